//! The linear kernel: GPU against its twin, any chunk size, two runs.

use std::ops::Range;

use crate::Case;
use crate::words::{compare, device, differing, drive, inputs, on_cpu, on_gpu};
use libtest_mimic::Failed;
use squealmap::engine::backend::Backend;
use squealmap::engine::gpu::chunks::{Batch, Session};
use squealmap::engine::kernel::linear::KERNEL;
use squealmap::engine::kernel::places::{Column, filled};
use squealmap::engine::kernel::scalar::Real;
use squealmap::engine::kernel::words::INPUT_WORDS;
use squealmap::engine::options::Options;
use squealmap::engine::precision::Precision;
use squealmap::model::kind::InstabilityType;
use squealmap::sweep::map::Map;
use squealmap::sweep::run;
use squealmap::sweep::spec::Spec;

/// Instances of a comparison.
const COUNT: usize = 65_536;

pub(crate) const CASES: &[Case] = &[
    ("linear::f32_equals_its_twin", f32_equals_its_twin),
    ("linear::two_runs_give_the_same_bits", two_runs),
    ("linear::any_chunk_size_gives_the_same_bits", any_chunk),
    ("linear::paper_map_has_the_types_of_the_reference", paper_map),
    ("linear::modes_that_nothing_damps_have_the_types_of_the_reference", undamped),
    ("linear::a_lost_device_is_opened_again", lost),
];

pub(crate) const F64: &[Case] = &[("linear::f64_equals_its_twin", f64_equals_its_twin)];

fn twin<R: Real>(tolerance: f64) -> Result<(), Failed> {
    let inputs = inputs::<R>(COUNT);
    let (cpu, gpu) = (on_cpu(&inputs, COUNT), on_gpu(&inputs, COUNT)?);
    let worst = compare(&gpu, &cpu, COUNT, tolerance, COUNT / 10_000)?;
    println!(
        "{}: worst {worst:.1e}, {} of {} words differ",
        R::PRECISION,
        differing(&gpu, &cpu),
        cpu.state.len()
    );
    Ok(())
}

fn f32_equals_its_twin() -> Result<(), Failed> {
    twin::<f32>(2e-4)
}

fn f64_equals_its_twin() -> Result<(), Failed> {
    twin::<f64>(1e-12)
}

fn two_runs() -> Result<(), Failed> {
    let inputs = inputs::<f32>(10_000);
    let (first, second) = (on_gpu(&inputs, 10_000)?, on_gpu(&inputs, 10_000)?);
    if first == second { Ok(()) } else { Err("two runs differ".into()) }
}

/// A linear sweep of the paper's map on the GPU.
fn sweep_of(chunk: Option<usize>) -> Result<Map, Failed> {
    let mut spec = Spec::read("sweeps/paper_map.toml".as_ref())?;
    spec.analysis.response = false;
    let options = Options { backend: Backend::Gpu, chunk, ..Options::default() };
    Ok(run::run(spec, &options, &|_| {})?)
}

/// Modes of which one has no damping: their growth rates are 0, or far below what f32 rounds.
fn undamped() -> Result<(), Failed> {
    let text = "analysis = [\"linear\"]\n[friction]\nlaw = \"constant\"\n[belt]\nbelt_velocity = 1\n[model]\nc2 = 0\n\
         [axes]\ntheta = { values = [0, 0.01] }\nc1 = { values = [0, 3.3, 57.7] }\nmu_d = { from = 0.05, to = 0.9, points = 13 }\n\
         k2 = { from = 7e4, to = 1.9e5, points = 31 }\n";
    let spec = Spec::parse(text, "the test", "".as_ref())?;
    let on = |backend| {
        let options = Options { backend, precision: None, ..Options::default() };
        run::run(spec.clone(), &options, &|_| {})
    };
    let [map, reference] = [Backend::Gpu, Backend::Reference].map(on);
    let (map, reference) = (map?, reference?);
    let others = map.records.iter().zip(&reference.records).filter(|(a, b)| a.kind != b.kind).count();
    let stable = reference.records.iter().filter(|one| one.kind == Some(InstabilityType::Stable)).count();
    println!("{others} of {} types differ; {stable} are stable", map.records.len());
    if others == 0 && stable > 100 { Ok(()) } else { Err(format!("{others} types differ").into()) }
}

fn any_chunk() -> Result<(), Failed> {
    let whole = sweep_of(None)?;
    for chunk in [1000, 4096, 8404] {
        if sweep_of(Some(chunk))?.records != whole.records {
            return Err(format!("chunks of {chunk} differ").into());
        }
    }
    Ok(())
}

fn paper_map() -> Result<(), Failed> {
    let map = sweep_of(None)?;
    let linear = map.provenance.linear.ok_or("no provenance")?;
    assert_eq!((linear.backend.as_str(), linear.precision.as_str()), ("gpu", "f32"));
    assert!(linear.adapter.is_some());
    let mut worst = 0.0_f64;
    for (index, record) in map.records.iter().enumerate() {
        let (kind, expected) = squealmap::model::linear::analyse(&map.spec.instance(index));
        assert_eq!(record.kind, kind, "instance {index}");
        if let (Some(actual), Some(expected)) = (record.linear, expected) {
            let size = expected.growth_rate.hypot(std::f64::consts::TAU * expected.frequency.unwrap_or(0.0));
            worst = worst.max((actual.growth_rate - expected.growth_rate).abs() / size);
        }
    }
    println!("growth rates are off by {worst:.1e} |λ| at most");
    assert!(worst < 1e-6, "{worst:e}");
    Ok(())
}

fn lost() -> Result<(), Failed> {
    let inputs = inputs::<f32>(1000);
    let expected = on_gpu(&inputs, 1000)?;
    let mut session = Session::new(device(Precision::F32)?);
    session.device().destroy();
    let mut sizes = Vec::new();
    let mut flags = 0;
    let prepare = |range: Range<usize>| {
        sizes.push(range.len());
        batch(&inputs, range)
    };
    session.each(&KERNEL, [1000, 1000], &drive(), prepare, |(), result| {
        flags += result.flags.len();
        Ok(())
    })?;
    assert_eq!(sizes, [1000, 500, 500], "the chunk is halved");
    assert_eq!(flags, expected.flags.len());
    session.device().destroy();
    let again = session.each(&KERNEL, [1000, 1000], &drive(), |range| batch(&inputs, range), |(), _| Ok(()));
    let message = again.err().map(|why| why.to_string()).unwrap_or_default();
    assert!(message.starts_with("the GPU was lost twice: "), "{message}");
    assert!(message.contains("0 of 1000 instances were done; use --backend cpu"), "{message}");
    Ok(())
}

/// Some of the instances of inputs.
fn batch(inputs: &[f32], range: Range<usize>) -> Batch<f32, ()> {
    let rows: Vec<Vec<f32>> =
        range.map(|index| Column::of_buffer(inputs, INPUT_WORDS, index).iter().collect()).collect();
    Batch { inputs: (filled(INPUT_WORDS, rows.len(), |index| &rows[index][..]), rows.len()), memory: () }
}
