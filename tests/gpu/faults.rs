//! Planted faults: every comparer and check has to notice.

use crate::Case;
use crate::words::{compare, device, drive, inputs, on_cpu};
use libtest_mimic::Failed;
use squealmap::engine::error::Error;
use squealmap::engine::gpu::kernel::Compiled;
use squealmap::engine::gpu::run::{ChunkResult, Drive, run};
use squealmap::engine::kernel::linear::KERNEL;
use squealmap::engine::kernel::places::{TOGETHER, place};
use squealmap::engine::kernel::words::{FLAG_WORDS, STATE_WORDS};
use squealmap::engine::precision::Precision;

/// Instances of a fault.
const COUNT: usize = 500;

pub(crate) const CASES: &[Case] = &[
    ("faults::one_wrong_value", || caught(|result| result.state[place([0, STATE_WORDS], 77)] += 0.01)),
    ("faults::one_nan", || caught(|result| result.state[1234] = f32::NAN)),
    ("faults::one_wrong_type", || caught(|result| result.flags[place([2, FLAG_WORDS], 5)] ^= 1)),
    ("faults::a_short_state", || caught(|result| result.state.truncate(COUNT))),
    ("faults::short_flags", || caught(|result| result.flags.truncate(COUNT))),
    ("faults::all_zero", || {
        caught(|result| {
            result.state.fill(0.0);
            result.flags.fill(0);
        })
    }),
    ("faults::swapped_words", || {
        caught(|result| {
            let (first, second) = result.state.split_at_mut(TOGETHER);
            first.swap_with_slice(&mut second[..TOGETHER]);
        })
    }),
    ("faults::a_kernel_that_stops_early", stops_early),
    ("faults::a_kernel_that_lies", lies),
    ("faults::short_inputs", short_inputs),
    ("faults::a_kernel_that_does_not_compile", does_not_compile),
    ("faults::cancelled", cancelled),
];

/// A fault in an otherwise right result must be noticed, and the right result accepted.
fn caught(fault: fn(&mut ChunkResult<f32>)) -> Result<(), Failed> {
    let right = on_cpu(&inputs::<f32>(COUNT), COUNT);
    compare(&right, &right, COUNT, 0.0, 0)?;
    let mut wrong = right.clone();
    fault(&mut wrong);
    match compare(&wrong, &right, COUNT, 1e-3, 0) {
        Ok(_) => Err("the fault was not noticed".into()),
        Err(_) => Ok(()),
    }
}

/// Runs the kernel with another entry point.
fn with_main(body: &str) -> Result<squealmap::engine::error::Result<ChunkResult<f32>>, Failed> {
    let main = format!(
        "@compute @workgroup_size(WORKGROUP_SIZE)\nfn main(@builtin(global_invocation_id) id: vec3<u32>) {{\n\
         let i = id.x;\nif i >= settings.count {{ return; }}\n{body}\n}}\n"
    );
    let device = device(Precision::F32)?;
    let files = [KERNEL.files[0], ("fault", main.as_str())];
    let source = KERNEL.source_with(Precision::F32, &[], &files);
    let compiled = Compiled::from_source(&device, &KERNEL, &source)?;
    Ok(run(&device, &compiled, (&inputs::<f32>(COUNT), COUNT), &drive()))
}

fn stops_early() -> Result<(), Failed> {
    match with_main("if i < 300u && flag(FLAG_STATUS, i) == STATUS_UNWRITTEN { analyse(i); }")? {
        Err(Error::Endless { finished: 300, count: COUNT, .. }) => Ok(()),
        other => Err(format!("{:?}", other.map(|_| "a result")).into()),
    }
}

fn lies() -> Result<(), Failed> {
    match with_main("if i == 7u { atomicAdd(&progress[0], 1u); } else { analyse(i); }")? {
        Err(Error::Unwritten { instance: 7 }) => Ok(()),
        other => Err(format!("{:?}", other.map(|_| "a result")).into()),
    }
}

fn short_inputs() -> Result<(), Failed> {
    let device = device(Precision::F32)?;
    let compiled = Compiled::new(&device, &KERNEL, &[])?;
    match run(&device, &compiled, (&[1.0_f32; 7], 1), &drive()) {
        Err(Error::ShortBuffer { name: "inputs", found: 7, .. }) => Ok(()),
        other => Err(format!("{:?}", other.map(|_| "a result")).into()),
    }
}

fn does_not_compile() -> Result<(), Failed> {
    match with_main("let x: u32 = 1.5;") {
        Err(why) if why.message().is_some_and(|text| text.contains("compiling the linear kernel")) => Ok(()),
        other => Err(format!("{:?}", other.map(|_| "compiled")).into()),
    }
}

fn cancelled() -> Result<(), Failed> {
    let device = device(Precision::F32)?;
    let compiled = Compiled::new(&device, &KERNEL, &[])?;
    let stop = std::sync::atomic::AtomicBool::new(true);
    match run(&device, &compiled, (&inputs::<f32>(COUNT), COUNT), &Drive { cancel: &stop, ..drive() }) {
        Err(Error::Cancelled { done: 0, total: COUNT }) => Ok(()),
        other => Err(format!("{:?}", other.map(|_| "a result")).into()),
    }
}
