//! What a run takes of this machine: processor time of the host and of a software driver, allocations, memory.

use std::alloc::{GlobalAlloc, Layout, System};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// The allocator of the system, which counts.
#[derive(Debug)]
pub(crate) struct Counting;

/// Allocations so far. What a driver allocates goes its own way.
static ALLOCATIONS: AtomicU64 = AtomicU64::new(0);

// SAFETY: every call is handed to the allocator of the system as it is.
#[expect(unsafe_code, reason = "an allocator that counts")]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: as above.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(at, layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: as above.
        unsafe { System.realloc(at, layout, size) }
    }
}

/// The clock of a thread in `/proc` ticks so often in a second.
const TICKS: f64 = 100.0;

/// The threads of this process now: before a device is opened the program's own, those of its pool among them.
pub(crate) fn own() -> BTreeSet<u64> {
    threads().into_keys().collect()
}

/// Processor time by thread, s.
fn threads() -> BTreeMap<u64, f64> {
    let read = |path: std::path::PathBuf| fs::read_to_string(path).unwrap_or_default();
    let tasks = fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    tasks
        .filter_map(|task| {
            let number = task.file_name().to_str()?.parse().ok()?;
            let line = read(task.path().join("stat"));
            let (_, rest) = line.rsplit_once(')')?;
            let fields: Vec<&str> = rest.split_whitespace().collect();
            let ticks = fields.get(11)?.parse::<f64>().ok()? + fields.get(12)?.parse::<f64>().ok()?;
            Some((number, ticks / TICKS))
        })
        .collect()
}

/// The largest memory that this process has had resident, bytes.
pub(crate) fn peak_memory() -> f64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM:")).unwrap_or_default();
    line.split_whitespace().nth(1).and_then(|kib| kib.parse::<f64>().ok()).unwrap_or(f64::NAN) * 1024.0
}

/// Forgets the largest memory so far.
pub(crate) fn forget_peak() {
    let _ = fs::write("/proc/self/clear_refs", "5");
}

/// What a stretch of this process has taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Taken {
    /// Wall time.
    pub(crate) wall: Duration,
    /// Processor time of the program's own threads, s.
    pub(crate) host: f64,
    /// Processor time of a software driver's threads, s.
    pub(crate) driver: f64,
    pub(crate) allocations: u64,
}

/// The beginning of a stretch.
pub(crate) struct Ledger {
    began: Instant,
    threads: BTreeMap<u64, f64>,
    allocations: u64,
}

impl Ledger {
    pub(crate) fn open() -> Ledger {
        Ledger { threads: threads(), allocations: ALLOCATIONS.load(Ordering::Relaxed), began: Instant::now() }
    }

    /// `own` are the program's threads, and those of its crews, which have their name; all others are those of a software driver,
    /// which runs kernels on some and takes submissions on another.
    pub(crate) fn close(self, own: &BTreeSet<u64>) -> Taken {
        let wall = self.began.elapsed();
        let allocations = ALLOCATIONS.load(Ordering::Relaxed) - self.allocations;
        let (mut host, mut driver) = (0.0, 0.0);
        for (number, seconds) in threads() {
            let before = self.threads.get(&number).copied().unwrap_or(0.0);
            let name = fs::read_to_string(format!("/proc/self/task/{number}/comm")).unwrap_or_default();
            let is_own = own.contains(&number) || name.starts_with("crew");
            *(if is_own { &mut host } else { &mut driver }) += seconds - before;
        }
        Taken { wall, host, driver, allocations }
    }
}
