//! Orders of elimination.

use squealmap_fem::assembly::assemble;
use squealmap_fem::elements::Kind;
use squealmap_fem::modes::{Factor, Ordering, lowest};

use crate::cases::{brake, pin};

/// The thick pin is parted by planes with fewer entries than by minimum degree, and the frequencies do not change. Whatever the body, the
/// better one is taken.
#[test]
fn dissection_saves_entries_in_thick_bodies() {
    for (model, thick) in [
        (pin::model(Kind::Hex20, 3).expect("the pin"), true),
        (brake::model(Kind::Hex8, [7, 60, 2]).expect("a brake"), false),
    ] {
        let (numbering, pencil) = assemble(&model).expect("matrices");
        let pattern = &pencil.stiffness.pattern;
        let places = numbering.places(&model.mesh);
        let degree = Ordering::new(pattern).expect("an order");
        let parted = Ordering::dissected(pattern, &places).expect("an order");
        println!(
            "{} unknowns: {} entries by degree, {} parted",
            pencil.size(),
            degree.entries(),
            parted.entries()
        );
        assert_eq!(thick, (parted.entries() as f64) < 0.9 * degree.entries() as f64);
        let best = Ordering::best(pattern, &places).expect("an order");
        assert_eq!(best.entries(), parted.entries().min(degree.entries()));
        let [a, b] = [&degree, &parted].map(|ordering| {
            let factor = Factor::new(ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
            lowest(&pencil, &factor, 5).expect("real modes").frequencies()
        });
        assert!(a.iter().zip(&b).all(|(a, b)| (a / b - 1.0).abs() < 1e-9), "{a:?} {b:?}");
    }
}

/// Each unknown lies at a node of the mesh, none at another's.
#[test]
fn unknowns_lie_at_their_nodes() {
    let model = pin::model(Kind::Hex20, 1).expect("the pin");
    let (numbering, _) = assemble(&model).expect("matrices");
    for (unknown, place) in numbering.places(&model.mesh).iter().enumerate() {
        let mut q = vec![0.0; numbering.unknowns];
        q[unknown] = 1.0;
        let moved = numbering.spread(&q);
        let at = model.mesh.nodes_where(|x| (0..3).all(|i| (x[i] - place[i]).abs() < 1e-12));
        assert!(at.iter().any(|node| moved[*node].iter().any(|u| (u - 1.0).abs() < 1e-12)), "{unknown}");
    }
}

#[test]
fn an_order_names_each_unknown_once() {
    let (_, pencil) = assemble(&pin::model(Kind::Hex8, 1).expect("the pin")).expect("matrices");
    let size = pencil.size();
    for order in [vec![0; size], (1..size).collect(), (1..=size).collect()] {
        let error = Ordering::given(&pencil.stiffness.pattern, &order).expect_err("no order").to_string();
        assert!(error.contains(&format!("each of the {size} unknowns once")), "{error}");
    }
}
