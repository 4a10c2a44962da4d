//! Which Welkin this is.

use sha2::{Digest, Sha256};
use std::{env, fs::File, io};

/// The version, and a fingerprint of the program itself: every change of shaders or code makes other entity tags.
pub(crate) fn build() -> String {
    let version = env!("CARGO_PKG_VERSION");
    let fingerprint = || -> io::Result<String> {
        let mut hash = Sha256::new();
        io::copy(&mut File::open(env::current_exe()?)?, &mut hash)?;
        Ok(hash.finalize()[..4]
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect())
    };
    fingerprint().map_or_else(|_| version.to_owned(), |print| format!("{version}+{print}"))
}
