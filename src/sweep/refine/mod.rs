//! The lines of a large map from few of its instances.
//!
//! A coarse part of the grid is computed first. Then only cells whose computed points differ in type, regime or status are
//! divided, again and again, down to the grid itself. Points inside the other cells take the label of the corners.
//!
//! A line that crosses two edges of a cell is followed into it, since the neighbour computes points on their common edge. A
//! region that lies inside one coarse cell is missed: no computed point shows it. A random sample of instances that were not
//! computed says how much of the map that may be, and cells where it finds another label are divided, too.
//!
//! - `planes.rs`: the planes of a grid, and which instance a point is.
//! - `cell.rs`: a cell, its points, its parts.

mod cell;
mod planes;

use rayon::prelude::*;

use crate::sweep::draw::spread;
use crate::sweep::error::{Error, Result};
use crate::sweep::grid::Grid;
use crate::sweep::label::{Label, Tally};
use crate::sweep::run::MOST_IN_MEMORY;
use crate::sweep::spec::refine::Settings;

use cell::Cell;
pub use planes::Planes;

/// A refined map.
#[derive(Clone, Debug)]
pub struct Refined {
    /// The planes of the grid.
    pub planes: Planes,
    /// The label of every instance, computed or taken from the cell around it. No line follows whether an instance is
    /// settled; an instance that was not computed takes that from the cell's nearest corner.
    pub labels: Vec<Label>,
    /// How many were computed.
    pub computed: usize,
    /// How many of these have which label.
    pub tally: Tally,
    /// How many of them were drawn.
    pub sampled: usize,
    /// How many of these had another label than the cell around them.
    pub missed: usize,
}

impl Refined {
    /// The largest share of what was not computed for a line that may have another label, one-sided with 95 %
    /// confidence (Wilson's score); before what the sample found was mended. `None` without a sample.
    #[must_use]
    pub fn missed_at_most(&self) -> Option<f64> {
        /// The one-sided 95 % quantile of the normal distribution.
        const Z: f64 = 1.645;
        let n = self.sampled as f64;
        let share = self.missed as f64 / n;
        let middle = share + Z * Z / (2.0 * n);
        let half = Z * (share * (1.0 - share) / n + Z * Z / (4.0 * n * n)).sqrt();
        (self.sampled > 0).then(|| ((middle + half) / (1.0 + Z * Z / n)).min(1.0))
    }
}

/// Computes some instances: gives their labels in the same order, or why there are none.
pub type Compute<'a, E> = dyn FnMut(&[usize]) -> std::result::Result<Vec<Label>, E> + 'a;

/// The planes of a grid that can be refined.
///
/// # Errors
/// When it has no plane of two numeric axes, or too many instances.
pub fn planes_of(grid: &Grid) -> Result<Planes> {
    let instances = grid.len();
    if instances > MOST_IN_MEMORY {
        return Err(Error::TooManyToRefine { instances, limit: MOST_IN_MEMORY });
    }
    Planes::new(grid).ok_or(Error::NothingToRefine)
}

/// Refines the map of a grid.
///
/// # Errors
/// Those of [`planes_of`] and of `compute`.
pub fn refine<E: From<Error>>(
    grid: &Grid,
    settings: Settings,
    compute: &mut Compute<'_, E>,
) -> std::result::Result<Refined, E> {
    let planes = planes_of(grid)?;
    let instances = grid.len();
    let mut map = Known { labels: vec![Label::NOT_COMPUTED; instances], tally: Tally::default() };
    let mut cells: Vec<Cell> =
        (0..planes.count()).flat_map(|plane| Cell::coarse(&planes, plane, settings.coarse)).collect();
    map.compute(corners(&planes, &cells), compute)?;
    divide(&planes, &mut cells, &mut map, compute)?;

    let rest: Vec<usize> = (0..instances).filter(|index| !map.is_known(*index)).collect();
    let drawn: Vec<usize> = spread(settings.seed, settings.sample, rest.len(), 0..rest.len())
        .into_iter()
        .map(|at| rest[at])
        .collect();
    drop(rest);
    let guessed = filled(&planes, &cells, &map);
    map.compute(drawn.clone(), compute)?;
    let missed = drawn.iter().filter(|at| guessed[**at].class() != map.labels[**at].class()).count();
    drop(guessed);
    divide(&planes, &mut cells, &mut map, compute)?;
    let labels = filled(&planes, &cells, &map);
    let tally = map.tally;
    Ok(Refined { planes, labels, computed: tally.total(), tally, sampled: drawn.len(), missed })
}

/// Labels of computed instances.
struct Known {
    /// One label for every instance; [`Label::NOT_COMPUTED`] for those that were not computed.
    labels: Vec<Label>,
    /// The labels of computed instances, counted.
    tally: Tally,
}

impl Known {
    fn is_known(&self, index: usize) -> bool {
        self.labels[index] != Label::NOT_COMPUTED
    }

    /// Computes those of some instances that are not known.
    fn compute<E>(
        &mut self,
        mut wanted: Vec<usize>,
        compute: &mut Compute<'_, E>,
    ) -> std::result::Result<(), E> {
        wanted.retain(|index| !self.is_known(*index));
        wanted.par_sort_unstable();
        wanted.dedup();
        if wanted.is_empty() {
            return Ok(());
        }
        let labels = compute(&wanted)?;
        for (index, label) in wanted.iter().zip(labels) {
            self.tally.add_label(label);
            self.labels[*index] = label;
        }
        Ok(())
    }
}

fn corners(planes: &Planes, cells: &[Cell]) -> Vec<usize> {
    cells.iter().flat_map(|cell| cell.corners().map(|point| planes.instance(point))).collect()
}

/// Divides cells with different labels until none is left that can be.
fn divide<E>(
    planes: &Planes,
    cells: &mut Vec<Cell>,
    map: &mut Known,
    compute: &mut Compute<'_, E>,
) -> std::result::Result<(), E> {
    loop {
        let mixed: Vec<bool> =
            cells.par_iter().map(|cell| cell.can_be_divided() && is_mixed(planes, cell, map)).collect();
        if !mixed.contains(&true) {
            return Ok(());
        }
        let mut parts = Vec::new();
        let mut at = 0;
        cells.retain(|cell| {
            let divided = mixed[at];
            at += 1;
            if divided {
                parts.extend(cell.parts());
            }
            !divided
        });
        map.compute(corners(planes, &parts), compute)?;
        cells.append(&mut parts);
    }
}

/// Whether the computed points of a cell, those on its edges included, have different labels.
fn is_mixed(planes: &Planes, cell: &Cell, map: &Known) -> bool {
    let first = map.labels[planes.instance(cell.corners()[0])].class();
    cell.points().any(|point| {
        let label = map.labels[planes.instance(point)];
        label != Label::NOT_COMPUTED && label.class() != first
    })
}

/// The labels of all instances.
fn filled(planes: &Planes, cells: &[Cell], map: &Known) -> Vec<Label> {
    let mut labels = map.labels.clone();
    for cell in cells {
        for point in cell.points() {
            let label = &mut labels[planes.instance(point)];
            if *label == Label::NOT_COMPUTED {
                *label = map.labels[planes.instance(cell.nearest_corner(point))];
            }
        }
    }
    labels
}
