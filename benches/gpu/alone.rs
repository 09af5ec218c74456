//! What the host does for each instance, without a device beside it: instances are begun, put into words, and their records are made of
//! what a device has made of these words once. One thread, on the map of `cargo bench --bench map`, with all columns.

use std::error::Error;
use std::time::Instant;

use squealmap::engine::gpu::adapter::Adapter;
use squealmap::engine::gpu::device::Device;
use squealmap::engine::gpu::kernel::Compiled;
use squealmap::engine::gpu::run::advance;
use squealmap::engine::instances::Instances;
use squealmap::engine::kernel::places::{TOGETHER, room};
use squealmap::engine::march::asked::{Asked, Tally};
use squealmap::engine::march::flow::Flow;
use squealmap::engine::march::marching::PARTS;
use squealmap::engine::march::round::Round;
use squealmap::engine::march::table::{SETTING_FRESH, flag, state};
use squealmap::engine::precision::Precision;
use squealmap::engine::record::Record;

use crate::host::spec;

/// Instances where none are asked for: their places are larger than a cache.
const SIZE: usize = 40_000;

/// How often all are gone through; the fastest counts.
const TIMES: usize = 9;

/// Steps of a dispatch, more than a run of two periods has.
const STEPS: u32 = 256;

/// Measures and prints; of `arguments` the first is the number of instances.
pub(crate) fn run(arguments: &[&str]) -> Result<(), Box<dyn Error>> {
    let size = arguments.first().map_or(Ok(SIZE), |text| text.parse())?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    pool.install(|| measure(size).map_err(|why| why.to_string())).map_err(Into::into)
}

fn measure(size: usize) -> Result<(), Box<dyn Error>> {
    let spec = spec(size, "[response]\nsettle = \"1 periods\"\nmeasure = \"1 periods\"\n")?;
    let count = spec.grid.len();
    let mut made: Option<(Vec<f32>, Vec<u32>)> = None;
    let (mut free, mut best, mut sent) = (Vec::new(), [f64::INFINITY; 3], Vec::new());
    for time in 0..=TIMES {
        let (tally, mut records) = (Tally::default(), vec![Record::default(); count]);
        let asked = Asked::new(&spec, [0, count], &mut records, &tally);
        let (mut flow, mut lanes, mut round) = (Flow::new(&spec, free), Vec::new(), Round::new(false));
        let began = Instant::now();
        flow.turn_over(&asked, &mut lanes, count);
        let begun = Instant::now();
        round.place(&mut lanes);
        let [.., end] = round.begins_sent();
        sent.resize(end, 0_u8);
        round.send(&lanes, |at, part| sent[at..at + part.len()].copy_from_slice(part));
        let staged = Instant::now();
        let (state, flags) = match made.take() {
            Some(made) => made,
            None => by_device(&spec, &flow, (&round, bytemuck::cast_slice(&sent)))?,
        };
        let back = Instant::now();
        let (_, ended) = round.collect(&mut lanes, (&state, &flags), &flow, &asked);
        let taken = [begun - began, staged - begun, back.elapsed()];
        ended?;
        if !asked.is_done() {
            return Err("an instance is not at its end after one round".into());
        }
        // The first time finds memory that the system has still to give.
        made = Some((state, flags));
        if time > 0 {
            best = std::array::from_fn(|k| best[k].min(taken[k].as_secs_f64()));
        }
        flow.turn_over(&asked, &mut lanes, count);
        free = flow.into_places();
    }
    let each = best.map(|seconds| seconds / count as f64 * 1e6);
    println!("| instances | begun, µs each | put into words | records made | all |\n|---|---|---|---|---|");
    println!(
        "| {count} | {:.2} | {:.2} | {:.2} | {:.2} |",
        each[0],
        each[1],
        each[2],
        each.iter().sum::<f64>()
    );
    Ok(())
}

/// What a device makes of a round of lanes that have not begun, of which only inputs are sent: state and flags.
fn by_device(
    spec: &dyn Instances,
    flow: &Flow<f32>,
    (round, sent): (&Round<f32>, &[f32]),
) -> Result<(Vec<f32>, Vec<u32>), Box<dyn Error>> {
    let device = Device::open(&Adapter::best(Precision::F32, None)?, Precision::F32)?;
    let [_, all_words, all_flags] = round.words();
    let (mut words, mut flags) = (vec![0.0; all_words], vec![0; all_flags]);
    let dispatches = 2 * spec.plan().steps_per_period;
    for group in &round.groups {
        let places = room(group.lanes);
        let mut made = (vec![0.0; state::WORDS * places], vec![0; flag::WORDS * places]);
        let mut settings = flow.settings();
        settings[SETTING_FRESH] = 1;
        for part in PARTS {
            let (kernel, choices) = group.form.kernel(part).ok_or("there is no kernel")?;
            let compiled = Compiled::new(&device, kernel, &choices)?;
            let inputs = (&sent[group.sent[0]..][..group.words_sent()[0]], group.lanes);
            let came = advance(&device, &compiled, inputs, &made, (settings, [dispatches, STEPS]))?;
            (made, settings[SETTING_FRESH]) = ((came.state, came.flags), 0);
        }
        let [_, of_group, _] = group.words();
        let kept = words[group.first[1]..][..of_group].chunks_exact_mut(of_group / places * TOGETHER);
        for (kept, block) in kept.zip(made.0.chunks_exact(state::WORDS * TOGETHER)) {
            kept.copy_from_slice(&block[..kept.len()]);
        }
        flags[group.first[2]..][..made.1.len()].copy_from_slice(&made.1);
    }
    Ok((words, flags))
}
