//! Assets of a job: copied into the store when it is sent, and from there to each worker.

use crate::{JobError, JobId, Jobs, Store as Results, jobs::beside};
use bytes::Bytes;
use std::{collections::BTreeSet, sync::Arc};
use tempfile::TempDir;
use welkin_assets::{Kind, Limits, Name, Store, resolve};
use welkin_scene::{JobPlan, Scene, SceneAssets};

/// Names of all assets that a job's scenes refer to.
pub(crate) fn names_in(plan: &JobPlan) -> Result<BTreeSet<(Kind, Name)>, JobError> {
    let mut all = BTreeSet::new();
    for number in plan.scenes() {
        all.extend(named_by(&plan.frame(number)?.scene)?);
    }
    Ok(all)
}

/// As [`names_in`], of a job that was not yet sent.
///
/// # Errors
/// With the place in the scene, where one is not there.
pub(crate) fn named_in(plan: &JobPlan, shelf: Option<&Store>) -> Result<BTreeSet<(Kind, Name)>, JobError> {
    let mut all = BTreeSet::new();
    for number in plan.scenes() {
        let scene = plan.frame(number)?.scene;
        let named = named_by(&scene)?;
        if named.iter().any(|asset| !all.contains(asset)) {
            resolve(shelf, &scene)?;
            all.extend(named);
        }
    }
    Ok(all)
}

fn named_by(scene: &Scene) -> Result<Vec<(Kind, Name)>, JobError> {
    let references = scene.asset_references();
    let named = references.iter().map(|r| Ok((r.kind.into(), Name::new(r.name)?)));
    named.collect()
}

/// Copies an asset into the store of results, unless it is there.
pub(crate) async fn freeze(jobs: &Jobs, id: JobId, kind: Kind, name: &Name) -> Result<(), JobError> {
    let Some(shelf) = jobs.assets.clone() else {
        return Err(JobError::Damaged(
            "a job's assets were found, and are gone".into(),
        ));
    };
    let asset = name.clone();
    let file = beside(move || Ok(shelf.file(kind, &asset)?.1)).await?;
    jobs.store
        .put_new(&id.asset(kind, name), Bytes::from(file))
        .await?;
    Ok(())
}

/// A job's assets on this machine, gone with the last who has them.
pub(crate) struct Thawed {
    store: Option<Store>,
    _folder: Option<TempDir>,
}

/// Copies a job's assets here.
pub(crate) async fn thaw(
    results: &Results,
    id: JobId,
    named: BTreeSet<(Kind, Name)>,
) -> Result<Arc<Thawed>, JobError> {
    if named.is_empty() {
        return Ok(Arc::new(Thawed {
            store: None,
            _folder: None,
        }));
    }
    let folder =
        TempDir::with_prefix("welkin-job-").map_err(JobError::file("making a folder for a job's assets"))?;
    let limits = Limits {
        max_asset_bytes: u64::MAX,
        max_assets: u32::MAX,
        assets_bytes: u64::MAX,
    };
    let store = Arc::new(Store::open(folder.path(), limits)?);
    for (kind, name) in named {
        let path = id.asset(kind, &name);
        let file = results.get(&path).await?;
        let file =
            file.ok_or_else(|| JobError::Damaged(format!("{path} is missing in the store of results")))?;
        let store = Arc::clone(&store);
        beside(move || {
            store.put(kind, &name, &file, |_| true)?;
            Ok(())
        })
        .await?;
    }
    let store = Arc::into_inner(store);
    Ok(Arc::new(Thawed {
        store,
        _folder: Some(folder),
    }))
}

impl Thawed {
    /// What a scene takes of them.
    pub(crate) fn of(&self, scene: &Scene) -> Result<Arc<SceneAssets>, JobError> {
        Ok(resolve(self.store.as_ref(), scene)?)
    }
}
