// Shadows of clouds: for each band and sheet a map of its optical depth along the light, by where the light crosses the
// band's middle. Two layers a map hold the depth from the band's top down to eight heights, the last of them the base,
// where it is the whole.
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
    // Optical depth of all of them towards the light, on average.
    even_depth: f32,
    // Share of the light that on average leaves them below, scattered.
    spread_left: f32,
}

// Texels stand closer by the square towards the centre.
fn shade_coordinate(shade: CloudShade, along_m: vec2f) -> vec2f {
    let d = (along_m - shade.centre_m) / shade.reach_m;
    return 0.5 + 0.5 * sign(d) * sqrt(min(abs(d), vec2f(1.0)));
}

// 1 where the maps do not reach: what is there has the mean of all clouds, or the maps' edges would stand as stripes.
fn beyond_maps(shade: CloudShade, along_m: vec2f) -> f32 {
    let d = abs(along_m - shade.centre_m) / shade.reach_m;
    return smoothstep(0.8, 1.0, max(d.x, d.y));
}

fn shade_place(shade: CloudShade, coordinate: vec2f) -> vec2f {
    let u = 2.0 * coordinate - 1.0;
    return shade.centre_m + shade.reach_m * u * abs(u);
}

// Shares of a band's thickness above the eight heights, which stand closer near top and base, where clouds begin: 2x² and
// 1 - 2 (1 - x)² at eighths.
const UPPER_SHARES = vec4f(0.03125, 0.125, 0.28125, 0.5);
const LOWER_SHARES = vec4f(0.71875, 0.875, 0.96875, 1.0);

// Maps are blurred by their texels, and light that is scattered often goes about as 1/(1 + τ/3): so it is this that they
// hold, or a bright rim beside a dark core would be drowned.
fn depth_to_map(depth: vec4f) -> vec4f {
    return 1.0 / (1.0 + depth / 3.0);
}

fn depth_from_map(value: vec4f) -> vec4f {
    return 3.0 / value - 3.0;
}

// No light runs lower than this through a band: beyond, it would be in there for ever.
const LEAST_COSINE = 0.03;

fn light_cosine(mu: f32) -> f32 {
    return select(-1.0, 1.0, mu >= 0.0) * max(abs(mu), LEAST_COSINE);
}

// Optical depth of a band between a place in it and the light, and beyond the place.
struct LightDepth {
    before: f32,
    behind: f32,
}

// Along the light's way through a band: its optical depth from the top down to eight heights.
struct LightColumn {
    upper: vec4f,
    lower: vec4f,
}

// The way that crosses p.
fn light_column(
    shade: CloudShade,
    maps: texture_2d_array<f32>,
    linear_clamp: sampler,
    index: u32,
    middle_m: f32,
    radius_m: f32,
    p: vec3f,
    altitude_m: f32,
    light: vec3f,
    mu: f32,
) -> LightColumn {
    let q = p + (middle_m - altitude_m) / light_cosine(mu) * light;
    let at = shade_coordinate(shade, along_sphere(radius_m, q, middle_m));
    let upper = depth_from_map(textureSampleLevel(maps, linear_clamp, at, 2u * index, 0.0));
    let lower = depth_from_map(textureSampleLevel(maps, linear_clamp, at, 2u * index + 1u, 0.0));
    return LightColumn(upper, lower);
}

// Its optical depth down to a share of the band's thickness.
fn depth_over(column: LightColumn, share: f32) -> f32 {
    // The rise from each height to the next counts by how much of it lies above.
    let upper_before = vec4f(0.0, UPPER_SHARES.xyz);
    let lower_before = vec4f(UPPER_SHARES.w, LOWER_SHARES.xyz);
    let u = clamp((share - upper_before) / (UPPER_SHARES - upper_before), vec4f(0.0), vec4f(1.0));
    let l = clamp((share - lower_before) / (LOWER_SHARES - lower_before), vec4f(0.0), vec4f(1.0));
    return dot(u, column.upper - vec4f(0.0, column.upper.xyz)) + dot(l, column.lower - vec4f(column.upper.w, column.lower.xyz));
}

// Of a band, what lies before a share of its thickness from above, towards the light, and what lies behind another.
fn depths_beyond(column: LightColumn, share_before: f32, share_behind: f32, mu: f32) -> LightDepth {
    let over = vec2f(depth_over(column, share_before), depth_over(column, share_behind));
    let under = column.lower.w - over;
    // Light that runs level in a place comes from above on the near side and from below on the far one: the sphere falls
    // away, by a band's thickness or so where it runs at the least cosine.
    let from_above = smoothstep(-LEAST_COSINE, LEAST_COSINE, mu);
    return LightDepth(mix(under.x, over.x, from_above), mix(over.y, under.y, from_above));
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
        if middle_m > altitude_m {
            let way_m = distance_to_top(radius_m, middle_m, altitude_m, mu);
            let along_m = along_sphere(radius_m, p + way_m * light, middle_m);
            let at = shade_coordinate(shade, along_m);
            let depth = depth_from_map(textureSampleLevel(maps, linear_clamp, at, 2u * i + 1u, 0.0)).a;
            sum += mix(depth, shade.even_depth / f32(shade.count), beyond_maps(shade, along_m));
        }
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
