//! Stiffness and consistent mass of one element.

use super::{Kind, Point, Shape, mass_rule, shape, stiffness_rule};
use crate::material::{Material, inverse3};

/// Square matrices of one element, row by row; degree of freedom 3 a + i is direction i of local node a.
#[derive(Debug, Clone)]
pub struct Matrices {
    /// ∫ Bᵀ D B dV, N/m.
    pub stiffness: Vec<f64>,
    /// ∫ ρ Nᵀ N dV, kg.
    pub mass: Vec<f64>,
}

/// ∂x_j/∂ξ_i in row i and column j.
pub(crate) fn jacobian(nodes: &[[f64; 3]], gradient: &[[f64; 3]]) -> [[f64; 3]; 3] {
    let mut jacobian = [[0.0; 3]; 3];
    for (x, d) in nodes.iter().zip(gradient) {
        for i in 0..3 {
            for j in 0..3 {
                jacobian[i][j] += d[i] * x[j];
            }
        }
    }
    jacobian
}

/// Stiffness and mass of an element with nodes at these places (m).
///
/// # Errors
/// The determinant of the Jacobian, where it is not positive at a point of integration.
pub fn matrices(kind: Kind, nodes: &[[f64; 3]], material: &Material) -> Result<Matrices, f64> {
    let size = 3 * kind.nodes();
    let mut stiffness = vec![0.0; size * size];
    for point in stiffness_rule(kind) {
        add_stiffness(&mut stiffness, kind, nodes, material, point)?;
    }
    for i in 0..size {
        for j in 0..i {
            stiffness[i * size + j] = stiffness[j * size + i];
        }
    }
    let mut mass = vec![0.0; size * size];
    for point in mass_rule(kind) {
        let Shape { value, gradient } = shape(kind, point.at);
        let determinant = positive(inverse3(&jacobian(nodes, &gradient)).1)?;
        let scale = material.density * determinant * point.weight;
        for (a, na) in value.iter().enumerate() {
            for (b, nb) in value.iter().enumerate() {
                for i in 0..3 {
                    mass[(3 * a + i) * size + 3 * b + i] += scale * na * nb;
                }
            }
        }
    }
    Ok(Matrices { stiffness, mass })
}

fn positive(determinant: f64) -> Result<f64, f64> {
    if determinant > 0.0 { Ok(determinant) } else { Err(determinant) }
}

/// Adds the upper blocks of one point: K_ab += B_aᵀ D B_b |J| w for a ≤ b.
fn add_stiffness(
    stiffness: &mut [f64],
    kind: Kind,
    nodes: &[[f64; 3]],
    material: &Material,
    point: Point,
) -> Result<(), f64> {
    let size = 3 * nodes.len();
    let gradient = shape(kind, point.at).gradient;
    let (inverse, determinant) = inverse3(&jacobian(nodes, &gradient));
    let scale = positive(determinant)? * point.weight;
    // ∂N/∂x_i = Σ_j (J⁻¹)_ij ∂N/∂ξ_j
    let slopes: Vec<[f64; 3]> = gradient
        .iter()
        .map(|d| [0, 1, 2].map(|i| inverse[i][0] * d[0] + inverse[i][1] * d[1] + inverse[i][2] * d[2]))
        .collect();
    for (b, db) in slopes.iter().enumerate() {
        let strain = strains(*db);
        // D B_b: the stress per displacement of node b along each direction.
        let stress = strain.map(|e| {
            let mut s = [0.0; 6];
            for (s, row) in s.iter_mut().zip(&material.stiffness) {
                *s = scale * row.iter().zip(&e).map(|(c, e)| c * e).sum::<f64>();
            }
            s
        });
        for (a, da) in slopes.iter().enumerate().take(b + 1) {
            for (j, s) in stress.iter().enumerate() {
                let column = 3 * b + j;
                // B_aᵀ σ: each row of the divergence.
                stiffness[3 * a * size + column] += da[0] * s[0] + da[1] * s[3] + da[2] * s[5];
                stiffness[(3 * a + 1) * size + column] += da[1] * s[1] + da[0] * s[3] + da[2] * s[4];
                stiffness[(3 * a + 2) * size + column] += da[2] * s[2] + da[1] * s[4] + da[0] * s[5];
            }
        }
    }
    Ok(())
}

/// The strains xx, yy, zz, xy, yz, zx that a unit displacement of a node along x, y, z makes.
fn strains([x, y, z]: [f64; 3]) -> [[f64; 6]; 3] {
    [[x, 0., 0., y, 0., z], [0., y, 0., x, z, 0.], [0., 0., z, 0., y, x]]
}
