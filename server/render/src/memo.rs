//! Outputs kept until what they were made from changes.

use std::{
    collections::VecDeque,
    convert::Infallible,
    hash::{DefaultHasher, Hash, Hasher},
    sync::Arc,
};

/// A fingerprint of everything an output was made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Fingerprint(u64);

impl Fingerprint {
    /// Of a pass's name, its uniforms, sizes, and the fingerprints of what it reads.
    pub(crate) fn of(parts: impl Hash) -> Self {
        let mut hasher = DefaultHasher::new();
        parts.hash(&mut hasher);
        Self(hasher.finish())
    }
}

/// The latest outputs of a pass; several, since several viewers share the device.
pub(crate) struct Memo<T> {
    kept: VecDeque<(Fingerprint, Arc<T>)>,
    most: usize,
}

impl<T> Memo<T> {
    pub(crate) const fn new(most: usize) -> Self {
        Self {
            kept: VecDeque::new(),
            most,
        }
    }

    /// The output with this fingerprint, made if it is not there.
    pub(crate) fn get_or(&mut self, fingerprint: Fingerprint, make: impl FnOnce() -> T) -> Arc<T> {
        let Ok(output) = self.try_get_or(fingerprint, || Ok::<_, Infallible>(make()));
        output
    }

    /// As [`Self::get_or`], of what can fail to be made; a failure is not kept.
    pub(crate) fn try_get_or<E>(
        &mut self,
        fingerprint: Fingerprint,
        make: impl FnOnce() -> Result<T, E>,
    ) -> Result<Arc<T>, E> {
        if let Some(at) = self.kept.iter().position(|(f, _)| *f == fingerprint)
            && let Some(entry) = self.kept.remove(at)
        {
            let output = Arc::clone(&entry.1);
            self.kept.push_front(entry);
            return Ok(output);
        }
        let output = Arc::new(make()?);
        self.kept.push_front((fingerprint, Arc::clone(&output)));
        self.kept.truncate(self.most);
        Ok(output)
    }
}
