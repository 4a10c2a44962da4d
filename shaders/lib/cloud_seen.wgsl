// The light of the clouds that a ray sees. Whoever imports from here binds what `lib/cloud_on_ground.wgsl` names, and then
// this.
import package::lib::cloud::{clouds, sheet_optical_depth};
import package::lib::cloud_air::{LostInAir, lost_before, lost_in_air};
import package::lib::cloud_light::forward_lobes;
import package::lib::cloud_march::{FIRST_SHEET, OPAQUE};
import package::lib::cloud_nodes::{NODES, Nodes};
import package::lib::cloud_on_ground::lit_past_ground;
import package::lib::cloud_ray::{COARSEST_PIXEL, CloudRay, air, place_at, view};
import package::lib::cloud_source::{AirBefore, Surroundings, air_before, air_under_base, air_under_clouds, kept_from_air_among_clouds, linear_clamp, sheet_source, source_at, surroundings};
import package::lib::geometry::{altitude_after, edge_cosine};
import package::lib::shaft_lattice::{Lost, lost_of};

// True where no shafts tell what the air loses to clouds.
override CLOUD_AIR: bool = true;

// `LostInAir`.
@group(0) @binding(20) var cloud_air_table: texture_2d_array<f32>;

// What lights a place, and the air before it, serve for others that are no farther from it than this part of the way.
const NEAR = 0.05;

fn dimmed(around: Surroundings, lit: f32) -> Surroundings {
    return Surroundings(lit * around.sun, around.above, around.below, around.mu_s);
}

// Radiance to add in R, G, B; alpha is the share of what lies behind that comes through. `lost` is what the ray loses to
// shafts: the part of it that is before a cloud is not hidden by that.
fn clouds_seen(ray: CloudRay, nodes: Nodes, lost: Lost) -> vec4f {
    let lobes = forward_lobes(ray.nu);
    var light = vec3f(0.0);
    var around: Surroundings;
    var before: AirBefore;
    var around_m = -1.0;
    var lost_from = vec3f(0.0);
    if lost.from_m > 0.0 {
        lost_from = air_before(ray, lost.from_m).single;
    }
    let under = air_under_base(ray);
    var in_air: LostInAir;
    if CLOUD_AIR {
        in_air = lost_in_air(cloud_air_table, linear_clamp, ray.direction, view.up, edge_cosine(air.radius_m, view.altitude_m));
    }
    for (var n = 0u; n < NODES; n++) {
        var four = nodes.first;
        if n >= 4u {
            four = nodes.second;
        }
        let k = n % 4u;
        if four.share[k] > 0.0 {
            let distance_m = four.distance_m[k];
            let p = place_at(distance_m, ray.direction);
            let altitude_m = altitude_after(clouds.radius_m, view.altitude_m, ray.mu, distance_m);
            let index = u32(four.kind[k]);
            let part = fract(four.kind[k]);
            let extinction = part / (1.0 - part);
            if around_m < 0.0 || abs(distance_m - around_m) > NEAR * distance_m {
                around = surroundings(p, altitude_m);
                before = air_before(ray, distance_m);
                around_m = distance_m;
            }
            var source = vec3f(0.0);
            let lit = lit_past_ground(p);
            if index < FIRST_SHEET {
                source = source_at(index, p, altitude_m, extinction, dimmed(around, lit), lobes, min(ray.spread, COARSEST_PIXEL) * distance_m);
            }
            if index >= FIRST_SHEET {
                let sheet = clouds.sheets[index - FIRST_SHEET];
                source = sheet_source(index - FIRST_SHEET, p, ray.direction, sheet_optical_depth(sheet, p, sheet.height_m), dimmed(surroundings(p, sheet.height_m), lit), lobes);
            }
            var hidden = lost_of(lost, before.single - lost_from, distance_m);
            if CLOUD_AIR {
                hidden = min(hidden + lost_before(in_air, before.single, distance_m - ray.air_from_m), before.single);
            }
            hidden += kept_from_air_among_clouds(under, before, altitude_m);
            light += four.share[k] * (before.left * source + before.single + before.multiple - hidden);
        }
    }
    // What is left of an opaque cloud is nothing.
    let left = 1.0 - dot(nodes.first.share + nodes.second.share, vec4f(1.0));
    return vec4f(light + air_under_clouds(under), select(left, 0.0, left < 1.001 * OPAQUE));
}
