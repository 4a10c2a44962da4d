// Harmonics of the light that the sky sends on the ground: one workgroup looks all over the sky. Below the horizon there
// is nothing: what the ground sends up is added where it is used.
import package::lib::air::Air;
import package::lib::geometry::PI;
import package::lib::harmonics::harmonics;
import package::lib::light::{View, scattered_radiance};
import package::lib::scattering::{March, scatter_along};
import package::lib::view_ray::{Observer, enter_air};

override MULTIPLE: bool = true;
override HAZE: bool = true;

struct Part {
    // Where the result goes.
    first: u32,
}

@group(0) @binding(0) var<uniform> air: Air;
// With the ground's place in the observer's, and a light of unit irradiance.
@group(0) @binding(1) var<uniform> view: View;
@group(0) @binding(2) var<uniform> observer: Observer;
@group(0) @binding(3) var transmittance_table: texture_2d<f32>;
@group(0) @binding(4) var linear_clamp: sampler;
@group(0) @binding(5) var source_table: texture_2d_array<f32>;
@group(0) @binding(6) var<uniform> part: Part;
@group(0) @binding(7) var<storage, read_write> sky_harmonics: array<vec4f>;

const LOOKS = 256u;

var<workgroup> found: array<vec3f, 256>;
var<workgroup> towards: array<vec3f, 256>;

@compute @workgroup_size(256)
fn ground_sky(@builtin(local_invocation_index) i: u32) {
    // Evenly over the hemisphere, on a spiral (Vogel 1979).
    let mu = (f32(i) + 0.5) / f32(LOOKS);
    let turn = 2.39996323 * f32(i);
    let helper = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(view.up.x) > 0.5);
    let east = normalize(cross(helper, view.up));
    let direction = mu * view.up + sqrt(1.0 - mu * mu) * (cos(turn) * east + sin(turn) * cross(view.up, east));
    let nu = clamp(dot(direction, view.sun), -1.0, 1.0);
    let entry = enter_air(air, observer, mu, nu, false, 0.0);
    let march = March(true, MULTIPLE, HAZE, false, observer.steps, 4u, 0u);
    let light = scatter_along(air, entry, transmittance_table, source_table, linear_clamp, march);
    found[i] = scattered_radiance(air, view, light, nu);
    towards[i] = direction;
    workgroupBarrier();
    if i < 9u {
        var sum = vec3f(0.0);
        for (var k = 0u; k < LOOKS; k++) {
            let y = harmonics(towards[k]);
            sum += y[i] * found[k];
        }
        sky_harmonics[part.first + i] = vec4f(2.0 * PI / f32(LOOKS) * sum, 0.0);
    }
}
