//! The next leg of a job as words of the kernel, and what has come of it back into the job.

use num_complex::Complex64;
use smallvec::SmallVec;

use crate::engine::kernel::scalar::Real;
use crate::engine::lanes::block::{FIRST, SECOND, THIRD, event_of};
use crate::engine::lanes::constants::LAYER;
use crate::engine::lanes::contact::{Body, FREE, NOTHING, STICK, State, UPPER_KINK};
use crate::engine::lanes::job::{Job, Part};
use crate::engine::lanes::spectrum::COMPONENTS;
use crate::engine::march::leg::Leg;
use crate::engine::march::table::{SECTIONS, flag, head, history, piece, state};
use crate::engine::scene::MOST_STEPS;
use crate::engine::sums::sum;
use crate::model::status::Status;

/// Input words that a lane holds without an allocation: those of laws of two pieces.
const INPUTS: usize = head::WORDS + 2 * piece::WORDS;

/// The words of one lane.
#[derive(Clone, Debug, PartialEq)]
pub struct Words<R> {
    /// Constants, leg, and pieces of the law.
    pub inputs: SmallVec<[R; INPUTS]>,
    /// What is carried between dispatches.
    pub state: [R; state::WORDS],
    /// Counters and switches.
    pub flags: [u32; flag::WORDS],
}

impl<R: Real> Words<R> {
    /// Those of no leg.
    #[must_use]
    pub fn blank() -> Words<R> {
        Words { inputs: SmallVec::new(), state: [R::ZERO; state::WORDS], flags: [0; flag::WORDS] }
    }

    /// State and flags, which come back.
    pub(super) fn come_back(&mut self) -> (&mut [R], &mut [u32]) {
        (&mut self.state, &mut self.flags)
    }
}

/// Begins a leg of a job for a kernel of so many pieces, in the place of the one before.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts are words of a kernel")]
pub fn begin<R: Real>(job: &mut Job<R>, leg: &Leg, pieces: usize, words: &mut Words<R>) {
    let belt = job.warmth.seen(job.scene.belt(job.time));
    job.until = job.time + leg.length;

    let Words { inputs, state: words, flags } = words;
    inputs.resize(head::WORDS + pieces * piece::WORDS, R::ZERO);
    inputs[..head::STEP].copy_from_slice(&job.constants[..head::STEP]);
    inputs[head::V0] = job.words.v0;
    for (word, section) in inputs[head::STEP..].iter_mut().zip(&leg.sections) {
        *word = R::from_f64(section.step);
    }
    inputs[head::BEYOND] = R::from_f64(leg.beyond);
    inputs[head::LAYER..head::LAYER + 2].copy_from_slice(&job.constants[LAYER..LAYER + 2]);
    inputs[head::DRIVE] = R::from_f64(belt.acceleration);
    for (index, words) in inputs[head::WORDS..].chunks_exact_mut(piece::WORDS).enumerate() {
        // What there is room for beyond the last is the last.
        let one = &job.words.pieces[index.min(job.words.pieces.len() - 1)];
        words.copy_from_slice(&[one.at_zero, one.slope, one.rate, one.offset, one.kink]);
    }

    words.fill(R::ZERO);
    put_body(&mut words[state::BODY..], &job.state.body);
    words[state::BELT] = R::from_f64(belt.velocity);
    words[state::PREVIOUS] = job.previous;
    words[state::OMEGA] = R::from_f64(job.guessed_omega());

    flags.fill(0);
    flags[flag::STATUS] = Status::Unwritten as u32;
    flags[flag::PART] = match (job.in_window(), job.growing) {
        (true, _) => Part::Window as u32,
        (false, true) => Part::Growth as u32,
        (false, false) => Part::Settle as u32,
    };
    for (word, section) in flags[flag::WHOLE..].iter_mut().zip(&leg.sections) {
        *word = section.whole;
    }
    flags[flag::CONTACT] = job.state.contact;
    flags[flag::PIECE] = if job.state.contact == STICK { 0 } else { job.state.piece };
    flags[flag::DISARMED] = match job.state.disarmed {
        NOTHING => 0,
        UPPER_KINK => THIRD,
        _ if job.state.contact == FREE => FIRST,
        _ => SECOND,
    };
    flags[flag::LEFT_STEPS] = (f64::from(MOST_STEPS) - job.steps as f64).max(0.0) as u32;
    flags[flag::GROWING] = u32::from(job.growing);
    if let Some(start) = job.start_of_window() {
        flags[flag::OPENED] = 1;
        put_body(&mut words[state::START..], &start);
        flags[flag::BEGUN] = u32::from(job.seen.crossings > 0);
        flags[flag::BEFORE] = job.stretches.len() as u32;
    }
    inputs[head::START..head::COUNTS].copy_from_slice(&words[..state::SENT]);
    for (word, flag) in inputs[head::COUNTS..head::WORDS].iter_mut().zip(flags) {
        *word = R::from_f64(f64::from(*flag));
    }
}

/// Takes what the kernel has made of a leg; `None` when its status is none that it may have, or it says that it came to
/// its end and did not.
pub fn take<R: Real>(job: &mut Job<R>, leg: &Leg, words: &[R], flags: &[u32]) -> Option<()> {
    let status = Status::from_code(flags[flag::STATUS]).filter(|status| *status != Status::Unwritten)?;
    let whole: [u32; SECTIONS] = std::array::from_fn(|k| flags[flag::WHOLE + k]);
    let left = leg.left(words[state::LEFT].to_f64(), whole);
    let stretches = flags[flag::STRETCH] as usize;
    if status == Status::Ok && (left > 0.0 || stretches != leg.stretches) || stretches > leg.stretches {
        return None;
    }
    flush(job, words, flags, stretches);
    job.state = State {
        body: body(&words[state::BODY..]),
        contact: flags[flag::CONTACT],
        piece: flags[flag::PIECE],
        at_once: flags[flag::AT_ONCE],
        disarmed: event(flags[flag::DISARMED], flags[flag::CONTACT], flags[flag::PIECE]),
        status: if status == Status::Ok { job.state.status } else { status },
    };
    job.time = if left > 0.0 { (job.until - left).max(job.time) } else { job.until };
    Some(())
}

fn put_body<R: Real>(words: &mut [R], body: &Body<R>) {
    words[..3].copy_from_slice(&body.p);
    words[3..6].copy_from_slice(&body.v);
}

fn body<R: Real>(words: &[R]) -> Body<R> {
    Body { p: std::array::from_fn(|k| words[k]), v: std::array::from_fn(|k| words[3 + k]) }
}

/// The event of a function of the kernel.
fn event(function: u32, contact: u32, piece: u32) -> u32 {
    if function == 0 { NOTHING } else { event_of(function, contact, piece) }
}

/// Adds what a leg has summed to the job.
fn flush<R: Real>(job: &mut Job<R>, words: &[R], flags: &[u32], stretches: usize) {
    let number = |at: usize| words[at].to_f64();
    if job.growing {
        for (total, word) in job.seen.growth.iter_mut().zip(&words[state::GROWN..]) {
            *total += word.to_f64();
        }
    }
    job.growing &= flags[flag::GROWING] == 1;
    job.guess = Some(number(state::OMEGA));
    job.keep_previous(words[state::PREVIOUS], flags[flag::CONTACT]);
    job.steps += u64::from(flags[flag::STEPS]);
    if flags[flag::OPENED] == 0 {
        return;
    }
    let from = job.time.max(job.marks[0]);
    let [contact, disarmed, piece] = at_start(flags[flag::AT_START]);
    job.open_window_at(State {
        body: body(&words[state::START..]),
        contact,
        piece,
        disarmed: event(disarmed, contact, piece),
        ..job.state
    });
    job.quiet &= flags[flag::EVENTFUL] == 0;
    job.seen.impacts += u64::from(flags[flag::IMPACTS]);
    for (totals, words) in job.seen.halves.iter_mut().zip(words[state::SEEN..].chunks_exact(sum::WORDS)) {
        for (total, word) in totals.iter_mut().zip(words) {
            *total += word.to_f64();
        }
    }
    for (peak, word) in job.seen.peaks.iter_mut().zip(&words[state::PEAKS..]) {
        *peak = peak.max(word.to_f64());
    }
    let crossings = flags[flag::CROSSINGS];
    let [first_in, last_in] = [flag::FIRST_IN, flag::LAST_IN].map(|word| flags[word] as usize);
    let mut begins = from;
    let over = words[state::HISTORY..].chunks_exact(history::WORDS);
    for (index, stretch) in over.take(stretches).enumerate() {
        let [omega, length] = [history::OMEGA, history::TIME].map(|word| stretch[word].to_f64());
        if crossings > 0 && index == first_in && job.seen.crossings == 0 {
            job.seen.first = begins + number(state::FIRST);
        }
        if crossings > 0 && index == last_in {
            job.seen.last = begins + number(state::LAST);
        }
        // Their sums are about the start of the stretch, those of a job about its middle.
        let half = 0.5 * length;
        let turned = |words: &[R]| turned(words, Complex64::cis(omega * half));
        let noted = crossings > 0 && index == last_in && flags[flag::FRESH] == 1;
        let noted = noted.then(|| turned(&words[state::NOTED..]));
        job.stretches.push(omega, [begins + half, half], turned(&stretch[history::SPECTRUM..]), noted);
        begins += length;
    }
    if crossings > 0 && flags[flag::FRESH] == 0 {
        job.stretches.forget();
    }
    job.seen.crossings += u64::from(crossings);
}

/// Contact state, event function and piece at the start of the window.
fn at_start(word: u32) -> [u32; 3] {
    [word & 3, word >> 2 & 3, word >> 4]
}

/// Fourier sums times a factor.
fn turned<R: Real>(sums: &[R], factor: Complex64) -> [f64; COMPONENTS] {
    let mut all = [0.0; COMPONENTS];
    for (turned, pair) in all.chunks_exact_mut(2).zip(sums.chunks_exact(2)) {
        let product = factor * Complex64::new(pair[0].to_f64(), pair[1].to_f64());
        turned.copy_from_slice(&[product.re, product.im]);
    }
    all
}
