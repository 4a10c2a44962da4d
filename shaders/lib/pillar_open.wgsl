// A lamp's pillar where nothing casts shadows.
import package::lib::air::Air;
import package::lib::geometry::PI;
import package::lib::pillar::{Crystals, Fan, Lamp, fan_of};
import package::lib::pillar_lamp::{ice, mirrored, support_of};

// Radiance of one layer from a lamp's pillar along a ray that ends at `end_m`, W/m²/sr. `blur_m` is how far the lamp's image is
// spread to each side.
fn open_pillar(air: Air, layer: Crystals, lamp: Lamp, v: vec3f, end_m: f32, blur_m: f32) -> vec3f {
    let fan = fan_of(lamp.place_m, v, blur_m);
    let support = support_of(layer, fan, v.z, blur_m, end_m);
    if support.factor == 0.0 {
        return vec3f(0.0);
    }
    var sum = vec3f(0.0);
    for (var k = 0u; k < ice.three; k++) {
        let psi0 = fan.psi0 + (f32(k) - 1.0) * PI;
        let ends = vec2f(max(psi0 - support.reach, support.ends.x), min(psi0 + support.reach, support.ends.y));
        if ends.x < ends.y {
            sum += mirrored(air, layer, lamp, fan, v, support.sin_least, psi0, ends);
        }
    }
    return sum * lamp.intensity * (layer.face_per_m * support.factor / (2.0 * fan.b));
}
