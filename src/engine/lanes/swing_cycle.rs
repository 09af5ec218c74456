//! The stick-slip cycle of the single mass on a belt of one velocity. Only one cycle is followed in a stretch: whatever came
//! before, stick ends in the same state but for rounding, at the limit of friction and with the velocity of the belt. From
//! there on the motion repeats itself, and whole cycles up to the end of the stretch are added at once.
//!
//! Slip ends `2 μ_d N` inside the limit of stick. Without any dynamic friction and damping it ends on it, and rounding decides every
//! time whether the body sticks or slips back: what slips back tells nothing of the next cycle.

use pulp::Simd;

use crate::engine::lanes::block::Block;
use crate::engine::lanes::observe::Sums;
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::Mask;
use crate::engine::sums::sum;

/// A slip from the end of stick takes longer than half a turn at an angular frequency of about 1. A shorter one is chatter.
const SHORTEST: f64 = 1.0;

impl<S: Simd, T: Scalar<S>> Sums<S, T> {
    /// Where stick has come to its end for the second time (`slips`), adds the whole cycles that are left of the stretch;
    /// where for the first, remembers it. `window`: whether the sums of the window count.
    #[inline(always)]
    pub fn add_cycles(&mut self, b: &mut Block<S, T>, slips: Mask<S, T>, window: bool) {
        let zero = b.left.like(0.0);
        let period = self.time - self.cycle.since;
        let known = slips.and(zero.at_most(self.cycle.since)).and(zero.like(SHORTEST).less(period));
        let cycles = (b.left / known.select(period, zero.like(1.0))).floor().only(known);
        let skipped = cycles * period;
        if window {
            for i in 0..sum::WORDS {
                let once = self.window[i] - self.cycle.window[i];
                let whole = known.select(cycles.fma(once, self.window[i]), self.window[i]);
                self.window[i].put(whole);
                self.cycle.window[i].put(slips.select(whole, self.cycle.window[i]));
            }
        }
        // One that has none keeps its last.
        let rises = self.crossings - self.cycle.crossings;
        let last = known.and(zero.less(rises)).select(self.last + skipped, self.last);
        self.last.put(last);
        self.crossings += cycles * rises;
        let crossings = slips.select(self.crossings, self.cycle.crossings);
        self.cycle.crossings.put(crossings);
        self.time += skipped;
        b.left = (b.left - skipped).max(zero);
        let since = slips.select(self.time, self.cycle.since);
        self.cycle.since.put(since);
    }
}
