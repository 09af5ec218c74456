//! Where modes become unstable over friction, and where they are stable again.

use faer::c64;

use crate::Error;
use crate::assembly::{Pencil, Rows};
use crate::modes::{Basis, Factor, Pair, coalescence, likeness, pairs};
use crate::sweep::Mode;

/// What happens to modes at a coefficient of friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// Two undamped modes become one: from here on one grows and one decays.
    Coalescence,
    /// Two undamped modes part: both are stable from here on.
    Separation,
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

/// Whether a mode counts as growing. What rounding leaves of an undamped mode is some 1e-8 of its frequency.
#[must_use]
pub fn grows(lambda: c64, damped: bool) -> bool {
    const ROUNDING: f64 = 1e-6;
    if damped { lambda.re > 0.0 } else { lambda.re > ROUNDING * lambda.norm() }
}

/// The problem on which transitions are found.
pub(super) struct Search<'a> {
    pub(super) pencil: &'a Pencil,
    pub(super) factor: &'a Factor,
    pub(super) slope: &'a Rows,
    pub(super) mus: &'a [f64],
    pub(super) damped: bool,
}

impl Search<'_> {
    /// All transitions between the values of μ at which the modes are known. What begins and ends between two values is not seen.
    pub(super) fn all(&self, basis: &mut Basis, modes: &[Mode]) -> Result<Vec<Transition>, Error> {
        let mut found = Vec::new();
        for step in 0..self.mus.len().saturating_sub(1) {
            for begins in [true, false] {
                // The side on which there is growth.
                let (on, off) = if begins { (step + 1, step) } else { (step, step + 1) };
                let is_on = |mode: &Mode, i: usize| {
                    let lambda = mode.states[i].lambda;
                    grows(lambda, self.damped) || (!self.damped && grows(-lambda.conj(), false))
                };
                let changed: Vec<usize> =
                    (0..modes.len()).filter(|m| is_on(&modes[*m], on) && !is_on(&modes[*m], off)).collect();
                if self.damped {
                    let event = if begins { Event::Onset } else { Event::End };
                    for mode in changed {
                        let ends = [off, on].map(|i| (self.mus[i], modes[mode].states[i].lambda));
                        let (mu, frequency) = self.turn(basis, ends)?;
                        found.push(Transition { event, mu, frequency, modes: vec![mode] });
                    }
                    continue;
                }
                for group in partners(&changed, modes, on) {
                    let grown = group.iter().map(|m| modes[*m].states[on].lambda);
                    let Some(lambda) = grown.max_by(|a, b| a.re.total_cmp(&b.re)) else { continue };
                    found.push(self.one(basis, [self.mus[off], self.mus[on]], lambda, begins, group)?);
                }
            }
        }
        found.sort_by(|a, b| a.mu.total_cmp(&b.mu));
        Ok(found)
    }

    /// One transition between a value of μ without growth and one with a pair that grows.
    fn one(
        &self,
        basis: &mut Basis,
        [mut off, mut on]: [f64; 2],
        lambda: c64,
        begins: bool,
        modes: Vec<usize>,
    ) -> Result<Transition, Error> {
        /// Bisections before Newton's method, which needs to start near a coalescence.
        const BISECTIONS: usize = 10;
        let mut pair = self.growing(basis, on, lambda)?.ok_or_else(|| lost(on, lambda))?;
        for _ in 0..BISECTIONS {
            let middle = f64::midpoint(off, on);
            match self.growing(basis, middle, pair.lambda)? {
                Some(found) => (on, pair) = (middle, found),
                None => off = middle,
            }
        }
        let found = coalescence(self.pencil, self.factor, basis, on, &pair)?;
        let event = if begins { Event::Coalescence } else { Event::Separation };
        Ok(Transition { event, mu: found.mu, frequency: found.frequency(), modes })
    }

    /// Where a damped mode turns from one side to the other, and its frequency there (Hz), by bisection to rounding. It is followed by its
    /// shape: other modes that grow may be near.
    fn turn(&self, basis: &Basis, ends: [(f64, c64); 2]) -> Result<(f64, f64), Error> {
        const BISECTIONS: usize = 48;
        let closest = |mu: f64, lambda: c64| -> Result<Pair, Error> {
            let apart = |pair: &Pair| (pair.lambda - lambda).norm();
            let all = pairs(&basis.at(mu, self.slope))?;
            all.into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).ok_or_else(|| lost(mu, lambda))
        };
        let [(mut off, decaying), (mut on, growing)] = ends;
        let mut known = [closest(off, decaying)?, closest(on, growing)?];
        for _ in 0..BISECTIONS {
            let middle = f64::midpoint(off, on);
            let alike = |pair: &Pair| {
                let to = |end: &Pair| {
                    likeness(&end.vector, &pair.vector)
                        - (end.lambda - pair.lambda).norm() / end.lambda.norm()
                };
                to(&known[0]).max(to(&known[1]))
            };
            let all = pairs(&basis.at(middle, self.slope))?;
            let pair = all.into_iter().max_by(|a, b| alike(a).total_cmp(&alike(b)));
            let pair = pair.ok_or_else(|| lost(middle, growing))?;
            if grows(pair.lambda, true) {
                (on, known[1]) = (middle, pair);
            } else {
                (off, known[0]) = (middle, pair);
            }
        }
        Ok((f64::midpoint(off, on), known[1].frequency()))
    }

    /// The pair that grows and is nearest to an eigenvalue, as long as it is near.
    fn growing(&self, basis: &Basis, mu: f64, lambda: c64) -> Result<Option<Pair>, Error> {
        /// Between two values of μ a frequency moves by no more than this part.
        const NEAR: f64 = 0.05;
        let apart = |pair: &Pair| (pair.lambda - lambda).norm();
        let all = pairs(&basis.at(mu, self.slope))?;
        let grown = all.into_iter().filter(|pair| grows(pair.lambda, false));
        let nearest = grown.min_by(|a, b| apart(a).total_cmp(&apart(b)));
        Ok(nearest.filter(|pair| apart(pair) <= NEAR * lambda.norm()))
    }
}

fn lost(mu: f64, lambda: c64) -> Error {
    let what = format!(
        "the mode of {} Hz that grows at mu = {mu} is not found on the projected problem: ask for more modes",
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
