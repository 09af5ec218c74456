//! Flat surfaces of a mesh: their area and normal.

use crate::elements::{face_rule, face_shape};
use crate::mesh::{FaceRef, Mesh};

/// Area (m²) and outward unit normal of some faces.
///
/// # Errors
/// No faces; faces that do not all point the same way.
pub(super) fn flat(mesh: &Mesh, faces: &[FaceRef]) -> Result<(f64, [f64; 3]), String> {
    /// The normals of two places of a flat surface may differ by this much, as an angle.
    const FLAT: f64 = 1e-5;
    let (mut area, mut sum) = (0.0, [0.0; 3]);
    for face in mesh.resolve(faces) {
        for (at, weight) in face_rule(face.kind) {
            let (_, gradient) = face_shape(face.kind, at);
            let normal = face.area(&gradient, &mesh.nodes);
            area += weight * normal.iter().map(|c| c * c).sum::<f64>().sqrt();
            (0..3).for_each(|i| sum[i] += weight * normal[i]);
        }
    }
    let length = sum.iter().map(|c| c * c).sum::<f64>().sqrt();
    if !(area > 0.0) {
        return Err("the surface has no face: name a set of faces".to_owned());
    }
    // |Σ n dA| = Σ dA cos(angle), and 1 − cos is half the square of the angle.
    if length < area * (1.0 - 0.5 * FLAT * FLAT) - area * 1e-12 {
        return Err(format!(
            "the surface is not flat: its normals add up to {length:.3e} m2 on an area of {area:.3e} m2, name a flat part of it"
        ));
    }
    Ok((area, sum.map(|c| c / length)))
}
