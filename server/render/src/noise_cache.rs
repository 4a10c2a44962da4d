//! Noise kept on disk between starts.
//!
//! A file is a magic word, the format's version, the key of what the bytes were made from, their number, the bytes, and a
//! SHA-256 of all that. One that is damaged or not ours is as good as none; so is a folder that cannot be written.

use sha2::{Digest, Sha256};
use std::{
    fs, io,
    io::Write as _,
    path::{Path, PathBuf},
    time::SystemTime,
};

#[cfg(test)]
mod tests;

const MAGIC: &[u8; 8] = b"welkin~n";
const VERSION: u32 = 1;
const HEADER_BYTES: usize = 8 + 4 + 32 + 8;
const CHECKSUM_BYTES: usize = 32;
/// Files with other endings in the folder are never touched.
const ENDING: &str = ".noise";
/// Of files that are being written.
const UNFINISHED: &str = ".noise-part";

/// Where noise is kept between starts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DiskCache {
    /// Made when it is first needed.
    pub folder: PathBuf,
    /// The most that its files take, bytes; the ones not used for longest go first.
    pub most_bytes: u64,
}

impl DiskCache {
    /// `count` bytes made from what `key` stands for.
    pub(crate) fn find(&self, name: &str, key: &[u8; 32], count: usize) -> Option<Vec<u8>> {
        let path = self.path(name, key);
        // Only a file of the right size is read at all.
        let whole = (HEADER_BYTES + count + CHECKSUM_BYTES) as u64;
        fs::metadata(&path)
            .ok()
            .filter(|known| known.is_file() && known.len() == whole)?;
        let mut file = fs::read(&path).ok()?;
        let (content, checksum) = file.split_at_checked(HEADER_BYTES + count)?;
        if content[..HEADER_BYTES] != header(key, count) || Sha256::digest(content)[..] != *checksum {
            tracing::warn!(path = %path.display(), "kept noise is damaged; it is made anew");
            return None;
        }
        file.truncate(HEADER_BYTES + count);
        file.drain(..HEADER_BYTES);
        // So that it counts as used. A folder that is only read keeps its times.
        let touched = fs::File::options()
            .append(true)
            .open(&path)
            .and_then(|file| file.set_modified(SystemTime::now()));
        drop(touched);
        Some(file)
    }

    /// Keeps bytes, if that can be done.
    pub(crate) fn keep(&self, name: &str, key: &[u8; 32], bytes: &[u8]) {
        if let Err(error) = self.write(&self.path(name, key), key, bytes) {
            tracing::warn!(folder = %self.folder.display(), %error, "noise cannot be kept between starts");
        }
    }

    fn path(&self, name: &str, key: &[u8; 32]) -> PathBuf {
        let short: String = key[..8].iter().map(|byte| format!("{byte:02x}")).collect();
        self.folder.join(format!("{name}-{short}{ENDING}"))
    }

    /// The file appears whole or not at all.
    fn write(&self, path: &Path, key: &[u8; 32], bytes: &[u8]) -> io::Result<()> {
        let mut content = header(key, bytes.len());
        content.extend_from_slice(bytes);
        let checksum = Sha256::digest(&content);
        content.extend_from_slice(&checksum);
        if content.len() as u64 > self.most_bytes {
            return Ok(());
        }
        fs::create_dir_all(&self.folder)?;
        let mut file = tempfile::Builder::new()
            .suffix(UNFINISHED)
            .tempfile_in(&self.folder)?;
        file.write_all(&content)?;
        file.persist(path).map_err(|failure| failure.error)?;
        self.keep_to_bound()
    }

    fn keep_to_bound(&self) -> io::Result<()> {
        let mut files = Vec::new();
        for entry in fs::read_dir(&self.folder)? {
            let entry = entry?;
            let name = entry.file_name();
            let name = name.to_string_lossy();
            // Another process may have removed it by now.
            if (name.ends_with(ENDING) || name.ends_with(UNFINISHED))
                && let Ok(known) = entry.metadata()
                && known.is_file()
            {
                let used = known.modified().unwrap_or(SystemTime::UNIX_EPOCH);
                files.push((used, entry.path(), known.len()));
            }
        }
        files.sort();
        let mut taken: u64 = files.iter().map(|(_, _, bytes)| bytes).sum();
        for (_, path, bytes) in files {
            if taken <= self.most_bytes {
                break;
            }
            fs::remove_file(path)?;
            taken -= bytes;
        }
        Ok(())
    }
}

fn header(key: &[u8; 32], count: usize) -> Vec<u8> {
    let count = (count as u64).to_le_bytes();
    [&MAGIC[..], &VERSION.to_le_bytes(), key, &count].concat()
}
