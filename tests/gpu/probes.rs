//! Single functions of the kernel on the GPU against their twins, through probe entry points.

use crate::Case;
use crate::words::{device, drive, inputs};
use libtest_mimic::Failed;
use squealmap::engine::gpu::kernel::Compiled;
use squealmap::engine::gpu::run::run;
use squealmap::engine::kernel::linear::{KERNEL, Quartic, factors, quadratic, rightmost, split};
use squealmap::engine::kernel::places::place;
use squealmap::engine::kernel::words::{INPUT_WORDS, STATE_WORDS};
use squealmap::engine::precision::Precision;

/// Instances of a probe.
const COUNT: usize = 20_000;

pub(crate) const CASES: &[Case] = &[
    ("probes::split", || probe("store(0u, i, split(q));", 1e-5, |q| vec![split(q)])),
    ("probes::factors", || {
        let call = "let f = factors(q); store(0u, i, f.p1); store(1u, i, f.q1); store(2u, i, f.t1); \
                    store(3u, i, f.p2); store(4u, i, f.q2); store(5u, i, f.t2);";
        probe(call, 2e-4, |q| {
            let f = factors(q);
            vec![f.p1, f.q1, f.t1, f.p2, f.q2, f.t2]
        })
    }),
    ("probes::quadratic", || {
        let call =
            "let f = quadratic(q.p, real(1.0) + abs(q.g), abs(q.g)); store(0u, i, f.re); store(1u, i, f.im);";
        probe(call, 2e-4, |q| {
            let f = quadratic(q.p, 1.0 + q.g.abs(), q.g.abs());
            vec![f.re, f.im]
        })
    }),
    ("probes::rightmost", || {
        let call = "let f = rightmost(q); store(0u, i, f.re); store(1u, i, f.im);";
        probe(call, 2e-4, |q| {
            let f = rightmost(q);
            vec![f.re, f.im]
        })
    }),
];

/// Runs `call` on the polynomial `q` of every instance `i` and compares what it stores with the twin.
fn probe(call: &str, tolerance: f32, twin: fn(Quartic<f32>) -> Vec<f32>) -> Result<(), Failed> {
    let main = format!(
        "@compute @workgroup_size(WORKGROUP_SIZE)\nfn main(@builtin(global_invocation_id) id: vec3<u32>) {{\n\
         let i = id.x;\nif i >= settings.count {{ return; }}\nlet q = polynomial(INPUT_FULL, i);\n{call}\n\
         finish(i, STATUS_OK);\n}}\n"
    );
    let device = device(Precision::F32)?;
    let files = [KERNEL.files[0], ("probe", main.as_str())];
    let compiled = Compiled::from_source(&device, &KERNEL, &KERNEL.source_with(Precision::F32, &[], &files))?;
    let inputs = inputs::<f32>(COUNT);
    let result = run(&device, &compiled, (&inputs, COUNT), &drive())?;
    let (mut worst, mut differing) = (0.0_f32, 0);
    for i in 0..COUNT {
        let word = |word: usize| inputs[place([word, INPUT_WORDS], i)];
        let quartic = Quartic { p: word(0), g: word(1), k: word(2), e: word(3) };
        for (k, expected) in twin(quartic).into_iter().enumerate() {
            let actual = result.state[place([k, STATE_WORDS], i)];
            differing += usize::from(actual.to_bits() != expected.to_bits());
            let difference = (actual - expected).abs() / expected.abs().max(1.0);
            if difference.is_nan() || difference > tolerance {
                return Err(format!("{quartic:?} word {k}: {actual:e} instead of {expected:e}").into());
            }
            worst = worst.max(difference);
        }
    }
    println!("worst {worst:.1e}, {differing} words differ");
    Ok(())
}
