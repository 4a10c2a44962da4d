// Radiance, transmittance and distance at exact directions, integrated along each ray without the sky-view table.
import package::lib::air::Air;
import package::lib::airglow::{Airglow, airglow_radiance};
import package::lib::cloud_air::{lost_before, lost_in_air};
import package::lib::cloud_shade::{CloudShade, ground_shaded};
import package::lib::geometry::{PI, angle_between, distance_to_air, distance_to_sphere, edge_cosine};
import package::lib::light::{UNSHADED, View, ground_radiance, scattered_radiance, sun_disc};
import package::lib::moon::{Moon, moon_radiance, place_on_moon};
import package::lib::scattering::{March, Scattered, scatter_along};
import package::lib::view_ray::{Observer, enter_air};

// False for the first order alone.
override MULTIPLE: bool = true;
// True where there is haze.
override HAZE: bool = true;
// True where the optical depth to the sun is integrated in every step.
override NESTED: bool = false;

// The moon's disc, and its light on air and ground.
override MOON: bool = false;
override MOONLIGHT: bool = false;
// True where there are clouds.
override CLOUDS: bool = false;
// True where no shafts tell what the air loses to them.
override CLOUD_AIR: bool = false;
// True where more than the sphere stands on the ground.
override GROUND: bool = false;

// Where the clouds' shadows fall.
struct CloudFrame {
    // The observer's place in the scene.
    place_m: vec3f,
    // Of no meaning here.
    // The light that casts them.
    light: vec3f,
}

struct Answer {
    radiance: vec3f,
    // Negative where the sky is seen.
    distance_m: f32,
    transmittance: vec3f,
}

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(1) var<uniform> view: View;
@group(0) @binding(2) var<uniform> observer: Observer;
@group(0) @binding(3) var transmittance_table: texture_2d<f32>;
@group(0) @binding(4) var linear_clamp: sampler;
@group(0) @binding(5) var irradiance_table: texture_2d<f32>;
@group(0) @binding(6) var source_table: texture_2d_array<f32>;
// World direction; w is 1 where the discs of sun and moon count.
@group(0) @binding(7) var<storage, read> directions: array<vec4f>;
@group(0) @binding(8) var<storage, read_write> answers: array<Answer>;
@group(0) @binding(9) var<uniform> glow: Airglow;
@group(0) @binding(10) var<uniform> moon: Moon;
// The moon in the sun's place.
@group(0) @binding(11) var<uniform> moon_view: View;
@group(0) @binding(12) var<uniform> moon_observer: Observer;
@group(0) @binding(13) var moon_face: texture_2d<f32>;
// What clouds add in R, G and B, and what they let through; one a direction.
@group(0) @binding(14) var<storage, read> clouds_seen: array<vec4f>;
@group(0) @binding(15) var<uniform> shade: CloudShade;
@group(0) @binding(16) var shade_maps: texture_2d_array<f32>;
@group(0) @binding(17) var<uniform> cloud_frame: CloudFrame;
// Of each direction: radiance and distance of what stands on the ground; or what the sky loses to shafts, and -1.
@group(0) @binding(18) var<storage, read> lit_ground: array<vec4f>;
// `LostInAir`.
@group(0) @binding(19) var cloud_air_table: texture_2d_array<f32>;

// A ray that nothing stops.
const ENDLESS_M = 1e12;

fn discs(direction: vec3f) -> vec3f {
    let sun = sun_disc(view, direction);
    if !MOON {
        return sun;
    }
    let hidden = angle_between(direction, moon.direction) < moon.angular_radius;
    var both = select(moon.sun_disc_scale, 0.0, hidden) * sun;
    if moon.disc == 1.0 && hidden {
        both += moon_radiance(moon, moon_face, linear_clamp, place_on_moon(moon, moon.angular_radius, direction));
    }
    return both;
}

@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&directions) {
        return;
    }
    let direction = directions[id.x].xyz;
    let mu = clamp(dot(direction, view.up), -1.0, 1.0);
    let nu = clamp(dot(direction, view.sun), -1.0, 1.0);
    var ground_m = distance_to_sphere(air.radius_m, view.altitude_m, mu);
    var before = vec4f(0.0, 0.0, 0.0, -1.0);
    if GROUND {
        before = lit_ground[id.x];
        ground_m = select(ground_m, before.w, before.w >= 0.0);
    }
    let ground = ground_m >= 0.0;
    let entry = enter_air(air, observer, mu, nu, ground, ground_m);
    var light: Scattered;
    if entry.length_m > 0.0 {
        light = scatter_along(air, entry, transmittance_table, source_table, linear_clamp, March(true, MULTIPLE, HAZE, NESTED, observer.steps, 4u, observer.sun_steps));
    }
    let transmittance = exp(-light.optical_depth);
    var once = scattered_radiance(air, view, Scattered(light.rayleigh, light.mie, vec3f(0.0), light.optical_depth), nu);
    var between = scattered_radiance(air, view, light, nu)
        + airglow_radiance(glow, air.radius_m, view.altitude_m, mu, select(ENDLESS_M, ground_m, ground), light.optical_depth);
    var behind = directions[id.x].w * discs(direction);
    var shaded = UNSHADED;
    if CLOUDS && ground {
        let p = cloud_frame.place_m + ground_m * direction;
        let mu_light = dot(normalize(p + vec3f(0.0, 0.0, air.radius_m)), cloud_frame.light);
        shaded = ground_shaded(shade, shade_maps, linear_clamp, air.radius_m, p, cloud_frame.light, mu_light);
    }
    if ground {
        behind = ground_radiance(air, view, nu, ground_m, transmittance_table, irradiance_table, linear_clamp, shaded)
            + air.ground_albedo / PI * glow.ground_irradiance;
    }
    if MOONLIGHT {
        let nu_moon = clamp(dot(direction, moon_view.sun), -1.0, 1.0);
        let moonlit = enter_air(air, moon_observer, mu, nu_moon, ground, ground_m);
        if moonlit.length_m > 0.0 {
            let march = March(true, MULTIPLE, HAZE, NESTED, observer.steps, 4u, observer.sun_steps);
            let scattered = scatter_along(air, moonlit, transmittance_table, source_table, linear_clamp, march);
            let moonlight = scattered_radiance(air, moon_view, scattered, nu_moon);
            between += moonlight;
            once += moonlight;
        }
        if ground {
            behind += ground_radiance(air, moon_view, nu_moon, ground_m, transmittance_table, irradiance_table, linear_clamp, shaded);
        }
    }
    if CLOUD_AIR {
        let air_from_m = distance_to_air(air.radius_m, air.top_m, view.altitude_m, mu);
        let in_air = lost_in_air(cloud_air_table, linear_clamp, direction, view.up, edge_cosine(air.radius_m, view.altitude_m));
        // Down to the ground ways differ by more than the table knows.
        between -= select(in_air.light, lost_before(in_air, once, ground_m - air_from_m), ground);
    }
    var radiance = between + transmittance * behind;
    if GROUND {
        radiance = select(max(radiance - before.rgb, vec3f(0.0)), before.rgb, before.w >= 0.0);
    }
    var left = 1.0;
    if CLOUDS {
        let clouds = clouds_seen[id.x];
        left = clouds.a;
        radiance = max(left * radiance + clouds.rgb, vec3f(0.0));
    }
    answers[id.x] = Answer(radiance, ground_m, left * transmittance);
}
