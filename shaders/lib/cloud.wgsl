// Where there is cloud, and how dense: weather, height profile and noise (Schneider 2015, 2017). Whoever imports from here
// binds these first.
import package::lib::cloud_far::{BILLOWS, BLURRED, CLUMP, clumped_extinction, clumps_between};
import package::lib::geometry::along_sphere;

// A layer of cloud with a thickness.
struct CloudLayer {
    @align(16) base_m: f32,
    inverse_thickness_per_m: f32,
    // Of weather; negative where the map decides.
    cloud_type: f32,
    // As the threshold of an evenly spread map takes it, and as it was asked for.
    coverage: f32,
    share: f32,
    extinction_per_m: f32,
    anvil: f32,
}

// Layers that overlap are marched through as one; bands do not touch.
struct CloudBand {
    @align(16) base_m: f32,
    top_m: f32,
    first: u32,
    count: u32,
    // Of the thinnest layer.
    thickness_m: f32,
    // 0 for a deck, 1 for heaps that lose light at their sides.
    leak: f32,
}

// A layer that is thin against all distances.
struct CloudSheet {
    // Rotates and scales the way along the sphere, so that the wind blows along x.
    turn: vec2f,
    drift: vec2f,
    height_m: f32,
    coverage: f32,
    // Vertical, where it is densest.
    optical_depth: f32,
    // 0 cirrus, 1 cells, 2 veil.
    channel: u32,
}

// Where weather comes from.
struct WeatherSource {
    // Coverage, type and rain of weather that is the same everywhere.
    even: vec3f,
    // 0 the same everywhere; 1 coverage, type, rain; 2 low, high, height, density.
    convention: u32,
    drift: vec2f,
    second_drift: vec2f,
    inverse_extent_per_m: f32,
    // 1 to look twice, so that no tile is seen.
    twice: f32,
}

struct Clouds {
    layers: array<CloudLayer, 8>,
    bands: array<CloudBand, 8>,
    sheets: array<CloudSheet, 8>,
    weather: array<WeatherSource, 2>,
    gradients: array<vec4f, 3>,
    // The observer's place in the scene.
    place_m: vec3f,
    radius_m: f32,
    base_drift: vec3f,
    base_inverse_scale_per_m: f32,
    detail_drift: vec3f,
    detail_inverse_scale_per_m: f32,
    // How far a layer's top is ahead of its base.
    shear_m: vec2f,
    curl_inverse_scale_per_m: f32,
    curl_m: f32,
    layer_count: u32,
    band_count: u32,
    sheet_count: u32,
    // Of the second weather source.
    weather_share: f32,
    low_least: f32,
    low_inverse_range: f32,
    erosion: f32,
    precipitation: f32,
    // Steps to a layer, over 128.
    fineness: f32,
    // Single scattering albedo times the cloud's own colour.
    albedo: vec3f,
    // Mean cosine of the phase function.
    asymmetry: f32,
    sun_colour: vec3f,
    // Of the phase function: the forward lobe, the other lobe, and its share.
    forward: f32,
    other: f32,
    other_share: f32,
    // Draine's α of the other lobe; 0 for that of Henyey and Greenstein.
    alpha: f32,
    sun_factor: f32,
    ambient_factor: f32,
    powder: f32,
    octaves: u32,
    light_steps: u32,
    haze: f32,
}

@group(0) @binding(0) var<uniform> clouds: Clouds;
@group(0) @binding(1) var linear_repeat: sampler;
@group(0) @binding(2) var shape_volume: texture_3d<f32>;
@group(0) @binding(3) var first_weather: texture_2d<f32>;
@group(0) @binding(4) var second_weather: texture_2d<f32>;
@group(0) @binding(5) var detail_volume: texture_3d<f32>;
@group(0) @binding(6) var curl_texture: texture_2d<f32>;
@group(0) @binding(7) var sheet_texture: texture_2d<f32>;

// True where all of the clouds are one layer: then no device looks up which, and that is a fifth of the work of some.
override ONE_LAYER: bool = false;

fn band_at(index: u32) -> CloudBand {
    if ONE_LAYER {
        return clouds.bands[0];
    }
    return clouds.bands[index];
}

fn layer_at(index: u32) -> CloudLayer {
    if ONE_LAYER {
        return clouds.layers[0];
    }
    return clouds.layers[index];
}

fn one_or(count: u32) -> u32 {
    if ONE_LAYER {
        return 1u;
    }
    return count;
}

// Of all bands and sheets; each stand in the order of their heights.
fn lowest_cloud_m() -> f32 {
    let band_m = select(1e9, clouds.bands[0].base_m, clouds.band_count > 0u);
    return min(band_m, select(1e9, clouds.sheets[0].height_m, clouds.sheet_count > 0u));
}

struct Weather {
    coverage: f32,
    cloud_type: f32,
    rain: f32,
    // The clouds' greatest height as a share of the layer.
    height: f32,
    // Of S0 and S2: counts as the clouds' coverage rises beyond a half.
    high: f32,
    // 1 where coverage is spread evenly over 0 to 1, so that a threshold cuts off a known share.
    spread: f32,
}

// The second look at the map is turned and larger, by factors without a common measure.
const SECOND_LOOK = mat2x2f(0.2867, 0.1513, -0.1513, 0.2867);
const SECOND_WEIGHT = 0.35;
const SYSTEMS = mat2x2f(0.0331, -0.0207, 0.0207, 0.0331);

// P(a + k b < v) of a and b that are even over 0..1: the sum of both looks is spread evenly again.
fn share_below(v: vec3f) -> vec3f {
    let k = SECOND_WEIGHT;
    let left = 1.0 + k - v;
    return select(select(1.0 - left * left / (2.0 * k), v - 0.5 * k, v < vec3f(1.0)), v * v / (2.0 * k), v < vec3f(k));
}

fn weather_of(source: WeatherSource, map: texture_2d<f32>, along_m: vec2f) -> Weather {
    if source.convention == 0u {
        return Weather(source.even.x, source.even.y, source.even.z, 1.0, 0.0, 0.0);
    }
    let place = along_m * source.inverse_extent_per_m;
    // Pictures have north up and the scene's origin in the middle.
    let at = select(place, vec2f(place.x, -place.y) + 0.5, source.twice == 0.0);
    let first = textureSampleLevel(map, linear_repeat, at - source.drift, 0.0);
    if source.convention == 2u {
        return Weather(first.r, 0.5 + 0.5 * first.a, 0.0, max(first.b, 0.05), first.g, 0.0);
    }
    var seen = first.rgb;
    // Branches, here and below: a software device skips what no lane of a group takes, and runs loops of no round once.
    if source.twice > 0.0 {
        let second = textureSampleLevel(map, linear_repeat, SECOND_LOOK * at - source.second_drift, 0.0).rgb;
        seen = share_below(first.rgb + SECOND_WEIGHT * second);
        // Far from the scene, where only a flight or an orbit leads, weather systems gather what is even about it.
        let far = smoothstep(1e5, 6e5, length(along_m));
        if far > 0.0 {
            let system = textureSampleLevel(map, linear_repeat, SYSTEMS * at, 0.0).rgb;
            seen = mix(seen, share_below(system + SECOND_WEIGHT * seen), far);
        }
    }
    return Weather(seen.r, seen.g, seen.b, 1.0, 0.0, 1.0);
}

fn weather_at(along_m: vec2f) -> Weather {
    var a = weather_of(clouds.weather[0], first_weather, along_m);
    let s = clouds.weather_share;
    if s > 0.0 {
        let b = weather_of(clouds.weather[1], second_weather, along_m);
        a = Weather(mix(a.coverage, b.coverage, s), mix(a.cloud_type, b.cloud_type, s), mix(a.rain, b.rain, s), mix(a.height, b.height, s), mix(a.high, b.high, s), mix(a.spread, b.spread, s));
    }
    return a;
}

// Trapezium with smooth sides: rises from x to y, falls from z to w.
fn height_gradient(g: vec4f, h: f32) -> f32 {
    return smoothstep(g.x, g.y + 1e-4, h) * (1.0 - smoothstep(g.z, g.w + 1e-4, h));
}

// Between a cloud's core and its rim the strength falls over this share of the weather's range.
const RIM = 0.5;

// How strongly the weather wants cloud in a layer: 0 for none, 1 in the core. The threshold is moved so that no coverage
// leaves none and full coverage leaves no gap.
fn strength_of(layer: CloudLayer, weather: Weather) -> f32 {
    let spread = (weather.coverage - 1.0 + layer.coverage * (1.0 + RIM)) / RIM;
    let high = clamp(layer.share - 0.5, 0.0, 1.0) * 2.0 * weather.high;
    return clamp(mix(max(weather.coverage * layer.share, high), spread, weather.spread), 0.0, 1.0);
}

// How much of what could be there is, at a share h of a layer's height, before any noise.
fn profile(layer: CloudLayer, weather: Weather, strength: f32, h: f32) -> f32 {
    let t = select(weather.cloud_type, layer.cloud_type, layer.cloud_type >= 0.0);
    let w = vec3f(clamp(1.0 - 2.0 * t, 0.0, 1.0), 1.0 - 2.0 * abs(t - 0.5), clamp(2.0 * t - 1.0, 0.0, 1.0));
    // Heaped clouds rise as high as they are strong.
    let rise = mix(1.0, 0.3 + 0.7 * strength, w.z) * weather.height;
    let at = h / rise;
    let full = w.x * height_gradient(clouds.gradients[0], at) + w.y * height_gradient(clouds.gradients[1], at)
        + w.z * height_gradient(clouds.gradients[2], at);
    // The anvil spreads under the top.
    let spread = layer.anvil * height_gradient(vec4f(0.62, 0.8, 0.93, 1.0), h) * step(0.15, strength);
    return max(full, spread);
}

// Of the detail noise, at a modifier of 1.
const BITE = 1.7;

// The base noise is no less than this where all is covered.
const LEAST_CLOSED = 0.5;

// How far the cover of heaped cloud shrinks from base to top.
const TAPER = 0.65;

// 1 for cumulus, 0 for flat cloud.
fn heaped(layer: CloudLayer, weather: Weather) -> f32 {
    let t = select(weather.cloud_type, layer.cloud_type, layer.cloud_type >= 0.0);
    return clamp(2.0 * t - 1.0, 0.0, 1.0);
}

// The coarse noise as the controls take it; a closed deck has it fill its gaps.
fn low_noise(billows: f32, closed: f32) -> f32 {
    return max(clamp((billows - clouds.low_least) * clouds.low_inverse_range, 0.0, 1.0), LEAST_CLOSED * closed);
}

struct Density {
    // 0 to 1.
    value: f32,
    // The most that there may be, before the detail noise has taken its part.
    bulk: f32,
}

// Waves of the two octaves of detail, as shares of its scale: what is blurred over a wave is their mean.
const COARSE_WAVE = 0.3;
const FINER_WAVE = 0.08;

// How a density is asked for.
struct Look {
    // Whether with what the detail noise takes away.
    fine: bool,
    // What is blurred of that, and of all noise.
    blur_m: f32,
    pixel_m: f32,
}

// Without the detail noise.
const COARSE = Look(false, 0.0, 0.0);

// What the coarse noise makes of a layer, before the detail noise takes its part.
struct Coarse {
    // Over 0 where there is cloud: its density then, no more than `cover`.
    excess: f32,
    cover: f32,
    // As `profile` tells it.
    wanted: f32,
    // 1 for a deck without holes.
    closed: f32,
    place: vec3f,
    // Share of the layer's height.
    h: f32,
}

const NO_CLOUD = Coarse(-1.0, 0.0, 0.0, 0.0, vec3f(0.0), 0.0);

fn coarse_at(layer: CloudLayer, weather: Weather, along_m: vec2f, altitude_m: f32) -> Coarse {
    let h = (altitude_m - layer.base_m) * layer.inverse_thickness_per_m;
    let strength = strength_of(layer, weather);
    let wanted = profile(layer, weather, strength, clamp(h, 0.0, 1.0));
    var coarse = NO_CLOUD;
    if h > 0.0 && h < 1.0 && strength * wanted > 0.0 {
        let place = vec3f(along_m + clouds.shear_m * h, altitude_m);
        let closed = smoothstep(0.85, 1.0, layer.coverage);
        let noise = textureSampleLevel(shape_volume, linear_repeat, place * clouds.base_inverse_scale_per_m - clouds.base_drift, 0.0);
        let fbm = dot(noise.gba, vec3f(0.625, 0.25, 0.125));
        let low = low_noise((noise.r + 1.0 - fbm) / (2.0 - fbm), closed);
        let anvil = layer.anvil * smoothstep(0.55, 0.8, h);
        // Heaps narrow upwards into towers; the anvil widens again.
        let narrowed = strength * (1.0 - heaped(layer, weather) * TAPER * h * h * (1.0 - anvil));
        let cover = pow(narrowed, 1.0 - 0.75 * anvil);
        coarse = Coarse(low * wanted - 1.0 + cover, cover, wanted, closed, place, h);
    }
    return coarse;
}

// Density at a place of one layer.
fn layer_density(layer: CloudLayer, weather: Weather, along_m: vec2f, altitude_m: f32, look: Look) -> Density {
    let coarse = coarse_at(layer, weather, along_m, altitude_m);
    var density = max(coarse.excess, 0.0);
    var bulk = density;
    if coarse.cover > 0.0 && look.fine {
        let h = coarse.h;
        let cover = coarse.cover;
        let closed = coarse.closed;
        if density > 0.0 && density < BITE * clouds.erosion + 0.3 {
            var at = coarse.place;
            if clouds.curl_m > 0.0 {
                let curl = textureSampleLevel(curl_texture, linear_repeat, coarse.place.xy * clouds.curl_inverse_scale_per_m, 0.0).rgb;
                at += (curl - 0.5) * 4.0 * clouds.curl_m * (1.0 - h);
            }
            let detail_at = at * clouds.detail_inverse_scale_per_m - clouds.detail_drift;
            let first = textureSampleLevel(detail_volume, linear_repeat, detail_at, 0.0).a;
            let finer = textureSampleLevel(detail_volume, linear_repeat, 3.7 * detail_at, 0.0).a;
            let blur = max(look.blur_m, look.pixel_m) * clouds.detail_inverse_scale_per_m;
            let sharp = 0.6 * (first - 0.5) * (1.0 - smoothstep(0.3, 1.5, blur / COARSE_WAVE))
                + 0.4 * (finer - 0.5) * (1.0 - smoothstep(0.3, 1.5, blur / FINER_WAVE));
            let detail = smoothstep(0.15, 0.85, 0.5 + sharp);
            // Wisps at the base, billows above.
            let bite = mix(detail, 1.0 - detail, clamp(4.0 * h, 0.0, 1.0)) * BITE * clouds.erosion * (1.0 - 0.7 * closed);
            density = clamp((density - bite) / max(1.0 - bite, 1e-3), 0.0, 1.0);
        }
        let far = smoothstep(BLURRED.x, BLURRED.y, look.pixel_m * clouds.base_inverse_scale_per_m);
        if far > 0.0 {
            let bite = 0.5 * BITE * clouds.erosion * (1.0 - 0.7 * closed);
            let inverse = 1.0 / max(1.0 - bite, 1e-3);
            let least = (low_noise(BILLOWS.x, closed) * coarse.wanted - 1.0 + cover - bite) * inverse;
            let most = (low_noise(BILLOWS.y, closed) * coarse.wanted - 1.0 + cover - bite) * inverse;
            let clumps = clumps_between(least, most, max((cover - bite) * inverse, 1e-3));
            let even_per_m = clumped_extinction(clumps.share, layer.extinction_per_m * clumps.density, CLUMP / clouds.base_inverse_scale_per_m);
            density = mix(density, even_per_m / layer.extinction_per_m, far);
            bulk = max(bulk, clumps.share);
        }
    }
    return Density(density, bulk);
}

// Rain comes from drops that are larger and denser: darker cloud.
fn densest_per_m(layer: CloudLayer, weather: Weather) -> f32 {
    return layer.extinction_per_m * (1.0 + 2.0 * clouds.precipitation * weather.rain);
}

// Extinction coefficient at a place of a band, 1/m; and the bulk, which is over 0 where there may be some.
fn band_extinction(band: CloudBand, p: vec3f, altitude_m: f32, look: Look) -> Density {
    let along_m = along_sphere(clouds.radius_m, p, altitude_m);
    let weather = weather_at(along_m);
    var sum = Density(0.0, 0.0);
    for (var i = 0u; i < one_or(band.count); i++) {
        let layer = layer_at(band.first + i);
        let density = layer_density(layer, weather, along_m, altitude_m, look);
        sum.bulk += density.bulk;
        sum.value += densest_per_m(layer, weather) * density.value;
    }
    return sum;
}

// Of a sheet, squares of weather systems to a metre, and how many of its own squares they push it aside.
const SHEET_SYSTEMS = 8e-7;
const SHEET_TURN = 1.5;

// Vertical optical depth of a sheet.
fn sheet_optical_depth(sheet: CloudSheet, p: vec3f, altitude_m: f32) -> f32 {
    let along_m = along_sphere(clouds.radius_m, p, altitude_m);
    var at = vec2f(dot(along_m, sheet.turn), dot(along_m, vec2f(-sheet.turn.y, sheet.turn.x))) - sheet.drift;
    // Far from the scene streaks turn with the weather, and gather.
    let far = smoothstep(1e5, 6e5, length(along_m));
    var system = vec2f(0.0);
    if far > 0.0 {
        let place = SHEET_SYSTEMS * along_m;
        system = vec2f(textureSampleLevel(sheet_texture, linear_repeat, place, 0.0).b, textureSampleLevel(sheet_texture, linear_repeat, place.yx + 0.43, 0.0).b);
        at += far * SHEET_TURN * (system - 0.5);
    }
    let first = textureSampleLevel(sheet_texture, linear_repeat, at, 0.0);
    let second = textureSampleLevel(sheet_texture, linear_repeat, 0.31 * at + vec2f(0.37, 0.11), 0.0);
    let values = array<f32, 3>(first.r, first.g, first.b);
    let wide = array<f32, 3>(second.b, second.b, second.b);
    let near = share_below(vec3f(values[sheet.channel] + SECOND_WEIGHT * wide[sheet.channel])).x;
    let spread = mix(near, share_below(vec3f(system.x + SECOND_WEIGHT * near)).x, far);
    let over = clamp((spread - 1.0 + sheet.coverage * 1.2) / 0.6, 0.0, 1.0);
    return sheet.optical_depth * over * over * (0.6 + 0.4 * first.a);
}
