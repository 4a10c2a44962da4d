//! The folder of assets: opened to serve, or looked into for one scene.

use super::Failure;
use crate::settings::Settings;
use std::{
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};
use welkin_assets::{Error, Store, resolve};
use welkin_scene::{Scene, SceneAssets};

/// The store, its folder made where there is none yet. A folder that nobody asked for by name is done without where
/// it cannot be had.
///
/// # Errors
/// Where the folder that was asked for cannot be made or opened.
pub(crate) fn store(settings: &Settings) -> Result<Option<Store>, Failure> {
    let Some(folder) = settings.assets_folder() else {
        return Ok(None);
    };
    match made(&folder, settings) {
        Ok(store) => Ok(Some(store)),
        Err(failure) if settings.named_assets_folder().is_some() => Err(failure),
        Err(failure) => {
            tracing::warn!("no assets are kept: {failure}");
            Ok(None)
        }
    }
}

fn made(folder: &Path, settings: &Settings) -> Result<Store, Failure> {
    let making = Failure::file(format!("making the folder {}", folder.display()));
    fs::create_dir_all(folder).map_err(making)?;
    Ok(Store::open(folder, settings.asset_limits())?)
}

/// Everything that a scene takes from the store. Nothing is opened for a scene that takes nothing.
///
/// # Errors
/// Where the scene names what there is not, or the folder cannot be read.
pub(crate) fn of_scene(settings: &Settings, scene: &Scene) -> Result<Arc<SceneAssets>, Failure> {
    if scene.asset_references().is_empty() {
        return Ok(Arc::default());
    }
    let there = |folder: &PathBuf| settings.named_assets_folder().is_some() || folder.exists();
    let folder = settings.assets_folder().filter(there);
    let open = |folder: PathBuf| Store::open(&folder, settings.asset_limits());
    let store = folder.map(open).transpose()?;
    Ok(resolve(store.as_ref(), scene)?)
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        match error {
            Error::Scene(error) => Self::Scene(error),
            other => Self::Assets(other),
        }
    }
}
