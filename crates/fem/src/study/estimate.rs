//! What a study would cost, before it starts.

use super::Study;
use crate::Error;
use crate::assembly::assemble;
use crate::modes::Ordering;

/// Size and cost of a study.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Nodes of the mesh.
    pub nodes: usize,
    /// Its elements.
    pub elements: usize,
    /// Unknowns: degrees of freedom without supports, bonds and tied contact.
    pub unknowns: usize,
    /// Points of contact.
    pub points: usize,
    /// Entries of the factor of the stiffness matrix.
    pub entries: usize,
    /// Memory, bytes.
    pub memory: f64,
    /// Time on two cores, seconds.
    pub seconds: f64,
}

/// Sums up the matrices and orders them, which checks the model, but factorises nothing.
///
/// # Errors
/// Those of the model.
pub fn estimate(study: &Study) -> Result<Estimate, Error> {
    let (_, pencil) = assemble(&study.model)?;
    let ordering = Ordering::new(&pencil.stiffness.pattern)?;
    let unknowns = pencil.size();
    let entries = ordering.entries();
    let (n, l) = (unknowns as f64, entries as f64);
    let modes = study.document.modes.count as f64;
    // Two factors at most at a time, K and M, and vectors of Lanczos and of the space.
    let matrices = 24.0 * pencil.stiffness.pattern.row.len() as f64;
    let memory = 8.0 * 1.3 * l + matrices + 8.0 * n * VECTORS * modes;
    let factors = FACTORS + if study.is_pressed() { ROUNDS } else { 0.0 };
    let seconds = factors * FACTOR * l * l / n
        + l * modes * (SOLVES * SOLVE)
        + n * modes * VECTORS * modes * VECTOR
        + study.mus.len() as f64 * modes * l * 2.0 * SOLVE;
    let elements = study.model.mesh.elements().count();
    let nodes = study.model.mesh.nodes.len();
    Ok(Estimate { nodes, elements, unknowns, points: study.model.contact.len(), entries, memory, seconds })
}

/// Vectors that are kept for each mode: Lanczos keeps all, the space some at each coefficient of friction, and shapes.
const VECTORS: f64 = 20.0;
/// Factorisations: at 0 and at the shift that counts the modes.
const FACTORS: f64 = 2.0;
/// Factorisations of a static step, of which each changes what is in contact.
const ROUNDS: f64 = 2.0;
/// Solutions with the factor for each mode, without those of the sweep.
const SOLVES: f64 = 40.0;
/// Seconds of a factorisation over L²/n, with L entries and n unknowns: the operations are the squares of the lengths of the columns.
const FACTOR: f64 = 3e-11;
/// Seconds of a solution per entry of L.
const SOLVE: f64 = 1.5e-9;
/// Seconds per entry of a product of vectors.
const VECTOR: f64 = 2e-10;
