//! Why the store did not do what it was asked.

use crate::{Kind, Name, png_file::MAX_SIDE_PX};
use std::io;
use welkin_scene::problem::SceneError;

/// Why the store did not do what it was asked. Messages are for the client, but for [`Error::Folder`].
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Not a name that an asset may have.
    #[error("the name of an asset must be {}", Name::ALLOWED)]
    Name,
    /// Nothing of that name.
    #[error("there is no asset {name} among the {kind}")]
    Unknown {
        /// Where it was looked for.
        kind: Kind,
        /// What was looked for.
        name: Name,
    },
    /// Nothing that the kind can be sent as.
    #[error("the file is not {}: send {}", .kind.noun(), .kind.allowed())]
    Form {
        /// What it was sent as.
        kind: Kind,
    },
    /// A picture or a grid that is too wide or too high.
    #[error("the picture has {width_px} x {height_px} pixels: scale it down to {MAX_SIDE_PX} a side or less")]
    Side {
        /// Its width, pixels.
        width_px: u32,
        /// Its height, pixels.
        height_px: u32,
    },
    /// A file that cannot be read to its end.
    #[error("the file is damaged or cut short: {reason}")]
    Damaged {
        /// What was found.
        reason: String,
    },
    /// A file that can be read, and holds what an asset may not.
    #[error("the file is refused: {reason}")]
    Refused {
        /// What it holds, and what it may hold.
        reason: String,
    },
    /// More bytes than one asset may have.
    #[error("an asset may have {limit_bytes} bytes at most")]
    TooLarge {
        /// The most that it may have.
        limit_bytes: u64,
    },
    /// The store is full.
    #[error("the asset store is full: {reason}; delete what is not needed")]
    Full {
        /// Which limit is reached.
        reason: String,
    },
    /// Assets in use fill the memory that they may have.
    #[error("assets in use fill the memory they may have")]
    Busy,
    /// The condition of the one who asked does not hold.
    #[error("the asset is not, or no more, what the request takes it for")]
    Condition,
    /// A scene names what there is not.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The folder cannot be read or written.
    #[error("the asset store: {what}: {source}")]
    Folder {
        /// What was done.
        what: String,
        /// What the system said.
        source: io::Error,
    },
}

impl Error {
    /// For `map_err`: what a reader of files said.
    pub(crate) fn damaged(error: impl std::fmt::Display) -> Self {
        Self::Damaged {
            reason: error.to_string(),
        }
    }

    pub(crate) fn refused(reason: impl Into<String>) -> Self {
        Self::Refused {
            reason: reason.into(),
        }
    }

    /// For `map_err`: what was done when the system refused.
    pub(crate) fn folder(what: impl Into<String>) -> impl FnOnce(io::Error) -> Self {
        move |source| match source.kind() {
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => Self::Full {
                reason: "no space is left on its disk".into(),
            },
            _ => Self::Folder {
                what: what.into(),
                source,
            },
        }
    }
}
