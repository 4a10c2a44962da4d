//! What covers the ground, as the shaders take it.

use crate::uniforms::{ground::SkinUniform, narrow, narrow3};
use welkin_scene::{
    Scene, SphereSurface, Terrain,
    terrain::{GroundAlbedo, SurfaceBands},
};

/// Of a scene's terrain and of the sphere about it.
pub(crate) fn skin(scene: &Scene) -> SkinUniform {
    let sphere = narrow3(scene.planet.ground_albedo);
    let water = if wind_m_s(scene).is_some() { 1.0 } else { 0.0 };
    let Some(Terrain::Heightfield(field)) = &scene.terrain else {
        return SkinUniform {
            sphere,
            water,
            ..SkinUniform::default()
        };
    };
    let phong = field.surface.phong;
    // A plain albedo is bands of one colour.
    let (bands, mottled) = match &field.surface.albedo {
        GroundAlbedo::Bands(bands) => (bands.clone(), 1.0),
        GroundAlbedo::Plain(plain) => {
            let even = SurfaceBands {
                grass: plain.rgb,
                rock: plain.rgb,
                snow: plain.rgb,
                ..SurfaceBands::default()
            };
            (even, 0.0)
        }
    };
    let cosine = |deg: f64| narrow(deg.to_radians().cos());
    SkinUniform {
        grass: narrow3(bands.grass),
        grass_line_m: narrow(bands.grass_line_m),
        rock: narrow3(bands.rock),
        snow_line_m: narrow(bands.snow_line_m),
        snow: narrow3(bands.snow),
        line_width_m: narrow(bands.line_width_m),
        grass_cosine: cosine(bands.rock_slope_deg),
        snow_cosine: cosine(bands.snow_slope_deg),
        ambient: narrow(phong.ambient),
        diffuse: narrow(phong.diffuse),
        specular: narrow(phong.specular),
        shininess: narrow(phong.shininess),
        sphere,
        fade: narrow(field.edge_fade),
        mottled,
        water,
    }
}

/// Over a sphere of water; none over one of ground.
pub(crate) fn wind_m_s(scene: &Scene) -> Option<f32> {
    match scene.planet.surface {
        SphereSurface::Water(water) => Some(narrow(water.wind_m_s)),
        SphereSurface::Ground {} => None,
    }
}
