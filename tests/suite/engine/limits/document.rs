//! The table as text, and a stored text against it.

use std::fmt::Write;

use super::measure::Found;
use crate::engines::Engine;

/// A scene and what each engine made of it: with 12 and with 4 steps per period, or with its own.
pub(crate) struct Row {
    pub(crate) name: String,
    pub(crate) cells: [Vec<Found>; Engine::ALL.len()],
}

/// Smaller errors are not told apart.
const SMALLEST: i32 = -9;

const INTRODUCTION: &str = "\
# Limits

Where each method and precision stops being trustworthy: scenes at the ends of the ranges, and the largest relative error
of each engine, to the next decade above three times of it, with 12 and with 4 steps per period (`12 / 4`), or the status in its place. The file is
written and compared by the tests (`SQUEALMAP_WRITE_LIMITS=1 cargo test --release --test suite limits`): an error that has
grown beyond its decade, or fallen by two, is a failed test. `gpu` is the kernel by its twin on the CPU, without the second computation in f64 of what ends early.

What holds for all of them:

- **A step is never too large.** `steps_per_period` bounds it from above, and so do the truncation of the motion's series,
  and, in each contact state, the fastest mode, shown by the motion or not (`|λ| h ≤ 2.35`, of the reference 1.8, and small
  enough that an unseen mode loses less than 5e-7 of itself in a step; but for the reference, in f32 and with 3 to 8 steps per period, a hundredth of the
  tolerance, 1e-5 at most, if it is no faster than 2 ω0). With a step of a whole period every number below is within 10 % still, or the status is not `ok`.
  Before the third bound, weakly excited stiff modes were raised from the rounding to the truncation's
  bound, and `ay_rms` was off by 100 % at k2/k1 = 100 (cpu f32) and by a factor of 100 at 1e4.
- **Stiffness costs time, then the status says so.** A run takes as many steps as its fastest mode asks for. Where they are
  so short that a position stands still within the rounding (f32: `ω/ω0` above some 2000 to 4600; f64: never before the
  500 000 steps per period at which all engines stop) it is `step_too_large`.
- **Size does not matter.** Forces and velocities, masses and springs scale out; by powers of two not a bit changes. Scaled
  numbers beyond 1e±18 are `non_finite`, before the run.
- **Length does.** A run has 2^24 steps at most, 1.4 million periods with 12 steps each, on every engine: in f32 an amplitude
  drifts by some 1e-9 of itself per step, 2 % over so many. A plan of more is `step_too_large` before the run, and a run that
  comes to more where it has to take shorter steps is so there, a minute or two after its beginning. Each of several
  starts is a run of its own.
- **So is a period bounded:** by 500 000 steps (`step_too_large`) and 20 000 events (`event_limit`). The reference counts them
  period by period. The CPU engine and a GPU count at the ends of its stretches of up to
  256 steps, and a stretch that is longer than a period may have the steps of all its periods in one of them, at most 2^23.
- **So is a friction table.** On a short piece that rises steeply, sliding is held by a rate of the slope times the normal force, which all engines resolve; where 500 000 steps per period are not enough it is `step_too_large`.
- **Thin layers take steps of their own.** Near rest an exponential or a rational law changes within `v_0` or `1/δ`, which no bound on
  positions sees. A step goes no further than three tenths (reference) to six tenths (f32) of the way to the pole that the motion has there in
  complex time, beyond which the series of its forces says nothing, on every engine; layers of 1e-8 of the velocities are those of the reference in f64. In f32 they end early below some 1e-6 of them, and are computed again in f64; laws of straight
  pieces, and exponential ones, that rise within some 1e-4 of them are left to f64 from the start. Where in addition `M11` all but vanishes on the way, the engines may differ.
- **Painlevé's is what the law can do.** Where a row is narrower than an arithmetic resolves, friction is evaluated beyond its ends;
  `M11 ≤ 0` of a friction that the law has nowhere is `step_too_large`.
- **At a limit statuses may differ.** Each engine has its own steps: `event_limit`, `step_too_large` and `ok` part where an instance needs
  some three quarters of a bound or more on one of them, and where speeds that matter are less than 1e-14 of others.
- **What is at rest is at rest.** Amplitudes below 1e-18 of `F_ext/k2` are 0 in f32: a motion that has died out that far
  is told as none.
- **On the edge rounding decides.** A single mass without any damping and with `mu_d = 0` slips from one edge of the stick cone
  exactly to the other. Any `mu_d` above 0 makes it stick there; at 0 itself the last bits say whether it sticks or slips
  back, the engines differ, and the status is `ok`. Ask for `mu_d = 1e-6`.
- **Chaos.** From a restitution of about 0.95 on, and wherever a motion grazes the belt, the last bits decide: statuses and
  statistics hold, single values do not.
- **Inputs have limits.** Only regular files are read, no pipes or devices: a sweep file of at most 4 MiB, points of 1 GiB and
  20 million rows, friction tables and materials of 16 MiB and 65 536 rows (on a GPU 1024 in a table, in two neighbours of a material together). Points take 16 bytes per value
  beside the file itself. Signals are of any length, long ones read up to three times, a row of them has at most 1 MiB. A value in a
  message is cut after 40 characters, and control characters are shown by their escapes; a title has none.
";

/// A document is written with this factor on every error, for machines that round otherwise.
pub(crate) const ROOM: f64 = 3.0;

/// The document, every error times `room`.
pub(crate) fn render(groups: &[(&'static str, &'static str, Vec<Row>)], room: f64) -> String {
    let mut text = INTRODUCTION.to_owned();
    let engines: Vec<&str> = Engine::ALL.iter().map(|engine| engine.name()).collect();
    for (title, source, rows) in groups {
        let _ = write!(text, "\n## {title}\n\n{source}\n\n| scene | {} |\n", engines.join(" | "));
        let _ = writeln!(text, "|---|{}", "---|".repeat(engines.len()));
        for row in rows {
            let cells: Vec<String> = row.cells.iter().map(|found| cell(found, room)).collect();
            let _ = writeln!(text, "| {} | {} |", row.name, cells.join(" | "));
        }
    }
    text
}

/// `1e-6 / 1e-3`, or once what is the same with any step.
fn cell(found: &[Found], room: f64) -> String {
    let mut words: Vec<String> = found.iter().map(|one| word(*one, room)).collect();
    words.dedup();
    words.join(" / ")
}

fn word(found: Found, room: f64) -> String {
    match found {
        Found::Ended(status) => status.name().to_owned(),
        #[expect(clippy::cast_possible_truncation, reason = "a decade")]
        Found::Off(error) if error.is_finite() => {
            let decade = (room * error).max(f64::MIN_POSITIVE).log10().ceil() as i32;
            format!("1e{}", decade.max(SMALLEST))
        }
        Found::Off(_) => "missing".to_owned(),
    }
}

/// Whether a stored document says what is measured; else the first line that does not.
pub(crate) fn is_same(stored: &str, measured: &str) -> Result<(), String> {
    let (stored, measured): (Vec<&str>, Vec<&str>) = (stored.lines().collect(), measured.lines().collect());
    for (index, line) in measured.iter().enumerate() {
        let Some(other) = stored.get(index) else { return Err(format!("missing: {line}")) };
        let (cells, others) = (line.split(" | "), other.split(" | "));
        let same = cells.clone().count() == others.clone().count()
            && others.zip(cells).all(|(stored, measured)| stored == measured || agrees(stored, measured));
        if !same {
            return Err(format!("stored   {other}\nmeasured {line}"));
        }
    }
    if stored.len() > measured.len() { Err(format!("too much: {}", stored[measured.len()])) } else { Ok(()) }
}

/// Whether a measured cell is what a stored one claims: the same decades, or one less.
pub(crate) fn agrees(stored: &str, measured: &str) -> bool {
    let grades = |cell: &str| -> Vec<String> {
        let words: Vec<String> = cell.trim_matches(['|', ' ']).split(" / ").map(str::to_owned).collect();
        // One word stands for both steps.
        if words.len() == 1 { vec![words[0].clone(), words[0].clone()] } else { words }
    };
    grades(stored).iter().zip(&grades(measured)).all(|(stored, measured)| {
        let decade = |word: &str| word.strip_prefix("1e").and_then(|digits| digits.parse::<i32>().ok());
        match (decade(stored), decade(measured)) {
            (Some(stored), Some(measured)) => measured <= stored && stored <= measured + 1,
            _ => stored == measured,
        }
    })
}
