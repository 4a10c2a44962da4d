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
// Sum of weighted log luminance, and of weights.
var<workgroup> partial: array<vec2f, 64>;

// A meter reads L as mid grey: EV = log2(L · 100 / 12.5) (ISO 2720, K = 12.5 cd/m²).
const REFLECTED_LIGHT = 8.0;
// Below this, night stays night.
const LEAST_EV = -5.0;
// Full daylight; the eye follows a darker sky only in part, so that dusk looks like dusk.
const DAYLIGHT_EV = 12.5;
const FOLLOWED = 0.80;

@compute @workgroup_size(64)
fn exposure(@builtin(local_invocation_index) thread: u32) {
    var sum = vec2f(0.0);
    let count = meter.size_px.x * meter.size_px.y;
    for (var i = thread; i < count; i += THREADS) {
        let at = (vec2f(f32(i % meter.size_px.x), f32(i / meter.size_px.x)) + 0.5) / vec2f(meter.size_px) - 0.5;
        // Centre-weighted.
        let weight = radiance[i].a * exp(-4.0 * dot(at, at));
        sum += weight * vec2f(log2(max(photopic_luminance(radiance[i].rgb), 1e-6)), 1.0);
    }
    partial[thread] = sum;
    workgroupBarrier();
    if thread != 0u {
        return;
    }
    var all = vec2f(0.0);
    for (var i = 0u; i < THREADS; i++) {
        all += partial[i];
    }
    let read_ev = max(all.x / max(all.y, 1e-6) + log2(REFLECTED_LIGHT), LEAST_EV);
    let dark = max(DAYLIGHT_EV - read_ev, 0.0);
    let ev = read_ev + (1.0 - FOLLOWED) * dark - meter.compensation_ev;
    result.ev100 = ev;
    // ISO 12232: full scale at 1.2 · 2^EV cd/m².
    result.scale = exp2(-ev) / 1.2;
}
