//! Lamps as a renderer gets them.

use crate::lights::Light;
use std::{fmt, sync::Arc};

/// Lamps of a file. Two of the same digest are the same.
#[derive(Clone)]
pub struct LampList {
    /// About the file's own origin.
    pub lights: Arc<[Light]>,
    /// SHA-256 of the file that they were read from.
    pub digest: [u8; 32],
}

impl fmt::Debug for LampList {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "LampList({} lamps, {})", self.lights.len(), self.digest_hex())
    }
}
