//! The kernels of the march on a device: close to their twin whatever the device rounds, and caught where they lie.

use crate::Case;
use crate::twin::{Chunk, lane, outcomes_seen, settings};
use crate::words::device;
use libtest_mimic::Failed;
use squealmap::engine::gpu::device::Device;
use squealmap::engine::gpu::kernel::Compiled;
use squealmap::engine::gpu::run::{ChunkResult, advance, most_steps};
use squealmap::engine::kernel::places::{Column, place};
use squealmap::engine::kernel::source::SETTING_WORDS;
use squealmap::engine::lanes::Lanes;
use squealmap::engine::lanes::job::Part;
use squealmap::engine::march::marching::{Marching, Way};
use squealmap::engine::march::table::{flag, state};
use squealmap::engine::method::Method;
use squealmap::engine::method::taylor::REFERENCE_ORDER;
use squealmap::engine::plan::{Duration, Plan, STEP_TOLERANCE, StartKind};
use squealmap::engine::precision::Precision;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::motion::Motion;
use squealmap::model::status::Status;
use squealmap::model::{Param, Params};

pub(crate) const CASES: &[Case] = &[
    ("response::f32_is_close_to_its_twin", close),
    ("response::a_kernel_that_stops_early_is_noticed", stops_early),
    ("response::any_number_of_steps_per_dispatch_gives_the_same_bits", any_dispatch),
];

/// Friction coefficients 0 to 0.6 at four velocities.
fn instances() -> Vec<Instance> {
    let velocities = [0.5, 1.0, 3.0, 6.0];
    let instance = |velocity: f64, k: i32| {
        let mut params = Params::default();
        params.set(Param::BeltVelocity, velocity);
        params.set(Param::StartVelocity, 0.3 * velocity);
        let (mu_s, mu_d) = (0.15 * f64::from(k / 5), 0.15 * f64::from(k % 5));
        let law = FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: 5.0 };
        Instance { params, law, impact_friction: true, motion: Motion::Ramp, heating: None, modal: None }
    };
    velocities.iter().flat_map(|velocity| (0..25).map(|k| instance(*velocity, k))).collect()
}

pub(crate) fn plan(settle: f64, measure: f64) -> Plan {
    Plan {
        start: StartKind::Kick,
        settle: Duration::Periods(settle),
        settle_limit: None,
        hunts: false,
        measure: Duration::Periods(measure),
        steps_per_period: 12,
        method: Method::Taylor,
        order: REFERENCE_ORDER,
        tolerance: STEP_TOLERANCE,
    }
}

/// The parts of the legs of all instances, by the twin.
fn chunks(plan: &Plan) -> Vec<Chunk<f32>> {
    let mut chunks = Vec::new();
    outcomes_seen::<f32, 64>(&instances(), plan, |chunk| chunks.push(chunk));
    chunks
}

/// What a device makes of a chunk in dispatches of so many steps: as many as its twin has needed.
pub(crate) fn on_device<R: Lanes>(
    device: &Device,
    compiled: &Compiled,
    chunk: &Chunk<R>,
    inputs: &[R],
    (settings, steps): ([u32; SETTING_WORDS], u32),
) -> Result<ChunkResult<R>, Failed> {
    let steps = steps.min(most_steps(device, &compiled.kernel));
    let gone = |flags: &[u32], lane: usize| flags[place([flag::STEPS, flag::WORDS], lane)];
    let most =
        (0..chunk.lanes).map(|lane| gone(&chunk.result.flags, lane) - gone(&chunk.before.1, lane)).max();
    // A step that is too long is gone anew; of every other step there is one.
    let dispatches = 2 * most.unwrap_or(0) / steps + 2;
    Ok(advance(device, compiled, (inputs, chunk.lanes), &chunk.before, (settings, [dispatches, steps]))?)
}

/// What a device makes of a chunk, by the kernel's text with something in it replaced.
fn on_gpu(
    chunk: &Chunk<f32>,
    plan: &Plan,
    steps: Option<u32>,
    [from, to]: [&str; 2],
) -> Result<ChunkResult<f32>, Failed> {
    let device = device(Precision::F32)?;
    let (kernel, choices) = chunk.form.kernel(chunk.part).ok_or("no kernel")?;
    let text = kernel.source(Precision::F32, &choices);
    assert!(text.contains(from));
    let compiled = Compiled::from_source(&device, kernel, &text.replace(from, to))?;
    let settings = settings(&Way::new::<f32>(*plan));
    on_device(&device, &compiled, chunk, &chunk.inputs, (settings, steps.unwrap_or(u32::MAX)))
}

fn close() -> Result<(), Failed> {
    let plan = plan(2.0, 2.0);
    let (mut worst, mut count) = (0.0_f64, 0);
    for chunk in chunks(&plan).into_iter().filter(|chunk| chunk.part == Part::Window) {
        let found = on_gpu(&chunk, &plan, None, ["", ""])?;
        count += chunk.lanes;
        for index in 0..chunk.lanes {
            let ((found, _), (expected, flags)) = (lane(&found, index), lane(&chunk.result, index));
            if flags[flag::STATUS] != Status::Ok as u32 {
                return Err(format!("status {}", flags[flag::STATUS]).into());
            }
            let body = state::BODY..state::BODY + 6;
            let size =
                expected[body.clone()].iter().fold(0.0_f64, |size, value| size.max(f64::from(value.abs())));
            for (a, b) in found[body.clone()].iter().zip(&expected[body]) {
                let error = f64::from((a - b).abs()) / size;
                worst = if error.is_finite() { worst.max(error) } else { f64::INFINITY };
            }
        }
    }
    println!("{count} legs; worst difference of a body {worst:.1e}");
    if worst < 1e-3 && count >= 100 { Ok(()) } else { Err(format!("worst difference {worst:e}").into()) }
}

fn any_dispatch() -> Result<(), Failed> {
    let plan = plan(3.0, 3.0);
    for chunk in chunks(&plan) {
        let bits = |steps| -> Result<Vec<u32>, Failed> {
            let found = on_gpu(&chunk, &plan, steps, ["", ""])?;
            Ok(found.state.into_iter().map(f32::to_bits).chain(found.flags).collect())
        };
        let whole = bits(None)?;
        if bits(Some(7))? != whole || bits(Some(32))? != whole {
            return Err("the bits depend on the steps of a dispatch".into());
        }
    }
    Ok(())
}

/// A kernel that calls every lane finished after three steps.
fn stops_early() -> Result<(), Failed> {
    let plan = plan(2.0, 2.0);
    let way = Way::new::<f32>(plan);
    for chunk in chunks(&plan).iter().filter(|chunk| chunk.part == Part::Window).take(2) {
        let early =
            ["        steps += 1u;\n", "        steps += 1u; if steps > 3u { status = STATUS_OK; }\n"];
        let found = on_gpu(chunk, &plan, None, early)?;
        let right = on_gpu(chunk, &plan, None, ["", ""])?;
        let mut one = Marching::<f32>::new(0, &instances()[0], &way).map_err(Status::name)?;
        one.next(&way).ok_or("no leg")?;
        let (words, flags) = lane(&right, 0);
        assert!(one.clone().take(Column::of_row(&words), Column::of_row(&flags)).is_some());
        let (words, flags) = lane(&found, 0);
        assert!(
            one.take(Column::of_row(&words), Column::of_row(&flags)).is_none(),
            "a leg that did not come to its end was taken"
        );
    }
    Ok(())
}
