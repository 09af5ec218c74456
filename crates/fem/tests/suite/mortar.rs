//! Surfaces whose nodes do not match.

use squealmap_fem::assembly::{Loads, Model, Supports, internal_forces};
use squealmap_fem::contact::{mortar, rotating};
use squealmap_fem::elements::Kind;
use squealmap_fem::mesh::Block;
use squealmap_fem::statics::settle;

use crate::cases::{pin, steel};

/// Two blocks of different meshes and kinds on each other, in sliding contact, the upper one smaller.
fn stack(lower: Kind, upper: Kind) -> Model {
    let below =
        Block { origin: [0.0; 3], size: [2.0, 1.0, 1.0], cells: [5.into(), 3.into(), 2.into()], kind: lower };
    let above = Block {
        origin: [0.3, 0.1, 1.0],
        size: [1.2, 0.7, 0.9],
        cells: [4.into(), 2.into(), 2.into()],
        kind: upper,
    };
    let mut mesh = below.mesh().expect("a block");
    mesh.add(above.mesh().expect("a block"), "up.", 0);
    let faces = |name: &str| mesh.face_set(name).expect("a side");
    let contact =
        mortar(&mesh, faces("up.z0"), faces("z1"), [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]).expect("a contact");
    Model { mesh, materials: vec![steel()], contact, ..Model::default() }
}

const PAIRS: [(Kind, Kind); 5] = [
    (Kind::Hex8, Kind::Hex8),
    (Kind::Hex20, Kind::Hex20),
    (Kind::Tet10, Kind::Hex20),
    (Kind::Hex20, Kind::Tet10),
    (Kind::Tet4, Kind::Wedge15),
];

/// Weights of the masters reproduce every linear field at every slave.
#[test]
fn a_linear_field_passes_through() {
    for (lower, upper) in PAIRS {
        let model = stack(lower, upper);
        let field = |x: [f64; 3]| 1.0 + 0.7 * x[0] - 0.4 * x[1];
        for point in &model.contact {
            let sum: f64 = point.masters.iter().map(|(node, w)| w * field(model.mesh.nodes[*node])).sum();
            let exact = field(model.mesh.nodes[point.slave]);
            assert!((sum - exact).abs() < 1e-11, "{} on {}: {sum} {exact}", upper.name(), lower.name());
        }
    }
}

/// A body under uniform pressure on another, larger one: the pressures sum up to the load, every node is in equilibrium, and where
/// both are as large the pressure is uniform.
#[test]
fn a_constant_pressure_passes_through() {
    for (lower, upper) in PAIRS {
        let below = Block {
            origin: [0.0; 3],
            size: [2.0, 1.0, 1.0],
            cells: [5.into(), 3.into(), 2.into()],
            kind: lower,
        };
        let above = Block {
            origin: [0.0, 0.0, 1.0],
            size: [2.0, 1.0, 0.9],
            cells: [4.into(), 2.into(), 2.into()],
            kind: upper,
        };
        let mut mesh = below.mesh().expect("a block");
        mesh.add(above.mesh().expect("a block"), "up.", 0);
        let faces = |name: &str| mesh.face_set(name).expect("a side").to_vec();
        let (slaves, top) = (faces("up.z0"), faces("up.z1"));
        let contact =
            mortar(&mesh, &slaves, &faces("z1"), [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]).expect("a contact");
        let mut supports = Supports::default();
        for (axis, name) in [(0, "x0"), (1, "y0"), (2, "z0"), (0, "up.x0"), (1, "up.y0")] {
            supports.prescribe(mesh.node_set(name).expect("a side"), axis, 0.0);
        }
        let model = Model { mesh, materials: vec![steel()], contact, supports, ..Model::default() };
        let loads = Loads { pressure: vec![(top, 1e6)], ..Loads::default() };
        let settled = settle(&model, &slaves, &loads, 0.0).expect("settled blocks");
        for (x, u) in model.mesh.nodes.iter().zip(&settled.displacement) {
            let strain = 1e6 / 210e9;
            let exact = [0.3 * strain * x[0], 0.3 * strain * x[1], -strain * x[2]];
            for i in 0..3 {
                assert!(
                    (u[i] - exact[i]).abs() < 1e-15,
                    "{} on {}: {u:?} {exact:?}",
                    upper.name(),
                    lower.name()
                );
            }
        }
        for pressure in &settled.pressures {
            assert!((pressure / 1e6 - 1.0).abs() < 1e-9, "{pressure} Pa");
        }
    }
}

/// Friction between meshes that do not match is in equilibrium: −μ N on the slaves, its weighted opposite on the masters.
#[test]
fn friction_is_in_equilibrium() {
    let mu = 0.3;
    let mut model = stack(Kind::Hex20, Kind::Tet10);
    model.supports.clamp(model.mesh.node_set("z0").expect("a side"));
    let top = model.mesh.node_set("up.z1").expect("a side").to_vec();
    model.supports.clamp(&top);
    model.supports.prescribe(&top, 2, -1e-5);
    let slaves = model.mesh.face_set("up.z0").expect("a side").to_vec();
    let settled = settle(&model, &slaves, &Loads::default(), mu).expect("settled blocks");
    let held = internal_forces(&settled.model, &settled.displacement).expect("forces");
    let mut wanted = vec![[0.0; 3]; held.len()];
    for (point, n) in settled.model.contact.iter().zip(&settled.forces) {
        for (i, force) in [-mu * n, 0.0, *n].into_iter().enumerate() {
            wanted[point.slave][i] += force;
            for (master, w) in &point.masters {
                wanted[*master][i] -= w * force;
            }
        }
    }
    let total: f64 = settled.forces.iter().sum();
    for node in 0..held.len() {
        let supported = model.supports.prescribed.contains_key(&(node, 2));
        for i in 0..3 {
            let left = held[node][i] - wanted[node][i];
            assert!(supported || left.abs() < 1e-8 * total, "node {node}: {left} N of {total} N");
        }
    }
}

/// Where the nodes match, mortar is the same as tying them one by one.
#[test]
fn matching_nodes_are_tied_one_by_one() {
    let model = pin::model(Kind::Hex20, 1).expect("the pin");
    let faces = |name: &str| model.mesh.face_set(name).expect("a side");
    let points = mortar(&model.mesh, faces("pin.z0"), faces("z1"), [0.0, 0.0, 1.0], [1.0, 0.0, 0.0])
        .expect("a contact");
    assert_eq!(points.len(), model.contact.len());
    for point in &points {
        let partner =
            model.contact.iter().find(|p| p.slave == point.slave).expect("the same slave").masters[0].0;
        for (master, weight) in &point.masters {
            let expected = if *master == partner { 1.0 } else { 0.0 };
            assert!((weight - expected).abs() < 1e-11, "{point:?}");
        }
    }
}

/// On a disc the slaves slide along circles about its axis; a wrong axis leaves the surface.
#[test]
fn a_disc_turns_about_its_axis() {
    let model = stack(Kind::Hex8, Kind::Hex8);
    let (origin, axis) = ([0.9, -0.5, 7.0], [0.0, 0.0, 3.0]);
    let points = rotating(&model.mesh, model.contact.clone(), origin, axis).expect("a disc");
    for point in &points {
        let x = model.mesh.nodes[point.slave];
        let r = [x[0] - origin[0], x[1] - origin[1]];
        let length = r[0].hypot(r[1]);
        let exact = [-r[1] / length, r[0] / length, 0.0];
        assert!((0..3).all(|i| (point.direction[i] - exact[i]).abs() < 1e-12), "{point:?}");
    }
    let error = rotating(&model.mesh, model.contact.clone(), origin, [1.0, 0.0, 0.0]).map(drop);
    assert!(
        error
            .expect_err("a wrong axis")
            .to_string()
            .starts_with("the direction of sliding leaves the surface")
    );
}
