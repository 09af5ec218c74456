//! Several starts of one instance: bistable bands in closed form, a basin of the literature, the same for every engine and cut.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use crate::common::close;
use crate::synthetic::record;
use squealmap::engine::backend::Backend;
use squealmap::engine::computation::Stopped;
use squealmap::engine::error::Error;
use squealmap::engine::options::Options;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::precision::Precision;
use squealmap::engine::record::{Attractor, Basin, Record, differ};
use squealmap::engine::regime::Regime;
use squealmap::model::kind::InstabilityType;
use squealmap::model::status::Status;
use squealmap::sweep::solver::Solver;
use squealmap::sweep::spec::Spec;

/// The single mass on a belt with m = k = N = 1.
pub(crate) const SINGLE: &str =
    "[model]\nm1 = 0.9\nm2 = 0.1\nk1 = 1\nk2 = 1\nc2 = 0.1\nf_ext = 1\ntheta = 0\n";

/// Where the stick-slip cycle of [`exponential`] ends, by an independent integration (physics.md, section 6).
const CYCLE_ENDS: f64 = 1.836_600_97;

pub(crate) fn parse(text: &str) -> Spec {
    Spec::parse(text, "s.toml", ".".as_ref()).unwrap()
}

/// `μ_s = 1`, `μ_d = 0.5`, `v0 = 0.5`, `c = 0.1`.
fn exponential(velocities: &str, rest: &str) -> Spec {
    parse(&format!(
        "{SINGLE}c1 = 0.1\n[friction]\nlaw = \"exponential\"\nmu_s = 1\nmu_d = 0.5\nstribeck_velocity = 0.5\n\
         [axes]\nbelt_velocity = {{ values = [{velocities}] }}\n{rest}"
    ))
}

fn engines() -> [Options<'static>; 3] {
    let options = |backend, precision| Options { backend, precision, ..Options::default() };
    [
        options(Backend::Reference, None),
        options(Backend::Cpu, Some(Precision::F64)),
        options(Backend::Cpu, Some(Precision::F32)),
    ]
}

fn run(spec: &Spec, options: &Options) -> Vec<Record> {
    let computed = Solver::new(spec, options).unwrap().records(0..spec.grid.len(), &|_| {}).unwrap();
    assert_eq!(computed.stopped, None);
    computed.records
}

/// The verdicts of a sweep over velocities, from the two ends of its bistable band; an error names the first that is another.
fn band(records: &[Record], velocities: &[f64], [from, to]: [f64; 2]) -> Result<(), String> {
    for (record, velocity) in records.iter().zip(velocities) {
        let expected = (from..to).contains(velocity);
        if record.bistable != Some(expected) {
            return Err(format!("V = {velocity}: {:?} instead of {expected}", record.bistable));
        }
        let small = if *velocity < from { Attractor::Oscillation } else { Attractor::Equilibrium };
        let large = if *velocity < to { Attractor::Oscillation } else { Attractor::Equilibrium };
        let ends = [Some(record), record.large()].map(|one| Attractor::of(one.unwrap(), record.kind));
        if ends != [Some(small), Some(large)] {
            return Err(format!("V = {velocity}: ends {ends:?} instead of {small:?} and {large:?}"));
        }
    }
    Ok(())
}

/// The equilibrium is stable above `V = v0 ln((μ_s − μ_d) N/(c v0))`, the cycle lives below [`CYCLE_ENDS`].
#[test]
fn the_band_of_the_exponential_law_on_every_engine() {
    let hopf = 0.5 * (0.5_f64 / (0.1 * 0.5)).ln();
    let velocities = [0.7, 1.0, 1.1, 1.16, 1.3, 1.5, 1.7, 1.83, 1.845, 2.0, 3.0];
    let text = velocities.map(|velocity| velocity.to_string()).join(", ");
    for settle in ["auto", "150 periods"] {
        let spec =
            exponential(&text, &format!("[start]\nkind = \"both\"\n[response]\nsettle = \"{settle}\"\n"));
        for options in engines() {
            let records = run(&spec, &options);
            assert_eq!(band(&records, &velocities, [hopf, CYCLE_ENDS]), Ok(()), "settle {settle}");
            // The comparer sees another band.
            band(&records, &velocities, [hopf, 1.6]).unwrap_err();
        }
        // And a large start that is small.
        let fault = exponential(
            &text,
            &format!("[start]\nkind = \"both\"\nlarge_velocity = 0.01\n[response]\nsettle = \"{settle}\"\n"),
        );
        band(&run(&fault, &engines()[1]), &velocities, [hopf, CYCLE_ENDS]).unwrap_err();
    }
}

/// Law `constant` with `μ_s > μ_d`: the equilibrium is stable at every V, and the cycle exists as long as the slip that
/// begins at release comes back to the velocity of the belt. From the release (`ẋ = V`, `ẍ = −ΔF/m`) the velocity is
/// `w = e^{−ζωt} (V cos ω_d t + B sin ω_d t)`, `B = (ζωV − ΔF/m)/ω_d`, in polar form `R e^{−ζωt} cos(ω_d t + φ)`; its next
/// maximum lies at the phase 2π − asin ζ.
pub(crate) fn highest_velocity_of_the_cycle(damping: f64, difference: f64) -> f64 {
    let (zeta, omega) = (0.5 * damping, 1.0);
    let damped = omega * (1.0 - zeta * zeta).sqrt();
    let returns = |velocity: f64| {
        let b = (zeta * omega * velocity - difference) / damped;
        let (radius, phase) = (velocity.hypot(b), (-b).atan2(velocity));
        let time = (std::f64::consts::TAU - zeta.asin() - phase) / damped;
        radius * (-zeta * omega * time).exp() * (1.0 - zeta * zeta).sqrt() >= velocity
    };
    let (mut low, mut high) = (1e-3, 10.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if returns(middle) { low = middle } else { high = middle }
    }
    low
}

#[test]
fn the_band_of_a_jump_of_friction_is_its_closed_form() {
    for (damping, difference) in [(0.05, 0.15), (0.1, 0.3)] {
        let end = highest_velocity_of_the_cycle(damping, difference);
        let velocities = [0.2 * end, 0.9 * end, 0.99 * end, 1.01 * end, 1.5 * end];
        let text = velocities.map(|velocity| velocity.to_string()).join(", ");
        let spec = parse(&format!(
            "{SINGLE}c1 = {damping}\n[friction]\nlaw = \"constant\"\nmu_s = {}\nmu_d = 0.25\n\
             [axes]\nbelt_velocity = {{ values = [{text}] }}\n[start]\nkind = \"both\"\nstart_velocity = 0.001\n\
             [response]\nsettle = \"auto\"\n",
            0.25 + difference
        ));
        for options in engines() {
            let records = run(&spec, &options);
            assert_eq!(band(&records, &velocities, [0.0, end]), Ok(()), "c = {damping}");
            band(&records, &velocities, [0.0, 0.95 * end]).unwrap_err();
        }
    }
}

/// A box sweep of the bSTAB case, of which a share 0.3071 slides (physics.md, section 6); its box is absolute, and the
/// equilibrium stands at μ(V) N/k.
fn basin(velocity_to: f64, samples: u32, options: &Options) -> Basin {
    let equilibrium = 0.5 + 0.5 * (-1.5_f64 / 0.5).exp();
    let spec = exponential(
        "1.5",
        &format!(
            "[start]\nkind = \"box\"\nbox_samples = {samples}\nbox_displacement_from = {}\nbox_displacement_to = {}\n\
             box_velocity_from = 0\nbox_velocity_to = {velocity_to}\n[response]\nsettle = \"100 periods\"\n\
             measure = \"20 periods\"\ncheck = false\n",
            -2.0 - equilibrium,
            2.0 - equilibrium
        ),
    );
    run(&spec, options)[0].basin().unwrap()
}

/// Whether a share of the starts is 0.3071 within three standard errors.
fn is_of_bstab(basin: Basin) -> bool {
    let (share, samples) = (0.3071_f64, f64::from(basin.total()));
    let found = basin.fraction(basin.equilibrium).unwrap();
    (found - share).abs() < 3.0 * (share * (1.0 - share) / samples).sqrt()
}

#[test]
fn the_basin_of_bstab_within_its_sampling_error() {
    let [reference, f64, f32] = engines();
    for (options, samples) in [(reference, 300), (f64, 4000), (f32, 4000)] {
        let basin = basin(2.0, samples, &options);
        assert_eq!(basin.total(), samples);
        assert_eq!(basin.other, 0);
        assert!(is_of_bstab(basin), "{basin:?}");
        assert_eq!(basin.is_bistable(), Some(true));
    }
    // Starts in the lower half of the box slide more often.
    assert!(!is_of_bstab(self::basin(1.0, 4000, &f64)));
}

/// Whatever the ranges and threads, an instance has the same starts and results; another instance has others.
#[test]
fn the_cut_into_ranges_does_not_matter() {
    let velocities = "1.3, 1.5, 1.5, 1.7, 1.82, 2.5, 0.9";
    let boxed = "[start]\nkind = \"box\"\nbox_samples = 40\nbox_displacement_from = -2.5\nbox_displacement_to = 1.5\n\
        box_velocity_from = 0\nbox_velocity_to = 2\n";
    for start in ["[start]\nkind = \"both\"\n", boxed] {
        let spec = exponential(
            velocities,
            &format!("{start}[response]\nsettle = \"60 periods\"\nmeasure = \"20 periods\"\n"),
        );
        let options = engines()[1];
        let whole = run(&spec, &options);
        for size in [1, 2, 5] {
            let mut solver = Solver::new(&spec, &options).unwrap();
            let pool = rayon::ThreadPoolBuilder::new().num_threads(size).build().unwrap();
            let parts: Vec<Record> = (0..spec.grid.len())
                .step_by(size)
                .flat_map(|first| {
                    let range = first..(first + size).min(spec.grid.len());
                    pool.install(|| solver.records(range, &|_| {})).unwrap().records
                })
                .collect();
            assert!(parts == whole, "ranges of {size}");
        }
        // Two instances of the same velocity: the same kick and large start, other draws from the box.
        assert_eq!(whole[1].basin() == whole[2].basin(), whole[1].basin().is_none());
    }
}

/// An oscillation with this deviation of `x2`, settled.
pub(crate) fn oscillation(regime: Regime, x2_std: f64) -> Record {
    let outcome =
        Outcome { status: Status::Ok, x2_std: Some(x2_std), ay_rms: Some(1.0), ..Outcome::default() };
    Record { outcome: Some(Box::new(outcome)), ..record(InstabilityType::Stable, regime, true) }
}

#[test]
fn verdicts_of_two_starts() {
    let stable = Some(InstabilityType::Stable);
    let slides = record(InstabilityType::Stable, Regime::Equilibrium, true);
    let stuck = record(InstabilityType::Stable, Regime::Stuck, true);
    let cycle = oscillation(Regime::StickSlip, 1.0);
    assert_eq!(differ(&slides, &slides, stable), Some(false));
    assert_eq!(differ(&slides, &cycle, stable), Some(true));
    assert_eq!(differ(&cycle, &slides, stable), Some(true));
    assert_eq!(differ(&slides, &stuck, stable), Some(true));
    // One cycle, whose share of stick is about what counts, and two cycles.
    assert_eq!(differ(&cycle, &oscillation(Regime::Slip, 1.04), stable), Some(false));
    assert_eq!(differ(&cycle, &oscillation(Regime::StickSlip, 1.06), stable), Some(true));
    // What has not settled, and what decays towards an equilibrium that is not stable, gets no verdict.
    let unsettled = Record { settled: Some(false), ..cycle.clone() };
    assert_eq!(differ(&slides, &unsettled, stable), None);
    assert_eq!(differ(&slides, &cycle, Some(InstabilityType::NegativeSlope)), None);
    let failed = Record { status: Status::EventLimit, ..cycle.clone() };
    assert_eq!(differ(&failed, &cycle, stable), None);
}

#[test]
fn a_box_is_bistable_where_both_were_met() {
    let basin = |equilibrium, oscillation, other| Basin { equilibrium, oscillation, other, failed: 0 };
    assert_eq!(basin(3, 1, 0).is_bistable(), Some(true));
    assert_eq!(basin(3, 1, 7).is_bistable(), Some(true));
    assert_eq!(basin(4, 0, 0).is_bistable(), Some(false));
    assert_eq!(basin(4, 0, 1).is_bistable(), None);
    assert_eq!(basin(0, 0, 0).fraction(0), None);
    assert_eq!(basin(1, 3, 0).fraction(1), Some(0.25));
    // A start that failed is counted as that, and may hide either end.
    let stable = Some(InstabilityType::Stable);
    let cycle = oscillation(Regime::StickSlip, 1.0);
    let failed = Record { status: Status::EventLimit, ..cycle.clone() };
    let mut counted = Basin::default();
    for record in [&cycle, &failed, &cycle] {
        counted.add(record, stable);
    }
    assert_eq!(counted, Basin { equilibrium: 0, oscillation: 2, other: 0, failed: 1 });
    assert_eq!((counted.total(), counted.is_bistable()), (3, None));
}

/// The two-mass model below its critical friction (physics.md, section 6): the cycle sticks and detaches.
#[test]
fn the_default_large_start_finds_the_cycle_below_the_critical_friction() {
    let spec = parse(
        "[friction]\nlaw = \"constant\"\n[axes]\nmu_d = { values = [0.1, 0.2] }\n[belt]\nbelt_velocity = 3\n\
         [start]\nkind = \"both\"\n[response]\nsettle = \"auto\"\n",
    );
    for options in engines() {
        let records = run(&spec, &options);
        assert_eq!([&records[0], &records[1]].map(|record| record.bistable), [Some(false), Some(true)]);
        let cycle = records[1].large().unwrap();
        assert_eq!(cycle.regime, Some(Regime::DetachingStickSlip));
        let outcome = cycle.outcome.as_deref().unwrap();
        close("frequency", outcome.response_frequency.unwrap(), 34.09, 1e-3);
        close("peak", outcome.ax_peak.unwrap(), 800.0, 0.02);
    }
}

/// A run that is stopped keeps the instances that have come to the last of their starts, and says nothing of the others.
#[test]
fn a_cancelled_sweep_keeps_what_has_all_starts() {
    let boxed = "[start]\nkind = \"box\"\nbox_samples = 5000\nbox_displacement_from = -2.5\nbox_displacement_to = 1.5\n\
        box_velocity_from = 0\nbox_velocity_to = 2\n[response]\nsettle = \"2 periods\"\nmeasure = \"2 periods\"\ncheck = false\n";
    let spec = exponential("0.7, 1.5, 2.5, 1.3", boxed);
    let (cancel, done) = (AtomicBool::new(false), AtomicUsize::new(0));
    let options = Options { cancel: Some(&cancel), ..engines()[1] };
    let stop = |newly: usize| {
        let now = done.fetch_add(newly, Ordering::Relaxed) + newly;
        cancel.store(now >= 2, Ordering::Relaxed);
    };
    let computed = Solver::new(&spec, &options).unwrap().records(0..4, &stop).unwrap();
    assert_eq!(computed.stopped, Some(Stopped::Cancelled));
    let whole = run(&spec, &engines()[1]);
    let expected = [&whole[0], &whole[1], &Record::NOT_COMPUTED, &Record::NOT_COMPUTED];
    assert!(computed.records.iter().eq(expected), "{:?}", computed.records);
    // Both starts of instances that are taken at a time: none is done.
    let both = exponential(
        "0.7, 1.5",
        "[start]\nkind = \"both\"\n[response]\nsettle = \"2 periods\"\nmeasure = \"2 periods\"\n",
    );
    cancel.store(false, Ordering::Relaxed);
    let ended =
        Solver::new(&both, &options).unwrap().records(0..2, &|_| cancel.store(true, Ordering::Relaxed));
    assert!(matches!(ended, Err(Error::Cancelled { done: 0, total: 2 })), "{ended:?}");
}
