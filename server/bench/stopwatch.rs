//! What work costs: time on the clock, time of the processors, memory.

use serde::{Deserialize, Serialize};
use std::time::{Duration, Instant};

/// Runs from its start.
pub(crate) struct Stopwatch {
    wall: Instant,
    cpu: Option<Duration>,
}

/// What a piece of work cost.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Spent {
    /// Time on the clock, milliseconds.
    pub(crate) wall_ms: f64,
    /// Time of all threads of the process, milliseconds; none where the system does not tell it.
    pub(crate) cpu_ms: Option<f64>,
}

impl Spent {
    /// Of other processes, whose own time is not told.
    pub(crate) fn on_the_clock(took: Duration) -> Self {
        Self {
            wall_ms: took.as_secs_f64() * 1e3,
            cpu_ms: None,
        }
    }
}

impl Stopwatch {
    pub(crate) fn start() -> Self {
        // The dearer call first, so that it does not count.
        let cpu = processor_time();
        Self {
            wall: Instant::now(),
            cpu,
        }
    }

    pub(crate) fn stop(&self) -> Spent {
        let wall = self.wall.elapsed();
        let cpu = processor_time()
            .zip(self.cpu)
            .map(|(now, then)| now.saturating_sub(then));
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        Spent {
            wall_ms: ms(wall),
            cpu_ms: cpu.map(ms),
        }
    }
}

/// Time that all threads of this process, ended ones too, have had on a processor.
#[cfg(unix)]
fn processor_time() -> Option<Duration> {
    use rustix::time::{ClockId, clock_gettime};
    clock_gettime(ClockId::ProcessCPUTime).try_into().ok()
}

/// Not told here.
#[cfg(not(unix))]
fn processor_time() -> Option<Duration> {
    None
}

/// The most memory that this process has held at once, bytes; Linux tells it.
pub(crate) fn peak_memory_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kibibytes)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;

    #[cfg(unix)]
    #[test]
    fn waiting_costs_no_processor_and_other_threads_count() {
        // A whole process's time: tests beside this one in the same process only add to it.
        let watch = Stopwatch::start();
        let worked = std::thread::spawn(|| {
            let own = Instant::now();
            while own.elapsed() < Duration::from_millis(50) {
                std::hint::spin_loop();
            }
        });
        worked.join().unwrap();
        let spent = watch.stop();
        assert!(spent.wall_ms >= 50.0);
        assert!(spent.cpu_ms.unwrap() > 0.0, "{spent:?}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn the_peak_stays_after_memory_is_given_back() {
        let before = peak_memory_bytes().unwrap();
        let much = vec![1_u8; usize::try_from(before).unwrap()];
        std::hint::black_box(&much);
        drop(much);
        assert!(peak_memory_bytes().unwrap() > before);
    }
}
