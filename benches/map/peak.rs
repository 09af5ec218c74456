//! The FMA peak of one core, measured: independent accumulators in the widest registers there are.
//!
//! Every fused multiply-add `a ← a m + c` with `m = c = 1/2` tends to 1, so that the sum over all lanes of all
//! accumulators is known and nothing can be optimised away unseen.

use std::hint::black_box;
use std::time::Instant;

use pulp::{Arch, Simd, WithSimd};
use squealmap::engine::precision::Precision;

/// Accumulators that keep every multiplier busy: more than latency times ports of any CPU of today (4 × 2), and
/// as many as leave two of 16 registers for the factors.
const MANY: usize = 14;

/// Turns of one slice: about a millisecond.
const TURNS: u64 = 200_000;

/// Slices of which the fastest counts.
const SLICES: usize = 60;

/// Latency times ports, the number of multiply-adds in flight, on CPUs of today: 4 cycles and one or two ports
/// (3 to 5 cycles on older ones).
const IN_FLIGHT: std::ops::RangeInclusive<f64> = 2.8..=10.5;

/// The peak of one core.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Peak {
    /// Flop per second, a multiply-add counted as two.
    pub(crate) flops: f64,
    /// Lanes of a register.
    pub(crate) lanes: usize,
    /// How much faster than one chain of multiply-adds, each waiting for the one before: latency times ports.
    pub(crate) in_flight: f64,
}

impl Peak {
    /// Measures it on the present thread.
    ///
    /// # Errors
    /// When the sums are wrong, or the speed is not a plausible multiple of that of a single chain.
    pub(crate) fn measure(precision: Precision) -> Result<Peak, String> {
        let (many, lanes) = speed::<MANY>(precision)?;
        let (one, _) = speed::<1>(precision)?;
        let in_flight = many / one;
        if !IN_FLIGHT.contains(&in_flight) {
            return Err(format!("{in_flight:.1} multiply-adds in flight in {precision}: no peak of a CPU"));
        }
        Ok(Peak { flops: many, lanes, in_flight })
    }
}

/// Flop per second with `CHAINS` accumulators, and the lanes of a register.
#[expect(clippy::float_cmp, reason = "sums of ones are exact")]
fn speed<const CHAINS: usize>(precision: Precision) -> Result<(f64, usize), String> {
    let arch = Arch::new();
    let mut best = f64::INFINITY;
    let mut lanes = 1;
    for _ in 0..SLICES {
        let began = Instant::now();
        let (sum, found) = match precision {
            Precision::F32 => arch.dispatch(Chains::<f32, CHAINS>(black_box(0.5))),
            Precision::F64 => arch.dispatch(Chains::<f64, CHAINS>(black_box(0.5))),
        };
        best = best.min(began.elapsed().as_secs_f64());
        lanes = found;
        let expected = (CHAINS * lanes) as f64;
        if black_box(sum) != expected {
            return Err(format!("the multiply-adds of the peak sum to {sum} instead of {expected}"));
        }
    }
    Ok((2.0 * (lanes * CHAINS) as f64 * TURNS as f64 / best, lanes))
}

/// The loop: the factor, which the compiler does not know.
struct Chains<T, const CHAINS: usize>(T);

macro_rules! chains {
    ($scalar:ty, $lanes:ident, $splat:ident, $multiply_add:ident, $sum:ident) => {
        impl<const CHAINS: usize> WithSimd for Chains<$scalar, CHAINS> {
            type Output = (f64, usize);

            #[inline(always)]
            fn with_simd<S: Simd>(self, simd: S) -> (f64, usize) {
                let half = simd.$splat(self.0);
                let mut chains = [simd.$splat(0.0); CHAINS];
                for _ in 0..TURNS {
                    for chain in &mut chains {
                        *chain = simd.$multiply_add(*chain, half, half);
                    }
                }
                let sum = chains.into_iter().map(|chain| f64::from(simd.$sum(chain))).sum();
                (sum, S::$lanes)
            }
        }
    };
}

chains!(f32, F32_LANES, splat_f32s, mul_add_e_f32s, reduce_sum_f32s);
chains!(f64, F64_LANES, splat_f64s, mul_add_e_f64s, reduce_sum_f64s);
