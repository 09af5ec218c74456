//! Cycles whose period is doubled, and where they begin and end.

use crate::engines::Engine;
use crate::study::hysteresis::{follow, is, parse};
use squealmap::engine::instances::Instances;
use squealmap::engine::outcome::Ending;
use squealmap::model::Param;
use squealmap::study::cycles::branch::BranchPoint;
use squealmap::study::cycles::special::Special;

/// The band of belt velocities in which the period of the paper's model is doubled (`μ_s` = 0.5, `μ_d` = 0.3): the branch of one return
/// is unstable there, and that of two begins and ends on it. The upper end is that of `benches/peers/doubling.py`.
#[test]
fn a_doubled_period_begins_and_ends_at_period_doublings() {
    let spec = parse(
        "[friction]\nmu_s = 0.5\nmu_d = 0.3\n[response]\nsettle = \"cycle\"\n[axes]\nbelt_velocity = { values = [3] }\n",
    );
    let found = follow(&spec, Param::BeltVelocity, [0.15, 0.5], 8);
    let doublings = |branch: &[BranchPoint]| {
        let special = |point: &BranchPoint| point.special.map(|special| (special, point.value));
        branch.iter().filter_map(special).collect::<Vec<_>>()
    };
    let branches: Vec<_> =
        found.cycles.iter().map(|branch| (doublings(&branch.points), &branch.points)).collect();
    let [(once, single), (twice, double)] = &branches[..] else { panic!("{} branches", branches.len()) };
    for ends in [once, twice] {
        let [lower, upper] = ends[..] else { panic!("{ends:?}") };
        assert!(is(upper, Special::Doubling, 0.409_154_600), "{upper:?}");
        assert!(is(lower, Special::Doubling, 0.214_228_568), "{lower:?}");
    }
    let returns = |points: &[BranchPoint], count| {
        points.iter().all(|point| {
            point.record.outcome.as_ref().and_then(|outcome| outcome.cycle_returns) == Some(count)
        })
    };
    assert!(returns(single, 1) && returns(double, 2));
    let inside = |point: &&BranchPoint| (0.215..0.409).contains(&point.value);
    assert!(single.iter().filter(inside).all(|point| point.unstable == 1));
    assert!(double.iter().filter(inside).count() > 5 && double.iter().all(|point| point.unstable == 0));
}

/// Next to those ends a motion turns about the unstable cycle for hundreds of periods. Windows agree there, on values up to 30 % off
/// those of a run of 4000 periods.
#[test]
fn a_run_that_leaves_an_unstable_cycle_has_not_settled() {
    let sweep = |response: &str| {
        parse(&format!(
            "[friction]\nmu_s = 0.5\nmu_d = 0.3\n[start]\nkind = \"mode\"\n[response]\n{response}\n[axes]\nbelt_velocity = {{ values = [0.225, 0.25, 0.275, 0.3, 0.375, 0.4, 0.45] }}\n",
        ))
    };
    let (looked, waited) =
        (sweep("settle = \"cycle\""), sweep("settle = \"4000 periods\"\nmeasure = \"60 periods\""));
    let mut open = Vec::new();
    for index in 0..looked.grid.len() {
        let long = Engine::CpuF64.run(&waited.instance(index), &waited.plan());
        for engine in [Engine::Reference, Engine::CpuF64, Engine::CpuF32] {
            let found = engine.run(&looked.instance(index), &looked.plan());
            let off = found.x2_std.expect("an oscillation") / long.x2_std.expect("an oscillation") - 1.0;
            if found.ending == Some(Ending::Limit) {
                open.push((engine.name(), index));
            } else {
                assert!(off.abs() < 0.02, "{} of {index}: {off:+.3}, {found:?}", engine.name());
            }
        }
    }
    assert!(open.len() < 12, "{open:?}");
}
