//! Where the stability of a cycle changes along its branch.

use nalgebra::DVector;

use crate::study::cycles::map::ReturnMap;
use crate::study::cycles::newton::{Fixed, fixed};

/// What is special about a point of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Special {
    /// Two cycles meet: a multiplier is +1.
    Fold,
    /// The period doubles: a multiplier is −1.
    Doubling,
    /// A pair of multipliers is on the unit circle.
    Torus,
    /// Two cycles of other contact states meet, and no multiplier says so.
    Corner,
    /// The contact states change, and the cycle goes on.
    Border,
    /// The cycle shrinks to the equilibrium, whose stability changes.
    Hopf,
    /// The branch ends: no cycle of this kind is beside it.
    End,
}

impl Special {
    /// All of them.
    pub const ALL: [Special; 7] = [
        Special::Fold,
        Special::Doubling,
        Special::Torus,
        Special::Corner,
        Special::Border,
        Special::Hopf,
        Special::End,
    ];

    /// Those of cycles that have curves over two parameters.
    pub const FOLLOWED: [Special; 4] = [Special::Fold, Special::Corner, Special::Doubling, Special::Torus];

    /// The name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Special::Fold => "fold",
            Special::Doubling => "doubling",
            Special::Torus => "torus",
            Special::Corner => "corner",
            Special::Border => "border",
            Special::Hopf => "hopf",
            Special::End => "end",
        }
    }

    /// That of a name.
    #[must_use]
    pub fn of(name: &str) -> Option<Special> {
        Special::ALL.into_iter().find(|special| special.name() == name)
    }
}

/// Halvings between two points of a branch: to the rounding of what a flight knows.
const HALVINGS: usize = 36;

/// Where no multiplier comes this near to the unit circle, what changes the stability is no bifurcation of a smooth map.
const SMOOTH: f64 = 0.3;

/// The point between two neighbours of a branch at which their stability changes, if it does.
pub(super) fn between(map: &ReturnMap, before: &Fixed, after: &Fixed) -> Option<(Fixed, Special)> {
    let stable = before.unstable();
    if stable == after.unstable() || before.is_neutral() || after.is_neutral() {
        return None;
    }
    let chord = &after.place - &before.place;
    let along = chord.normalize();
    let [mut low, mut high] = [0.0, 1.0];
    let [mut from, mut to] = [before.clone(), after.clone()];
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        let Some(here) = fixed(map, &(&before.place + &chord * middle), &along) else { break };
        if here.unstable() == stable {
            (low, from) = (middle, here);
        } else {
            (high, to) = (middle, here);
        }
    }
    let multipliers = to.multipliers();
    let apart = |value: f64| (value - 1.0).abs();
    let critical = multipliers.iter().min_by(|a, b| apart(a.norm()).total_cmp(&apart(b.norm())))?;
    let is_smooth = apart(critical.norm()) <= SMOOTH;
    let special = if from.order != to.order {
        Special::Border
    } else if !is_smooth {
        // The halvings have met a change of contact that the orders do not tell.
        if from.along() * to.along() < 0.0 { Special::Corner } else { Special::Border }
    } else if from.along() * to.along() < 0.0 || critical.im == 0.0 && critical.re > 0.0 {
        Special::Fold
    } else if critical.im == 0.0 {
        Special::Doubling
    } else {
        Special::Torus
    };
    // The halvings end where a multiplier is seen to be outside, which is not where it crosses.
    let crosses = matches!(special, Special::Doubling | Special::Torus);
    let at =
        if crosses { crossing(map, &to.place, &to, special).filter(|at| at.order == to.order) } else { None };
    Some((at.unwrap_or(to), special))
}

/// The first step along the branch, and when it ends the search.
const STEPS: [f64; 2] = [1e-4, 1e-7];

/// Steps of the search.
const MOST_STEPS: usize = 14;

/// Where a multiplier crosses the unit circle: a root along the branch, by secants.
pub(super) fn crossing(
    map: &ReturnMap<'_>,
    guess: &DVector<f64>,
    before: &Fixed,
    special: Special,
) -> Option<Fixed> {
    let count = map.count();
    // At a fold the parameter is an extremum of the branch; elsewhere it tells the cycles apart.
    let mut along = before.tangent.clone();
    if special == Special::Fold {
        along[count] = 0.0;
    } else {
        along.fill(0.0);
        along[count] = 1.0;
    }
    let along = along.normalize();
    let at = |by: f64| {
        let here = fixed(map, &(guess + &along * by), &along)?;
        let test = test(&here, special)?;
        Some((here, test))
    };
    let mut last = (0.0, at(0.0)?.1);
    let mut by = STEPS[0];
    for _ in 0..MOST_STEPS {
        let (here, test) = at(by)?;
        let step = -test * (by - last.0) / (test - last.1);
        if !step.is_finite() {
            return None;
        }
        if step.abs() <= STEPS[1] {
            // The last step is known, too.
            return Some(at(by + step).map_or(here, |(there, _)| there));
        }
        last = (by, test);
        by += step;
    }
    None
}

/// A number that is zero where the point is special, and changes its sign there.
fn test(fixed: &Fixed, special: Special) -> Option<f64> {
    match special {
        Special::Fold => Some(fixed.along()),
        Special::Doubling => {
            let count = fixed.jacobian.nrows();
            let mut matrix = fixed.jacobian.columns(0, count).into_owned();
            for i in 0..count {
                matrix[(i, i)] += 1.0;
            }
            Some(matrix.determinant())
        }
        Special::Torus => {
            let pairs = fixed.multipliers().into_iter().filter(|multiplier| multiplier.im > 0.0);
            let apart = pairs.map(|multiplier| multiplier.norm() - 1.0);
            apart.min_by(|a, b| a.abs().total_cmp(&b.abs()))
        }
        _ => None,
    }
}
