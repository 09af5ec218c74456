//! Contact by a stiffness.

use squealmap_fem::assembly::{Loads, Model, Penalty, Rows, assemble};
use squealmap_fem::contact::{mortar, overhangs, sliding_on_rigid};
use squealmap_fem::elements::Kind;
use squealmap_fem::mesh::Block;
use squealmap_fem::modes::{Basis, Factor, Ordering, lowest, pairs, refine};
use squealmap_fem::statics::settle;

use crate::cases::{block, outcome, pin, slides, steel, support};

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

/// A stiff pad that hangs over both edges of what it lies on sinks by the force over the area that both share, wherever the edges of its elements are.
#[test]
fn what_hangs_over_does_not_press() {
    let stiffness = 1e9;
    for (kind, cells) in
        [(Kind::Hex8, 1), (Kind::Hex8, 3), (Kind::Hex8, 4), (Kind::Hex8, 8), (Kind::Hex20, 3)]
    {
        let block = |origin, size, cells: [usize; 3]| {
            Block { origin, size, cells: cells.map(Into::into), kind }.mesh().expect("a block")
        };
        let mut model = Model { materials: vec![steel()], ..Model::default() };
        model.mesh = block([0.0, 0.0, -0.01], [0.01, 0.01, 0.01], [2, 2, 1]);
        model.mesh.add(block([-0.005, 0.0, 0.0], [0.02, 0.01, 0.01], [cells, 1, 1]), "pad.", 0);
        let faces = |model: &Model, name| model.mesh.face_set(name).expect("a side").to_vec();
        let [slaves, masters, top] = ["pad.z0", "z1", "pad.z1"].map(|name| faces(&model, name));
        let normal = [0.0, 0.0, 1.0];
        model.contact = mortar(&model.mesh, &slaves, &masters, normal, [1.0, 0.0, 0.0]).expect("a contact");
        model.partly = overhangs(&model.mesh, &slaves, &masters, normal);
        model.penalty = Some(Penalty { stiffness, faces: slaves.clone() });
        model.supports.clamp(model.mesh.node_set("z0").expect("a side"));
        for (node, _) in model.mesh.nodes.clone().iter().enumerate().filter(|(_, x)| x[2] >= 0.0) {
            let lower = model.mesh.node_set("z1").expect("a side").contains(&node);
            if !lower {
                model.supports.prescribe(&[node], 0, 0.0);
                model.supports.prescribe(&[node], 1, 0.0);
            }
        }
        let loads = Loads { pressure: vec![(top, 5e4)], ..Loads::default() };
        let settled = settle(&model, &slaves, &loads, 0.0).expect("a settled pad");
        let total: f64 = settled.forces.iter().sum();
        assert!((total - 10.0).abs() < 1e-9, "{cells}: {total} N");
        let pad = model.mesh.node_set("pad.z1").expect("a side");
        let sinks = -pad.iter().map(|node| settled.displacement[*node][2]).sum::<f64>() / pad.len() as f64;
        let exact = 10.0 / (stiffness * 1e-4);
        assert!((sinks / exact - 1.0).abs() < 1e-3, "{cells}: {sinks} {exact}");
    }
}

/// A pad on two rails, whose faces lie on one of them each, or between both.
fn pad_on_rails(friction: &str, gap: f64) -> Vec<f64> {
    let along = [1.0, 0.0, 0.0];
    let bodies = [
        block("pad", "hex20", [[0.0; 3], [0.05, 0.01, 0.01]], [5, 1, 1], "a"),
        block("l", "hex8", [[0.0, 0.0, -0.01], [0.01 + gap, 0.01, 0.01]], [2, 2, 1], "a"),
        block("r", "hex8", [[0.04, 0.0, -0.01], [0.01, 0.01, 0.01]], [2, 2, 1], "a"),
        support("pad.z1", "xy"),
        support("l.z0", "xyz"),
        support("r.z0", "xyz"),
        slides("pad.z0", "l.z1", along),
        slides("pad.z0", "r.z1", along),
    ]
    .concat();
    let text = format!(
        r"
        {bodies}
        [materials.a]
        young = 70e9
        poisson = 0.3
        density = 2700.0
        [friction]
        mu = {{ values = [0.0] }}
        {friction}
        [modes]
        count = 4
        "
    );
    outcome(&text).real[..4].to_vec()
}

/// A face that lies on the masters of one of two pairs presses there, and a high stiffness comes to multipliers; a rail that reaches a five-hundredth into the
/// next face changes next to nothing.
#[test]
fn faces_of_two_pairs_press_where_they_lie() {
    // On a soft contact the pad bounces as a mass on the area of both rails.
    let bounces = f64::sqrt(1e10 * 2e-4 / (2700.0 * 5e-6)) / std::f64::consts::TAU;
    let soft = pad_on_rails("contact_stiffness = 1e10", 0.0);
    assert!(soft.iter().any(|found| (found / bounces - 1.0).abs() < 5e-3), "{soft:?} {bounces}");
    let tied = pad_on_rails("", 0.0);
    for (a, b) in tied.iter().zip(pad_on_rails("contact_stiffness = 1e17", 0.0)) {
        assert!((a / b - 1.0).abs() < 1e-2, "{a} {b}");
    }
    for (a, b) in tied.iter().zip(pad_on_rails("", 2e-5)) {
        assert!((a / b - 1.0).abs() < 5e-3, "{a} {b}");
    }
}
