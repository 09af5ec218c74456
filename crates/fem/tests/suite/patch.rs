//! Patch tests on distorted meshes, and loads.

use squealmap_fem::assembly::{Loads, Model, assemble, load_vector, nodal_forces};
use squealmap_fem::elements::Kind;
use squealmap_fem::mesh::{Block, Mesh};
use squealmap_fem::modes::{Factor, Ordering};

use crate::cases::steel;
use crate::elements::KINDS;

/// A block of 2 × 2 × 2 cells whose inner corner nodes are moved, middles of edges following: edges stay straight.
fn distorted(kind: Kind) -> Mesh {
    let block =
        Block { origin: [0.0; 3], size: [2.0, 1.8, 1.5], cells: [2.into(), 2.into(), 2.into()], kind };
    let mut mesh = block.mesh().expect("a block");
    let corners: Vec<bool> = {
        let mut corners = vec![false; mesh.nodes.len()];
        for (_, kind, _, nodes) in mesh.elements() {
            nodes[..kind.corners()].iter().for_each(|node| corners[*node] = true);
        }
        corners
    };
    for node in 0..mesh.nodes.len() {
        let x = mesh.nodes[node];
        if corners[node] {
            // Zero on the outside, so that the block stays one.
            let inside = |x: f64, l: f64| x * (l - x);
            let by = 0.2 * inside(x[0], 2.0) * inside(x[1], 1.8) * inside(x[2], 1.5);
            mesh.nodes[node] = [x[0] + by, x[1] - 0.8 * by, x[2] + 0.6 * by];
        }
    }
    if kind.quadratic() {
        let groups = mesh.groups.clone();
        for group in groups {
            for element in group.elements {
                for (i, [a, b]) in kind.edges().iter().enumerate() {
                    let (x, y) = (mesh.nodes[element[*a]], mesh.nodes[element[*b]]);
                    mesh.nodes[element[kind.corners() + i]] = [0, 1, 2].map(|c| f64::midpoint(x[c], y[c]));
                }
            }
        }
    }
    mesh
}

fn solve(model: &Model, loads: &Loads) -> Vec<[f64; 3]> {
    let (numbering, pencil) = assemble(model).expect("a sound model");
    let (force, _) = load_vector(model, &numbering, loads).expect("loads");
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    let mut q = faer::Mat::from_fn(force.len(), 1, |i, _| force[i]);
    factor.solve(q.as_mut());
    let q: Vec<f64> = (0..force.len()).map(|i| q[(i, 0)]).collect();
    let mut u = numbering.spread(&q);
    for (node, u) in u.iter_mut().enumerate() {
        (0..3).for_each(|i| u[i] += numbering.given[3 * node + i]);
    }
    u
}

/// A linear displacement on the outside is linear inside.
#[test]
fn a_constant_strain_passes_through_distorted_elements() {
    let displacement = |x: [f64; 3]| {
        [
            1e-3 * (x[0] + 0.4 * x[1] - 0.2 * x[2]),
            1e-3 * (0.1 * x[0] - 0.6 * x[1] + 0.3 * x[2]),
            1e-3 * (0.5 * x[0] + 0.2 * x[1] + 0.8 * x[2]),
        ]
    };
    for kind in KINDS {
        let mesh = distorted(kind);
        let mut model = Model { materials: vec![steel()], ..Model::default() };
        let outside = mesh.face_nodes(&mesh.faces_where(|_| true));
        assert!(outside.len() < mesh.nodes.len(), "{} has a node inside", kind.name());
        for node in outside {
            for (axis, value) in displacement(mesh.nodes[node]).into_iter().enumerate() {
                model.supports.prescribe(&[node], axis, value);
            }
        }
        model.mesh = mesh;
        for (x, u) in model.mesh.nodes.iter().zip(solve(&model, &Loads::default())) {
            let exact = displacement(*x);
            for i in 0..3 {
                assert!((u[i] - exact[i]).abs() < 1e-14, "{}: {u:?} {exact:?}", kind.name());
            }
        }
    }
}

/// A block under pressure on one side and held by planes of symmetry on three shortens by p l/E and widens by ν p w/E.
#[test]
fn pressure_makes_a_uniform_stress() {
    let pressure = 1e6;
    for kind in KINDS {
        let mesh = distorted(kind);
        let mut model = Model { materials: vec![steel()], ..Model::default() };
        for (axis, name) in ["x0", "y0", "z0"].into_iter().enumerate() {
            model.supports.prescribe(mesh.node_set(name).expect("a side"), axis, 0.0);
        }
        let faces = mesh.face_set("z1").expect("a side").to_vec();
        model.mesh = mesh;
        let loads = Loads { pressure: vec![(faces, pressure)], ..Loads::default() };
        let total: f64 = nodal_forces(&model, &loads).iter().map(|f| f[2]).sum();
        assert!((total + pressure * 2.0 * 1.8).abs() < 1e-6, "the pressure sums to {total} N");
        for (x, u) in model.mesh.nodes.iter().zip(solve(&model, &loads)) {
            let strain = pressure / 210e9;
            let exact = [0.3 * strain * x[0], 0.3 * strain * x[1], -strain * x[2]];
            for i in 0..3 {
                assert!((u[i] - exact[i]).abs() < 1e-17, "{}: {u:?} {exact:?}", kind.name());
            }
        }
    }
}

#[test]
fn blocks_have_their_volume_and_sides() {
    for kind in KINDS {
        let mesh = distorted(kind);
        let mut model = Model { mesh, materials: vec![steel()], ..Model::default() };
        let (numbering, pencil) = assemble(&model).expect("a sound model");
        for axis in 0..3 {
            let mut shift = vec![0.0; pencil.size()];
            for node in 0..model.mesh.nodes.len() {
                numbering.rows[3 * node + axis].iter().for_each(|(i, _)| shift[*i] = 1.0);
            }
            let mass: f64 = pencil.mass.times(&shift).iter().zip(&shift).map(|(a, b)| a * b).sum();
            let exact = 7800.0 * 2.0 * 1.8 * 1.5;
            assert!((mass - exact).abs() < 1e-10 * exact, "{}: {mass} kg", kind.name());
        }
        // Each side is as large as its edges say, to the outside.
        for (name, area) in [("x1", 1.8 * 1.5), ("y0", 2.0 * 1.5), ("z1", 2.0 * 1.8)] {
            let faces = model.mesh.face_set(name).expect("a side").to_vec();
            let loads = Loads { pressure: vec![(faces, 1.0)], ..Loads::default() };
            let force = nodal_forces(&model, &loads)
                .iter()
                .fold([0.0; 3], |s, f| [s[0] + f[0], s[1] + f[1], s[2] + f[2]]);
            let axis = usize::from(name.as_bytes()[0] - b'x');
            let outwards = if name.ends_with('1') { -1.0 } else { 1.0 };
            assert!((force[axis] - outwards * area).abs() < 1e-12, "{} {name}: {force:?}", kind.name());
        }
        model.supports.clamp(&[0]);
    }
}
