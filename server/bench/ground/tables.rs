//! The tables that are measured, and the setups of each.

use super::{
    super::Size,
    scenes::{Light, Place, Relief},
};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use welkin_scene::Quality;

/// Those of the thesis.
pub(super) const THESIS_SIZES: [Size; 3] = [Size::new(800, 600), Size::new(1280, 720), Size::new(1920, 1080)];
/// Of the other tables.
pub(super) const OWN_SIZE: Size = Size::new(900, 600);

/// Squares of even numbers, see [`super::scenes::of_triangles`].
pub(super) const FEW_TRIANGLES: u32 = 99_856;
pub(super) const MANY_TRIANGLES: u32 = 1_000_000;

/// What one setup measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Table {
    /// Iniesta and Pérez 2015, table 6.1, the last block and what it adds to the one before.
    FinalApproach,
    /// What each kind of change costs, in mountains by seed.
    Ground,
    /// By the size of the shadow map.
    ShadowMaps,
    /// By the number of triangles.
    Triangles,
}

impl Table {
    pub(super) const ALL: [Self; 4] = [
        Self::FinalApproach,
        Self::Ground,
        Self::ShadowMaps,
        Self::Triangles,
    ];

    pub(super) const fn sizes(self) -> &'static [Size] {
        match self {
            Self::FinalApproach => &THESIS_SIZES,
            Self::Ground | Self::ShadowMaps | Self::Triangles => &[OWN_SIZE],
        }
    }

    /// Of each setup at a size.
    pub(super) fn parameters(self) -> Vec<Map<String, Value>> {
        let all = match self {
            Self::FinalApproach => {
                let mut all = Vec::new();
                for place in [Place::Ground, Place::Space] {
                    for relief in [Relief::Mountains, Relief::Town] {
                        for light in [Light::Plain, Light::Shadows, Light::ShadowsAndShafts] {
                            all.push(json!({"relief": relief, "place": place, "light": light}));
                        }
                    }
                }
                all
            }
            Self::Ground => {
                let mut all = Vec::new();
                for quality in [Quality::Preview, Quality::Final] {
                    for light in Light::ALL {
                        all.push(json!({"quality": quality, "light": light}));
                    }
                }
                all
            }
            Self::ShadowMaps => vec![json!({})],
            Self::Triangles => [FEW_TRIANGLES, MANY_TRIANGLES]
                .map(|count| json!({"triangles": count}))
                .into(),
        };
        let named = all.into_iter().map(|parameters| {
            let mut named = Map::from_iter([("table".to_owned(), json!(self))]);
            named.extend(parameters.as_object().cloned().unwrap_or_default());
            named
        });
        named.collect()
    }
}
