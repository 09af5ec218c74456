//! What the host takes from a kernel of the march, and what it does not: planted faults in the words of finished lanes.

use crate::common::{bilinear, paper, plan};
use crate::engine::kernel_response::scenes;
use crate::twin::{columns, lane, outcomes_seen, program, run, settings};
use squealmap::engine::march::marching::{Marching, Way};
use squealmap::engine::march::table::{flag, state};
use squealmap::engine::outcome::Outcome;
use squealmap::engine::precision::Precision;
use squealmap::model::Param;
use squealmap::model::status::Status;

/// An instance with its first stretch done by the twin, and the words of that.
fn begun(way: &Way) -> (Marching<f32>, (Vec<f32>, Vec<u32>)) {
    let mut instance = paper(0.1, 0.1, 3.0);
    instance.params.set(Param::StartVelocity, 0.1);
    let mut one = Marching::new(0, &instance, way).expect("an equilibrium");
    let (form, words) = one.next(way).expect("a stretch");
    let (kernel, program) = program(form, Precision::F32);
    let (inputs, before) = columns(&[words]);
    let (result, _) = run::<f32, 1>(&program, kernel, &inputs, Some(&before), settings(way));
    (one, lane(&result, 0))
}

#[test]
fn words_that_are_no_finished_stretch_are_refused() {
    let way = Way::new::<f32>(plan(1.0, 1.0, 12));
    let (one, right) = begun(&way);
    assert!(one.clone().take(&right.0, &right.1).is_some());
    for code in [0, Status::NotComputed as u32, 77] {
        let mut wrong = right.clone();
        wrong.1[flag::STATUS] = code;
        assert!(one.clone().take(&wrong.0, &wrong.1).is_none(), "status {code}");
    }
    let blank = (vec![0.0; state::WORDS], vec![0; flag::WORDS]);
    assert!(one.clone().take(&blank.0, &blank.1).is_none(), "an unwritten lane");
    let mut early = right;
    early.0[state::LEFT] = 0.5;
    assert!(one.clone().take(&early.0, &early.1).is_none(), "it says that it came to its end and did not");
    // Up to the first event alone a stretch may end before.
    early.1[flag::EVENTFUL] = 1;
    assert!(one.clone().take(&early.0, &early.1).is_some());
}

/// A sum that is no number makes no result.
#[test]
fn a_sum_that_is_no_number_is_told() {
    let way = Way::new::<f32>(plan(1.0, 1.0, 12));
    let end = |fault: Option<f32>| -> Outcome {
        let (mut one, mut words) = begun(&way);
        loop {
            one.take(&words.0, &words.1).expect("a finished stretch");
            let Some((form, next)) = one.next(&way) else { return one.job.outcome(&way.plan) };
            let (kernel, program) = program(form, Precision::F32);
            let (inputs, before) = columns(&[next]);
            words = lane(&run::<f32, 1>(&program, kernel, &inputs, Some(&before), settings(&way)).0, 0);
            if let Some(fault) = fault {
                words.0[state::WINDOW + 2] = fault;
            }
        }
    };
    assert_eq!(end(None).status, Status::Ok);
    for fault in [f32::NAN, f32::INFINITY] {
        assert_eq!(end(Some(fault)).status, Status::NonFinite);
    }
}

/// Beside others or alone, the same bits; a warp of one lane is always full.
#[test]
fn lanes_know_nothing_of_each_other() {
    let plan = plan(0.1, 0.1, 12);
    let way = Way::new::<f32>(plan);
    let mut chunks = Vec::new();
    outcomes_seen::<f32, 64>(&scenes(bilinear), &plan, |chunk| chunks.push(chunk));
    assert!(chunks.len() > 3);
    for chunk in chunks {
        let (kernel, program) = program(chunk.form, Precision::F32);
        let (alone, count) =
            run::<f32, 1>(&program, kernel, &chunk.inputs, Some(&chunk.before), settings(&way));
        let bits = |words: &[f32]| words.iter().map(|word| word.to_bits()).collect::<Vec<u32>>();
        assert_eq!((bits(&alone.state), &alone.flags), (bits(&chunk.result.state), &chunk.result.flags));
        assert_eq!((count.issued, count.useful), (chunk.count.useful, chunk.count.useful));
        assert!(chunk.count.issued < count.issued && 64 * chunk.count.issued > count.issued);
    }
}
