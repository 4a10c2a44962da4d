// Shadows of clouds: for each band and sheet a map of its optical depth towards the light, by where the way to the light
// crosses the band's middle.
import package::lib::geometry::{along_sphere, distance_to_top};
import package::lib::light::Shaded;

struct CloudShade {
    // Altitudes of the middles, four to a vector, from below.
    middles_m: array<vec4f, 4>,
    // The place on the sphere at the maps' centre.
    centre_m: vec2f,
    // Half a map's side.
    reach_m: f32,
    count: u32,
    // Share of the light, straight from its source and after scattering, that on average comes through all of them.
    direct_left: f32,
    diffuse_left: f32,
    // Mean cosine of the clouds' phase function.
    asymmetry: f32,
    // Altitude of the lowest base.
    base_m: f32,
}

// Texels stand closer by the square towards the centre.
fn shade_coordinate(shade: CloudShade, along_m: vec2f) -> vec2f {
    let d = (along_m - shade.centre_m) / shade.reach_m;
    return 0.5 + 0.5 * sign(d) * sqrt(min(abs(d), vec2f(1.0)));
}

fn shade_place(shade: CloudShade, coordinate: vec2f) -> vec2f {
    let u = 2.0 * coordinate - 1.0;
    return shade.centre_m + shade.reach_m * u * abs(u);
}

// Optical depth towards the light of all bands over a place. `mu` is the light's cosine with the zenith there.
fn shade_depth(
    shade: CloudShade,
    maps: texture_2d_array<f32>,
    linear_clamp: sampler,
    radius_m: f32,
    p: vec3f,
    altitude_m: f32,
    light: vec3f,
    mu: f32,
) -> f32 {
    var sum = 0.0;
    for (var i = 0u; i < shade.count; i++) {
        let middle_m = shade.middles_m[i / 4u][i % 4u];
        let over = max(middle_m - altitude_m, 0.0);
        let way_m = distance_to_top(radius_m, middle_m, min(altitude_m, middle_m), mu);
        let at = shade_coordinate(shade, along_sphere(radius_m, p + way_m * light, middle_m));
        let depth = textureSampleLevel(maps, linear_clamp, at, i, 0.0).r;
        sum += select(0.0, depth, over > 0.0);
    }
    return sum;
}

// Of light on a slab's top, at a cosine, the share that leaves below, straight or scattered; both on a level plane. The
// diffusion limit with Eddington's closure and Marshak's boundaries, as in `lib/cloud_light.wgsl`.
fn slab_transmission(asymmetry: f32, cosine: f32, optical_depth: f32) -> f32 {
    let whole = (1.0 - asymmetry) * optical_depth;
    let mu = max(cosine, 0.02);
    return (2.0 + 3.0 * mu + (2.0 - 3.0 * mu) * exp(-whole / mu)) / (4.0 + 3.0 * whole);
}

// What clouds leave of the light on the ground at p.
fn ground_shaded(
    shade: CloudShade,
    maps: texture_2d_array<f32>,
    linear_clamp: sampler,
    radius_m: f32,
    p: vec3f,
    light: vec3f,
    mu: f32,
) -> Shaded {
    let depth = shade_depth(shade, maps, linear_clamp, radius_m, p, 0.0, light, mu);
    let cosine = max(mu, 0.03);
    return Shaded(slab_transmission(shade.asymmetry, cosine, depth * cosine), shade.diffuse_left);
}

// From the table of a tile's clouds, which has a margin of one texel, at a place in the tile, in pixels; `fineness` is
// texels to a pixel. Weighed here and not by a sampler, whose rounding would show where tiles meet.
fn clouds_before(table: texture_2d<f32>, place: vec2f, fineness: f32) -> vec4f {
    let at = 0.5 + place * fineness;
    let first = vec2u(at);
    let part = fract(at);
    let last = textureDimensions(table) - 1u;
    let low = min(first, last);
    let high = min(first + 1u, last);
    let top = mix(textureLoad(table, low, 0), textureLoad(table, vec2u(high.x, low.y), 0), part.x);
    let bottom = mix(textureLoad(table, vec2u(low.x, high.y), 0), textureLoad(table, high, 0), part.x);
    return mix(top, bottom, part.y);
}
