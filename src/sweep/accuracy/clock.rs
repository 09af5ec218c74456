//! How long one thread has worked: on a machine with other work, wall time says how busy that is.

use std::fs::read_to_string;
use std::time::Instant;

/// A running stop watch of the thread that started it.
#[derive(Debug)]
pub struct Clock {
    wall: Instant,
    worked: Option<f64>,
}

impl Clock {
    /// Starts.
    #[must_use]
    pub fn start() -> Clock {
        Clock { wall: Instant::now(), worked: worked() }
    }

    /// Seconds of a processor since then; of wall time where the system does not count them.
    #[must_use]
    pub fn worked(&self) -> f64 {
        worked().zip(self.worked).map_or_else(|| self.wall(), |(now, then)| now - then)
    }

    /// Seconds of wall time since then.
    #[must_use]
    pub fn wall(&self) -> f64 {
        self.wall.elapsed().as_secs_f64()
    }
}

/// Seconds that this thread has been on a processor, as Linux counts them in nanoseconds.
fn worked() -> Option<f64> {
    let text = read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(1e-9 * text.split_whitespace().next()?.parse::<f64>().ok()?)
}

#[cfg(test)]
mod tests {
    use super::Clock;

    #[test]
    fn sleep_is_no_work() {
        let clock = Clock::start();
        std::thread::sleep(std::time::Duration::from_millis(100));
        assert!(clock.wall() >= 0.1);
        #[cfg(target_os = "linux")]
        assert!(clock.worked() < 0.05, "{}", clock.worked());
    }
}
