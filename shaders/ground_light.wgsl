// The light of the ground before every pixel of one tile, through the air in front of it.
import package::lib::aerial::aerial_to;
import package::lib::air::Air;
import package::lib::airglow::{Airglow, airglow_radiance};
import package::lib::camera::{Camera, sight_at};
import package::lib::cloud_air::{lost_before, lost_in_air, scattered_under_clouds};
import package::lib::cloud_shade::{CloudShade, shade_depth, slab_transmission};
import package::lib::geometry::{PI, altitude_after, angle_of_cosine, distance_to_air, distance_to_sphere, distance_to_top, edge_cosine, horizon_distance_squared, over_horizon};
import package::lib::harmonics::irradiance_towards;
import package::lib::light::{View, scattered_radiance};
import package::lib::scattering::{AirRay, March, Scattered, scatter_along};
import package::lib::seen_ground::{PackedGround, SeenGround, unpack_ground};
import package::lib::shaft_lattice::{Lost, depth_weight, lattice_weight, lost_of};
import package::lib::source::cosine_of_azimuth;
import package::lib::tables::{SkyViewRay, light_from_table, sky_view_coordinate, sun_cosine_unit, unit_to_coordinate};
import package::lib::transmittance::transmittance_to_space;
import package::lib::view_ray::{Observer, enter_air};
import package::lib::water::{glitter, mean_reflectance, mirrored_direction, slope_variance};

// 0: light in the air from a volume; 1: integrated along each pixel's ray, 2: with the optical depth to the sun
// integrated in every step of it.
override METHOD: u32 = 0u;
override MULTIPLE: bool = true;
override HAZE: bool = true;
override AIRGLOW: bool = true;
override MOONLIGHT: bool = false;
override CLOUDS: bool = false;
// True where no shafts tell what the air loses to clouds.
override CLOUD_AIR: bool = false;
override SHAFTS: bool = false;
// True where the sphere is of water.
override WATER: bool = false;
// True where nobody follows a ray through the clouds before the ground: none are there.
override DOME: bool = false;
// True where the ground hides the moon's light, not the sun's.
override MOON_HIDDEN: bool = false;
override PROJECTION: u32 = 0u;
// True to look along a list of directions, not through the pixels of a tile.
override LIST: bool = false;

struct Tile {
    origin_px: vec2u,
    size_px: vec2u,
    // From one pixel of the tile to the next in the frame.
    stride_px: u32,
}

struct LightSettings {
    // The lattice at which shafts were looked for: its first place, places in a row, and pixels from one to the next.
    first_place_px: vec2u,
    places_across: u32,
    grain: u32,
    // Over the water.
    wind_m_s: f32,
}

struct CloudFrame {
    // The observer's place in the scene.
    place_m: vec3f,
    // The light that casts the clouds' shadows.
    light: vec3f,
}

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(1) var<uniform> view: View;
@group(0) @binding(2) var<uniform> camera: Camera;
@group(0) @binding(3) var<uniform> tile: Tile;
@group(0) @binding(4) var<uniform> observer: Observer;
@group(0) @binding(5) var transmittance_table: texture_2d<f32>;
@group(0) @binding(6) var linear_clamp: sampler;
@group(0) @binding(7) var irradiance_table: texture_2d<f32>;
@group(0) @binding(8) var source_table: texture_2d_array<f32>;
@group(0) @binding(9) var aerial_rayleigh: texture_3d<f32>;
@group(0) @binding(10) var aerial_mie: texture_3d<f32>;
@group(0) @binding(11) var aerial_multiple: texture_3d<f32>;
@group(0) @binding(12) var<uniform> glow: Airglow;
// The moon in the sun's place.
@group(0) @binding(13) var<uniform> moon_view: View;
@group(0) @binding(14) var<uniform> moon_observer: Observer;
@group(0) @binding(15) var<uniform> shade: CloudShade;
@group(0) @binding(16) var shade_maps: texture_2d_array<f32>;
@group(0) @binding(17) var<uniform> cloud_frame: CloudFrame;
@group(0) @binding(18) var<storage, read> directions: array<vec4f>;
@group(0) @binding(19) var<storage, read> seen: array<PackedGround>;
// Harmonics of the sky's light over the ground, of the sun's and then of the moon's.
@group(0) @binding(20) var<storage, read> sky_harmonics: array<vec4f>;
// Radiance in R, G, B and how far away it is; where nothing stands, what the sky loses to shafts, and -1 less the share of what
// clear air before the horizon sends that is lost.
@group(0) @binding(21) var<storage, read_write> lit_ground: array<vec4f>;
@group(0) @binding(22) var<uniform> settings: LightSettings;
// Of the lattice, or of each direction.
@group(0) @binding(23) var<storage, read> lost: array<Lost>;
// Of each pixel or direction, for those who look at what stands before it.
@group(0) @binding(24) var<storage, read_write> lost_to_shafts: array<Lost>;
// `LostInAir`.
@group(0) @binding(25) var cloud_air_table: texture_2d_array<f32>;

// Where on the ground light falls.
struct Place {
    p: vec3f,
    up: vec3f,
    altitude_m: f32,
}

struct Shade {
    sun: f32,
    sky: f32,
}

// 0 below the lowest clouds, 1 from their middle on.
fn over_clouds(altitude_m: f32) -> f32 {
    let middle_m = max(shade.middles_m[0].x, shade.base_m + 1.0);
    return select(0.0, smoothstep(shade.base_m, middle_m, altitude_m), CLOUDS);
}

// What clouds leave of the light there.
fn clouds_leave(place: Place) -> Shade {
    if !CLOUDS {
        return Shade(1.0, 1.0);
    }
    let mu = dot(place.up, cloud_frame.light);
    let depth = shade_depth(shade, shade_maps, linear_clamp, air.radius_m, place.p, place.altitude_m, cloud_frame.light, mu);
    let cosine = max(mu, 0.03);
    return Shade(slab_transmission(shade.asymmetry, cosine, depth * cosine), mix(shade.diffuse_left, 1.0, over_clouds(place.altitude_m)));
}

// Phong 1975, with each term a share of the light that falls on the surface: the lobe about the mirror's direction
// integrates to 1 by (n+1)/(2π).
fn radiance_by(light: View, first: u32, lit: f32, found: SeenGround, place: Place, direction: vec3f, left: Shade) -> vec3f {
    let mu = dot(place.up, light.sun);
    let falling = max(dot(found.normal, light.sun), 0.0);
    let straight = falling * lit * left.sun * transmittance_to_space(air, transmittance_table, linear_clamp, place.altitude_m, mu);
    // The sky by the table where the sun stands as there, and by harmonics for which way the surface faces.
    let level = sky_at(mu);
    let sun_below = max(mu, 0.0) * transmittance_to_space(air, transmittance_table, linear_clamp, 0.0, mu);
    // Over clouds, what comes from below is what they send back: all but what they let through.
    let over = over_clouds(place.altitude_m);
    let deck = mix(air.ground_albedo, vec3f(1.0), over * (1.0 - shade.diffuse_left));
    let bounced = deck * (mix(left.sun, 1.0, over) * sun_below + left.sky * level);
    let tilt = irradiance_share(first, found.normal, place.up);
    let sky = left.sky * level * found.open * tilt + (1.0 - found.open * 0.5 * (1.0 + dot(found.normal, place.up))) * bounced;
    if WATER && found.water {
        return light.sun_irradiance * water_by(light, found.diffuse, straight, left.sky * level, lit * left.sun, place, direction);
    }
    let mirrored = reflect(direction, found.normal);
    let lobe = (found.shininess + 1.0) / (2.0 * PI) * pow(max(dot(mirrored, light.sun), 0.0), found.shininess);
    return light.sun_irradiance * ((found.diffuse * straight + found.ambient * sky) / PI + found.specular * lobe * straight);
}

const MIRROR_STEPS = 16u;

// Of water: the light's glitter, which is the image of its disc, the sky that the waves mirror, and what comes back out of the water of what went in.
fn water_by(light: View, albedo: vec3f, straight: vec3f, sky: vec3f, lit: f32, place: Place, direction: vec3f) -> vec3f {
    let variance = slope_variance(settings.wind_m_s);
    let mu = dot(place.up, light.sun);
    let view_cosine = max(-dot(direction, place.up), 0.0);
    let mirrors = mean_reflectance(view_cosine, variance);
    let sun = light.disc * lit * transmittance_to_space(air, transmittance_table, linear_clamp, 0.0, mu) * glitter(place.up, -direction, light.sun, variance);
    let towards = mirrored_direction(place.up, -direction, variance);
    let mu_towards = dot(towards, place.up);
    let nu = clamp(dot(towards, light.sun), -1.0, 1.0);
    let ray = AirRay(0.0, mu_towards, mu, nu, distance_to_top(air.radius_m, air.top_m, 0.0, mu_towards));
    let march = March(true, MULTIPLE, HAZE, false, MIRROR_STEPS, 4u, 0u);
    let mirrored = scatter_along(air, ray, transmittance_table, source_table, linear_clamp, march);
    let even = View(light.up, light.altitude_m, light.sun, light.mu_s, vec3f(1.0), light.sun_angular_radius, light.limb_exponent, light.disc);
    let left = sky / max(sky_at(mu), vec3f(1e-12));
    return sun + mirrors * left * scattered_radiance(air, even, mirrored, nu) + (1.0 - mirrors) * albedo / PI * (straight + sky);
}

// Of the whole sky on a level place, for a light of unit irradiance at that cosine.
fn sky_at(mu: f32) -> vec3f {
    let x = unit_to_coordinate(sun_cosine_unit(mu), textureDimensions(irradiance_table).x);
    return light_from_table(textureSampleLevel(irradiance_table, linear_clamp, vec2f(x, 0.5), 0.0).rgb);
}

// Irradiance of a surface against that of a level one, under the sky where the ground stands.
fn irradiance_share(first: u32, normal: vec3f, up: vec3f) -> vec3f {
    var c: array<vec3f, 9>;
    for (var k = 0u; k < 9u; k++) {
        c[k] = sky_harmonics[first + k].rgb;
    }
    return irradiance_towards(c, normal) / max(irradiance_towards(c, up), vec3f(1e-12));
}

// Light in the air up to the ground, of a ray with these cosines.
fn air_before(direction: vec3f, distance_m: f32) -> Scattered {
    let mu = clamp(dot(direction, view.up), -1.0, 1.0);
    let nu = clamp(dot(direction, view.sun), -1.0, 1.0);
    if METHOD == 0u {
        let met_m = distance_to_sphere(air.radius_m, view.altitude_m, mu);
        let entry = enter_air(air, observer, mu, nu, met_m >= 0.0, met_m);
        let from_m = distance_to_air(air.radius_m, air.top_m, view.altitude_m, mu);
        let ray = SkyViewRay(angle_of_cosine(cosine_of_azimuth(mu, view.mu_s, nu)), angle_of_cosine(mu), met_m >= 0.0, met_m);
        let way_m = clamp(distance_m - from_m, 0.0, max(entry.length_m, 0.0));
        return aerial_to(air, aerial_rayleigh, aerial_mie, aerial_multiple, linear_clamp, view.altitude_m, ray, way_m, max(entry.length_m, 0.0));
    }
    var light: Scattered;
    let entry = enter_air(air, observer, mu, nu, true, distance_m);
    if entry.length_m > 0.0 {
        let march = March(true, MULTIPLE, HAZE, METHOD == 2u, observer.steps, 6u, observer.sun_steps);
        light = scatter_along(air, entry, transmittance_table, source_table, linear_clamp, march);
    }
    return light;
}

// Under clouds the air gets what they let through, on average. Whoever follows a ray through them takes that from it.
fn under_clouds(light: Scattered, direction: vec3f, distance_m: f32) -> Scattered {
    if !DOME || view.altitude_m >= shade.base_m {
        return light;
    }
    let up_m = distance_to_top(air.radius_m, shade.base_m, view.altitude_m, dot(direction, view.up));
    let share = min(up_m / max(distance_m, 1.0), 1.0);
    return Scattered(light.rayleigh, light.mie, mix(1.0, shade.diffuse_left, share) * light.multiple, light.optical_depth);
}

// What the air up to the ground loses to clouds of the light that it scatters once, less what it gets of theirs.
fn lost_under_clouds(direction: vec3f, distance_m: f32, light: Scattered) -> vec3f {
    var lost = vec3f(0.0);
    if CLOUD_AIR {
        let in_air = lost_in_air(cloud_air_table, linear_clamp, direction, view.up, edge_cosine(air.radius_m, view.altitude_m));
        let from_m = distance_to_air(air.radius_m, air.top_m, view.altitude_m, dot(direction, view.up));
        let once = Scattered(light.rayleigh, light.mie, vec3f(0.0), light.optical_depth);
        lost = lost_before(in_air, scattered_radiance(air, view, once, clamp(dot(direction, view.sun), -1.0, 1.0)), distance_m - from_m);
    }
    if DOME && view.altitude_m < shade.base_m {
        lost -= scattered_under_clouds(air, view, shade, transmittance_table, linear_clamp, exp(-light.optical_depth));
    }
    return lost;
}

fn radiance_towards(direction: vec3f, found: SeenGround) -> vec3f {
    let mu = clamp(dot(direction, view.up), -1.0, 1.0);
    let nu = clamp(dot(direction, view.sun), -1.0, 1.0);
    let p = cloud_frame.place_m + found.distance_m * direction;
    let altitude_m = max(altitude_after(air.radius_m, view.altitude_m, mu, found.distance_m), 0.0);
    let place = Place(p, normalize(p + vec3f(0.0, 0.0, air.radius_m)), altitude_m);
    let left = clouds_leave(place);
    let light = air_before(direction, found.distance_m);
    var seen_there = radiance_by(view, 0u, select(found.lit, 1.0, MOON_HIDDEN), found, place, direction, left);
    var between = scattered_radiance(air, view, under_clouds(light, direction, found.distance_m), nu);
    between -= lost_under_clouds(direction, found.distance_m, light);
    if AIRGLOW {
        seen_there += found.ambient / PI * glow.ground_irradiance;
        between += airglow_radiance(glow, air.radius_m, view.altitude_m, mu, found.distance_m, light.optical_depth);
    }
    if MOONLIGHT {
        seen_there += radiance_by(moon_view, 9u, select(1.0, found.lit, MOON_HIDDEN), found, place, direction, left);
        let nu_moon = clamp(dot(direction, moon_view.sun), -1.0, 1.0);
        let entry = enter_air(air, moon_observer, mu, nu_moon, true, found.distance_m);
        if entry.length_m > 0.0 {
            let march = March(true, MULTIPLE, HAZE, false, 16u, 4u, 0u);
            let moonlit = scatter_along(air, entry, transmittance_table, source_table, linear_clamp, march);
            between += scattered_radiance(air, moon_view, under_clouds(moonlit, direction, found.distance_m), nu_moon);
        }
    }
    return between + exp(-light.optical_depth) * seen_there;
}

const ENDLESS_M = 1e12;

// What clear air sends from before a distance after one scattering.
fn sent_once(direction: vec3f, distance_m: f32) -> vec3f {
    var light = air_before(direction, distance_m);
    light.multiple = vec3f(0.0);
    return scattered_radiance(air, view, light, clamp(dot(direction, view.sun), -1.0, 1.0));
}

// The lattice's rays end elsewhere by more than this factor, as just under the horizon, where the ground is at 200 m in one place
// and at 1 km in the next pixel.
const ELSEWHERE = 1.1;

// What a ray through a pixel of the frame loses to shafts.
fn lost_at(pixel: vec2u, direction: vec3f, end_m: f32) -> Lost {
    // The lattice may begin left of the frame, where it wraps round.
    let place = vec2f(pixel - settings.first_place_px) / f32(settings.grain);
    let nearest = vec2i(round(place));
    var sum: Lost;
    var first = vec4f(0.0);
    var second = vec4f(0.0);
    var weights = 0.0;
    // Of rays that were looked along up to their ends, and where that was.
    var ended = 0.0;
    var ends_m = 0.0;
    for (var k = 0; k < 9; k++) {
        let at = nearest + vec2i(k % 3, k / 3) - 1;
        let there = lost[u32(at.y) * settings.places_across + u32(at.x)];
        let weight = lattice_weight(place - vec2f(at)) * depth_weight(end_m, there.end_m);
        sum.light += weight * there.light;
        sum.from_m += weight * there.from_m;
        sum.to_m += weight * there.to_m;
        let to_end = select(0.0, weight, there.to_m > 0.99 * there.end_m);
        ended += to_end;
        ends_m += to_end * there.end_m;
        first += weight * unpack4x8unorm(there.first);
        second += weight * unpack4x8unorm(there.second);
        weights += weight;
    }
    let share = 1.0 / max(weights, 1e-12);
    var light = share * sum.light;
    var to_m = share * sum.to_m;
    if ended > 0.5 * weights && end_m < ENDLESS_M {
        let ended_m = ends_m / ended;
        if max(end_m / ended_m, ended_m / end_m) > ELSEWHERE {
            light *= sent_once(direction, end_m) / max(sent_once(direction, ended_m), vec3f(1e-30));
            to_m = end_m;
        }
    }
    return Lost(light, end_m, share * sum.from_m, to_m, pack4x8unorm(share * first), pack4x8unorm(share * second));
}

// Of what clear air sends from before the horizon, the share that is lost; elsewhere nobody asks.
fn share_before_horizon(direction: vec3f, less: Lost) -> f32 {
    let mu = dot(direction, view.up);
    let horizon_mu = edge_cosine(air.radius_m, view.altitude_m);
    var share = 0.0;
    if abs(mu - horizon_mu) < camera.pixel_angle {
        let edge_m = sqrt(horizon_distance_squared(air.radius_m, view.altitude_m));
        let sent = sent_once(direction, edge_m);
        share = dot(lost_of(less, sent, edge_m), vec3f(1.0)) / max(dot(sent, vec3f(1.0)), 1e-30);
    }
    return share;
}

fn write(i: u32, direction: vec3f, pixel: vec2u) {
    let found = unpack_ground(seen[i]);
    var value = vec4f(0.0, 0.0, 0.0, -1.0);
    if found.distance_m >= 0.0 {
        value = vec4f(radiance_towards(direction, found), found.distance_m);
    }
    if SHAFTS {
        // Where the horizon crosses a pixel, the sky in it is asked for; the ground loses what is before it.
        let met_m = distance_to_sphere(air.radius_m, view.altitude_m, dot(over_horizon(direction, view.up, edge_cosine(air.radius_m, view.altitude_m), 0.5 * camera.pixel_angle), view.up));
        let end_m = select(select(ENDLESS_M, met_m, met_m >= 0.0), found.distance_m, found.distance_m >= 0.0);
        var less: Lost;
        if LIST {
            less = lost[i];
        } else {
            less = lost_at(pixel, direction, end_m);
        }
        lost_to_shafts[i] = less;
        if found.distance_m >= 0.0 {
            value = vec4f(max(value.rgb - less.light, vec3f(0.0)), found.distance_m);
        } else {
            value = vec4f(less.light, -1.0 - share_before_horizon(direction, less));
        }
    }
    lit_ground[i] = value;
}

@compute @workgroup_size(8, 8)
fn ground_light(@builtin(global_invocation_id) id: vec3u) {
    if LIST {
        if id.x < arrayLength(&directions) && id.y == 0u {
            write(id.x, directions[id.x].xyz, vec2u(0u));
        }
        return;
    }
    if any(id.xy >= tile.size_px) {
        return;
    }
    let pixel = tile.origin_px + tile.stride_px * id.xy;
    let sight = sight_at(camera, PROJECTION, vec2f(pixel) + 0.5);
    write(id.y * tile.size_px.x + id.x, sight.direction, pixel);
}
