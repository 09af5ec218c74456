//! Ranges of a sweep one after the other, with instances of the next ones on their way meanwhile.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use crate::Case;
use libtest_mimic::Failed;
use squealmap::engine::Engine;
use squealmap::engine::computation::Stopped;
use squealmap::engine::gpu::adapter::Adapter;
use squealmap::engine::gpu::device::Device;
use squealmap::engine::gpu::records::Gpu;
use squealmap::engine::precision::Precision;
use squealmap::engine::record::Record;
use squealmap::sweep::spec::Spec;

pub(crate) const CASES: &[Case] = &[
    ("ahead::ranges_have_the_records_of_the_whole_and_lanes_are_busier", ranges),
    ("ahead::a_device_that_is_lost_between_two_ranges_loses_nothing", lost),
    ("ahead::what_is_begun_of_one_sweep_is_not_another_s", another),
    ("ahead::a_run_that_is_cancelled_keeps_what_is_finished", cancelled),
];

/// Instances of a range, and of one of its buffers.
const RANGE: usize = 24;
const CHUNK: usize = 8;

/// Runs until settled, some of which take far longer than others.
fn spec(knee: f64) -> Result<Spec, Failed> {
    let text = format!(
        "[friction]\nknee_velocity = {knee:?}\n[belt]\nbelt_velocity = 3.0\n[axes]\n\
         mu_s = {{ from = 0.05, to = 0.6, points = 12 }}\nmu_d = {{ from = 0.05, to = 0.6, points = 10 }}\n\
         [response]\nsettle = \"auto\"\nsettle_limit = \"300 periods\"\nsteps_per_period = 4\n"
    );
    Ok(Spec::parse(&text, "sweep.toml", ".".as_ref())?)
}

fn device() -> Result<Device, Failed> {
    Ok(Device::open(&Adapter::best(Precision::F32, None)?, Precision::F32)?)
}

static NEVER: AtomicBool = AtomicBool::new(false);

/// The records of a range with so many instances ahead.
fn part(gpu: &mut Gpu, spec: &Spec, range: Range<usize>, ahead: usize) -> Result<Vec<Record>, Failed> {
    let (wanted, told) = (range.len(), AtomicUsize::new(0));
    let tell = |count| {
        told.fetch_add(count, Ordering::Relaxed);
    };
    let made = gpu.records_ahead(spec, range, ahead, &NEVER, &tell)?;
    if made.stopped.is_some() || told.into_inner() != wanted || made.records.len() != wanted {
        return Err("a range was not told to its end".into());
    }
    Ok(made.records)
}

/// The records of all ranges, and the share of its lanes that a device has held.
fn all(spec: &Spec, ahead: usize) -> Result<(Vec<Record>, f64), Failed> {
    let device = device()?;
    let mut gpu = Gpu::new(vec![device.clone()], Some(CHUNK));
    let (mut records, count) = (Vec::new(), spec.grid.len());
    for first in (0..count).step_by(RANGE) {
        let range = first..(first + RANGE).min(count);
        let ahead = ahead.min(count - range.end);
        records.extend(part(&mut gpu, spec, range, ahead)?);
    }
    let metered = device.metered();
    Ok((records, metered.lanes as f64 / metered.room as f64))
}

/// All at once.
fn whole(spec: &Spec) -> Result<Vec<Record>, Failed> {
    part(&mut Gpu::new(vec![device()?], None), spec, 0..spec.grid.len(), 0)
}

fn ranges() -> Result<(), Failed> {
    let spec = spec(5.0)?;
    let whole = whole(&spec)?;
    let (one_by_one, alone) = all(&spec, 0)?;
    let (with_next, beside) = all(&spec, 2 * RANGE)?;
    println!("{:.0} % of the lanes held, {:.0} % ahead", 100.0 * alone, 100.0 * beside);
    assert!(one_by_one == whole && with_next == whole, "ranges differ from the whole");
    assert!(1.0 - beside < 0.7 * (1.0 - alone), "as many lanes are empty");
    Ok(())
}

fn lost() -> Result<(), Failed> {
    let (spec, device) = (spec(5.0)?, device()?);
    let mut gpu = Gpu::new(vec![device.clone()], Some(CHUNK));
    let mut found = part(&mut gpu, &spec, 0..RANGE, 2 * RANGE)?;
    device.destroy();
    found.extend(part(&mut gpu, &spec, RANGE..spec.grid.len(), 0)?);
    assert!(found == whole(&spec)?, "they differ");
    Ok(())
}

/// The next call is about another sweep, about other instances, or about fewer than were begun.
fn another() -> Result<(), Failed> {
    let (first, second) = (spec(5.0)?, spec(4.0)?);
    let (of_first, of_second) = (whole(&first)?, whole(&second)?);
    let mut gpu = Gpu::new(vec![device()?], Some(CHUNK));
    for (then, whole, range) in [
        (&second, &of_second, RANGE..2 * RANGE),
        (&first, &of_first, 2 * RANGE..3 * RANGE),
        (&first, &of_first, 0..RANGE),
        (&first, &of_first, RANGE..RANGE + 7),
    ] {
        assert!(part(&mut gpu, &first, 0..RANGE, 2 * RANGE)? == of_first[..RANGE]);
        assert!(part(&mut gpu, then, range.clone(), 0)? == whole[range.clone()], "{range:?}");
    }
    // What is left of those that were begun.
    let rest = RANGE + 7..first.grid.len();
    assert!(part(&mut gpu, &first, rest.clone(), 0)? == of_first[rest], "the rest");
    Ok(())
}

fn cancelled() -> Result<(), Failed> {
    let spec = spec(5.0)?;
    let whole = whole(&spec)?;
    let mut gpu = Gpu::new(vec![device()?], Some(CHUNK));
    part(&mut gpu, &spec, 0..RANGE, 2 * RANGE)?;
    let (cancel, all) = (AtomicBool::new(false), RANGE..spec.grid.len());
    let stop = |_| cancel.store(true, Ordering::Relaxed);
    let made = gpu.records_ahead(&spec, all.clone(), 0, &cancel, &stop)?;
    let computed = made.records.iter().filter(|record| **record != Record::NOT_COMPUTED).count();
    println!("{computed} of {} instances were finished", all.len());
    assert_eq!((made.stopped, made.records.len()), (Some(Stopped::Cancelled), all.len()));
    assert!(0 < computed && computed < all.len());
    for (found, expected) in made.records.iter().zip(&whole[all.clone()]) {
        assert!(*found == Record::NOT_COMPUTED || found == expected);
    }
    assert!(part(&mut gpu, &spec, all.clone(), 0)? == whole[all], "after that");
    Ok(())
}
