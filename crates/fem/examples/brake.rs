//! A disc brake with 100 coefficients of friction: time and memory against the number of unknowns.
//!
//!     cargo run --release -p squealmap-fem --example brake [-- --write]
//!
//! `--write` puts the rows into benches/results/brake.csv. One size is given as its elements along the radius, around and along the axis, as `14,120,2`, and behind it other residuals than 1e-4. With `order` before it, the ways to order the
//! elimination are compared, that of METIS (Debian package metis) where it is installed; `order pin,4` does that for a pin on a block.

#![allow(clippy::doc_markdown, reason = "METIS and symbols of equations are no code")]

#[path = "../tests/suite/cases/mod.rs"]
#[expect(dead_code, reason = "one of the models is used here")]
mod cases;
#[expect(dead_code, reason = "of the costs those of this program are used here")]
mod cost;

use std::fmt::Write as _;
use std::process::{Command, Stdio};
use std::time::Instant;

use cost::{memory, work};
use squealmap_fem::assembly::{Model, Pencil, Rows, assemble};
use squealmap_fem::elements::Kind;
use squealmap_fem::modes::{Basis, Factor, Ordering, lowest, refine};
use squealmap_fem::sweep::{Range, sweep};

type Failure = Box<dyn std::error::Error>;

/// Residuals to which the space is refined at three coefficients of friction; between these they are allowed ten times as much.
const BOUND: f64 = 1e-4;

fn main() -> Result<(), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match words.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        [] => all(false),
        ["--write"] => all(true),
        ["order", size] => compare(&of_size(size)?),
        [size] => run(size, BOUND),
        [size, bound] => run(size, bound.parse()?),
        _ => Err("give a size as 14,120,2, or nothing for all".into()),
    }
}

/// Columns of the table.
const HEAD: [&str; 17] = [
    "elements",
    "unknowns",
    "contact points",
    "entries of L",
    "matrices, s",
    "order and factor, s",
    "40 modes, s",
    "space, s",
    "100 μ, s",
    "work of all cores, s",
    "wall, s",
    "memory, GB",
    "vectors",
    "largest residual",
    "unstable from μ",
    "Hz",
    "load before",
];

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../benches/results/brake.csv");

/// The table, and the file where it is asked for.
fn all(write: bool) -> Result<(), Failure> {
    println!("| {} |\n{}|", HEAD.join(" | "), "|---".repeat(HEAD.len()));
    let named = HEAD.map(|name| name.replace(", ", "_").replace(' ', "_").replace('μ', "mu"));
    let mut file = named.join(",").to_lowercase() + "\n";
    // Each in a program of its own: the memory is the most that a program has had.
    for size in ["7,60,2", "14,120,2", "14,120,4", "21,132,4"] {
        let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
        let load = load.split_whitespace().next().unwrap_or("unknown").to_owned();
        let ended = Command::new(std::env::current_exe()?).arg(size).stderr(Stdio::inherit()).output()?;
        if !ended.status.success() {
            return Err(format!("the brake of {size} elements failed").into());
        }
        let row = String::from_utf8(ended.stdout)?;
        let cells: Vec<&str> =
            row.trim().trim_matches('|').split('|').map(str::trim).chain([load.as_str()]).collect();
        println!("| {} |", cells.join(" | "));
        file += &(cells.join(",").replace(" × ", "x") + "\n");
    }
    if write {
        std::fs::write(FILE, file)?;
    }
    Ok(())
}

/// The brake by its numbers of elements, or the pin on the block by `pin,n` with elements of 5 mm over n.
fn of_size(size: &str) -> Result<Model, Failure> {
    if let Some(cut) = size.strip_prefix("pin,") {
        return Ok(cases::pin::model(Kind::Hex20, cut.parse()?)?);
    }
    let cells: Vec<usize> = size.split(',').map(str::parse).collect::<Result<_, _>>()?;
    let cells = cells.try_into().map_err(|_| "give three numbers of elements, as 14,120,2, or pin,4")?;
    Ok(cases::brake::model(Kind::Hex20, cells)?)
}

/// One row of the table.
fn run(size: &str, bound: f64) -> Result<(), Failure> {
    let start = Instant::now();
    let mut clock = vec![work()];
    let model = of_size(size)?;
    let (numbering, pencil) = assemble(&model)?;
    clock.push(work());
    let ordering = Ordering::best(&pencil.stiffness.pattern, &numbering.places(&model.mesh))?;
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0)?;
    clock.push(work());
    let modes = lowest(&pencil, &factor, 40)?;
    clock.push(work());
    let mut basis = Basis::new(&pencil, &modes.shapes);
    let none = Rows::default();
    refine(&pencil, &factor, &mut basis, &[0.3, 0.6, 0.9], &none, 30, bound, 20)?;
    clock.push(work());
    let mus: Vec<f64> = (0..100).map(|i| 0.01 * f64::from(i)).collect();
    let range = Range { mus: &mus, slope: &none, count: 30, bound: 10.0 * bound };
    let modes = sweep(&pencil, &ordering, &factor, &basis, range)?;
    clock.push(work());
    let states = || modes.iter().flat_map(|mode| mode.states.iter());
    let worst = states().map(|state| state.residual).fold(0.0, f64::max);
    let first = (0..mus.len()).find_map(|i| {
        let grows = modes.iter().map(|mode| mode.states[i].lambda).find(|lambda| lambda.re > 1.0);
        grows.map(|lambda| format!("{:.2} | {:.1}", mus[i], lambda.im / std::f64::consts::TAU))
    });
    let seconds: Vec<String> = clock.windows(2).map(|w| format!("{:.1}", w[1] - w[0])).collect();
    println!(
        "| {} | {} | {} | {:.2e} | {} | {:.1} | {:.1} | {:.2} | {} | {worst:.1e} | {} |",
        size.replace(',', " × "),
        pencil.size(),
        pencil.slip.rows.len(),
        ordering.entries() as f64,
        seconds.join(" | "),
        clock[clock.len() - 1] - clock[0],
        start.elapsed().as_secs_f64(),
        memory(),
        basis.vectors.ncols(),
        first.unwrap_or("none | ".to_owned())
    );
    Ok(())
}

/// What each order of elimination costs.
fn compare(model: &Model) -> Result<(), Failure> {
    let (numbering, pencil) = assemble(model)?;
    let pattern = &pencil.stiffness.pattern;
    println!(
        "{} unknowns\n\n| order | entries of L | order, s | factor, s |\n|---|---|---|---|",
        pencil.size()
    );
    let before = Instant::now();
    let row = |name: &str, ordering: Ordering, order: f64| -> Result<(), Failure> {
        let before = work();
        Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0)?;
        let entries = ordering.entries() as f64;
        println!("| {name} | {entries:.2e} | {order:.1} | {:.1} |", work() - before);
        Ok(())
    };
    let ordering = Ordering::dissected(pattern, &numbering.places(&model.mesh))?;
    row("nested dissection by places", ordering, before.elapsed().as_secs_f64())?;
    let before = Instant::now();
    match metis(&pencil)? {
        Some(order) => {
            let ordering = Ordering::given(pattern, &order)?;
            row("METIS (ndmetis)", ordering, before.elapsed().as_secs_f64())?;
        }
        None => println!("| METIS | ndmetis is not installed (Debian package metis) | | |"),
    }
    let before = Instant::now();
    let ordering = Ordering::new(pattern)?;
    row("minimum degree (faer)", ordering, before.elapsed().as_secs_f64())
}

/// The order of METIS's program, `None` where it is not installed.
fn metis(pencil: &Pencil) -> Result<Option<Vec<usize>>, Failure> {
    let pattern = &pencil.stiffness.pattern;
    let size = pattern.size();
    let file = std::env::temp_dir().join(format!("squealmap-{}.graph", std::process::id()));
    let mut text = format!("{size} {}\n", (pattern.row.len() - size) / 2);
    for i in 0..size {
        for j in pattern.row[pattern.start[i]..pattern.start[i + 1]].iter().filter(|j| **j != i) {
            write!(text, "{} ", j + 1)?;
        }
        text.push('\n');
    }
    std::fs::write(&file, text)?;
    let ran = Command::new("ndmetis").arg(&file).output();
    std::fs::remove_file(&file)?;
    let Ok(ran) = ran else { return Ok(None) };
    if !ran.status.success() {
        return Err(format!("ndmetis: {}", String::from_utf8_lossy(&ran.stderr)).into());
    }
    let ordered = file.with_extension("graph.iperm");
    let mut order = vec![0; size];
    for (i, line) in std::fs::read_to_string(&ordered)?.lines().enumerate() {
        order[line.trim().parse::<usize>()?] = i;
    }
    std::fs::remove_file(ordered)?;
    Ok(Some(order))
}
