//! Contact by a stiffness.

use squealmap_fem::assembly::{Loads, Model, Penalty, Rows, assemble};
use squealmap_fem::contact::sliding_on_rigid;
use squealmap_fem::elements::Kind;
use squealmap_fem::mesh::Block;
use squealmap_fem::modes::{Basis, Factor, Ordering, lowest, pairs, refine};
use squealmap_fem::statics::settle;

use crate::cases::{pin, steel};

/// A block under pressure p sinks by p/k into a plane of contact stiffness k, and its forces sum to the load.
#[test]
fn a_block_sinks_by_pressure_over_stiffness() {
    let (pressure, stiffness) = (1e6, 4e12);
    for kind in [Kind::Hex8, Kind::Hex20, Kind::Tet10] {
        let cells = [3.into(), 2.into(), 2.into()];
        let mesh = Block { origin: [0.0; 3], size: [2.0, 1.0, 1.5], cells, kind }.mesh().expect("a block");
        let set = |name| mesh.node_set(name).expect("a side").to_vec();
        let faces = |name| mesh.face_set(name).expect("a side").to_vec();
        let contact = sliding_on_rigid(&set("z0"), [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]).expect("a plane");
        let mut model = Model { materials: vec![steel()], contact, ..Model::default() };
        model.supports.prescribe(&set("x0"), 0, 0.0);
        model.supports.prescribe(&set("y0"), 1, 0.0);
        model.penalty = Some(Penalty { stiffness, faces: faces("z0") });
        let loads = Loads { pressure: vec![(faces("z1"), pressure)], ..Loads::default() };
        let slaves = faces("z0");
        model.mesh = mesh.clone();
        let settled = settle(&model, &slaves, &loads, 0.0).expect("a settled block");
        for (x, u) in model.mesh.nodes.iter().zip(&settled.displacement) {
            let exact = -pressure / stiffness - pressure / 210e9 * x[2];
            assert!((u[2] - exact).abs() < 1e-14, "{}: {} {exact}", kind.name(), u[2]);
        }
        let total: f64 = settled.forces.iter().sum();
        assert!((total - 2e6).abs() < 1e-3, "{}: {total} N", kind.name());
    }
}

/// With a stiffness that grows, complex eigenvalues come to those of multipliers, ten times nearer for ten times the stiffness.
#[test]
fn a_high_stiffness_comes_to_multipliers() {
    let mu = 0.4;
    let solve = |stiffness: Option<f64>| {
        let mut model = pin::model(Kind::Hex20, 1).expect("the pin");
        let faces = model.mesh.face_set("pin.z0").expect("a side").to_vec();
        model.penalty = stiffness.map(|stiffness| Penalty { stiffness, faces });
        let (_, pencil) = assemble(&model).expect("matrices");
        let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
        let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
        let modes = lowest(&pencil, &factor, 20).expect("real modes");
        let mut basis = Basis::new(&pencil, &modes.shapes);
        let none = Rows::default();
        refine(&pencil, &factor, &mut basis, &[mu], &none, 5, 1e-9, 30).expect("a space");
        let found = pairs(&basis.at(mu, &none)).expect("complex modes");
        found[..5].iter().map(|pair| pair.lambda).collect::<Vec<_>>()
    };
    let tied = solve(None);
    let errors = [1e16, 1e17].map(|stiffness| {
        let found = solve(Some(stiffness));
        found.iter().zip(&tied).map(|(a, b)| (a - b).norm() / b.norm()).collect::<Vec<f64>>()
    });
    for (a, b) in errors[0].iter().zip(&errors[1]) {
        assert!(*a < 1e-2 && (8.0..12.0).contains(&(a / b)), "{errors:?}");
    }
}
