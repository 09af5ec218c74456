//! Real modes where frequencies are equal, against closed forms.

use faer::linalg::solvers::Solve;
use squealmap_fem::assembly::{Model, assemble};
use squealmap_fem::elements::Kind;
use squealmap_fem::mesh::{Block, Grading};
use squealmap_fem::modes::{Factor, Ordering, count_below, lowest};

use crate::cases::steel;

/// A bar of square section bends in two directions with the same frequency: each is found twice, and none is missed.
#[test]
fn equal_frequencies_are_found_twice() {
    let block = Block {
        origin: [0.0; 3],
        size: [0.01, 0.01, 0.06],
        cells: [2.into(), 2.into(), 6.into()],
        kind: Kind::Hex20,
    };
    let mut model =
        Model { mesh: block.mesh().expect("a bar"), materials: vec![steel()], ..Model::default() };
    let end = model.mesh.node_set("z0").expect("a side").to_vec();
    model.supports.clamp(&end);
    let (_, pencil) = assemble(&model).expect("matrices");
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    let found = lowest(&pencil, &factor, 12).expect("real modes").frequencies();
    let twice = found.windows(2).filter(|f| (f[1] / f[0] - 1.0).abs() < 1e-9).count();
    assert!(twice >= 3, "{found:?}");
    for k in 1..12 {
        if found[k] / found[k - 1] > 1.001 {
            let between = f64::midpoint(found[k - 1], found[k]);
            assert_eq!(count_below(&pencil, &ordering, between).expect("a count"), k, "{found:?}");
        }
    }
}

/// A bar that only moves along itself, clamped at one end: (2 k − 1)/4 √(E/ρ)/l with ν = 0, on a graded mesh, to the error of its
/// elements, (k h)⁴/1440 of the longest one at most.
#[test]
fn a_graded_bar_has_its_frequencies() {
    let material =
        squealmap_fem::material::Material::isotropic("bar", 210e9, 0.0, 7800.0).expect("constants");
    let (length, elements) = (0.1, 12);
    let block = Block {
        origin: [0.0; 3],
        size: [0.01, 0.01, length],
        cells: [1.into(), 1.into(), Grading { elements, ratio: 2.0 }],
        kind: Kind::Hex20,
    };
    let mesh = block.mesh().expect("a bar");
    let mut levels: Vec<f64> =
        mesh.groups[0].elements.iter().map(|e| mesh.nodes[e[4]][2] - mesh.nodes[e[0]][2]).collect();
    levels.sort_by(f64::total_cmp);
    assert!((levels[elements - 1] / levels[0] - 2.0).abs() < 1e-12, "{levels:?}");
    let mut model = Model { materials: vec![material], ..Model::default() };
    let all: Vec<usize> = (0..mesh.nodes.len()).collect();
    model.supports.prescribe(&all, 0, 0.0);
    model.supports.prescribe(&all, 1, 0.0);
    model.supports.clamp(mesh.node_set("z0").expect("a side"));
    model.mesh = mesh;
    let (_, pencil) = assemble(&model).expect("matrices");
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    let found = lowest(&pencil, &factor, 3).expect("real modes").frequencies();
    for (k, found) in found.iter().enumerate() {
        let quarters = 2.0 * k as f64 + 1.0;
        let exact = quarters / 4.0 * f64::sqrt(210e9 / 7800.0) / length;
        let wave = quarters * std::f64::consts::FRAC_PI_2 / length * levels[elements - 1];
        let error = found / exact - 1.0;
        assert!(error > 0.0 && error < wave.powi(4) / 1440.0, "{found} Hz, not {exact} Hz: {error:e}");
    }
}

/// All modes that a model has, up to the last: the ω² sum to the trace of M⁻¹ K, here of 252 unknowns.
#[test]
fn every_mode_is_found() {
    let (_, pencil) = assemble(&crate::cases::pin::model(Kind::Hex8, 1).expect("the pin")).expect("matrices");
    let size = pencil.size();
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    let modes = lowest(&pencil, &factor, size).expect("all modes");
    let dense = |matrix: &squealmap_fem::assembly::Symmetric| {
        faer::Mat::from_fn(size, size, |i, j| matrix.pattern.find(i, j).map_or(0.0, |at| matrix.values[at]))
    };
    let solved = dense(&pencil.mass).partial_piv_lu().solve(&dense(&pencil.stiffness));
    let trace: f64 = (0..size).map(|i| solved[(i, i)]).sum();
    let sum: f64 = modes.omega2.iter().sum();
    assert!((sum / trace - 1.0).abs() < 1e-9, "{sum} {trace}");
}
