// Phase functions, per steradian; each integrates to 1 over the sphere.
import package::lib::geometry::PI;

// Rayleigh 1871: 3/(16π) (1 + cos²θ).
fn rayleigh_phase(nu: f32) -> f32 {
    return 3.0 / (16.0 * PI) * (1.0 + nu * nu);
}

// Cornette and Shanks 1992: 3/(8π) (1-g²)(1+cos²θ) / ((2+g²)(1+g²-2g cosθ)^1.5).
// 1+g²-2g cosθ is written (1-g)² + 2g(1-cosθ), which keeps the peak of g → 1 exact.
fn cornette_shanks_phase(nu: f32, g: f32) -> f32 {
    let base = max((1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - nu), 1e-12);
    return 3.0 / (8.0 * PI) * (1.0 - g * g) * (1.0 + nu * nu) / ((2.0 + g * g) * base * sqrt(base));
}
