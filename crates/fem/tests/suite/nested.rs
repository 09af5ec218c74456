//! Surfaces of which one has nodes between those of the other.

use squealmap_fem::study::document::Document;
use squealmap_fem::study::{Study, compute};

/// Two halves of a column of 0.1 m under 1 MPa, without a Poisson's ratio, with other meshes where they meet.
fn column(lower: (&str, usize), upper: (&str, usize), meet: &str) -> Study {
    let part = |name: &str, (element, cells): (&str, usize), z: f64| {
        format!(
            "[parts.{name}]\nkind = \"block\"\nelement = \"{element}\"\norigin = [0.0, 0.0, {z}]\nsize = [0.02, 0.02, 0.05]\n\
             cells = [{cells}, {cells}, 4]\nmaterial = \"steel\"\n"
        )
    };
    let hold = |set: &str, axes: &str| format!("[[supports]]\nset = \"{set}\"\naxes = \"{axes}\"\n");
    let text = part("lower", lower, 0.0)
        + &part("upper", upper, 0.05)
        + "[materials.steel]\nyoung = 2.1e11\npoisson = 0.0\ndensity = 7800.0\n"
        + &["lower", "upper"]
            .iter()
            // Nodes that are tied to others are not held.
            .filter(|part| !meet.starts_with(&format!("[[bonds]]\nslaves = \"{part}")))
            .map(|part| hold(&format!("{part}.x0"), "x") + &hold(&format!("{part}.y0"), "y"))
            .collect::<String>()
        + &hold("upper.z1", "xy")
        + "[[loads]]\nset = \"upper.z1\"\npressure = 1e6\n"
        + "[[sliding]]\nslaves = \"lower.z0\"\nmasters = \"rigid\"\ndirection = [0.0, 1.0, 0.0]\n"
        + meet
        + "[friction]\nmu = { values = [0.0] }\n[modes]\ncount = 3\n";
    Study::new(Document::read(&text).expect("a description"), &|path| Err(format!("{path} is no file")))
        .expect("a study")
}

/// The column is shortened by p L/E, whichever side the slaves are on; pairs of nodes alone leave what lies between them free.
#[test]
fn nodes_between_those_of_the_other_side_are_tied_as_well() {
    let bond =
        |slaves: &str, masters: &str| format!("[[bonds]]\nslaves = \"{slaves}\"\nmasters = \"{masters}\"\n");
    let slide = |slaves: &str, masters: &str| {
        format!("[[sliding]]\nslaves = \"{slaves}\"\nmasters = \"{masters}\"\ndirection = [0.0, 1.0, 0.0]\n")
    };
    let (below, above) = ("lower.z1", "upper.z0");
    for (lower, upper, meet) in [
        (("hex8", 1), ("hex8", 4), bond(below, above)),
        (("hex8", 1), ("hex8", 4), bond(above, below)),
        (("hex20", 1), ("hex20", 2), bond(below, above)),
        (("hex8", 2), ("hex20", 2), bond(below, above)),
        (("hex8", 1), ("hex8", 4), slide(below, above)),
        (("hex8", 1), ("hex8", 4), slide(above, below)),
        (("hex8", 2), ("hex8", 2), slide(above, below)),
    ] {
        let study = column(lower, upper, &meet);
        let outcome = compute(&study, &mut |_| ()).expect("results");
        let pressed = outcome.pressed.expect("a static step");
        let nodes = study.model.mesh.nodes.iter().zip(&pressed.displacement);
        let exact = 1e6 * 0.1 / 2.1e11;
        for (x, u) in nodes.filter(|(x, _)| x[2] > 0.1 - 1e-9) {
            assert!((u[2] / -exact - 1.0).abs() < 1e-8, "{lower:?} {upper:?} {meet} {x:?}: {u:?}");
        }
        if meet.contains("sliding") {
            assert_eq!(study.matching, [true, lower.1 == upper.1]);
            // √(E/ρ)/4L, but for the mesh.
            let first = outcome.real[0] / 12_971.8 - 1.0;
            assert!(first.abs() < 0.005, "{meet}: {first}");
        }
    }
}
