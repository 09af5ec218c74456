//! The transient of many instances at a time in the lanes of the CPU's vector registers.
//!
//! The method: Taylor series over the step, events located inside it. Lanes are
//! asynchronous: each has its own instance, time, step and contact state, and none waits for another. A run
//! is cut into parts, each stepped by code that does only what its part needs.
//!
//! | question | where |
//! |---|---|
//! | a sweep on all cores; some instances of it; those that need double precision | [`records`], [`outcomes`], [`again`] |
//! | one instance between passes, and as scalars | [`job`], [`words`] |
//! | one part of the run: which lanes, step by step | [`march`], [`pass`](mod@pass), [`block`], [`count`] |
//! | eigenvalues of many equilibria | [`linear`] |
//! | numbers in lanes | [`vector`], [`polynomial`], [`angle`], [`constants`] |
//! | a step: its series, its length | [`expand`], [`friction`], [`layer`](mod@layer), [`reach`] |
//! | its first event, and what that does | [`functions`], [`function`], [`root`], [`events`], [`carry`], [`transitions`], [`impacts`]; lane by lane: [`contact`] |
//! | what is seen on the way | [`nodes`], [`observe`], [`crossings`], [`spectrum`], [`stretches`] |
//! | the single mass in closed form | [`swing`], [`swing_step`], [`swing_sums`], [`swing_cycle`], [`cycle`] |

#![expect(
    clippy::inline_always,
    clippy::needless_range_loop,
    reason = "only what is inlined is compiled for the instruction set; several arrays share an index"
)]
#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "counts and codes travel as scalars of the lanes"
)]

pub mod again;
pub mod angle;
pub mod block;
pub mod carry;
pub mod constants;
pub mod contact;
pub mod count;
pub mod craft;
pub mod crossings;
pub mod cycle;
pub mod drive;
pub mod events;
pub mod expand;
pub mod flight;
pub mod forms;
pub mod friction;
pub mod function;
pub mod functions;
pub mod heat;
pub mod hunts;
pub mod impacts;
pub mod job;
pub mod layer;
pub mod linear;
pub mod march;
pub mod motion;
pub mod nodes;
pub mod observe;
pub mod outcomes;
pub mod pass;
pub mod polynomial;
pub mod reach;
pub mod records;
pub mod root;
pub mod scalar;
pub mod section;
pub mod spectrum;
pub mod stretches;
pub mod swing;
pub mod swing_cycle;
pub mod swing_step;
pub mod swing_sums;
pub mod transitions;
pub mod vector;
pub mod words;

use std::sync::atomic::Ordering;

use pulp::{Simd, WithSimd};

use crate::engine::kernel::scalar::Real;
use crate::engine::precision::Precision;
use crate::model::piece::LawForm;
use job::{Job, Part};
use march::Settings;
use pass::pass;
use scalar::Scalar;

/// Order of the Taylor series: one of those whose steps damp an undamped mode whatever their length.
pub const ORDER: usize = 13;

/// Bound on the truncation of a step, relative to the motion. Fewer steps per period ask for less: at the
/// default of 12 the deviations of `paper_map` are those of the reference to 1e-7 at the 99th percentile, at 5
/// to 1e-3. In f32 a smaller bound than 1e-4 drowns in the rounding.
#[must_use]
pub fn tolerance(precision: Precision, steps_per_period: u32) -> f64 {
    let floor = match precision {
        Precision::F32 => 1e-4,
        Precision::F64 => 1e-13,
    };
    (1e-6 * (12.0 / f64::from(steps_per_period)).powi(8)).clamp(floor, 1e-3)
}

/// A scalar the engine computes in.
pub trait Lanes: Real {
    /// Takes jobs whose laws have one form through some parts of their runs; `single` says whether they are all single masses
    /// with straight laws.
    fn run(jobs: &mut [Job<Self>], parts: &[Part], single: bool, settings: Settings);
}

macro_rules! lanes {
    ($scalar:ty) => {
        impl Lanes for $scalar {
            fn run(jobs: &mut [Job<Self>], parts: &[Part], single: bool, settings: Settings) {
                match jobs.first().map(Job::law) {
                    None => {}
                    Some(LawForm::Pieces) => settings.terms.instructions.dispatch(Parts::<
                        '_,
                        $scalar,
                        { ORDER + 1 },
                        { motion::PIECES },
                    > {
                        jobs,
                        which: parts,
                        single,
                        settings,
                    }),
                    Some(LawForm::Exponential | LawForm::Rational) => {
                        settings.terms.instructions.dispatch(Parts::<
                            '_,
                            $scalar,
                            { ORDER + 1 },
                            { motion::CURVED },
                        > {
                            jobs,
                            which: parts,
                            single,
                            settings,
                        })
                    }
                }
            }
        }

        impl<const N: usize, const LAW: bool> WithSimd for Parts<'_, $scalar, N, LAW> {
            type Output = ();
            #[inline(always)]
            fn with_simd<S: Simd>(self, simd: S) {
                self.run(simd);
            }
        }
    };
}

lanes!(f32);
lanes!(f64);

/// Some parts of some jobs.
struct Parts<'a, T: Real, const N: usize, const LAW: bool> {
    jobs: &'a mut [Job<T>],
    which: &'a [Part],
    single: bool,
    settings: Settings<'a>,
}

impl<T: Real, const N: usize, const LAW: bool> Parts<'_, T, N, LAW> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S)
    where
        T: Scalar<S>,
    {
        let Parts { jobs, which, single, settings } = self;
        for part in which {
            pass::<S, T, N, LAW>(simd, jobs, *part, single, settings);
            if settings.cancel.load(Ordering::Relaxed) {
                return;
            }
        }
    }
}
