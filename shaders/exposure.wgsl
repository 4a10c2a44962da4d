// The camera's meter: from a small picture of the scene to an exposure.
import package::lib::colour::photopic_luminance;

struct Meter {
    // Size of the small picture, pixels.
    size_px: vec2u,
    compensation_ev: f32,
}

struct Exposure {
    // Multiplies luminance.
    scale: f32,
    // EV at ISO 100.
    ev100: f32,
}

@group(0) @binding(0) var<uniform> meter: Meter;
@group(0) @binding(1) var<storage, read> radiance: array<vec4f>;
@group(0) @binding(2) var<storage, read_write> result: Exposure;

const THREADS = 64u;
// Sum of weighted log luminance, sum of weights, greatest luminance.
var<workgroup> partial: array<vec3f, 64>;

// A metered luminance L shall become mid grey, 0.18, where full scale stands at 1.2 · 2^EV cd/m² (ISO 12232):
// EV = log2(L / (0.18 · 1.2)).
const MID_GREY = 0.18;
const FULL_SCALE = 1.2;
// Stops above mid grey that the brightest part of the sky may reach: more would be flat white.
const HEADROOM_EV = 4.0;
// Stops under the brightest part at which darkness begins to count less, and from which on it counts nothing: space
// beside a planet is not part of what the photographer exposes for.
const DARK_FROM_EV = 6.0;
const DARK_TO_EV = 10.0;
// Below this, night stays night: a moonless, starlit scene reads -10.
const LEAST_EV = -10.5;
// From daylight on down the eye follows a darker sky only in part, so that dusk looks like dusk.
const DAYLIGHT_EV = 12.5;
const FOLLOWED = 0.85;

fn luminance_at(i: u32) -> f32 {
    return log2(max(photopic_luminance(radiance[i].rgb), 1e-6));
}

@compute @workgroup_size(64)
fn exposure(@builtin(local_invocation_index) thread: u32) {
    let count = meter.size_px.x * meter.size_px.y;
    var brightest = -20.0;
    for (var i = thread; i < count; i += THREADS) {
        brightest = max(brightest, select(-20.0, luminance_at(i), radiance[i].a > 0.0));
    }
    partial[thread] = vec3f(0.0, 0.0, brightest);
    workgroupBarrier();
    for (var i = 0u; i < THREADS; i++) {
        brightest = max(brightest, partial[i].z);
    }
    workgroupBarrier();
    var sum = vec3f(0.0);
    for (var i = thread; i < count; i += THREADS) {
        let at = (vec2f(f32(i % meter.size_px.x), f32(i / meter.size_px.x)) + 0.5) / vec2f(meter.size_px) - 0.5;
        let log_luminance = luminance_at(i);
        let seen = 1.0 - smoothstep(DARK_FROM_EV, DARK_TO_EV, brightest - log_luminance);
        // Centre-weighted.
        let weight = select(0.0, seen, radiance[i].a > 0.0) * exp(-4.0 * dot(at, at));
        sum += weight * vec3f(log_luminance, 1.0, 0.0);
    }
    partial[thread] = sum;
    workgroupBarrier();
    if thread != 0u {
        return;
    }
    var all = vec3f(0.0);
    for (var i = 0u; i < THREADS; i++) {
        all += partial[i];
    }
    let grey_at = -log2(MID_GREY * FULL_SCALE);
    let mean_ev = all.x / max(all.y, 1e-6) + grey_at;
    let read_ev = max(max(mean_ev, brightest + grey_at - HEADROOM_EV), LEAST_EV);
    let ev = read_ev + (1.0 - FOLLOWED) * max(DAYLIGHT_EV - read_ev, 0.0) - meter.compensation_ev;
    result.ev100 = ev;
    result.scale = exp2(-ev) / FULL_SCALE;
}
