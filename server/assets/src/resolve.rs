//! From the names in a scene to what they stand for.

use crate::{Error, Kind, Name, Store};
use std::sync::Arc;
use welkin_scene::{
    AssetReference, Scene, SceneAssets,
    problem::{Problem, SceneError},
};

/// Names that an error lists.
const NAMES_TOLD: usize = 8;

/// Everything that a scene takes from the store.
///
/// # Errors
/// [`Error::Scene`], with the field of each name that stands for nothing; [`Error::Busy`]; [`Error::Folder`].
pub fn resolve(store: Option<&Store>, scene: &Scene) -> Result<Arc<SceneAssets>, Error> {
    let mut assets = SceneAssets::default();
    let mut problems = Vec::new();
    for reference in scene.asset_references() {
        let kind = Kind::from(reference.kind);
        let Some(store) = store else {
            let allowed = format!(
                "{} in an asset store, and none is set up here: --assets names its folder",
                kind.noun()
            );
            problems.push(problem(&reference, allowed, "there is no asset store".into()));
            continue;
        };
        match take(store, kind, reference.name, &mut assets) {
            Ok(()) => {}
            Err(error @ (Error::Folder { .. } | Error::Busy)) => return Err(error),
            Err(error) => problems.push(problem(&reference, allowed(store, kind)?, error.to_string())),
        }
    }
    if problems.is_empty() {
        Ok(Arc::new(assets))
    } else {
        Err(SceneError::Invalid(problems).into())
    }
}

fn take(store: &Store, kind: Kind, name: &str, assets: &mut SceneAssets) -> Result<(), Error> {
    let (asset, key) = (Name::new(name)?, name.to_owned());
    match kind {
        Kind::WeatherMaps => drop(assets.weather_maps.insert(key, store.weather_picture(&asset)?)),
        Kind::Heightfields => drop(assets.heightfields.insert(key, store.height_grid(&asset)?)),
        Kind::Meshes => drop(assets.meshes.insert(key, store.mesh_model(&asset)?)),
    }
    Ok(())
}

fn problem(reference: &AssetReference<'_>, allowed: String, reason: String) -> Problem {
    Problem {
        pointer: reference.pointer.into(),
        value: reference.name.into(),
        message: format!("`name` must be {allowed}, but is {:?}: {reason}", reference.name),
        allowed,
    }
}

fn allowed(store: &Store, kind: Kind) -> Result<String, Error> {
    let assets = store.list(kind)?;
    if assets.is_empty() {
        return Ok(format!("{} in the asset store, which has none", kind.noun()));
    }
    let names: Vec<_> = assets
        .iter()
        .take(NAMES_TOLD)
        .map(|asset| asset.name.as_str())
        .collect();
    let more = match assets.len() - names.len() {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    Ok(format!(
        "{} in the asset store: {}{more}",
        kind.noun(),
        names.join(", ")
    ))
}
