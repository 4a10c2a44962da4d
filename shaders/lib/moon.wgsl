// The moon's disc.
import package::lib::geometry::{PI, angle_between};

struct Moon {
    // Towards it.
    direction: vec3f,
    angular_radius: f32,
    // Across the line of sight, selenographic east (right as seen from the northern hemisphere) and north.
    east: vec3f,
    // 1 where the disc is shown.
    disc: f32,
    north: vec3f,
    // Share of the sun's disc that the moon leaves.
    sun_left: f32,
    // Towards the sun along the axes: to the observer, east, north.
    light: vec3f,
    // What to multiply the sun's light in the sky by to have that of its disc.
    sun_disc_scale: f32,
    // Multiplies the face and 2 mu0 / (mu0 + mu).
    radiance: vec3f,
    // Multiplies the face: light of the Earth.
    earthshine: vec3f,
    // 1 where the lens' glare is about the moon rather than the sun.
    glares: f32,
}

// Place on a disc of angular radius α, east and north in radii. With |p| = sin(γ/2) / sin(α/2) equal areas are equal
// solid angles, so that the disc's light does not depend on its size.
fn place_on_moon(moon: Moon, alpha: f32, direction: vec3f) -> vec2f {
    let angle = angle_between(direction, moon.direction);
    let across = vec2f(dot(direction, moon.east), dot(direction, moon.north));
    return across / (2.0 * cos(0.5 * angle) * sin(0.5 * alpha));
}

// Radiance at a place on the disc. The lit side scatters by Lommel and Seeliger's law, mu0 / (mu0 + mu): the full moon is
// as bright at its limb as in its middle. The dark side is lit from where it is seen, which makes that law constant.
fn moon_radiance(moon: Moon, face: texture_2d<f32>, linear_clamp: sampler, place: vec2f) -> vec3f {
    let off = dot(place, place);
    if off >= 1.0 {
        return vec3f(0.0);
    }
    let at = vec3f(sqrt(1.0 - off), place);
    let mu0 = dot(at, moon.light);
    let lit = select(0.0, 2.0 * mu0 / (mu0 + at.x), mu0 > 0.0);
    let albedo = textureSampleLevel(face, linear_clamp, vec2f(0.5, 0.5) + vec2f(0.5, -0.5) * place, 0.0).rgb;
    return albedo * (lit * moon.radiance + moon.earthshine);
}

// The sun's corona over the mean radiance of its disc, r in solar radii from its centre: 1e-6 (0.0532 r^-2.5 + 1.425 r^-7 +
// 2.565 r^-17) (Baumbach 1937). It takes a total eclipse to see it.
fn corona(sun_irradiance: vec3f, sun_angular_radius: f32, angle: f32) -> vec3f {
    let r = max(angle / sun_angular_radius, 1.0);
    let share = 1e-6 * (0.0532 * pow(r, -2.5) + 1.425 * pow(r, -7.0) + 2.565 * pow(r, -17.0));
    return share * sun_irradiance / (PI * sun_angular_radius * sun_angular_radius);
}
