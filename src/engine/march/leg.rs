//! The leg of an instance: what a device goes through of its run without the host.

use std::f64::consts::TAU;

use crate::engine::kernel::scalar::Real;
use crate::engine::lanes::job::{FIRST_STRETCH, Job, STRETCH};
use crate::engine::march::table::{SECTIONS, history};

/// Steps of the same length.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Section {
    /// How many, if none is cut short.
    pub whole: u32,
    /// Their length.
    pub step: f64,
}

/// A leg: as much of a run as its belt has one acceleration, and as its stretches of the window have places.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Leg {
    /// The time before the window, and its two halves.
    pub sections: [Section; SECTIONS],
    /// Its length.
    pub length: f64,
    /// Time from its end to that of the window, where it is in that.
    pub beyond: f64,
    /// How many stretches it has in the window.
    pub stretches: usize,
}

impl Leg {
    /// The next one of a job; `None` at the end of the window.
    #[must_use]
    pub fn next<R: Real>(job: &Job<R>, steps_per_period: u32) -> Option<Leg> {
        let nominal = TAU / f64::from(steps_per_period);
        let end = job.marks[SECTIONS - 1];
        if job.time >= end {
            return None;
        }
        let (_, holds) = job.scene.belt_from(job.time);
        let mut leg = Leg::default();
        let mut at = job.time;
        for (number, mark) in job.marks.iter().enumerate() {
            let goal = mark.min(job.time + holds);
            if at >= goal {
                continue;
            }
            let whole = ((goal - at) / nominal - 1e-6).ceil().max(1.0);
            let step = (goal - at) / whole;
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "less than MOST_STEPS"
            )]
            let whole = whole as u32;
            let gone = if number == 0 { whole } else { leg.stretch(whole, job.stretches.len()) };
            leg.sections[number] = Section { whole: gone, step };
            at = if gone == whole { goal } else { at + f64::from(gone) * step };
            if gone < whole || goal < *mark {
                break;
            }
        }
        leg.length = at - job.time;
        leg.beyond = end - at;
        Some(leg)
    }

    /// Takes stretches of the window for so many steps, as long as there are places; how many steps they are.
    fn stretch(&mut self, whole: u32, before: usize) -> u32 {
        let mut gone = 0;
        while gone < whole && self.stretches < history::MOST {
            #[expect(clippy::cast_possible_truncation, reason = "a number of stretches")]
            let place = (1 + before + self.stretches) as u32;
            gone += STRETCH.min(FIRST_STRETCH * place).min(whole - gone);
            self.stretches += 1;
        }
        gone
    }

    /// The time that is left of it after `left` of a stretch and so many steps of every section.
    #[must_use]
    pub fn left(&self, left: f64, whole: [u32; SECTIONS]) -> f64 {
        self.sections
            .iter()
            .zip(whole)
            .fold(left, |left, (section, whole)| left + f64::from(whole) * section.step)
    }
}
