//! Progress on standard error: a bar on a terminal, plain lines otherwise.

use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use console::Term;
use indicatif::{ProgressBar, ProgressStyle};

use crate::cli::talk;

/// Plain lines are printed each time another of this many parts is done …
const LINES: usize = 10;

/// … but not in this first time, s: a short sweep needs no news.
const QUIET: f64 = 1.0;

/// Columns that the words beside the bar take at most, besides the two counts: the longest time, a rate of eight digits.
const WORDS: usize = " of  instances, 5399 h 59 min left, 12345678 instances/s ".len();

/// Columns of the longest bar.
const BAR: usize = 32;

/// Counts what is finished: instances, or what else a command has many of.
#[derive(Debug)]
pub(crate) struct Progress {
    total: usize,
    unit: &'static str,
    done: AtomicUsize,
    began: Instant,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// Starts counting to `total` of a `unit`, in the plural.
    pub(crate) fn new(total: usize, unit: &'static str) -> Progress {
        let bar = (std::io::stderr().is_terminal() && !talk::is_quiet()).then(|| {
            let columns = usize::from(Term::stderr().size().1);
            let words = WORDS + 2 * total.to_string().len();
            // The words are clipped where they do not fit: a line that wraps is drawn again and again.
            let template = match columns.saturating_sub(words).min(BAR) {
                0..8 => "{wide_msg}".to_owned(),
                bar => format!("{{bar:{bar}}} {{wide_msg}}"),
            };
            let style = ProgressStyle::with_template(&template);
            ProgressBar::new(total as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        });
        Progress { total, unit, done: AtomicUsize::new(0), began: Instant::now(), bar }
    }

    /// Adds newly finished instances; called from every worker.
    pub(crate) fn add(&self, count: usize) {
        let before = self.done.fetch_add(count, Ordering::Relaxed);
        let done = before + count;
        match &self.bar {
            Some(bar) => {
                bar.set_message(self.words(done));
                bar.inc(count as u64);
            }
            None if self.part(before) < self.part(done) && done < self.total => self.line(done),
            None => {}
        }
    }

    /// Removes the bar.
    pub(crate) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }

    /// How many of the parts `done` instances fill.
    fn part(&self, done: usize) -> usize {
        done.saturating_mul(LINES) / self.total.max(1)
    }

    fn line(&self, done: usize) {
        if self.began.elapsed().as_secs_f64() >= QUIET && !talk::is_quiet() {
            let _ = writeln!(std::io::stderr().lock(), "{}", self.words(done));
        }
    }

    /// How far it has come, the most wanted first.
    fn words(&self, done: usize) -> String {
        let rate = done as f64 / self.began.elapsed().as_secs_f64().max(f64::MIN_POSITIVE);
        let left = seconds(self.total.saturating_sub(done) as f64 / rate);
        let Progress { total, unit, .. } = self;
        // What is done in many seconds has no rate to speak of.
        let pace = if rate < 1.0 { String::new() } else { format!(", {rate:.0} {unit}/s") };
        format!("{done} of {total} {unit}, {left} left{pace}")
    }
}

/// A time for people: `3.5 ms`, `0.35 s`, `42 s`, `3 min 20 s`, `2 h 5 min`.
pub(crate) fn seconds(seconds: f64) -> String {
    if seconds < 0.1 {
        format!("{:.2} ms", seconds * 1e3)
    } else if seconds < 10.0 {
        format!("{seconds:.2} s")
    } else if seconds < 90.0 {
        format!("{seconds:.0} s")
    } else if seconds < 5400.0 {
        format!("{:.0} min {:.0} s", (seconds / 60.0).floor(), seconds % 60.0)
    } else {
        format!("{:.0} h {:.0} min", (seconds / 3600.0).floor(), (seconds % 3600.0) / 60.0)
    }
}
