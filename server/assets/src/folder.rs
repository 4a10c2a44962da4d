//! The files of the store. Every path is one name within a folder that is open: none leads out, and a symbolic link
//! is as good as nothing.

use crate::{Error, Form, Kind, Name, bundle, stamp::Stamp, tree};
use cap_fs_ext::{DirExt, FollowSymlinks, OpenOptionsFollowExt};
use cap_std::{
    ambient_authority,
    fs::{Dir, OpenOptions},
};
use cap_tempfile::TempFile;
use std::{
    collections::BTreeSet,
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
        let mut names = BTreeSet::new();
        for entry in folder.entries().map_err(listing())? {
            let file_name = entry.map_err(listing())?.file_name();
            let stem = file_name.to_str().and_then(|name| stem(kind, name));
            names.extend(stem.and_then(|stem| Name::new(stem).ok()));
        }
        let mut found = Vec::new();
        for name in names {
            if let Some((_, stamp)) = place(&folder, &name, kind).map_err(listing())? {
                found.push(Entry {
                    name,
                    bytes: stamp.bytes(),
                    stamp,
                });
            }
        }
        Ok(found)
    }

    /// What the system tells of a file, if it is there.
    pub(crate) fn stamp(&self, kind: Kind, name: &Name) -> Result<Option<Stamp>, Error> {
        let Some(folder) = self.of_kind(kind)? else {
            return Ok(None);
        };
        let found = place(&folder, name, kind);
        let found = found.map_err(Error::folder(format!("looking for {name} among the {kind}")))?;
        Ok(found.map(|(_, stamp)| stamp))
    }

    /// A file as it was at one moment, if it is there; of a folder, all its files packed into one.
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
        let Some((place, stamp)) = place(&folder, name, kind).map_err(reading())? else {
            return Ok(None);
        };
        let found = match place {
            Place::File(file_name) => {
                unless_missing(read_file(&folder, &file_name, limit_bytes)).map_err(reading())?
            }
            Place::Folder(inner) => {
                let packed = tree::packed(&inner, limit_bytes).map_err(reading())?;
                match packed {
                    Some(files) => Some((stamp, bundle::pack(&files)?)),
                    None => return Err(Error::TooLarge { limit_bytes }),
                }
            }
        };
        if let Some((_, bytes)) = &found
            && bytes.len() as u64 > limit_bytes
        {
            return Err(Error::TooLarge { limit_bytes });
        }
        Ok(found)
    }

    /// Puts a file in its place in one step: who reads meanwhile gets the old one or the new one, whole. It is on
    /// the disk when this returns.
    pub(crate) fn write(
        &self,
        _lock: &Lock,
        kind: Kind,
        name: &Name,
        form: Form,
        bytes: &[u8],
    ) -> Result<(), Error> {
        let writing = || Error::folder(format!("writing {name} of the {kind}"));
        let folder = match self.of_kind(kind)? {
            Some(folder) => folder,
            None => {
                self.root.create_dir(kind.name()).map_err(writing())?;
                self.root.open_dir_nofollow(kind.name()).map_err(writing())?
            }
        };
        let file_name = format!("{name}{}", form.endings()[0]);
        let mut file = TempFile::new(&folder).map_err(writing())?;
        file.write_all(bytes).map_err(writing())?;
        file.as_file().sync_all().map_err(writing())?;
        file.replace(&file_name).map_err(writing())?;
        remove_all(&folder, name, kind, Some(&file_name)).map_err(writing())?;
        settle(&folder).map_err(writing())
    }

    /// Removes a file. What is removed already is no error.
    pub(crate) fn remove(&self, _lock: &Lock, kind: Kind, name: &Name) -> Result<(), Error> {
        let removing = || Error::folder(format!("removing {name} of the {kind}"));
        let Some(folder) = self.of_kind(kind)? else {
            return Ok(());
        };
        remove_all(&folder, name, kind, None).map_err(removing())?;
        settle(&folder).map_err(removing())
    }

    fn of_kind(&self, kind: Kind) -> Result<Option<Dir>, Error> {
        let opened = unless_missing(self.root.open_dir_nofollow(kind.name()));
        opened.map_err(Error::folder(format!("opening the folder of the {kind}")))
    }
}

/// Where an asset is.
enum Place {
    File(String),
    Folder(Dir),
}

/// The name of the asset that a file of this name would be.
fn stem(kind: Kind, file_name: &str) -> Option<&str> {
    let mut endings = kind.forms().iter().flat_map(|form| form.endings());
    let stem = endings.find_map(|ending| file_name.strip_suffix(ending));
    stem.or_else(|| kind.has_folders().then_some(file_name))
}

/// Names that an asset's file may have; of several that are there, the first counts.
fn file_names(name: &Name, kind: Kind) -> impl Iterator<Item = String> {
    let endings = kind.forms().iter().flat_map(|form| form.endings());
    endings.map(move |ending| format!("{name}{ending}"))
}

/// Files first, then a folder. Links, pipes, and folders elsewhere are none of ours.
fn place(folder: &Dir, name: &Name, kind: Kind) -> io::Result<Option<(Place, Stamp)>> {
    for file_name in file_names(name, kind) {
        if let Some(metadata) = unless_missing(folder.symlink_metadata(&file_name))?
            && metadata.is_file()
        {
            return Ok(Some((Place::File(file_name), Stamp::of(&metadata))));
        }
    }
    if kind.has_folders()
        && let Some(metadata) = unless_missing(folder.symlink_metadata(name.as_str()))?
        && metadata.is_dir()
        && let Some(inner) = unless_missing(folder.open_dir_nofollow(name.as_str()))?
    {
        let stamp = tree::stamp(&inner)?;
        return Ok(Some((Place::Folder(inner), stamp)));
    }
    Ok(None)
}

/// One byte more than the limit, where there are more.
pub(crate) fn read_file(folder: &Dir, file_name: &str, limit_bytes: u64) -> io::Result<(Stamp, Vec<u8>)> {
    let mut options = OpenOptions::new();
    options.read(true).follow(FollowSymlinks::No);
    let file = folder.open_with(file_name, &options)?;
    let stamp = Stamp::of(&file.metadata()?);
    let mut bytes = Vec::new();
    file.take(limit_bytes.saturating_add(1)).read_to_end(&mut bytes)?;
    Ok((stamp, bytes))
}

/// Removes whatever stands for an asset, but for the file that is named.
fn remove_all(folder: &Dir, name: &Name, kind: Kind, kept: Option<&str>) -> io::Result<()> {
    for file_name in file_names(name, kind).filter(|file_name| kept != Some(file_name)) {
        if let Some(metadata) = unless_missing(folder.symlink_metadata(&file_name))?
            && metadata.is_file()
        {
            unless_missing(folder.remove_file(&file_name))?;
        }
    }
    if kind.has_folders()
        && let Some(metadata) = unless_missing(folder.symlink_metadata(name.as_str()))?
        && metadata.is_dir()
    {
        unless_missing(folder.remove_dir_all(name.as_str()))?;
    }
    Ok(())
}

pub(crate) fn unless_missing<T>(found: io::Result<T>) -> io::Result<Option<T>> {
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
