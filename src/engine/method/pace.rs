//! The longest step that a Taylor series of some order may take of a mode, whether the motion shows it or not.

use crate::model::fastest::Fastest;
use crate::model::piece::{LawForm, Piece, PieceChain};
use crate::model::scaled::Scaled;

/// Beyond this many radians of an undamped mode a step of even order makes it grow: the first excess over 1 of the
/// step's amplification lies at 2.02 for order 8, 1.86 for order 12 and 2.11 for order 16.
pub const STABLE: f64 = 1.8;

/// A step of order 13 only ever damps such a mode, up to 3.6 radians; so far the nodes and samples within a step show
/// what it does.
pub const SEEN: f64 = 2.35;

/// In contact, the last term of a mode's own series may be this part of the mode. Contact may last for the whole run, and
/// what rings unseen is still there at its end. A step takes less than the last term from the mode: a tenth of it at even
/// orders.
pub const KEPT: f64 = 5e-7;

/// [`KEPT`] at order 13, whose steps take half of the last term from the mode.
const KEPT_DAMPED: f64 = 1e-7;

/// Where the tolerance is coarse, the last term may be this part of the tolerance instead. That holds for modes that do not
/// ring more often within a run than the motion does: up to [`SLOW`] times `ω0`.
const KEPT_OF_TOLERANCE: f64 = 2.5e-3;

/// [`KEPT_OF_TOLERANCE`] at order 13.
const KEPT_OF_TOLERANCE_DAMPED: f64 = 1e-2;

/// The fastest mode to which [`KEPT_OF_TOLERANCE`] applies, by `ω0`.
const SLOW: f64 = 2.0;

/// A mode that holds slip on a piece of the law may be raised to the tolerance of a position; for a velocity that is the
/// tolerance times the rate of the mode. A piece that is this many times as wide does not notice. Of 180 jagged tables one
/// does at 400 times.
const RAISED: f64 = 2000.0;

/// The normal force and the inertia of slip change on the way; the rate of a piece may rise with them by this factor. So much
/// more counts the slope of an exponential that drives the motion away.
pub const HARDER: f64 = 2.0;

/// Of a piece that drives the motion away only this part of its rate counts. The motion itself shows that it is driven, and
/// the truncation of its series shortens the step. But a series over ten thousand times the right step tells nothing at all.
const SHOWN: f64 = 1.0 / 16.0;

/// How far a mode may turn within a step, radians. The bounds are [`STABLE`] or [`SEEN`], and the last term of the mode's
/// own series, `(|λ| h)^n/n!`: it stays below a tolerance, and in contact below [`KEPT`] as well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turns {
    tolerance: f64,
    contact: f64,
    slow: f64,
    flight: f64,
    layer: Layer,
}

/// How far a step of slip may go on a curved law, near whose rest friction may change within a layer of speeds so thin that
/// no bound on positions sees it.
///
/// As a function of complex time the motion has a pole near by, where the argument of the law runs to its own end: the series
/// of the forces holds only up to there, and those of the positions, which hardly move in a layer, do not show it. With
/// `v' = a + E u`, where `u` is the law's share that fades with speed, scaled to 1 now, `A = a + E` is the acceleration now. Of
/// an exponential of rate `r` the pole lies at the time `ln(A/E) / (r (A − E))`, and of a rational law no nearer than
/// `(1 + r v) / (r (|A| + 2 |E|))`. Where the acceleration is about to change, at the rate `J`,
/// `|A| t + |J| t²/2` stands in place of `|A| t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// A part of the way to the pole.
    pole: f64,
    /// The largest exponent by which the slope of the law lets the motion grow or decay within a step.
    turn: f64,
}

/// Where the acceleration `A` is more than this many shares `E`, what an exponential's pole does to the forces is within the
/// truncation.
pub const HIDDEN: f64 = 400.0;

/// An exponential is left behind by a motion that goes away from it: from some 40 of its widths on what remains of it is too little
/// to show, wherever the pole is. With this factor of the fourth power of the widths a step may be longer.
pub const LEFT_BEHIND: f64 = 1.0 / (40.0 * 40.0 * 40.0);

impl Layer {
    /// The inverse of the longest step at the relative speed `speed`; its first and second rate of change are `relative`, and
    /// `share` is what friction by the part of the law that fades with speed has in the first, positive where friction falls.
    #[must_use]
    pub fn pace(&self, law: &PieceChain, relative: [f64; 2], share: f64, speed: f64) -> f64 {
        let [reach, along] = self.inverses(law.form());
        let (rate, leaves) = (law.rate(), relative[0] > 0.0);
        let [relative, turning] = relative.map(f64::abs);
        let widths = rate * speed;
        let away = 1.0 + widths;
        let (held, toward) = match law.form() {
            LawForm::Exponential => {
                // By `ln y ≥ 4 (√y − 1)/(√y + 1)`.
                let root = relative.min(share.abs() * HIDDEN).sqrt() + share.abs().sqrt();
                let behind = if leaves { widths.powi(4) * LEFT_BEHIND } else { 0.0 };
                let slope = if share > 0.0 { HARDER * share } else { -share };
                ((0.25 * root * root * reach).max(slope * along), relative * reach / (away + behind))
            }
            LawForm::Pieces | LawForm::Rational => (0.0, (relative * reach + share.abs() * along) / away),
        };
        // In the time `t` the motion may come as far as `A t + J t²/2`.
        let (toward, turning) = (rate * toward, rate * turning * reach / away);
        (rate * held).max(0.5 * (toward + (toward * toward + 2.0 * turning).sqrt()))
    }

    /// The factors of both in [`Layer::pace`].
    #[must_use]
    pub fn inverses(&self, form: LawForm) -> [f64; 2] {
        match form {
            LawForm::Exponential => [1.0 / self.pole, 1.0 / self.turn],
            LawForm::Pieces | LawForm::Rational => [1.0 / self.pole, 2.0 / self.pole],
        }
    }
}

impl Turns {
    /// The bounds for series of an order. An infinite tolerance asks for steps of fixed length, which nothing here shortens.
    #[must_use]
    pub fn new(order: usize, tolerance: f64) -> Turns {
        if !tolerance.is_finite() {
            let endless = f64::INFINITY;
            let layer = Layer { pole: endless, turn: endless };
            return Turns { tolerance, contact: endless, slow: endless, flight: endless, layer };
        }
        let (kept, part) =
            if damps(order) { (KEPT_DAMPED, KEPT_OF_TOLERANCE_DAMPED) } else { (KEPT, KEPT_OF_TOLERANCE) };
        Turns {
            tolerance,
            contact: turn(order, tolerance.min(kept)),
            slow: turn(order, tolerance.min(kept.max(tolerance * part))),
            flight: turn(order, tolerance),
            layer: Layer { pole: tolerance.powf(0.75 / order as f64), turn: turn(order, tolerance) },
        }
    }

    /// How far a step may go on a curved law.
    #[must_use]
    pub fn layer(&self) -> Layer {
        self.layer
    }

    /// The longest step of slip on a piece of the law, infinite where that of slip is enough.
    #[must_use]
    pub fn longest_step_on(&self, model: &Scaled, piece: usize) -> f64 {
        let beyond = fastest_beyond(model, piece);
        let law = &model.law;
        let lower = if piece == 0 { 0.0 } else { law.kinks[piece - 1] };
        let width = law.kinks.get(piece).map_or(f64::INFINITY, |upper| upper - lower);
        if law.slope_of(piece) >= 0.0 && width > RAISED * self.tolerance * beyond {
            return f64::INFINITY;
        }
        // A direction in which sliding is not unique ends the run when it comes, and says nothing of the other one.
        let [slip, reverse] =
            [0, 1].map(|way| Some(model.fastest[way]).filter(|rate| rate.is_finite()).unwrap_or_default());
        if beyond > 0.0 { self.contact / (slip.max(reverse) + beyond) } else { f64::INFINITY }
    }

    /// The longest step of slip near rest, where friction rises there along an exponential; infinite on other laws.
    #[must_use]
    pub fn longest_step_of_a_rise(&self, model: &Scaled) -> f64 {
        let Piece::Exponential { height, rate, .. } = model.law.pieces[0] else { return f64::INFINITY };
        self.layer.turn / (HARDER * rate * (-height).max(0.0) * model.n0)
    }

    /// The longest step of slip, reversed slip, stick and flight.
    #[must_use]
    pub fn longest_steps(&self, fastest: &Fastest) -> [f64; 4] {
        if self.contact.is_infinite() {
            return [f64::INFINITY; 4];
        }
        let closed = |rate: f64| if rate <= SLOW { self.slow } else { self.contact } / rate;
        let [slip, reverse, stick, free] = *fastest;
        [closed(slip), closed(reverse), closed(stick), self.flight / free]
    }
}

/// How far a mode may turn within a step.
fn turn(order: usize, tolerance: f64) -> f64 {
    let factorial: f64 = (1..=order).map(|k| k as f64).product();
    (tolerance * factorial).powf(1.0 / order as f64).min(longest_turn(order))
}

/// The longest turn for which a step of that order is of use.
#[must_use]
pub fn longest_turn(order: usize) -> f64 {
    if damps(order) { SEEN } else { STABLE }
}

/// Whether steps of that order damp an undamped mode, however long they are.
fn damps(order: usize) -> bool {
    order % 4 == 1
}

/// Whether steps are so short that a scalar of that rounding stands still: `x + ẍ h²` is `x`.
#[must_use]
pub fn stands_still(longest: f64, epsilon: f64) -> bool {
    longest * longest < epsilon
}

/// How fast the fastest mode of slip is on a piece of the law, where it is faster than [`Fastest`] counts; 0 where it is
/// not.
///
/// Friction that rises more steeply than at the equilibrium holds the motion where it is. Such a mode dies out within a step
/// that is too long for it, but a series of that length raises the remains of the mode, and the motion no longer ends at the
/// kinks of the piece.
#[must_use]
pub fn fastest_beyond(model: &Scaled, piece: usize) -> f64 {
    let law = &model.law;
    let (here, known) = (law.slope_of(piece), law.slope_of(law.index(model.v0)).max(0.0));
    if here < 0.0 {
        -SHOWN * here * model.n0
    } else if here > known {
        HARDER * (here - known) * model.n0
    } else {
        0.0
    }
}
