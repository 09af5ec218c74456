//! The matrices of a contact by penalty.

use super::along::{along, weighted};
use super::{Model, Numbering, Penalty, Rows, Surface, Symmetric};
use crate::Error;

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
        let surface = Surface::new(model, numbering, &penalty.faces, &model.contact);
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
