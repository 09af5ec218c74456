//! Single elements against closed forms.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};
use squealmap_fem::elements::{
    Inertia, Kind, face_rule, face_shape, mass_rule, matrices, shape, stiffness_rule,
};
use squealmap_fem::material::{Material, Orthotropic};

use crate::cases::steel;

pub(crate) const KINDS: [Kind; 6] =
    [Kind::Hex8, Kind::Hex20, Kind::Hex20Reduced, Kind::Tet4, Kind::Tet10, Kind::Wedge15];

/// An affine image of the reference element: volumes are known.
fn skewed(kind: Kind) -> Vec<[f64; 3]> {
    let map = |[x, y, z]: [f64; 3]| [2.0 * x + 0.3 * y, 1.5 * y - 0.2 * z, 0.4 * x + z];
    kind.reference().into_iter().map(map).collect()
}

/// det of the map above: 2 (1.5 · 1 − 0) − 0.3 (0 + 0.2 · 0.4).
const SKEW: f64 = 3.0 - 0.3 * 0.08;

fn volume(kind: Kind) -> f64 {
    SKEW * match kind {
        Kind::Hex8 | Kind::Hex20 | Kind::Hex20Reduced => 8.0,
        Kind::Tet4 | Kind::Tet10 => 1.0 / 6.0,
        Kind::Wedge15 => 1.0,
    }
}

#[test]
fn a_shape_function_is_one_at_its_node_and_zero_at_the_others() {
    for kind in KINDS {
        for (i, at) in kind.reference().into_iter().enumerate() {
            for (j, value) in shape(kind, at).value.into_iter().enumerate() {
                assert!((value - f64::from(u8::from(i == j))).abs() < 1e-14, "{} {i} {j}", kind.name());
            }
        }
    }
}

#[test]
fn derivatives_are_those_of_the_values() {
    let step = 1e-6;
    for kind in KINDS {
        let at = [0.21, 0.17, -0.13];
        let exact = shape(kind, at).gradient;
        for axis in 0..3 {
            let moved = |by: f64| {
                let mut at = at;
                at[axis] += by;
                shape(kind, at).value
            };
            for (node, (a, b)) in moved(step).iter().zip(moved(-step)).enumerate() {
                assert!((exact[node][axis] - (a - b) / (2.0 * step)).abs() < 1e-9, "{} {node}", kind.name());
            }
        }
    }
}

#[test]
fn faces_have_the_shape_functions_of_their_element() {
    for kind in KINDS {
        let reference = kind.reference();
        for number in 0..kind.face_corners().len() {
            let (face, local) = kind.face(number);
            for (at, _) in face_rule(face) {
                let (value, _) = face_shape(face, at);
                let place = [0, 1, 2]
                    .map(|i| local.iter().zip(&value).map(|(n, v)| reference[*n][i] * v).sum::<f64>());
                let solid = shape(kind, place).value;
                for (node, v) in local.iter().zip(&value) {
                    assert!((solid[*node] - v).abs() < 1e-13, "{} face {number}", kind.name());
                }
                let on_face: f64 = local.iter().map(|node| solid[*node]).sum();
                assert!((on_face - 1.0).abs() < 1e-13);
            }
        }
    }
}

/// ∫ x^a y^b z^c over the reference tetrahedron is a! b! c!/(a + b + c + 3)!.
#[test]
fn rules_integrate_the_polynomials_they_are_for() {
    let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
    for (kind, degree, rule) in [
        (Kind::Tet10, 4, mass_rule(Kind::Tet10, Inertia::Exact)),
        (Kind::Tet10, 2, stiffness_rule(Kind::Tet10)),
        (Kind::Tet4, 1, stiffness_rule(Kind::Tet4)),
    ] {
        for (a, b, c) in (0..=4).flat_map(|a| (0..=4).flat_map(move |b| (0..=4).map(move |c| (a, b, c)))) {
            if a + b + c > degree {
                continue;
            }
            let power = |x: [f64; 3]| x[0].powi(a) * x[1].powi(b) * x[2].powi(c);
            let sum: f64 = rule.iter().map(|p| p.weight * power(p.at)).sum();
            let [a, b, c] = [a, b, c].map(i32::unsigned_abs);
            let exact = factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 3);
            assert!((sum - exact).abs() < 1e-15, "{} {a} {b} {c}", kind.name());
        }
    }
    // The wedge: ∫ x^a y^b over the triangle is a! b!/(a + b + 2)!, ∫ z⁴ is 2/5.
    for (a, b) in (0..=4).flat_map(|a| (0..=4 - a).map(move |b| (a, b))) {
        let power = |x: [f64; 3]| x[0].powi(a) * x[1].powi(b) * x[2].powi(4);
        let sum: f64 = mass_rule(Kind::Wedge15, Inertia::Exact).iter().map(|p| p.weight * power(p.at)).sum();
        let [a, b] = [a, b].map(i32::unsigned_abs);
        let exact = 0.4 * factorial(a) * factorial(b) / factorial(a + b + 2);
        assert!((sum - exact).abs() < 1e-15, "wedge {a} {b}");
    }
}

#[test]
fn masses_sum_to_density_times_volume() {
    for kind in KINDS {
        let made = matrices(kind, &skewed(kind), &steel(), Inertia::Exact).expect("a sound element");
        let size = 3 * kind.nodes();
        for axis in 0..3 {
            let along = |i: &usize| i % 3 == axis;
            let total: f64 = (0..size)
                .filter(along)
                .flat_map(|i| (0..size).filter(along).map(move |j| i * size + j))
                .map(|k| made.mass[k])
                .sum();
            let exact = 7800.0 * volume(kind);
            assert!((total - exact).abs() < 1e-12 * exact, "{}: {total} {exact}", kind.name());
        }
    }
}

/// 1/2 uᵀ K u of a linear displacement is the energy of its constant strain, 1/2 εᵀ D ε V, also where three axes differ.
#[test]
fn a_constant_strain_has_its_energy() {
    let constants =
        Orthotropic { young: [12e9, 9e9, 3e9], poisson: [0.25, 0.2, 0.3], shear: [3e9, 1.5e9, 2e9] };
    let lining = Material::orthotropic("lining", constants, 2500.0).expect("stable constants");
    let gradient = [[1.0, 0.4, -0.2], [0.1, -0.6, 0.3], [0.5, 0.2, 0.8]];
    let strain = [
        gradient[0][0],
        gradient[1][1],
        gradient[2][2],
        gradient[0][1] + gradient[1][0],
        gradient[1][2] + gradient[2][1],
        gradient[2][0] + gradient[0][2],
    ];
    // By the compliance that the constants are defined with: ε = S σ, energy σᵀ S σ.
    let s = |i: usize, j: usize| {
        let [x, y, z] = constants.young;
        let [xy, yz, xz] = constants.poisson;
        let [gxy, gyz, gzx] = constants.shear;
        [
            [1.0 / x, -xy / x, -xz / x, 0.0, 0.0, 0.0],
            [-xy / x, 1.0 / y, -yz / y, 0.0, 0.0, 0.0],
            [-xz / x, -yz / y, 1.0 / z, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 1.0 / gxy, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, 1.0 / gyz, 0.0],
            [0.0, 0.0, 0.0, 0.0, 0.0, 1.0 / gzx],
        ][i][j]
    };
    let stress = Mat::from_fn(6, 6, s).partial_piv_lu().solve(Mat::from_fn(6, 1, |i, _| strain[i]));
    let density: f64 = (0..6).map(|i| strain[i] * stress[(i, 0)]).sum();
    for kind in KINDS {
        let nodes = skewed(kind);
        let made = matrices(kind, &nodes, &lining, Inertia::Exact).expect("a sound element");
        let u: Vec<f64> = nodes
            .iter()
            .flat_map(|x| gradient.map(|row| (0..3).map(|j| row[j] * x[j]).sum::<f64>()))
            .collect();
        let size = u.len();
        let energy: f64 = (0..size * size).map(|k| u[k / size] * made.stiffness[k] * u[k % size]).sum();
        let exact = density * volume(kind);
        assert!((energy - exact).abs() < 1e-12 * exact, "{}: {energy} {exact}", kind.name());
    }
}

/// Six motions of a rigid body have no energy, all others have; Hex20 with 2 × 2 × 2 points has six more that have none
/// (Cook, Concepts and Applications of Finite Element Analysis).
#[test]
fn six_motions_are_rigid() {
    for kind in KINDS {
        let made = matrices(kind, &skewed(kind), &steel(), Inertia::Exact).expect("a sound element");
        let size = 3 * kind.nodes();
        let matrix = Mat::from_fn(size, size, |i, j| made.stiffness[i * size + j]);
        let values = matrix.self_adjoint_eigenvalues(Side::Lower).expect("a symmetric matrix");
        let largest = values.iter().copied().fold(0.0, f64::max);
        let zeros = values.iter().filter(|v| v.abs() < 1e-12 * largest).count();
        let expected = if kind == Kind::Hex20Reduced { 12 } else { 6 };
        assert_eq!(zeros, expected, "{}: {values:?}", kind.name());
    }
}
