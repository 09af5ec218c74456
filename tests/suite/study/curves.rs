//! Curves over two parameters on which cycles meet or are born: where closed forms and independent codes have them.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::cli::program::squealmap;
use crate::store::resume::with;
use crate::study::hysteresis::last_velocity_of_the_cycle;
use squealmap::results::figure::look::Look;
use squealmap::study::curves::seek::{PlaneCurves, seek};
use squealmap::study::cycles::curve::{Curve, End};
use squealmap::study::cycles::special::Special;
use squealmap::study::{Kind, Picture};
use squealmap::sweep::spec::Spec;

/// Table 1 with the bilinear law, over a band of belt velocities at whose ends `benches/peers/folds.py` has the folds.
const BAND: &str = "[model]\ntheta = 0.01\n[friction]\nlaw = \"bilinear\"\nmu_s = 0.6\nknee_velocity = 5\n\
    [response]\nsettle = \"auto\"\n[axes]\nmu_d = { from = 0.0, to = 0.6, points = 5 }\n\
    belt_velocity = { from = 3.0, to = 4.0, points = 5 }\n";

/// The single mass on a belt with m = k = N = 1, over belt velocity and damping.
const SINGLE: &str = "[model]\nm1 = 0.9\nm2 = 0.1\nk1 = 1\nk2 = 1\nc2 = 0.1\nf_ext = 1\ntheta = 0\n\
    [friction]\nlaw = \"exponential\"\nmu_s = 1\nmu_d = 0.5\nstribeck_velocity = 0.5\n\
    [start]\nstart_velocity = 0.0001\n[response]\nsettle = \"auto\"\n[axes]\nbelt_velocity = { from = 0.5, to = 2.1, points = 5 }\n\
    c1 = { from = 0.1, to = 0.15, points = 5 }\n";

fn parse(text: &str) -> Spec {
    Spec::parse(text, "s.toml", ".".as_ref()).unwrap()
}

fn only(spec: &Spec) -> PlaneCurves {
    let mut planes = seek(spec, 2, &|| ()).unwrap();
    assert_eq!(planes.len(), 1);
    planes.remove(0)
}

/// The values at both ends of a curve, those of the lower second parameter first.
fn ends(curve: &Curve) -> [[f64; 2]; 2] {
    assert_eq!(curve.ends, [End::Edge; 2]);
    let [first, last] = [&curve.points[0], &curve.points[curve.points.len() - 1]].map(|point| point.values);
    if first[1] < last[1] { [first, last] } else { [last, first] }
}

fn is(found: [f64; 2], [x, y]: [f64; 2]) -> bool {
    (found[0] - x).abs() < 1e-8 && (found[1] - y).abs() < 1e-12
}

/// Both folds of the paper's model, at both ends of the band of velocities.
#[test]
fn the_folds_of_the_papers_model_are_those_of_an_independent_code() {
    let found = only(&parse(BAND));
    let mut folds: Vec<[[f64; 2]; 2]> = found.curves.iter().map(ends).collect();
    assert!(found.curves.iter().all(|curve| curve.special == Special::Fold) && found.alone.is_empty());
    folds.sort_by(|a, b| a[0][0].total_cmp(&b[0][0]));
    let [lower, upper] = folds[..] else { panic!("{folds:?}") };
    let known = [[0.075_381_729, 0.129_773_693_5], [0.343_427_415, 0.302_106_307_6]];
    for (fold, [at_three, at_four]) in [lower, upper].into_iter().zip(known) {
        assert!(is(fold[0], [at_three, 3.0]) && is(fold[1], [at_four, 4.0]), "{fold:?}");
        assert!(!is(fold[0], [at_three + 2e-8, 3.0]), "the comparer sees a fold that is elsewhere");
    }
    // Each point of a curve has a cycle there, with a multiplier of +1.
    for point in found.curves.iter().flat_map(|curve| &curve.points) {
        let outcome = point.cycle.record.outcome.as_ref().unwrap();
        assert!(
            (outcome.floquet.unwrap() - 1.0).abs() < 2e-5 && outcome.floquet_angle == Some(0.0),
            "{point:?}"
        );
    }
}

/// The stick-slip of the single mass ends at a corner, by steps of Runge and Kutta; the equilibrium loses its stability at
/// `V = v0 ln((μ_s − μ_d) N/(c v0))`.
#[test]
fn the_curves_of_the_single_mass_are_its_closed_forms() {
    let found = only(&parse(SINGLE));
    let of = |special: Special| {
        let mut curves = found.curves.iter().filter(|curve| curve.special == special);
        (curves.next().unwrap(), curves.count())
    };
    let (corner, others) = of(Special::Corner);
    assert_eq!((found.curves.len(), others, found.alone.len()), (2, 0, 0));
    let [low, high] = ends(corner);
    let middle = corner.points[corner.points.len() / 2].values;
    for values in [low, high, middle] {
        let end = last_velocity_of_the_cycle(values[1]);
        assert!(is(values, [end, values[1]]), "{values:?}: {end}");
        assert!(!is(values, [end + 2e-8, values[1]]));
    }
    let (hopf, _) = of(Special::Hopf);
    let [low, high] = ends(hopf);
    assert!((low[1] - 0.1).abs() < 1e-12 && (high[1] - 0.15).abs() < 1e-12);
    for point in &hopf.points {
        let [velocity, damping] = point.values;
        let known = 0.5 * (0.5 / (damping * 0.5)).ln();
        assert!(is([velocity, damping], [known, damping]), "{velocity}: {known}");
    }
}

/// Files, figure, the same figure by `plot`, and the lines over the map of the sweep; what does not fit is refused.
#[test]
fn the_program_draws_the_curves_alone_and_over_a_map() {
    let directory = with(BAND);
    let run = |arguments: &[&str]| squealmap(directory.path(), arguments);
    let ended = run(&["curves", "s.toml", "--lines", "2", "-o", "curves"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let said = " points, from mu_d = 0.343427, belt_velocity = 3 to mu_d = 0.302106, belt_velocity = 4\n";
    assert!(ended.out.contains("a curve of folds, ") && ended.out.contains(said), "{}", ended.out);
    let folder = directory.path().join("curves");
    let read = |name: &str| String::from_utf8(std::fs::read(folder.join(name)).unwrap()).unwrap();
    let drawn = || Picture::read(&folder, Kind::Curves).and_then(|picture| picture.svg(&Look::default()));
    let svg = drawn().unwrap();
    assert!(svg == read("curves.svg"));
    assert_eq!(svg.matches("class=\"fold\"").count(), 2 + 1, "two curves and the legend");
    let table = read("curves.csv");
    assert!(table.starts_with("curve,special,unstable_multipliers,mu_d,belt_velocity,type,"));
    // A table, and a document, that were changed since.
    for (name, from, to) in
        [("curves.csv", "\n0,fold,0,", "\n0,fold,1,"), ("curves.json", "\"bilinear\"", "\"bilinear \"")]
    {
        let whole = read(name);
        let changed = whole.replacen(from, to, 1);
        assert!(changed != whole, "{name}");
        std::fs::write(folder.join(name), changed).unwrap();
        let error = drawn().unwrap_err().to_string();
        assert!(error.contains(name) && error.contains("run `squealmap curves` again"), "{error}");
        std::fs::write(folder.join(name), whole).unwrap();
    }

    assert_eq!(run(&["run", "s.toml", "-o", "map"]).code, Some(0));
    let ended = run(&["plot", "map", "--curves", "curves", "--quantity", "regime,floquet", "-o", "over"]);
    assert_eq!(ended.code, Some(2), "without `settle = \"cycle\"` there is no such column");
    let ended = run(&["plot", "map", "--curves", "curves", "--quantity", "regime,x2_std", "-o", "over"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let over = std::fs::read_to_string(directory.path().join("over/plot.svg")).unwrap();
    assert_eq!(over.matches("class=\"fold\"").count(), 2 * (2 + 1), "two blocks");
    assert!(over.contains("--curves curves"), "the command that draws it again");

    // Another system; another plane; no map.
    let refused = |name: &str, text: &str, part: &str| {
        let sweep = format!("{name}.toml");
        std::fs::write(directory.path().join(&sweep), text).unwrap();
        assert_eq!(run(&["run", &sweep, "-o", name]).code, Some(0));
        let ended = run(&["plot", name, "--curves", "curves"]);
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        assert!(ended.err.contains(part), "{}", ended.err);
    };
    refused("steep", &BAND.replace("theta = 0.01", "theta = 0.02"), "`model` differs");
    let plane = BAND.replace("mu_d = { from = 0.0, to = 0.6, points = 5 }", "mu_d = { values = [0.1] }");
    refused("line", &plane, "no curve in `curves` lies in a plane that the figure shows");
    let ended = run(&["plot", "curves", "--curves", "curves"]);
    assert!(ended.code == Some(2) && ended.err.contains("--curves"), "{}", ended.err);
}

#[test]
fn what_has_no_plane_is_named() {
    for (text, part) in [
        (
            BAND.replace(
                "belt_velocity = { from = 3.0, to = 4.0, points = 5 }",
                "belt_velocity = { values = [3] }",
            ),
            "curves needs two axes of numbers",
        ),
        (
            BAND.replace(
                "belt_velocity = { from = 3.0, to = 4.0, points = 5 }\n",
                "start_velocity = { from = 0.1, to = 1.0, points = 5 }\n[belt]\nbelt_velocity = 3\n",
            ),
            "`start_velocity` as an axis, along which no cycle can be followed",
        ),
    ] {
        let directory = with(&text);
        let ended = squealmap(directory.path(), &["curves", "s.toml"]);
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        assert!(ended.err.contains(part), "{}", ended.err);
        assert!(!directory.path().join("out").exists());
    }
}
