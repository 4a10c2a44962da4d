// What a ray loses of the light that its air scatters towards the observer, once.
import package::lib::air::{Air, coefficients_at};

struct LostSum {
    // Per unit irradiance of the light's source.
    lost: vec3f,
    // What the air lets through up to here.
    left: vec3f,
    // Brightness of all that is sent.
    sent: f32,
    // Of that up to each eighth of the steps, the share that is lost.
    first: vec4f,
    second: vec4f,
}

// With the step dt at an altitude where `lit` is what the air leaves of the light, of which a share is hidden. `far` is the
// share of the steps that lie before its end.
fn with_step(before: LostSum, air: Air, altitude_m: f32, phases: vec2f, lit: vec3f, hidden: f32, dt: f32, far: f32) -> LostSum {
    let c = coefficients_at(air, altitude_m, altitude_m < air.haze_top_m);
    let passed = exp(-c.extinction_per_m * dt);
    let sent = dt * before.left * 0.5 * (1.0 + passed) * lit * (phases.x * c.rayleigh_per_m + phases.y * c.mie_per_m);
    var sum = before;
    sum.lost += hidden * sent;
    sum.sent += dot(sent, vec3f(1.0));
    sum.left *= passed;
    let share = vec4f(dot(sum.lost, vec3f(1.0)) / max(sum.sent, 1e-30));
    sum.first = select(sum.first, share, vec4f(far) <= vec4f(0.125, 0.25, 0.375, 0.5));
    sum.second = select(sum.second, share, vec4f(far) <= vec4f(0.625, 0.75, 0.875, 1.0));
    return sum;
}

// Of what clear air sends from a stretch's begin up to a part of its length, what is lost; `most` is what is lost in all, and
// behind the stretch nothing more is. The shares are those of `LostSum`; up to the first eighth it is the same.
fn lost_until(part: f32, first: vec4f, second: vec4f, sent: vec3f, most: vec3f) -> vec3f {
    let x = 8.0 * sqrt(clamp(part, 0.0, 1.0));
    let within_first = clamp(x - vec3f(1.0, 2.0, 3.0), vec3f(0.0), vec3f(1.0));
    let within_second = clamp(x - vec4f(4.0, 5.0, 6.0, 7.0), vec4f(0.0), vec4f(1.0));
    let share = first.x + dot(within_first, first.yzw - first.xyz) + dot(within_second, second - vec4f(first.w, second.xyz));
    return clamp(share * sent, vec3f(0.0), most);
}
