// What is seen in one direction: the light in the air, the ground, the discs of sun and moon. Clouds stand before it.
import package::lib::airglow::{Airglow, airglow_radiance};
import package::lib::air::Air;
import package::lib::camera::{Camera, sight_at};
import package::lib::geometry::{
    PI, angle_if_near, angle_of_cosine, distance_to_air, distance_to_sphere, edge_cosine, edge_zenith_angle, horizon_distance_squared,
};
import package::lib::phase::{cornette_shanks_phase, rayleigh_phase};
import package::lib::cloud_air::{LostInAir, lost_before, lost_in_air, scattered_under_clouds};
import package::lib::cloud_shade::{CloudShade, ground_shaded};
import package::lib::light::{UNSHADED, View, disc_radiance, ground_radiance, scattered_radiance};
import package::lib::moon::{Moon, corona, moon_radiance, place_on_moon};
import package::lib::scattering::{March, Scattered, scatter_along};
import package::lib::source::cosine_of_azimuth;
import package::lib::tables::{SkyViewRay, light_from_table, sky_view_coordinate, least_zenith_angle};
import package::lib::view_ray::{Observer, enter_air};

// 0: light in the air from the sky-view table; 1: integrated along each pixel's ray, 2: with the optical depth to the
// sun integrated in every step of it.
override METHOD: u32 = 0u;
// False for the first order alone.
override MULTIPLE: bool = true;
// True where there is haze.
override HAZE: bool = true;

// As `sight_at` numbers it.
override PROJECTION: u32 = 0u;

// Further variants, so that a scene pays for what it has: a moon whose disc is shown or hides the sun's, and one that
// lights air and ground as well.
override AIRGLOW: bool = true;
override MOON: bool = false;
override MOONLIGHT: bool = false;
// True where there are clouds, and where no shafts tell what the air loses to them.
override CLOUDS: bool = false;
override CLOUD_AIR: bool = false;

// What the ground's shadows need to know of the clouds.
struct CloudFrame {
    // The observer's place in the scene.
    place_m: vec3f,
    // The light that casts their shadows.
    light: vec3f,
}

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(1) var<uniform> view: View;
@group(0) @binding(2) var<uniform> camera: Camera;
@group(0) @binding(4) var<uniform> observer: Observer;
@group(0) @binding(5) var transmittance_table: texture_2d<f32>;
@group(0) @binding(6) var linear_clamp: sampler;
@group(0) @binding(7) var irradiance_table: texture_2d<f32>;
// Whichever of the two the method reads.
@group(0) @binding(8) var sky_view_table: texture_2d_array<f32>;
@group(0) @binding(9) var source_table: texture_2d_array<f32>;
@group(0) @binding(11) var<uniform> glow: Airglow;
@group(0) @binding(12) var<uniform> moon: Moon;
// The moon in the sun's place, and its light in the air.
@group(0) @binding(13) var<uniform> moon_view: View;
@group(0) @binding(14) var moon_sky_view_table: texture_2d_array<f32>;
@group(0) @binding(15) var moon_face: texture_2d<f32>;
@group(0) @binding(20) var<uniform> shade: CloudShade;
@group(0) @binding(21) var shade_maps: texture_2d_array<f32>;
@group(0) @binding(22) var<uniform> cloud_frame: CloudFrame;
// `LostInAir`.
@group(0) @binding(30) var cloud_air_table: texture_2d_array<f32>;

fn light_in_air(ray: SkyViewRay, mu: f32, nu: f32) -> Scattered {
    if METHOD != 0u {
        var light: Scattered;
        let entry = enter_air(air, observer, mu, nu, ray.ground, ray.distance_m);
        if entry.length_m > 0.0 {
            let march = March(true, MULTIPLE, HAZE, METHOD == 2u, observer.steps, 6u, observer.sun_steps);
            light = scatter_along(air, entry, transmittance_table, source_table, linear_clamp, march);
        }
        return light;
    }
    return light_in_table(sky_view_table, ray);
}

fn light_in_table(table: texture_2d_array<f32>, ray: SkyViewRay) -> Scattered {
    let at = sky_view_coordinate(air.radius_m, air.top_m, view.altitude_m, ray, textureDimensions(table));
    let rayleigh = textureSampleLevel(table, linear_clamp, at, 0, 0.0);
    let mie = textureSampleLevel(table, linear_clamp, at, 1, 0.0);
    let multiple = textureSampleLevel(table, linear_clamp, at, 2, 0.0);
    let depth = vec3f(rayleigh.a, mie.a, multiple.a);
    return Scattered(light_from_table(rayleigh.rgb), light_from_table(mie.rgb), light_from_table(multiple.rgb), depth);
}

// Places along each side of a pixel at which the disc is looked at.
const DISC_PLACES = 12;

// Mean radiance of the sun's disc over a pixel, so that a frame holds the sun's irradiance however large its pixels
// are. A disc that is smaller than a pixel is drawn as large as a pixel and as much fainter.
fn disc_in_pixel(place: vec2f, direction: vec3f) -> vec3f {
    let angle = angle_if_near(direction, view.sun);
    // Nowhere in any projection is a pixel far larger than at the centre.
    if view.disc == 0.0 || view.sun_angular_radius <= 0.0 || angle > view.sun_angular_radius + 4.0 * camera.pixel_angle {
        return vec3f(0.0);
    }
    // From the centre to the corners; not quite, since a cubemap's next face begins there.
    let falling = angle_if_near(direction, sight_at(camera, PROJECTION, place + vec2f(0.49, 0.49)).direction);
    let rising = angle_if_near(direction, sight_at(camera, PROJECTION, place + vec2f(0.49, -0.49)).direction);
    let reach = max(falling, rising);
    let alpha = max(view.sun_angular_radius, reach);
    if angle + 3.0 * reach < alpha && !(MOON && moon.sun_left < 1.0) {
        return disc_radiance(view, alpha, angle);
    }
    var sum = vec3f(0.0);
    for (var i = 0; i < DISC_PLACES * DISC_PLACES; i++) {
        let at = (vec2f(f32(i % DISC_PLACES), f32(i / DISC_PLACES)) + 0.5) / f32(DISC_PLACES) - 0.5;
        let towards = sight_at(camera, PROJECTION, place + at).direction;
        let hidden = MOON && alpha == view.sun_angular_radius && angle_if_near(towards, moon.direction) < moon.angular_radius;
        sum += select(1.0, 0.0, hidden) * disc_radiance(view, alpha, angle_if_near(towards, view.sun));
    }
    // Drawn larger than it is, the sun loses by its share.
    let left = select(1.0, moon.sun_left, MOON && alpha > view.sun_angular_radius);
    return left * sum / f32(DISC_PLACES * DISC_PLACES);
}

// Most places along each side of a pixel at which the moon is looked at, and places across its disc that show all of
// its face.
const MOON_PLACES = 48.0;
const FACE_PLACES = 500.0;

// Mean radiance of the moon's disc over a pixel, as that of the sun's.
fn moon_in_pixel(place: vec2f, direction: vec3f) -> vec3f {
    let angle = angle_if_near(direction, moon.direction);
    if moon.disc == 0.0 || moon.angular_radius <= 0.0 || angle > moon.angular_radius + 4.0 * camera.pixel_angle {
        return vec3f(0.0);
    }
    let falling = angle_if_near(direction, sight_at(camera, PROJECTION, place + vec2f(0.49, 0.49)).direction);
    let rising = angle_if_near(direction, sight_at(camera, PROJECTION, place + vec2f(0.49, -0.49)).direction);
    let reach = max(falling, rising);
    let alpha = max(moon.angular_radius, reach);
    let fainter = sin(0.5 * moon.angular_radius) / sin(0.5 * alpha);
    let places = i32(clamp(ceil(FACE_PLACES * reach / alpha), 2.0, MOON_PLACES));
    var sum = vec3f(0.0);
    for (var i = 0; i < places * places; i++) {
        // A lattice of irrational steps (Roberts 2018) falls on no line of the crescent.
        let at = fract(0.5 + f32(i) * vec2f(0.7548777, 0.5698403)) - 0.5;
        let towards = sight_at(camera, PROJECTION, place + at).direction;
        sum += moon_radiance(moon, moon_face, linear_clamp, place_on_moon(moon, alpha, towards));
    }
    return fainter * fainter * sum / f32(places * places);
}

// The corona about the moon, once the rest of the sun no longer outshines it.
fn corona_towards(direction: vec3f) -> vec3f {
    let hidden = angle_if_near(direction, moon.direction) < moon.angular_radius;
    if view.disc == 0.0 || view.sun_angular_radius <= 0.0 || moon.sun_left > 0.01 || hidden {
        return vec3f(0.0);
    }
    return (1.0 - moon.sun_left / 0.01) * corona(view.sun_irradiance, view.sun_angular_radius, angle_if_near(direction, view.sun));
}

// Angle along the horizon between a direction and a light, of cosines with the zenith and with each other. At the zenith
// there is no azimuth and any will do.
fn azimuth_from(light: View, mu: f32, nu: f32) -> f32 {
    return angle_of_cosine(cosine_of_azimuth(mu, light.mu_s, nu));
}

// Radiance that the air scatters of the moon's light.
fn moonlight_in_air(direction: vec3f, mu: f32, zenith_angle: f32, ground: bool, distance_m: f32) -> vec3f {
    let azimuth = azimuth_from(moon_view, mu, clamp(dot(direction, moon_view.sun), -1.0, 1.0));
    let light = light_in_table(moon_sky_view_table, SkyViewRay(azimuth, zenith_angle, ground, distance_m));
    return scattered_radiance(air, moon_view, light, clamp(dot(direction, moon_view.sun), -1.0, 1.0));
}

// A ray that nothing stops.
const ENDLESS_M = 1e12;

// What is between the observer and the discs, in one direction.
struct Light {
    // Times the Rayleigh phase function.
    rayleigh: vec3f,
    // Times the Mie phase function.
    mie: vec3f,
    // No phase function.
    even: vec3f,
    // Transmittance to the discs, none where the ground hides them.
    left: vec3f,
}

// Share of a pixel that is above the horizon.
fn share_above(zenith_angle: f32) -> f32 {
    return clamp(0.5 + (edge_zenith_angle(air.radius_m, view.altitude_m) - zenith_angle) / camera.pixel_angle, 0.0, 1.0);
}

fn light_towards(direction: vec3f, mu: f32, nu: f32) -> Light {
    let zenith_angle = angle_of_cosine(mu);
    let azimuth = azimuth_from(view, mu, nu);
    let horizon = edge_zenith_angle(air.radius_m, view.altitude_m);
    // For an even edge.
    let above = share_above(zenith_angle);
    let met_m = distance_to_sphere(air.radius_m, view.altitude_m, mu);
    let edge_m = sqrt(horizon_distance_squared(air.radius_m, view.altitude_m));
    var in_air: LostInAir;
    var air_from_m = 0.0;
    if CLOUD_AIR {
        in_air = lost_in_air(cloud_air_table, linear_clamp, direction, view.up, edge_cosine(air.radius_m, view.altitude_m));
        air_from_m = distance_to_air(air.radius_m, air.top_m, view.altitude_m, mu);
    }
    // One side of the horizon, and where the pixel lies on it the other as well: a loop, since a software device runs
    // both sides of a branch.
    var sum: Light;
    for (var side = 0u; side < select(1u, 2u, above > 0.0 && above < 1.0); side++) {
        let ground = (above < 0.5) != (side == 1u);
        let share = select(above, 1.0 - above, ground);
        // A ray that belongs to the other side is turned to the horizon.
        let turned = ground != (met_m >= 0.0);
        let ray_mu = select(mu, edge_cosine(air.radius_m, view.altitude_m), turned);
        let ray_angle = select(min(zenith_angle, horizon), zenith_angle, ground);
        let distance_m = select(select(met_m, edge_m, turned), ENDLESS_M, !ground);
        var light: Scattered;
        var even = vec3f(0.0);
        if ground || ray_angle >= least_zenith_angle(air.radius_m, air.top_m, view.altitude_m) {
            light = light_in_air(SkyViewRay(azimuth, ray_angle, ground, distance_m), ray_mu, nu);
            even = view.sun_irradiance * light.multiple;
            var once = single_of(light.rayleigh, light.mie, nu);
            if MOONLIGHT {
                let moonlight = moonlight_in_air(direction, mu, ray_angle, ground, distance_m);
                even += moonlight;
                once += moonlight;
            }
            if CLOUD_AIR {
                // Down to the ground ways differ by more than the table knows.
                even -= select(in_air.light, lost_before(in_air, once, distance_m - air_from_m), ground);
            }
        }
        let left = exp(-light.optical_depth);
        if ground {
            var shaded = UNSHADED;
            if CLOUDS {
                let p = cloud_frame.place_m + distance_m * direction;
                let mu_light = dot(normalize(p + vec3f(0.0, 0.0, air.radius_m)), cloud_frame.light);
                shaded = ground_shaded(shade, shade_maps, linear_clamp, air.radius_m, p, cloud_frame.light, mu_light);
            }
            var behind = ground_radiance(air, view, nu, distance_m, transmittance_table, irradiance_table, linear_clamp, shaded);
            if AIRGLOW {
                behind += air.ground_albedo / PI * glow.ground_irradiance;
            }
            if MOONLIGHT {
                let nu_moon = clamp(dot(direction, moon_view.sun), -1.0, 1.0);
                behind += ground_radiance(air, moon_view, nu_moon, distance_m, transmittance_table, irradiance_table, linear_clamp, shaded);
            }
            even += left * behind;
        }
        if AIRGLOW {
            even += airglow_radiance(glow, air.radius_m, view.altitude_m, mu, distance_m, light.optical_depth);
        }
        sum.rayleigh += share * light.rayleigh;
        sum.mie += share * light.mie;
        sum.even += share * even;
        sum.left += select(share, 0.0, ground) * left;
    }
    return sum;
}

fn single_of(rayleigh: vec3f, mie: vec3f, nu: f32) -> vec3f {
    return view.sun_irradiance * (rayleigh_phase(nu) * rayleigh + cornette_shanks_phase(nu, air.mie_asymmetry) * mie);
}

fn radiance_of(light: Light, nu: f32, disc: vec3f) -> vec3f {
    return single_of(light.rayleigh, light.mie, nu) + light.even + light.left * disc;
}

// What clouds add to the light of the air under them, up to the ground, or take from it, but for what it loses to shadows. Whoever
// has clouds before the ground has it with them.
fn changed_under_clouds(direction: vec3f, mu: f32, nu: f32) -> vec3f {
    let met_m = distance_to_sphere(air.radius_m, view.altitude_m, mu);
    let ray = SkyViewRay(azimuth_from(view, mu, nu), angle_of_cosine(mu), true, met_m);
    let light = light_in_air(ray, mu, nu);
    let gained = scattered_under_clouds(air, view, shade, transmittance_table, linear_clamp, exp(-light.optical_depth));
    return gained - (1.0 - shade.diffuse_left) * view.sun_irradiance * light.multiple;
}
