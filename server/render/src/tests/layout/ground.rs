//! The uniforms of what stands on the ground.

use super::{Filled, check};
use crate::{
    shader,
    uniforms::{Part, ground::GroundShadowUniform},
};

#[test]
fn ground_shadow() {
    let mut f = Filled::default();
    let part = Part::new(&GroundShadowUniform {
        right: f.vec3("right"),
        size_px: f.u32("size_px"),
        up: f.vec3("up"),
        lift_px: f.f32("lift_px"),
        light: f.vec3("light"),
        middle_m: f.vec3("middle_m"),
        half_m: f.vec3("half_m"),
    });
    let shaders = [
        &shader::GROUND_SHADOW,
        &shader::GROUND_VIEW,
        &shader::SHAFTS,
        &shader::CLOUD_VIEW_LIGHT,
        &shader::CLOUD_DOME_LIGHT,
        &shader::CLOUD_PROBE,
    ];
    check(&shaders, "GroundShadow", &part, &f);
}
