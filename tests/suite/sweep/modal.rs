//! Modal models: maps of a structure's eigenvalues from the file of its modes.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

use num_complex::Complex64;
use squealmap::engine::options::Options;
use squealmap::engine::record::Record;
use squealmap::model::kind::InstabilityType;
use squealmap::model::linear::{Linear, spectrum};
use squealmap::model::status::Status;
use squealmap::study::modes::follow::{modes_of, modes_svg};
use squealmap::sweep::run::run;
use squealmap::sweep::spec::Spec;

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
pub(super) const THREE: &str = "kind = \"modal\"
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
