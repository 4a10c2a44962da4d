// Light that the air would scatter towards the observer, once, if neither ground nor clouds kept it from the light's
// source: looked up at a lattice of pixels, or along a list of directions. Light that is scattered more often comes from
// everywhere, and stays.
import package::lib::air::{Air, coefficients_at};
import package::lib::camera::{Camera, sight_at};
import package::lib::cloud_shade::{CloudShade, shade_depth};
import package::lib::geometry::{altitude_after, cosine_after, distance_to_sphere, distance_to_top, shell_stretch};
import package::lib::ground::{ground, to_ground_frame};
import package::lib::ground_light::{SHADOW, shadow, sun_in_air};
import package::lib::light::View;
import package::lib::phase::{cornette_shanks_phase, rayleigh_phase};
import package::lib::seen_ground::PackedGround;
import package::lib::shaft_lattice::Lost;
import package::lib::shaft_ray::{LostSum, with_step};
import package::lib::transmittance::transmittance_to_space;

override PROJECTION: u32 = 0u;
override LIST: bool = false;
override CLOUDS: bool = false;
// True to smear over the picture what hides the source's surroundings.
override RADIAL: bool = false;

struct Tile {
    origin_px: vec2u,
    size_px: vec2u,
    // From one place of the lattice to the next.
    stride_px: u32,
}

struct CloudFrame {
    // The observer's place in the scene.
    place_m: vec3f,
    // The light that casts shadows.
    light: vec3f,
}

struct Shafts {
    // Places along a ray, or over the picture.
    steps: u32,
    // For radial ones: how much of the way to the source's image is looked at, what counts of its far end, what multiplies
    // the shafts, and where the image is, in shares of the picture's sides.
    length: f32,
    decay: f32,
    strength: f32,
    image: vec2f,
}

@group(0) @binding(3) var<uniform> air: Air;
// The light that casts shadows.
@group(0) @binding(4) var<uniform> view: View;
@group(0) @binding(5) var<uniform> camera: Camera;
@group(0) @binding(6) var<uniform> tile: Tile;
@group(0) @binding(7) var transmittance_table: texture_2d<f32>;
@group(0) @binding(8) var linear_clamp: sampler;
@group(0) @binding(9) var<uniform> shade: CloudShade;
@group(0) @binding(10) var shade_maps: texture_2d_array<f32>;
@group(0) @binding(11) var<uniform> cloud_frame: CloudFrame;
@group(0) @binding(12) var<uniform> settings: Shafts;
@group(0) @binding(13) var<storage, read> directions: array<vec4f>;
@group(0) @binding(14) var<storage, read> seen: array<PackedGround>;
@group(0) @binding(15) var<storage, read_write> lost: array<Lost>;
// Six vectors a place, as `Nodes` has them.
@group(0) @binding(16) var<storage, read> clouds_seen: array<vec4f>;

// Beyond, no shadow is looked for.
const FARTHEST_M = 1.6e5;

// The stretch of a ray in the ground's frame that the map covers, below the highest that stands there.
fn stretch_in_map(p: vec3f, d: vec3f) -> vec2f {
    let start = (vec3f(dot(p, shadow.right), dot(p, shadow.up), dot(p, shadow.light)) - shadow.middle_m) / shadow.half_m;
    let along = vec3f(dot(d, shadow.right), dot(d, shadow.up), dot(d, shadow.light)) / shadow.half_m;
    let inverse = 1.0 / select(along, vec3f(1e-12), abs(along) < vec3f(1e-12));
    let a = (vec3f(-1.0, -1.0, -1e9) - start) * inverse;
    let b = (vec3f(1.0) - start) * inverse;
    let enter = max(max(min(a.x, b.x), min(a.y, b.y)), min(a.z, b.z));
    let leave = min(min(max(a.x, b.x), max(a.y, b.y)), max(a.z, b.z));
    return vec2f(enter, leave);
}

fn joined(a: vec2f, b: vec2f) -> vec2f {
    let either = select(a, b, a.x >= a.y);
    return select(either, vec2f(min(a.x, b.x), max(a.y, b.y)), a.x < a.y && b.x < b.y);
}

// Of the light at p, the share that does not come straight from its source.
fn hidden_share(p: vec3f, altitude_m: f32, mu: f32) -> f32 {
    var lit = 1.0;
    if SHADOW != 0u {
        let moved = p - cloud_frame.place_m;
        lit = sun_in_air(ground.place_m + to_ground_frame(moved));
    }
    if CLOUDS {
        lit *= exp(-shade_depth(shade, shade_maps, linear_clamp, air.radius_m, p, altitude_m, cloud_frame.light, mu));
    }
    return 1.0 - lit;
}

// Steps of a ray that is lit alike all along.
const EVEN_STEPS = 12u;

// ∫ (1 - V) T σ_s p T_light dt, by the middles of steps that grow with the square, all moved by the same share of a step.
fn lost_along(direction: vec3f, end_m: f32, jitter: f32, smeared: f32) -> Lost {
    let mu = clamp(dot(direction, view.up), -1.0, 1.0);
    let nu = clamp(dot(direction, view.sun), -1.0, 1.0);
    let h0 = view.altitude_m;
    // The air ends there.
    let in_air = select(vec2f(0.0, distance_to_top(air.radius_m, air.top_m, h0, mu)), shell_stretch(air.radius_m + air.top_m, h0 - air.top_m, mu, end_m), h0 > air.top_m);
    var reach = vec2f(0.0);
    if RADIAL {
        reach = vec2f(0.0, end_m);
    } else if SHADOW != 0u {
        reach = stretch_in_map(ground.place_m, to_ground_frame(direction));
    }
    if !RADIAL && CLOUDS && shade.count > 0u {
        let last = shade.count - 1u;
        let top_m = shade.middles_m[last / 4u][last % 4u];
        reach = joined(reach, shell_stretch(air.radius_m + top_m, h0 - top_m, mu, end_m));
    }
    let first_m = max(in_air.x, 0.0);
    let from_m = max(reach.x, first_m);
    let to_m = min(min(reach.y, end_m), min(in_air.y, from_m + FARTHEST_M));
    var sum: LostSum;
    if to_m > from_m {
        sum.left = vec3f(1.0);
        if from_m > first_m {
            var depth = vec3f(0.0);
            for (var k = 0u; k < 8u; k++) {
                let h = altitude_after(air.radius_m, h0, mu, mix(first_m, from_m, (f32(k) + 0.5) / 8.0));
                depth += coefficients_at(air, h, h < air.haze_top_m).extinction_per_m;
            }
            sum.left = exp(-depth * (from_m - first_m) / 8.0);
        }
        let phases = vec2f(rayleigh_phase(nu), cornette_shanks_phase(nu, air.mie_asymmetry));
        let steps = select(settings.steps, EVEN_STEPS, RADIAL);
        for (var k = 0u; k < steps; k++) {
            let near = f32(k) / f32(steps);
            let far = f32(k + 1u) / f32(steps);
            let dt = (to_m - from_m) * (far * far - near * near);
            let x = mix(near, far, jitter);
            let t = from_m + (to_m - from_m) * x * x;
            let h = max(altitude_after(air.radius_m, h0, mu, t), 0.0);
            let mu_light = cosine_after(air.radius_m, h0, h, view.mu_s, nu, t);
            var hidden = smeared;
            if !RADIAL {
                hidden = hidden_share(cloud_frame.place_m + t * direction, h, mu_light);
            }
            let lit = transmittance_to_space(air, transmittance_table, linear_clamp, h, mu_light);
            sum = with_step(sum, air, h, phases, lit, hidden, dt, far);
        }
    }
    return Lost(view.sun_irradiance * sum.lost, end_m, from_m, to_m, pack4x8unorm(sum.first), pack4x8unorm(sum.second));
}

// Interleaved gradient noise (Jimenez 2014): even over every 3×3 places.
fn jitter_of(place: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(place, vec2f(0.06711056, 0.00583715))));
}

const ENDLESS_M = 1e12;

fn end_of(direction: vec3f, seen_m: f32) -> f32 {
    let met_m = distance_to_sphere(air.radius_m, view.altitude_m, dot(direction, view.up));
    return select(select(ENDLESS_M, met_m, met_m >= 0.0), seen_m, seen_m >= 0.0);
}

fn look(i: u32, direction: vec3f, seen_m: f32, jitter: f32, smeared: f32) {
    lost[i] = lost_along(direction, end_of(direction, seen_m), jitter, smeared);
}

// Of the picture between a place of the lattice and the source's image, the share that something stands or hangs before,
// the nearer the more (Mitchell, GPU Gems 3, chapter 13). What lies beyond the picture hides nothing.
fn hidden_towards_image(id: vec2u, jitter: f32) -> f32 {
    // The lattice has a place before the picture and two beyond it.
    let last = vec2f(tile.size_px) - 3.0;
    let image = settings.image * last + 1.0;
    var hidden = 0.0;
    var whole = 0.0;
    for (var k = 0u; k < settings.steps; k++) {
        let part = (f32(k) + jitter) / f32(settings.steps);
        let place = mix(vec2f(id), image, settings.length * part);
        let weight = pow(max(settings.decay, 1e-6), part);
        whole += weight;
        if all(place >= vec2f(0.0)) && all(place <= vec2f(tile.size_px - 1u)) {
            let at = vec2u(round(place));
            let i = at.y * tile.size_px.x + at.x;
            var there = select(0.0, 1.0, seen[i].distance_m >= 0.0);
            if CLOUDS {
                there = max(there, dot(clouds_seen[6u * i + 1u] + clouds_seen[6u * i + 4u], vec4f(1.0)));
            }
            hidden += weight * there;
        }
    }
    // Clouds have taken their share on average.
    return settings.strength * select(1.0, shade.direct_left, CLOUDS) * hidden / whole;
}

@compute @workgroup_size(8, 8)
fn shafts(@builtin(global_invocation_id) id: vec3u) {
    if LIST {
        if id.x < arrayLength(&directions) && id.y == 0u {
            look(id.x, directions[id.x].xyz, seen[id.x].distance_m, 0.5, 0.0);
        }
        return;
    }
    if any(id.xy >= tile.size_px) {
        return;
    }
    // What lies left of the frame wraps round.
    let at = vec2i(tile.origin_px + tile.stride_px * id.xy);
    let sight = sight_at(camera, PROJECTION, vec2f(at) + 0.5);
    let i = id.y * tile.size_px.x + id.x;
    if sight.seen {
        let jitter = jitter_of(vec2f(at / i32(tile.stride_px)));
        var smeared = 0.0;
        if RADIAL {
            smeared = hidden_towards_image(id.xy, jitter);
        }
        look(i, sight.direction, seen[i].distance_m, jitter, smeared);
    } else {
        lost[i] = Lost(vec3f(0.0), ENDLESS_M, 0.0, 0.0, 0u, 0u);
    }
}
