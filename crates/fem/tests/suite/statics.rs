//! The static step: pressures, friction, gaps.

use squealmap_fem::assembly::{Loads, Model, internal_forces, nodal_forces};
use squealmap_fem::contact::sliding_on_rigid;
use squealmap_fem::elements::Kind;
use squealmap_fem::mesh::Block;
use squealmap_fem::statics::settle;

use crate::cases::{pin, steel};
use crate::elements::KINDS;

fn on_plane(kind: Kind, size: [f64; 3], cells: [usize; 3]) -> Model {
    let block = Block { origin: [0.0; 3], size, cells: cells.map(Into::into), kind };
    let mesh = block.mesh().expect("a block");
    let slaves = mesh.node_set("z0").expect("a side").to_vec();
    let contact = sliding_on_rigid(&slaves, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]).expect("a plane");
    Model { mesh, materials: vec![steel()], contact, ..Model::default() }
}

/// A block pressed on a plane without friction has that pressure everywhere, and the forces sum to the load.
#[test]
fn a_uniform_load_makes_a_uniform_pressure() {
    for kind in KINDS {
        let mut model = on_plane(kind, [2.0, 1.0, 1.5], [3, 2, 2]);
        for (axis, name) in ["x0", "y0"].into_iter().enumerate() {
            let side = model.mesh.node_set(name).expect("a side").to_vec();
            model.supports.prescribe(&side, axis, 0.0);
        }
        let set = |name| model.mesh.face_set(name).expect("a side").to_vec();
        let loads = Loads { pressure: vec![(set("z1"), 1e6)], ..Loads::default() };
        let settled = settle(&model, &set("z0"), &loads, 0.0).expect("a settled block");
        assert!(settled.open.is_empty());
        for pressure in &settled.pressures {
            assert!((pressure - 1e6).abs() < 1e-3, "{}: {:?}", kind.name(), settled.pressures);
        }
        let total: f64 = settled.forces.iter().sum();
        assert!((total - 2e6).abs() < 1e-3, "{}: {total} N", kind.name());
    }
}

/// Every node of two bodies in sliding contact is in equilibrium: N along the normal and −μ N along the sliding on the slaves, the
/// opposite on the masters, the loads elsewhere.
#[test]
fn forces_are_in_equilibrium_and_friction_is_mu_n() {
    let mu = 0.35;
    let mut model = pin::model(Kind::Hex20, 1).expect("the pin");
    let top = model.mesh.node_set("pin.z1").expect("a side").to_vec();
    model.supports.prescribe(&top, 2, -1e-6);
    let faces = model.mesh.face_set("pin.z0").expect("a side").to_vec();
    let settled = settle(&model, &faces, &Loads::default(), mu).expect("a settled pin");
    let held = internal_forces(&settled.model, &settled.displacement).expect("forces");
    let mut wanted = vec![[0.0; 3]; held.len()];
    for (point, n) in settled.model.contact.iter().zip(&settled.forces) {
        let force = [-mu * n, 0.0, *n];
        for i in 0..3 {
            wanted[point.slave][i] += force[i];
            for (master, w) in &point.masters {
                wanted[*master][i] -= w * force[i];
            }
        }
    }
    let total: f64 = settled.forces.iter().sum();
    assert!(total > 100.0, "the pin is pressed with {total} N");
    for node in 0..held.len() {
        let supported = (0..3).any(|axis| model.supports.prescribed.contains_key(&(node, axis)));
        for i in 0..3 {
            let left = held[node][i] - wanted[node][i];
            assert!(supported || left.abs() < 1e-9 * total, "node {node}: {left} N of {total} N");
        }
    }
}

/// A block that is pressed at one end lifts at the other: nowhere pulled, nowhere overlapping, and in equilibrium.
#[test]
fn what_is_pulled_opens() {
    for kind in [Kind::Hex8, Kind::Hex20, Kind::Tet10] {
        let mut model = on_plane(kind, [8.0, 1.0, 1.0], [16, 2, 2]);
        let side = model.mesh.node_set("y0").expect("a side").to_vec();
        model.supports.prescribe(&side, 1, 0.0);
        let end = model.mesh.node_set("x0").expect("a side").to_vec();
        model.supports.prescribe(&end, 0, 0.0);
        let faces = model.mesh.faces_where(|x| x[2] > 1.0 - 1e-9 && x[0] < 1.0 + 1e-9);
        let loads = Loads { pressure: vec![(faces, 1e7)], ..Loads::default() };
        let slaves = model.mesh.face_set("z0").expect("a side").to_vec();
        let settled = settle(&model, &slaves, &loads, 0.0).expect("a settled block");
        assert!(!settled.open.is_empty() && !settled.forces.is_empty(), "{}", kind.name());
        let applied: f64 = nodal_forces(&model, &loads).iter().map(|f| f[2]).sum();
        let total = settled.force;
        assert!((total + applied).abs() < 1e-9 * total, "{total} N carry {applied} N");
        // Where the pressed part ends does not depend on the elements, to within one of them.
        let end = settled.model.contact.iter().map(|p| model.mesh.nodes[p.slave][0]).fold(0.0, f64::max);
        assert!((end - 2.0).abs() <= 0.5, "{} is pressed up to {end} m", kind.name());
        if kind == Kind::Hex8 {
            assert!(settled.forces.iter().all(|n| *n >= -1e-9 * total), "{:?}", settled.forces);
        }
        let gaps: Vec<f64> = settled.open.iter().map(|p| settled.displacement[p.slave][2]).collect();
        let widest = gaps.iter().copied().fold(0.0, f64::max);
        assert!(widest > 0.0 && gaps.iter().all(|gap| *gap >= -1e-9 * widest), "{gaps:?}");
    }
}

/// Whatever pushes and pulls it from above, nowhere is it pulled from below, nowhere does it overlap the plane: what has opened in one
/// round has to close in another.
#[test]
fn what_has_opened_closes_again() {
    let mut model = on_plane(Kind::Hex8, [6.0, 1.0, 0.5], [24, 2, 2]);
    for (axis, name) in ["x0", "y0"].into_iter().enumerate() {
        let side = model.mesh.node_set(name).expect("a side").to_vec();
        model.supports.prescribe(&side, axis, 0.0);
    }
    let slaves = model.mesh.face_set("z0").expect("a side").to_vec();
    let mut number = 7_u32;
    for _ in 0..8 {
        let pressure = (0..12)
            .map(|i| {
                let from = 0.5 * f64::from(i);
                number = number.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let faces = model
                    .mesh
                    .faces_where(|x| x[2] > 0.5 - 1e-9 && x[0] > from - 1e-9 && x[0] < from + 0.5 + 1e-9);
                (faces, 1e6 * (f64::from(number >> 16) / 65_536.0 * 5.0 - 2.0))
            })
            .collect();
        let settled =
            settle(&model, &slaves, &Loads { pressure, ..Loads::default() }, 0.0).expect("a settled block");
        let total: f64 = settled.forces.iter().sum();
        assert!(settled.forces.iter().all(|n| *n >= -1e-6 * total), "{:?}", settled.forces);
        let gaps: Vec<f64> = settled.open.iter().map(|p| settled.displacement[p.slave][2]).collect();
        let widest = gaps.iter().copied().fold(0.0, f64::max);
        assert!(gaps.iter().all(|gap| *gap >= -1e-6 * widest), "{gaps:?}");
    }
}

/// A column that is pressed from above and hinged there, with friction at its foot: whatever the elements, the normal forces stand off
/// its middle by μ times its height. Beyond half its length it tips over.
#[test]
fn friction_moves_the_normal_force_by_mu_times_the_height() {
    let (length, height) = (1.0, 4.0);
    let column = |kind: Kind| {
        let mut model = on_plane(kind, [length, 0.5, height], [6, 2, 6]);
        let top = model.mesh.node_set("z1").expect("a side").to_vec();
        model.supports.prescribe(&top, 0, 0.0);
        model.supports.prescribe(&top, 1, 0.0);
        model
    };
    let pressed = |model: &Model, mu: f64| {
        let set = |name| model.mesh.face_set(name).expect("a side").to_vec();
        let loads = Loads { pressure: vec![(set("z1"), 1e6)], ..Loads::default() };
        settle(model, &set("z0"), &loads, mu)
    };
    for kind in [Kind::Hex8, Kind::Hex20, Kind::Tet10, Kind::Wedge15] {
        let model = column(kind);
        for (mu, opens) in [(0.02, false), (0.06, true), (0.1, true)] {
            let settled = pressed(&model, mu).expect("a settled column");
            assert_eq!(opens, !settled.open.is_empty(), "{} at {mu}", kind.name());
            let forces = internal_forces(&settled.model, &settled.displacement).expect("forces");
            let foot = model.mesh.node_set("z0").expect("a side");
            let total: f64 = foot.iter().map(|node| forces[*node][2]).sum();
            let sideways: f64 = foot.iter().map(|node| forces[*node][0]).sum();
            let moment: f64 =
                foot.iter().map(|node| (model.mesh.nodes[*node][0] - length / 2.0) * forces[*node][2]).sum();
            assert!((total - 0.5e6).abs() < 1e-3 && (settled.force - total).abs() < 1e-3, "{total} N");
            assert!((sideways + mu * total).abs() < 1e-3, "{sideways} N");
            let off = (moment / total).abs();
            assert!((off - mu * height).abs() < 1e-6, "{}: {off} m at {mu}", kind.name());
            let gaps = settled.open.iter().map(|p| settled.displacement[p.slave][2]);
            assert!(gaps.clone().all(|gap| gap > -1e-15), "{:?}", gaps.collect::<Vec<_>>());
            let pressing = settled.surface.pressing(&settled.forces);
            assert!(pressing.iter().all(|force| *force > -1e-3), "{pressing:?}");
        }
    }
    let error = pressed(&column(Kind::Hex8), 0.15).expect_err("it tips over").to_string();
    assert!(
        error.contains("is pressed or open: static friction of 0.15 may tip a body over its edge"),
        "{error}"
    );
}

#[test]
fn a_block_that_is_pulled_off_is_an_error() {
    let mut model = on_plane(Kind::Hex8, [1.0, 1.0, 1.0], [2, 2, 2]);
    for (axis, name) in ["x0", "y0"].into_iter().enumerate() {
        let side = model.mesh.node_set(name).expect("a side").to_vec();
        model.supports.prescribe(&side, axis, 0.0);
    }
    let set = |name| model.mesh.face_set(name).expect("a side").to_vec();
    let loads = Loads { pressure: vec![(set("z1"), -1e6)], ..Loads::default() };
    let error = settle(&model, &set("z0"), &loads, 0.0).expect_err("nothing holds it").to_string();
    assert!(
        error.starts_with("the surfaces are pulled apart, so that nothing of the contact stays pressed"),
        "{error}"
    );
}
