//! The store as handlers use it: beside the asynchronous work, and with news of every change.

use crate::{error::Error, metrics, state::Service};
use std::sync::Arc;
use tokio::sync::watch;
use welkin_assets::{Store, resolve};
use welkin_scene::{Scene, SceneAssets};

/// Where assets are kept, if anywhere, and who wants to know when they change.
#[derive(Clone, Default)]
pub(crate) struct Shelf {
    store: Option<Arc<Store>>,
    changed: watch::Sender<()>,
}

impl Shelf {
    pub(crate) fn new(store: Arc<Store>) -> Self {
        let store = Some(store);
        let changed = watch::Sender::new(());
        Self { store, changed }
    }

    pub(crate) fn store(&self) -> Result<Arc<Store>, Error> {
        self.store.clone().ok_or(Error::NoAssets)
    }

    /// Tells operators how full the store is.
    pub(crate) fn count(&self) {
        match self.store.as_ref().map(|store| store.usage()) {
            Some(Ok(used)) => metrics::assets(used),
            Some(Err(error)) => tracing::warn!(%error, "assets are not counted"),
            None => {}
        }
    }

    /// Told after every change that this service makes.
    pub(crate) fn changes(&self) -> watch::Receiver<()> {
        self.changed.subscribe()
    }
}

impl Service {
    /// The same service with a place for assets.
    #[must_use]
    pub fn with_assets(mut self, store: impl Into<Arc<Store>>) -> Self {
        self.assets = Shelf::new(store.into());
        self
    }

    /// Reads the store.
    pub(crate) async fn read_assets<T: Send + 'static>(
        &self,
        read: impl FnOnce(&Store) -> Result<T, welkin_assets::Error> + Send + 'static,
    ) -> Result<T, Error> {
        let store = self.assets.store()?;
        beside(move || read(&store)).await
    }

    /// Changes the store, and tells who looks at it. The change is made to its end even where nobody waits for it.
    pub(crate) async fn change_assets<T: Send + 'static>(
        &self,
        change: impl FnOnce(&Store) -> Result<T, welkin_assets::Error> + Send + 'static,
    ) -> Result<T, Error> {
        let (shelf, store) = (self.assets.clone(), self.assets.store()?);
        beside(move || {
            let done = change(&store)?;
            shelf.changed.send_replace(());
            shelf.count();
            Ok(done)
        })
        .await
    }

    /// Everything that a scene takes from the store.
    pub(crate) async fn assets_of(&self, scene: &Scene) -> Result<Arc<SceneAssets>, Error> {
        if scene.asset_references().is_empty() {
            return Ok(Arc::default());
        }
        let (store, scene) = (self.assets.store.clone(), scene.clone());
        beside(move || resolve(store.as_deref(), &scene)).await
    }
}

async fn beside<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, welkin_assets::Error> + Send + 'static,
) -> Result<T, Error> {
    let done = tokio::task::spawn_blocking(work).await;
    let done = done.map_err(|e| Error::Internal {
        cause: format!("asset store: {e}"),
    })?;
    Ok(done?)
}
