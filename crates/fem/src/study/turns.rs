//! Where damped modes turn from decay to growth over friction, and back.

use faer::c64;

use super::growth::grows;
use super::transitions::{Event, Search, Transition, lost};
use crate::Error;
use crate::modes::{Basis, Pair, likeness, pairs};
use crate::sweep::Mode;

/// Steps by which modes are followed from one value of μ to the next.
const STEPS: usize = 32;

/// What became of a mode that grows, followed to the other value of μ.
enum Followed {
    /// It grows there, too.
    Grows,
    /// It turns, at a coefficient of friction, with a frequency in Hz.
    Turns(f64, f64),
    /// It jumps to another one.
    Lost,
}

/// The eigenvalues of the projected problem at equal steps between two values of μ, each found when it is asked for.
struct Grid {
    mus: Vec<f64>,
    pairs: Vec<Option<Vec<Pair>>>,
}

impl Search<'_> {
    /// The turns between two neighbouring values of μ, the first of them number `step`. Modes that grow at one of both are followed to the other: numbers may
    /// be exchanged where modes come near each other. Where no number changes from decay to growth or back, nothing is looked for.
    pub(super) fn turns(
        &self,
        basis: &Basis,
        modes: &[Mode],
        step: usize,
        missed: &mut Vec<String>,
    ) -> Result<Vec<Transition>, Error> {
        let mut found = Vec::new();
        let growing = |mode: &Mode| [step, step + 1].map(|i| grows(mode.states[i].lambda, true));
        if modes.iter().all(|mode| growing(mode)[0] == growing(mode)[1]) {
            return Ok(found);
        }
        let [first, last] = [step, step + 1].map(|i| self.range.mus[i]);
        let mus = (0..=STEPS).map(|k| first + (last - first) * k as f64 / STEPS as f64).collect();
        let mut grid = Grid { mus, pairs: vec![None; STEPS + 1] };
        for (event, from) in [(Event::Onset, 1), (Event::End, 0)] {
            for (number, mode) in modes.iter().enumerate().filter(|(_, mode)| growing(mode)[from]) {
                let lambda = mode.states[step + from].lambda;
                match self.followed(basis, &mut grid, from == 1, lambda)? {
                    Followed::Grows => {}
                    Followed::Turns(mu, frequency) => {
                        found.push(Transition { event, mu, frequency, modes: vec![number] });
                    }
                    Followed::Lost => missed.push(format!(
                        "the mode of {:.1} Hz turns between mu = {first} and {last}, but where was not found: take more values of mu there",
                        lambda.im / std::f64::consts::TAU
                    )),
                }
            }
        }
        Ok(found)
    }

    /// Follows a mode that grows at one end of a grid to the other one.
    fn followed(&self, basis: &Basis, grid: &mut Grid, back: bool, lambda: c64) -> Result<Followed, Error> {
        let place = |k: usize| if back { STEPS - k } else { k };
        let at = grid.mus[place(0)];
        let apart = |pair: &Pair| (pair.lambda - lambda).norm();
        let all = self.of(grid, basis, place(0))?;
        let mut known = nearest(all, |pair| -apart(pair)).ok_or_else(|| lost(at, lambda))?;
        for k in 1..=STEPS {
            let (from, to) = (grid.mus[place(k - 1)], grid.mus[place(k)]);
            let all = self.of(grid, basis, place(k))?;
            let next = nearest(all, |pair| alike(&known, pair)).ok_or_else(|| lost(to, lambda))?;
            if !grows(next.lambda, true) {
                return self.turn(basis, [(to, next), (from, known)]);
            }
            known = next;
        }
        Ok(Followed::Grows)
    }

    /// Where a mode turns between a value of μ where it decays and one where it grows, by bisection to rounding on the projected problem. It is followed by its shape: other modes
    /// that grow may be near.
    fn turn(
        &self,
        basis: &Basis,
        [(mut off, mut decays), (mut on, mut grown)]: [(f64, Pair); 2],
    ) -> Result<Followed, Error> {
        const BISECTIONS: usize = 48;
        /// Growth over the frequency up to which it is none: a bisection ends with that of rounding, or at a jump to another mode.
        const NONE: f64 = 1e-6;
        for _ in 0..BISECTIONS {
            let middle = f64::midpoint(off, on);
            let all = pairs(&basis.at(middle, self.range.slope))?;
            let either = |pair: &Pair| alike(&decays, pair).max(alike(&grown, pair));
            let pair = nearest(&all, either).ok_or_else(|| lost(middle, grown.lambda))?;
            if pair.lambda.re > 0.0 {
                (on, grown) = (middle, pair);
            } else {
                (off, decays) = (middle, pair);
            }
        }
        let turns = grown.lambda.re < NONE * grown.lambda.norm();
        Ok(if turns { Followed::Turns(f64::midpoint(off, on), grown.frequency()) } else { Followed::Lost })
    }

    /// The pairs at one place of a grid.
    fn of<'a>(&self, grid: &'a mut Grid, basis: &Basis, place: usize) -> Result<&'a [Pair], Error> {
        let slot = &mut grid.pairs[place];
        if slot.is_none() {
            *slot = Some(pairs(&basis.at(grid.mus[place], self.range.slope))?);
        }
        Ok(slot.as_deref().unwrap_or_default())
    }
}

/// How much a pair is like a known one, by shape and eigenvalue.
fn alike(known: &Pair, pair: &Pair) -> f64 {
    likeness(&known.vector, &pair.vector) - (known.lambda - pair.lambda).norm() / known.lambda.norm()
}

/// The pair that has most of something.
fn nearest(all: &[Pair], of: impl Fn(&Pair) -> f64) -> Option<Pair> {
    all.iter().max_by(|a, b| of(a).total_cmp(&of(b))).cloned()
}
