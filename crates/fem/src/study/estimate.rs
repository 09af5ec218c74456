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
    let (numbering, pencil) = assemble(&study.model)?;
    let ordering = Ordering::best(&pencil.stiffness.pattern, &numbering.places(&study.model.mesh))?;
    let unknowns = pencil.size();
    let entries = ordering.entries();
    let (n, l) = (unknowns as f64, entries as f64);
    let (modes, mus) = (study.document.modes.count as f64, study.mus.len() as f64);
    // Two factors at a time, when the modes are counted; K, M and their pattern; vectors.
    let memory = 16.0 * l + 36.0 * pencil.stiffness.pattern.row.len() as f64 + 8.0 * n * VECTORS * modes;
    let factors = FACTORS + if study.is_pressed() { 1.0 } else { 0.0 };
    let solutions = SOLUTIONS * modes + 2.0 * modes * mus;
    let projected = (VECTORS * modes).min(n).powi(3) * (mus + SOME);
    let seconds = n * factors * MATRICES
        + factors * l * l / n * FACTOR
        + solutions * l * SOLUTION
        + projected * PROJECTED;
    let elements = study.model.mesh.elements().count();
    let nodes = study.model.mesh.nodes.len();
    Ok(Estimate { nodes, elements, unknowns, points: study.model.contact.len(), entries, memory, seconds })
}

/// Vectors of the space for each mode: real modes and corrections at a few coefficients of friction.
const VECTORS: f64 = 14.0;
/// Factorisations: of the stiffness, and of the shift that counts the modes.
const FACTORS: f64 = 2.0;
/// Solutions with the factor for each mode, beside two at each coefficient of friction.
const SOLUTIONS: f64 = 50.0;
/// Projected problems beside those of the sweep.
const SOME: f64 = 25.0;

// Seconds on two cores of 2.9 GHz, from the runs in `docs/fem_paper.md`.

/// Of the matrices, per unknown.
const MATRICES: f64 = 4e-5;
/// Of a factorisation, over L²/n with L entries and n unknowns: the operations are the squares of the lengths of the columns.
const FACTOR: f64 = 2.5e-11;
/// Of a solution, per entry of L.
const SOLUTION: f64 = 5e-10;
/// Of a projected problem, over the cube of its vectors.
const PROJECTED: f64 = 1.2e-8;
