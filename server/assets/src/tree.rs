//! A folder that stands for one asset, with all that is in it.

use crate::{
    bundle::MOST_FILES,
    folder::{read_file, unless_missing},
    stamp::Stamp,
};
use cap_fs_ext::DirExt;
use cap_std::fs::Dir;
use std::io;

/// Folders within folders.
const MOST_DEPTH: usize = 8;

/// Files by their paths within the folder.
pub(crate) type Files = Vec<(String, Vec<u8>)>;

/// What changes when a file in the folder does.
pub(crate) fn stamp(folder: &Dir) -> io::Result<Stamp> {
    let mut stamps = Vec::new();
    visit(folder, "", 0, &mut |within, file_name, path| {
        let metadata = unless_missing(within.symlink_metadata(file_name))?;
        stamps.extend(metadata.map(|metadata| (path, Stamp::of(&metadata))));
        Ok(stamps.len() <= MOST_FILES)
    })?;
    stamps.sort_by(|a, b| a.0.cmp(&b.0));
    Ok(Stamp::of_all(&stamps))
}

/// The files with their paths, in their order; none where they are too many or too large.
pub(crate) fn packed(folder: &Dir, limit_bytes: u64) -> io::Result<Option<Files>> {
    let mut files = Vec::new();
    let mut left_bytes = limit_bytes;
    let whole = visit(folder, "", 0, &mut |within, file_name, path| {
        let Some((_, bytes)) = unless_missing(read_file(within, file_name, left_bytes))? else {
            return Ok(true);
        };
        let Some(left) = left_bytes.checked_sub(bytes.len() as u64) else {
            return Ok(false);
        };
        left_bytes = left;
        files.push((path, bytes));
        Ok(files.len() <= MOST_FILES)
    })?;
    files.sort_by(|a, b| a.0.cmp(&b.0));
    Ok(whole.then_some(files))
}

/// Calls for each file until one says no, and tells whether none did. Links, hidden files and names that are no text
/// are passed over.
fn visit(
    folder: &Dir,
    above: &str,
    depth: usize,
    call: &mut dyn FnMut(&Dir, &str, String) -> io::Result<bool>,
) -> io::Result<bool> {
    for entry in folder.entries()? {
        let entry = entry?;
        let Ok(name) = entry.file_name().into_string() else {
            continue;
        };
        let kind = entry.file_type()?;
        if name.starts_with('.') {
            continue;
        }
        let path = format!("{above}{name}");
        let goes_on = if kind.is_file() {
            call(folder, &name, path)?
        } else if kind.is_dir() && depth < MOST_DEPTH {
            match unless_missing(folder.open_dir_nofollow(&name))? {
                Some(inner) => visit(&inner, &format!("{path}/"), depth + 1, call)?,
                None => true,
            }
        } else {
            true
        };
        if !goes_on {
            return Ok(false);
        }
    }
    Ok(true)
}
