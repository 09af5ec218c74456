//! The matrices of all elements, summed up.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::along::along;
use super::springs::Springs;
use super::{Model, Numbering, Pattern, Pencil, Point, Rows, Symmetric, check_joined};
use crate::Error;
use crate::mesh::{self};

/// One row of normal forces while it is summed up: stiffness, mass and damping by column.
type NormalRow = BTreeMap<usize, [f64; 3]>;

/// Numbers the unknowns and sums up the matrices.
///
/// # Errors
/// Bad elements, contradicting supports, a missing material, parts that nothing holds.
pub fn assemble(model: &Model) -> Result<(Numbering, Pencil), Error> {
    mesh::check(&model.mesh)?;
    if let Some(moved) = model.stressed.as_ref().filter(|moved| moved.len() != model.mesh.nodes.len()) {
        let (given, nodes) = (moved.len(), model.mesh.nodes.len());
        let what = format!(
            "{given} displacements are given to stiffen the bodies, one for each of {nodes} nodes is needed"
        );
        return Err(Error::Mesh { what });
    }
    let tied: &[Point] = if model.penalty.is_some() { &[] } else { &model.contact };
    let numbering = Numbering::new(&model.mesh, &model.supports, tied)?;
    check_joined(model, &numbering)?;
    let springs = model.penalty.as_ref().map(|p| Springs::new(model, &numbering, p)).transpose()?;
    let mut groups: Vec<Vec<usize>> =
        model.mesh.elements().map(|(_, _, _, nodes)| unknowns_of(&numbering, nodes)).collect();
    groups.extend(springs.iter().flat_map(Springs::groups));
    let pattern = Arc::new(Pattern::of(numbering.unknowns, &groups));
    let mut stiffness = Symmetric::zero(pattern.clone());
    let mut mass = Symmetric::zero(pattern.clone());
    let damped = model.materials.iter().any(|m| m.rayleigh.iter().any(|c| c.abs() > 0.0));
    let mut damping = damped.then(|| Symmetric::zero(pattern.clone()));

    // Contact points by the leader of their slave node.
    let mut points: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (i, point) in tied.iter().enumerate() {
        points.entry(numbering.leader[point.slave]).or_default().push(i);
    }
    let mut normal: Vec<NormalRow> = vec![NormalRow::new(); model.contact.len()];

    for (element, kind, material, nodes) in model.mesh.elements() {
        let (matrices, material) = model.element(element, kind, material, nodes)?;
        let size = 3 * nodes.len();
        let [alpha, beta] = material.rayleigh;
        let elastic = matrices.elastic();
        let rows: Vec<&[(usize, f64)]> =
            (0..size).map(|i| numbering.rows[3 * nodes[i / 3] + i % 3].as_slice()).collect();
        for j in 0..size {
            for (column, fj) in rows[j] {
                let from = pattern.start[*column];
                let entries = &pattern.row[from..pattern.start[*column + 1]];
                for i in 0..size {
                    for (row, fi) in rows[i] {
                        let at = from + entries.partition_point(|r| r < row);
                        let (k, m) = (elastic[i * size + j], matrices.mass[i * size + j]);
                        stiffness.values[at] += fi * fj * matrices.stiffness[i * size + j];
                        mass.values[at] += fi * fj * m;
                        if let Some(damping) = &mut damping {
                            damping.values[at] += fi * fj * (alpha * m + beta * k);
                        }
                    }
                }
            }
        }
        for (a, node) in nodes.iter().enumerate() {
            for index in points.get(&numbering.leader[*node]).into_iter().flatten() {
                let n = model.contact[*index].normal;
                for (j, row) in rows.iter().enumerate() {
                    let along =
                        |matrix: &[f64]| (0..3).map(|i| n[i] * matrix[(3 * a + i) * size + j]).sum::<f64>();
                    let [stiffness, k, m] = [&matrices.stiffness, elastic, &matrices.mass].map(along);
                    for (column, f) in *row {
                        let sums = normal[*index].entry(*column).or_default();
                        for (sum, part) in sums.iter_mut().zip([stiffness, m, alpha * m + beta * k]) {
                            *sum += f * part;
                        }
                    }
                }
            }
        }
    }
    let rows = |which: usize| Rows {
        rows: normal.iter().map(|row| row.iter().map(|(i, v)| (*i, v[which])).collect()).collect(),
    };
    let (mut normal_stiffness, normal_mass, normal_damping) = (rows(0), rows(1), rows(2));
    if let Some(springs) = springs {
        springs.add_to(&mut stiffness);
        normal_stiffness = springs.normal;
    }
    let slip = along(&numbering, &model.contact, |point| point.direction);
    Ok((
        numbering,
        Pencil {
            stiffness,
            mass,
            damping,
            modal: Vec::new(),
            slip,
            normal_stiffness,
            normal_mass,
            normal_damping,
        },
    ))
}

/// The unknowns that move the nodes of an element, each once.
fn unknowns_of(numbering: &Numbering, nodes: &[usize]) -> Vec<usize> {
    let mut unknowns: Vec<usize> = nodes
        .iter()
        .flat_map(|node| (0..3).flat_map(move |axis| numbering.rows[3 * node + axis].iter().map(|(i, _)| *i)))
        .collect();
    unknowns.sort_unstable();
    unknowns.dedup();
    unknowns
}
