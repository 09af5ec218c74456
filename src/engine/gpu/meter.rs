//! What a device was given to do, counted for the benches.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

#[doc(inline)]
pub use crate::engine::march::lane::WARP;

/// Counters of a device.
#[derive(Debug, Default)]
pub(super) struct Meter {
    up: AtomicU64,
    back: AtomicU64,
    steps: AtomicU64,
    of_warps: AtomicU64,
    lanes: AtomicU64,
    room: AtomicU64,
    computed: AtomicU64,
    waited: AtomicU64,
}

/// What a [`Device`](crate::engine::gpu::device::Device) has done since it was opened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Metered {
    /// Bytes that were sent to it.
    pub up: u64,
    /// Bytes that were read back from it.
    pub back: u64,
    /// Steps of the lanes of transients, as their kernels count them.
    pub steps: u64,
    /// The same if every lane of a warp of [`WARP`] took as many in a dispatch as the one that took most.
    pub of_warps: u64,
    /// Lanes with an instance, summed over the rounds.
    pub lanes: u64,
    /// Lanes that there was room for.
    pub room: u64,
    /// Time that it computed transients, ns; 0 where it does not tell.
    pub computed: u64,
    /// Time that the host waited for it, ns.
    pub waited: u64,
}

impl Meter {
    pub(super) fn carry(&self, up: usize, back: usize) {
        self.up.fetch_add(up as u64, Ordering::Relaxed);
        self.back.fetch_add(back as u64, Ordering::Relaxed);
    }

    pub(super) fn step(&self, steps: u64, of_warps: u64) {
        self.steps.fetch_add(steps, Ordering::Relaxed);
        self.of_warps.fetch_add(of_warps, Ordering::Relaxed);
    }

    pub(super) fn hold(&self, lanes: usize, room: usize) {
        self.lanes.fetch_add(lanes as u64, Ordering::Relaxed);
        self.room.fetch_add(room as u64, Ordering::Relaxed);
    }

    pub(super) fn compute(&self, nanoseconds: f64) {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        self.computed.fetch_add(nanoseconds as u64, Ordering::Relaxed);
    }

    /// Counts the time of what waits for the device.
    pub(super) fn wait<T>(&self, waits: impl FnOnce() -> T) -> T {
        let began = Instant::now();
        let waited = waits();
        let nanoseconds = u64::try_from(began.elapsed().as_nanos()).unwrap_or(u64::MAX);
        self.waited.fetch_add(nanoseconds, Ordering::Relaxed);
        waited
    }

    pub(super) fn read(&self) -> Metered {
        let of = |counter: &AtomicU64| counter.load(Ordering::Relaxed);
        Metered {
            up: of(&self.up),
            back: of(&self.back),
            steps: of(&self.steps),
            of_warps: of(&self.of_warps),
            lanes: of(&self.lanes),
            room: of(&self.room),
            computed: of(&self.computed),
            waited: of(&self.waited),
        }
    }
}
