//! Level and slope of friction in a stretch of cells: as the mean of `T/N`, or within the oscillation.

use crate::cells::Cell;
use crate::cross::Measured;
use crate::knee::Knee;
use crate::settings::Settings;
use crate::trend::Trended;
use crate::within::{SIDE, differ, differ_clearly};

/// Velocity of the vibration, over that of sliding, below which the mean of `T/N` is the friction at the mean velocity.
pub(super) const SMALL: f64 = 0.1;
/// The fewest cells of a segment that is cut off another one.
pub(super) const LEAST: usize = 5;
/// Swing of a force, over its mean, from which on force sensors follow a vibration that reverses the sliding.
const FOLLOWS: f64 = 0.05;

/// The part of the friction coefficient by which restored forces differ in themselves from which on nothing is read with them.
pub(super) const UNFIT: f64 = 0.15;

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
    /// The same where it falls least and where it falls most: at an end of the segment, or above the mean velocity; `None` but for
    /// [`Reading::Within`].
    pub extremes: Option<[Measured; 2]>,
    /// What a falling slope has to exceed to be unstable alone: the damping along the contact over the normal force, s/m;
    /// of a contact that opens, all that [`Settings::damping_ratio`] leaves. `None` where force sensors do not follow the vibration.
    pub damping: Option<Measured>,
    /// The part of the friction coefficient by which forces taken from the accelerations ([`Settings::rig`]) differ while the velocity
    /// rises and while it falls, where the law is read with them: 0 where the rig fits the record.
    pub misfit: Option<f64>,
}

/// Range of a quantity.
pub(super) fn range(cells: &[Cell], of: impl Fn(&Cell) -> f64) -> [f64; 2] {
    let values = cells.iter().map(of);
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

/// Relative range of a quantity.
pub(super) fn spread(cells: &[Cell], of: impl Fn(&Cell) -> f64) -> f64 {
    let [low, high] = range(cells, of);
    (high - low) / high.abs().max(low.abs()).max(f64::MIN_POSITIVE)
}

/// Cells in order of speed: a part of them is a part of the law, however often the velocity goes to and fro.
pub(super) fn by_speed(cells: &[Cell]) -> Vec<Cell> {
    let mut sorted = cells.to_vec();
    sorted.sort_by(|a, b| a.speed().total_cmp(&b.speed()));
    sorted
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

/// The law read within the oscillation, of as few cells as show it: the cell after the last of them, and the mean velocity (m/s) with the
/// friction coefficient there.
pub(super) fn reads(cells: &[Cell]) -> Vec<(usize, [f64; 2])> {
    let mut found = Vec::new();
    let mut sum = Cell::default();
    for (number, cell) in cells.iter().enumerate() {
        sum.add(cell);
        let velocity = sum.velocity();
        if let Some([level, _]) = sum.within.law(velocity) {
            found.push((number + 1, [velocity, level.value]));
            sum = Cell::default();
        }
    }
    found
}

/// The part of the friction coefficient by which restored forces differ while the velocity rises and while it falls: next to nothing
/// where the rig is that of the record. 3 % of a stiffness make it 0.1 to 0.5.
fn misfit(cells: &[Cell]) -> Option<f64> {
    /// Parts of the time in which it is looked for.
    const PARTS: usize = 8;
    let parts = cells.chunks(cells.len().div_ceil(PARTS)).map(Cell::sum);
    let of = |part: Cell| {
        let velocity = part.velocity();
        Some(part.within.differs(velocity)? / part.within.law(velocity)?[0].value.abs())
    };
    let found: Vec<f64> = parts.filter_map(of).collect();
    (!found.is_empty()).then(|| found.iter().sum::<f64>() / found.len() as f64)
}

/// The largest and the least slope.
fn extremes(slopes: impl Iterator<Item = Measured>) -> Option<[Measured; 2]> {
    let slopes: Vec<Measured> = slopes.collect();
    let by_value = |a: &&Measured, b: &&Measured| a.value.total_cmp(&b.value);
    Some([*slopes.iter().max_by(by_value)?, *slopes.iter().min_by(by_value)?])
}

/// Slopes (s/m) of the levels over the velocity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trend {
    all: Measured,
    /// Of the slower and of the faster half.
    halves: [Measured; 2],
    /// Where friction falls least, and where it falls most.
    ends: [Measured; 2],
    /// Whether it lies on one side of a knee that is fitted.
    beside_knee: bool,
    /// The range of the velocity, m/s.
    range: f64,
}

impl Trend {
    /// `None` where the velocity hardly moves, or the law is read too seldom to tell slow from fast. `at_knee`: whether the
    /// fastest cell is at one; what the knee above all cells smears into them is taken out. The cells are in order of speed.
    pub(super) fn new(sorted: &[Cell], at_knee: bool, knee: Option<Knee>) -> Option<Trend> {
        /// Relative range of the velocity from which on levels show a slope.
        const MOVES: f64 = 0.1;
        let slope = |cells: &[Cell]| {
            let found = reads(cells);
            let clear = |[velocity, level]: [f64; 2]| {
                [velocity, level - knee.map_or(0.0, |knee| knee.smear(velocity))]
            };
            (found.len() >= LEAST).then(|| Trended::new(found.iter().map(|(_, point)| clear(*point))).slope)
        };
        let spread = spread(sorted, Cell::velocity);
        if spread < MOVES {
            return None;
        }
        let all = slope(sorted)?;
        let (slow, fast) = sorted.split_at(sorted.len() / 2);
        let halves = [slope(slow)?, slope(fast)?];
        let range = spread * Cell::sum(sorted).speed();
        let speeds = [&sorted[0], &sorted[sorted.len() - 1]].map(Cell::speed);
        Some(Trend { all, halves, ends: ends(speeds, halves, at_knee), beside_knee: knee.is_some(), range })
    }

    /// The slope, whether it bends, and its extremes, where friction at this velocity (m/s) is known up to `allowed` and has this `level`.
    fn read(&self, allowed: f64, level: f64, velocity: f64) -> Read {
        let wider = |slope: Measured| Measured { error: slope.error.hypot(allowed / self.range), ..slope };
        let halves = self.halves.map(wider);
        // Beside a knee the law is a line, unless it is seen to bend.
        let straight = self.beside_knee && !differ_clearly(halves);
        let ends = if straight { [self.all; 2] } else { self.ends };
        (wider(self.all), differ(halves, level, velocity), Some(ends.map(wider)))
    }
}

/// A slope, whether it is another at either end, and its extremes.
type Read = (Measured, bool, Option<[Measured; 2]>);

/// Where friction falls least, and where it falls most, by the slopes of the slower and the faster half (`speeds`: where they begin and end,
/// m/s): a slope that changes goes on changing from their middles to either end, of which half of the way counts. At the faster end the law may
/// have had its knee meanwhile, which is smeared over a fifth of the velocity: what the slope clearly changes by counts over that, too, unless the
/// record is cut there (`knee`).
fn ends([slowest, fastest]: [f64; 2], [slow, fast]: [Measured; 2], knee: bool) -> [Measured; 2] {
    /// The most that the smear of a knee counts, over the way between the halves.
    const MOST: f64 = 2.0;
    let smeared = if knee { 0.0 } else { (SIDE * fastest / (0.5 * (fastest - slowest))).min(MOST) };
    let end = |near: Measured, far: Measured, smeared: f64| {
        let clearly = (near.value - far.value - near.error.hypot(far.error)).max(0.0);
        Measured {
            value: 1.25 * near.value - 0.25 * far.value + smeared * clearly,
            error: (1.25 * near.error).hypot(0.25 * far.error),
        }
    };
    let both = [end(slow, fast, 0.0), end(fast, slow, smeared)];
    extremes(both.into_iter()).unwrap_or(both)
}

/// Whether the law read within the oscillation has another slope in the first of these cells than in the last: the velocity (m/s, its mean) has
/// passed a bend.
fn turns(cells: &[Cell], velocity: f64) -> bool {
    /// Parts before and after.
    const PARTS: usize = 4;
    let read = |some: &[Cell]| {
        let all = Cell::sum(some);
        all.within.law(all.velocity())
    };
    (1..PARTS).any(|part| {
        let (first, last) = cells.split_at(cells.len() * part / PARTS);
        !first.is_empty()
            && read(first)
                .zip(read(last))
                .is_some_and(|(first, last)| differ([first[1], last[1]], first[0].value, velocity))
    })
}

/// The slopes (s/m) of the slower cells, of the faster ones, and above the mean velocity: the one that falls least and the one that falls most. A knee that the velocity
/// passes in between makes the slope of all of them one that there is nowhere.
fn parts(sorted: &[Cell]) -> Option<[Measured; 2]> {
    let (slow, fast) = sorted.split_at(sorted.len() / 2);
    let slopes = [slow, fast].map(|cells| {
        let all = Cell::sum(cells);
        all.within.law(all.velocity()).map(|[_, slope]| slope)
    });
    let all = Cell::sum(sorted);
    let above = Some(all.within.above(all.velocity())).filter(|slope| slope.error.is_finite());
    extremes(slopes.into_iter().chain([above]).flatten())
}

/// What a falling slope has to exceed, s/m.
fn damping(cells: &[Cell], all: &Cell, settings: &Settings) -> Option<Measured> {
    let normal = all.normal();
    let read = if let Some(rig) = settings.rig {
        Some(rig.damping())
    } else if all.losses.opens() {
        let omega = std::f64::consts::TAU * all.frequency();
        all.inertia.damping(settings.damping_ratio, omega)
    } else {
        all.losses.damping(settings.inclination).filter(|_| steady(cells))
    };
    read.map(|Measured { value, error }| Measured { value: value / normal, error: error / normal })
}

/// What is known of the law around a segment.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Around {
    /// Whether its fastest cell is at a knee of the law.
    pub(super) at_knee: bool,
    /// The knee below which the segment lies, where one is fitted.
    pub(super) knee: Option<Knee>,
    /// The law of all that is slower than the slowest cut: it is one, however often the velocity comes there. Of what smears from above alone a line
    /// would have a slope, too.
    pub(super) line: Option<Trend>,
    /// Whether a part of it lies beyond a knee, for too short a time to be cut off: it has no slope.
    pub(super) mixed: bool,
}

/// Level and slope of friction; whether the velocity is recorded, and whether it limits the vibration.
pub(super) fn level(
    cells: &[Cell],
    all: &Cell,
    [has_velocity, limited]: [bool; 2],
    Around { at_knee, knee, line, mixed }: Around,
    settings: &Settings,
) -> Level {
    /// Relative range of the velocity from which on there is a slope.
    const MOVES: f64 = 0.05;
    /// Systematic errors of a friction coefficient, relative, and of a slope, over that of `μ/v`.
    const SYSTEMATIC: f64 = 0.01;
    /// The part of the difference of restored forces that a coefficient is off.
    const OFF: f64 = 0.1;
    /// That of a slope within the oscillation, over that: it is read over two fifths of the velocity.
    const LOCAL: f64 = 3.0;
    let damping = damping(cells, all, settings).filter(|_| limited && all.swing() >= FOLLOWS);
    let misfit = settings.rig.and_then(|_| misfit(cells));
    let fits = settings.rig.is_none() || misfit.is_some_and(|misfit| misfit < UNFIT);
    let within = all.within.law(all.velocity()).filter(|_| limited && all.swing() >= FOLLOWS && fits);
    if let Some([level, slope]) = within {
        let known = (SYSTEMATIC + OFF * misfit.unwrap_or_default()) * level.value.abs();
        // The error of the level as a whole is that of its ends.
        let allowed = known.hypot(level.error);
        let error = allowed;
        let velocity = all.velocity();
        let local = (LOCAL * known / velocity.abs()).hypot(all.within.unclear_bend(velocity));
        let slope = Measured { error: slope.error.hypot(local), ..slope };
        let wider = |slope: Measured| Measured { error: slope.error.hypot(local), ..slope };
        // By the levels over the velocity, or within each period, whichever is known better. What the jumps of friction lose between samples
        // tilts the law within a period: with restored forces its levels alone count.
        let sorted = by_speed(cells);
        let moves = Trend::new(&sorted, at_knee, knee).map(|own| own.read(allowed, level.value, velocity));
        let around = line.map(|line| line.read(allowed, level.value, velocity));
        let inside = settings.rig.is_none().then(|| {
            let bent = all.within.bends(velocity) || turns(cells, velocity) || turns(&sorted, velocity);
            (slope, bent, parts(&sorted).map(|both| both.map(wider)))
        });
        let better = moves
            .into_iter()
            .chain(around)
            .chain(inside)
            .min_by(|a, b| a.0.error.total_cmp(&b.0.error))
            .filter(|_| !mixed);
        let (slope, extremes) =
            better.map_or((None, None), |(slope, bent, extremes)| ((!bent).then_some(slope), extremes));
        let level = Measured { error, ..level };
        return Level { reading: Reading::Within, level, slope, extremes, damping, misfit };
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
        extremes: None,
        damping,
        misfit,
    }
}
