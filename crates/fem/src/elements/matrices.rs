//! Stiffness and consistent mass of one element.

use super::{Inertia, Kind, Point, Shape, mass_rule, shape, stiffness_rule};
use crate::material::{Material, inverse3};

/// Square matrices of one element, row by row; degree of freedom 3 a + i is direction i of local node a.
#[derive(Debug, Clone)]
pub struct Matrices {
    /// ∫ Bᵀ D B dV, N/m.
    pub stiffness: Vec<f64>,
    /// ∫ ρ Nᵀ N dV, kg.
    pub mass: Vec<f64>,
    /// The stiffness without that of a stress, where one stiffens the element.
    pub unstressed: Option<Vec<f64>>,
}

impl Matrices {
    /// The stiffness of the material alone, N/m: what loses energy.
    #[must_use]
    pub fn elastic(&self) -> &[f64] {
        self.unstressed.as_ref().unwrap_or(&self.stiffness)
    }
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
pub fn matrices(
    kind: Kind,
    nodes: &[[f64; 3]],
    material: &Material,
    inertia: Inertia,
) -> Result<Matrices, f64> {
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
    for point in mass_rule(kind, inertia) {
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
    Ok(Matrices { stiffness, mass, unstressed: None })
}

fn positive(determinant: f64) -> Result<f64, f64> {
    if determinant > 0.0 { Ok(determinant) } else { Err(determinant) }
}

/// ∂N/∂x of each node at a place in the reference element, and the determinant of the Jacobian there.
fn slopes(kind: Kind, nodes: &[[f64; 3]], at: [f64; 3]) -> Result<(Vec<[f64; 3]>, f64), f64> {
    let gradient = shape(kind, at).gradient;
    let (inverse, determinant) = inverse3(&jacobian(nodes, &gradient));
    // ∂N/∂x_i = Σ_j (J⁻¹)_ij ∂N/∂ξ_j
    let slope =
        |d: &[f64; 3]| [0, 1, 2].map(|i| inverse[i][0] * d[0] + inverse[i][1] * d[1] + inverse[i][2] * d[2]);
    Ok((gradient.iter().map(slope).collect(), positive(determinant)?))
}

/// Adds ∫ ∇N_aᵀ σ ∇N_b dV to each direction, where σ is the stress that displacements (m) of the nodes make: a tension stiffens, as in a
/// string, a compression softens.
///
/// # Errors
/// The determinant of the Jacobian, where it is not positive at a point of integration.
pub(crate) fn add_geometric(
    stiffness: &mut [f64],
    kind: Kind,
    nodes: &[[f64; 3]],
    material: &Material,
    displacement: &[[f64; 3]],
) -> Result<(), f64> {
    let size = 3 * nodes.len();
    for point in stiffness_rule(kind) {
        let (slopes, determinant) = slopes(kind, nodes, point.at)?;
        let mut strain = [0.0; 6];
        for (slope, u) in slopes.iter().zip(displacement) {
            for (part, u) in strains(*slope).iter().zip(u) {
                strain.iter_mut().zip(part).for_each(|(sum, e)| *sum += e * u);
            }
        }
        let [xx, yy, zz, xy, yz, zx] =
            material.stiffness.map(|row| row.iter().zip(&strain).map(|(c, e)| c * e).sum::<f64>());
        let stress = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
        for (a, da) in slopes.iter().enumerate() {
            for (b, db) in slopes.iter().enumerate() {
                let along = |row: &[f64; 3]| row.iter().zip(db).map(|(s, d)| s * d).sum::<f64>();
                let work: f64 = stress.iter().zip(da).map(|(row, d)| d * along(row)).sum();
                for i in 0..3 {
                    stiffness[(3 * a + i) * size + 3 * b + i] += point.weight * determinant * work;
                }
            }
        }
    }
    Ok(())
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
    let (slopes, determinant) = slopes(kind, nodes, point.at)?;
    let scale = determinant * point.weight;
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
