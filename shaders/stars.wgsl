// Adds the stars to a tile of the picture. The list holds each pixel once, so that no two threads meet.
import package::lib::air::Air;
import package::lib::cloud_shade::clouds_before;
import package::lib::light::View;
import package::lib::stars::light_left;

struct Glint {
    direction: vec3f,
    // Row times width, plus column.
    pixel: u32,
    radiance: vec3f,
}

struct Stretch {
    // Of the list, the part in this tile.
    first: u32,
    count: u32,
    // The tile's first pixel; tiles are whole rows or parts of one, so that pixels follow one another.
    origin: u32,
    // Rises from 0 to 1 as the stars come out.
    out: f32,
    // Of the tile.
    width: u32,
    // Texels of the clouds' table to a pixel.
    cloud_fineness: f32,
}

// True where there are clouds.
override CLOUDS: bool = false;

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(1) var<uniform> view: View;
@group(0) @binding(2) var<uniform> stretch: Stretch;
@group(0) @binding(3) var transmittance_table: texture_2d<f32>;
@group(0) @binding(4) var linear_clamp: sampler;
@group(0) @binding(5) var<storage, read> glints: array<Glint>;
@group(0) @binding(6) var<storage, read_write> radiance: array<vec4f>;
// What they let through, in alpha.
@group(0) @binding(7) var cloud_table: texture_2d<f32>;

@compute @workgroup_size(64)
fn stars(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= stretch.count {
        return;
    }
    let glint = glints[stretch.first + id.x];
    let mu = dot(glint.direction, view.up);
    var left = light_left(air, transmittance_table, linear_clamp, view.altitude_m, mu);
    let pixel = glint.pixel - stretch.origin;
    if CLOUDS {
        let place = vec2f(f32(pixel % stretch.width), f32(pixel / stretch.width)) + 0.5;
        left *= clouds_before(cloud_table, place, stretch.cloud_fineness).a;
    }
    radiance[pixel] += vec4f(stretch.out * left * glint.radiance, 0.0);
}
