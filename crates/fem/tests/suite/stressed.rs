//! Bodies under stress, and bodies that are warm.

use squealmap_fem::assembly::{Loads, Model, assemble};
use squealmap_fem::contact::periodic;
use squealmap_fem::elements::Kind;
use squealmap_fem::material::{Constants, Material, Orthotropic};
use squealmap_fem::mesh::Block;
use squealmap_fem::modes::{Factor, Ordering, lowest};
use squealmap_fem::read::{abaqus, abaqus_at};
use squealmap_fem::statics::settle;

use crate::elements::KINDS;

const LENGTH: f64 = 0.1;
const YOUNG: f64 = 3e9;
const DENSITY: f64 = 1200.0;

/// Shear waves along a bar whose sides are periodic: nodes move across only, both ends stand.
fn bar(kind: Kind, cells: usize) -> Model {
    let block = Block {
        origin: [0.0; 3],
        size: [LENGTH, 0.01, 0.01],
        cells: [cells.into(), 1.into(), 1.into()],
        kind,
    };
    let mesh = block.mesh().expect("a block");
    // Without a Poisson's ratio a pull along the bar is a stress along it alone.
    let material = Material::isotropic("rubber", YOUNG, 0.0, DENSITY).expect("constants");
    let mut model = Model { materials: vec![material], ..Model::default() };
    let side = |name| mesh.node_set(name).expect("a side").to_vec();
    model.supports.bond(periodic(&mesh, &side("y1"), &side("y0"), [0.0, -0.01, 0.0]).expect("two sides"));
    let all: Vec<usize> = (0..mesh.nodes.len()).collect();
    model.supports.prescribe(&all, 0, 0.0);
    model.supports.prescribe(&all, 2, 0.0);
    model.supports.clamp(&side("x0"));
    model.supports.clamp(&side("x1"));
    model.mesh = mesh;
    model
}

fn first(model: &Model) -> f64 {
    let (_, pencil) = assemble(model).expect("matrices");
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    lowest(&pencil, &factor, 1).expect("a real mode").frequencies()[0]
}

/// Under a tension σ shear waves run with √((G + σ)/ρ), as those of a string with √(σ/ρ).
#[test]
fn tension_stiffens_and_compression_softens() {
    let shear = YOUNG / 2.0;
    for kind in KINDS {
        for stretch in [0.2, -0.2] {
            let mut model = bar(kind, 12);
            let plain = first(&model);
            model.stressed = Some(model.mesh.nodes.iter().map(|x| [stretch * x[0], 0.0, 0.0]).collect());
            let expected = (1.0 + stretch * YOUNG / shear).sqrt();
            let ratio = first(&model) / plain;
            let exact = (shear / DENSITY).sqrt() / (2.0 * LENGTH);
            let error = (plain / exact - 1.0).abs();
            assert!(error < 4e-3, "{}: {plain}, not {exact}", kind.name());
            // Bricks and wedges keep the shape of the wave, tetrahedra change it a little.
            let apart = (ratio / expected - 1.0).abs();
            assert!(apart < 1e-9 + 0.05 * error, "{} {stretch}: {ratio}, not {expected}", kind.name());
        }
    }
}

/// A static step hands its stress on: the bar pulled at its end by a prescribed displacement.
#[test]
fn the_static_step_stiffens_the_modes() {
    let mut model = bar(Kind::Hex20, 12);
    let plain = first(&model);
    let inner: Vec<usize> = model.mesh.nodes_where(|x| x[0] > 1e-9 && x[0] < LENGTH - 1e-9);
    for node in inner {
        model.supports.prescribed.remove(&(node, 0));
    }
    let end = model.mesh.node_set("x1").expect("a side").to_vec();
    model.supports.prescribe(&end, 0, 0.01 * LENGTH);
    let settled = settle(&model, &[], &Loads::default(), 0.0).expect("a stretched bar");
    let mut held = bar(Kind::Hex20, 12);
    held.stressed = Some(settled.displacement.clone());
    let ratio = first(&held) / plain;
    assert!((ratio / 1.02_f64.sqrt() - 1.0).abs() < 1e-9, "{ratio}");
    // The same matrices as the settled model's own.
    let stiff = settled.stiffened().expect("matrices").stiffness;
    let softer = settled.pencil.stiffness;
    assert!(
        stiff.values.iter().zip(&softer.values).any(|(a, b)| (a - b).abs() > 1e-3 * b.abs() && b.abs() > 0.0)
    );
}

/// Rayleigh's β damps by what the material does, whatever stress there is.
#[test]
fn stress_is_no_damping() {
    let mut model = bar(Kind::Hex20, 2);
    model.materials = model.materials.into_iter().map(|material| material.damped(0.0, 1e-6)).collect();
    let plain = assemble(&model).expect("matrices").1;
    model.stressed = Some(model.mesh.nodes.iter().map(|x| [0.2 * x[0], 0.0, 0.0]).collect());
    let stressed = assemble(&model).expect("matrices").1;
    assert_ne!(plain.stiffness.values, stressed.stiffness.values);
    let [plain, stressed] = [plain, stressed].map(|pencil| pencil.damping.expect("a damped bar").values);
    assert_eq!(plain, stressed);
}

#[test]
fn displacements_of_another_mesh_stiffen_nothing() {
    let mut model = bar(Kind::Hex8, 2);
    model.stressed = Some(vec![[0.0; 3]; 5]);
    let error = assemble(&model).expect_err("five displacements").to_string();
    assert!(error.contains("5 displacements") && error.contains("12 nodes"), "{error}");
}

/// Constants lie on straight lines between the rows of a table, and frequencies go with √E.
#[test]
fn constants_follow_their_table() {
    let table = [
        (20.0, Constants::Isotropic(210e9, 0.3)),
        (100.0, Constants::Isotropic(200e9, 0.3)),
        (300.0, Constants::Isotropic(180e9, 0.32)),
    ];
    for (celsius, young, poisson) in [
        (-40.0, 210e9, 0.3),
        (20.0, 210e9, 0.3),
        (60.0, 205e9, 0.3),
        (250.0, 185e9, 0.315),
        (900.0, 180e9, 0.32),
    ] {
        let found = Material::at("steel", celsius, &table, 7800.0).expect("a material");
        let expected = Material::isotropic("steel", young, poisson, 7800.0).expect("a material");
        for (a, b) in found.stiffness.iter().flatten().zip(expected.stiffness.iter().flatten()) {
            assert!((a - b).abs() <= 1e-12 * 210e9, "{celsius}: {a} {b}");
        }
    }
    let lining = |scale: f64| Orthotropic {
        young: [12e9 * scale, 9e9 * scale, 3e9 * scale],
        poisson: [0.25, 0.2, 0.3],
        shear: [3e9 * scale, 1.5e9 * scale, 2e9 * scale],
    };
    let table = [(0.0, Constants::Orthotropic(lining(1.0))), (200.0, Constants::Orthotropic(lining(0.6)))];
    let found = Material::at("lining", 50.0, &table, 2500.0).expect("a material");
    let expected = Material::orthotropic("lining", lining(0.9), 2500.0).expect("a material");
    for (a, b) in found.stiffness.iter().flatten().zip(expected.stiffness.iter().flatten()) {
        assert!((a - b).abs() <= 1e-12 * 12e9, "{a} {b}");
    }
    let text = include_str!("files/bar_hex20.inp");
    let warm = text.replace("*ELASTIC\n210e9, 0.3", "*ELASTIC\n210e9, 0.3, 20\n189e9, 0.3, 120");
    assert_ne!(text, warm);
    let young = |deck: squealmap_fem::read::Deck| deck.materials[0].stiffness[0][0];
    let cold = young(abaqus(text).expect("a file"));
    let at = |celsius| young(abaqus_at(&warm, celsius).expect("a file")) / cold;
    assert!(
        (at(70.0) - 0.95).abs() < 1e-12 && (young(abaqus(&warm).expect("a file")) / cold - 1.0).abs() < 1e-12
    );
}

#[test]
fn tables_that_make_no_sense_are_named() {
    let iso = |celsius| (celsius, Constants::Isotropic(1e9, 0.3));
    let other = Constants::Orthotropic(Orthotropic { young: [1e9; 3], poisson: [0.2; 3], shear: [4e8; 3] });
    for (table, words) in [
        (vec![], "no row"),
        (vec![iso(20.0), iso(20.0)], "20 °C follows 20 °C"),
        (vec![iso(20.0), (40.0, other)], "isotropic and orthotropic"),
    ] {
        let error = Material::at("pad", 30.0, &table, 1.0).expect_err("no material").to_string();
        assert!(error.contains(words) && error.contains("pad"), "{error}");
    }
}
