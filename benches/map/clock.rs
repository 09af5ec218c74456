//! Wall time, CPU time of all threads and peak memory of this process, as Linux counts them; without `/proc`
//! the last two are unknown.

use std::fs::read_to_string;
use std::time::Instant;

/// Ticks per second of the times in `/proc/self/stat`: fixed for programs, whatever the kernel's own clock.
const TICKS: f64 = 100.0;

/// Fields of `/proc/self/stat` between the name of the program and the user time.
const BEFORE_USER_TIME: usize = 11;

/// A running stop watch.
pub(crate) struct Clock {
    wall: Instant,
    cpu: Option<f64>,
}

/// What it showed, in seconds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Elapsed {
    pub(crate) wall: f64,
    pub(crate) cpu: Option<f64>,
}

impl Clock {
    pub(crate) fn start() -> Clock {
        Clock { wall: Instant::now(), cpu: cpu() }
    }

    pub(crate) fn elapsed(&self) -> Elapsed {
        let cpu = cpu().zip(self.cpu).map(|(now, then)| now - then);
        Elapsed { wall: self.wall.elapsed().as_secs_f64(), cpu }
    }
}

/// User and system time of all threads so far, in seconds.
fn cpu() -> Option<f64> {
    let stat = read_to_string("/proc/self/stat").ok()?;
    // The name stands in brackets and may hold blanks.
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |field: usize| fields.get(field)?.parse::<f64>().ok();
    Some((ticks(BEFORE_USER_TIME)? + ticks(BEFORE_USER_TIME + 1)?) / TICKS)
}

/// The most memory that was resident at one time, in MiB.
pub(crate) fn peak_memory() -> Option<f64> {
    let status = read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.split_whitespace().next()?.parse::<f64>().ok()? / 1024.0)
}
