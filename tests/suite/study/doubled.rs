//! Cycles whose period is doubled, and where they begin and end.

use crate::study::hysteresis::{follow, is, parse};
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
