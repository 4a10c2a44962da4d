// The air's coefficients at a height. Bruneton and Neyret 2008 §2; Hillaire 2020 §4.

struct Air {
    rayleigh_scattering_per_m: vec3f,
    rayleigh_inverse_height_per_m: f32,
    rayleigh_extinction_per_m: vec3f,
    mie_inverse_height_per_m: f32,
    mie_scattering_per_m: vec3f,
    mie_asymmetry: f32,
    mie_extinction_per_m: vec3f,
    ozone_centre_m: f32,
    ozone_absorption_per_m: vec3f,
    ozone_inverse_half_width_per_m: f32,
    // An even layer from the ground to `haze_top_m`, with the aerosols' phase function.
    haze_scattering_per_m: vec3f,
    haze_extinction_per_m: f32,
    ground_albedo: vec3f,
    haze_top_m: f32,
    radius_m: f32,
    top_m: f32,
    // 1: all orders of scattering; 0: the first alone.
    multiple: f32,
}

struct Coefficients {
    rayleigh_per_m: vec3f,
    // Aerosols and haze.
    mie_per_m: vec3f,
    extinction_per_m: vec3f,
}

// Scattering and extinction at an altitude, in the haze or not. Ozone absorbs only, and lies in a tent about its centre.
fn coefficients_at(air: Air, altitude_m: f32, in_haze: bool) -> Coefficients {
    let h = max(altitude_m, 0.0);
    let rayleigh = exp(-h * air.rayleigh_inverse_height_per_m);
    let mie = exp(-h * air.mie_inverse_height_per_m);
    let ozone = max(1.0 - abs(h - air.ozone_centre_m) * air.ozone_inverse_half_width_per_m, 0.0);
    let haze = select(0.0, 1.0, in_haze);
    var c: Coefficients;
    c.rayleigh_per_m = rayleigh * air.rayleigh_scattering_per_m;
    c.mie_per_m = mie * air.mie_scattering_per_m + haze * air.haze_scattering_per_m;
    c.extinction_per_m = rayleigh * air.rayleigh_extinction_per_m + mie * air.mie_extinction_per_m
        + ozone * air.ozone_absorption_per_m + haze * air.haze_extinction_per_m;
    return c;
}
