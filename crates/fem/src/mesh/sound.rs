//! Whether a mesh can be computed with: nodes that are there, elements that are not turned inside out.

use super::Mesh;
use crate::Error;
use crate::elements::{Inertia, jacobian, mass_rule, shape, stiffness_rule};
use crate::material::inverse3;

/// Checks every element of a mesh.
///
/// # Errors
/// The first element that names a missing node, names one twice, has a wrong number of nodes, or whose Jacobian determinant is
/// not positive at a corner or a point of integration; a place that is no number; a mesh without elements.
pub fn check(mesh: &Mesh) -> Result<(), Error> {
    if mesh.elements().next().is_none() {
        return Err(Error::Mesh { what: "the mesh has no solid element: give it at least one".to_owned() });
    }
    if let Some(node) = mesh.nodes.iter().position(|x| x.iter().any(|c| !c.is_finite())) {
        return Err(Error::Mesh { what: format!("a coordinate of node {node} is not a finite number") });
    }
    for (element, kind, _, nodes) in mesh.elements() {
        let wrong = |what| Error::Connectivity { element, kind: kind.name(), what };
        if nodes.len() != kind.nodes() {
            return Err(wrong(format!("has {} nodes, it needs {}", nodes.len(), kind.nodes())));
        }
        if let Some(node) = nodes.iter().find(|node| **node >= mesh.nodes.len()) {
            return Err(wrong(format!("names node {node}, but there are only {}", mesh.nodes.len())));
        }
        if let Some(node) = nodes.iter().enumerate().find(|(i, node)| nodes[..*i].contains(node)) {
            return Err(wrong(format!("names node {} twice", node.1)));
        }
        let places: Vec<[f64; 3]> = nodes.iter().map(|node| mesh.nodes[*node]).collect();
        // Corners, too: swapped nodes of a quadratic element can leave the points of integration as they should be.
        let corners = kind.reference().into_iter().take(kind.corners());
        for at in corners
            .chain(stiffness_rule(kind).iter().chain(&mass_rule(kind, Inertia::Exact)).map(|point| point.at))
        {
            let (_, determinant) = inverse3(&jacobian(&places, &shape(kind, at).gradient));
            if !(determinant > 0.0) {
                return Err(Error::Inverted { element, kind: kind.name(), determinant });
            }
        }
    }
    Ok(())
}
