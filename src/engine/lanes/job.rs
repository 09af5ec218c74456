//! One instance between passes: where it is, and what it has seen.

use std::f64::consts::TAU;

use crate::engine::course::Warmth;
use crate::engine::kernel::scalar::Real;
use crate::engine::lanes::constants::{CONSTANTS, SWING, constants};
use crate::engine::lanes::contact::{Belt, Body, FREE, GAP, STICK, State, UPPER_KINK};
use crate::engine::lanes::count::Count;
use crate::engine::lanes::flight::Flight;
use crate::engine::lanes::stretches::Stretches;
use crate::engine::lanes::words::Words;
use crate::engine::measuring::Measuring;
use crate::engine::method::pace::{Turns, stands_still};
use crate::engine::method::taylor::BeltMotion;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::reductions::{End, Reductions};
use crate::engine::scene::Scene;
use crate::engine::sums::sum;
use crate::model::instance::Instance;
use crate::model::piece::LawForm;
use crate::model::scaled::Scaled;
use crate::model::status::Status;

/// Steps of a stretch of the window: short sums keep their digits, and a lane is looked at between stretches.
pub const STRETCH: u32 = 80;

/// Steps of a stretch between the first event and the window, whose sums are only a guess at the frequency.
pub const LONG_STRETCH: u32 = 256;

/// Steps of the last of them.
pub const LAST_STRETCH: u32 = 48;

/// Periods `2π/ω0` of a stretch of the single mass in closed form, whose steps are whole swings.
const SWINGS: f64 = 100.0;

/// Length of [`Part::Approach`]: ten periods.
const APPROACH: f64 = 10.0 * TAU;

/// Relative error of a Fourier component from a guess of its frequency, in units of the bound on the truncation
/// of a step: 0.006 degrees for 1e-5.
const PHASE_ERROR: f64 = 10.0;

/// Steps of the first stretch of a window, whose guess of the frequency is the worst.
pub const FIRST_STRETCH: u32 = 32;

/// The parts of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Up to the first event: growth, frequency and phase are measured.
    Growth,
    /// Some further periods, which show what the instance does: see [`Job::habit`].
    Approach,
    /// The rest of the time before the window.
    Settle,
    /// The window; of what swings all of the run.
    Window,
    /// The window once more, from the first to the last crossing.
    Phase,
    /// From a state to its next returns to the section, see [`crate::engine::cycle`].
    Return,
}

/// An instance on its way.
#[expect(clippy::struct_excessive_bools, reason = "each says one thing of the way, by itself")]
#[derive(Clone, Debug)]
pub struct Job<T> {
    /// The instance ready to be integrated, with its model of now.
    pub scene: Scene,
    /// What that model is of.
    pub warmth: Warmth,
    /// The instance as scalars, for what happens lane by lane.
    pub words: Words<T>,
    /// The instance as the constants that the steps in vector registers take.
    pub constants: [T; CONSTANTS],
    /// Body, contact and status.
    pub state: State<T>,
    /// Time reached at the last boundary of a stretch.
    pub time: f64,
    /// End of the present stretch.
    pub until: f64,
    /// Whether the first event is still to come.
    pub growing: bool,
    /// Whether the present stretch has sums of growth.
    pub sums_growth: bool,
    /// What it did in the last part: the highest code of its contact states, and whether it had events. Instances of one habit
    /// go on side by side, as a step does what any of its lanes needs.
    pub habit: (u32, bool),
    /// End of [`Part::Approach`].
    approached: f64,
    /// `x2` and `y1` at the start of the window.
    pub origin: [T; 2],
    /// The sums of its run so far.
    pub seen: Reductions,
    /// `ẋ2` at the end of the last step of the window.
    pub previous: T,
    /// The Fourier components of the window, stretch by stretch.
    pub stretches: Stretches,
    /// Angular frequency of the response as far as it is known before the window.
    pub guess: Option<f64>,
    /// Steps.
    pub steps: u64,
    /// Steps and events of the present period.
    pub count: Count,
    /// Times of the end of the settling, of the first half of the window and of the window.
    pub marks: [f64; 3],
    /// Whether no event has fallen into the window.
    pub quiet: bool,
    /// The flight to the section that it is on.
    pub flight: Flight,
    /// Whether its outcome is known otherwise.
    pub is_over: bool,
    measuring: Measuring,
    /// The state at the start of the window.
    snapshot: Option<State<T>>,
    /// From where its positions count.
    opened: [f64; 2],
}

/// Whether steps where friction rises near rest are so short that nothing moves. f64 goes on: there is nothing finer that would
/// compute it again.
pub(super) fn is_left_to_f64<T: Real>(words: &Words<T>, model: &Scaled, turns: &Turns) -> bool {
    let epsilon = T::EPSILON.to_f64();
    let rises =
        || words.stands_still_on_a_rise() || stands_still(turns.longest_step_of_a_rise(model), epsilon);
    epsilon > f64::EPSILON && rises()
}

impl<T: Real> Job<T> {
    /// The start of an instance, whose steps may turn so far.
    #[must_use]
    pub fn new(instance: &Instance, scene: Scene, plan: &Plan, turns: &Turns) -> Job<T> {
        let words: Words<T> = Words::new(instance.law.kind().form(), &scene, turns);
        let measuring = Measuring::new(instance, &scene, plan);
        let mut state = State::new(&words, belt_at(scene.belt(0.0)));
        if is_left_to_f64(&words, &scene.model, turns) {
            state.status = Status::StepTooLarge;
        }
        Job {
            constants: constants(&scene.model, turns),
            warmth: scene.warmth(),
            scene,
            state,
            words,
            time: 0.0,
            until: 0.0,
            growing: true,
            sums_growth: false,
            habit: (0, false),
            approached: 0.0,
            origin: [T::ZERO; 2],
            seen: Reductions::default(),
            previous: T::ZERO,
            stretches: Stretches::default(),
            guess: None,
            steps: 0,
            count: Count::default(),
            marks: window(&measuring),
            quiet: true,
            flight: Flight::default(),
            is_over: false,
            measuring,
            snapshot: None,
            opened: [0.0; 2],
        }
    }

    /// The form of its law.
    #[must_use]
    pub fn law(&self) -> LawForm {
        self.words.law
    }

    /// Whether `x2` alone moves: without an inclination nothing pushes `y1`, and the contact stays closed.
    #[must_use]
    pub fn is_single(&self) -> bool {
        let body = &self.state.body;
        let rest = [body.p[1], body.p[2], body.v[1], body.v[2]].iter().all(|value| *value == T::ZERO);
        rest && self.scene.model.s == 0.0 && self.state.contact != FREE
    }

    /// Whether its motion between two events has a closed form that [`crate::engine::lanes::swing`] knows, if it is a single mass: constant
    /// friction, a belt of one velocity, weak damping.
    #[must_use]
    pub fn swings(&self) -> bool {
        let pieces = &self.words.pieces;
        let constant = pieces.len() == 1 && pieces[0].slope == T::ZERO;
        constant && self.scene.has_steady_belt() && self.constants[SWING + 1] > T::ZERO
    }

    /// Whether a part of the run has anything to do. Among none but single masses (`single`) growth is measured on the way to
    /// the window.
    pub fn enter(&mut self, part: Part, tolerance: f64, single: bool) -> bool {
        if self.state.status != Status::Unwritten || self.is_over {
            return false;
        }
        self.habit = (0, false);
        match part {
            Part::Growth => self.growing && self.time < self.marks[0] && !single,
            Part::Approach => {
                self.approached = self.marks[0].min(self.time + APPROACH);
                self.time < self.marks[0] && !single
            }
            Part::Settle => self.time < self.marks[0],
            Part::Window => self.time < self.marks[2],
            Part::Return => self.flight.is_open(),
            Part::Phase => {
                let told = self.tells_phase(tolerance);
                let Some(snapshot) = self.snapshot.take().filter(|_| !told) else { return false };
                self.state.return_to(&snapshot);
                self.time = self.marks[0];
                self.count = Count::restarted(self.time);
                self.take_model(tolerance);
                true
            }
        }
    }

    /// Whether the window needs no second pass: it has no phase, or its stretches tell it.
    pub fn tells_phase(&mut self, tolerance: f64) -> bool {
        // The single mass has no phase.
        let none = self.seen.crossings < 2 || self.seen.last <= self.seen.first || self.is_single();
        if self.state.status != Status::Unwritten || self.is_over || self.snapshot.is_none() || none {
            return true;
        }
        let phase = self.components(PHASE_ERROR * tolerance);
        self.seen.phase = phase.unwrap_or(self.seen.phase);
        phase.is_some()
    }

    /// Whether the window has begun.
    #[must_use]
    pub fn in_window(&self) -> bool {
        self.time >= self.marks[0]
    }

    /// Remembers the start of the window, where it has begun and that has not been done.
    pub fn open_window(&mut self) {
        if self.snapshot.is_none() && self.in_window() {
            self.previous = T::ZERO;
            self.open_window_at(self.state);
        }
    }

    /// Remembers the state at the start of the window, where that has not been done.
    pub fn open_window_at(&mut self, start: State<T>) {
        if self.snapshot.is_none() {
            self.quiet = true;
            self.origin = [start.body.p[0], start.body.p[2]];
            self.seen.origin = std::array::from_fn(|k| self.origin[k].to_f64() + self.warmth.base[k]);
            (self.snapshot, self.opened) = (Some(start), self.warmth.base);
        }
    }

    /// Position and velocity at the start of the window, where that has begun, from the present equilibrium.
    #[must_use]
    pub fn start_of_window(&self) -> Option<Body<T>> {
        let mut body = self.snapshot.as_ref()?.body;
        body.shift(self.shift_from(self.opened));
        Some(body)
    }

    /// Keeps `ẋ2` at the end of a stretch: what sticks on a belt that has come to rest has not gone below it, but for a rounding.
    pub fn keep_previous(&mut self, velocity: T, contact: u32) {
        self.previous = if contact == STICK { velocity.max(T::ZERO) } else { velocity };
    }

    /// The angular frequency between the first and the last crossing of the window.
    #[must_use]
    pub fn omega(&self) -> f64 {
        TAU * (self.seen.crossings - 1) as f64 / (self.seen.last - self.seen.first)
    }

    /// That angular frequency while the window is still open: from its crossings so far, or guessed; `None` before there is
    /// a guess.
    fn known_omega(&self) -> Option<f64> {
        if self.seen.crossings > 2 { Some(self.omega()) } else { self.guess }
    }

    /// That angular frequency as far as it is known now, or else `ω0`, which is 1 in scaled time.
    #[must_use]
    pub fn guessed_omega(&self) -> f64 {
        self.known_omega().unwrap_or(1.0)
    }

    /// The Fourier components of the window from its stretches, if they are good enough.
    fn components(&self, bound: f64) -> Option<[[f64; 2]; 2]> {
        let all = |i: usize| self.seen.halves[0][i] + self.seen.halves[1][i];
        let rms = [all(sum::AX), all(sum::AY)].map(|square| (square / all(sum::TIME)).sqrt());
        self.stretches.components(self.omega(), self.seen.first, rms, bound)
    }

    /// The half of the window the present stretch lies in.
    #[must_use]
    pub fn half(&self) -> usize {
        usize::from(self.time >= self.marks[1])
    }

    /// The next stretch of a part: its length and its longest step; `None` at the end of the part. What `swings` is stepped
    /// in closed form.
    pub fn stretch(&mut self, part: Part, steps_per_period: u32, swings: bool) -> Option<[f64; 2]> {
        let goals: &[f64] = match part {
            Part::Growth | Part::Settle => &self.marks[..1],
            Part::Approach => &[self.approached],
            Part::Window => &self.marks,
            Part::Phase => &[self.seen.first, self.seen.last],
            Part::Return => &[self.flight.until],
        };
        let goal = *goals.iter().find(|goal| self.time < **goal)?;
        let (_, holds) = self.scene.belt_from(self.time);
        let end = if holds < goal - self.time { self.time + holds } else { goal };
        let nominal = TAU / f64::from(steps_per_period);
        let length = end - self.time;
        let whole = (length / nominal - 1e-6).ceil().max(1.0);
        let step = length / whole;
        let most = match part {
            // What grows is sampled in steps as short as those of a series.
            _ if swings && !self.growing => SWINGS * f64::from(steps_per_period),
            Part::Window if !self.is_single() => {
                f64::from(STRETCH).min(f64::from(FIRST_STRETCH) * (1 + self.stretches.len()) as f64)
            }
            // Sums of growth, as in the window.
            Part::Settle if self.growing => f64::from(STRETCH),
            // The last one guesses the frequency: it is late, and not too short.
            Part::Settle if whole > f64::from(LAST_STRETCH) => {
                f64::from(LONG_STRETCH).min(whole - f64::from(LAST_STRETCH))
            }
            Part::Approach | Part::Settle | Part::Return => f64::from(LONG_STRETCH),
            _ => f64::from(STRETCH),
        };
        if whole <= most {
            self.until = end;
            return Some([length, step]);
        }
        self.until = self.time + most * step;
        Some([most * step, step])
    }

    /// Carries out an event; `exhausted` when there have been too many.
    pub fn event(&mut self, event: u32, exhausted: bool, in_window: bool, belt: Belt<T>) {
        self.growing = false;
        if exhausted {
            self.state.status = Status::EventLimit;
            return;
        }
        if event == UPPER_KINK && self.state.piece as usize + 1 >= self.words.pieces.len() {
            // A speed beyond all kinks, where there is none.
            self.state.status = Status::NonFinite;
            return;
        }
        self.state.transition(&self.words, event, belt);
        if in_window && event == GAP {
            self.seen.impacts += 1;
        }
    }

    /// Judges the window of a run until settled; true when another one follows.
    pub fn goes_on(&mut self, plan: &Plan) -> bool {
        if self.state.status != Status::Unwritten
            || self.is_over
            || !self.measuring.until_settled()
            || self.measuring.is_over()
        {
            return false;
        }
        let outcome = self.outcome(plan);
        if !self.measuring.goes_on(&outcome, self.seen.frequency(), !self.quiet, self.marks[2]) {
            return false;
        }
        self.next_window();
        true
    }

    /// Whether the windows of an oscillation agree.
    #[must_use]
    pub fn has_settled(&self) -> bool {
        self.measuring.has_settled() && self.seen.frequency().is_some()
    }

    /// Takes that back; true when another window follows.
    pub fn reopen(&mut self) -> bool {
        let goes_on = self.measuring.reopen(self.seen.frequency(), self.marks[2]);
        if goes_on {
            self.next_window();
        }
        goes_on
    }

    fn next_window(&mut self) {
        let guess = self.known_omega();
        self.marks = window(&self.measuring);
        self.guess = guess;
        self.seen = Reductions { growth: self.seen.growth, ..Reductions::default() };
        self.stretches = Stretches::default();
        self.snapshot = None;
    }

    /// Goes on for a scaled time before the window begins; false when that would be too late, and the window begins now.
    pub fn wait(&mut self, time: f64) -> bool {
        let waits = self.measuring.wait(self.time, time);
        self.marks = window(&self.measuring);
        waits
    }

    /// Makes the window the one from here on for a period, scaled.
    pub fn open_period(&mut self, period: f64) {
        self.marks = [self.time, self.time + 0.5 * period, self.time + period];
    }

    /// Takes what the window has seen for one period of a cycle, of which the phase is still to be measured.
    pub fn close_period(&mut self) {
        self.seen.close_period([self.marks[0], self.marks[2]]);
        self.stretches = Stretches::default();
    }

    /// The outcome of a job that has passed all parts.
    #[must_use]
    pub fn outcome(&self, plan: &Plan) -> Outcome {
        let end = self.marks[2];
        let status = self.state.status;
        // The second pass goes over the window again and ends before its end.
        let (status, time) =
            if status == Status::Unwritten { (Status::Ok, end) } else { (status, self.time) };
        let end = End { status, steps: self.steps, time, met_event: !self.growing };
        self.measuring.told(self.seen.outcome(&self.scene, plan, &end), &self.scene)
    }
}

/// A belt in the numbers of the lanes.
pub(super) fn belt_at<T: Real>(belt: BeltMotion) -> Belt<T> {
    Belt { velocity: T::from_f64(belt.velocity), acceleration: T::from_f64(belt.acceleration) }
}

/// The times of a window's start, middle and end.
fn window(measuring: &Measuring) -> [f64; 3] {
    let (start, half) = (measuring.start(), measuring.half());
    [start, start + half, start + half + half]
}
