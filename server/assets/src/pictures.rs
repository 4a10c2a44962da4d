//! Decoded pictures, each in memory once however many frames use it, and all of them together bounded.

use crate::{
    Error,
    png_file::{self, PngFacts},
};
use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, MutexGuard, PoisonError, Weak},
};
use welkin_scene::WeatherPicture;

/// Pictures kept for the next who asks, bytes: four of the largest.
const KEPT_BYTES: u64 = 256 << 20;
/// Pictures in memory altogether, those in use by orders included, bytes.
const MOST_BYTES: u64 = 1 << 30;

#[derive(Default)]
pub(crate) struct Pictures {
    table: Mutex<Table>,
    /// One picture is decoded at a time: the work on one takes several times its own memory.
    decoding: Mutex<()>,
}

#[derive(Default)]
struct Table {
    /// The last used first.
    kept: VecDeque<Arc<WeatherPicture>>,
    /// Every picture that somebody still has.
    alive: Vec<Weak<WeatherPicture>>,
}

impl Pictures {
    pub(crate) fn find(&self, digest: &[u8; 32]) -> Option<Arc<WeatherPicture>> {
        self.table().find(digest)
    }

    /// The picture of a file whose digest is known, decoded unless it is there.
    pub(crate) fn decoded(&self, digest: [u8; 32], file: &[u8]) -> Result<Arc<WeatherPicture>, Error> {
        let _turn = self.decoding.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = self.find(&digest) {
            return Ok(found);
        }
        let facts = png_file::facts(file)?;
        self.table().make_room(facts.rgba_bytes())?;
        let PngFacts {
            width_px, height_px, ..
        } = facts;
        let picture = Arc::new(WeatherPicture {
            width_px,
            height_px,
            rgba: png_file::rgba(file)?.into(),
            digest,
        });
        self.table().insert(Arc::clone(&picture));
        Ok(picture)
    }

    fn table(&self) -> MutexGuard<'_, Table> {
        self.table.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Table {
    fn find(&mut self, digest: &[u8; 32]) -> Option<Arc<WeatherPicture>> {
        let found = self
            .alive
            .iter()
            .filter_map(Weak::upgrade)
            .find(|p| p.digest == *digest)?;
        self.keep(Arc::clone(&found));
        Some(found)
    }

    fn insert(&mut self, picture: Arc<WeatherPicture>) {
        self.alive.push(Arc::downgrade(&picture));
        self.keep(picture);
    }

    fn keep(&mut self, picture: Arc<WeatherPicture>) {
        self.kept.retain(|kept| kept.digest != picture.digest);
        self.kept.push_front(picture);
        while self.kept.iter().map(|kept| size(kept)).sum::<u64>() > KEPT_BYTES {
            self.kept.pop_back();
        }
    }

    /// Lets go of what is merely kept until `bytes` more fit.
    fn make_room(&mut self, bytes: u64) -> Result<(), Error> {
        while self.alive_bytes() + bytes > MOST_BYTES {
            self.kept.pop_back().ok_or(Error::Busy)?;
        }
        Ok(())
    }

    fn alive_bytes(&mut self) -> u64 {
        self.alive.retain(|picture| picture.strong_count() > 0);
        self.alive
            .iter()
            .filter_map(Weak::upgrade)
            .map(|p| size(&p))
            .sum()
    }
}

fn size(picture: &WeatherPicture) -> u64 {
    picture.rgba.len() as u64
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;

    /// As large as `bytes` says to the table, and with no memory of its own: all of them share one.
    fn picture(number: u8, rgba: &Arc<[u8]>) -> Arc<WeatherPicture> {
        Arc::new(WeatherPicture {
            width_px: 1,
            height_px: 1,
            rgba: Arc::clone(rgba),
            digest: [number; 32],
        })
    }

    #[test]
    fn memory_is_bounded_by_what_is_kept_and_by_what_is_in_use() {
        let rgba: Arc<[u8]> = vec![0; 64 << 20].into();
        let mut table = Table::default();
        for number in 0..6 {
            table.insert(picture(number, &rgba));
        }
        assert_eq!(table.kept.len(), 4, "of 64 MiB each");
        assert!(table.find(&[1; 32]).is_none(), "let go");
        assert!(table.find(&[2; 32]).is_some());
        table.insert(picture(6, &rgba));
        assert!(table.find(&[2; 32]).is_some(), "the one used last stays");
        assert!(table.find(&[3; 32]).is_none());
        let used: Vec<_> = (10..26).map(|number| picture(number, &rgba)).collect();
        for picture in &used[..15] {
            table.insert(Arc::clone(picture));
        }
        table.make_room(64 << 20).unwrap();
        table.insert(Arc::clone(&used[15]));
        assert!(
            table.find(&[10; 32]).is_some(),
            "in use, so it need not be read again"
        );
        assert!(matches!(table.make_room(1), Err(Error::Busy)));
        drop(used);
        table.make_room(1).unwrap();
    }
}
