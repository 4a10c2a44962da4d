// The coarse extinction of every layer of clouds about the observer.
import package::lib::cloud::{clouds, coarse_at, densest_per_m, layer_at, weather_at};
import package::lib::cloud_volume::volume_place;

// Extinction coefficient, 1/m; the layers' levels one on the other.
@group(0) @binding(5) var volume: texture_storage_3d<r32float, write>;

@compute @workgroup_size(8, 8)
fn cloud_volume(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(volume);
    if any(id.xy >= size.xy) || id.z >= clouds.layer_count {
        return;
    }
    let along_m = volume_place(id.xy, size.xy);
    let weather = weather_at(along_m);
    let layer = layer_at(id.z);
    let densest = densest_per_m(layer, weather);
    let levels = size.z / clouds.layer_count;
    for (var k = 0u; k < levels; k++) {
        let altitude_m = layer.base_m + (f32(k) + 0.5) / (f32(levels) * layer.inverse_thickness_per_m);
        let extinction_per_m = densest * max(coarse_at(layer, weather, along_m, altitude_m).excess, 0.0);
        textureStore(volume, vec3u(id.xy, id.z * levels + k), vec4f(extinction_per_m));
    }
}
