// Light in the air between the observer and something that stands in it, from a volume: azimuth and row as the sky view has
// them, depth by the root of the way. What is stored is the mean over the way from the observer, which near them is that of
// the place itself: so nothing is lost between the first slices.
import package::lib::air::Air;
import package::lib::scattering::Scattered;
import package::lib::tables::{SkyViewRay, light_from_table, sky_view_coordinate, unit_to_coordinate};


// Share of the ray's way in the air at a slice.
fn aerial_share(slice: u32, slices: u32) -> f32 {
    let w = f32(slice) / f32(slices - 1u);
    return w * w;
}

// Light and optical depth of the first `way_m` of a ray whose way in the air is `length_m`.
fn aerial_to(
    air: Air,
    rayleigh: texture_3d<f32>,
    mie: texture_3d<f32>,
    multiple: texture_3d<f32>,
    linear_clamp: sampler,
    altitude_m: f32,
    ray: SkyViewRay,
    way_m: f32,
    length_m: f32,
) -> Scattered {
    let size = textureDimensions(rayleigh);
    let at = sky_view_coordinate(air.radius_m, air.top_m, altitude_m, ray, size.xy);
    let w = sqrt(clamp(way_m / max(length_m, 1.0), 0.0, 1.0));
    let place = vec3f(at, unit_to_coordinate(w, size.z));
    let r = textureSampleLevel(rayleigh, linear_clamp, place, 0.0);
    let m = textureSampleLevel(mie, linear_clamp, place, 0.0);
    let s = textureSampleLevel(multiple, linear_clamp, place, 0.0);
    return Scattered(way_m * light_from_table(r.rgb), way_m * light_from_table(m.rgb), way_m * light_from_table(s.rgb), way_m * vec3f(r.a, m.a, s.a));
}
