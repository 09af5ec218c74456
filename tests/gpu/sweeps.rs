//! Whole sweeps with response on the GPU: against the reference, any chunk size, two runs, every kernel.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use crate::Case;
use crate::differences::Differences;
use crate::twin::outcomes;
use libtest_mimic::Failed;
use squealmap::engine::Engine;
use squealmap::engine::backend::Backend;
use squealmap::engine::computation::Stopped;
use squealmap::engine::gpu::adapter::Adapter;
use squealmap::engine::gpu::chunks::software_chunk;
use squealmap::engine::gpu::device::Device;
use squealmap::engine::gpu::records::Gpu;
use squealmap::engine::options::Options;
use squealmap::engine::plan::{Duration, Plan};
use squealmap::engine::precision::Precision;
use squealmap::engine::record::Record;
use squealmap::model::Param;
use squealmap::model::instance::Instance;
use squealmap::model::status::Status;
use squealmap::sweep::map::Map;
use squealmap::sweep::run;
use squealmap::sweep::spec::Spec;

pub(crate) const CASES: &[Case] = &[
    ("sweeps::a_coarse_paper_map_is_that_of_the_reference", coarse_paper_map),
    ("sweeps::every_law_and_a_ramp_are_those_of_the_reference", laws_and_ramp),
    ("sweeps::a_pad_that_warms_up_is_that_of_the_reference", warms_up),
    ("sweeps::leaning_springs_are_those_of_the_reference", leaning_springs),
    ("sweeps::runs_until_settled_are_those_of_the_reference", until_settled),
    ("sweeps::slow_belts_are_those_of_the_reference", slow_belts),
    ("sweeps::belts_on_a_kink_of_the_law_have_the_frequency_of_the_reference", on_a_kink),
    ("sweeps::a_table_of_forty_rows_is_that_of_the_reference", || table(40, 24)),
    ("sweeps::a_table_of_a_hundred_rows_is_that_of_the_reference", || table(100, 12)),
    ("sweeps::tables_of_a_material_are_those_of_the_reference", tables),
    ("sweeps::any_chunk_size_and_two_runs_give_the_same_records", any_chunk),
    ("sweeps::instances_that_cannot_start_keep_their_status", dead),
    ("sweeps::a_cancelled_sweep_keeps_what_is_finished", cancelled),
    ("sweeps::a_cancelled_sweep_keeps_what_was_told", keeps_told),
    ("sweeps::any_number_of_devices_gives_the_same_records", several_devices),
    ("sweeps::a_lost_device_loses_nothing", lost),
    ("sweeps::the_comparer_sees_another_scene", planted),
];

pub(crate) const SLOW: &[Case] = &[
    ("sweeps::paper_map_is_that_of_the_reference", paper_map),
    ("sweeps::two_million_steps_per_instance", two_million_steps),
    ("sweeps::a_table_of_a_thousand_rows_is_that_of_the_reference", || table(1000, 6)),
];

pub(crate) const F64: &[Case] = &[("sweeps::f64_is_that_of_its_twin", in_f64)];

fn on_gpu(spec: &Spec, precision: Precision, chunk: Option<usize>) -> Result<Map, Failed> {
    let options = Options { backend: Backend::Gpu, precision: Some(precision), chunk, ..Options::default() };
    Ok(run::run(spec.clone(), &options, &|_| {})?)
}

fn on_cpu(spec: &Spec) -> Result<Map, Failed> {
    Ok(run::run(spec.clone(), &Options { backend: Backend::Reference, ..Options::default() }, &|_| {})?)
}

/// At least 99.5 % of the labels equal, amplitudes within the median and the 99th percentile.
fn verdict(differences: &Differences, median: f64, p99: f64) -> Result<(), Failed> {
    let Differences { labels, windows, amplitudes, instances } = differences;
    if (labels.len() + windows.len()) * 200 > *instances {
        return Err(
            format!("{} of {instances} labels or windows differ", labels.len() + windows.len()).into()
        );
    }
    let found = [50, 99].map(|share| differences.quantile(share));
    if amplitudes.len() < *instances || !(found[0] <= median && found[1] <= p99) {
        return Err(format!("{} amplitudes: {found:?}", amplitudes.len()).into());
    }
    Ok(())
}

/// As [`verdict`], printing how the map differs.
fn check(map: &Map, reference: &Map, median: f64, p99: f64) -> Result<(), Failed> {
    let differences = Differences::new(map, reference);
    println!("{differences}");
    verdict(&differences, median, p99)
}

/// A sweep from the text of its file.
fn spec(text: &str) -> Result<Spec, Failed> {
    let mut spec = Spec::parse(text, "the test", "".as_ref())?;
    // Checks would put results of the CPU into those of the GPU.
    spec.analysis.checked = false;
    Ok(spec)
}

/// The shipped map with `points` friction coefficients on each axis.
fn paper_map_of(points: usize) -> Result<Spec, Failed> {
    let text = std::fs::read_to_string("sweeps/paper_map.toml")?;
    spec(&text.replace("points = 41", &format!("points = {points}")))
}

fn coarse_paper_map() -> Result<(), Failed> {
    let spec = paper_map_of(7)?;
    check(&on_gpu(&spec, Precision::F32, None)?, &on_cpu(&spec)?, 1e-5, 2e-3)
}

fn paper_map() -> Result<(), Failed> {
    let spec = paper_map_of(41)?;
    let (map, reference) = (on_gpu(&spec, Precision::F32, None)?, on_cpu(&spec)?);
    check(&map, &reference, 1e-5, 5e-4)?;
    let labels = Differences::new(&map, &reference).labels;
    if labels.is_empty() { Ok(()) } else { Err(format!("{} labels differ", labels.len()).into()) }
}

fn in_f64() -> Result<(), Failed> {
    let spec = paper_map_of(5)?;
    let mut twin = on_gpu(&spec, Precision::F64, None)?;
    let map = twin.clone();
    let instances: Vec<Instance> = (0..spec.grid.len()).map(|index| spec.instance(index)).collect();
    for (record, outcome) in twin.records.iter_mut().zip(outcomes::<f64>(&instances, &Plan::new(&spec))) {
        record.outcome = Some(Box::new(outcome));
    }
    check(&map, &twin, 1e-12, 1e-6)
}

/// The shipped map at another normal stiffness must not pass for itself.
fn planted() -> Result<(), Failed> {
    let spec = paper_map_of(5)?;
    let mut wrong = spec.clone();
    wrong.base.set(Param::K2, 1.02 * spec.base.require(Param::K2));
    let map = on_gpu(&wrong, Precision::F32, None)?;
    match verdict(&Differences::new(&map, &on_cpu(&spec)?), 5e-3, 2e-2) {
        Ok(()) => Err("the fault was not noticed".into()),
        Err(_) => Ok(()),
    }
}

/// Turns the belt of [`LAWS`] to a ramp that ends inside the measuring window.
const RAMP: &str = "[belt]\nbelt_velocity_end = 0.3\nramp_duration = 2.5\n";

/// Every law at 32 points.
const LAWS: &str = r#"
[friction]
stribeck_velocity = 2.0
decay = 0.2
knee_velocity = 4.0
[axes]
law = { values = ["constant", "bilinear", "exponential", "rational"] }
mu_s = { values = [0.3, 0.5] }
mu_d = { values = [0.1, 0.3] }
belt_velocity = { values = [0.8, 3.0] }
restitution = { values = [0.0, 0.4] }
[start]
start_velocity = 0.3
[response]
settle = "2 s"
measure = "2 s"
"#;

fn laws_and_ramp() -> Result<(), Failed> {
    for text in [LAWS.to_owned(), LAWS.to_owned() + RAMP] {
        let spec = spec(&text)?;
        check(&on_gpu(&spec, Precision::F32, None)?, &on_cpu(&spec)?, 1e-4, 5e-3)?;
    }
    Ok(())
}

/// A law that changes from leg to leg.
fn warms_up() -> Result<(), Failed> {
    let spec = spec(
        "[friction]\nmaterial = \"sweeps/pad.csv\"\ntemperature = 100\ntemperature_end = 500\n\
         [belt]\nramp_duration = 1.5\n\
         [axes]\nbelt_velocity = { values = [0.1, 0.5, 1, 2, 3, 4, 5] }\ntheta = { values = [0, 0.01, 0.3] }\n\
         [start]\nstart_velocity = 0.3\n[response]\nsettle = \"1 s\"\nmeasure = \"0.8 s\"\n",
    )?;
    check(&on_gpu(&spec, Precision::F32, None)?, &on_cpu(&spec)?, 1e-4, 5e-3)
}

/// Until settled, in chunks that leave few lanes to a window: the same endings, and windows of whole cycles.
fn until_settled() -> Result<(), Failed> {
    let spec = spec(
        "[axes]\nmu_s = { values = [0.1, 0.25, 0.45] }\nmu_d = { values = [0.02, 0.1, 0.4] }\n\
         belt_velocity = { values = [1, 3, 6] }\n\
         [start]\nstart_velocity = 0.3\n\
         [response]\nsettle = \"auto\"\nsettle_limit = \"200 periods\"\n",
    )?;
    let reference = on_cpu(&spec)?;
    for chunk in [None, Some(10)] {
        let map = on_gpu(&spec, Precision::F32, chunk)?;
        check(&map, &reference, 1e-4, 5e-3)?;
        let mut endings = std::collections::BTreeMap::new();
        for (found, expected) in map.records.iter().zip(&reference.records) {
            let (found, expected) = (
                found.outcome.as_deref().ok_or("an outcome")?,
                expected.outcome.as_deref().ok_or("an outcome")?,
            );
            assert_eq!(found.ending, expected.ending);
            let [a, b] = [found, expected].map(|one| one.settling_time.unwrap_or(f64::NAN));
            assert!((a / b - 1.0).abs() < 1e-3, "{a} {b}");
            let degrees = found.phase_cycle.unwrap_or(0.0) - expected.phase_cycle.unwrap_or(0.0);
            assert!(degrees.abs() < 0.5 || degrees.abs() > 359.5, "{degrees}");
            *endings.entry(format!("{:?}", found.ending)).or_insert(0) += 1;
        }
        println!("{endings:?}");
        assert_eq!(endings.len(), 3, "decays, settled and not");
    }
    Ok(())
}

fn slow_belts() -> Result<(), Failed> {
    // The motion scales with the velocity, the static loads do not: what an event may be off by must follow
    // the motion.
    let spec = spec(
        "[model]\ntheta = 0.0\n[friction]\nmu_s = 0.5\nmu_d = 0.3\nknee_velocity = 5.0\n\
         [axes]\nbelt_velocity = { values = [1e-3, 3e-3, 1e-2, 1e-1] }\n\
         [response]\nsettle = \"50 periods\"\nmeasure = \"20 periods\"\n",
    )?;
    check(&on_gpu(&spec, Precision::F32, None)?, &on_cpu(&spec)?, 1e-5, 2e-4)
}

/// Motions whose events lie where ẋ2 passes 0: each of these crossings counts once.
fn on_a_kink() -> Result<(), Failed> {
    let spec = spec(
        "[friction]\nknee_velocity = 5.0\n\
         [axes]\nmu_s = { from = 0.1, to = 0.5, points = 5 }\nmu_d = { from = 0.05, to = 0.25, points = 5 }\n\
         belt_velocity = { values = [5] }\n[start]\nstart_velocity = 0.3\n\
         [response]\nsettle = \"60 periods\"\nmeasure = \"40 periods\"\n",
    )?;
    let (map, reference) = (on_gpu(&spec, Precision::F32, None)?, on_cpu(&spec)?);
    let mut compared = 0;
    for (found, expected) in map.records.iter().zip(&reference.records) {
        let [found, expected] = [found, expected].map(|record| record.outcome.as_deref());
        let (found, expected) = found.zip(expected).ok_or("an outcome")?;
        let oscillates = expected.x2_std > Some(1e-6);
        let Some(expected) = expected.response_frequency.filter(|_| oscillates) else { continue };
        let found = found.response_frequency.ok_or("a frequency")?;
        compared += 1;
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} Hz instead of {expected} Hz");
    }
    println!("{compared} oscillate");
    if compared >= 10 { Ok(()) } else { Err("nothing was compared".into()) }
}

fn leaning_springs() -> Result<(), Failed> {
    // With θ < 0 the stick cone is left and entered again within rounding: none may chatter on the spot.
    let spec = spec(
        "[friction]\nknee_velocity = 3.0\n\
         [axes]\ntheta = { values = [-0.2, -0.05] }\nmu_s = { from = 0.3, to = 1.2, points = 7 }\n\
         mu_d = { values = [0.05, 0.1, 0.25] }\nbelt_velocity = { from = 0.1, to = 1, points = 6 }\n\
         [start]\nstart_velocity = 0.01\n\
         [response]\nsettle = \"100 periods\"\nmeasure = \"40 periods\"\n",
    )?;
    let reference = on_cpu(&spec)?;
    for precision in [Precision::F32, Precision::F64] {
        let map = on_gpu(&spec, precision, None)?;
        let failed = |map: &Map| map.records.iter().filter(|record| record.status != Status::Ok).count();
        assert_eq!((failed(&map), failed(&reference)), (0, 0), "{precision}");
        println!("{}", Differences::new(&map, &reference));
        // What has not settled is chaotic here: its detachments come and go with the last bits, between any two engines.
        let settled =
            |index: &usize| [&map, &reference].iter().all(|map| map.records[*index].settled == Some(true));
        let settled: Vec<usize> = (0..reference.records.len()).filter(settled).collect();
        let label = |map: &Map, index: usize| (map.records[index].kind, map.records[index].regime);
        let differ =
            settled.iter().filter(|index| label(&map, **index) != label(&reference, **index)).count();
        assert!(settled.len() > 100 && differ == 0, "{precision}: {differ} of {} differ", settled.len());
    }
    Ok(())
}

/// A table of `rows` rows, each longer one in a larger kernel, at `points` belt velocities.
fn table(rows: i32, points: usize) -> Result<(), Failed> {
    let directory = tempfile::tempdir()?;
    // The exponential law up to 6 m/s, so that a run passes many kinks.
    let row = |i: i32| {
        let v = 6.0 * f64::from(i) / f64::from(rows);
        format!("{v},{}\n", 0.2 + 0.3 * (-v / 2.0).exp())
    };
    let text = "velocity,mu\n".to_owned() + &(0..rows).map(row).collect::<String>();
    std::fs::write(directory.path().join("mu.csv"), text)?;
    std::fs::write(
        directory.path().join("sweep.toml"),
        format!(
            "[friction]\nlaw = \"table\"\ntable = \"mu.csv\"\n\
             [axes]\nbelt_velocity = {{ from = 0.2, to = 5.5, points = {points} }}\n\
             [response]\nsettle = \"3 s\"\nmeasure = \"2 s\"\n"
        ),
    )?;
    let mut spec = Spec::read(&directory.path().join("sweep.toml"))?;
    spec.analysis.checked = false;
    let reference = on_cpu(&spec)?;
    let steps: u64 =
        reference.records.iter().filter_map(|one| one.outcome.as_ref()).map(|one| one.steps).sum();
    println!("{steps} steps of the reference, an event ends one");
    check(&on_gpu(&spec, Precision::F32, None)?, &reference, 1e-4, 2e-3)
}

/// A material of a short and a longer table: at its temperatures and between them the laws need kernels of several sizes.
fn tables() -> Result<(), Failed> {
    let directory = tempfile::tempdir()?;
    let row = |i: i32| {
        let v = 6.0 * f64::from(i) / 20.0;
        format!("300,{v},{}\n", 0.2 + 0.3 * (-v / 2.0).exp())
    };
    let cold = "temperature,velocity,mu\n100,0,0.3\n100,2.1,0.35\n100,4,0.2\n".to_owned();
    std::fs::write(directory.path().join("pad.csv"), cold + &(0..20).map(row).collect::<String>())?;
    std::fs::write(
        directory.path().join("sweep.toml"),
        "[friction]\nlaw = \"table\"\nmaterial = \"pad.csv\"\n[axes]\n\
         temperature = { values = [100, 160, 220, 300] }\nbelt_velocity = { from = 0.2, to = 5.5, points = 8 }\n\
         [response]\nsettle = \"3 s\"\nmeasure = \"2 s\"\n",
    )?;
    let mut spec = Spec::read(&directory.path().join("sweep.toml"))?;
    spec.analysis.checked = false;
    let reference = on_cpu(&spec)?;
    check(&on_gpu(&spec, Precision::F32, None)?, &reference, 1e-4, 2e-3)
}

fn any_chunk() -> Result<(), Failed> {
    let spec = spec(&LAWS.replace("2 s", "0.2 s"))?;
    let whole = on_gpu(&spec, Precision::F32, None)?;
    for chunk in [None, Some(1), Some(37)] {
        if on_gpu(&spec, Precision::F32, chunk)?.records != whole.records {
            return Err(format!("chunks of {chunk:?} differ").into());
        }
    }
    Ok(())
}

fn cancelled() -> Result<(), Failed> {
    let mut spec = paper_map_of(4)?;
    (spec.settle, spec.measure) = (Duration::Periods(10.0), Duration::Periods(10.0));
    spec.settle_limit = None;
    let whole = on_gpu(&spec, Precision::F32, None)?;
    let cancel = AtomicBool::new(false);
    // A few at a time, so that there are several rounds.
    let options =
        Options { backend: Backend::Gpu, chunk: Some(10), cancel: Some(&cancel), ..Options::default() };
    let map = run::run(spec, &options, &|_| cancel.store(true, Ordering::Relaxed))?;
    let computed = map.computed();
    println!("{computed} of {} instances were finished", map.records.len());
    assert_eq!(map.stopped, Some(Stopped::Cancelled));
    assert!(0 < computed && computed < map.records.len());
    for (found, expected) in map.records.iter().zip(&whole.records) {
        assert!(*found == Record::NOT_COMPUTED || found == expected);
    }
    Ok(())
}

/// Every instance that was told as done is kept, as it is; the chunks are those that a software adapter takes by itself,
/// elsewhere they are asked for.
fn keeps_told() -> Result<(), Failed> {
    const MANY: usize = 12;
    let chunk = software_chunk();
    let software = Adapter::best(Precision::F32, None)?.may_be_software();
    let spec = spec(&format!(
        "[friction]\nmu_d = 0.3\nmu_s = 0.4\n[axes]\n\
         belt_velocity = {{ from = 1, to = 3, points = {} }}\n\
         [response]\nsettle = \"1 periods\"\nmeasure = \"1 periods\"\n",
        MANY * chunk
    ))?;
    let whole = on_gpu(&spec, Precision::F32, None)?;
    assert_eq!(whole.computed(), MANY * chunk);
    let (cancel, done) = (AtomicBool::new(false), AtomicUsize::new(0));
    let options = Options {
        backend: Backend::Gpu,
        chunk: (!software).then_some(chunk),
        cancel: Some(&cancel),
        ..Options::default()
    };
    let map = run::run(spec, &options, &|count| {
        if done.fetch_add(count, Ordering::Relaxed) + count > chunk {
            cancel.store(true, Ordering::Relaxed);
        }
    })?;
    println!("{} of {} instances were finished, chunks of {chunk}", map.computed(), MANY * chunk);
    assert_eq!(map.stopped, Some(Stopped::Cancelled));
    assert_eq!(map.computed(), done.into_inner());
    assert!(chunk < map.computed() && map.computed() < MANY * chunk);
    for (found, expected) in map.records.iter().zip(&whole.records) {
        assert!(*found == Record::NOT_COMPUTED || found == expected);
    }
    Ok(())
}

/// An engine on so many devices that are opened for it.
fn devices(count: usize) -> Result<Vec<Device>, Failed> {
    let adapter = Adapter::best(Precision::F32, None)?;
    Ok((0..count).map(|_| Device::open(&adapter, Precision::F32)).collect::<Result<_, _>>()?)
}

/// The records of a sweep on some devices; `seen` gets the number of those that are newly done.
fn records_on(
    spec: &Spec,
    devices: Vec<Device>,
    chunk: usize,
    seen: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Record>, Failed> {
    let never = AtomicBool::new(false);
    let computed = Gpu::new(devices, Some(chunk)).records(spec, 0..spec.grid.len(), &never, seen)?;
    if let Some(why) = computed.stopped {
        return Err(why.to_string().into());
    }
    Ok(computed.records)
}

/// The sweep of [`LAWS`] of one law, which few kernels compute, in a tenth of the time.
fn one_law() -> Result<Spec, Failed> {
    spec(
        &LAWS
            .replace("2 s", "0.2 s")
            .replace("\"constant\", \"bilinear\", \"exponential\", \"rational\"", "\"bilinear\"")
            .replace("stribeck_velocity = 2.0\ndecay = 0.2\n", ""),
    )
}

fn several_devices() -> Result<(), Failed> {
    let spec = one_law()?;
    let whole = on_gpu(&spec, Precision::F32, None)?;
    for (count, chunk) in [(2, 3), (3, 1)] {
        let devices = devices(count)?;
        let found = records_on(&spec, devices.clone(), chunk, &|_| {})?;
        assert!(devices.iter().all(|device| device.metered().steps > 0), "a device did nothing");
        assert!(found == whole.records, "{count} devices differ from one");
    }
    Ok(())
}

/// Lost when a part of the instances is done, with two more rounds under way: the others go on where they were.
fn lost() -> Result<(), Failed> {
    let spec = one_law()?;
    let whole = on_gpu(&spec, Precision::F32, None)?;
    for count in [1, 2] {
        let devices = devices(count)?;
        let (first, done) = (devices[0].clone(), AtomicUsize::new(0));
        let found = records_on(&spec, devices, 3, &|count| {
            if done.fetch_add(count, Ordering::Relaxed) + count > 5 {
                first.destroy();
            }
        })?;
        assert!(done.into_inner() == whole.records.len() && found == whole.records, "{count} devices");
    }
    Ok(())
}

fn dead() -> Result<(), Failed> {
    let spec = spec(
        "[friction]\nlaw = \"constant\"\n[belt]\nbelt_velocity = 1.0\n[model]\ntheta = -0.9\n\
         [axes]\nmu_s = { values = [0.1, 0.3, 0.9, 3.0] }\nmu_d = { values = [0.1, 0.5, 0.9, 3.0] }\n\
         [response]\nsettle = \"5 periods\"\nmeasure = \"5 periods\"\n",
    )?;
    let (gpu, cpu) = (on_gpu(&spec, Precision::F32, Some(5))?, on_cpu(&spec)?);
    let statuses = |map: &Map| map.records.iter().map(|record| record.status).collect::<Vec<_>>();
    let found = statuses(&gpu);
    println!("{found:?}");
    assert_eq!(found, statuses(&cpu));
    for status in [Status::Ok, Status::InvalidLaw, Status::NoEquilibrium] {
        assert!(found.contains(&status), "{status:?} does not occur");
    }
    Ok(())
}

fn two_million_steps() -> Result<(), Failed> {
    // At 12 steps per period.
    let spec = spec(
        "[friction]\nmu_d = 0.3\nknee_velocity = 5.0\n[belt]\nbelt_velocity = 3.0\n[axes]\nmu_s = { values = [0.2, 0.5] }\n\
         [response]\nsettle = \"166600 periods\"\nmeasure = \"100 periods\"\n",
    )?;
    let map = on_gpu(&spec, Precision::F32, None)?;
    for (index, record) in map.records.iter().enumerate() {
        let outcome = record.outcome.as_deref().ok_or("no outcome")?;
        let scene =
            squealmap::engine::scene::Scene::new(&spec.instance(index), spec.start).map_err(Status::name)?;
        let asked = scene.scaled(spec.settle) + scene.scaled(spec.measure);
        let asked = asked * scene.units.time;
        println!(
            "{} s of {asked} s in {} steps: {:?}",
            outcome.simulated_time, outcome.steps, outcome.status
        );
        if outcome.status != Status::Ok || outcome.steps < 2_000_000 {
            return Err("not to the end".into());
        }
        if (outcome.simulated_time - asked).abs() > 1e-9 * asked {
            return Err(format!("{} s instead of {asked} s", outcome.simulated_time).into());
        }
    }
    Ok(())
}
