//! Rings and cylinders: what they weigh, how they twist, how they slide about an axis.

use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

use faer::c64;
use squealmap_fem::assembly::{Loads, Model, Rows, assemble, internal_forces, nodal_forces};
use squealmap_fem::contact::{rotating, sliding_on_rigid};
use squealmap_fem::elements::Kind;
use squealmap_fem::mesh::{Cylinder, Mesh, Ring};
use squealmap_fem::modes::{Basis, Factor, Ordering, lift, lowest, pairs, refine};
use squealmap_fem::statics::settle;

use crate::cases::{brake, steel};

const HEIGHT: f64 = 0.03;
const RADII: [f64; 2] = [0.01, 0.02];
/// Off the origin, so that a place about the axis is not taken for one about the origin.
const CENTRE: [f64; 3] = [0.3, -0.2, 0.1];

fn ring(kind: Kind, n: usize) -> Mesh {
    let cells = [n.into(), (8 * n).into(), (2 * n).into()];
    Ring { centre: CENTRE, radii: RADII, angles: [0.4, 0.4 + TAU], height: HEIGHT, cells, kind }
        .mesh()
        .expect("a ring")
}

fn cylinder(kind: Kind, n: usize) -> Mesh {
    Cylinder { centre: CENTRE, radius: RADII[1], height: HEIGHT, cells: [n, n, 2 * n], kind }
        .mesh()
        .expect("a cylinder")
}

fn clamped(mesh: Mesh, side: &str) -> Model {
    let mut model = Model { mesh, materials: vec![steel()], ..Model::default() };
    model.supports.clamp(model.mesh.node_set(side).expect("a side"));
    model
}

fn real(model: &Model, count: usize) -> Vec<f64> {
    let (numbering, pencil) = assemble(model).expect("matrices");
    let ordering =
        Ordering::best(&pencil.stiffness.pattern, &numbering.places(&model.mesh)).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    lowest(&pencil, &factor, count).expect("real modes").frequencies()
}

/// The area of a side by the forces of a pressure of 1 Pa on it.
fn area(mesh: &Mesh, side: &str) -> f64 {
    let model = Model { mesh: mesh.clone(), materials: vec![steel()], ..Model::default() };
    let faces = model.mesh.face_set(side).expect("a side").to_vec();
    let loads = Loads { pressure: vec![(faces, 1.0)], ..Loads::default() };
    nodal_forces(&model, &loads).iter().map(|f| f[2]).sum::<f64>().abs()
}

/// A full ring has no seam, a sector two more sides; parabolas on circles: areas come to π (R² − r²) with the fourth power of the size.
#[test]
fn ends_have_their_areas() {
    let [inner, outer] = RADII.map(|r| PI * r * r);
    for (mesh, exact) in
        [(ring as fn(Kind, usize) -> Mesh, outer - inner), (cylinder as fn(Kind, usize) -> Mesh, outer)]
    {
        for side in ["z0", "z1"] {
            let errors = [1, 2, 4].map(|n| (area(&mesh(Kind::Hex20, n), side) / exact - 1.0).abs());
            let orders = [0, 1].map(|i| (errors[i] / errors[i + 1]).log2());
            println!("{side}: {errors:?}, {orders:?}");
            assert!(
                errors[0] < 2e-2 && orders.iter().all(|o| (3.6..4.4).contains(o)),
                "{errors:?} {orders:?}"
            );
        }
        for kind in [Kind::Hex8, Kind::Hex20, Kind::Wedge15] {
            let mesh = mesh(kind, 2);
            let outer = |x: [f64; 3]| {
                let r = (x[0] - CENTRE[0]).hypot(x[1] - CENTRE[1]);
                (r - RADII[1]).abs() < 1e-9
            };
            assert_eq!(mesh.node_set("r1").expect("a side"), mesh.nodes_where(outer), "{}", kind.name());
            // No more sides than there are: every outer face is in one of them.
            let named: usize = mesh.face_sets.values().map(Vec::len).sum();
            assert_eq!(named, mesh.skin().len(), "{}", kind.name());
        }
    }
    let sector = Ring {
        centre: [0.0; 3],
        radii: RADII,
        angles: [0.0, 1.0],
        height: HEIGHT,
        cells: [2.into(), 5.into(), 1.into()],
        kind: Kind::Tet10,
    };
    let sector = sector.mesh().expect("a sector");
    assert_eq!(
        sector.face_sets.keys().map(String::as_str).collect::<Vec<_>>(),
        ["a0", "a1", "r0", "r1", "z0", "z1"]
    );
    assert!((area(&sector, "z1") / (0.5 * (RADII[1].powi(2) - RADII[0].powi(2))) - 1.0).abs() < 1e-4);
}

/// A round bar clamped at one end twists with c_s/4L, 3 c_s/4L and so on, whatever its radii.
#[test]
fn round_bars_twist_as_they_should() {
    let speed = (210e9 / 2.6 / 7800.0_f64).sqrt();
    let exact = speed / (4.0 * HEIGHT);
    for (mesh, kind) in
        [(ring as fn(Kind, usize) -> Mesh, Kind::Hex20), (cylinder, Kind::Hex20), (cylinder, Kind::Wedge15)]
    {
        let errors = [1, 2].map(|n| {
            let found = real(&clamped(mesh(kind, n), "z0"), 6);
            found.iter().map(|f| (f / exact - 1.0).abs()).fold(f64::INFINITY, f64::min)
        });
        println!("{}: {errors:?} of {exact} Hz", kind.name());
        // They fall with the fourth power, by 16.
        assert!(errors[1] < 3e-4 && errors[0] > 8.0 * errors[1], "{errors:?}");
    }
}

/// A ring pressed on a plane that turns below it: the friction has a moment of μ p ∫ r dA about the axis and no resultant.
#[test]
fn friction_about_an_axis_has_its_moment() {
    let mu = 0.3;
    for mesh in [ring(Kind::Hex20, 2), cylinder(Kind::Hex20, 2)] {
        let hollow = mesh.node_sets.contains_key("r0");
        let mut model = clamped(mesh, "z1");
        // Loaded by moving the clamped end down, so that the pressure is what it becomes: moment and force are compared.
        for node in model.mesh.node_set("z1").expect("a side").to_vec() {
            model.supports.prescribed.insert((node, 2), -1e-6);
        }
        let slaves: Vec<usize> = model
            .mesh
            .node_set("z0")
            .expect("a side")
            .iter()
            .copied()
            .filter(|n| {
                let x = model.mesh.nodes[*n];
                (x[0] - CENTRE[0]).hypot(x[1] - CENTRE[1]) > 1e-6
            })
            .collect();
        let points = sliding_on_rigid(&slaves, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]).expect("a plane");
        model.contact = rotating(&model.mesh, points, CENTRE, [0.0, 0.0, 1.0]).expect("an axis");
        let faces = model.mesh.face_set("z0").expect("a side").to_vec();
        let settled = settle(&model, &faces, &Loads::default(), mu).expect("a ring that slides");
        let forces = internal_forces(&settled.model, &settled.displacement).expect("forces");
        let about = |node: usize, f: [f64; 3]| {
            let x = model.mesh.nodes[node];
            (x[0] - CENTRE[0]) * f[1] - (x[1] - CENTRE[1]) * f[0]
        };
        let held = model.mesh.node_set("z1").expect("a side");
        let moment: f64 = held.iter().map(|n| about(*n, forces[*n])).sum();
        let across = [0, 1].map(|i| held.iter().map(|n| forces[*n][i]).sum::<f64>());
        let expected: f64 = settled
            .model
            .contact
            .iter()
            .zip(&settled.forces)
            .map(|(p, n)| {
                let x = model.mesh.nodes[p.slave];
                mu * n * (x[0] - CENTRE[0]).hypot(x[1] - CENTRE[1])
            })
            .sum();
        let normal: f64 = settled.forces.iter().sum();
        println!("{moment} N m of {normal} N, {across:?}");
        assert!((moment / expected - 1.0).abs() < 1e-9, "{moment} {expected}");
        assert!(across.iter().all(|f| f.abs() < 1e-9 * normal), "{across:?}");
        // Between those of a ring's inner and outer radius, and near that of a uniform pressure.
        let inner = if hollow { RADII[0] } else { 0.0 };
        let lever = 2.0 / 3.0 * (RADII[1].powi(3) - inner.powi(3)) / (RADII[1].powi(2) - inner.powi(2));
        assert!((moment / (mu * normal * lever) - 1.0).abs() < 0.05, "{moment} {normal} {lever}");
    }
}

/// Linings on both sides of a disc are mirror images of each other, and so is their friction: each complex mode is even or odd in z.
#[test]
fn both_sides_of_a_disc_slide_alike() {
    let mu = 0.5;
    let model = brake::model(Kind::Hex8, [7, 36, 2]).expect("a brake");
    let (numbering, pencil) = assemble(&model).expect("matrices");
    let ordering =
        Ordering::best(&pencil.stiffness.pattern, &numbering.places(&model.mesh)).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    let mut basis = Basis::new(&pencil, &lowest(&pencil, &factor, 14).expect("real modes").shapes);
    let none = Rows::default();
    refine(&pencil, &factor, &mut basis, &[mu], &none, 8, 1e-7, 20).expect("a space");
    let key = |x: [f64; 3]| x.map(|c| format!("{:.7}", c + 0.0));
    let places: HashMap<_, _> = model.mesh.nodes.iter().enumerate().map(|(i, x)| (key(*x), i)).collect();
    // The middle of the disc lies at 6 mm. Backs and linings have nodes of their own at the places where they meet: those of the last one count.
    let mirror: Vec<usize> =
        model.mesh.nodes.iter().map(|x| places[&key([x[0], x[1], 0.012 - x[2]])]).collect();
    let found = pairs(&basis.at(mu, &none)).expect("complex modes");
    for pair in &found[..8] {
        let [re, im] = lift(&basis, &pair.vector).map(|part| numbering.spread(&part));
        // Where surfaces slide, two nodes at one place move differently: left out, as the mirror knows one of them only.
        let inner: Vec<usize> = (0..mirror.len()).filter(|n| mirror[mirror[*n]] == *n).collect();
        let at = |node: usize, axis: usize| c64::new(re[node][axis], im[node][axis]);
        let sum = |of: &dyn Fn(usize, usize) -> c64| -> c64 {
            inner.iter().flat_map(|n| (0..3).map(move |axis| (*n, axis))).map(|(n, axis)| of(n, axis)).sum()
        };
        let sign = |axis| if axis == 2 { -1.0 } else { 1.0 };
        let own = sum(&|n, axis| at(n, axis).conj() * at(n, axis));
        let turned = sum(&|n, axis| at(n, axis).conj() * at(mirror[n], axis) * sign(axis));
        let parity = turned / own;
        println!("{:.1} Hz, {:.1} 1/s: {parity}", pair.frequency(), pair.growth());
        assert!(
            (parity.norm() - 1.0).abs() < 1e-6 && parity.im.abs() < 1e-6,
            "{} Hz: {parity}",
            pair.frequency()
        );
    }
}
