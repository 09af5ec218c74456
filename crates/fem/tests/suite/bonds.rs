//! Bonds between meshes that do not match.

use squealmap_fem::assembly::{Loads, Model, Supports, Tie, assemble};
use squealmap_fem::contact::{bonded, bonded_mortar, bonded_points};
use squealmap_fem::elements::Kind;
use squealmap_fem::mesh::{Block, Mesh};
use squealmap_fem::modes::{Factor, Ordering, lowest};
use squealmap_fem::statics::settle;

use crate::cases::steel;

const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// Two blocks on each other.
fn stack(cells: [[usize; 3]; 2], kinds: [Kind; 2]) -> Mesh {
    let block = |i: usize, z: f64| Block {
        origin: [0.0, 0.0, z],
        size: [0.02, 0.01, 0.01],
        cells: cells[i].map(Into::into),
        kind: kinds[i],
    };
    let mut mesh = block(0, 0.0).mesh().expect("a block");
    mesh.add(block(1, 0.01).mesh().expect("a block"), "up.", 0);
    mesh
}

fn ties(mesh: &Mesh, by_points: bool) -> Vec<Tie> {
    let faces = |name: &str| mesh.face_set(name).expect("a side");
    let bond = if by_points { bonded_points } else { bonded_mortar };
    bond(mesh, faces("up.z0"), faces("z1"), UP).expect("a bond")
}

/// A linear field passes through both kinds of bonds.
#[test]
fn a_linear_field_passes_through_a_bond() {
    for kinds in [[Kind::Tet10, Kind::Hex20], [Kind::Hex20, Kind::Tet10], [Kind::Hex8, Kind::Hex20]] {
        let mesh = stack([[3, 2, 2], [8, 5, 2]], kinds);
        for by_points in [false, true] {
            let ties = ties(&mesh, by_points);
            assert_eq!(ties.len(), mesh.node_set("up.z0").expect("a side").len());
            let field = |x: [f64; 3]| 1.0 + 70.0 * x[0] - 40.0 * x[1];
            for tie in &ties {
                let sum: f64 = tie.masters.iter().map(|(node, w)| w * field(mesh.nodes[*node])).sum();
                assert!((sum - field(mesh.nodes[tie.slave])).abs() < 1e-11, "{tie:?}");
            }
        }
    }
}

/// A column of two bonded blocks under pressure: u = p z/E below and above the bond, exactly.
#[test]
fn a_bonded_column_is_compressed_uniformly() {
    // Edges of the master lie on edges of the slaves, as bonds by points ask for.
    for (cells, kinds, by_points) in [
        ([[3, 2, 2], [8, 5, 2]], [Kind::Tet10, Kind::Hex20], false),
        ([[2, 2, 2], [8, 4, 2]], [Kind::Hex20, Kind::Hex20], true),
    ] {
        let mesh = stack(cells, kinds);
        let mut supports = Supports { tied: ties(&mesh, by_points), ..Supports::default() };
        let set = |name: &str| mesh.node_set(name).expect("a side");
        for (axis, name) in [(0, "x0"), (1, "y0"), (2, "z0")] {
            supports.prescribe(set(name), axis, 0.0);
        }
        let loads = Loads {
            pressure: vec![(mesh.face_set("up.z1").expect("a side").to_vec(), 1e6)],
            ..Loads::default()
        };
        let model = Model { mesh, materials: vec![steel()], supports, ..Model::default() };
        let settled = settle(&model, &[], &loads, 0.0).expect("a settled column");
        let strain = 1e6 / 210e9;
        for (x, u) in model.mesh.nodes.iter().zip(&settled.displacement) {
            let exact = [0.3 * strain * x[0], 0.3 * strain * x[1], -strain * x[2]];
            assert!((0..3).all(|i| (u[i] - exact[i]).abs() < 1e-8 * strain * 0.02), "{u:?} {exact:?}");
        }
    }
}

/// Where the nodes match, both kinds of bonds are merged nodes: the same frequencies.
#[test]
fn bonds_of_matching_nodes_merge_them() {
    let mesh = stack([[4, 2, 2]; 2], [Kind::Hex20; 2]);
    let frequencies = |supports: Supports| {
        let mut model = Model { mesh: mesh.clone(), materials: vec![steel()], supports, ..Model::default() };
        model.supports.clamp(mesh.node_set("z0").expect("a side"));
        let (_, pencil) = assemble(&model).expect("matrices");
        let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
        let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
        lowest(&pencil, &factor, 6).expect("modes").frequencies()
    };
    let set = |name: &str| mesh.node_set(name).expect("a side");
    let same = bonded(&mesh, set("up.z0"), set("z1")).expect("pairs");
    let merged = frequencies(Supports { same, ..Supports::default() });
    for by_points in [false, true] {
        let tied = frequencies(Supports { tied: ties(&mesh, by_points), ..Supports::default() });
        for (a, b) in merged.iter().zip(&tied) {
            assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
        }
    }
}

#[test]
fn bonds_that_cannot_hold_are_refused() {
    let mesh = stack([[2, 2, 2], [4, 2, 2]], [Kind::Hex20; 2]);
    let faces = |name: &str| mesh.face_set(name).expect("a side");
    let beside = mesh.faces_where(|x| (x[2] - 0.01).abs() < 1e-9 && x[0] < 0.011);
    let error = bonded_points(&mesh, faces("up.z0"), &beside, UP).map(drop).expect_err("beside").to_string();
    assert!(error.contains("m beside the other surface (limit"), "{error}");
    let mut supports = Supports { tied: ties(&mesh, true), ..Supports::default() };
    supports.clamp(mesh.node_set("up.z0").expect("a side"));
    let model = Model { mesh, materials: vec![steel()], supports, ..Model::default() };
    let error = assemble(&model).map(drop).expect_err("bonded and clamped").to_string();
    assert!(error.contains("is bonded to a surface, and supported"), "{error}");
}
