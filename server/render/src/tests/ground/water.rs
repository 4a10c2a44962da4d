//! Light on water.

use crate::{
    shader,
    tests::{engine, evaluate},
};

/// What waves mirror of the sun, summed over all directions above, is what Fresnel says of a mirror: energy is not made, and
/// of what single waves send on to others a few hundredths are lost at a high sun.
#[test]
fn waves_mirror_as_much_as_fresnel_says() {
    let engine = engine();
    let mut rows = Vec::new();
    for wind in [0.0_f32, 4.0, 10.0] {
        for deg in [90.0_f32, 60.0, 35.0] {
            rows.push([
                deg.to_radians().cos(),
                0.0,
                deg.to_radians().sin(),
                wind,
                0.0,
                0.0,
                0.0,
                0.0,
            ]);
        }
    }
    let statements = "for (var i = 0; i < 400; i++) {
            let mu = (f32(i) + 0.5) / 400.0;
            for (var k = 0; k < 400; k++) {
                let turn = (f32(k) + 0.5) / 400.0 * 6.2831853;
                let v = vec3f(sqrt(1.0 - mu * mu) * vec2f(cos(turn), sin(turn)), mu);
                x.x += mu * glitter(vec3f(0.0, 0.0, 1.0), v, a.xyz, slope_variance(a.w));
            }
        }
        x.x *= 6.2831853 / 160000.0 / a.z;
        x.y = reflectance(a.z);";
    let found = evaluate(&engine.gpu, &shader::GROUND_LIGHT, statements, &rows, &[]);
    for (row, found) in rows.iter().zip(found) {
        let share = found[0] / found[1];
        // A rough sea at a low sun mirrors less steeply than a flat one, and some waves hide others.
        assert!(
            (0.8..1.15).contains(&share),
            "{row:?}: {} of {}",
            found[0],
            found[1]
        );
    }
}
