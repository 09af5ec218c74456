//! The matrices of all elements, summed up.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::penalty::{Penalty, Springs};
use super::{Numbering, Pattern, Pencil, Rows, Supports, Symmetric, check_joined};
use crate::Error;
use crate::contact::Point;
use crate::elements::{Kind, Matrices, add_geometric, matrices};
use crate::material::Material;
use crate::mesh::{self, Mesh};

/// All that the matrices are made of.
#[derive(Debug, Clone, Default)]
pub struct Model {
    /// Nodes and elements.
    pub mesh: Mesh,
    /// Materials, by the groups' indices.
    pub materials: Vec<Material>,
    /// Supports and bonds.
    pub supports: Supports,
    /// Points of sliding contact.
    pub contact: Vec<Point>,
    /// A contact stiffness, where normal displacements are not to be tied.
    pub penalty: Option<Penalty>,
    /// Displacements (m) of all nodes whose stress stiffens the bodies: those of a static step. That is the stiffness of the elements
    /// only: how the contact's normals turn is left out.
    pub stressed: Option<Vec<[f64; 3]>>,
}

impl Model {
    /// The matrices of one element.
    ///
    /// # Errors
    /// Where the element is inverted or its material is missing.
    pub(crate) fn element(
        &self,
        element: usize,
        kind: Kind,
        material: usize,
        nodes: &[usize],
    ) -> Result<(Matrices, &Material), Error> {
        let material = self.materials.get(material).ok_or_else(|| Error::Mesh {
            what: format!(
                "element {element} is of material {material}, but there are only {}",
                self.materials.len()
            ),
        })?;
        let places: Vec<[f64; 3]> = nodes.iter().map(|node| self.mesh.nodes[*node]).collect();
        let inverted = |determinant| Error::Inverted { element, kind: kind.name(), determinant };
        let mut matrices = matrices(kind, &places, material).map_err(inverted)?;
        if let Some(moved) = &self.stressed {
            let moved: Vec<[f64; 3]> = nodes.iter().map(|node| moved[*node]).collect();
            add_geometric(&mut matrices.stiffness, kind, &places, material, &moved).map_err(inverted)?;
        }
        Ok((matrices, material))
    }
}

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
        let rows: Vec<&[(usize, f64)]> =
            (0..size).map(|i| numbering.rows[3 * nodes[i / 3] + i % 3].as_slice()).collect();
        for j in 0..size {
            for (column, fj) in rows[j] {
                let from = pattern.start[*column];
                let entries = &pattern.row[from..pattern.start[*column + 1]];
                for i in 0..size {
                    for (row, fi) in rows[i] {
                        let at = from + entries.partition_point(|r| r < row);
                        let (k, m) = (matrices.stiffness[i * size + j], matrices.mass[i * size + j]);
                        stiffness.values[at] += fi * fj * k;
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
                    let (k, m) = (along(&matrices.stiffness), along(&matrices.mass));
                    for (column, f) in *row {
                        let sums = normal[*index].entry(*column).or_default();
                        for (sum, part) in sums.iter_mut().zip([k, m, alpha * m + beta * k]) {
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

/// v·(u_s − Σ w u_m) of each contact point along a direction v of it: S for the direction of sliding.
pub(super) fn along(
    numbering: &Numbering,
    contact: &[Point],
    direction: impl Fn(&Point) -> [f64; 3],
) -> Rows {
    let row = |point: &Point| {
        let v = direction(point);
        let sides = std::iter::once((point.slave, 1.0)).chain(point.masters.iter().map(|(m, w)| (*m, -w)));
        weighted(
            sides.flat_map(|(node, w)| {
                (0..3).map(move |axis| (w * v[axis], &numbering.rows[3 * node + axis]))
            }),
        )
    };
    Rows { rows: contact.iter().map(row).collect() }
}

/// The sum of some rows, each with a factor.
pub(super) fn weighted<'a>(rows: impl Iterator<Item = (f64, &'a Vec<(usize, f64)>)>) -> Vec<(usize, f64)> {
    let mut sums: BTreeMap<usize, f64> = BTreeMap::new();
    for (factor, row) in rows {
        for (unknown, f) in row {
            *sums.entry(*unknown).or_default() += factor * f;
        }
    }
    sums.into_iter().filter(|(_, v)| v.abs() > 0.0).collect()
}
