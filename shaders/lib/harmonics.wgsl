// Real spherical harmonics of the first three bands, and the irradiance that light so described sends on a surface.
import package::lib::geometry::PI;

fn harmonics(d: vec3f) -> array<f32, 9> {
    return array<f32, 9>(
        0.28209479,
        0.48860251 * d.y,
        0.48860251 * d.z,
        0.48860251 * d.x,
        1.09254843 * d.x * d.y,
        1.09254843 * d.y * d.z,
        0.31539157 * (3.0 * d.z * d.z - 1.0),
        1.09254843 * d.x * d.z,
        0.54627421 * (d.x * d.x - d.y * d.y),
    );
}

// Each band of radiance times that of the clamped cosine: π, 2π/3, π/4 (Ramamoorthi and Hanrahan 2001).
fn irradiance_towards(radiance: array<vec3f, 9>, normal: vec3f) -> vec3f {
    let y = harmonics(normal);
    var first = vec3f(0.0);
    var second = vec3f(0.0);
    for (var k = 1u; k < 4u; k++) {
        first += y[k] * radiance[k];
    }
    for (var k = 4u; k < 9u; k++) {
        second += y[k] * radiance[k];
    }
    return max(PI * y[0] * radiance[0] + 2.0 * PI / 3.0 * first + PI / 4.0 * second, vec3f(0.0));
}
