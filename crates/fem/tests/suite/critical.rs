//! Where modes coalesce that have others near them, at the end of those that are followed, and in bodies with symmetry. Expected values come
//! from finite elements of another author, in numpy: bisection between eigenvalues of the whole problem.

use squealmap_fem::study::document::Document;
use squealmap_fem::study::{Event, Outcome, Study};

use crate::cases::{block, outcome, slides, support};

/// μ and Hz of each coalescence; nothing else happens.
fn met(outcome: &Outcome) -> Vec<[f64; 2]> {
    assert_eq!(outcome.remarks, Vec::<String>::new());
    let coalesces = |t: &squealmap_fem::study::Transition| {
        assert_eq!(t.event, Event::Coalescence);
        [t.mu, t.frequency]
    };
    outcome.transitions.iter().map(coalesces).collect()
}

/// Two blocks of two bricks and three, clamped at their ends.
fn blocks(values: &str, count: usize) -> String {
    let bodies = [
        block("u", "hex20", [[0.01, 0.0, 0.0], [0.009, 0.009, 0.02]], [1, 1, 2], "a"),
        block("l", "hex20", [[0.001, 0.0, -0.008], [0.027, 0.009, 0.008]], [3, 1, 1], "b"),
        support("u.z1", "xyz"),
        support("l.z0", "xyz"),
        slides("u.z0", "l.z1", [1.0, 0.0, 0.0]),
    ]
    .concat();
    format!(
        r"
        {bodies}
        [materials.a]
        young = 6.5e9
        poisson = 0.2
        density = 1800.0
        [materials.b]
        young = 70e9
        poisson = 0.3
        density = 2700.0
        [friction]
        mu = {{ {values} }}
        [modes]
        count = {count}
        "
    )
}

/// Two pairs within 4 % of each other's frequency, one of which grows from a low friction on: whatever values of μ are taken, and however many modes
/// are followed, each is found where it is.
#[test]
fn a_pair_beside_another_is_followed_to_its_own_place() {
    let fine = "from = 0.0, to = 0.8, points = 9";
    for (values, count) in
        [("values = [0.0, 0.3, 0.4, 0.8]", 20), ("values = [0.0, 0.3, 0.4, 0.8]", 17), (fine, 17), (fine, 16)]
    {
        let found = met(&outcome(&blocks(values, count)));
        let [first, second] = found.as_slice() else { panic!("{values}, {count}: {found:?}") };
        assert!(
            (first[0] - 0.047_43).abs() < 2e-5 && (second[0] - 0.649_36).abs() < 1e-5,
            "{values}, {count}: {found:?}"
        );
        assert!((second[1] / 95_044.7 - 1.0).abs() < 1e-6, "{found:?}");
    }
    // Of the second pair only one is followed.
    let found = met(&outcome(&blocks(fine, 13)));
    assert!(found.iter().any(|[mu, _]| (mu - 0.649_36).abs() < 1e-5), "{found:?}");
}

/// A block from the origin on two rigid planes, along each of which it slides in a direction; and what else there is.
fn guided(size: &str, cells: &str, material: &str, [first, second]: [(&str, &str); 2], rest: &str) -> String {
    let slides = |(side, direction): (&str, &str)| {
        format!("[[sliding]]\nslaves = \"p.{side}\"\nmasters = \"rigid\"\ndirection = {direction}\n")
    };
    format!(
        "[parts.p]\nkind = \"block\"\nelement = \"hex20\"\norigin = [0.0, 0.0, 0.0]\nsize = {size}\ncells = {cells}\nmaterial = \"a\"\n\
         [materials.a]\n{material}\n{}{}{rest}",
        slides(first),
        slides(second)
    )
}

/// A block in a guide of two rigid planes, pressed on both: what one plane carries does not become part of the other along their edge. Two equal
/// pairs meet at one place, as its two transverse directions are alike.
#[test]
fn surfaces_with_an_edge_in_common_are_two() {
    let guide = |friction: &str| {
        let along = "[1.0, 0.0, 0.0]";
        let rest = format!(
            "[[supports]]\nset = \"p.x1\"\naxes = \"x\"\n[[loads]]\nset = \"p.z1\"\npressure = 1e6\n[[loads]]\nset = \"p.y1\"\npressure = 1e6\n\
             [friction]\nmu = {{ values = [0.0, 0.3, 0.6, 1.0] }}\n{friction}\n[modes]\ncount = 10\n"
        );
        let material = "young = 26e9\npoisson = 0.0\ndensity = 1800.0";
        guided("[0.02, 0.01, 0.01]", "[2, 1, 1]", material, [("z0", along), ("y0", along)], &rest)
    };
    let pressed = outcome(&guide(""));
    assert_eq!(pressed.pressed.as_ref().map(|pressed| pressed.open), Some(0));
    let has = |outcome: &Outcome, frequency: f64| {
        let near = |mode: &squealmap_fem::sweep::Mode| {
            (mode.states[0].lambda.im / std::f64::consts::TAU / frequency - 1.0).abs() < 1e-5
        };
        outcome.modes.iter().filter(|mode| near(mode)).count()
    };
    assert_eq!(has(&pressed, 95_371.0), 2, "{:?}", pressed.real);
    let found = met(&pressed);
    assert!(found.len() == 2 && found.iter().all(|[mu, _]| (mu - 0.635_219).abs() < 1e-6), "{found:?}");
    let stiff = outcome(&guide("contact_stiffness = 1e14"));
    assert_eq!(has(&stiff, 92_903.0), 2, "{:?}", stiff.real);
    let falling = outcome(&guide("slope = -0.05"));
    let growth =
        |at: usize| falling.modes.iter().map(|mode| mode.states[at].lambda.re).fold(f64::MIN, f64::max);
    assert!(
        (growth(0) / 2778.0 - 1.0).abs() < 1e-4 && (growth(1) / 2635.46 - 1.0).abs() < 1e-4,
        "{}, {}",
        growth(0),
        growth(1)
    );
    // Surfaces that lie in one plane have no edge of two.
    let both = guide("").replace(r#"slaves = "p.y0""#, r#"slaves = "p.z0""#);
    let error = Study::new(Document::read(&both).expect("a description"), &|_| Err(String::new())).map(drop);
    let error = error.expect_err("one surface twice").to_string();
    assert!(error.contains("sliding[1].slaves") && error.contains("at right angles"), "{error}");
}

/// Bodies on one side of their contact would lie in each other.
#[test]
fn surfaces_that_face_the_same_way_are_refused() {
    let text = blocks("values = [0.0]", 4)
        .replace(r#""l.z1""#, r#""l.z0""#)
        .replace("[0.001, 0.0, -0.008]", "[0.001, 0.0, 0.0]");
    let error = Study::new(Document::read(&text).expect("a description"), &|_| Err(String::new())).map(drop);
    let error = error.expect_err("two bodies in one place").to_string();
    assert!(error.contains("face the same way"), "{error}");
}

/// A cube between two planes at right angles, along which it slides in two directions: a pair that couples weakly is found where it is by any
/// values of μ, also where its growth is next to nothing at some of them; and the other way round it jams at μ = 1, as a rigid body does.
#[test]
fn a_weak_pair_and_a_jam_are_where_they_are() {
    let cube = |values: &str, along: &str| {
        let rest = format!(
            "[[supports]]\nset = \"p.y0\"\naxes = \"y\"\n[friction]\nmu = {{ {values} }}\ncontact_stiffness = 1e11\n[modes]\ncount = 8\n"
        );
        let material = "young = 2.1e11\npoisson = 0.3\ndensity = 7850.0";
        let slides = [("z0", along), ("x0", "[0.0, 0.0, -1.0]")];
        guided("[0.02, 0.02, 0.02]", "[2, 2, 2]", material, slides, &rest)
    };
    let weak = |values: &str| {
        let found = met(&outcome(&cube(values, "[1.0, 0.0, 0.0]")));
        let pair = found.iter().find(|[_, frequency]| (frequency / 42_380.5 - 1.0).abs() < 1e-4);
        pair.expect("a weak pair")[0]
    };
    let coarse = weak("values = [0.0, 0.0006, 0.01]");
    // Growth squared over μ, by the eigenvalues at 0.0007 and 0.001, is a straight line to 0 there.
    assert!((coarse - 6.6e-4).abs() < 1e-5, "{coarse}");
    assert!((weak("values = [0.0, 0.0006, 0.0007, 0.001]") - coarse).abs() < 1e-8);
    let jam = outcome(&cube("from = 0.0, to = 1.6, points = 9", "[-1.0, 0.0, 0.0]")).transitions;
    assert!(jam.iter().any(|t| t.event == Event::Divergence && (t.mu - 1.0).abs() < 1e-6), "{jam:?}");
}
