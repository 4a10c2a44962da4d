// The surface of water, rough with waves whose slopes are spread evenly about the vertical (Cox and Munk 1954), too small
// to be seen one by one.
import package::lib::geometry::PI;

// Mean square slope by the wind's speed at mast height.
fn slope_variance(wind_m_s: f32) -> f32 {
    return 0.003 + 0.00512 * wind_m_s;
}

// Fresnel's reflectance of water, n = 1.34, by Schlick.
fn reflectance(cosine: f32) -> f32 {
    return 0.0211 + 0.9789 * pow(1.0 - clamp(cosine, 0.0, 1.0), 5.0);
}

// The same, mean over the waves that are seen (Bruneton, Neyret and Holzschuch 2010, eq. 16).
fn mean_reflectance(cosine: f32, variance: f32) -> f32 {
    let sigma = sqrt(variance);
    return 0.0211 + 0.9789 * pow(1.0 - clamp(cosine, 0.0, 1.0), 5.0 * exp(-2.69 * sigma)) / (1.0 + 22.7 * sigma * sqrt(sigma));
}

// Share of the waves that is not hidden by others, seen at that cosine (Smith 1967, as fitted by Walter et al. 2007).
fn unhidden(cosine: f32, variance: f32) -> f32 {
    let mu = clamp(cosine, 1e-4, 1.0);
    let a = mu / sqrt(max(variance * (1.0 - mu * mu), 1e-8));
    return select((3.535 * a + 2.181 * a * a) / (1.0 + 2.276 * a + 2.577 * a * a), 1.0, a >= 1.6);
}

// Radiance towards the viewer of a sun that sends unit irradiance on a plane that faces it: F D G / (4 cos θ_v), with the
// slopes' density D = e^{-tan²β/σ²} / (π σ² cos⁴β) at the slope β that mirrors the one to the other.
fn glitter(up: vec3f, to_viewer: vec3f, to_sun: vec3f, variance: f32) -> f32 {
    let h = normalize(to_viewer + to_sun);
    let beta = max(dot(h, up), 1e-3);
    let view = max(dot(to_viewer, up), 1e-4);
    let sun = dot(to_sun, up);
    if sun <= 0.0 {
        return 0.0;
    }
    let squared = beta * beta;
    let density = exp((1.0 - 1.0 / squared) / variance) / (PI * variance * squared * squared);
    return reflectance(dot(h, to_viewer)) * density * unhidden(view, variance) * unhidden(sun, variance) / (4.0 * view);
}

// Where the waves mirror the sky from, on average: seen along the water, those that face the viewer, so that it is never
// the horizon itself.
fn mirrored_direction(up: vec3f, to_viewer: vec3f, variance: f32) -> vec3f {
    let view = max(dot(to_viewer, up), 0.0);
    let level = view * up - to_viewer;
    let raised = sqrt(view * view + 0.6 * variance);
    let along = level / max(length(level), 1e-5);
    return normalize(raised * up + sqrt(max(1.0 - raised * raised, 0.0)) * along);
}
