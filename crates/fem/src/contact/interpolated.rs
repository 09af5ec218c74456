//! Bonds between surfaces whose nodes do not match, node by node: each slave moves as the master's face does at its place.
//!
//! A slave has the nodes of one face as masters, where those of a mortar bond are all nodes of the surface: large surfaces stay sparse.
//! Linear displacements pass through exactly; a constant pressure does where the edges of the master's faces lie on edges of the slaves'.

use super::mortar::{Flat, across, one_plane};
use crate::Error;
use crate::assembly::Tie;
use crate::mesh::{FaceRef, Mesh};

/// Bonds the nodes of some flat faces to others.
///
/// # Errors
/// Surfaces that do not lie in one plane; a slave node beside all faces of the master.
pub fn bonded_points(
    mesh: &Mesh,
    slaves: &[FaceRef],
    masters: &[FaceRef],
    normal: [f64; 3],
) -> Result<Vec<Tie>, Error> {
    /// A node may lie outside a face by this part of the size of the mesh: what coordinates written with few digits lose.
    const OUTSIDE: f64 = 1e-6;
    /// Weights below this are what rounding makes of zero.
    const ZERO: f64 = 1e-13;
    let [first, second] = across(normal);
    let (slave_faces, master_faces) = (mesh.resolve(slaves), mesh.resolve(masters));
    one_plane(mesh, normal, slave_faces.iter().chain(&master_faces))?;
    let flats: Vec<Flat> = master_faces.iter().map(|face| Flat::new(mesh, face, first, second)).collect();
    let limit = OUTSIDE * mesh.extent();
    let tie = |slave: usize| {
        let x = mesh.nodes[slave];
        let place = [first, second].map(|axis| (0..3).map(|i| axis[i] * x[i]).sum::<f64>());
        let nearest = flats.iter().map(|flat| (flat.outside(place), flat)).min_by(|a, b| a.0.total_cmp(&b.0));
        match nearest {
            Some((distance, flat)) if distance <= limit => {
                let weights = flat.nodes.iter().copied().zip(flat.shape_at(place));
                Ok(Tie { slave, masters: weights.filter(|(_, w)| w.abs() > ZERO).collect() })
            }
            other => Err(Error::Contact {
                what: format!(
                    "node {slave} of a bond at ({:.6}, {:.6}, {:.6}) m lies {:.2e} m beside the other surface (limit {limit:.1e} m): let the larger \
                     surface be the master, or name other faces",
                    x[0],
                    x[1],
                    x[2],
                    other.map_or(f64::INFINITY, |(distance, _)| distance)
                ),
            }),
        }
    };
    mesh.face_nodes(slaves).into_iter().map(tie).collect()
}
