//! Where the stability of a cycle changes along its branch.

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
    let special = if from.order != to.order {
        Special::Border
    } else if from.along() * to.along() < 0.0 || critical.im == 0.0 && critical.re > 0.0 {
        Special::Fold
    } else if critical.im == 0.0 {
        Special::Doubling
    } else {
        Special::Torus
    };
    Some((to, special))
}
