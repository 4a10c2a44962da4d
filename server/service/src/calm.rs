//! Batch work waits while somebody looks.

use crate::state::Service;
use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};
use tokio::time::sleep;
use welkin_jobs::Calm;

/// After this long without an order, a viewer is thought to be done for now.
const QUIET: Duration = Duration::from_secs(1);
/// After this long a frame of a job is begun all the same: jobs are slowed by viewers, not stopped.
const LONGEST: Duration = Duration::from_secs(60);
const LOOK: Duration = Duration::from_millis(100);

/// Whether somebody waits for a frame.
pub(crate) struct Attention {
    epoch: Instant,
    /// Orders in work.
    orders: AtomicU64,
    /// When the last one ended, milliseconds after the epoch; 0 before the first.
    ended_ms: AtomicU64,
}

impl Default for Attention {
    fn default() -> Self {
        Self {
            epoch: Instant::now(),
            orders: AtomicU64::new(0),
            ended_ms: AtomicU64::new(0),
        }
    }
}

/// An order that somebody waits for.
pub(crate) struct Attended(Arc<Attention>);

impl Attention {
    pub(crate) fn order(self: &Arc<Self>) -> Attended {
        self.orders.fetch_add(1, Ordering::SeqCst);
        Attended(Arc::clone(self))
    }

    fn now_ms(&self) -> u64 {
        u64::try_from(self.epoch.elapsed().as_millis()).unwrap_or(u64::MAX)
    }

    fn is_calm(&self) -> bool {
        let ended_ms = self.ended_ms.load(Ordering::SeqCst);
        let quiet_ms = u64::try_from(QUIET.as_millis()).unwrap_or(u64::MAX);
        // An order may end between the two looks at the clock.
        let since_ms = self.now_ms().saturating_sub(ended_ms);
        self.orders.load(Ordering::SeqCst) == 0 && (ended_ms == 0 || since_ms >= quiet_ms)
    }
}

impl Drop for Attended {
    fn drop(&mut self) {
        self.0.ended_ms.store(self.0.now_ms().max(1), Ordering::SeqCst);
        self.0.orders.fetch_sub(1, Ordering::SeqCst);
    }
}

impl Service {
    /// For the worker beside this service: ready when nobody has ordered a frame for a second, or after a minute.
    #[must_use]
    pub fn calm(&self) -> Calm {
        let attention = Arc::clone(&self.attention);
        Arc::new(move || {
            let attention = Arc::clone(&attention);
            Box::pin(async move {
                let begun = Instant::now();
                while !attention.is_calm() && begun.elapsed() < LONGEST {
                    sleep(LOOK).await;
                }
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_calm_a_while_after_the_last_order_and_not_before() {
        let attention = Arc::new(Attention::default());
        assert!(attention.is_calm());
        let (one, other) = (attention.order(), attention.order());
        drop(one);
        assert!(!attention.is_calm());
        drop(other);
        assert!(!attention.is_calm());
        std::thread::sleep(QUIET + LOOK);
        assert!(attention.is_calm());
    }
}
