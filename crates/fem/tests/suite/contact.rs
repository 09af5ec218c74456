//! Bonded and sliding surfaces, wherever they lie.

use faer::c64;
use squealmap_fem::assembly::{Model, Rows, assemble};
use squealmap_fem::contact::{bonded, sliding_on_rigid};
use squealmap_fem::elements::Kind;
use squealmap_fem::mesh::Block;
use squealmap_fem::modes::{Basis, Factor, Ordering, lowest, pairs, refine};

use crate::cases::{pin, steel};

fn real(model: &Model) -> Vec<f64> {
    let (_, pencil) = assemble(model).expect("matrices");
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    lowest(&pencil, &factor, 8).expect("real modes").frequencies()
}

/// Two blocks bonded at matching nodes are one block.
#[test]
fn bonded_blocks_are_one() {
    for kind in [Kind::Hex8, Kind::Hex20, Kind::Wedge15] {
        let block = |from: f64, length: f64, cells: usize| {
            let cells = [3.into(), 2.into(), cells.into()];
            Block { origin: [0.0, 0.0, from], size: [0.03, 0.02, length], cells, kind }
                .mesh()
                .expect("a block")
        };
        let mut whole = Model { mesh: block(0.0, 0.05, 5), materials: vec![steel()], ..Model::default() };
        whole.supports.clamp(whole.mesh.node_set("z0").expect("a side"));
        let mut parts = Model { mesh: block(0.0, 0.02, 2), materials: vec![steel()], ..Model::default() };
        parts.mesh.add(block(0.02, 0.03, 3), "up.", 0);
        let set = |name| parts.mesh.node_set(name).expect("a side").to_vec();
        let (bottom, below, above) = (set("z0"), set("z1"), set("up.z0"));
        parts.supports.clamp(&bottom);
        parts.supports.bond(bonded(&parts.mesh, &above, &below).expect("matching surfaces"));
        for (a, b) in real(&whole).iter().zip(real(&parts)) {
            assert!((a / b - 1.0).abs() < 1e-9, "{}: {a} {b}", kind.name());
        }
    }
}

/// Friction turned with the bodies into any direction has the same eigenvalues, though the normal is along no axis then.
#[test]
fn friction_does_not_know_the_axes() {
    let mu = 0.45;
    let solve = |model: &Model| -> Vec<c64> {
        let (_, pencil) = assemble(model).expect("matrices");
        let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
        let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
        let modes = lowest(&pencil, &factor, 20).expect("real modes");
        let mut basis = Basis::new(&pencil, &modes.shapes);
        let none = Rows::default();
        let worst = refine(&pencil, &factor, &mut basis, &[mu], &none, 7, 1e-8, 30).expect("a space");
        assert!(worst <= 1e-8, "{worst:e}");
        let mut found = pairs(&basis.at(mu, &none)).expect("complex modes");
        found.truncate(7);
        found.into_iter().map(|pair| pair.lambda).collect()
    };
    let model = pin::model(Kind::Hex20, 1).expect("the pin");
    let mut turned = model.clone();
    // By 40 degrees about z, then by 25 degrees about x.
    let ((s, c), (u, v)) = (40_f64.to_radians().sin_cos(), 25_f64.to_radians().sin_cos());
    let turn = |x: [f64; 3]| {
        let y = [c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]];
        [y[0], v * y[1] - u * y[2], u * y[1] + v * y[2]]
    };
    for x in &mut turned.mesh.nodes {
        *x = turn(*x);
    }
    for point in &mut turned.contact {
        point.normal = turn(point.normal);
        point.direction = turn(point.direction);
    }
    let found = solve(&turned);
    let straight = solve(&model);
    assert!(straight.iter().any(|lambda| lambda.re > 100.0), "{straight:?}");
    for lambda in straight {
        let error = found.iter().map(|f| (f - lambda).norm()).fold(f64::INFINITY, f64::min);
        assert!(error < 1e-8 * lambda.norm(), "{lambda}: {error:e}");
    }
}

/// A block whose edge slides on two planes at right angles has the same frequencies however it lies, whichever plane comes first.
#[test]
fn an_edge_on_two_planes_does_not_know_the_axes() {
    let cells = [2.into(), 2.into(), 2.into()];
    let block = Block { origin: [0.0; 3], size: [0.03, 0.02, 0.025], cells, kind: Kind::Hex8 };
    let mesh = block.mesh().expect("a block");
    let set = |name| mesh.node_set(name).expect("a side").to_vec();
    let (below, beside, top) = (set("z0"), set("y0"), set("x1"));
    let (along, across, up) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let frequencies = |turned: &dyn Fn([f64; 3]) -> [f64; 3], swapped: bool| {
        let mut model = Model { mesh: mesh.clone(), materials: vec![steel()], ..Model::default() };
        model.mesh.nodes = mesh.nodes.iter().map(|x| turned(*x)).collect();
        model.supports.clamp(&top);
        let free = |nodes: &[usize]| -> Vec<usize> {
            nodes.iter().copied().filter(|node| !top.contains(node)).collect()
        };
        let mut planes = [(free(&below), up), (free(&beside), across)];
        if swapped {
            planes.reverse();
        }
        for (nodes, normal) in planes {
            let points = sliding_on_rigid(&nodes, turned(normal), turned(along)).expect("a plane");
            model.contact.extend(points);
        }
        real(&model)
    };
    let straight = frequencies(&|x| x, false);
    // Turned so that the normals are (1, 1, 1)/√3 and (−1, 1, 0)/√2.
    let turned = |[x, y, z]: [f64; 3]| {
        let rows = [[1.0, 1.0, -2.0], [-1.0, 1.0, 0.0], [1.0, 1.0, 1.0]];
        let lengths = [6_f64, 2.0, 3.0].map(f64::sqrt);
        std::array::from_fn(|i| {
            [x, y, z].iter().zip(rows).zip(lengths).map(|((c, row), length)| c * row[i] / length).sum()
        })
    };
    for swapped in [false, true] {
        for (a, b) in straight.iter().zip(frequencies(&turned, swapped)) {
            assert!((a / b - 1.0).abs() < 1e-9, "{swapped}: {a} {b}");
        }
    }
}
