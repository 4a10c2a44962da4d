//! The store: a folder with limits.

use crate::{
    Error, Facts, Form, Kind, Name,
    content::Content,
    contents::Contents,
    folder::{Entry, Folder},
    png_file,
    stamp::Stamp,
};
use serde::{Serialize, Serializer};
use sha2::{Digest, Sha256};
use std::{
    collections::HashMap,
    path::Path,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};
use welkin_scene::{HeightGrid, MeshModel, WeatherPicture};

/// How much the store takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Limits {
    /// The largest asset, bytes.
    pub max_asset_bytes: u64,
    /// Most assets, of all kinds together.
    pub max_assets: u32,
    /// All assets together, bytes.
    pub assets_bytes: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            max_asset_bytes: 64 << 20,
            max_assets: 1000,
            assets_bytes: 1 << 30,
        }
    }
}

/// How full the store is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Usage {
    /// Assets of all kinds.
    pub count: u32,
    /// What they take, bytes.
    pub bytes: u64,
}

/// An asset as it is listed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Asset {
    /// What it is for.
    pub kind: Kind,
    /// What scenes call it.
    pub name: Name,
    /// How the file holds it.
    #[serde(rename = "format")]
    pub form: Form,
    /// Size of the file, bytes.
    pub bytes: u64,
    /// SHA-256 of the file.
    #[serde(rename = "sha256", serialize_with = "hexadecimal")]
    pub digest: [u8; 32],
    /// What it holds.
    #[serde(flatten)]
    pub facts: Facts,
}

/// What became of a file that was put.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Put {
    /// There was none of that name.
    Created,
    /// It took the place of another, or was there already.
    Replaced,
}

/// The store. It may be used from several threads, and several stores may share a folder.
pub struct Store {
    folder: Folder,
    limits: Limits,
    known: Mutex<HashMap<(Kind, Name), (Stamp, Asset)>>,
    contents: Contents,
}

impl Store {
    /// Opens a folder that exists. What is in it stays, even where the limits are lower than that.
    ///
    /// # Errors
    /// [`Error::Folder`].
    pub fn open(folder: &Path, limits: Limits) -> Result<Self, Error> {
        Ok(Self {
            folder: Folder::open(folder)?,
            limits,
            known: Mutex::default(),
            contents: Contents::default(),
        })
    }

    /// How much the store takes.
    #[must_use]
    pub const fn limits(&self) -> Limits {
        self.limits
    }

    /// How full the store is.
    ///
    /// # Errors
    /// [`Error::Folder`].
    pub fn usage(&self) -> Result<Usage, Error> {
        let mut usage = Usage::default();
        for kind in Kind::ALL {
            for entry in self.folder.entries(kind)? {
                usage.count = usage.count.saturating_add(1);
                usage.bytes = usage.bytes.saturating_add(entry.bytes);
            }
        }
        Ok(usage)
    }

    /// All assets of a kind, in the order of their names. Files that cannot be used are left out, and told to the log.
    ///
    /// # Errors
    /// [`Error::Folder`].
    pub fn list(&self, kind: Kind) -> Result<Vec<Asset>, Error> {
        let entries = self.folder.entries(kind)?;
        let there = |name: &Name| entries.binary_search_by(|entry| entry.name.cmp(name)).is_ok();
        self.known().retain(|(of, name), _| *of != kind || there(name));
        let mut assets = Vec::new();
        for Entry { name, stamp, .. } in entries {
            match self.asset_with(kind, &name, stamp) {
                Ok(asset) => assets.extend(asset),
                Err(error @ Error::Folder { .. }) => return Err(error),
                Err(error) => tracing::warn!(%kind, %name, %error, "a file in the asset store is of no use"),
            }
        }
        Ok(assets)
    }

    /// What is known of an asset, if it is there.
    ///
    /// # Errors
    /// [`Error::Folder`]; where the file has come into the folder by another way than [`Self::put`], also those of
    /// files that are no assets.
    pub fn asset(&self, kind: Kind, name: &Name) -> Result<Option<Asset>, Error> {
        match self.folder.stamp(kind, name)? {
            Some(stamp) => self.asset_with(kind, name, stamp),
            None => Ok(None),
        }
    }

    /// The file as it was put.
    ///
    /// # Errors
    /// [`Error::Unknown`], and those of [`Self::asset`].
    pub fn file(&self, kind: Kind, name: &Name) -> Result<(Asset, Vec<u8>), Error> {
        let read = self.read(kind, name)?;
        read.ok_or_else(|| unknown(kind, name))
    }

    /// Stores a file, if it is an asset of its kind and `allowed` says yes to what stands there (its SHA-256).
    ///
    /// # Errors
    /// Those of files that are no assets; [`Error::Condition`] where it is not allowed; [`Error::Full`];
    /// [`Error::Folder`].
    pub fn put(
        &self,
        kind: Kind,
        name: &Name,
        file: &[u8],
        allowed: impl FnOnce(Option<&[u8; 32]>) -> bool,
    ) -> Result<(Asset, Put), Error> {
        let limit_bytes = self.limits.max_asset_bytes;
        if file.len() as u64 > limit_bytes {
            return Err(Error::TooLarge { limit_bytes });
        }
        let asset = self.describe(kind, name, file)?;
        if kind == Kind::WeatherMaps {
            self.contents.read::<WeatherPicture>(asset.digest, file)?;
        }
        let lock = self.folder.lock()?;
        let there = self.digest_for_condition(kind, name)?;
        if !allowed(there.as_ref()) {
            return Err(Error::Condition);
        }
        if there == Some(asset.digest) {
            return Ok((asset, Put::Replaced));
        }
        self.check_room(kind, name, file.len() as u64)?;
        self.folder.write(&lock, kind, name, asset.form, file)?;
        let put = if there.is_some() {
            Put::Replaced
        } else {
            Put::Created
        };
        Ok((asset, put))
    }

    /// Removes an asset, if `allowed` says yes to it (its SHA-256).
    ///
    /// # Errors
    /// [`Error::Unknown`]; [`Error::Condition`] where it is not allowed; [`Error::Folder`].
    pub fn delete(
        &self,
        kind: Kind,
        name: &Name,
        allowed: impl FnOnce(Option<&[u8; 32]>) -> bool,
    ) -> Result<(), Error> {
        let lock = self.folder.lock()?;
        let there = self.digest_for_condition(kind, name)?;
        if !allowed(there.as_ref()) {
            return Err(Error::Condition);
        }
        if there.is_none() {
            return Err(unknown(kind, name));
        }
        self.folder.remove(&lock, kind, name)
    }

    /// A weather map as a renderer wants it.
    ///
    /// # Errors
    /// [`Error::Unknown`], [`Error::Busy`], and those of [`Self::asset`].
    pub fn weather_picture(&self, name: &Name) -> Result<Arc<WeatherPicture>, Error> {
        self.content(Kind::WeatherMaps, name)
    }

    /// A heightfield as a renderer wants it.
    ///
    /// # Errors
    /// As [`Self::weather_picture`].
    pub fn height_grid(&self, name: &Name) -> Result<Arc<HeightGrid>, Error> {
        self.content(Kind::Heightfields, name)
    }

    /// A mesh as a renderer wants it.
    ///
    /// # Errors
    /// As [`Self::weather_picture`].
    pub fn mesh_model(&self, name: &Name) -> Result<Arc<MeshModel>, Error> {
        self.content(Kind::Meshes, name)
    }

    fn content<T: Content>(&self, kind: Kind, name: &Name) -> Result<Arc<T>, Error> {
        let asset = self.asset(kind, name)?.ok_or_else(|| unknown(kind, name))?;
        if let Some(found) = self.contents.find(&asset.digest) {
            return Ok(found);
        }
        let (asset, file) = self.file(kind, name)?;
        self.contents.read(asset.digest, &file)
    }

    /// What a file is. Of a picture its header tells; heights and triangles have to be read.
    fn describe(&self, kind: Kind, name: &Name, file: &[u8]) -> Result<Asset, Error> {
        let form = kind.form_of(file)?;
        let digest = Sha256::digest(file).into();
        let facts = match kind {
            Kind::WeatherMaps => Facts::Picture(png_file::facts(file)?),
            Kind::Heightfields => (&*self.contents.read::<HeightGrid>(digest, file)?).into(),
            Kind::Meshes => (&*self.contents.read::<MeshModel>(digest, file)?).into(),
        };
        Ok(Asset {
            kind,
            name: name.clone(),
            form,
            bytes: file.len() as u64,
            digest,
            facts,
        })
    }

    fn asset_with(&self, kind: Kind, name: &Name, stamp: Stamp) -> Result<Option<Asset>, Error> {
        let known = self.known().get(&(kind, name.clone())).cloned();
        match known {
            Some((then, asset)) if then == stamp => Ok(Some(asset)),
            _ => Ok(self.read(kind, name)?.map(|(asset, _)| asset)),
        }
    }

    fn read(&self, kind: Kind, name: &Name) -> Result<Option<(Asset, Vec<u8>)>, Error> {
        let Some((stamp, file)) = self.folder.read(kind, name, self.limits.max_asset_bytes)? else {
            return Ok(None);
        };
        let asset = self.describe(kind, name, &file)?;
        if stamp.is_settled() {
            self.known().insert((kind, name.clone()), (stamp, asset.clone()));
        }
        Ok(Some((asset, file)))
    }

    /// The digest of what stands there. A file that is no asset may be replaced or removed all the same, and is then
    /// like none that anybody may have in mind.
    fn digest_for_condition(&self, kind: Kind, name: &Name) -> Result<Option<[u8; 32]>, Error> {
        match self.asset(kind, name) {
            Ok(asset) => Ok(asset.map(|asset| asset.digest)),
            Err(error @ Error::Folder { .. }) => Err(error),
            Err(_) => Ok(Some([0; 32])),
        }
    }

    fn check_room(&self, kind: Kind, name: &Name, bytes: u64) -> Result<(), Error> {
        let Limits {
            max_assets,
            assets_bytes,
            ..
        } = self.limits;
        let replaced = self
            .folder
            .entries(kind)?
            .into_iter()
            .find(|entry| entry.name == *name);
        let used = self.usage()?;
        let count = used.count.saturating_sub(u32::from(replaced.is_some()));
        let others = used.bytes.saturating_sub(replaced.map_or(0, |entry| entry.bytes));
        if count >= max_assets {
            return Err(Error::Full {
                reason: format!("it may hold {max_assets} assets"),
            });
        }
        if others.saturating_add(bytes) > assets_bytes {
            return Err(Error::Full {
                reason: format!("it may hold {assets_bytes} bytes, {others} of which are taken by others"),
            });
        }
        Ok(())
    }

    fn known(&self) -> MutexGuard<'_, HashMap<(Kind, Name), (Stamp, Asset)>> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn unknown(kind: Kind, name: &Name) -> Error {
    Error::Unknown {
        kind,
        name: name.clone(),
    }
}

fn hexadecimal<S: Serializer>(digest: &[u8; 32], serializer: S) -> Result<S::Ok, S::Error> {
    let hex: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
    serializer.serialize_str(&hex)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use std::{fs, thread::sleep, time::Duration};

    fn pixel(grey: u8) -> Vec<u8> {
        let mut file = Vec::new();
        let mut writer = png::Encoder::new(&mut file, 1, 1).write_header().unwrap();
        writer.write_image_data(&[grey]).unwrap();
        writer.finish().unwrap();
        file
    }

    /// A new file may change once more within one step of the file system's clock, and is read each time; an old one
    /// is known by its stamp.
    #[test]
    fn a_file_is_known_once_its_stamp_tells_changes() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path(), Limits::default()).unwrap();
        let (kind, name) = (Kind::WeatherMaps, Name::new("map").unwrap());
        let (first, _) = store.put(kind, &name, &pixel(1), |_| true).unwrap();
        assert_eq!(store.asset(kind, &name).unwrap().as_ref(), Some(&first));
        assert!(store.known().is_empty());
        // Over the three seconds that a stamp needs to settle.
        sleep(Duration::from_millis(3200));
        assert_eq!(store.asset(kind, &name).unwrap().as_ref(), Some(&first));
        assert_eq!(store.known().len(), 1);
        fs::write(folder.path().join("weather-maps/map.png"), pixel(2)).unwrap();
        assert_ne!(store.asset(kind, &name).unwrap().unwrap().digest, first.digest);
        store.delete(kind, &name, |_| true).unwrap();
        assert!(store.asset(kind, &name).unwrap().is_none());
        assert!(store.list(kind).unwrap().is_empty() && store.known().is_empty());
    }
}
