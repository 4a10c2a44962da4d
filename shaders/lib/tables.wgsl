// Table coordinates: each mapping stands beside its inverse. x in 0..1 spans the centres of the first and the last
// texel, so that the ends of a range are stored exactly.
import package::lib::air::Air;
import package::lib::geometry::{PI, horizon_distance_squared, distance_to_top, edge_zenith_angle};

fn texel_to_unit(texel: u32, size: u32) -> f32 {
    return f32(texel) / f32(size - 1u);
}

fn unit_to_coordinate(x: f32, size: u32) -> f32 {
    return (0.5 + clamp(x, 0.0, 1.0) * f32(size - 1u)) / f32(size);
}

// Light is stored as its fourth root. Through twilight it falls tenfold in a few texels; between two of them, linear
// interpolation of f = e^{kx} is off by (kΔ)²/8, that of its root by a quarter of it. Half floats reach deeper, too.
fn light_to_table(light: vec3f) -> vec3f {
    return sqrt(sqrt(max(light, vec3f(0.0))));
}

fn light_from_table(stored: vec3f) -> vec3f {
    return stored * stored * stored * stored;
}

// Transmittance (Bruneton 2017): x from the distance d to the top, between that of the zenith and that of the
// horizon; y = rho/H with rho and H the horizon distances from the point and from the top.
struct HeightCosine {
    altitude_m: f32,
    mu: f32,
}

fn transmittance_unit(radius_m: f32, top_m: f32, p: HeightCosine) -> vec2f {
    let h = clamp(p.altitude_m, 0.0, top_m);
    let rho = sqrt(horizon_distance_squared(radius_m, h));
    let rho_top = sqrt(horizon_distance_squared(radius_m, top_m));
    let d_min = top_m - h;
    let d_max = rho + rho_top;
    let d = distance_to_top(radius_m, top_m, h, p.mu);
    return vec2f((d - d_min) / max(d_max - d_min, 1e-6), rho / rho_top);
}

fn transmittance_point(radius_m: f32, top_m: f32, unit: vec2f) -> HeightCosine {
    let rho_top = sqrt(horizon_distance_squared(radius_m, top_m));
    let rho = rho_top * unit.y;
    let h = rho * rho / (sqrt(radius_m * radius_m + rho * rho) + radius_m);
    let d_min = top_m - h;
    let d_max = rho + rho_top;
    let d = d_min + unit.x * (d_max - d_min);
    // (R+top)² = r² + d² + 2 r d mu
    let mu = (rho_top * rho_top - rho * rho - d * d) / (2.0 * (radius_m + h) * max(d, 1e-6));
    return HeightCosine(h, select(clamp(mu, -1.0, 1.0), 1.0, d <= 0.0));
}

// Multiple scattering: x is the sun's cosine, finer about the horizon; y is the height. Above the haze it is finer
// towards its lower end; the haze, where there is one, has the first HAZE_ROWS rows for itself, so that nothing bleeds
// over its top.
const HAZE_ROWS = 16u;

// Share of the haze's height at y of its rows. In a dense one the light changes within a free path of either end, at
// the top with the sun's fall, and linearly between (diffusion): rows stand closer by the square towards both ends.
fn haze_share(y: f32) -> f32 {
    let end = min(y, 1.0 - y);
    return select(2.0 * end * end, 1.0 - 2.0 * end * end, y > 0.5);
}

fn haze_unit(share: f32) -> f32 {
    let end = sqrt(0.5 * clamp(min(share, 1.0 - share), 0.0, 0.5));
    return select(end, 1.0 - end, share > 0.5);
}

fn sun_cosine_unit(mu_s: f32) -> f32 {
    return 0.5 + 0.5 * sign(mu_s) * sqrt(abs(mu_s));
}

fn sun_cosine_point(x: f32) -> f32 {
    let s = 2.0 * x - 1.0;
    return s * abs(s);
}

// Directions of view: the zenith angle from π to 0, finer about the horizon. The elevation is π/2 (a s + (1-a) s²) of
// s = 2x - 1, with the sign of s.
const VIEW_EVENNESS = 0.3;

fn view_zenith_angle(x: f32) -> f32 {
    let s = 2.0 * x - 1.0;
    return 0.5 * PI * (1.0 - s * (VIEW_EVENNESS + (1.0 - VIEW_EVENNESS) * abs(s)));
}

fn view_unit(zenith_angle: f32) -> f32 {
    let elevation = 1.0 - zenith_angle / (0.5 * PI);
    let root = sqrt(VIEW_EVENNESS * VIEW_EVENNESS + 4.0 * (1.0 - VIEW_EVENNESS) * abs(elevation));
    return 0.5 + 0.5 * sign(elevation) * (root - VIEW_EVENNESS) / (2.0 * (1.0 - VIEW_EVENNESS));
}

// x as a unit; y as a texture's coordinate.
fn multi_scattering_unit(air: Air, p: HeightCosine, in_haze: bool, rows: u32) -> vec2f {
    let x = sun_cosine_unit(p.mu);
    if air.haze_extinction_per_m <= 0.0 {
        return vec2f(x, unit_to_coordinate(sqrt(clamp(p.altitude_m / air.top_m, 0.0, 1.0)), rows));
    }
    let first = select(HAZE_ROWS, 0u, in_haze);
    let count = select(rows - HAZE_ROWS, HAZE_ROWS, in_haze);
    let above = sqrt(clamp((p.altitude_m - air.haze_top_m) / max(air.top_m - air.haze_top_m, 1.0), 0.0, 1.0));
    let y = select(above, haze_unit(p.altitude_m / air.haze_top_m), in_haze);
    return vec2f(x, (f32(first) + 0.5 + y * f32(count - 1u)) / f32(rows));
}

struct MultiScatteringPoint {
    altitude_m: f32,
    mu_s: f32,
    in_haze: bool,
}

fn multi_scattering_point(air: Air, texel: vec2u, size: vec2u) -> MultiScatteringPoint {
    let mu_s = sun_cosine_point(texel_to_unit(texel.x, size.x));
    let hazy = air.haze_extinction_per_m > 0.0;
    if hazy && texel.y < HAZE_ROWS {
        return MultiScatteringPoint(haze_share(texel_to_unit(texel.y, HAZE_ROWS)) * air.haze_top_m, mu_s, true);
    }
    let first = select(0u, HAZE_ROWS, hazy);
    let floor_m = select(0.0, air.haze_top_m, hazy);
    let y = texel_to_unit(texel.y - first, size.y - first);
    return MultiScatteringPoint(floor_m + y * y * (air.top_m - floor_m), mu_s, false);
}

// Sky view, seen from one altitude. x is the azimuth from the sun over π: the sky is even in it. The lower rows hold rays
// to the ground by the root of the distance beyond that to the nadir, which is even in angle about the nadir; the upper
// ones rays to space by the root of the angle over the horizon. No row belongs to both, so nothing bleeds over the
// horizon. Seen from outside, the upper rows span only the air over the limb.
struct SkyViewRay {
    azimuth: f32,
    zenith_angle: f32,
    ground: bool,
    // Of rays to the ground.
    distance_m: f32,
}

fn least_zenith_angle(radius_m: f32, top_m: f32, altitude_m: f32) -> f32 {
    if altitude_m <= top_m {
        return 0.0;
    }
    return edge_zenith_angle(radius_m + top_m, altitude_m - top_m);
}

// The last row's zenith angle. Seen from outside, a little under the top of the air, so that no row is of rays without
// air: towards nothing, the root would bend the light too far.
const OUTERMOST = 0.992;

fn last_zenith_angle(radius_m: f32, top_m: f32, altitude_m: f32) -> f32 {
    if altitude_m <= top_m {
        return 0.0;
    }
    return least_zenith_angle(radius_m, OUTERMOST * top_m, altitude_m);
}

// Rows of rays to the ground; light is smoother there than over the horizon.
fn ground_rows(rows: u32) -> u32 {
    return rows / 2u;
}

fn sky_view_ray(radius_m: f32, top_m: f32, altitude_m: f32, texel: vec2u, size: vec2u) -> SkyViewRay {
    let below = ground_rows(size.y);
    let azimuth = PI * texel_to_unit(texel.x, size.x);
    let horizon = edge_zenith_angle(radius_m, altitude_m);
    if texel.y >= below {
        let y = texel_to_unit(texel.y - below, size.y - below);
        let least = last_zenith_angle(radius_m, top_m, altitude_m);
        return SkyViewRay(azimuth, horizon - y * y * (horizon - least), false, 0.0);
    }
    let y = texel_to_unit(texel.y, below);
    let squared = horizon_distance_squared(radius_m, altitude_m);
    let d = altitude_m + y * y * (sqrt(squared) - altitude_m);
    // From R² = r² + d² + 2 r d mu follows 1 + mu = (d - h)(2R + h - d) / (2 r d). The half angle of the nadir's side by
    // its tangent: drivers' acos may be off by 1e-4, which from far away is kilometres of ground.
    var nadir_angle = 0.0;
    if d > altitude_m && d > 0.0 {
        let risen = clamp((d - altitude_m) * (2.0 * radius_m + altitude_m - d) / (2.0 * (radius_m + altitude_m) * d), 0.0, 1.0);
        nadir_angle = 2.0 * atan(sqrt(risen / (2.0 - risen)));
    }
    return SkyViewRay(azimuth, PI - nadir_angle, true, d);
}

fn sky_view_coordinate(radius_m: f32, top_m: f32, altitude_m: f32, ray: SkyViewRay, size: vec2u) -> vec2f {
    let below = ground_rows(size.y);
    let share = f32(below) / f32(size.y);
    let x = unit_to_coordinate(ray.azimuth / PI, size.x);
    if ray.ground {
        let farthest = sqrt(horizon_distance_squared(radius_m, altitude_m));
        let y = sqrt(max(ray.distance_m - altitude_m, 0.0) / max(farthest - altitude_m, 1e-3));
        return vec2f(x, share * unit_to_coordinate(y, below));
    }
    let horizon = edge_zenith_angle(radius_m, altitude_m);
    let least = last_zenith_angle(radius_m, top_m, altitude_m);
    let y = sqrt(clamp((horizon - ray.zenith_angle) / (horizon - least), 0.0, 1.0));
    return vec2f(x, share + (1.0 - share) * unit_to_coordinate(y, size.y - below));
}
