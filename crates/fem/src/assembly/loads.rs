//! Loads: pressure on faces, forces on nodes, displacements that are prescribed.

use super::{Model, Numbering};
use crate::Error;
use crate::elements::{face_rule, face_shape};
use crate::mesh::FaceRef;

/// Loads of a static step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Loads {
    /// Faces and the pressure (Pa) that pushes them inwards.
    pub pressure: Vec<(Vec<FaceRef>, f64)>,
    /// Nodes and forces, N.
    pub forces: Vec<(usize, [f64; 3])>,
}

/// Forces on all nodes, N, without those that prescribed displacements make.
#[must_use]
pub fn nodal_forces(model: &Model, loads: &Loads) -> Vec<[f64; 3]> {
    let mut forces = vec![[0.0; 3]; model.mesh.nodes.len()];
    for (node, force) in &loads.forces {
        (0..3).for_each(|i| forces[*node][i] += force[i]);
    }
    for (faces, pressure) in &loads.pressure {
        for face in model.mesh.resolve(faces) {
            for (at, weight) in face_rule(face.kind) {
                let (value, gradient) = face_shape(face.kind, at);
                let area = face.area(&gradient, &model.mesh.nodes);
                for (node, n) in face.nodes.iter().zip(&value) {
                    (0..3).for_each(|i| forces[*node][i] -= pressure * weight * n * area[i]);
                }
            }
        }
    }
    forces
}

/// The forces K u (N) that hold the nodes of the elements in displacements u (m): loads, reactions and contact forces.
///
/// # Errors
/// Bad elements.
pub fn internal_forces(model: &Model, displacement: &[[f64; 3]]) -> Result<Vec<[f64; 3]>, Error> {
    let mut forces = vec![[0.0; 3]; model.mesh.nodes.len()];
    for (element, kind, material, nodes) in model.mesh.elements() {
        let (matrices, _) = model.element(element, kind, material, nodes)?;
        let moved: Vec<f64> = nodes.iter().flat_map(|node| displacement[*node]).collect();
        for (i, row) in matrices.stiffness.chunks_exact(moved.len()).enumerate() {
            forces[nodes[i / 3]][i % 3] += row.iter().zip(&moved).map(|(k, u)| k * u).sum::<f64>();
        }
    }
    Ok(forces)
}

/// The right-hand side Zᵀ (f − K g) in N, and n·(f − K g) of each contact point's slave node.
///
/// # Errors
/// Bad elements.
pub fn load_vector(
    model: &Model,
    numbering: &Numbering,
    loads: &Loads,
) -> Result<(Vec<f64>, Vec<f64>), Error> {
    let mut forces: Vec<f64> = nodal_forces(model, loads).into_iter().flatten().collect();
    if numbering.given.iter().any(|g| *g != 0.0) {
        let given: Vec<[f64; 3]> = numbering.given.chunks_exact(3).map(|g| [g[0], g[1], g[2]]).collect();
        let held = internal_forces(model, &given)?;
        forces.iter_mut().zip(held.iter().flatten()).for_each(|(f, k)| *f -= k);
    }
    let mut unknowns = vec![0.0; numbering.unknowns];
    for (row, force) in numbering.rows.iter().zip(&forces) {
        for (i, f) in row {
            unknowns[*i] += f * force;
        }
    }
    let mut normal = vec![0.0; model.contact.len()];
    // The force of a contact stiffness is that of its overlap alone.
    let tied: &[_] = if model.penalty.is_some() { &[] } else { &model.contact };
    for (sum, point) in normal.iter_mut().zip(tied) {
        for node in
            (0..model.mesh.nodes.len()).filter(|n| numbering.leader[*n] == numbering.leader[point.slave])
        {
            *sum += (0..3).map(|i| point.normal[i] * forces[3 * node + i]).sum::<f64>();
        }
    }
    Ok((unknowns, normal))
}
