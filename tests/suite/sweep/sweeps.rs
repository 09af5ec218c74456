//! Every shipped sweep runs and shows what its comments say; the large ones thinned.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;

use squealmap::engine::options::Options;
use squealmap::model::Param;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::kind::InstabilityType;
use squealmap::model::status::Status;
use squealmap::sweep::grid::{Axis, Grid, Value};
use squealmap::sweep::map::Map;
use squealmap::sweep::run;
use squealmap::sweep::spec::Spec;

fn read(name: &str) -> Spec {
    let sweeps = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/sweeps"));
    Spec::read(&sweeps.join(name).with_extension("toml")).unwrap()
}

/// First, middle and last value of every axis.
fn thin(mut spec: Spec) -> Spec {
    if let Grid::Axes(axes) = &mut spec.grid {
        for Axis { values, .. } in axes {
            let mut keep = vec![0, values.len() / 2, values.len() - 1];
            keep.dedup();
            *values = keep.into_iter().map(|index| values[index].clone()).collect();
        }
    }
    spec
}

/// Runs a sweep; every record is computed, complete and `ok`.
fn run(spec: Spec) -> Map {
    let map = run::run(spec, &Options::default(), &|_| {}).unwrap();
    assert_eq!(map.records.len(), map.spec.grid.len());
    for (index, record) in map.records.iter().enumerate() {
        assert_eq!(record.status, Status::Ok, "instance {index}");
        assert_eq!(record.kind.is_some(), map.spec.analysis.linear, "instance {index}");
        assert_eq!(record.regime.is_some(), map.spec.analysis.response, "instance {index}");
    }
    map
}

#[test]
fn paper_map_runs() {
    let map = run(thin(read("paper_map")));
    assert_eq!(map.records.len(), 27);
}

#[test]
fn refined_map_runs_and_asks_to_be_refined() {
    let spec = read("refined_map");
    assert_eq!(spec.grid.len(), 1025 * 1025 * 3);
    assert_eq!(spec.refine.map(|settings| (settings.coarse, settings.sample)), Some((32, 1000)));
    assert_eq!(run(thin(spec)).records.len(), 27);
}

#[test]
fn figure2_modes_merge_at_the_critical_friction() {
    let map = run(read("paper/figure2"));
    for (index, record) in map.records.iter().enumerate() {
        let mu = map.spec.instance(index).params.require(Param::MuD);
        let expected = if mu < 0.226_361 { InstabilityType::Stable } else { InstabilityType::ModeCoupling };
        assert_eq!(record.kind, Some(expected), "mu_d = {mu}");
    }
}

#[test]
fn mass_on_belt_runs() {
    run(thin(read("mass_on_belt")));
}

#[test]
fn mass_on_belt_is_unstable_where_the_slope_beats_the_damping() {
    let mut spec = read("mass_on_belt");
    spec.analysis.response = false;
    let map = run(spec);
    let mut unstable = 0;
    for (index, record) in map.records.iter().enumerate() {
        let instance = map.spec.instance(index);
        let FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity } = instance.law else {
            panic!("the sweep has an exponential law")
        };
        // V = v0 ln((mu_s − mu_d) N/(c v0))
        let force = instance.params.require(Param::FExt);
        let damping = instance.params.require(Param::C1);
        let critical = stribeck_velocity * ((mu_s - mu_d) * force / (damping * stribeck_velocity)).ln();
        let velocity = instance.params.require(Param::BeltVelocity);
        let expected =
            if velocity < critical { InstabilityType::NegativeSlope } else { InstabilityType::Stable };
        assert_eq!(record.kind, Some(expected), "c1 = {damping}, V = {velocity}");
        unstable += usize::from(velocity < critical);
    }
    assert!(unstable > map.records.len() / 5 && unstable < map.records.len() / 5 * 4, "{unstable}");
}

#[test]
fn bistable_band_lies_above_the_limit_of_linear_stability() {
    let mut spec = read("bistable_band");
    if let Grid::Axes(axes) = &mut spec.grid {
        // c = 0.1 N s/m: the band is known in closed form, and below it the growth is slow for one value.
        axes[0].values.retain(|value| matches!(value, Value::Number(c) if (c - 0.1).abs() < 1e-9));
        assert_eq!(axes[0].values.len(), 1);
    }
    let map = run(spec);
    for (index, record) in map.records.iter().enumerate() {
        let velocity = map.spec.instance(index).params.require(Param::BeltVelocity);
        if !(1.12..1.152).contains(&velocity) {
            assert_eq!(record.bistable, Some((1.152..1.8366).contains(&velocity)), "V = {velocity}");
        }
    }
}

#[test]
fn basin_counts_every_start() {
    let map = run(thin(read("basin")));
    let slide: Vec<u32> = map.records.iter().map(|one| one.basin().unwrap().equilibrium).collect();
    // V = 1, 1.5 and 2 m/s: none, some and all of the 200 starts.
    assert!(slide[0] == 0 && (40..90).contains(&slide[1]) && slide[2] == 200, "{slide:?}");
}

#[test]
fn hysteresis_runs() {
    run(read("hysteresis"));
}

#[test]
fn cycle_map_finds_the_cycles_that_settled_map_waits_for() {
    let (found, waited) = (run(thin(read("cycle_map"))), run(thin(read("settled_map"))));
    let mut count = 0;
    for (index, (found, waited)) in found.records.iter().zip(&waited.records).enumerate() {
        assert_eq!((found.kind, found.regime), (waited.kind, waited.regime), "instance {index}");
        let [found, waited] = [found, waited].map(|record| record.outcome.as_ref().unwrap());
        if found.floquet.is_some() {
            count += 1;
            let [found, waited] = [found, waited].map(|outcome| outcome.x2_std.unwrap());
            assert!((found - waited).abs() < 0.01 * waited, "instance {index}: {found} and {waited}");
        }
    }
    // All that is not stable.
    assert!(count >= 20, "{count}");
}

#[test]
fn temperature_map_runs_from_stable_to_unstable() {
    let map = run(thin(read("temperature_map")));
    for (index, record) in map.records.iter().enumerate() {
        let temperature = map.spec.instance(index).params.require(Param::Temperature);
        if temperature <= 100.0 {
            assert_eq!(record.kind, Some(InstabilityType::Stable), "instance {index}");
        } else if temperature >= 500.0 {
            assert_ne!(record.kind, Some(InstabilityType::Stable), "instance {index}");
        }
    }
}

#[test]
fn tuples_are_the_cases_of_the_paper() {
    use InstabilityType::{Coexistence, ModeCoupling, NegativeSlope, Stable};
    let map = run(read("tuples"));
    let kinds: Vec<_> = map.records.iter().map(|record| record.kind.unwrap()).collect();
    let expected = [
        Stable,
        NegativeSlope,
        NegativeSlope,
        ModeCoupling,
        Coexistence,
        NegativeSlope,
        ModeCoupling,
        ModeCoupling,
    ];
    assert_eq!(kinds, expected);
}
