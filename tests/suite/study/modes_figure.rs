//! The eigenvalues along an axis: followed, marked, written and drawn.

use crate::results::figure::draw as render;
use num_complex::Complex64;
use squealmap::model::linear::eigenvalues;
use squealmap::results::figure::look::Look;
use squealmap::study::error::Error;
use squealmap::study::modes::follow::{Mode, draw, follow, modes_csv, modes_svg};
use squealmap::sweep::spec::Spec;

fn sweep(sections: &str, axes: &str) -> Spec {
    let text = format!("analysis = [\"linear\"]\n{sections}\n[axes]\n{axes}\n");
    Spec::parse(&text, "test", std::path::Path::new(".")).expect("a valid sweep")
}

fn of(spec: &Spec, index: usize) -> Option<Vec<Complex64>> {
    eigenvalues(&spec.instance(index)).map(Vec::from)
}

const CONSTANT: &str = "[friction]\nlaw = \"constant\"\n[belt]\nbelt_velocity = 3.0";

#[test]
fn the_critical_friction_is_found_between_the_points() {
    // physics.md, section 6: with the damping of Table 1.
    let spec = sweep(CONSTANT, "mu_d = { from = 0.0, to = 1.0, points = 11 }");
    let modes = follow(&spec, &of).expect("an axis of numbers");
    assert_eq!(modes.branches.len(), 1);
    let critical = &modes.branches[0].critical;
    assert_eq!(critical.len(), 1);
    assert!((critical[0] - 0.226_361_157_99).abs() < 1e-10, "{critical:?}");
    let svg = modes_svg(&spec).expect("an axis of numbers");
    assert!(svg.contains(" = 0.2264"));
    render(&svg, "modes");
}

#[test]
fn modes_keep_their_names_where_frequencies_cross() {
    // Three uncoupled modes whose frequencies cross, by steps as large as they are apart: ordering by frequency would swap them, and so
    // would joining what is nearest.
    let spec = sweep(CONSTANT, "mu_d = { from = 0.0, to = 1.0, points = 6 }");
    let crossing = |spec: &Spec, index: usize| {
        let mu = spec.instance(index).params.require(squealmap::model::Param::MuD);
        let [a, b, c] = [(-1.0, 100.0 + 60.0 * mu), (2.0, 148.0 - 60.0 * mu), (1.0, 131.0 + mu)]
            .map(|(growth, omega)| Complex64::new(growth, omega));
        Some(vec![b, a.conj(), c, b.conj(), a, c.conj()])
    };
    let modes = follow(&spec, &crossing).expect("an axis of numbers");
    for all in modes.branches[0].modes.iter().flatten() {
        assert_eq!(all.iter().map(Mode::growth_rate).collect::<Vec<_>>(), [-1.0, 1.0, 2.0]);
    }
    render(&draw(&spec, &modes, &Look::default()), "modes_crossing");
}

#[test]
fn the_table_holds_the_eigenvalues_to_the_bit() {
    let spec =
        sweep(CONSTANT, "mu_d = { from = 0.0, to = 1.0, points = 7 }\ntheta = { values = [0.01, 0.02] }");
    let bytes = modes_csv(&spec).expect("an axis of numbers");
    let mut reader = csv::Reader::from_reader(bytes.as_slice());
    let header: Vec<String> = reader.headers().expect("a header").iter().map(str::to_owned).collect();
    assert_eq!(
        header.join(","),
        "instance,mu_d,theta,frequency_1,growth_rate_1,growth_rate_1_fast,frequency_2,growth_rate_2,growth_rate_2_fast"
    );
    let mut rows = 0;
    for (index, row) in reader.records().enumerate() {
        let row = row.expect("an even row");
        assert_eq!(row[0], index.to_string());
        let all = of(&spec, index).expect("an equilibrium");
        for column in [4, 7] {
            let growth: f64 = row[column].parse().expect("a number");
            assert!(all.iter().any(|z| z.re.to_bits() == growth.to_bits()), "row {index}");
        }
        rows += 1;
    }
    assert_eq!(rows, 14);
    let svg = modes_svg(&spec).expect("an axis of numbers");
    assert!(svg.contains(" = 0.02 rad"));
    render(&svg, "modes_theta");
}

#[test]
fn overdamped_modes_show_both_decays() {
    let damped = "[model]\nc1 = 2000.0\n[friction]\nlaw = \"constant\"\n[belt]\nbelt_velocity = 3.0";
    let spec = sweep(damped, "mu_d = { from = 0.0, to = 1.0, points = 21 }");
    let modes = follow(&spec, &of).expect("an axis of numbers");
    for pair in modes.branches[0].modes.iter().flatten() {
        let slow = pair.iter().find(|mode| mode.fast.is_some()).expect("a real pair");
        assert!(slow.frequency() == 0.0 && slow.fast.is_some_and(|fast| fast < slow.growth_rate()));
    }
    render(&draw(&spec, &modes, &Look::default()), "modes_overdamped");
}

#[test]
fn sweeps_without_an_equilibrium_or_an_axis() {
    let spec = sweep(
        "[friction]\nlaw = \"constant\"\n[belt]\nbelt_velocity = 0.0",
        "mu_d = { values = [0.1, 0.2] }",
    );
    assert!(matches!(modes_svg(&spec), Err(Error::NoModes)));
    // One belt that moves is enough.
    let spec = sweep("[friction]\nlaw = \"constant\"\nmu_d = 0.3", "belt_velocity = { values = [0.0, 1.0] }");
    render(&modes_svg(&spec).expect("an axis of numbers"), "modes_sticking");
    let spec = sweep(CONSTANT, "mu_d = { values = [0.1] }");
    assert!(matches!(modes_csv(&spec), Err(Error::NoModesAxis)));
    let tuples = concat!(env!("CARGO_MANIFEST_DIR"), "/sweeps/tuples.toml");
    let error = modes_csv(&Spec::read(tuples.as_ref()).expect("a sweep")).expect_err("no axes");
    assert!(error.is_bad_input() && error.to_string().contains("lists its instances in a file of `points`"));
}
