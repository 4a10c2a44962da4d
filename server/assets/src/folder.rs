//! The files of the store. Every path is one name within a folder that is open: none leads out, and a symbolic link
//! is as good as nothing.

use crate::{Error, Kind, Name, stamp::Stamp};
use cap_fs_ext::{DirExt, FollowSymlinks, OpenOptionsFollowExt};
use cap_std::{
    ambient_authority,
    fs::{Dir, Metadata, OpenOptions},
};
use cap_tempfile::TempFile;
use std::{
    fs::File,
    io::{self, ErrorKind, Read, Write},
    path::Path,
};

/// Held by who changes something, whichever process that is.
const LOCK: &str = ".lock";

/// The open folder.
pub(crate) struct Folder {
    root: Dir,
}

/// While it lives, nobody else changes the folder.
pub(crate) struct Lock(#[expect(dead_code, reason = "closing the file gives the lock back")] File);

/// A file of the store, before it is read.
pub(crate) struct Entry {
    pub(crate) name: Name,
    pub(crate) bytes: u64,
    pub(crate) stamp: Stamp,
}

impl Folder {
    pub(crate) fn open(path: &Path) -> Result<Self, Error> {
        let opening = || format!("opening the folder {}", path.display());
        let root = Dir::open_ambient_dir(path, ambient_authority()).map_err(Error::folder(opening()))?;
        Ok(Self { root })
    }

    pub(crate) fn lock(&self) -> Result<Lock, Error> {
        let mut options = OpenOptions::new();
        options
            .read(true)
            .write(true)
            .create(true)
            .follow(FollowSymlinks::No);
        let file = self
            .root
            .open_with(LOCK, &options)
            .map(cap_std::fs::File::into_std);
        let locked = file.and_then(|file| file.lock().map(|()| file));
        locked.map(Lock).map_err(Error::folder("locking the folder"))
    }

    /// The files of a kind, in the order of their names. What is none of ours is passed over.
    pub(crate) fn entries(&self, kind: Kind) -> Result<Vec<Entry>, Error> {
        let listing = || Error::folder(format!("listing the {kind}"));
        let Some(folder) = self.of_kind(kind)? else {
            return Ok(Vec::new());
        };
        let mut found = Vec::new();
        for entry in folder.entries().map_err(listing())? {
            let file_name = entry.map_err(listing())?.file_name();
            let stem = file_name
                .to_str()
                .and_then(|name| name.strip_suffix(kind.ending()));
            if let Some(name) = stem.and_then(|stem| Name::new(stem).ok())
                && let Some(metadata) = file_metadata(&folder, &name, kind).map_err(listing())?
            {
                found.push(Entry {
                    name,
                    bytes: metadata.len(),
                    stamp: Stamp::of(&metadata),
                });
            }
        }
        found.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(found)
    }

    /// What the system tells of a file, if it is there.
    pub(crate) fn stamp(&self, kind: Kind, name: &Name) -> Result<Option<Stamp>, Error> {
        let Some(folder) = self.of_kind(kind)? else {
            return Ok(None);
        };
        let metadata = file_metadata(&folder, name, kind);
        let metadata = metadata.map_err(Error::folder(format!("looking for {name} among the {kind}")))?;
        Ok(metadata.as_ref().map(Stamp::of))
    }

    /// A file as it was at one moment, if it is there.
    pub(crate) fn read(
        &self,
        kind: Kind,
        name: &Name,
        limit_bytes: u64,
    ) -> Result<Option<(Stamp, Vec<u8>)>, Error> {
        let reading = || Error::folder(format!("reading {name} of the {kind}"));
        let Some(folder) = self.of_kind(kind)? else {
            return Ok(None);
        };
        // Opening something else than a file, a pipe for example, could wait for ever.
        if file_metadata(&folder, name, kind).map_err(reading())?.is_none() {
            return Ok(None);
        }
        let mut options = OpenOptions::new();
        options.read(true).follow(FollowSymlinks::No);
        let Some(file) =
            unless_missing(folder.open_with(file_name(name, kind), &options)).map_err(reading())?
        else {
            return Ok(None);
        };
        let metadata = file.metadata().map_err(reading())?;
        let mut bytes = Vec::new();
        file.take(limit_bytes + 1)
            .read_to_end(&mut bytes)
            .map_err(reading())?;
        if bytes.len() as u64 > limit_bytes {
            return Err(Error::TooLarge { limit_bytes });
        }
        Ok(Some((Stamp::of(&metadata), bytes)))
    }

    /// Puts a file in its place in one step: who reads meanwhile gets the old one or the new one, whole. It is on
    /// the disk when this returns.
    pub(crate) fn write(&self, _lock: &Lock, kind: Kind, name: &Name, bytes: &[u8]) -> Result<(), Error> {
        let writing = || Error::folder(format!("writing {name} of the {kind}"));
        let folder = match self.of_kind(kind)? {
            Some(folder) => folder,
            None => {
                self.root.create_dir(kind.name()).map_err(writing())?;
                self.root.open_dir_nofollow(kind.name()).map_err(writing())?
            }
        };
        let mut file = TempFile::new(&folder).map_err(writing())?;
        file.write_all(bytes).map_err(writing())?;
        file.as_file().sync_all().map_err(writing())?;
        file.replace(file_name(name, kind)).map_err(writing())?;
        settle(&folder).map_err(writing())
    }

    /// Removes a file. What is removed already is no error.
    pub(crate) fn remove(&self, _lock: &Lock, kind: Kind, name: &Name) -> Result<(), Error> {
        let removing = || Error::folder(format!("removing {name} of the {kind}"));
        let Some(folder) = self.of_kind(kind)? else {
            return Ok(());
        };
        unless_missing(folder.remove_file(file_name(name, kind))).map_err(removing())?;
        settle(&folder).map_err(removing())
    }

    fn of_kind(&self, kind: Kind) -> Result<Option<Dir>, Error> {
        let opened = unless_missing(self.root.open_dir_nofollow(kind.name()));
        opened.map_err(Error::folder(format!("opening the folder of the {kind}")))
    }
}

fn file_name(name: &Name, kind: Kind) -> String {
    format!("{name}{}", kind.ending())
}

/// Of files only: links, folders and pipes are none of ours.
fn file_metadata(folder: &Dir, name: &Name, kind: Kind) -> io::Result<Option<Metadata>> {
    let metadata = unless_missing(folder.symlink_metadata(file_name(name, kind)))?;
    Ok(metadata.filter(Metadata::is_file))
}

fn unless_missing<T>(found: io::Result<T>) -> io::Result<Option<T>> {
    match found {
        Ok(found) => Ok(Some(found)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}

/// Waits until names as they are now are on the disk.
#[cfg(unix)]
fn settle(folder: &Dir) -> io::Result<()> {
    // The open folder is but a path to the system; opened for reading, it can be synchronised.
    folder.open(".")?.sync_all()
}

/// Elsewhere folders cannot be synchronised.
#[cfg(not(unix))]
fn settle(_: &Dir) -> io::Result<()> {
    Ok(())
}
