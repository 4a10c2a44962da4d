//! The scenes that are measured, with the meshes that stand in them.

use super::{mountains, town};
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use welkin_scene::{
    Camera, Direction, Method, Projection, Scene, Shafts, SunPosition, Terrain,
    assets::{MeshModel, SceneAssets},
    preset,
    shafts::{ExactShafts, RadialShafts},
    terrain::{Heightfield, Mesh, Shadow, ShadowMap, UpAxis},
};

/// Of each of the thesis' integrals.
const STEPS: u32 = 30;
const VERTICAL_FOV_DEG: f64 = 60.0;
/// Before the observer at the right, so that ridges stand in its light and shafts in view.
const SUN_AZIMUTH_DEG: f64 = 25.0;
const SUN_ELEVATION_DEG: f64 = 12.0;

/// Where the camera is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Place {
    /// Near the ground, looking at the horizon.
    Ground,
    /// In space, with a part of the planet and its limb in sight.
    Space,
}

/// The thesis' meshes, by their numbers of triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Relief {
    /// 97,650.
    Mountains,
    /// 11,820.
    Town,
}

/// What hides the sun.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Light {
    /// Nothing does.
    Plain,
    /// The terrain from the ground, by a map.
    Shadows,
    /// And from the air.
    ShadowsAndShafts,
    /// In the air only as a glow smeared over the picture.
    RadialShafts,
}

impl Light {
    pub(super) const ALL: [Self; 4] = [
        Self::Plain,
        Self::Shadows,
        Self::ShadowsAndShafts,
        Self::RadialShafts,
    ];

    fn shadow(self) -> Option<Shadow> {
        (self != Self::Plain).then(|| Shadow::Map(ShadowMap::default()))
    }

    fn shafts(self, steps: Option<u32>) -> Option<Shafts> {
        match self {
            Self::Plain | Self::Shadows => None,
            Self::ShadowsAndShafts => Some(Shafts::Exact(
                steps.map_or_else(ExactShafts::default, |steps| ExactShafts { steps }),
            )),
            Self::RadialShafts => Some(Shafts::Radial(RadialShafts::default())),
        }
    }
}

/// A scene with what it names.
pub(super) struct Staged {
    pub(super) scene: Scene,
    pub(super) assets: Arc<SceneAssets>,
}

/// The thesis' own scene by day and its last method: a table of the air, shadows by a map, shafts. It draws no disc, and
/// nothing of the night, which is seen from space by day too.
pub(super) fn thesis(relief: Relief, place: Place, light: Light) -> Staged {
    let mut scene = preset("complutense")
        .map(|preset| preset.scene.clone())
        .unwrap_or_default();
    scene.sun.disc = false;
    (scene.moon, scene.stars) = (None, None);
    if let Some(air) = &mut scene.atmosphere {
        air.method = Method::Table;
        air.airglow = None;
        (air.view_steps, air.sun_steps) = (Some(STEPS), Some(STEPS));
    }
    scene.shafts = light.shafts(Some(STEPS));
    let (model, side_m) = match relief {
        // 225 × 217 cells.
        Relief::Mountains => (mountains::mountains(225, 217), mountains::SIDE_M),
        Relief::Town => (town::town(), town::SIDE_M),
    };
    // At its southern edge, or from 400 km where a line 30° down meets the ground.
    let (north_m, height_m, elevation_deg) = match place {
        Place::Ground => (0.55 * f64::from(side_m), 2.0, 0.0),
        Place::Space => (8e5, 4e5, -30.0),
    };
    stand(&mut scene, height_m, elevation_deg);
    with_mesh(scene, model, north_m, light)
}

/// Mountains with that many triangles in our own default air.
pub(super) fn of_triangles(count: u32) -> Staged {
    let mut scene = Scene::clear();
    scene.shafts = Light::ShadowsAndShafts.shafts(None);
    stand(&mut scene, 2.0, 5.0);
    // Half as many rows as columns, and two triangles a cell.
    let columns = count.isqrt();
    let model = mountains::mountains(columns, columns / 2);
    with_mesh(
        scene,
        model,
        0.3 * f64::from(mountains::SIDE_M),
        Light::ShadowsAndShafts,
    )
}

/// In a valley of the default mountains, under a clear sky.
pub(super) fn by_seed(light: Light) -> Staged {
    let mut scene = Scene::clear();
    scene.shafts = light.shafts(None);
    stand(&mut scene, 100.0, 5.0);
    scene.terrain = Some(Terrain::Heightfield(Heightfield {
        shadow: light.shadow(),
        ..Heightfield::default()
    }));
    Staged {
        scene,
        assets: Arc::default(),
    }
}

fn stand(scene: &mut Scene, height_m: f64, elevation_deg: f64) {
    scene.sun.position = SunPosition::Direction(Direction::angles(SUN_AZIMUTH_DEG, SUN_ELEVATION_DEG));
    scene.camera = Camera {
        position_m: [0.0, 0.0, height_m],
        direction: Direction::angles(0.0, elevation_deg),
        projection: Projection::Perspective {
            vertical_fov_deg: VERTICAL_FOV_DEG,
        },
        ..Camera::default()
    };
}

fn with_mesh(mut scene: Scene, model: MeshModel, north_m: f64, light: Light) -> Staged {
    let name = "relief".to_owned();
    scene.terrain = Some(Terrain::Mesh(Mesh {
        name: name.clone(),
        scale: 1.0,
        position_m: [0.0, north_m, 0.0],
        azimuth_deg: 0.0,
        up_axis: UpAxis::Y,
        phong: None,
        shadow: light.shadow(),
    }));
    Staged {
        scene,
        assets: Arc::new(SceneAssets {
            meshes: [(name, Arc::new(model))].into(),
            ..SceneAssets::default()
        }),
    }
}
