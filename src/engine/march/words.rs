//! The next leg of a job as words of the kernel, and what has come of it back into the job.

use num_complex::Complex64;

use crate::engine::kernel::places::Column;
use crate::engine::kernel::scalar::Real;
use crate::engine::lanes::block::{FIRST, SECOND, THIRD, event_of};
use crate::engine::lanes::constants::LAYER;
use crate::engine::lanes::contact::{Body, FREE, NOTHING, STICK, State, UPPER_KINK};
use crate::engine::lanes::job::{Job, Part};
use crate::engine::lanes::spectrum::COMPONENTS;
use crate::engine::march::leg::Leg;
use crate::engine::march::table::{SECTIONS, flag, head, history, piece, state};
use crate::engine::scene::MOST_STEPS;
use crate::model::status::Status;

/// What a leg of a job begins from, as the words of a kernel's inputs.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts are words of a kernel")]
pub(super) fn put<R: Real>(job: &Job<R>, leg: &Leg, inputs: &mut [R]) {
    let belt = job.warmth.seen(job.scene.belt(job.time));
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

    let words = &mut inputs[head::START..head::COUNTS];
    words.fill(R::ZERO);
    put_body(&mut words[state::BODY..], &job.state.body);
    words[state::BELT] = R::from_f64(belt.velocity);
    words[state::PREVIOUS] = job.previous;
    words[state::OMEGA] = R::from_f64(job.guessed_omega());
    let start = job.start_of_window();
    if let Some(start) = &start {
        put_body(&mut words[state::START..], start);
    }

    let mut flags = [0; flag::SENT];
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
    if start.is_some() {
        flags[flag::OPENED] = 1;
        flags[flag::BEGUN] = u32::from(job.seen.crossings > 0);
        flags[flag::BEFORE] = job.stretches.len() as u32;
    }
    for (word, flag) in inputs[head::COUNTS..head::WORDS].iter_mut().zip(flags) {
        *word = R::from_f64(f64::from(flag));
    }
}

/// Takes what the kernel has made of a leg; `None` when its status is none that it may have, or it says that it came to
/// its end and did not.
pub(super) fn take<R: Real>(job: &mut Job<R>, leg: &Leg, words: Column<R>, flags: Column<u32>) -> Option<()> {
    let status = Status::from_code(flags.at(flag::STATUS)).filter(|status| *status != Status::Unwritten)?;
    let whole: [u32; SECTIONS] = std::array::from_fn(|k| flags.at(flag::WHOLE + k));
    let left = leg.left(words.at(state::LEFT).to_f64(), whole);
    let stretches = flags.at(flag::STRETCH) as usize;
    if status == Status::Ok && (left > 0.0 || stretches != leg.stretches) || stretches > leg.stretches {
        return None;
    }
    flush(job, words, flags, stretches);
    job.state = State {
        body: body(words.from(state::BODY)),
        contact: flags.at(flag::CONTACT),
        piece: flags.at(flag::PIECE),
        at_once: flags.at(flag::AT_ONCE),
        disarmed: event(flags.at(flag::DISARMED), flags.at(flag::CONTACT), flags.at(flag::PIECE)),
        status: if status == Status::Ok { job.state.status } else { status },
    };
    job.time = if left > 0.0 { (job.until - left).max(job.time) } else { job.until };
    Some(())
}

fn put_body<R: Real>(words: &mut [R], body: &Body<R>) {
    words[..3].copy_from_slice(&body.p);
    words[3..6].copy_from_slice(&body.v);
}

fn body<R: Real>(words: Column<R>) -> Body<R> {
    Body { p: std::array::from_fn(|k| words.at(k)), v: std::array::from_fn(|k| words.at(3 + k)) }
}

/// The event of a function of the kernel.
fn event(function: u32, contact: u32, piece: u32) -> u32 {
    if function == 0 { NOTHING } else { event_of(function, contact, piece) }
}

/// Adds what a leg has summed to the job.
fn flush<R: Real>(job: &mut Job<R>, words: Column<R>, flags: Column<u32>, stretches: usize) {
    let number = |at: usize| words.at(at).to_f64();
    if job.growing {
        for (total, word) in job.seen.growth.iter_mut().zip(words.from(state::GROWN).iter()) {
            *total += word.to_f64();
        }
    }
    job.growing &= flags.at(flag::GROWING) == 1;
    job.guess = Some(number(state::OMEGA));
    job.keep_previous(words.at(state::PREVIOUS), flags.at(flag::CONTACT));
    job.steps += u64::from(flags.at(flag::STEPS));
    if flags.at(flag::OPENED) == 0 {
        return;
    }
    let from = job.time.max(job.marks[0]);
    let [contact, disarmed, piece] = at_start(flags.at(flag::AT_START));
    job.open_window_at(State {
        body: body(words.from(state::START)),
        contact,
        piece,
        disarmed: event(disarmed, contact, piece),
        ..job.state
    });
    job.quiet &= flags.at(flag::EVENTFUL) == 0;
    job.seen.impacts += u64::from(flags.at(flag::IMPACTS));
    for (total, word) in job.seen.halves.iter_mut().flatten().zip(words.from(state::SEEN).iter()) {
        *total += word.to_f64();
    }
    for (peak, word) in job.seen.peaks.iter_mut().zip(words.from(state::PEAKS).iter()) {
        *peak = peak.max(word.to_f64());
    }
    let crossings = flags.at(flag::CROSSINGS);
    let [first_in, last_in] = [flag::FIRST_IN, flag::LAST_IN].map(|word| flags.at(word) as usize);
    let mut begins = from;
    job.stretches.reserve(stretches);
    for index in 0..stretches {
        let stretch = words.from(state::HISTORY + index * history::WORDS);
        let [omega, length] = [history::OMEGA, history::TIME].map(|word| stretch.at(word).to_f64());
        if crossings > 0 && index == first_in && job.seen.crossings == 0 {
            job.seen.first = begins + number(state::FIRST);
        }
        if crossings > 0 && index == last_in {
            job.seen.last = begins + number(state::LAST);
        }
        // Their sums are about the start of the stretch, those of a job about its middle.
        let half = 0.5 * length;
        let factor = Complex64::cis(omega * half);
        let noted = crossings > 0 && index == last_in && flags.at(flag::FRESH) == 1;
        let noted = noted.then(|| turned(words.from(state::NOTED), factor));
        job.stretches.push(
            omega,
            [begins + half, half],
            turned(stretch.from(history::SPECTRUM), factor),
            noted,
        );
        begins += length;
    }
    if crossings > 0 && flags.at(flag::FRESH) == 0 {
        job.stretches.forget();
    }
    job.seen.crossings += u64::from(crossings);
}

/// Contact state, event function and piece at the start of the window.
fn at_start(word: u32) -> [u32; 3] {
    [word & 3, word >> 2 & 3, word >> 4]
}

/// Fourier sums times a factor.
fn turned<R: Real>(sums: Column<R>, factor: Complex64) -> [f64; COMPONENTS] {
    let mut all = [0.0; COMPONENTS];
    for (pair, turned) in all.chunks_exact_mut(2).enumerate() {
        let product = factor * Complex64::new(sums.at(2 * pair).to_f64(), sums.at(2 * pair + 1).to_f64());
        turned.copy_from_slice(&[product.re, product.im]);
    }
    all
}
