//! What a model is.

use super::{Partly, Penalty, Point, Supports};
use crate::Error;
use crate::elements::{Inertia, Kind, Matrices, add_geometric, matrices};
use crate::material::Material;
use crate::mesh::Mesh;

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
    /// How slave faces are integrated that hang over the edge of their masters.
    pub partly: Partly,
    /// A contact stiffness, where normal displacements are not to be tied.
    pub penalty: Option<Penalty>,
    /// Displacements (m) of all nodes whose stress stiffens the bodies: those of a static step. That is the stiffness of the elements
    /// only: how the contact's normals turn is left out.
    pub stressed: Option<Vec<[f64; 3]>>,
    /// Where the mass of elements is integrated.
    pub inertia: Inertia,
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
        let mut matrices = matrices(kind, &places, material, self.inertia).map_err(inverted)?;
        if let Some(moved) = &self.stressed {
            let moved: Vec<[f64; 3]> = nodes.iter().map(|node| moved[*node]).collect();
            matrices.unstressed = Some(matrices.stiffness.clone());
            add_geometric(&mut matrices.stiffness, kind, &places, material, &moved).map_err(inverted)?;
        }
        Ok((matrices, material))
    }
}
