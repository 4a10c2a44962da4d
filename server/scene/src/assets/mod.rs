//! What a scene refers to by name, and what a renderer gets for it.

mod terrain;

pub use terrain::{HeightGrid, Material, MeshModel, Texture};

use crate::{
    clouds::{AssetMap, BlendMap, PlainMap, WeatherMap},
    document::Scene,
    terrain::Terrain,
};
use std::{collections::BTreeMap, fmt, sync::Arc};

/// Longest name of an asset, characters.
pub const MAX_NAME_CHARS: usize = 64;

/// True for `[a-z0-9][a-z0-9_-]{0,63}`, the names that assets have.
#[must_use]
pub fn is_asset_name(name: &str) -> bool {
    let letter_or_digit = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit();
    let bytes = name.as_bytes();
    bytes.len() <= MAX_NAME_CHARS
        && bytes.first().is_some_and(|&first| letter_or_digit(first))
        && bytes
            .iter()
            .all(|&byte| letter_or_digit(byte) || byte == b'_' || byte == b'-')
}

/// A weather map as a renderer gets it. Two of the same digest are the same picture.
#[derive(Clone)]
pub struct WeatherPicture {
    /// Width, pixels.
    pub width_px: u32,
    /// Height, pixels.
    pub height_px: u32,
    /// R, G, B, A of each pixel, rows from the top, as they stand in the file: no colour space is meant. A file
    /// without colour has its grey in R, G and B; one without alpha is opaque.
    pub rgba: Arc<[u8]>,
    /// SHA-256 of the file that the picture was read from.
    pub digest: [u8; 32],
}

impl fmt::Debug for WeatherPicture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            width_px, height_px, ..
        } = self;
        write!(
            f,
            "WeatherPicture({width_px} x {height_px}, {})",
            self.digest_hex()
        )
    }
}

/// Equal by digest, which is also shown.
macro_rules! known_by_digest {
    ($($asset:ident),*) => { $(
        impl PartialEq for $asset {
            fn eq(&self, other: &Self) -> bool {
                self.digest == other.digest
            }
        }

        impl Eq for $asset {}

        impl $asset {
            /// The digest in hexadecimal.
            #[must_use]
            pub fn digest_hex(&self) -> String {
                self.digest.iter().map(|byte| format!("{byte:02x}")).collect()
            }
        }
    )* };
}

known_by_digest!(WeatherPicture, HeightGrid, MeshModel);

/// The assets that a scene refers to, each under its name. Equal where every name stands for the same content.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SceneAssets {
    /// Weather maps.
    pub weather_maps: BTreeMap<String, Arc<WeatherPicture>>,
    /// Heightfields.
    pub heightfields: BTreeMap<String, Arc<HeightGrid>>,
    /// Meshes.
    pub meshes: BTreeMap<String, Arc<MeshModel>>,
}

impl SceneAssets {
    /// Equal to this, and holds no content: for comparing later.
    #[must_use]
    pub fn without_content(&self) -> Self {
        fn bare<T>(assets: &BTreeMap<String, Arc<T>>, bare: impl Fn(&T) -> T) -> BTreeMap<String, Arc<T>> {
            let each = assets.iter();
            each.map(|(name, asset)| (name.clone(), Arc::new(bare(asset))))
                .collect()
        }
        Self {
            weather_maps: bare(&self.weather_maps, |picture| WeatherPicture {
                rgba: Arc::default(),
                ..*picture
            }),
            heightfields: bare(&self.heightfields, |grid| HeightGrid {
                heights: Arc::default(),
                ..*grid
            }),
            meshes: bare(&self.meshes, |mesh| MeshModel {
                digest: mesh.digest,
                ..MeshModel::default()
            }),
        }
    }
}

/// What an asset is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AssetKind {
    /// A picture that spreads clouds.
    WeatherMap,
    /// Heights over a rectangle.
    Heightfield,
    /// Triangles.
    Mesh,
}

/// A place in a scene where an asset is named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AssetReference<'a> {
    /// What it is for.
    pub kind: AssetKind,
    /// The field that holds the name, as a JSON pointer in the scene.
    pub pointer: &'static str,
    /// The name.
    pub name: &'a str,
}

impl Scene {
    /// What the scene takes from the asset store, in the order of the document.
    #[must_use]
    pub fn asset_references(&self) -> Vec<AssetReference<'_>> {
        let mut found = Vec::new();
        match self.clouds.as_ref().map(|clouds| &clouds.weather_map) {
            Some(WeatherMap::Asset(AssetMap { name, .. })) => found.push(AssetReference {
                kind: AssetKind::WeatherMap,
                pointer: "/clouds/weather_map/name",
                name,
            }),
            Some(WeatherMap::Blend(BlendMap { from, to, .. })) => {
                found.extend(plain(from, "/clouds/weather_map/from/name"));
                found.extend(plain(to, "/clouds/weather_map/to/name"));
            }
            Some(WeatherMap::Procedural(_) | WeatherMap::Uniform(_)) | None => {}
        }
        let terrain = match &self.terrain {
            Some(Terrain::Heightfield(field)) => {
                field.name.as_ref().map(|name| (AssetKind::Heightfield, name))
            }
            Some(Terrain::Mesh(mesh)) => Some((AssetKind::Mesh, &mesh.name)),
            None => None,
        };
        found.extend(terrain.map(|(kind, name)| AssetReference {
            kind,
            pointer: "/terrain/name",
            name,
        }));
        found
    }
}

fn plain<'a>(map: &'a PlainMap, pointer: &'static str) -> Option<AssetReference<'a>> {
    match map {
        PlainMap::Asset(AssetMap { name, .. }) => Some(AssetReference {
            kind: AssetKind::WeatherMap,
            pointer,
            name,
        }),
        PlainMap::Procedural(_) | PlainMap::Uniform(_) => None,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use serde_json::json;

    #[test]
    fn names_are_those_that_the_schema_allows() {
        for name in ["a", "0", "front-2_b", &"x".repeat(64)] {
            assert!(is_asset_name(name), "{name}");
        }
        for name in [
            "",
            "-a",
            "_a",
            "A",
            "a.png",
            "a/b",
            "..",
            "ä",
            "a b",
            "a\0",
            &"x".repeat(65),
        ] {
            assert!(!is_asset_name(name), "{name:?}");
        }
    }

    #[test]
    fn without_their_content_assets_are_still_told_apart() {
        let assets = |digest: u8| SceneAssets {
            weather_maps: [(
                "front".to_owned(),
                Arc::new(WeatherPicture {
                    width_px: 1,
                    height_px: 1,
                    rgba: vec![0; 4].into(),
                    digest: [digest; 32],
                }),
            )]
            .into(),
            heightfields: [(
                "alps".to_owned(),
                Arc::new(HeightGrid {
                    width: 2,
                    height: 2,
                    heights: vec![0.0; 4].into(),
                    range_m: None,
                    extent_m: None,
                    digest: [digest / 2; 32],
                }),
            )]
            .into(),
            meshes: [(
                "town".to_owned(),
                Arc::new(MeshModel {
                    positions: vec![[0.0; 3]].into(),
                    digest: [digest / 4; 32],
                    ..MeshModel::default()
                }),
            )]
            .into(),
        };
        let bare = assets(0).without_content();
        assert!(bare.weather_maps["front"].rgba.is_empty());
        assert!(bare.heightfields["alps"].heights.is_empty());
        assert!(bare.meshes["town"].positions.is_empty());
        assert_eq!(bare, assets(0));
        for other in [1, 2, 4] {
            assert_ne!(assets(other).without_content(), assets(other ^ 7));
            assert_ne!(bare, assets(other));
        }
        assert_ne!(bare, SceneAssets::default());
    }

    #[test]
    fn references_are_found_wherever_a_map_may_stand() {
        let found = |map: serde_json::Value| {
            let scene = Scene::from_value(&json!({"clouds": {"weather_map": map}})).unwrap();
            let found = scene.asset_references();
            assert!(found.iter().all(|r| r.kind == AssetKind::WeatherMap));
            found
                .iter()
                .map(|r| (r.pointer, r.name.to_owned()))
                .collect::<Vec<_>>()
        };
        let asset = |name: &str| json!({"kind": "asset", "name": name});
        assert_eq!(found(json!({"kind": "procedural"})), []);
        assert_eq!(
            found(asset("front")),
            [("/clouds/weather_map/name", "front".to_owned())]
        );
        assert_eq!(
            found(json!({"kind": "blend", "from": asset("a"), "to": asset("b")})),
            [
                ("/clouds/weather_map/from/name", "a".to_owned()),
                ("/clouds/weather_map/to/name", "b".to_owned())
            ]
        );
        assert_eq!(
            found(json!({"kind": "blend", "from": {"kind": "uniform"}, "to": asset("b")})),
            [("/clouds/weather_map/to/name", "b".to_owned())]
        );
        let cloudless = Scene::from_value(&json!({"clouds": null})).unwrap();
        assert_eq!(cloudless.asset_references(), []);
        for (terrain, kind) in [
            (
                json!({"kind": "heightfield", "name": "alps"}),
                AssetKind::Heightfield,
            ),
            (json!({"kind": "mesh", "name": "alps"}), AssetKind::Mesh),
        ] {
            let scene = Scene::from_value(&json!({"clouds": null, "terrain": terrain})).unwrap();
            let reference = AssetReference {
                kind,
                pointer: "/terrain/name",
                name: "alps",
            };
            assert_eq!(scene.asset_references(), [reference]);
        }
        let made = Scene::from_value(&json!({"terrain": {"kind": "heightfield"}})).unwrap();
        assert_eq!(made.asset_references(), []);
    }
}
