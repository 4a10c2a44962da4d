//! What tells, without reading it, that a file has changed.

use cap_std::fs::Metadata;
use std::{
    hash::{DefaultHasher, Hash, Hasher},
    time::{Duration, SystemTime},
};

/// File systems count time in steps of up to two seconds: two contents written within one step look alike.
const COARSEST_CLOCK: Duration = Duration::from_secs(3);

/// What the system tells of a file. Equal stamps that are [settled](Stamp::is_settled) mean equal content.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Stamp {
    bytes: u64,
    modified: Option<SystemTime>,
    /// Inode, and when it was last changed; a file moved over another brings its old time of modification along.
    inode: Option<(u64, SystemTime)>,
}

impl Stamp {
    pub(crate) fn of(metadata: &Metadata) -> Self {
        Self {
            bytes: metadata.len(),
            modified: metadata.modified().ok().map(cap_std::time::SystemTime::into_std),
            inode: inode(metadata),
        }
    }

    /// Of several files, each with its path: one that changes, comes or goes gives another stamp.
    pub(crate) fn of_all(files: &[(String, Self)]) -> Self {
        let mut hasher = DefaultHasher::new();
        files.hash(&mut hasher);
        let latest = files.iter().filter_map(|(_, stamp)| stamp.latest()).max();
        Self {
            bytes: files.iter().map(|(_, stamp)| stamp.bytes).sum(),
            modified: latest,
            inode: latest.map(|latest| (hasher.finish(), latest)),
        }
    }

    pub(crate) const fn bytes(&self) -> u64 {
        self.bytes
    }

    fn latest(&self) -> Option<SystemTime> {
        let changed = self.inode.map(|(_, changed)| changed);
        [self.modified, changed].into_iter().flatten().max()
    }

    /// True where a change after this stamp was taken would have to give another.
    pub(crate) fn is_settled(&self) -> bool {
        let latest = self.latest();
        latest.is_some_and(|latest| latest.elapsed().is_ok_and(|age| age > COARSEST_CLOCK))
    }
}

#[cfg(unix)]
fn inode(metadata: &Metadata) -> Option<(u64, SystemTime)> {
    use cap_std::fs::MetadataExt;
    let seconds = u64::try_from(metadata.ctime()).ok()?;
    let nanoseconds = u32::try_from(metadata.ctime_nsec()).ok()?;
    let changed = SystemTime::UNIX_EPOCH.checked_add(Duration::new(seconds, nanoseconds))?;
    Some((metadata.ino(), changed))
}

#[cfg(not(unix))]
const fn inode(_: &Metadata) -> Option<(u64, SystemTime)> {
    None
}
