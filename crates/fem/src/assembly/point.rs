//! A point of sliding contact.

use std::collections::BTreeMap;

use crate::mesh::FaceRef;

/// A point of sliding contact: the normal displacement of a slave node is tied, and friction acts on its slip.
///
/// The normal points from the master's side to the slave's: a compressive force pushes the slave along it. The slave slides
/// along `direction` relative to the master, friction pulls it back.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// The node whose normal displacement is tied.
    pub slave: usize,
    /// The nodes that it slides on and their weights, which sum to 1; none where it slides on a rigid surface.
    pub masters: Vec<(usize, f64)>,
    /// Unit vector.
    pub normal: [f64; 3],
    /// Unit vector across the normal.
    pub direction: [f64; 3],
}

/// Places on faces (coordinates of the reference face) and the area of each, m², for faces that lie on their masters in part only.
pub type Partly = BTreeMap<FaceRef, Vec<([f64; 2], f64)>>;
