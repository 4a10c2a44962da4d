// The light of a place in the clouds, and the air before it. Whoever imports from here binds what `lib/cloud_ray.wgsl` names,
// and then this.
import package::lib::aerial::aerial_to;
import package::lib::cloud_air::scattered_under_clouds;
import package::lib::cloud::{CloudBand, band_at, clouds};
import package::lib::cloud_far::BLURRED;
import package::lib::cloud_light::{Lobes, ambient_source, depth_seen, lit_source};
import package::lib::cloud_ray::{CloudRay, air, view};
import package::lib::cloud_shade::{CloudShade, LightDepth, beyond_maps, depths_beyond, light_column, light_cosine, shade_depth};
import package::lib::cloud_volume::coarse_extinction;
import package::lib::geometry::{along_sphere, altitude_after, distance_to_top};
import package::lib::light::scattered_radiance;
import package::lib::tables::{SkyViewRay, light_from_table, sun_cosine_unit, unit_to_coordinate};
import package::lib::transmittance::transmittance_to_space;

@group(0) @binding(10) var<uniform> shade: CloudShade;
@group(0) @binding(11) var linear_clamp: sampler;
@group(0) @binding(12) var transmittance_table: texture_2d<f32>;
@group(0) @binding(13) var irradiance_table: texture_2d<f32>;
@group(0) @binding(14) var aerial_rayleigh: texture_3d<f32>;
@group(0) @binding(15) var aerial_mie: texture_3d<f32>;
@group(0) @binding(16) var aerial_multiple: texture_3d<f32>;
@group(0) @binding(17) var shade_maps: texture_2d_array<f32>;
// Extinction coefficients, as `lib/cloud_volume.wgsl` places them.
@group(0) @binding(21) var cloud_volume: texture_3d<f32>;

// Light in the air up to a distance, and what the air lets through.
struct AirBefore {
    single: vec3f,
    multiple: vec3f,
    left: vec3f,
}

fn air_before(ray: CloudRay, t: f32) -> AirBefore {
    let way_m = clamp(t - ray.air_from_m, 0.0, ray.air_length_m);
    let sky_ray = SkyViewRay(ray.azimuth, ray.zenith_angle, ray.ground, ray.end_m);
    let light = aerial_to(air, aerial_rayleigh, aerial_mie, aerial_multiple, linear_clamp, view.altitude_m, sky_ray, way_m, ray.air_length_m);
    let all = scattered_radiance(air, view, light, ray.nu);
    let multiple = view.sun_irradiance * light.multiple;
    return AirBefore(all - multiple, multiple, exp(-light.optical_depth));
}

// Optical depth of a band from a place on, that way; steps grow with the power 1.5 of their number, which brings
// six of them closest to as many as one likes.
fn depth_within(band: CloudBand, p: vec3f, altitude_m: f32, towards: vec3f, mu: f32, steps: u32, most_m: f32) -> f32 {
    var sum = 0.0;
    var near_m = 0.0;
    for (var k = 1u; k <= steps; k++) {
        let far = f32(k) / f32(steps);
        let far_m = most_m * far * sqrt(far);
        let t = 0.5 * (near_m + far_m);
        let h = altitude_after(clouds.radius_m, altitude_m, mu, t);
        sum += coarse_extinction(cloud_volume, linear_clamp, band, p + t * towards, h) * (far_m - near_m);
        near_m = far_m;
    }
    return sum;
}

// Light about a place of a cloud, W/m².
struct Surroundings {
    // Of the sun, through the air alone.
    sun: vec3f,
    // Of the whole sky on a level place, over the air below it; and of the ground and the air beneath.
    above: vec3f,
    below: vec3f,
    // The light's cosine with the zenith.
    mu_s: f32,
}

const AIR_SCALE_M = 8500.0;

fn surroundings(p: vec3f, altitude_m: f32) -> Surroundings {
    let mu_s = dot(normalize(p + vec3f(0.0, 0.0, clouds.radius_m)), view.sun);
    let x = unit_to_coordinate(sun_cosine_unit(mu_s), textureDimensions(irradiance_table).x);
    let sky = light_from_table(textureSampleLevel(irradiance_table, linear_clamp, vec2f(x, 0.5), 0.0).rgb);
    let on_ground = max(mu_s, 0.0) * transmittance_to_space(air, transmittance_table, linear_clamp, 0.0, mu_s);
    let here = transmittance_to_space(air, transmittance_table, linear_clamp, altitude_m, mu_s);
    let above = exp(-altitude_m / AIR_SCALE_M);
    // What clouds leave lights the ground and the air beneath them alike.
    let beneath = shade.diffuse_left * (air.ground_albedo * (on_ground + sky) + sky * (1.0 - above));
    let even = clouds.ambient_factor * view.sun_irradiance;
    let sun = clouds.sun_factor * clouds.sun_colour * view.sun_irradiance * here;
    return Surroundings(sun, even * sky * above, even * beneath, mu_s);
}

// With so many steps the light's way is followed to its ends.
const ALL_LIGHT_STEPS = 64u;
// With fewer, over this share of the shape noise's scale. Within it density changes faster than the maps can hold, which
// stand in texels and at eight heights.
const REACH = 0.25;
// A preview takes one step each way, over that share of it, while the sun is high: what is seen of a cloud is denser than its
// column is on average. Under a low sun light runs many kilometres from one of the maps' heights to the next, and these would
// stand as stripes on the clouds: from the second cosine down more of the way is followed, until the first.
const CLOSE_BY = 0.4;
const LOW_LIGHT = vec2f(0.05, 0.25);
// Steps of a preview then, and how far those of both go, against `REACH`.
const LOW_LIGHT_STEPS = 3u;
const LOW_LIGHT_REACH = 2.0;

// How far the steps go on one side: towards the light (`side` 1) or away from it (-1), `close_m` at most, and not out of the
// band.
fn followed_m(band: CloudBand, altitude_m: f32, cosine: f32, steps: u32, close_m: f32) -> f32 {
    let out_m = select(altitude_m - band.base_m, band.top_m - altitude_m, cosine > 0.0) / abs(cosine);
    return min(out_m, select(close_m, out_m, steps >= ALL_LIGHT_STEPS));
}

// Optical depth of a band on both sides of a place: followed close to it, and beyond as it stands in the maps of shadows.
fn depths_about(index: u32, band: CloudBand, p: vec3f, altitude_m: f32, mu_s: f32, steps: u32, close_m: f32) -> LightDepth {
    let cosine = light_cosine(mu_s);
    var near = vec2f(0.0);
    var reach_m = vec2f(0.0);
    if steps > 0u {
        reach_m = vec2f(followed_m(band, altitude_m, cosine, steps, close_m), followed_m(band, altitude_m, -cosine, steps, close_m));
        near.x = depth_within(band, p, altitude_m, view.sun, mu_s, steps, reach_m.x);
        near.y = depth_within(band, p, altitude_m, -view.sun, -mu_s, steps, reach_m.y);
    }
    if steps >= ALL_LIGHT_STEPS {
        return LightDepth(near.x, near.y);
    }
    let column = light_column(shade, shade_maps, linear_clamp, index, 0.5 * (band.base_m + band.top_m), clouds.radius_m, p, altitude_m, view.sun, mu_s);
    let shares = (band.top_m - altitude_m - vec2f(cosine, -cosine) * reach_m) / (band.top_m - band.base_m);
    let beyond = depths_beyond(column, shares.x, shares.y, mu_s);
    return LightDepth(near.x + beyond.before, near.y + beyond.behind);
}

// Of a band, how much of its height has cloud as dense as where it is seen.
const EVEN_FILLING = 0.5;

// Source function of a place in a band, W/m²/sr; `pixel_m` is what is seen as one there.
fn source_at(index: u32, p: vec3f, altitude_m: f32, extinction_per_m: f32, around: Surroundings, lobes: Lobes, pixel_m: f32) -> vec3f {
    let band = band_at(index);
    let mu_s = around.mu_s;
    let thickness = band.top_m - band.base_m;
    let low = 1.0 - smoothstep(LOW_LIGHT.x, LOW_LIGHT.y, abs(mu_s));
    let preview = clouds.light_steps == 0u;
    let near_steps = select(clouds.light_steps, select(1u, LOW_LIGHT_STEPS, low > 0.0), preview);
    let beyond = beyond_maps(shade, along_sphere(clouds.radius_m, p, altitude_m));
    // The light of heaps that are finer than a pixel is that of their mean.
    let steps = select(near_steps, 0u, beyond >= 1.0 || pixel_m * clouds.base_inverse_scale_per_m > BLURRED.y);
    let close_m = mix(select(1.0, CLOSE_BY, preview), LOW_LIGHT_REACH, low) * REACH / clouds.base_inverse_scale_per_m;
    var way = depths_about(index, band, p, altitude_m, mu_s, steps, close_m);
    let h = clamp((altitude_m - band.base_m) / thickness, 0.0, 1.0);
    if beyond > 0.0 {
        // The place's own density stands for the band's.
        let out = EVEN_FILLING * extinction_per_m * thickness / abs(light_cosine(mu_s));
        // Light that runs level comes from above and from below; no line may show where it turns.
        let before = mix(h, 1.0 - h, smoothstep(-0.1, 0.1, mu_s));
        way.before = mix(way.before, before * out, beyond);
        way.behind = mix(way.behind, (1.0 - before) * out, beyond);
    }
    let over = shade_depth(shade, shade_maps, linear_clamp, clouds.radius_m, p, band.top_m, view.sun, mu_s);
    // Into a heap even light comes by the shortest way, not straight down: a share of the thickness on either side. Into a
    // deck there is no other way than the light's own, less its slant.
    let heap = 0.5 * extinction_per_m * thickness * vec2f(1.0 - h, h);
    let deck = abs(light_cosine(mu_s)) * select(vec2f(way.behind, way.before), vec2f(way.before, way.behind), mu_s >= 0.0);
    let up = mix(deck.x, heap.x, band.leak);
    let down = mix(deck.y, heap.y, band.leak);
    let direct = around.sun * exp(-over) * lit_source(lobes, abs(light_cosine(mu_s)), way.before, way.behind, band.leak);
    return clouds.albedo * (direct + around.above * ambient_source(up, down) + around.below * ambient_source(down, up));
}

// A layer without thickness, of an optical depth: its light is that of a slab, at the depth that is seen of it on the average, so
// that a thick one sends down what the ground gets through it.
fn sheet_source(index: u32, p: vec3f, direction: vec3f, depth: f32, around: Surroundings, lobes: Lobes) -> vec3f {
    let sheet = clouds.sheets[index];
    let shaded = shade_depth(shade, shade_maps, linear_clamp, clouds.radius_m, p, sheet.height_m + 1.0, view.sun, around.mu_s);
    let mu = dot(normalize(p + vec3f(0.0, 0.0, clouds.radius_m)), direction);
    let seen = depth_seen(max(abs(mu), 0.05), depth);
    let over = select(seen, depth - seen, mu > 0.0);
    let under = depth - over;
    let cosine = max(abs(around.mu_s), 0.05);
    let ways = select(vec2f(under, over), vec2f(over, under), around.mu_s >= 0.0) / cosine;
    let direct = around.sun * exp(-shaded) * lit_source(lobes, cosine, ways.x, ways.y, 0.0);
    return clouds.albedo * (direct + around.above * ambient_source(over, under) + around.below * ambient_source(under, over));
}

// The air of a ray that begins under all clouds, up to the lowest base; none of another.
fn air_under_base(ray: CloudRay) -> AirBefore {
    if view.altitude_m >= shade.base_m {
        return AirBefore(vec3f(0.0), vec3f(0.0), vec3f(1.0));
    }
    return air_before(ray, min(distance_to_top(clouds.radius_m, shade.base_m, view.altitude_m, ray.mu), ray.stop_m));
}

// Under the clouds the air gets what they let through, on average: this is what that adds to the light of clear air that is
// scattered more than once, or takes from it.
fn air_under_clouds(under: AirBefore) -> vec3f {
    let added = scattered_under_clouds(air, view, shade, transmittance_table, linear_clamp, under.left);
    return added - (1.0 - shade.diffuse_left) * under.multiple;
}

// And from the lowest base up to a place among the clouds, where ever less of them stands over it: up to their top this is taken
// to change evenly.
fn kept_from_air_among_clouds(under: AirBefore, before: AirBefore, altitude_m: f32) -> vec3f {
    if view.altitude_m >= shade.base_m || clouds.band_count == 0u {
        return vec3f(0.0);
    }
    let thickness_m = clouds.bands[clouds.band_count - 1u].top_m - shade.base_m;
    let x = max(altitude_m - shade.base_m, 0.0) / max(thickness_m, 1.0);
    let kept = (1.0 - shade.diffuse_left) * select(0.5 / max(x, 1.0), 1.0 - 0.5 * x, x < 1.0);
    return kept * max(before.multiple - under.multiple, vec3f(0.0));
}
