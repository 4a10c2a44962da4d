//! Several files in one: a zip, or a folder that is packed into one when it is read.

use crate::Error;
use std::{
    cell::{Cell, RefCell},
    io::{Cursor, Read, Write},
};
use zip::{CompressionMethod, ZipArchive, ZipWriter, write::SimpleFileOptions};

/// Most files in one.
pub(crate) const MOST_FILES: usize = 1000;
/// All that is unpacked of one, bytes.
const MOST_UNPACKED_BYTES: u64 = 512 << 20;

/// The files of a zip, unpacked one by one.
pub(crate) struct Bundle<'a> {
    archive: RefCell<ZipArchive<Cursor<&'a [u8]>>>,
    /// Paths with `/`, each with its place in the archive.
    files: Vec<(String, usize)>,
    /// What may still be unpacked, bytes.
    left_bytes: Cell<u64>,
}

impl<'a> Bundle<'a> {
    /// Reads the list of files; all of them must lie within.
    pub(crate) fn open(file: &'a [u8]) -> Result<Self, Error> {
        let mut archive = ZipArchive::new(Cursor::new(file)).map_err(Error::damaged)?;
        if archive.len() > MOST_FILES {
            return Err(Error::refused(format!(
                "the zip holds {} files, and may hold {MOST_FILES}",
                archive.len()
            )));
        }
        let mut files = Vec::new();
        for i in 0..archive.len() {
            let entry = archive.by_index_raw(i).map_err(Error::damaged)?;
            let path = entry.name().map_err(Error::damaged)?.replace('\\', "/");
            if entry.is_symlink() || !is_within(path.trim_end_matches('/')) {
                return Err(Error::refused(format!(
                    "the zip holds {}: every path must lie within it, and be no link",
                    shown(&path)
                )));
            }
            if entry.is_file() {
                files.push((path, i));
            }
        }
        Ok(Self {
            archive: RefCell::new(archive),
            files,
            left_bytes: Cell::new(MOST_UNPACKED_BYTES),
        })
    }

    pub(crate) fn paths(&self) -> impl Iterator<Item = &str> {
        self.files.iter().map(|(path, _)| path.as_str())
    }

    /// Unpacks a file. What it says of its own size is not relied on.
    pub(crate) fn read(&self, path: &str) -> Result<Vec<u8>, Error> {
        let found = self.files.iter().find(|(of, _)| of == path);
        let (_, place) =
            found.ok_or_else(|| Error::refused(format!("{}, which is named, is missing", shown(path))))?;
        let mut archive = self.archive.borrow_mut();
        let entry = archive.by_index(*place).map_err(Error::damaged)?;
        let mut bytes = Vec::new();
        let left_bytes = self.left_bytes.get();
        entry
            .take(left_bytes.saturating_add(1))
            .read_to_end(&mut bytes)
            .map_err(Error::damaged)?;
        let Some(left_bytes) = left_bytes.checked_sub(bytes.len() as u64) else {
            return Err(Error::refused(format!(
                "the zip unpacks to more than {MOST_UNPACKED_BYTES} bytes"
            )));
        };
        self.left_bytes.set(left_bytes);
        Ok(bytes)
    }
}

/// The path of what the file at `path` refers to, which must lie in the same bundle.
pub(crate) fn beside(path: &str, reference: &str) -> Result<String, Error> {
    let plain = reference.replace('\\', "/");
    let plain = plain.trim_start_matches("./");
    if !is_within(plain) {
        return Err(Error::refused(format!(
            "{} names {}: a path must lie within, without `..` and not absolute",
            shown(path),
            shown(reference)
        )));
    }
    Ok(match path.rsplit_once('/') {
        Some((folder, _)) => format!("{folder}/{plain}"),
        None => plain.to_owned(),
    })
}

/// A path from where one is to somewhere below. A colon would begin a drive or a URL.
fn is_within(path: &str) -> bool {
    !path.contains([':', '\0']) && path.split('/').all(|part| !matches!(part, "" | "." | ".."))
}

/// A name that somebody else chose, cut so that it may be told.
pub(crate) fn shown(name: &str) -> String {
    format!("{:?}", name.chars().take(80).collect::<String>())
}

/// One file of all, the same for the same files.
pub(crate) fn pack(files: &[(String, Vec<u8>)]) -> Result<Vec<u8>, Error> {
    let mut packed = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    for (path, bytes) in files {
        packed.start_file(path, options).map_err(Error::damaged)?;
        packed.write_all(bytes).map_err(Error::damaged)?;
    }
    Ok(packed.finish().map_err(Error::damaged)?.into_inner())
}
