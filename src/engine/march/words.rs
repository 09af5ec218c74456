//! The next stretch of a job as words of the kernel, and what has come of it back into the job.

use std::f64::consts::TAU;

use smallvec::SmallVec;

use crate::engine::kernel::scalar::Real;
use crate::engine::lanes::block::{FIRST, SECOND, THIRD, event_of};
use crate::engine::lanes::constants::LAYER;
use crate::engine::lanes::contact::{Body, FREE, NOTHING, STICK, UPPER_KINK};
use crate::engine::lanes::job::{Job, Part};
use crate::engine::lanes::spectrum::{CLOSING, COMPONENTS};
use crate::engine::march::table::{flag, head, piece, state};
use crate::engine::plan::Plan;
use crate::engine::scene::MOST_STEPS;
use crate::engine::sums::sum;
use crate::model::status::Status;

/// Input words that a lane holds without an allocation: those of laws of two pieces.
const INPUTS: usize = head::WORDS + 2 * piece::WORDS;

/// The words of one lane.
#[derive(Clone, Debug, PartialEq)]
pub struct Words<R> {
    /// Constants, stretch, and pieces of the law.
    pub inputs: SmallVec<[R; INPUTS]>,
    /// What is carried between dispatches.
    pub state: [R; state::WORDS],
    /// Counters and switches.
    pub flags: [u32; flag::WORDS],
}

impl<R: Real> Words<R> {
    /// Those of no stretch.
    #[must_use]
    pub fn blank() -> Words<R> {
        Words { inputs: SmallVec::new(), state: [R::ZERO; state::WORDS], flags: [0; flag::WORDS] }
    }
}

/// Begins the next stretch of a part of a job for a kernel of so many pieces, in the place of the one before; `None` at the end
/// of the part.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts are words of a kernel")]
pub fn begin<R: Real>(
    job: &mut Job<R>,
    part: Part,
    plan: &Plan,
    pieces: usize,
    words: &mut Words<R>,
) -> Option<()> {
    if part == Part::Window {
        job.open_window();
    }
    job.sums_growth = part != Part::Settle && job.growing;
    let [length, step] = job.stretch(part, plan.steps_per_period, false)?;
    let left = f64::from(MOST_STEPS) - job.steps as f64;
    let [most_steps, most_events] = job.count.most([job.time, job.until], left);
    let belt = job.scene.belt(job.time);

    let Words { inputs, state: words, flags } = words;
    inputs.resize(head::WORDS + pieces * piece::WORDS, R::ZERO);
    inputs[..head::STEP].copy_from_slice(&job.constants[..head::STEP]);
    inputs[head::V0] = job.words.v0;
    inputs[head::STEP] = R::from_f64(step);
    inputs[head::LAYER..head::LAYER + 2].copy_from_slice(&job.constants[LAYER..LAYER + 2]);
    inputs[head::DRIVE] = R::from_f64(belt.acceleration);
    for (index, words) in inputs[head::WORDS..].chunks_exact_mut(piece::WORDS).enumerate() {
        // What there is room for beyond the last is the last.
        let one = &job.words.pieces[index.min(job.words.pieces.len() - 1)];
        words.copy_from_slice(&[one.at_zero, one.slope, one.rate, one.offset, one.kink]);
    }

    words.fill(R::ZERO);
    let body = &job.state.body;
    words[state::BODY..state::BODY + 3].copy_from_slice(&body.p);
    words[state::BODY + 3..state::BODY + 6].copy_from_slice(&body.v);
    words[state::BELT] = R::from_f64(belt.velocity);
    words[state::LEFT] = R::from_f64(length);
    words[state::PACE] = R::from_f64(step);
    words[state::PREVIOUS] = job.previous;
    let begun = part == Part::Window && job.seen.crossings > 0;
    if part == Part::Window {
        words[state::ORIGIN..state::ORIGIN + 2].copy_from_slice(&job.origin);
        let (omega, half) = (job.guessed_omega(), 0.5 * length);
        let (sine, cosine) = (omega * half).sin_cos();
        words[state::OMEGA] = R::from_f64(omega);
        words[state::CARRIER] = R::from_f64(cosine);
        words[state::CARRIER + 1] = R::from_f64(sine);
        words[state::SCALE] = R::from_f64(1.0 / half);
        words[state::CLOSING] = R::from_f64(job.marks[2] - job.time - CLOSING * TAU / omega);
    }

    flags.fill(0);
    flags[flag::STATUS] = Status::Unwritten as u32;
    flags[flag::CONTACT] = job.state.contact;
    flags[flag::PIECE] = if job.state.contact == STICK { 0 } else { job.state.piece };
    flags[flag::DISARMED] = match job.state.disarmed {
        NOTHING => 0,
        UPPER_KINK => THIRD,
        _ if job.state.contact == FREE => FIRST,
        _ => SECOND,
    };
    flags[flag::MOST_STEPS] = most_steps.max(0.0) as u32;
    flags[flag::MOST_EVENTS] = most_events.max(0.0) as u32;
    flags[flag::GROWING] = u32::from(job.growing);
    flags[flag::BEGUN] = u32::from(begun);
    Some(())
}

/// Takes what the kernel has made of a stretch; `None` when its status is none that it may have, or it says that it came to
/// its end and did not.
pub fn take<R: Real>(job: &mut Job<R>, part: Part, words: &[R], flags: &[u32]) -> Option<()> {
    let status = Status::from_code(flags[flag::STATUS]).filter(|status| *status != Status::Unwritten)?;
    let left = words[state::LEFT].to_f64();
    let met = part == Part::Growth && flags[flag::EVENTFUL] == 1;
    if status == Status::Ok && left > 0.0 && !met {
        return None;
    }
    flush(job, part, words, flags);
    let triple = |at: usize| [words[at], words[at + 1], words[at + 2]];
    job.state.body = Body { p: triple(state::BODY), v: triple(state::BODY + 3) };
    job.state.contact = flags[flag::CONTACT];
    job.state.piece = flags[flag::PIECE];
    job.state.at_once = flags[flag::AT_ONCE];
    job.state.disarmed = match flags[flag::DISARMED] {
        0 => NOTHING,
        function => event_of(function, job.state.contact, job.state.piece),
    };
    if status != Status::Ok {
        job.state.status = status;
    }
    job.time = if left > 0.0 { (job.until - left).max(job.time) } else { job.until };
    Some(())
}

/// Adds what a stretch has summed to the job.
fn flush<R: Real>(job: &mut Job<R>, part: Part, words: &[R], flags: &[u32]) {
    let number = |at: usize| words[at].to_f64();
    if job.sums_growth {
        for (total, word) in job.seen.growth.iter_mut().zip(&words[state::GROWTH..]) {
            *total += word.to_f64();
        }
    }
    job.growing &= flags[flag::GROWING] == 1;
    let crossings = flags[flag::CROSSINGS];
    if part == Part::Window && job.in_window() {
        let half = job.half();
        job.quiet &= flags[flag::EVENTFUL] == 0;
        job.seen.impacts += u64::from(flags[flag::IMPACTS]);
        for (total, word) in job.seen.halves[half].iter_mut().zip(&words[state::WINDOW..][..sum::WORDS]) {
            *total += word.to_f64();
        }
        for (peak, word) in job.seen.peaks.iter_mut().zip(&words[state::PEAKS..]) {
            *peak = peak.max(word.to_f64());
        }
        if crossings > 0 {
            if job.seen.crossings == 0 {
                job.seen.first = job.time + number(state::FIRST);
            }
            job.seen.last = job.time + number(state::LAST);
            job.seen.crossings += u64::from(crossings);
        }
        let sums = |at: usize| std::array::from_fn::<f64, COMPONENTS, _>(|i| number(at + i));
        let half = 0.5 * (job.until - job.time);
        let noted = (crossings > 0).then(|| sums(state::NOTED));
        job.stretches.push(number(state::OMEGA), [job.time + half, half], sums(state::SPECTRUM), noted);
        if crossings > 0 && flags[flag::FRESH] == 0 {
            job.stretches.forget();
        }
    } else {
        let cycles = f64::from(crossings) - 1.0;
        let span = number(state::LAST) - number(state::FIRST);
        if cycles >= 2.0 && span > 0.0 {
            job.guess = Some(TAU * cycles / span);
        }
    }
    job.previous = words[state::PREVIOUS];
    let steps = f64::from(flags[flag::STEPS]);
    job.count.add(steps, f64::from(flags[flag::COUNTED]));
    job.steps += u64::from(flags[flag::STEPS]);
}
