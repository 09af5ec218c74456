//! Into how many tasks a sweep is cut.

use std::time::Duration;

/// A task should last at least this long: schedulers start about ten tasks a minute, and each reads the sweep and opens
/// its engine anew.
const TASK: Duration = Duration::from_mins(10);

/// As many cores as a GPU is counted for. Not a measurement of any: where it is too low there are more tasks than
/// needed and each is short, where it is too high there are fewer and each is long.
const CORES_OF_A_GPU: f64 = 64.0;

/// The means that one task computes with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Means {
    /// Cores of the processor.
    pub cpus: u16,
    /// Whether a GPU computes.
    pub gpu: bool,
}

/// The number of tasks for `tiles` tiles that take one core `time`: each with ten minutes of work or more, none without
/// a tile, and no more than the `most` that an array may have.
#[must_use]
pub fn tasks(time: Duration, means: Means, tiles: usize, most: usize) -> usize {
    let cores = if means.gpu { CORES_OF_A_GPU } else { f64::from(means.cpus) };
    let wanted = (time.as_secs_f64() / cores / TASK.as_secs_f64()).floor();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "not negative; too large saturates"
    )]
    let wanted = wanted as usize;
    wanted.min(tiles).min(most).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORE: Means = Means { cpus: 1, gpu: false };

    #[test]
    fn a_task_has_ten_minutes_of_work() {
        let hour = Duration::from_hours(1);
        assert_eq!(tasks(hour, CORE, 1000, 1001), 6);
        assert_eq!(tasks(hour, Means { cpus: 3, gpu: false }, 1000, 1001), 2);
        assert_eq!(tasks(64 * hour, Means { cpus: 3, gpu: true }, 1000, 1001), 6);
        assert_eq!(tasks(Duration::from_secs(1), CORE, 1000, 1001), 1);
    }

    #[test]
    fn tiles_and_the_cluster_bound_the_number() {
        let year = Duration::from_hours(8766);
        assert_eq!(tasks(year, CORE, 7, 1001), 7);
        assert_eq!(tasks(year, CORE, 1_000_000, 1001), 1001);
        assert_eq!(tasks(Duration::MAX, CORE, 7, usize::MAX), 7);
        assert_eq!(tasks(Duration::ZERO, CORE, 7, 1001), 1);
    }
}
