//! Level and slope of friction in a stretch of cells: as the mean of `T/N`, or within the oscillation.

use crate::cells::Cell;
use crate::cross::Measured;
use crate::settings::Settings;
use crate::trend::Trended;
use crate::within::differ;

/// Velocity of the vibration, over that of sliding, below which the mean of `T/N` is the friction at the mean velocity.
pub(super) const SMALL: f64 = 0.1;
/// The fewest cells of a segment that is cut off another one.
pub(super) const LEAST: usize = 5;
/// Swing of a force, over its mean, from which on force sensors follow a vibration that reverses the sliding.
const FOLLOWS: f64 = 0.05;

/// How the friction coefficient of a segment was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reading {
    /// The mean of `T/N`: the vibration is too small to change it.
    Mean,
    /// The law itself, within the oscillation, by force sensors that follow it.
    Within,
    /// The mean of `T/N` of a vibration that reverses the sliding: friction reaches at least that.
    Bound,
}

/// Friction of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// How it was read.
    pub reading: Reading,
    /// The friction coefficient.
    pub level: Measured,
    /// `dμ/dv`, s/m; `None` where the velocity hardly changes.
    pub slope: Option<Measured>,
    /// The same where it falls least: above the mean velocity, or early, or late; `None` but for [`Reading::Within`].
    pub least: Option<Measured>,
    /// What a falling slope has to exceed to be unstable alone: the damping along the contact over the normal force, s/m;
    /// of a contact that opens, all that [`Settings::damping_ratio`] leaves. `None` where force sensors do not follow the vibration.
    pub damping: Option<Measured>,
}

/// Relative range of a quantity.
pub(super) fn spread(cells: &[Cell], of: impl Fn(&Cell) -> f64) -> f64 {
    let values = cells.iter().map(of);
    let [low, high] =
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    (high - low) / high.abs().max(low.abs()).max(f64::MIN_POSITIVE)
}

/// Whether the force sensors follow the vibration.
pub(super) fn follows(cells: &[Cell]) -> bool {
    Cell::sum(cells).swing() >= FOLLOWS
}

/// Whether the power of friction goes into the losses, and next to none into a growth, or comes from a decay.
fn steady(cells: &[Cell]) -> bool {
    /// Growth rate, over the angular frequency, from which on it is not.
    const STEADY: f64 = 2e-3;
    let [first, last] = [&cells[0], &cells[cells.len() - 1]];
    let omega = std::f64::consts::TAU * Cell::sum(cells).frequency();
    let change = (last.amplitude() / first.amplitude()).ln().abs();
    change < STEADY * omega * (last.middle() - first.middle())
}

/// Whether the law read within the oscillation has another slope early than late: the velocity (m/s, its mean) has passed a bend.
fn turns(cells: &[Cell], velocity: f64) -> bool {
    /// Parts of the time before and after.
    const PARTS: usize = 4;
    let read = |some: &[Cell]| {
        let all = Cell::sum(some);
        all.within.law(all.velocity())
    };
    (1..PARTS).any(|part| {
        let (early, late) = cells.split_at(cells.len() * part / PARTS);
        !early.is_empty()
            && read(early)
                .zip(read(late))
                .is_some_and(|(early, late)| differ([early[1], late[1]], early[0].value, velocity))
    })
}

/// The slope (s/m) early, late, or above the mean velocity, whichever falls least: a knee that the velocity passes in between
/// makes the slope of all of them one that there is nowhere.
fn least(cells: &[Cell]) -> Option<Measured> {
    let (early, late) = cells.split_at(cells.len() / 2);
    let slopes = [early, late].map(|cells| {
        let all = Cell::sum(cells);
        all.within.law(all.velocity()).map(|[_, slope]| slope)
    });
    let all = Cell::sum(cells);
    let above = Some(all.within.above(all.velocity())).filter(|slope| slope.error.is_finite());
    slopes.into_iter().chain([above]).flatten().max_by(|a, b| a.value.total_cmp(&b.value))
}

/// Level and slope of friction.
pub(super) fn level(
    cells: &[Cell],
    all: &Cell,
    has_velocity: bool,
    limited: bool,
    settings: &Settings,
) -> Level {
    /// Relative range of the velocity from which on there is a slope.
    const MOVES: f64 = 0.05;
    /// Systematic errors of a friction coefficient, relative, and of a slope, over that of `μ/v`.
    const SYSTEMATIC: f64 = 0.01;
    /// That of a slope within the oscillation, over that: it is read over three fifths of the velocity.
    const LOCAL: f64 = 3.0;
    let within = all.within.law(all.velocity()).filter(|_| limited && all.swing() >= FOLLOWS);
    if let Some([level, slope]) = within {
        let allowed = SYSTEMATIC * level.value.abs();
        let error = level.error.hypot(allowed);
        let velocity = all.velocity();
        let local = (LOCAL * allowed / velocity.abs()).hypot(all.within.unclear_bend(velocity));
        let slope = Measured { error: slope.error.hypot(local), ..slope };
        let bent = all.within.bends(velocity) || turns(cells, velocity);
        let slope = (!bent).then_some(slope);
        let normal = all.normal();
        let damping = if all.losses.opens() {
            let omega = std::f64::consts::TAU * all.frequency();
            all.inertia.damping(settings.damping_ratio, omega)
        } else {
            all.losses.damping(settings.inclination).filter(|_| steady(cells))
        };
        let damping = damping
            .map(|Measured { value, error }| Measured { value: value / normal, error: error / normal });
        let least = least(cells).map(|least| Measured { error: least.error.hypot(local), ..least });
        return Level { reading: Reading::Within, level: Measured { error, ..level }, slope, least, damping };
    }
    // A vibration that is not small any more lowers the mean: what is left of a growth is its beginning.
    let small: Vec<Cell> =
        cells.iter().filter(|cell| cell.reach().is_none_or(|r| r < SMALL)).copied().collect();
    let few = small.len() < LEAST;
    let blurred = !limited && few && small.len() < cells.len();
    let cells = if limited || few { cells } else { &small };
    let all = Cell::sum(cells);
    let moves = has_velocity && !blurred && cells.len() >= LEAST && spread(cells, Cell::velocity) > MOVES;
    let abscissa = |cell: &Cell| if moves { cell.velocity() } else { cell.middle() };
    let line = Trended::new(cells.iter().map(|cell| [abscissa(cell), cell.friction()]));
    let error = line.error.hypot(SYSTEMATIC * all.friction().abs());
    Level {
        reading: if limited { Reading::Bound } else { Reading::Mean },
        level: Measured { value: all.friction(), error },
        slope: moves.then_some(line.slope).filter(|slope| slope.error.is_finite()),
        least: None,
        damping: None,
    }
}
