//! Modal models: maps of a structure's eigenvalues from the file of its modes.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

use num_complex::Complex64;
use squealmap::Sweep;
use squealmap::engine::options::Options;
use squealmap::engine::record::Record;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType;
use squealmap::model::linear::{Linear, analyse, eigenvalues, spectrum};
use squealmap::model::modal::{At, EACH};
use squealmap::model::status::Status;
use squealmap::store::description::Description;
use squealmap::store::identity::identity;
use squealmap::study::modes::follow::{Mode, modes_of, modes_svg};
use squealmap::sweep::grid::{Axis, Grid};
use squealmap::sweep::run::run;
use squealmap::sweep::solver::Solver;
use squealmap::sweep::spec::Spec;

use crate::cli::program::{squealmap, unwrapped};

/// Masses, springs, dampers and inclination of two masses.
#[derive(Clone, Copy)]
struct Masses {
    m: [f64; 2],
    k: [f64; 2],
    c: [f64; 2],
    theta: f64,
}

/// Table 1 of the paper.
const PAPER: Masses = Masses { m: [2.12, 0.18], k: [100_000.0, 101_000.0], c: [0.1, 0.1], theta: 0.01 };

impl Masses {
    /// The file of their modes in the coordinates `x2 y1`, by the equations of motion: with `T = μ N`, `N = W − κ ẍ2`,
    ///
    /// `(m2 + m1 c²) ẍ2 + R = T`, `m1 ÿ1 = h − F_ext`, `R = c g + s h`, `W = c h − s g`, `κ = m1 s c`,
    ///
    /// `g = k1 x2 c`, `h = k2 (x2 s − y1)`; and `N0 = F_ext/(c + μ s)`.
    fn file(self, load: f64) -> String {
        let ([m1, m2], (s, c)) = (self.m, self.theta.sin_cos());
        let row = |of: [f64; 2], on: [f64; 2]| {
            // on = [part of g, part of h] of the row, as coefficients of x2 and y1.
            [on[0] * of[0] * c + on[1] * of[1] * s, -on[1] * of[1]]
        };
        let mut text = format!(
            "kind = \"modal\"\nversion = 2\ntitle = \"Two masses\"\nmu = [0.0, 1.0]\nmodes = 2\nload = {load:e}\nwedge = {:e}\n",
            self.theta.tan()
        );
        let mut put = |name: &str, rows: [[f64; 2]; 2]| writeln!(text, "{name} = {rows:?}").unwrap();
        let zero = [0.0, 0.0];
        put("mass", [[m2 + m1 * c * c, 0.0], [0.0, m1]]);
        put("mass_friction", [[m1 * s * c, 0.0], zero]);
        for (name, of) in [("stiffness", self.k), ("damping", self.c)] {
            put(name, [row(of, [c, s]), row(of, [0.0, -1.0])]);
            put(&format!("{name}_friction"), [row(of, [s, -c]), zero]);
        }
        put("damping_slope", [[load / c, 0.0], zero]);
        text
    }

    fn section(self) -> String {
        let Masses { m: [m1, m2], k: [k1, k2], c: [c1, c2], theta } = self;
        format!("m1 = {m1}\nm2 = {m2}\nk1 = {k1}\nk2 = {k2}\nc1 = {c1}\nc2 = {c2}\ntheta = {theta}\n")
    }
}

fn frequency_of(linear: &Linear) -> f64 {
    linear.frequency.expect("a mode that leads")
}

/// Records of a sweep whose `[model]` begins with `model`.
fn records(directory: &Path, model: &str, rest: &str) -> Vec<Record> {
    let text = format!("analysis = [\"linear\"]\n[model]\n{model}\n{rest}");
    let spec = Spec::parse(&text, "test.toml", directory).unwrap_or_else(|error| panic!("{error}"));
    run(spec, &Options::default(), &|_| {}).unwrap().records
}

const MAP: &str = "f_ext = 700.0
[friction]
law = \"bilinear\"
[axes]
mu_s = { from = 0.0, to = 0.9, points = 19 }
mu_d = { from = 0.0, to = 0.9, points = 21 }
belt_velocity = { values = [0.0, 0.5, 3.0, 6.0] }
";

/// The test of the path: two masses as a file have their own map.
#[test]
fn two_masses_as_a_file_have_their_own_map() {
    /// No mode of these masses is below, Hz.
    const LOWEST: f64 = 30.0;
    let directory = tempfile::tempdir().unwrap();
    let undamped = Masses { c: [0.0, 0.0], ..PAPER };
    let steep = Masses { theta: 0.4, c: [2.0, 15.0], ..PAPER };
    let leaning = Masses { theta: -1.3, m: [1.0, 0.7], k: [5e4, 2e5], c: [1.0, 0.5] };
    let curved = "f_ext = 700.0\n[friction]\nlaw = \"exponential\"\nstribeck_velocity = 1.5\n[axes]\n\
                  mu_s = { from = 0.0, to = 0.9, points = 19 }\nmu_d = { values = [0.1, 0.25, 0.4] }\n\
                  belt_velocity = { values = [0.5, 3.0] }\n";
    for (masses, rest, kinds) in
        [(PAPER, MAP, 6), (undamped, MAP, 5), (steep, MAP, 4), (leaning, MAP, 3), (PAPER, curved, 4)]
    {
        // The load of the file is another one: matrices scale with it.
        std::fs::write(directory.path().join("modes.toml"), masses.file(250.0)).unwrap();
        let own = records(directory.path(), &masses.section(), rest);
        let modal = records(directory.path(), "kind = \"modal\"\nmodes = \"modes.toml\"\n", rest);
        assert_eq!(own.len(), modal.len());
        let mut met: Vec<InstabilityType> = Vec::new();
        let mut leaderless = 0;
        for (index, (own, modal)) in own.iter().zip(&modal).enumerate() {
            assert_eq!((own.status, own.kind), (modal.status, modal.kind), "{index}: {own:?} {modal:?}");
            met.extend(own.kind.filter(|kind| !met.contains(kind)));
            let (Some(a), Some(b)) = (own.linear, modal.linear) else {
                assert_eq!(own.linear.is_some(), modal.linear.is_some(), "{index}");
                continue;
            };
            // Where no mode leads, neither does with these.
            assert_eq!(a.frequency.is_some(), b.frequency.is_some(), "{index}: {own:?} {modal:?}");
            leaderless += usize::from(a.frequency.is_none());
            let size = Complex64::new(a.growth_rate, TAU * a.frequency.unwrap_or(LOWEST)).norm();
            for (a, b) in [
                (a.growth_rate, b.growth_rate),
                (TAU * a.frequency.unwrap_or(0.0), TAU * b.frequency.unwrap_or(0.0)),
                (a.growth_rate_flat, b.growth_rate_flat),
                (a.growth_rate_frozen, b.growth_rate_frozen),
            ] {
                assert!((a - b).abs() <= 1e-9 * size, "{index}: {own:?} {modal:?}");
            }
        }
        assert!(met.len() >= kinds, "{met:?}");
        assert_eq!(leaderless > 0, masses.c == [0.0, 0.0], "{leaderless}");
    }
}

/// Real modes 10, 20, 30 rad/s of unit masses, of which friction couples the first two.
const THREE: &str = "kind = \"modal\"
version = 2
title = \"Three\"
mu = [0.0, 1.0]
modes = 3
load = 10.0
stiffness = [[100.0, 0.0, 0.0], [0.0, 400.0, 0.0], [0.0, 0.0, 900.0]]
mass = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
stiffness_friction = [[0.0, 1000.0, 0.0], [-1000.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
damping_slope = [[5.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
";

/// One instance of the three modes.
fn three(file: &str, rest: &str) -> Record {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("three.toml"), file).unwrap();
    let model = format!("kind = \"modal\"\nmodes = \"three.toml\"\n{rest}");
    records(directory.path(), &model, "").remove(0)
}

#[test]
fn one_mechanism_alone_is_known_in_closed_form() {
    let constant =
        |mu: f64| format!("[friction]\nlaw = \"constant\"\nmu_d = {mu}\n[belt]\nbelt_velocity = 1\n");
    // (100 − x)(400 − x) + 10⁶ μ² = 0 has a double root at μ = 0.15.
    let at = |rest: &str| {
        let record = three(THREE, rest);
        (record.kind.unwrap(), record.linear.unwrap())
    };
    let (kind, linear) = at(&constant(0.1499));
    // Nothing damps: nothing grows or decays, and no mode leads.
    assert_eq!(kind, InstabilityType::Stable);
    assert_eq!(linear.growth_rate.to_bits() << 1, 0, "{linear:?}");
    assert_eq!(linear.frequency, None);
    let mu: f64 = 0.2;
    let (kind, linear) = at(&constant(mu));
    let theta = Complex64::new(250.0, (1e6 * mu * mu - 150.0_f64.powi(2)).sqrt());
    let lambda = Complex64::I * theta.conj().sqrt();
    assert_eq!(kind, InstabilityType::ModeCoupling);
    assert!((linear.growth_rate - lambda.re).abs() < 1e-12 * 20.0, "{linear:?}");
    assert!((frequency_of(&linear) * TAU - lambda.im).abs() < 1e-12 * 20.0, "{linear:?}");
    assert!(
        (linear.growth_rate_flat - lambda.re).abs() < 1e-12 * 20.0 && linear.growth_rate_frozen.abs() < 1e-12
    );
    // A damping ratio of each mode: λ = ω (−ζ ± i √(1 − ζ²)), the slowest decay is that of the lowest mode.
    let (_, linear) = three_of(&format!("damping_ratio = 0.03\n{}", constant(0.0)));
    assert!((linear.growth_rate + 0.03 * 10.0).abs() < 1e-12, "{linear:?}");
    assert!(
        (frequency_of(&linear) * TAU - 10.0 * (1.0 - 0.03_f64.powi(2)).sqrt()).abs() < 1e-11,
        "{linear:?}"
    );
    // A slope of −0.1 s/m under twice the load of the file: λ² − 1.0 λ + 100 = 0 for the first mode alone.
    let falling = "f_ext = 20\n[friction]\nmu_s = 0.1\nmu_d = 0.0\nknee_velocity = 1.0\n[belt]\nbelt_velocity = 0.999999999999\n";
    let (kind, linear) = three_of(falling);
    assert_eq!(kind, InstabilityType::NegativeSlope);
    assert!((linear.growth_rate_frozen - 0.5).abs() < 1e-12, "{linear:?}");
    assert!((linear.growth_rate - 0.5).abs() < 1e-6 && linear.growth_rate_flat.abs() < 1e-9, "{linear:?}");
}

/// Modes of 10, 20 and 30 rad/s in skew coordinates, with damping ratios of their own along an axis: λ = ω (−ζ ± i √(1 − ζ²)).
#[test]
fn each_mode_may_have_its_damping() {
    let directory = tempfile::tempdir().unwrap();
    let file = "kind = \"modal\"\nversion = 2\ntitle = \"\"\nmu = [0.0, 1.0]\nmodes = 3\nload = 1.0\n\
                stiffness = [[100.0, 100.0, 0.0], [100.0, 500.0, 400.0], [0.0, 400.0, 1300.0]]\n\
                mass = [[1.0, 1.0, 0.0], [1.0, 2.0, 1.0], [0.0, 1.0, 2.0]]\n";
    std::fs::write(directory.path().join("skew.toml"), file).unwrap();
    let text = "analysis = [\"linear\"]\n[model]\nkind = \"modal\"\nmodes = \"skew.toml\"\ndamping_ratio = 0.02\ndamping_ratio_3 = 0.5\n\
                [friction]\nlaw = \"constant\"\nmu_d = 0\n[belt]\nbelt_velocity = 1\n[axes]\ndamping_ratio_1 = { values = [0, 0.1, 0.3] }\n";
    let spec = Spec::parse(text, "test.toml", directory.path()).unwrap();
    // One damped mode of three: what rounding makes of the others does not grow.
    let one = text
        .replace("damping_ratio = 0.02\ndamping_ratio_3 = 0.5\n", "")
        .replace("mu_d = 0\n", "")
        .replace("[axes]\n", "[axes]\nmu_d = { values = [0, 0.1, 0.2, 0.3] }\n");
    let modes = modes_of(&Spec::parse(&one, "test.toml", directory.path()).unwrap()).unwrap();
    assert_eq!(modes.branches.len(), 3);
    assert!(modes.branches.iter().all(|branch| branch.critical.is_empty()), "{modes:?}");
    for (index, first) in [0.0, 0.1, 0.3].into_iter().enumerate() {
        let found = spectrum(&spec.instance(index)).unwrap();
        for (omega, ratio) in [(10.0, 0.02 + first), (20.0, 0.02), (30.0, 0.52)] {
            let wanted = Complex64::new(-ratio, f64::sqrt(1.0 - ratio * ratio)) * omega;
            let nearest = found.iter().map(|z| (z - wanted).norm()).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-11 * omega, "{first}: {wanted} is not in {found:?}");
        }
    }
}

/// Frequencies from 10 kHz on have one unit in all figures; lower ones stay in Hz.
#[test]
fn high_frequencies_are_drawn_in_kilohertz() {
    let directory = tempfile::tempdir().unwrap();
    for (k, unit) in [(1e10, "kHz"), (1e4, "Hz")] {
        let file = format!(
            "kind = \"modal\"\nversion = 2\ntitle = \"\"\nmu = [0.0, 1.0]\nmodes = 1\nload = 1.0\nstiffness = [[{k:e}]]\nmass = [[1.0]]\n"
        );
        std::fs::write(directory.path().join("one.toml"), file).unwrap();
        let text = "analysis = [\"linear\"]\n[model]\nkind = \"modal\"\nmodes = \"one.toml\"\n[friction]\nlaw = \"constant\"\n\
                    [belt]\nbelt_velocity = 1\n[axes]\nmu_d = { from = 0, to = 0.5, points = 3 }\n";
        let svg = modes_svg(&Spec::parse(text, "test.toml", directory.path()).unwrap()).unwrap();
        assert!(svg.contains(&format!("Frequency ({unit})")), "{svg}");
    }
}

fn three_of(rest: &str) -> (InstabilityType, Linear) {
    let record = three(THREE, rest);
    (record.kind.unwrap(), record.linear.unwrap())
}

/// What vectors make of modes beyond those that they were chosen for is not the structure's.
#[test]
fn only_the_lowest_modes_count() {
    let rest = "[friction]\nlaw = \"constant\"\nmu_d = 0.5\n[belt]\nbelt_velocity = 1\n";
    // Friction couples the second and the third mode, and only the first counts.
    let coupled = THREE
        .replace("[[0.0, 1000.0, 0.0], [-1000.0, 0.0, 0.0]", "[[0.0, 0.0, 0.0], [0.0, 0.0, 1000.0]")
        .replace("[0.0, 0.0, 0.0]]\ndamping_slope", "[0.0, -1000.0, 0.0]]\ndamping_slope");
    assert_eq!(three(&coupled, rest).kind, Some(InstabilityType::ModeCoupling));
    let one = three(&coupled.replace("modes = 3", "modes = 1"), rest);
    assert_eq!(one.kind, Some(InstabilityType::Stable));
    // One mode alone leads without damping, too.
    assert!((frequency_of(&one.linear.unwrap()) * TAU - 10.0).abs() < 1e-12);
    // The same where something damps.
    let damped = format!("damping_ratio = 1e-4\n{rest}");
    assert_eq!(three(&coupled, &damped).kind, Some(InstabilityType::ModeCoupling));
    assert_eq!(
        three(&coupled.replace("modes = 3", "modes = 1"), &damped).kind,
        Some(InstabilityType::Stable)
    );
}

#[test]
fn a_wedge_may_have_no_equilibrium() {
    let rest = |mu: f64| format!("[friction]\nlaw = \"constant\"\nmu_d = {mu}\n[belt]\nbelt_velocity = 1\n");
    let file = THREE.replace("load = 10.0", "load = 10.0\nwedge = -2.0");
    let beyond = three(&file, &rest(0.6));
    assert_eq!((beyond.kind, beyond.status), (Some(InstabilityType::Divergence), Status::NoEquilibrium));
    assert_eq!(three(&file, &rest(0.4)).status, Status::Ok);
    // A mass that friction takes away altogether.
    let massless = THREE.replace(
        "damping_slope",
        "mass_friction = [[-1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]\ndamping_slope",
    );
    assert_eq!(three(&massless, &rest(1.0)).status, Status::NonFinite);
}

/// x along the sliding on a spring a and y on the contact's spring k, coupled by c, masses of 1 kg; friction pulls x by μ k y:
/// θ² − (a + k) θ + a k − c (c + μ k) = 0 with θ = −λ². Without c and μ both are oscillators with a damping ratio.
#[test]
fn a_contact_stiffness_is_known_in_closed_form() {
    let directory = tempfile::tempdir().unwrap();
    let (a, k0) = (4e6, 3e6);
    let file = |c: f64| {
        format!(
            "kind = \"modal\"\nversion = 2\ntitle = \"\"\nmu = [0.0, 1.0]\nmodes = 2\nload = 1.0\nstiffness = [[{a}, {c}], [{c}, {k0}]]\n\
             mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness_friction = [[0.0, {k0}], [0.0, 0.0]]\ncontact_stiffness = {k0}\n\
             contact_range = [1e6, 9e6]\nstiffness_contact = [[0.0, 0.0], [0.0, 1.0]]\n"
        )
    };
    let stiffnesses = [1e6, k0, 3.9e6, 6e6];
    let found = |c: f64, mu: f64, [ratio, more]: [f64; 2]| {
        std::fs::write(directory.path().join("contact.toml"), file(c)).unwrap();
        let rest = format!(
            "damping_ratio = {ratio}\ndamping_ratio_1 = {more}\n[friction]\nlaw = \"constant\"\nmu_d = {mu}\n[belt]\nbelt_velocity = 1\n[axes]\nkn = {{ values = {stiffnesses:?} }}\n"
        );
        let records = records(directory.path(), "kind = \"modal\"\nmodes = \"contact.toml\"\n", &rest);
        records.iter().map(|record| record.linear.unwrap()).collect::<Vec<_>>()
    };
    let c = -3e5;
    let mut unstable = 0;
    for (k, linear) in stiffnesses.iter().zip(found(c, 0.4, [0.0; 2])) {
        let (sum, product) = (a + k, a * k - c * (c + 0.4 * k));
        let root = Complex64::from(sum * sum / 4.0 - product).sqrt();
        let lambdas = [sum / 2.0 + root, sum / 2.0 - root].map(|theta| (-theta).sqrt());
        let growth = lambdas.iter().map(|z| z.re.abs()).fold(0.0, f64::max);
        // What does not couple has no growth at all, and no frequency.
        assert!((linear.growth_rate - growth).abs() < 1e-9 * growth.max(1.0), "{k}: {linear:?} {growth}");
        assert_eq!(linear.frequency.is_some(), growth > 1.0, "{k}: {linear:?} {lambdas:?}");
        if let Some(frequency) = linear.frequency {
            let near = lambdas.iter().map(|z| (z.im.abs() / TAU - frequency).abs());
            assert!(near.fold(f64::INFINITY, f64::min) < 1e-9 * frequency, "{k}: {linear:?} {lambdas:?}");
            unstable += 1;
        }
    }
    assert!((1..stiffnesses.len()).contains(&unstable), "{unstable}");
    for (k, linear) in stiffnesses.iter().zip(found(0.0, 0.0, [0.1, 0.4])) {
        // One half of the lower, a tenth of the higher: that decays more slowly.
        let (low, high) = (a.min(*k).sqrt(), a.max(*k).sqrt());
        assert!((linear.growth_rate + (0.5 * low).min(0.1 * high)).abs() < 1e-9 * high, "{k}: {linear:?}");
    }
    for (k, linear) in stiffnesses.iter().zip(found(0.0, 0.0, [0.1, 0.0])) {
        // The slower one decays most slowly.
        let omega = a.min(*k).sqrt();
        assert!((linear.growth_rate + 0.1 * omega).abs() < 1e-9 * omega, "{k}: {linear:?}");
        assert!(
            (frequency_of(&linear) * TAU - omega * 0.99_f64.sqrt()).abs() < 1e-9 * omega,
            "{k}: {linear:?}"
        );
    }
}

/// Every word that a modal model has no use for is one sentence.
#[test]
fn what_a_modal_model_does_not_read_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("three.toml"), THREE).unwrap();
    std::fs::write(directory.path().join("free.toml"), THREE.replace("load = 10.0\n", "")).unwrap();
    std::fs::write(directory.path().join("hollow.toml"), THREE.replace("mass = [[1.0", "mass = [[-1.0"))
        .unwrap();
    std::fs::write(directory.path().join("bad.toml"), THREE.replace("100.0, 0.0", "100.0, 1.0")).unwrap();
    let two_mass = "it is used only by kind = \"two_mass\" in [model]";
    let modal = "it is used only by kind = \"modal\" in [model]";
    for (model, rest, wanted) in [
        ("modes = \"three.toml\"\nm1 = 2", "", format!("`m1` in [model] would have no effect: {two_mass}")),
        ("modes = \"three.toml\"\nimpact_friction = false", "", format!("`impact_friction` in [model] would have no effect: {two_mass}")),
        ("modes = \"three.toml\"", "[axes]\ntheta = { from = 0, to = 0.1, points = 3 }", format!("axis `theta` would have no effect: {two_mass}")),
        ("modes = \"three.toml\"", "[start]\nkind = \"mode\"", format!("`kind` in [start] would have no effect: {two_mass}")),
        ("modes = \"three.toml\"", "[start]\nstart_velocity = 1", format!("`start_velocity` in [start] would have no effect: {two_mass}")),
        ("modes = \"three.toml\"", "[response]\nsettle = \"auto\"", format!("a response would have no effect: {two_mass}, since a modal model has eigenvalues alone")),
        ("modes = \"three.toml\"\ndamping_ratio_4 = 0.1", "", "`damping_ratio_4` in [model] would have no effect: it is used only by a file of more modes than 3, which `three.toml` has".to_owned()),
        ("modes = \"three.toml\"", "[axes]\nkn = { values = [1e9, 2e9] }", "axis `kn` would have no effect: it is used only by a file of modes with a range of contact stiffness".to_owned()),
        ("", "", "`modes` is missing: kind = \"modal\" in [model] is a file of modes, so write modes = \"modes.toml\" in [model]".to_owned()),
        ("modes = \"none.toml\"", "", "cannot read the modes file `".to_owned()),
        ("modes = \"free.toml\"", "", "free.toml`: its load is 0 N, so that a slope of friction would have no effect; press the bodies in the study".to_owned()),
        ("modes = \"hollow.toml\"", "", "hollow.toml`: its mass matrix is not positive definite".to_owned()),
        ("modes = \"bad.toml\"", "", "bad.toml`: stiffness: it differs from its transpose by 1e0".to_owned()),
    ] {
        let text = format!("[model]\nkind = \"modal\"\n{model}\n[friction]\nlaw = \"constant\"\nmu_d = 0.1\n[belt]\nbelt_velocity = 1\n{rest}\n");
        let found = Spec::parse(&text, "test.toml", directory.path()).unwrap_err().to_string();
        assert!(found.contains(&wanted), "{found}\ndoes not say\n{wanted}");
        assert!(!found.contains('\n'), "{found}");
    }
    let rest = "\n[friction]\nlaw = \"constant\"\nmu_d = 0.1\n[belt]\nbelt_velocity = 1\n";
    for (text, wanted) in [
        (
            format!("analysis = [\"response\"]\n[model]\nkind = \"modal\"\nmodes = \"three.toml\"{rest}"),
            format!("test.toml:1:13: a response would have no effect: {two_mass}"),
        ),
        (
            format!("[model]\nmodes = \"three.toml\"{rest}"),
            format!("`modes` in [model] would have no effect: {modal}"),
        ),
        (
            format!("[model]\ndamping_ratio = 0.1{rest}"),
            format!("`damping_ratio` in [model] would have no effect: {modal}"),
        ),
        (
            format!("[axes]\nkn = {{ from = 1e12, to = 1e15, points = 4 }}{rest}"),
            format!("axis `kn` would have no effect: {modal}"),
        ),
        (
            format!("[model]\ncontact_stiffness = 1e14{rest}"),
            "unknown key `contact_stiffness` in [model]; the contact stiffness of a modal model is `kn`"
                .to_owned(),
        ),
        (format!("[model]\nkind = \"modes\"{rest}"), "unknown model `modes` as `kind` in [model]".to_owned()),
        // Both sections have a key of this name.
        (
            format!("analysis = [\"linear\"]\n[model]\nkind = \"two_mass\"\n[start]\nkind = \"both\"{rest}"),
            "test.toml:5:8: `kind = \"both\"` in [start] would have no effect".to_owned(),
        ),
    ] {
        let found = Spec::parse(&text, "test.toml", directory.path()).unwrap_err().to_string();
        assert!(found.contains(&wanted), "{found}\ndoes not say\n{wanted}");
    }
}

fn sweep_of_three(directory: &Path) -> Spec {
    std::fs::write(directory.join("three.toml"), THREE).unwrap();
    let text = "[model]\nkind = \"modal\"\nmodes = \"three.toml\"\n[friction]\nknee_velocity = 2\n[belt]\nbelt_velocity = 1\n\
                [axes]\nmu_s = { from = 0, to = 0.4, points = 5 }\nmu_d = { from = 0, to = 0.4, points = 5 }\n";
    std::fs::write(directory.join("map.toml"), text).unwrap();
    Spec::read(&directory.join("map.toml")).unwrap()
}

/// What stands in the file is part of what a sweep is, and enough to compute it again.
#[test]
fn another_file_is_another_sweep() {
    let directory = tempfile::tempdir().unwrap();
    let spec = sweep_of_three(directory.path());
    assert!((spec.base.require(Param::FExt) - 10.0).abs() < 1e-15, "the load of the file");
    let options = Options::default();
    let computations = Solver::new(&spec, &options).unwrap().computations();
    let described = Description::new(&spec, computations.clone(), 8);
    assert_eq!(described.computations[0].as_ref().unwrap().method, squealmap::model::modal::METHOD);
    // A description alone gives the sweep again.
    std::fs::remove_file(directory.path().join("three.toml")).unwrap();
    let again = Description::from_bytes(&described.to_bytes()).unwrap().spec().unwrap();
    assert_eq!(identity(&again, &computations), identity(&spec, &computations));
    for index in 0..25 {
        assert_eq!(analyse(&again.instance(index)), analyse(&spec.instance(index)));
    }
    // One digit more is another sweep.
    let text = THREE.replace("900.0", "900.1");
    std::fs::write(directory.path().join("three.toml"), text).unwrap();
    let other = Spec::read(&directory.path().join("map.toml")).unwrap();
    assert_ne!(Description::new(&other, computations, 8).id, described.id);
}

#[test]
fn the_program_maps_a_structure_and_refuses_what_it_has_not() {
    let directory = tempfile::tempdir().unwrap();
    let here = directory.path();
    sweep_of_three(here);
    let ended = squealmap(here, &["run", "map.toml", "--output", "a"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let table = std::fs::read_to_string(here.join("a/map.csv")).unwrap();
    let header =
        "instance,mu_s,mu_d,type,growth_rate,frequency,phase,growth_rate_flat,growth_rate_frozen,status";
    assert_eq!(table.lines().next(), Some(header));
    assert!(table.contains("mode_coupling") && table.contains("negative_slope"), "{table}");
    let figure = std::fs::read_to_string(here.join("a/map.svg")).unwrap();
    assert!(figure.contains("Type"), "{}", &figure[..400]);
    let manifest = std::fs::read_to_string(here.join("a/manifest.json")).unwrap();
    assert!(manifest.contains(&blake3::hash(THREE.as_bytes()).to_hex().to_string()), "{manifest}");
    let refined = squealmap(here, &["refine", "map.toml", "--output", "b"]);
    assert_eq!(refined.code, Some(0), "{}", refined.err);
    let checked = squealmap(here, &["check", "map.toml"]);
    assert!(
        checked.out.contains("model     three.toml: 3 mode(s) in the space of 3 vector(s)"),
        "{}",
        checked.out
    );
    // The third mode knows nothing of friction.
    let ended = squealmap(here, &["modes", "map.toml", "--output", "c"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let table = std::fs::read_to_string(here.join("c/modes.csv")).unwrap();
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let third = reader.headers().unwrap().iter().position(|name| name == "frequency_3").unwrap();
    let thirds: Vec<f64> = reader.records().map(|row| row.unwrap()[third].parse().unwrap()).collect();
    assert_eq!(thirds.len(), 25);
    assert!(thirds.iter().all(|hertz| (hertz * TAU - 30.0).abs() < 1e-9), "{thirds:?}");
    let drawn = |path: &str| std::fs::read_to_string(here.join(path)).unwrap();
    let figure = drawn("c/modes.svg");
    assert!(figure.contains(">unstable<") && !figure.contains(">mode 1<"), "{}", &figure[..2000]);
    let ended = squealmap(here, &["plot", "c"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let curves = |text: &str| {
        text.lines().filter(|line| line.starts_with("<path")).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(curves(&drawn("c/plot.svg")), curves(&figure));
    // Friction beyond that of the vectors is said, and computed.
    assert!(!checked.err.contains("vectors"), "{}", checked.err);
    let far = std::fs::read_to_string(here.join("map.toml"))
        .unwrap()
        .replace("to = 0.4, points = 5 }\nmu_d", "to = 2.4, points = 5 }\nmu_d");
    std::fs::write(here.join("far.toml"), far).unwrap();
    for command in ["check", "run"] {
        let ended = squealmap(here, &[command, "far.toml"]);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        let wanted = "warning: the coefficient of friction is 1.4000 in this sweep, but the vectors of `three.toml` were chosen for 0 to 1";
        assert!(unwrapped(&ended.err).contains(wanted), "{}", ended.err);
    }
    for (arguments, wanted) in [
        (
            vec!["trace", "map.toml", "--at", "mu_s=0.1,mu_d=0.1"],
            "`trace` needs two masses, but the model is the modes of three.toml: a modal model has eigenvalues alone, which `run` maps",
        ),
        (vec!["tradeoff", "map.toml"], "`tradeoff` needs two masses"),
        (
            vec!["run", "map.toml", "--backend", "gpu"],
            "no kernel of a GPU computes a modal model, which --backend cpu does",
        ),
        (
            vec!["run", "map.toml", "--require-gpu"],
            "--require-gpu: this needs a GPU, but no kernel of one computes a modal model; compute it on the CPU, or remove --require-gpu",
        ),
    ] {
        let ended = squealmap(here, &arguments);
        assert_eq!(ended.code, Some(2), "{arguments:?} {}", ended.err);
        let said = unwrapped(&ended.err);
        assert!(said.contains(wanted), "{said}\ndoes not say\n{wanted}");
    }
    assert!(
        eigenvalues(&Spec::read(&here.join("map.toml")).unwrap().instance(0)).is_none(),
        "it has no four"
    );
}

/// A sweep in code is that of the file.
#[test]
fn code_names_the_file_of_modes() {
    let directory = tempfile::tempdir().unwrap();
    let spec = sweep_of_three(directory.path());
    let built = Sweep::modal("three.toml")
        .files_in(directory.path())
        .set(Param::KneeVelocity, 2.0)
        .set(Param::BeltVelocity, 1.0)
        .axis(Param::MuS, 0.0..=0.4, 5)
        .axis(Param::MuD, 0.0..=0.4, 5);
    let same = built.spec().unwrap();
    assert_eq!(same.resolved(), spec.resolved());
    assert_eq!(built.run().unwrap().records, run(spec, &Options::default(), &|_| {}).unwrap().records);
    let wrong = Sweep::modal("none.toml").spec().unwrap_err().to_string();
    assert!(
        wrong.starts_with("Sweep::modal(\"none.toml\"): ") || wrong.starts_with("modal(\"none.toml\"): "),
        "{wrong}"
    );
    let wrong = built.set(Param::Theta, 0.1).spec().unwrap_err().to_string();
    assert!(wrong.starts_with(".set(Param::Theta, 0.1): `theta` in [model] would have no effect"), "{wrong}");
}

/// `modes` finds the critical friction of the study (`docs/fem_paper.md`) by bisection, and each mode goes on as it has come.
#[test]
fn modes_of_a_structure_are_followed() {
    let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/sweeps/fem");
    let text = "analysis = [\"linear\"]\n[model]\nkind = \"modal\"\nmodes = \"fem_modes.toml\"\n[friction]\nlaw = \"constant\"\n[belt]\n\
                belt_velocity = 1\n[axes]\nmu_d = { from = 0, to = 0.4, points = 21 }\n";
    let found = modes_of(&Spec::parse(text, "test.toml", directory.as_ref()).unwrap()).unwrap();
    let branch = &found.branches[0];
    assert_eq!((found.count(), branch.critical.len()), (6, 1));
    assert!((branch.critical[0] - 0.199_213).abs() < 1e-6, "{:?}", branch.critical);
    let rows: Vec<&Vec<_>> = branch.modes.iter().flatten().collect();
    assert_eq!(rows.len(), 21);
    for k in 0..6 {
        for pair in rows.windows(2) {
            let moved = (pair[1][k].frequency() - pair[0][k].frequency()).abs();
            // Least apart at the beginning are two that lie 238 Hz from each other.
            assert!(moved < 200.0, "mode {k} jumps by {moved} Hz");
        }
    }
    let growth = rows[20].iter().map(Mode::growth_rate).fold(0.0, f64::max);
    assert!((growth - 4821.2).abs() < 0.1, "{growth}");
}

/// The shipped map is that of the study's own numbers (`docs/fem_paper.md`), and has the types that its page names.
#[test]
fn the_shipped_map_is_that_of_the_papers_model() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/sweeps/fem/fem_map.toml");
    let mut spec = Spec::read(path.as_ref()).unwrap();
    let modal = spec.modal.clone().unwrap();
    assert_eq!((modal.modes(), modal.size()), (6, 16));
    assert!((modal.load - 17.0).abs() < 1e-10);
    let growth = |mu: f64| {
        let all = modal.eigenvalues(At { mu, slope: 0.0, ratio: 0.0, each: [0.0; EACH], kn: None }).unwrap();
        all.iter().map(|z| z.re).fold(0.0, f64::max)
    };
    // Growth rises as the root of the distance from the critical friction.
    let critical = 0.199_212_7;
    assert!(growth(critical - 2e-7) == 0.0 && growth(critical + 2e-7) > 0.1);
    assert!((growth(0.4) - 4821.2).abs() < 0.1, "{}", growth(0.4));
    let frequency = modal
        .eigenvalues(At { mu: 0.4, slope: 0.0, ratio: 0.0, each: [0.0; EACH], kn: None })
        .unwrap()
        .iter()
        .max_by(|a, b| a.re.total_cmp(&b.re))
        .unwrap()
        .im
        .abs()
        / TAU;
    assert!((frequency - 14_527.17).abs() < 0.01, "{frequency}");
    let Grid::Axes(axes) = &mut spec.grid else { panic!("it has axes") };
    for Axis { values, .. } in axes {
        *values = values.iter().step_by(15).cloned().collect();
    }
    let kinds: Vec<_> = run(spec, &Options::default(), &|_| {})
        .unwrap()
        .records
        .iter()
        .map(|one| one.kind.unwrap())
        .collect();
    let of = |mu_s: usize, mu_d: usize| kinds[18 * mu_s + mu_d];
    assert_eq!(kinds.len(), 18 * 18);
    assert_eq!(of(0, 0), InstabilityType::Stable);
    assert_eq!(of(6, 0), InstabilityType::NegativeSlope);
    assert_eq!(of(17, 17), InstabilityType::ModeCoupling);
    assert_eq!(of(17, 0), InstabilityType::Coexistence);
    assert!(kinds.contains(&InstabilityType::Interaction));
}
