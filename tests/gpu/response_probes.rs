//! Single functions of the response kernel on the GPU against their twins, through probe entry points.

use crate::Case;
use crate::instances::Uniform;
use crate::response::plan;
use crate::strict::instance;
use crate::words::{device, drive};
use libtest_mimic::Failed;
use squealmap::engine::gpu::arithmetic::Arithmetic;
use squealmap::engine::gpu::kernel::Compiled;
use squealmap::engine::gpu::run::run;
use squealmap::engine::kernel::crossing::{deflated, first_crossing, lower_bound};
use squealmap::engine::kernel::lane::Lane;
use squealmap::engine::kernel::observe::{maximum, rotate};
use squealmap::engine::kernel::response::{choices, kernel, words};
use squealmap::engine::kernel::scene::{Scene as Words, exp_m1};
use squealmap::engine::kernel::segments::segments;
use squealmap::engine::kernel::series::{
    Body, Expansion, FREE, REVERSE, SLIP, STICK, evaluate, expand, step_length, value,
};
use squealmap::engine::kernel::source::Kernel;
use squealmap::engine::kernel::steps::ORDER;
use squealmap::engine::precision::Precision;
use squealmap::engine::scene::Scene;
use squealmap::model::piece::LawForm;

/// Instances of a probe, of each form of law.
const COUNT: usize = 4000;

const PIECES: usize = 2;
const KERNEL: Kernel = kernel::<PIECES>();

pub(crate) const CASES: &[Case] = &[
    ("probes::friction", || probe(FRICTION, friction)),
    ("probes::exp_m1", || probe("put(exp_m1(probed * real(20.0)));", |_, x, _| vec![exp_m1(x * 20.0)])),
    ("probes::expand_slip", || probe(&expansion(SLIP), |scene, _, body| series(scene, body, SLIP))),
    ("probes::expand_reverse", || probe(&expansion(REVERSE), |scene, _, body| series(scene, body, REVERSE))),
    ("probes::expand_stick", || probe(&expansion(STICK), |scene, _, body| series(scene, body, STICK))),
    ("probes::expand_free", || probe(&expansion(FREE), |scene, _, body| series(scene, body, FREE))),
    ("probes::step_length", || {
        probe(&(slip() + "put(step_length(real(2.0), real(1e-4)));"), |scene, _, body| {
            vec![step_length(&expanded(scene, body, SLIP), 2.0, 1e-4)]
        })
    }),
    ("probes::evaluate", || {
        probe(
            &(slip()
                + "let x = evaluate(&sx, probed); put(x.p); put(x.v); put(x.a); put(value(&sn, probed));"),
            |scene, x, body| {
                let e = expanded(scene, body, SLIP);
                let mut all = evaluate(&e.x, x).to_vec();
                all.push(value(&e.n, x));
                all
            },
        )
    }),
    ("probes::crossing", || probe(&(slip() + CROSSING), crossing)),
    ("probes::maximum", || {
        let call = "put(maximum(array<real, 5>(probed, probed * probed, real(0.3), real(0.5) - probed, real(0.1))));";
        probe(call, |_, x, _| vec![maximum(&[x, x * x, 0.3, 0.5 - x, 0.1])])
    }),
    ("probes::a_wrong_twin_is_noticed", || {
        let call = "let z = rotate(vec2<real>(real(0.6), real(0.8)), probed); put(z.x); put(z.y);";
        match probe(call, |_, x, _| rotate([0.6, 0.801], x).to_vec()) {
            Ok(()) => Err("the fault was not noticed".into()),
            Err(_) => Ok(()),
        }
    }),
    ("probes::rotate", || {
        let call = "let z = rotate(vec2<real>(real(0.6), real(0.8)), probed); put(z.x); put(z.y);";
        probe(call, |_, x, _| rotate([0.6, 0.8], x).to_vec())
    }),
];

const FRICTION: &str = "let f = friction(piece_of(0u), real(1.0), scene.v0 * probed, scene.v0 - scene.v0 * probed); \
    let b = friction(piece_of(1u), real(-1.0), -(scene.v0 * probed), scene.v0 + scene.v0 * probed); \
    put(f.q); put(f.less); put(b.q); put(b.less); put(mu(scene.v0 * probed)); put(real(piece_at(scene.v0 * probed)));";

fn friction(scene: &Words<f32>, x: f32, _: &Body<f32>) -> Vec<f32> {
    let v = scene.v0 * x;
    let forward = scene.friction(&scene.pieces[0], 1.0, v, scene.v0 - v);
    let backward = scene.friction(&scene.pieces[1], -1.0, -v, scene.v0 + v);
    #[expect(clippy::cast_precision_loss, reason = "0 or 1")]
    let piece = scene.piece_at(v) as f32;
    vec![forward.0, forward.1, backward.0, backward.1, scene.mu(v), piece]
}

/// Expands from the start on a contact state.
fn expansion(contact: u32) -> String {
    format!(
        "expand(lane.body, {contact}u, piece_of(0u), belt.velocity, belt.acceleration);\n\
         for (var k = 0u; k < SERIES; k++) {{ put(sx[k]); put(sy[k]); put(sw[k]); put(sn[k]); put(sv[k]); }}\n\
         if {contact}u <= REVERSE {{ for (var k = 0u; k < SERIES; k++) {{ put(st[k]); }} }}\n"
    )
}

fn slip() -> String {
    "expand(lane.body, SLIP, piece_of(0u), belt.velocity, belt.acceleration);\n".to_owned()
}

fn expanded(scene: &Words<f32>, body: &Body<f32>, contact: u32) -> Expansion<f32> {
    let belt = scene.segments[0];
    expand(scene, body, contact, &scene.pieces[0], belt.velocity, belt.acceleration)
}

fn series(scene: &Words<f32>, body: &Body<f32>, contact: u32) -> Vec<f32> {
    let e = expanded(scene, body, contact);
    let mut all: Vec<f32> = (0..=ORDER).flat_map(|k| [e.x[k], e.y[k], e.w[k], e.n[k], e.v[k]]).collect();
    if contact <= REVERSE {
        all.extend(e.t);
    }
    all
}

/// Where `ẋ2` less a part of its start falls to zero.
const CROSSING: &str = "for (var k = 0u; k < ORDER; k++) { sg[k] = sv[k]; } \
    sg[ORDER] = real(0.0); sg[0] = sv[0] * probed; \
    put(first_crossing(ORDER - 1u, real(0.5), false, real(0.0), real(1e-6))); \
    sb = sg; put(lower_bound(ORDER - 1u)); let d = deflated(ORDER - 1u, 1u, probed); put(d.x); put(d.y);";

fn crossing(scene: &Words<f32>, x: f32, body: &Body<f32>) -> Vec<f32> {
    let mut g = expanded(scene, body, SLIP).v;
    g[ORDER] = 0.0;
    g[0] *= x;
    let [value, slope] = deflated(&g, ORDER - 1, 1, x);
    vec![first_crossing(&g, ORDER - 1, 0.5, false, 0.0, 1e-6), lower_bound(&g, ORDER - 1), value, slope]
}

/// Runs `call` on random instances of every law and compares what it puts with the twin: bit by bit where the
/// device is strict and software, else to 1e-4 of the largest. `probed` is a number in (0, 1).
fn probe(call: &str, twin: fn(&Words<f32>, f32, &Body<f32>) -> Vec<f32>) -> Result<(), Failed> {
    let main = format!(
        "var<private> next: u32;\nfn put(value: real) {{ store(next, instance, value); next += 1u; }}\n\
         @compute @workgroup_size(WORKGROUP_SIZE)\nfn main(@builtin(global_invocation_id) id: vec3<u32>) {{\n\
         instance = id.x;\nif instance >= settings.count {{ return; }}\nread_scene();\nstart_lane();\n\
         next = 0u;\nlet belt = segment_of(0u);\nlet probed = (real(instance) + real(0.5)) / real(settings.count);\n\
         {call}\nfinish(instance, STATUS_OK);\n}}\n"
    );
    let strict = device(Arithmetic { precision: Precision::F32, strict: true });
    let exact = strict.as_ref().is_ok_and(squealmap::engine::gpu::device::Device::is_software);
    let device = if exact { strict? } else { device(Precision::F32)? };
    let mut files = KERNEL.files.to_vec();
    files.pop();
    files.push(("probe", main.as_str()));
    for law in LawForm::ALL {
        let packed = instances(law);
        #[expect(clippy::cast_possible_truncation, reason = "the narrowing of the host")]
        let inputs: Vec<f32> =
            (0..packed[0].len()).flat_map(|word| packed.iter().map(move |one| one[word] as f32)).collect();
        let source = KERNEL.source_with(Precision::F32, &choices(law, true), &files);
        let compiled = Compiled::from_source(&device, &KERNEL, &source)?;
        let result = run(&device, &compiled, &inputs, &drive())?;
        let mut worst = 0.0_f32;
        for (i, words) in packed.iter().enumerate() {
            let scene = Words::read(law, PIECES, words);
            #[expect(clippy::cast_precision_loss, reason = "small numbers")]
            let x = (i as f32 + 0.5) / COUNT as f32;
            let expected = twin(&scene, x, &Lane::new(&scene).state.body);
            let size = expected.iter().fold(0.0_f32, |size, value| size.max(value.abs()));
            for (k, expected) in expected.into_iter().enumerate() {
                let actual = result.state[k * COUNT + i];
                let error = (actual - expected).abs() / size;
                let same = actual.to_bits() == expected.to_bits();
                if !same && (exact || error.is_nan() || error > 1e-4) {
                    return Err(format!("{law:?} {i} word {k}: {actual:e} instead of {expected:e}").into());
                }
                worst = if same { worst } else { worst.max(error) };
            }
        }
        println!("{law:?}: {}, worst {worst:.1e}", if exact { "bit by bit" } else { "not strict" });
    }
    Ok(())
}

/// The words of random instances of a form of law.
fn instances(law: LawForm) -> Vec<Vec<f64>> {
    let plan = plan(1.0, 1.0);
    let mut u = Uniform(23);
    std::iter::repeat_with(|| instance(&mut u, law))
        .inspect(|one| assert_eq!(one.law.kind().form(), law))
        .filter_map(|one| Scene::new(&one, plan.start).ok())
        .map(|scene| words(&scene, &segments(&scene, &plan), PIECES))
        .take(COUNT)
        .collect()
}
