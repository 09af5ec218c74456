//! Contact by a stiffness instead of multipliers: the surfaces overlap a little, and the normal force grows with that.
//!
//! The normal forces are N = −k A g with the gaps g = G_n u of the contact points and A = ∫ N_a N_b dA. That adds Gᵀ k A G to K, with
//! G = G_n Z, and makes K_n = −k A G; inertia and damping of the surface have no part in N.

use super::build::{along, weighted};
use super::{Model, Numbering, Rows, Symmetric};
use crate::Error;
use crate::contact::Surface;
use crate::mesh::FaceRef;

/// A contact stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct Penalty {
    /// Pressure per overlap k, Pa/m.
    pub stiffness: f64,
    /// Faces of the slaves.
    pub faces: Vec<FaceRef>,
}

/// The matrices of a contact by penalty.
pub(super) struct Springs {
    /// G.
    gap: Rows,
    /// k A.
    areas: Rows,
    /// −k A G.
    pub(super) normal: Rows,
}

impl Springs {
    /// The springs of a model whose normal displacements are not tied.
    pub(super) fn new(model: &Model, numbering: &Numbering, penalty: &Penalty) -> Result<Self, Error> {
        let k = penalty.stiffness;
        if !(k > 0.0 && k.is_finite()) {
            return Err(Error::Contact {
                what: format!("the contact stiffness is {k} Pa/m, it must be above 0"),
            });
        }
        let surface = Surface::new(&model.mesh, numbering, &penalty.faces, &model.contact);
        let areas = surface.matrix(&vec![k; model.contact.len()]);
        let gap = along(numbering, &model.contact, |point| point.normal);
        let normal =
            areas.rows.iter().map(|row| weighted(row.iter().map(|(j, a)| (-a, &gap.rows[*j])))).collect();
        Ok(Self { gap, areas, normal: Rows { rows: normal } })
    }

    /// The unknowns that each contact point couples.
    pub(super) fn groups(&self) -> Vec<Vec<usize>> {
        let group = |(i, row): (usize, &Vec<(usize, f64)>)| {
            let points = std::iter::once(i).chain(row.iter().map(|(j, _)| *j));
            let mut unknowns: Vec<usize> =
                points.flat_map(|j| self.gap.rows[j].iter().map(|(u, _)| *u)).collect();
            unknowns.sort_unstable();
            unknowns.dedup();
            unknowns
        };
        self.areas.rows.iter().enumerate().map(group).collect()
    }

    /// K + Gᵀ k A G.
    pub(super) fn add_to(&self, stiffness: &mut Symmetric) {
        for (gap, force) in self.gap.rows.iter().zip(&self.normal.rows) {
            for (column, f) in force {
                for (row, g) in gap {
                    if let Some(at) = stiffness.pattern.find(*row, *column) {
                        stiffness.values[at] -= g * f;
                    }
                }
            }
        }
    }
}
