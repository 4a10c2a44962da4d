// Conventions of every shader
//   World axes: x east, y north, z up at the scene's origin. Metres. Radiance in W/m²/sr for a sun of unit
//   irradiance until the last pass multiplies by the sun's irradiance.
//   A point in the air is given by its altitude h above the sphere of radius R and by cosines: mu of the view
//   direction with the zenith at that point, mu_s of the sun with the same zenith, nu of view and sun. A ray is
//   followed by its length t from where it starts.
//   f32 resolves 0.5 m at the planet's radius, so no radius is ever subtracted from another: altitudes are carried,
//   and (R+h)² - R² is written h(2R+h).

const PI = 3.14159265358979;

// h(2R+h) = (R+h)² - R², the square of the distance from altitude h to the horizon.
fn horizon_distance_squared(radius_m: f32, altitude_m: f32) -> f32 {
    return altitude_m * (2.0 * radius_m + altitude_m);
}

// Altitude after a length t. From |p|² - R² = t² + 2 r mu t + h(2R+h) =: c and h' = c / (√(R²+c) + R).
fn altitude_after(radius_m: f32, altitude_m: f32, mu: f32, t: f32) -> f32 {
    let c = t * (t + 2.0 * (radius_m + altitude_m) * mu) + horizon_distance_squared(radius_m, altitude_m);
    return c / (sqrt(max(radius_m * radius_m + c, 0.0)) + radius_m);
}

// Cosine with the local zenith after a length t of a direction that has cosine `mu_d` with the zenith at the start
// and cosine `along` with the ray: p·d / |p|.
fn cosine_after(radius_m: f32, altitude_m: f32, altitude_after_m: f32, mu_d: f32, along: f32, t: f32) -> f32 {
    return clamp(((radius_m + altitude_m) * mu_d + t * along) / (radius_m + altitude_after_m), -1.0, 1.0);
}

// Length to the sphere of radius R from altitude h ≥ 0 above it, or -1. The smaller root of t² + 2 r mu t + h(2R+h)
// as c / (-b + √(b²-c)), which cancels nothing.
fn distance_to_sphere(radius_m: f32, altitude_m: f32, mu: f32) -> f32 {
    let b = (radius_m + altitude_m) * mu;
    let c = horizon_distance_squared(radius_m, altitude_m);
    let discriminant = b * b - c;
    if mu >= 0.0 || discriminant < 0.0 {
        return -1.0;
    }
    return c / (sqrt(discriminant) - b);
}

// Length to where a ray enters the air, whose top is at `top_m`; 0 from within, and for a ray that passes it by.
fn distance_to_air(radius_m: f32, top_m: f32, altitude_m: f32, mu: f32) -> f32 {
    return select(0.0, max(distance_to_sphere(radius_m + top_m, altitude_m - top_m, mu), 0.0), altitude_m > top_m);
}

// Length from inside the sphere of altitude `top_m` to it.
fn distance_to_top(radius_m: f32, top_m: f32, altitude_m: f32, mu: f32) -> f32 {
    let b = (radius_m + altitude_m) * mu;
    let c = max((top_m - altitude_m) * (top_m + altitude_m + 2.0 * radius_m), 0.0);
    let root = sqrt(b * b + c);
    if b > 0.0 {
        return c / (b + root);
    }
    return root - b;
}

// The stretch of a ray of length t_max that lies inside a sphere of radius `r_shell`, from altitude h above it
// (negative: inside), empty where x ≥ y. Roots of t² + 2 (r_shell + h) mu t + h(2 r_shell + h), the far one of them
// added, the near one by the quotient, so that nothing cancels.
fn shell_stretch(r_shell_m: f32, h: f32, mu: f32, t_max: f32) -> vec2f {
    let b = (r_shell_m + h) * mu;
    let c = h * (2.0 * r_shell_m + h);
    let discriminant = b * b - c;
    if discriminant <= 0.0 {
        return vec2f(0.0);
    }
    let q = -(b + select(-1.0, 1.0, b >= 0.0) * sqrt(discriminant));
    let other = select(c / q, 0.0, q == 0.0);
    return vec2f(max(min(q, other), 0.0), min(max(q, other), t_max));
}

// Angle from the zenith at which the sphere's edge is seen from altitude h above it: π/2 + atan(√(h(2R+h)) / R).
fn edge_zenith_angle(radius_m: f32, altitude_m: f32) -> f32 {
    return 0.5 * PI + atan(sqrt(horizon_distance_squared(radius_m, altitude_m)) / radius_m);
}

// Its cosine: of π/2 + atan(d/R) with d² = h(2R+h), so that R² + d² = (R+h)².
fn edge_cosine(radius_m: f32, altitude_m: f32) -> f32 {
    return -sqrt(horizon_distance_squared(radius_m, altitude_m)) / (radius_m + altitude_m);
}

// Over the horizon by so little, a ray no longer meets the ground.
const LIFTED = 1e-5;

// A direction under the horizon by less than `reach`, in cosines with `up`, looks just over it instead.
fn over_horizon(direction: vec3f, up: vec3f, horizon: f32, reach: f32) -> vec3f {
    let under = horizon - dot(direction, up);
    return normalize(direction + select(0.0, under + LIFTED, under > -LIFTED && under < reach) * up);
}

// From its cosine: within 3e-4 at 0 and π, where the cosine is flat, and exact between. Mesa's acos is off by 1e-4.
fn angle_of_cosine(c: f32) -> f32 {
    return atan2(sqrt(max((1.0 - c) * (1.0 + c), 0.0)), c);
}

// Angle between unit vectors that are near each other, from their chord c = 2 sin(θ/2): exact to 1e-6 up to half a
// radian; less than the angle beyond, 2.5 for π. For discs and glare.
fn angle_if_near(a: vec3f, b: vec3f) -> f32 {
    let c = a - b;
    let square = dot(c, c);
    return sqrt(square) * (1.0 + square * (1.0 / 24.0 + square * (3.0 / 640.0)));
}

// Of unit vectors; exact for small angles, where acos of the dot product is not.
fn angle_between(a: vec3f, b: vec3f) -> f32 {
    return atan2(length(cross(a, b)), dot(a, b));
}

// The stretch of a ray that lies in the planet's shadow, empty where x ≥ y. Parallel light: the shadow is the half
// of the cylinder of radius R about the sun's axis that lies behind the planet. Points of the ray have
// |p|² - R² - (p·s)² = a t² + 2 b t + c with a = 1 - nu², b = r (mu - mu_s nu), c = h(2R+h) - (r mu_s)².
fn shadow_stretch(radius_m: f32, altitude_m: f32, mu: f32, mu_s: f32, nu: f32, t_max: f32) -> vec2f {
    let r = radius_m + altitude_m;
    let behind = r * mu_s; // p·s = behind + t nu
    let a = max(1.0 - nu * nu, 0.0);
    let b = r * (mu - mu_s * nu);
    let rho = sqrt(horizon_distance_squared(radius_m, altitude_m));
    let c = (rho - abs(behind)) * (rho + abs(behind));
    var stretch = vec2f(0.0, t_max);
    if a < 1e-9 {
        if c >= 0.0 {
            return vec2f(0.0);
        }
    } else {
        let discriminant = b * b - a * c;
        if discriminant <= 0.0 {
            return vec2f(0.0);
        }
        let q = -(b + select(-1.0, 1.0, b >= 0.0) * sqrt(discriminant));
        var roots = vec2f(q / a, q / a);
        if q != 0.0 {
            roots.y = c / q;
        }
        stretch = vec2f(max(min(roots.x, roots.y), 0.0), min(max(roots.x, roots.y), t_max));
    }
    // Only where p·s < 0.
    if abs(nu) > 1e-9 {
        let t_terminator = -behind / nu;
        if nu > 0.0 {
            stretch.y = min(stretch.y, t_terminator);
        } else {
            stretch.x = max(stretch.x, t_terminator);
        }
    } else if behind >= 0.0 {
        return vec2f(0.0);
    }
    return stretch;
}

// The way along the sphere from the scene's origin to below a place: R times the angle, whose sine is s/|p|, by the series
// of asin (within 1e-3 up to 50°), so that from orbit nothing is stretched.
fn along_sphere(radius_m: f32, p: vec3f, altitude_m: f32) -> vec2f {
    let r = radius_m + altitude_m;
    let x2 = min(dot(p.xy, p.xy) / (r * r), 1.0);
    return p.xy * (radius_m / r) * (1.0 + x2 * (1.0 / 6.0 + x2 * (3.0 / 40.0 + x2 * (15.0 / 336.0 + x2 * 0.09))));
}
