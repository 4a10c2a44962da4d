//! That no uniform goes without its test.

use crate::shader;

/// What the shaders bind as uniforms, so that a new one cannot go without a test.
#[test]
fn every_uniform_is_tested() {
    let mut names = Vec::new();
    let shaders = [
        &shader::TRANSMITTANCE,
        &shader::MULTI_SCATTERING,
        &shader::SKY_VIEW,
        &shader::AERIAL,
        &shader::CLOUD_AIR,
        &shader::CLOUD_VOLUME,
        &shader::CLOUD_SHADOW,
        &shader::CLOUD_VIEW,
        &shader::CLOUD_VIEW_LIGHT,
        &shader::CLOUD_DOME,
        &shader::CLOUD_DOME_LIGHT,
        &shader::SKY,
        &shader::STARS,
        &shader::EXPOSURE,
        &shader::TONE,
        &shader::PROBE,
    ];
    for shader in shaders {
        let module = naga::front::wgsl::parse_str(shader.wgsl).unwrap();
        for (_, variable) in module.global_variables.iter() {
            if variable.space == naga::AddressSpace::Uniform {
                names.push((shader.name, module.types[variable.ty].name.clone().unwrap()));
            }
        }
    }
    let expected = [
        ("transmittance", "Air"),
        ("transmittance", "Integral"),
        ("multi_scattering", "Air"),
        ("multi_scattering", "Order"),
        ("sky_view", "Air"),
        ("sky_view", "Observer"),
        ("aerial", "Air"),
        ("aerial", "Observer"),
        ("cloud_air", "Air"),
        ("cloud_air", "View"),
        ("cloud_air", "CloudShade"),
        ("cloud_air", "CloudFrame"),
        ("cloud_volume", "Clouds"),
        ("cloud_shadow", "CloudShade"),
        ("cloud_shadow", "Shadow"),
        ("cloud_shadow", "Clouds"),
        ("cloud_view", "Camera"),
        ("cloud_view", "Tile"),
        ("cloud_view", "Observer"),
        ("cloud_view", "View"),
        ("cloud_view", "Air"),
        ("cloud_view", "Clouds"),
        ("cloud_view_light", "Camera"),
        ("cloud_view_light", "Tile"),
        ("cloud_view_light", "Observer"),
        ("cloud_view_light", "View"),
        ("cloud_view_light", "Air"),
        ("cloud_view_light", "Clouds"),
        ("cloud_view_light", "CloudShade"),
        ("cloud_view_light", "GroundShadow"),
        ("cloud_dome", "View"),
        ("cloud_dome", "Air"),
        ("cloud_dome", "Clouds"),
        ("cloud_dome", "Dome"),
        ("cloud_dome", "Observer"),
        ("cloud_dome_light", "View"),
        ("cloud_dome_light", "Air"),
        ("cloud_dome_light", "Clouds"),
        ("cloud_dome_light", "CloudShade"),
        ("cloud_dome_light", "GroundShadow"),
        ("cloud_dome_light", "Dome"),
        ("cloud_dome_light", "Observer"),
        ("sky", "Air"),
        ("sky", "View"),
        ("sky", "Camera"),
        ("sky", "Tile"),
        ("sky", "Observer"),
        ("sky", "Airglow"),
        ("sky", "Moon"),
        ("sky", "View"),
        ("sky", "Tone"),
        ("sky", "CloudShade"),
        ("sky", "CloudFrame"),
        ("sky", "Dome"),
        ("stars", "Air"),
        ("stars", "View"),
        ("stars", "Stretch"),
        ("stars", "Dome"),
        ("exposure", "Meter"),
        ("tone", "Tone"),
        ("probe", "Air"),
        ("probe", "View"),
        ("probe", "Observer"),
        ("probe", "Airglow"),
        ("probe", "Moon"),
        ("probe", "View"),
        ("probe", "Observer"),
        ("probe", "CloudShade"),
        ("probe", "CloudFrame"),
    ];
    let mut expected = expected.map(|(shader, name)| (shader, name.to_owned()));
    // The linker puts what is imported in an order of its own.
    names.sort();
    expected.sort();
    assert_eq!(names, expected);
}
