//! What the host takes from a kernel of the march, and what it does not: planted faults in the words of finished lanes.

use crate::common::{bilinear, paper, plan};
use crate::engine::kernel_response::scenes;
use crate::twin::{begin, lane, outcomes_seen, program, run, run_leg, settings};
use squealmap::engine::kernel::places::Column;
use squealmap::engine::lanes::job::Part;
use squealmap::engine::march::marching::{Marching, Way};
use squealmap::engine::march::table::{SETTING_FRESH, flag, state};
use squealmap::engine::outcome::Outcome;
use squealmap::engine::precision::Precision;
use squealmap::model::Param;
use squealmap::model::status::Status;
use squealmap_lockstep::Count;

/// A fault in the words of state and flags.
type Fault = fn(&mut [f32], &mut [u32]);

/// An instance with its next leg done by the twin, and the words of that; `None` at its end.
fn went(one: &mut Marching<f32>, way: &Way) -> Option<(Vec<f32>, Vec<u32>)> {
    let (form, words) = begin(one, way)?;
    Some(lane(&run_leg::<f32, 1>(form, &[words], settings(way), |_| {}), 0))
}

/// Whether an instance takes these words as those of its leg.
fn taken(one: &Marching<f32>, (words, flags): &(Vec<f32>, Vec<u32>)) -> Option<()> {
    one.clone().take(Column::of_row(words), Column::of_row(flags))
}

/// An instance with its first leg done.
fn begun(way: &Way) -> (Marching<f32>, (Vec<f32>, Vec<u32>)) {
    let mut instance = paper(0.1, 0.1, 3.0);
    instance.params.set(Param::StartVelocity, 0.1);
    let mut one = Marching::new(0, &instance, way).expect("an equilibrium");
    let words = went(&mut one, way).expect("a leg");
    (one, words)
}

#[test]
fn words_that_are_no_finished_leg_are_refused() {
    let way = Way::new::<f32>(plan(1.0, 1.0, 12));
    let (one, right) = begun(&way);
    assert!(taken(&one, &right).is_some());
    for code in [0, Status::NotComputed as u32, 77] {
        let mut wrong = right.clone();
        wrong.1[flag::STATUS] = code;
        assert!(taken(&one, &wrong).is_none(), "status {code}");
    }
    let blank = (vec![0.0; state::WORDS], vec![0; flag::WORDS]);
    assert!(taken(&one, &blank).is_none(), "an unwritten lane");
    let faults: [Fault; 4] = [
        |state, _| state[state::LEFT] = 0.5,
        |_, flags| flags[flag::WHOLE + 2] = 1,
        |_, flags| flags[flag::STRETCH] -= 1,
        |_, flags| flags[flag::STRETCH] += 1,
    ];
    for fault in faults {
        let mut wrong = right.clone();
        fault(&mut wrong.0, &mut wrong.1);
        assert!(taken(&one, &wrong).is_none(), "it says that it came to its end and did not");
    }
}

/// A sum that is no number makes no result.
#[test]
fn a_sum_that_is_no_number_is_told() {
    let way = Way::new::<f32>(plan(1.0, 1.0, 12));
    let end = |fault: Option<f32>| -> Outcome {
        let (mut one, mut words) = begun(&way);
        if let Some(fault) = fault {
            words.0[state::SEEN + 2] = fault;
        }
        one.take(Column::of_row(&words.0), Column::of_row(&words.1)).expect("a finished leg");
        assert!(went(&mut one, &way).is_none(), "one leg is the whole run");
        one.job.outcome(&way.plan)
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
    assert!(chunks.len() >= 3);
    for chunk in chunks {
        let (kernel, program) = program(chunk.form, chunk.part, Precision::F32);
        let (alone, counts) = run::<f32, 1>(
            &program,
            kernel,
            (&chunk.inputs, chunk.lanes),
            Some(&chunk.before),
            settings(&way),
        );
        let count: Count = counts.into_iter().sum();
        let bits = |words: &[f32]| words.iter().map(|word| word.to_bits()).collect::<Vec<u32>>();
        assert_eq!((bits(&alone.state), &alone.flags), (bits(&chunk.result.state), &chunk.result.flags));
        assert_eq!((count.issued, count.useful), (chunk.count().useful, chunk.count().useful));
        if chunk.begun() > 1 {
            assert!(chunk.count().issued < count.issued && 64 * chunk.count().issued > count.issued);
        }
    }
}

/// What a leg begins from stands in its inputs: whatever was in the other buffers before, it begins there.
#[test]
fn a_leg_that_has_not_begun_needs_its_inputs_alone() {
    let plan = plan(0.1, 0.1, 12);
    let mut fresh = settings(&Way::new::<f32>(plan));
    fresh[SETTING_FRESH] = 1;
    let mut legs = 0;
    outcomes_seen::<f32, 64>(&scenes(bilinear), &plan, |chunk| {
        if chunk.part != Part::Growth {
            return;
        }
        let (kernel, program) = program(chunk.form, chunk.part, Precision::F32);
        let (mut state, mut flags) = (chunk.result.state.clone(), chunk.result.flags.clone());
        state.fill(7.0);
        flags.fill(7);
        let inputs = (&chunk.inputs[..], chunk.lanes);
        let (made, _) = run::<f32, 64>(&program, kernel, inputs, Some(&(state, flags)), fresh);
        for index in 0..chunk.lanes {
            assert_eq!(lane(&made, index), lane(&chunk.result, index));
            legs += 1;
        }
    });
    assert!(legs >= 100, "{legs}");
}
