//! Segments of time: stretches in which amplitude, frequency, phase and friction stay in kind.

use std::f64::consts::TAU;

use crate::cells::Cell;
use crate::cross::{INDEPENDENT, Measured};
use crate::cut::{Course, cut};
use crate::level::{Around, LEAST, Level, Reading, follows, level, range, spread};
use crate::parts::{Part, parts, stretches};
use crate::population::{Seen, Source};
use crate::rig::Rig;
use crate::settings::Settings;
use crate::testimony::{Mechanism, Testimony, Witness};
use crate::trend::Trended;
use crate::verdict::Verdict;

/// Amplitude, over the largest of the record, from which on the record vibrates.
const VIBRATES: f64 = 0.1;
/// Velocity of the vibration, over that of sliding, from which on it is limited by friction: it all but reverses the sliding.
pub(super) const REVERSES: f64 = 0.5;
/// The shortest segment, as a part of the record.
const SHORTEST: f64 = 0.03;
/// The shortest stretch that vibrates, or does not, as a part of the record.
const APART: f64 = 0.01;
/// Change of the logarithm of the amplitude that is no steady vibration any more.
const CHANGES: f64 = 1.0;
/// E-foldings per period below which nothing that is left to itself dies out: 0.02 % of critical damping. What becomes weaker slower than that
/// follows the velocity, perhaps, which is not recorded.
const LINGERS: f64 = 1e-3;
/// Relative range of the velocity from which on the friction law shows in it.
const MOVES: f64 = 0.05;
/// Standard errors from which on a trend of the amplitude is one.
const CLEAR: f64 = 6.0;

/// What the vibration does in a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// None to speak of.
    Quiet,
    /// It grows.
    Growing,
    /// It goes on.
    Sustained,
    /// It dies out.
    Decaying,
}

impl State {
    /// Whether something goes on or grows.
    pub(super) fn vibrates(self) -> bool {
        matches!(self, State::Growing | State::Sustained)
    }

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            State::Quiet => "quiet",
            State::Growing => "growing",
            State::Sustained => "sustained",
            State::Decaying => "decaying",
        }
    }
}

/// A segment of time.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Start and end, s.
    pub time: [f64; 2],
    /// What the vibration does.
    pub state: State,
    /// Amplitude over the largest of the record of a vibration that stands out of the noise, neither grows nor dies out, and is too weak
    /// to be judged; `None` elsewhere.
    pub weak: Option<f64>,
    /// Its frequency, Hz; `None` where nothing vibrates.
    pub frequency: Option<f64>,
    /// Amplitude of the tangential acceleration, m/s².
    pub amplitude: f64,
    /// Velocity of the vibration over that of sliding, where that is known.
    pub reach: Option<f64>,
    /// Phase of the normal against the tangential acceleration, degrees.
    pub phase: Option<Measured>,
    /// Squared coherence of the two.
    pub coherence: Option<f64>,
    /// Stiffness and damping across the contact that the two show while it is closed, each over that of [`Settings::rig`], where there is
    /// one.
    pub across: Option<[Measured; 2]>,
    /// Friction, where both forces are recorded.
    pub friction: Option<Level>,
    /// First and last velocity, m/s.
    pub velocity: Option<[f64; 2]>,
    /// Lowest and highest velocity, m/s.
    pub(super) swept: Option<[f64; 2]>,
    /// Whether nothing vibrates along the contact where much does across it.
    pub(super) unlike: bool,
    /// Mean temperature, °C.
    pub temperature: Option<f64>,
    /// What the simulated population is asked about; `None` where there is no phase.
    pub seen: Option<Seen>,
    /// What each witness says, in the order of [`Witness::ALL`].
    pub testimonies: Vec<Testimony>,
    /// The joint verdict.
    pub verdict: Verdict,
    /// Where that is undecided between causes: the mechanism that they share, and its probability.
    pub shared: Option<(Mechanism, f64)>,
    /// The witnesses that it rests on.
    pub rests_on: Vec<Witness>,
    /// What speaks against it.
    pub contradictions: Vec<String>,
}

impl Segment {
    /// Whether it is an instability at all, and not driven: that shows in what limits it, or in its growth (`grows`). What has grown and
    /// goes on far below its limit may be driven.
    pub(super) fn goes_by_itself(&self, grows: bool) -> bool {
        let limited = self.reach.is_some_and(|reach| reach >= REVERSES);
        self.state.vibrates() && limited || self.state == State::Growing && grows
    }

    /// Where the simulated population has a vibration like that of this segment.
    pub(super) fn source(&self) -> Source {
        let within = self.friction.is_some_and(|friction| friction.reading == Reading::Within);
        match self.state {
            State::Growing => Source::Growth,
            _ if within => Source::Within,
            _ => Source::Sustained,
        }
    }
}

/// What the record has, beside the accelerations along the contact.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "one for each channel")]
pub(super) struct Has {
    pub(super) normal_acceleration: bool,
    pub(super) forces: bool,
    pub(super) velocity: bool,
    pub(super) temperature: bool,
}

/// The segments of a record, not judged yet.
pub(super) fn segments(cells: &[Cell], has: Has, settings: &Settings) -> Vec<Segment> {
    let largest = cells.iter().map(Cell::amplitude).fold(0.0, f64::max);
    let vibrates = |cell: &Cell| {
        cell.is_loud()
            && (cell.amplitude() >= VIBRATES * largest || reached(cell, has).is_some_and(|r| r >= REVERSES))
    };
    let kinds = cells.iter().map(|cell| usize::from(vibrates(cell))).collect();
    let part = |share: f64| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small part of a small number"
        )]
        let part = (share * cells.len() as f64).ceil() as usize;
        part
    };
    let mut found = Vec::new();
    // The end of a record may be the beginning of a growth.
    for [from, to] in stretches(kinds, part(APART).max(2), true) {
        let stretch = &cells[from..to];
        let vibrating = cells[from..to]
            .iter()
            .filter(|cell| cell.is_loud() && cell.amplitude() >= VIBRATES * largest)
            .count();
        let vibrating = 2 * vibrating >= to - from;
        let least = LEAST.max(part(SHORTEST));
        let read = has.forces && has.velocity && vibrating && follows(stretch);
        let parts = if read && spread(stretch, Cell::velocity) > MOVES {
            parts(stretch, least)
        } else {
            vec![Part::whole(stretch.len())]
        };
        for part in parts {
            let [first, after] = part.cells;
            let mut start = first;
            for end in cut(after - first, &courses(&stretch[first..after], has, vibrating), least) {
                let end = first + end;
                let around = part.around([start, end], stretch);
                let context = Context { vibrating, largest, around };
                found.push(segment(&stretch[start..end], has, context, settings));
                start = end;
            }
        }
    }
    found
}

/// The quantities that stay in kind within a segment.
fn courses(cells: &[Cell], has: Has, vibrating: bool) -> Vec<Course> {
    let over_time = |of: &dyn Fn(&Cell) -> f64| -> Vec<[f64; 2]> {
        cells.iter().map(|cell| [cell.middle(), of(cell)]).collect()
    };
    let mut courses = Vec::new();
    if vibrating {
        // A limit cycle follows the velocity: over it, its amplitude stays in kind.
        let size = |cell: &Cell| reached(cell, has).unwrap_or(cell.amplitude()).max(f64::MIN_POSITIVE);
        courses.push(Course::new(&over_time(&|cell| size(cell).ln()), 0.2));
        courses.push(Course::new(&over_time(&|cell| cell.frequency().max(f64::MIN_POSITIVE).ln()), 0.004));
        if has.normal_acceleration {
            let turn = |cell: &Cell| cell.sums.yx / cell.sums.yx.norm().max(f64::MIN_POSITIVE);
            courses.push(Course::new(&over_time(&|cell| turn(cell).re), 0.06));
            courses.push(Course::new(&over_time(&|cell| turn(cell).im), 0.06));
        }
    }
    if has.forces {
        let moves = has.velocity && spread(cells, Cell::velocity) > 0.02;
        let points =
            cells.iter().map(|cell| [if moves { cell.velocity() } else { cell.middle() }, cell.friction()]);
        courses.push(Course::new(&points.collect::<Vec<_>>(), 0.004));
        if has.velocity && vibrating && follows(cells) {
            let law = |cell: &Cell| cell.within.law(cell.velocity());
            if cells.iter().all(|cell| law(cell).is_some()) {
                let slope = |cell: &Cell| law(cell).map_or(0.0, |[_, slope]| slope.value * cell.velocity());
                courses.push(Course::new(&over_time(&slope), 0.006));
                courses.push(Course::new(
                    &over_time(&|cell| law(cell).map_or(0.0, |[level, _]| level.value)),
                    0.01,
                ));
            }
        }
    }
    courses
}

/// That where the velocity is recorded.
fn reached(cell: &Cell, has: Has) -> Option<f64> {
    cell.reach().filter(|_| has.velocity)
}

/// The stretch of a segment, and what is around it.
#[derive(Clone, Copy, Debug)]
struct Context {
    vibrating: bool,
    /// Amplitude of the record's loudest cell, m/s².
    largest: f64,
    around: Around,
}

/// One segment, not judged yet.
fn segment(cells: &[Cell], has: Has, context: Context, settings: &Settings) -> Segment {
    let Context { vibrating, largest, around } = context;
    let all = Cell::sum(cells);
    let reach = reached(&all, has).filter(|_| all.is_loud());
    let change = change(cells, has);
    let clear = change.abs() > CHANGES;
    let limited = reach.is_some_and(|reach| reach >= REVERSES);
    let lingers = !has.velocity && change > -LINGERS * all.frequency() * (all.time[1] - all.time[0]);
    let state = match (vibrating, clear && !limited) {
        (false, _) => State::Quiet,
        (true, true) if change > 0.0 => State::Growing,
        (true, true) if !lingers => State::Decaying,
        (true, _) => State::Sustained,
    };
    // What dies out may still stand out of the noise.
    let weak =
        (state == State::Quiet && all.is_loud() && change > -CHANGES).then(|| all.amplitude() / largest);
    let shown = all.phase(settings.skew).filter(|_| vibrating && has.normal_acceleration);
    Segment {
        time: all.time,
        state,
        weak,
        frequency: vibrating.then(|| all.frequency()),
        amplitude: all.amplitude(),
        reach,
        phase: shown.map(|(phase, _)| phase),
        coherence: shown.map(|(_, coherence)| coherence),
        across: settings.rig.filter(|_| shown.is_some()).and_then(|rig| across(cells, rig, settings.skew)),
        friction: has.forces.then(|| level(cells, &all, [has.velocity, limited], around, settings)),
        velocity: has.velocity.then(|| [cells[0].velocity(), cells[cells.len() - 1].velocity()]),
        swept: has.velocity.then(|| range(cells, Cell::velocity)),
        unlike: state == State::Quiet && all.is_unlike(),
        temperature: has.temperature.then(|| all.temperature()),
        seen: None,
        testimonies: Vec::new(),
        verdict: Verdict::undecided("not judged"),
        shared: None,
        rests_on: Vec::new(),
        contradictions: Vec::new(),
    }
}

/// What the cells say of a rig across the contact in which forces are restored: not of a contact that opens.
fn across(cells: &[Cell], rig: Rig, skew: f64) -> Option<[Measured; 2]> {
    let closed: Vec<Cell> = cells.iter().filter(|cell| cell.is_loud() && cell.reads()).copied().collect();
    let all = Cell::sum(&closed);
    let omega = TAU * all.frequency();
    let ratio = all.sums.normal_acceleration(INDEPENDENT).advanced(omega * skew);
    let [first, last] = [closed.first()?, closed.last()?];
    let growth = (last.amplitude() / first.amplitude()).ln() / (last.time[1] - first.time[0]);
    (ratio.value.norm() > 0.0).then(|| rig.across(omega, growth, ratio))
}

/// Change of the logarithm of the amplitude where it is clear, else 0. A forced vibration that follows the velocity, or one that
/// stays while the velocity falls, neither grows nor dies out: of both changes the smaller one counts.
fn change(cells: &[Cell], has: Has) -> f64 {
    let length = cells[cells.len() - 1].time[1] - cells[0].time[0];
    let of = |size: &dyn Fn(&Cell) -> f64| {
        let points = cells.iter().map(|cell| [cell.middle(), size(cell).max(f64::MIN_POSITIVE).ln()]);
        let Measured { value, error } = Trended::new(points).slope;
        if value.abs() > CLEAR * error { value * length } else { 0.0 }
    };
    let amplitude = of(&Cell::amplitude);
    if cells.iter().any(|cell| reached(cell, has).is_none()) {
        return amplitude;
    }
    let over_velocity = of(&|cell| reached(cell, has).unwrap_or_default());
    if amplitude * over_velocity <= 0.0 {
        0.0
    } else if amplitude.abs() < over_velocity.abs() {
        amplitude
    } else {
        over_velocity
    }
}
