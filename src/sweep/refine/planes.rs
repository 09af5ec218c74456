//! The planes of a grid: its two longest numeric axes, once for every value of the others.

use crate::sweep::grid::{Axis, AxisKey, Grid};

/// A grid point of a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Point {
    pub(super) plane: u32,
    pub(super) column: u32,
    pub(super) row: u32,
}

/// The planes of a grid. Neighbours are neighbours by value, in whatever order a sweep file lists the values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Planes {
    /// The positions of the axes of columns and rows among the axes of the grid.
    pub axes: [usize; 2],
    sides: [usize; 2],
    strides: [usize; 2],
    /// The positions of the values of both axes, rising.
    orders: [Vec<usize>; 2],
    /// The instance of the first point of every plane.
    first: Vec<usize>,
}

impl Planes {
    /// The planes of a grid; `None` when it has no two numeric axes of at least three values.
    #[must_use]
    pub fn new(grid: &Grid) -> Option<Planes> {
        let Grid::Axes(all) = grid else { return None };
        let numeric = |axis: &Axis| matches!(axis.key, AxisKey::Param(_)) && axis.values.len() > 2;
        let mut longest: Vec<usize> = (0..all.len()).filter(|i| numeric(&all[*i])).collect();
        longest.sort_by_key(|i| std::cmp::Reverse(all[*i].values.len()));
        let mut axes = [*longest.first()?, *longest.get(1)?];
        axes.sort_unstable();
        let length = |i: usize| all[i].values.len();
        let stride = |i: usize| all[i + 1..].iter().map(|axis| axis.values.len()).product::<usize>();
        let mut first = vec![0];
        for i in (0..all.len()).filter(|i| !axes.contains(i)) {
            first = first
                .into_iter()
                .flat_map(|at| (0..length(i)).map(move |k| (at, k)))
                .map(|(at, k)| at + k * stride(i))
                .collect();
        }
        let orders = axes.map(|i| all[i].rising());
        Some(Planes { axes, sides: axes.map(length), strides: axes.map(stride), orders, first })
    }

    /// How many planes.
    #[must_use]
    pub fn count(&self) -> usize {
        self.first.len()
    }

    /// Points along columns and rows of a plane.
    #[must_use]
    pub fn sides(&self) -> [usize; 2] {
        self.sides
    }

    /// The instance in a column and row of a plane, by the rank of its values.
    #[must_use]
    pub fn at(&self, plane: usize, column: usize, row: usize) -> usize {
        let [columns, rows] = &self.orders;
        self.first[plane] + columns[column] * self.strides[0] + rows[row] * self.strides[1]
    }

    /// The instance in a column and row as the sweep file lists their values.
    #[must_use]
    pub fn listed(&self, plane: usize, [column, row]: [usize; 2]) -> usize {
        self.first[plane] + column * self.strides[0] + row * self.strides[1]
    }

    pub(super) fn instance(&self, point: Point) -> usize {
        self.at(point.plane as usize, point.column as usize, point.row as usize)
    }
}
