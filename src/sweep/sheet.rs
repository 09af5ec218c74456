//! A sheet: everything that an export says about a sweep besides its records.

use crate::engine::computation::Computation;
use crate::sweep::grid::Grid;
use crate::sweep::map::Map;
use crate::sweep::spec::{Analysis, Spec};

/// A sweep as its exports see it.
#[derive(Clone, Copy, Debug)]
pub struct Sheet<'a> {
    /// Title of figures and manifest; may be empty.
    pub title: &'a str,
    /// What was computed.
    pub analysis: Analysis,
    /// The instances.
    pub grid: &'a Grid,
    /// Where and how the eigenvalue analysis was computed, when asked for.
    pub linear: Option<&'a Computation>,
    /// Where and how the response was computed, when asked for.
    pub response: Option<&'a Computation>,
}

impl<'a> Sheet<'a> {
    /// The sheet of a sweep with its computations, see [`crate::sweep::solver::Solver::computations`].
    #[must_use]
    pub fn new(spec: &'a Spec, [linear, response]: [Option<&'a Computation>; 2]) -> Sheet<'a> {
        Sheet { title: &spec.title, analysis: spec.analysis, grid: &spec.grid, linear, response }
    }
}

impl<'a> From<&'a Map> for Sheet<'a> {
    fn from(map: &'a Map) -> Sheet<'a> {
        let made = &map.provenance;
        Sheet::new(&map.spec, [made.linear.as_ref(), made.response.as_ref()])
    }
}
