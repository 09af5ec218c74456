//! Where modes become unstable over friction, and where they are stable again.

use faer::c64;

use crate::Error;
use crate::assembly::{Pencil, Rows};
use crate::modes::{Basis, Factor, Pair, coalescence, pairs};
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

/// Whether a mode counts as growing or decaying. What rounding leaves of an undamped mode is some 1e-8 of its frequency.
pub(super) fn grows(lambda: c64, damped: bool) -> bool {
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
                for group in partners(&changed, modes, on, self.damped) {
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
        /// Bisections where there is no Newton's method: to rounding.
        const ALL: usize = 48;
        let mut pair = self.growing(basis, on, lambda)?.ok_or_else(|| lost(on, lambda))?;
        for _ in 0..if self.damped { ALL } else { BISECTIONS } {
            let middle = f64::midpoint(off, on);
            match self.growing(basis, middle, pair.lambda)? {
                Some(found) => (on, pair) = (middle, found),
                None => off = middle,
            }
        }
        if self.damped {
            let event = if begins { Event::Onset } else { Event::End };
            return Ok(Transition { event, mu: f64::midpoint(off, on), frequency: pair.frequency(), modes });
        }
        let found = coalescence(self.pencil, self.factor, basis, on, &pair)?;
        let event = if begins { Event::Coalescence } else { Event::Separation };
        Ok(Transition { event, mu: found.mu, frequency: found.frequency(), modes })
    }

    /// The pair that grows and is nearest to an eigenvalue, as long as it is near.
    fn growing(&self, basis: &Basis, mu: f64, lambda: c64) -> Result<Option<Pair>, Error> {
        /// Between two values of μ a frequency moves by no more than this part.
        const NEAR: f64 = 0.05;
        let apart = |pair: &Pair| (pair.lambda - lambda).norm();
        let all = pairs(&basis.at(mu, self.slope))?;
        let grown = all.into_iter().filter(|pair| grows(pair.lambda, self.damped));
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

/// Puts the two of each conjugate pair −λ̄ together; damped modes are alone.
fn partners(changed: &[usize], modes: &[Mode], at: usize, damped: bool) -> Vec<Vec<usize>> {
    /// The two of a pair differ by rounding and what is left of the residual.
    const SAME: f64 = 1e-4;
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for mode in changed {
        let lambda = modes[*mode].states[at].lambda;
        let partner = groups.iter_mut().find(|group| {
            let other = modes[group[0]].states[at].lambda;
            group.len() == 1 && !damped && (lambda + other.conj()).norm() <= SAME * lambda.norm()
        });
        match partner {
            Some(group) => group.push(*mode),
            None => groups.push(vec![*mode]),
        }
    }
    groups
}
