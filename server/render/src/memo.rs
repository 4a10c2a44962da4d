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
    kept: VecDeque<Kept<T>>,
    most: u64,
}

struct Kept<T> {
    made_from: Fingerprint,
    weight: u64,
    output: Arc<T>,
}

impl<T> Memo<T> {
    /// Holds what weighs that much together, and the latest output at least.
    pub(crate) const fn new(most: u64) -> Self {
        Self {
            kept: VecDeque::new(),
            most,
        }
    }

    /// The output with this fingerprint, made if it is not there. Weighs 1.
    pub(crate) fn get_or(&mut self, fingerprint: Fingerprint, make: impl FnOnce() -> T) -> Arc<T> {
        self.get_or_weighing(1, fingerprint, make)
    }

    /// As [`Self::get_or`], of what weighs that much.
    pub(crate) fn get_or_weighing(
        &mut self,
        weight: u64,
        fingerprint: Fingerprint,
        make: impl FnOnce() -> T,
    ) -> Arc<T> {
        let Ok(output) = self.find_or(weight, fingerprint, || Ok::<_, Infallible>(make()));
        output
    }

    /// As [`Self::get_or`], of what can fail to be made; a failure is not kept.
    pub(crate) fn try_get_or<E>(
        &mut self,
        fingerprint: Fingerprint,
        make: impl FnOnce() -> Result<T, E>,
    ) -> Result<Arc<T>, E> {
        self.find_or(1, fingerprint, make)
    }

    fn find_or<E>(
        &mut self,
        weight: u64,
        made_from: Fingerprint,
        make: impl FnOnce() -> Result<T, E>,
    ) -> Result<Arc<T>, E> {
        let there = self.kept.iter().position(|kept| kept.made_from == made_from);
        let kept = match there.and_then(|at| self.kept.remove(at)) {
            Some(kept) => kept,
            None => Kept {
                made_from,
                weight,
                output: Arc::new(make()?),
            },
        };
        let output = Arc::clone(&kept.output);
        self.kept.push_front(kept);
        let mut whole: u64 = self.kept.iter().map(|kept| kept.weight).sum();
        while whole > self.most && self.kept.len() > 1 {
            whole -= self.kept.pop_back().map_or(0, |kept| kept.weight);
        }
        Ok(output)
    }
}
