//! Where modes become unstable over friction, and where they are stable again.

use faer::c64;

use super::growth::grows;
use super::plane::{Plane, Two};
use crate::Error;
use crate::assembly::Pencil;
use crate::modes::{Basis, Factor, Ordering, Pair, coalescence, nearby, pairs};
use crate::sweep::{Mode, Range};

/// What happens to modes at a coefficient of friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// Two undamped modes become one: from here on one grows and one decays.
    Coalescence,
    /// Two undamped modes part: both are stable from here on.
    Separation,
    /// A mode loses its stiffness: from here on it grows without a frequency, as a contact that jams.
    Divergence,
    /// A damped mode begins to grow.
    Onset,
    /// A damped mode ends to grow.
    End,
}

impl Event {
    /// Its name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Coalescence => "coalescence",
            Self::Separation => "separation",
            Self::Divergence => "divergence",
            Self::Onset => "onset",
            Self::End => "end",
        }
    }
}

/// A transition between stable and unstable.
#[derive(Debug, Clone, PartialEq)]
pub struct Transition {
    /// What happens.
    pub event: Event,
    /// The coefficient of friction.
    pub mu: f64,
    /// Frequency there, Hz.
    pub frequency: f64,
    /// The modes concerned, counted from 0 in the order of the sweep: two, or one where the other was not followed or nothing coalesces.
    pub modes: Vec<usize>,
}

/// The problem on which transitions are found.
pub(super) struct Search<'a> {
    pub(super) pencil: &'a Pencil,
    pub(super) ordering: &'a Ordering,
    pub(super) factor: &'a Factor,
    pub(super) range: Range<'a>,
    pub(super) damped: bool,
}

impl Search<'_> {
    /// All transitions between the values of μ at which the modes are known, and sentences on those that were not found. What begins and ends
    /// between two values is not seen.
    pub(super) fn all(
        &self,
        basis: &mut Basis,
        modes: &[Mode],
    ) -> Result<(Vec<Transition>, Vec<String>), Error> {
        let (mut found, mut missed) = (Vec::new(), Vec::new());
        for step in 0..self.range.mus.len().saturating_sub(1) {
            if self.damped {
                found.extend(self.turns(basis, modes, step, &mut missed)?);
                continue;
            }
            for begins in [true, false] {
                // The side on which there is growth.
                let (on, off) = if begins { (step + 1, step) } else { (step, step + 1) };
                let is_on = |mode: &Mode, i: usize| {
                    let lambda = mode.states[i].lambda;
                    grows(lambda, false) || grows(-lambda.conj(), false)
                };
                let changed: Vec<usize> =
                    (0..modes.len()).filter(|m| is_on(&modes[*m], on) && !is_on(&modes[*m], off)).collect();
                for group in partners(&changed, modes, on) {
                    // Of the two only the one that decays may be followed.
                    let lambda = modes[group[0]].states[on].lambda;
                    let lambda = c64::new(lambda.re.abs(), lambda.im);
                    match self.one(basis, [self.range.mus[off], self.range.mus[on]], lambda)? {
                        One::At(mu, frequency) => {
                            let event = match (begins, lambda.im > 0.0) {
                                (true, true) => Event::Coalescence,
                                (false, true) => Event::Separation,
                                (true, false) => Event::Divergence,
                                (false, false) => Event::End,
                            };
                            found.push(Transition { event, mu, frequency, modes: group });
                        }
                        One::Everywhere => {}
                        One::Missed => missed.push(format!(
                            "two modes near {:.1} Hz become one between mu = {} and {}, but where was not found: take more values of mu there, \
                             or more modes",
                            lambda.im / std::f64::consts::TAU,
                            self.range.mus[step],
                            self.range.mus[step + 1]
                        )),
                    }
                }
            }
        }
        found.sort_by(|a, b| a.mu.total_cmp(&b.mu));
        Ok((found, missed))
    }

    /// One transition between a value of μ without growth and one with a pair that grows. The plane of the two is followed to where they part.
    fn one(&self, basis: &mut Basis, [off, on]: [f64; 2], lambda: c64) -> Result<One, Error> {
        /// Steps over which the two are followed.
        const STEPS: i32 = 16;
        /// Bisections before Newton's method, which needs to start near a coalescence; and without it, to rounding.
        const BISECTIONS: [u32; 2] = [10, 45];
        let Some(mut pair) = self.known(basis, on, lambda)? else { return Ok(One::Missed) };
        let step = (off - on) / f64::from(STEPS);
        let (mut grows, mut parts) = (on, None);
        for k in 1..=STEPS {
            let mu = on + step * f64::from(k);
            let Some(found) = self.grown(basis, mu, &pair)? else {
                parts = Some(mu);
                break;
            };
            (grows, pair) = (mu, found);
        }
        // What grows on both sides has its number from another mode.
        let Some(parts) = parts else { return Ok(One::Everywhere) };
        let (near, _, start) = self.bisected(basis, [grows, parts], &pair, BISECTIONS[0])?;
        let mut space = basis.clone();
        // Growth that is next to nothing is seen late: what has been found may lie a little outside of both values.
        if let Ok(found) = coalescence(self.pencil, self.factor, &mut space, near, &start)
            && (found.mu - near).abs() <= (on - off).abs()
            && Plane::of(&start).holds(&found.vectors[0])
            && (found.frequency() / start.frequency() - 1.0).abs() < NEAR
        {
            *basis = space;
            return Ok(One::At(found.mu, found.frequency()));
        }
        // Newton's method fails where two such pairs meet at the same place, as those of a symmetric body do.
        let start = self.held(basis, near, &start)?.unwrap_or(start);
        let (grows, parts, pair) = self.bisected(basis, [grows, parts], &start, BISECTIONS[1])?;
        Ok(One::At(f64::midpoint(grows, parts), pair.frequency()))
    }

    /// Where a pair that grows at the first of two values of μ parts before the second: the last value with growth, the first without, and the pair.
    fn bisected(
        &self,
        basis: &Basis,
        [mut grows, mut parts]: [f64; 2],
        pair: &Pair,
        times: u32,
    ) -> Result<(f64, f64, Pair), Error> {
        let mut pair = pair.clone();
        for _ in 0..times {
            let middle = f64::midpoint(parts, grows);
            match self.grown(basis, middle, &pair)? {
                Some(found) => (grows, pair) = (middle, found),
                None => parts = middle,
            }
        }
        Ok((grows, parts, pair))
    }

    /// The pair that has an eigenvalue which grows, in a space that holds it; `None` where it is not found.
    fn known(&self, basis: &mut Basis, mu: f64, lambda: c64) -> Result<Option<Pair>, Error> {
        /// Apart by no more than this, the space holds it well enough.
        const SAME: f64 = 1e-6;
        let apart = |pair: &Pair| (pair.lambda - lambda).norm() / lambda.norm();
        let all = pairs(&basis.at(mu, self.range.slope))?;
        let nearest = all.into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        let Some(nearest) = nearest else { return Ok(None) };
        if apart(&nearest) <= SAME && grows(nearest.lambda, false) {
            return Ok(Some(nearest));
        }
        let held = self.held(basis, mu, &nearest)?;
        Ok(held.filter(|pair| grows(pair.lambda, false) && apart(pair) <= NEAR))
    }

    /// The same pair in a space that has taken in what it lacked; `None` where that does not help.
    fn held(&self, basis: &mut Basis, mu: f64, pair: &Pair) -> Result<Option<Pair>, Error> {
        /// What a place is known to goes by its square.
        const BOUND: f64 = 1e-6;
        let found = nearby(self.pencil, self.ordering, self.factor, basis, mu, self.range.slope, pair, BOUND);
        match found {
            Ok((pair, _)) => Ok(Some(pair)),
            Err(Error::Solver { .. }) => Ok(None),
            Err(other) => Err(other),
        }
    }

    /// The pair that grows in the plane of one that is known at a value of μ near by; `None` where the two vibrate by themselves.
    fn grown(&self, basis: &Basis, mu: f64, known: &Pair) -> Result<Option<Pair>, Error> {
        let all = pairs(&basis.at(mu, self.range.slope))?;
        Ok(match Plane::of(known).two(&all, known.lambda) {
            Some(Two::Grow(pair)) => Some(pair.clone()),
            Some(Two::Apart) | None => None,
        })
    }
}

/// What became of a search.
enum One {
    /// Coefficient of friction and frequency, Hz.
    At(f64, f64),
    /// The two grow on both sides.
    Everywhere,
    /// It was not found.
    Missed,
}

/// A coalescence has a frequency that is no farther than this part from that of the pair near it.
const NEAR: f64 = 0.05;

pub(super) fn lost(mu: f64, lambda: c64) -> Error {
    let what = format!(
        "the mode of {:.1} Hz that grows at mu = {mu} is not found on the projected problem: ask for more modes",
        lambda.im / std::f64::consts::TAU
    );
    Error::Solver { what }
}

/// Puts the two of each conjugate pair −λ̄ together.
fn partners(changed: &[usize], modes: &[Mode], at: usize) -> Vec<Vec<usize>> {
    /// The two of a pair differ by rounding and what is left of the residual.
    const SAME: f64 = 1e-4;
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for mode in changed {
        let lambda = modes[*mode].states[at].lambda;
        let partner = groups.iter_mut().find(|group| {
            let other = modes[group[0]].states[at].lambda;
            group.len() == 1 && (lambda + other.conj()).norm() <= SAME * lambda.norm()
        });
        match partner {
            Some(group) => group.push(*mode),
            None => groups.push(vec![*mode]),
        }
    }
    groups
}
