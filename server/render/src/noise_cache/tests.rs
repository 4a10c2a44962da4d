//! Files that are not what they should be, and folders that are not where they should be.
#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use super::*;
use proptest::prelude::*;
use std::time::Duration;
use tempfile::TempDir;

const KEY: [u8; 32] = [7; 32];
const BYTES: [u8; 40] = [9; 40];
const FILE_LENGTH: usize = HEADER_BYTES + BYTES.len() + CHECKSUM_BYTES;
const FILE_BYTES: u64 = FILE_LENGTH as u64;

fn cache(most_bytes: u64) -> (TempDir, DiskCache) {
    let folder = tempfile::tempdir().unwrap();
    let cache = DiskCache {
        folder: folder.path().join("noise"),
        most_bytes,
    };
    (folder, cache)
}

fn names(cache: &DiskCache) -> Vec<String> {
    let entries = fs::read_dir(&cache.folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn what_was_kept_is_found_by_its_own_key_and_size_alone() {
    let (_folder, cache) = cache(1 << 20);
    assert_eq!(cache.find("noise", &KEY, 40), None);
    cache.keep("noise", &KEY, &BYTES);
    assert_eq!(cache.find("noise", &KEY, 40).unwrap(), BYTES);
    assert_eq!(cache.find("other", &KEY, 40), None);
    assert_eq!(cache.find("noise", &[8; 32], 40), None);
    assert_eq!(cache.find("noise", &KEY, 39), None);
    // The file's name holds a part of the key, the file all of it.
    let mut other = KEY;
    other[31] = 0;
    assert_eq!(cache.path("noise", &other), cache.path("noise", &KEY));
    assert_eq!(cache.find("noise", &other, 40), None);
    cache.keep("noise", &KEY, &[1; 40]);
    assert_eq!(cache.find("noise", &KEY, 40).unwrap(), [1; 40]);
    assert_eq!(names(&cache).len(), 1);
}

proptest! {
    #[test]
    fn a_flipped_bit_is_noticed(at in 0..FILE_LENGTH, bit in 0..8) {
        let (_folder, cache) = cache(1 << 20);
        cache.keep("noise", &KEY, &BYTES);
        let path = cache.path("noise", &KEY);
        let mut file = fs::read(&path).unwrap();
        file[at] ^= 1_u8 << bit;
        fs::write(&path, file).unwrap();
        prop_assert_eq!(cache.find("noise", &KEY, 40), None);
        cache.keep("noise", &KEY, &BYTES);
        prop_assert_eq!(cache.find("noise", &KEY, 40).unwrap(), BYTES);
    }
}

#[test]
fn a_file_cut_short_or_too_long_is_noticed() {
    let (_folder, cache) = cache(1 << 20);
    cache.keep("noise", &KEY, &BYTES);
    let path = cache.path("noise", &KEY);
    let whole = fs::read(&path).unwrap();
    assert_eq!(whole.len() as u64, FILE_BYTES);
    for length in 0..whole.len() {
        fs::write(&path, &whole[..length]).unwrap();
        assert_eq!(cache.find("noise", &KEY, 40), None, "{length}");
    }
    fs::write(&path, [&whole[..], &[0]].concat()).unwrap();
    assert_eq!(cache.find("noise", &KEY, 40), None);
}

/// Even with a right checksum.
#[test]
fn another_version_is_noticed() {
    let (_folder, cache) = cache(1 << 20);
    cache.keep("noise", &KEY, &BYTES);
    let path = cache.path("noise", &KEY);
    let whole = fs::read(&path).unwrap();
    let mut content = whole[..whole.len() - CHECKSUM_BYTES].to_vec();
    content[8..12].copy_from_slice(&(VERSION + 1).to_le_bytes());
    let checksum = Sha256::digest(&content);
    content.extend_from_slice(&checksum);
    fs::write(&path, content).unwrap();
    assert_eq!(cache.find("noise", &KEY, 40), None);
}

#[test]
fn a_folder_that_cannot_be_written_does_no_harm() {
    let (folder, cache) = cache(1 << 20);
    // A file stands in the folder's place: that stops root too, whom no permission stops.
    fs::write(&cache.folder, "in the way").unwrap();
    cache.keep("noise", &KEY, &BYTES);
    assert_eq!(cache.find("noise", &KEY, 40), None);
    assert_eq!(fs::read(&cache.folder).unwrap(), b"in the way");
    let below = DiskCache {
        folder: folder.path().join("noise").join("deeper"),
        most_bytes: 1 << 20,
    };
    below.keep("noise", &KEY, &BYTES);
    assert_eq!(below.find("noise", &KEY, 40), None);
}

#[cfg(unix)]
#[test]
fn a_folder_that_can_only_be_read_still_serves() {
    use std::os::unix::fs::PermissionsExt;
    let (_folder, cache) = cache(1 << 20);
    cache.keep("noise", &KEY, &BYTES);
    let path = cache.path("noise", &KEY);
    fs::set_permissions(&path, fs::Permissions::from_mode(0o400)).unwrap();
    fs::set_permissions(&cache.folder, fs::Permissions::from_mode(0o500)).unwrap();
    assert_eq!(cache.find("noise", &KEY, 40).unwrap(), BYTES);
    cache.keep("other", &KEY, &BYTES);
    assert_eq!(cache.find("noise", &KEY, 40).unwrap(), BYTES);
    fs::set_permissions(&cache.folder, fs::Permissions::from_mode(0o700)).unwrap();
}

#[test]
fn a_folder_in_the_files_place_does_no_harm() {
    let (_folder, cache) = cache(1 << 20);
    fs::create_dir_all(cache.path("noise", &KEY)).unwrap();
    assert_eq!(cache.find("noise", &KEY, 40), None);
    cache.keep("noise", &KEY, &BYTES);
    assert_eq!(cache.find("noise", &KEY, 40), None);
    // Nothing is left of the attempt.
    assert_eq!(names(&cache).len(), 1);
}

#[test]
fn what_was_not_used_for_longest_goes_first() {
    let (_folder, cache) = cache(3 * FILE_BYTES);
    fs::create_dir_all(&cache.folder).unwrap();
    fs::write(cache.folder.join("not ours"), [0; 4096]).unwrap();
    let key = |n: u8| [n; 32];
    let used = |n: u8, seconds: u64| {
        let path = cache.path("noise", &key(n));
        let file = fs::File::options().append(true).open(path).unwrap();
        file.set_modified(SystemTime::UNIX_EPOCH + Duration::from_secs(seconds))
            .unwrap();
    };
    for n in 1..=3 {
        cache.keep("noise", &key(n), &BYTES);
        used(n, 1000 + u64::from(n));
    }
    assert_eq!(names(&cache).len(), 4);
    // Now the second is the oldest.
    assert!(cache.find("noise", &key(1), 40).is_some());
    cache.keep("noise", &key(4), &BYTES);
    let there = [1, 2, 3, 4].map(|n| cache.find("noise", &key(n), 40).is_some());
    assert_eq!(there, [true, false, true, true]);
    // What a process left half written is old one day, too.
    let left = cache.folder.join(format!("x{UNFINISHED}"));
    fs::write(&left, BYTES).unwrap();
    fs::File::options()
        .append(true)
        .open(&left)
        .unwrap()
        .set_modified(SystemTime::UNIX_EPOCH)
        .unwrap();
    cache.keep("noise", &key(3), &BYTES);
    assert!(!left.exists());
    assert!(cache.folder.join("not ours").exists());
}

#[test]
fn what_is_larger_than_the_bound_is_not_kept() {
    let (_folder, cache) = cache(FILE_BYTES - 1);
    cache.keep("noise", &KEY, &BYTES);
    assert!(!cache.folder.exists());
    let exact = DiskCache {
        most_bytes: FILE_BYTES,
        ..cache
    };
    exact.keep("noise", &KEY, &BYTES);
    assert!(exact.find("noise", &KEY, 40).is_some());
}
