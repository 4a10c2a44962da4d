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
    for reference in scene.weather_map_references() {
        let found = match (store, Name::new(reference.name)) {
            (Some(store), Ok(name)) => store.weather_picture(&name),
            (None, _) => {
                problems.push(problem(
                    &reference,
                    "a weather map in an asset store, and none is set up here: --assets names its folder"
                        .into(),
                    "there is no asset store".into(),
                ));
                continue;
            }
            (_, Err(error)) => Err(error),
        };
        match found {
            Ok(picture) => {
                assets.weather_maps.insert(reference.name.to_owned(), picture);
            }
            Err(error @ (Error::Folder { .. } | Error::Busy)) => return Err(error),
            Err(error) => problems.push(problem(&reference, allowed(store)?, error.to_string())),
        }
    }
    if problems.is_empty() {
        Ok(Arc::new(assets))
    } else {
        Err(SceneError::Invalid(problems).into())
    }
}

fn problem(reference: &AssetReference<'_>, allowed: String, reason: String) -> Problem {
    Problem {
        pointer: reference.pointer.into(),
        value: reference.name.into(),
        message: format!("`name` must be {allowed}, but is {:?}: {reason}", reference.name),
        allowed,
    }
}

fn allowed(store: Option<&Store>) -> Result<String, Error> {
    let assets = store.map_or_else(|| Ok(Vec::new()), |store| store.list(Kind::WeatherMaps))?;
    if assets.is_empty() {
        return Ok("a weather map in the asset store, which has none".into());
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
        "a weather map in the asset store: {}{more}",
        names.join(", ")
    ))
}
