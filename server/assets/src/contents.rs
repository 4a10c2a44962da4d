//! What files have become, each in memory once however many frames use it, and all of them together bounded.

use crate::{Error, content::Content};
use std::{
    any::Any,
    collections::VecDeque,
    sync::{Arc, Mutex, MutexGuard, PoisonError, Weak},
};

/// Kept for the next who asks, bytes: four of the largest pictures.
const KEPT_BYTES: u64 = 256 << 20;
/// In memory altogether, what orders use included, bytes.
const MOST_BYTES: u64 = 1 << 30;

#[derive(Default)]
pub(crate) struct Contents {
    table: Mutex<Table>,
    /// One file is read at a time: the work on one takes several times its own memory.
    reading: Mutex<()>,
}

#[derive(Default)]
struct Table {
    /// The last used first.
    kept: VecDeque<Arc<dyn Content>>,
    /// All that somebody still has.
    alive: Vec<Weak<dyn Content>>,
}

impl Contents {
    pub(crate) fn find<T: Content>(&self, digest: &[u8; 32]) -> Option<Arc<T>> {
        self.table().find(digest)
    }

    /// The content of a file whose digest is known, read unless it is there.
    pub(crate) fn read<T: Content>(&self, digest: [u8; 32], file: &[u8]) -> Result<Arc<T>, Error> {
        let _turn = self.reading.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = self.find(&digest) {
            return Ok(found);
        }
        self.table().make_room(T::most_bytes(file)?)?;
        let content = Arc::new(T::read(file, digest)?);
        self.table().insert(Arc::clone(&content) as _);
        Ok(content)
    }

    fn table(&self) -> MutexGuard<'_, Table> {
        self.table.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Table {
    /// One file may be of two kinds, a picture and heights.
    fn find<T: Content>(&mut self, digest: &[u8; 32]) -> Option<Arc<T>> {
        let alive = self.alive.iter().filter_map(Weak::upgrade);
        let mut alike = alive.filter(|content| content.digest() == digest);
        let found =
            alike.find_map(|content| Arc::downcast::<T>(content as Arc<dyn Any + Send + Sync>).ok())?;
        self.keep(Arc::clone(&found) as _);
        Some(found)
    }

    fn insert(&mut self, content: Arc<dyn Content>) {
        self.alive.push(Arc::downgrade(&content));
        self.keep(content);
    }

    fn keep(&mut self, content: Arc<dyn Content>) {
        self.kept.retain(|kept| !Arc::ptr_eq(kept, &content));
        self.kept.push_front(content);
        while self.kept.len() > 1 && self.kept.iter().map(|kept| kept.bytes()).sum::<u64>() > KEPT_BYTES {
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
        self.alive.retain(|content| content.strong_count() > 0);
        let alive = self.alive.iter().filter_map(Weak::upgrade);
        alive.map(|content| content.bytes()).sum()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use welkin_scene::WeatherPicture;

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
            table.insert(picture(number, &rgba) as _);
        }
        assert_eq!(table.kept.len(), 4, "of 64 MiB each");
        assert!(table.find::<WeatherPicture>(&[1; 32]).is_none(), "let go");
        assert!(table.find::<WeatherPicture>(&[2; 32]).is_some());
        table.insert(picture(6, &rgba) as _);
        assert!(
            table.find::<WeatherPicture>(&[2; 32]).is_some(),
            "the one used last stays"
        );
        assert!(table.find::<WeatherPicture>(&[3; 32]).is_none());
        let used: Vec<_> = (10..26).map(|number| picture(number, &rgba)).collect();
        for picture in &used[..15] {
            table.insert(Arc::clone(picture) as _);
        }
        table.make_room(64 << 20).unwrap();
        table.insert(Arc::clone(&used[15]) as _);
        assert!(
            table.find::<WeatherPicture>(&[10; 32]).is_some(),
            "in use, so it need not be read again"
        );
        assert!(matches!(table.make_room(1), Err(Error::Busy)));
        drop(used);
        table.make_room(1).unwrap();
    }
}
