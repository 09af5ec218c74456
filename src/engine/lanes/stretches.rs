//! The stretches of a window put together: Fourier components at the frequency its crossings give.

use num_complex::Complex64;

use crate::engine::lanes::spectrum::{COMPONENTS, MOMENTS};

/// Most stretches that are kept; a longer window is integrated twice.
const MOST: usize = 256;

/// The sums of one stretch, see [`crate::engine::lanes::spectrum`].
#[derive(Clone, Copy, Debug)]
struct Stretch {
    /// The guess of the frequency.
    omega: f64,
    /// The middle of the stretch.
    middle: f64,
    /// Half its length.
    half: f64,
    sums: [f64; COMPONENTS],
}

/// The stretches of a window up to the last crossing.
#[derive(Clone, Debug, Default)]
pub struct Stretches {
    /// Stretches that are summed to their ends.
    whole: Vec<Stretch>,
    /// The stretch with the last crossing, summed up to it, and how many stretches come before it.
    last: Option<(usize, Stretch)>,
    /// Whether there were more than are kept.
    overflown: bool,
}

impl Stretches {
    /// These without any, in the memory that they had.
    #[must_use]
    pub fn cleared(mut self) -> Stretches {
        self.whole.clear();
        Stretches { whole: self.whole, ..Stretches::default() }
    }

    /// Makes room for some more: for the first ones and no others, as most windows have no more.
    pub fn reserve(&mut self, more: usize) {
        if self.whole.is_empty() {
            self.whole.reserve_exact(more);
        } else {
            self.whole.reserve(more);
        }
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.whole.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.whole.is_empty()
    }

    /// Adds the stretch of length `2 half` around `middle`; `noted` are its sums at its last crossing.
    pub fn push(
        &mut self,
        omega: f64,
        [middle, half]: [f64; 2],
        sums: [f64; COMPONENTS],
        noted: Option<[f64; COMPONENTS]>,
    ) {
        if self.whole.len() == MOST {
            self.overflown = true;
            return;
        }
        if let Some(sums) = noted {
            self.last = Some((self.whole.len(), Stretch { omega, middle, half, sums }));
        }
        self.whole.push(Stretch { omega, middle, half, sums });
    }

    /// The last crossing was not noted.
    pub fn forget(&mut self) {
        self.last = None;
    }

    /// The components of `ẍ2` and `ÿ1` at `omega`, phases from `start` on; `None` when a guess was so far off
    /// that the terms left out of a series may exceed `bound` times a component. `rms` are the root mean
    /// squares of both signals.
    #[must_use]
    pub fn components(&self, omega: f64, start: f64, rms: [f64; 2], bound: f64) -> Option<[[f64; 2]; 2]> {
        let (before, last) = self.last.as_ref().filter(|_| !self.overflown)?;
        let mut sums = [Complex64::ZERO; 2];
        let mut left_out = 0.0;
        for stretch in self.whole[..*before].iter().chain([last]) {
            let shift = (omega - stretch.omega) * stretch.half;
            let turned = Complex64::cis(-omega * (stretch.middle - start));
            let mut factor = turned;
            for (m, terms) in stretch.sums.chunks_exact(4).enumerate() {
                for (sum, term) in sums.iter_mut().zip(terms.chunks_exact(2)) {
                    *sum += factor * Complex64::new(term[0], term[1]);
                }
                factor *= Complex64::new(0.0, -shift) / (m + 1) as f64;
            }
            // The first term left out, for a signal of this root mean square over the whole stretch.
            left_out += factor.norm() * 2.0 * stretch.half / (2.0 * MOMENTS as f64 + 1.0).sqrt();
        }
        let small = sums.iter().zip(rms).all(|(sum, rms)| left_out * rms <= bound * sum.norm());
        small.then(|| sums.map(|sum| [sum.re, sum.im]))
    }
}
