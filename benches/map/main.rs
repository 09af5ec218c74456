//! `cargo bench --bench map [-- options]`: one map on every engine, judged; see [`options::Options`].

mod clock;
mod date;
mod engine;
mod flops;
mod gpu;
mod judge;
mod kept;
mod machine;
mod options;
mod peak;
mod row;
mod store;
mod table;
mod work;

use std::error::Error;

use clap::Parser;
use squealmap::engine::gpu::adapter::Adapter;
use squealmap::engine::precision::Precision;
use squealmap::sweep::spec::STEPS_PER_PERIOD;

use clock::{Clock, Elapsed, peak_memory};
use engine::{Case, Engine};
use judge::Judge;
use machine::Machine;
use options::Options;
use row::Row;
use table::Tables;
use work::Work;

/// A map is computed again until this many seconds are over: CPU time is counted in hundredths of a second.
const LEAST_SECONDS: f64 = 0.4;

/// Most instances for scalar codes, which compute about a thousand a second.
const MOST_FOR_SCALAR: usize = 2000;

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::parse();
    let adapter = options.engines.contains(&Engine::Gpu).then(gpu::adapter).flatten();
    let mut machine = Machine::new()?;
    let mut rows = Vec::new();
    for &size in &options.sizes {
        let work = Work::of_size(size);
        let judge = Judge::new(work);
        let mut of_size: Vec<Row> = cases(&options, work, adapter.as_ref())
            .into_iter()
            .map(|case| blank(case, work, adapter.as_ref()))
            .collect();
        for _ in 0..options.rounds.max(1) {
            machine.measure_again()?;
            for row in &mut of_size {
                measure(row, work, &judge, adapter.as_ref())?;
            }
        }
        rows.extend(of_size);
    }
    check_peak(&rows, &machine)?;
    print!("{}", Tables { rows: &rows, machine: &machine });
    if !options.dry {
        eprintln!("kept in {}", store::store(&rows, &machine)?.display());
    }
    Ok(())
}

/// What is measured on a map.
fn cases(options: &Options, work: Work, adapter: Option<&Adapter>) -> Vec<Case> {
    let scalars = options.scalars.iter().copied();
    let case = |engine, precision, steps_per_period| Case { engine, precision, steps_per_period };
    let mut cases = Vec::new();
    if work.len() <= MOST_FOR_SCALAR {
        cases.push(case(Engine::Reference, Precision::F64, STEPS_PER_PERIOD));
    }
    for precision in scalars.clone() {
        for &steps in &options.steps {
            if work.len() <= MOST_FOR_SCALAR {
                cases.push(case(Engine::Scalar, precision, steps));
            }
            cases.push(case(Engine::Simd, precision, steps));
        }
    }
    if let Some(adapter) = adapter.filter(|adapter| gpu::is_fit(adapter, work)) {
        let computes = |precision: &Precision| *precision == Precision::F32 || adapter.describe().f64;
        for precision in scalars.filter(computes) {
            cases.extend(options.steps.iter().map(|steps| case(Engine::Gpu, precision, *steps)));
        }
    }
    cases.retain(|case| options.engines.contains(&case.engine));
    cases
}

/// A row before its first round.
fn blank(case: Case, work: Work, adapter: Option<&Adapter>) -> Row {
    let adapter = adapter.filter(|_| case.engine == Engine::Gpu);
    Row {
        case,
        instances: work.len(),
        best: Elapsed { wall: f64::INFINITY, cpu: Some(f64::INFINITY) },
        steps: 0,
        failed: 0,
        errors: judge::Errors::default(),
        adapter: adapter.map(|adapter| gpu::name(&adapter.describe())).unwrap_or_default(),
        on_cpu: adapter.is_none_or(Adapter::may_be_software),
        memory: None,
    }
}

/// One round of a row.
fn measure(
    row: &mut Row,
    work: Work,
    judge: &Judge,
    adapter: Option<&Adapter>,
) -> squealmap::error::Result<()> {
    let clock = Clock::start();
    let mut maps = 0.0;
    let mut elapsed = clock.elapsed();
    while maps < 1.0 || elapsed.wall < LEAST_SECONDS {
        let output = row.case.run(work, &judge.indices, adapter)?;
        maps += 1.0;
        elapsed = clock.elapsed();
        if row.memory.is_none() {
            row.memory = peak_memory();
            if let Some((index, status)) = output.failed.first() {
                let (case, values) = (row.case, work.values(*index));
                eprintln!("{case:?}: [mu_s, mu_d, V, kick] = {values:?} ended as {}", status.name());
            }
            row.take(&output, judge.errors(&output.judged));
        }
    }
    row.improve(Elapsed { wall: elapsed.wall / maps, cpu: elapsed.cpu.map(|cpu| cpu / maps) });
    Ok(())
}

/// A peak that something else beats is none.
fn check_peak(rows: &[Row], machine: &Machine) -> Result<(), String> {
    for row in rows {
        if let Some([share, _]) = row.share_of_peak(machine).filter(|[share, _]| *share >= 1.0) {
            return Err(format!("{} computes at {share:.2} of the measured peak", row.case.engine.name()));
        }
    }
    Ok(())
}
