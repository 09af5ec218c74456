//! A rectangle of grid points of one plane.

use crate::sweep::refine::planes::{Planes, Point};

/// A cell: its corners are grid points, and its edges belong to it and to its neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cell {
    plane: u32,
    columns: [u32; 2],
    rows: [u32; 2],
}

impl Cell {
    /// The cells to begin with, at most `count` along each side.
    #[expect(clippy::cast_possible_truncation, reason = "sides are far below 2^32")]
    pub(super) fn coarse(planes: &Planes, plane: usize, count: usize) -> Vec<Cell> {
        let bounds = |points: usize| -> Vec<[u32; 2]> {
            let steps = points - 1;
            let count = count.clamp(1, steps);
            // Powers of two, so that halves of halves meet the grid.
            let step = steps.div_ceil(count).next_power_of_two();
            (0..steps).step_by(step).map(|low| [low as u32, (low + step).min(steps) as u32]).collect()
        };
        let [columns, rows] = planes.sides().map(bounds);
        let cell = |rows: [u32; 2]| {
            let along =
                columns.iter().map(move |columns| Cell { plane: plane as u32, columns: *columns, rows });
            along.collect::<Vec<_>>()
        };
        rows.into_iter().flat_map(cell).collect()
    }

    /// The corners.
    pub(super) fn corners(&self) -> [Point; 4] {
        let [[left, right], [low, high]] = [self.columns, self.rows];
        [(left, low), (right, low), (left, high), (right, high)].map(|(column, row)| Point {
            plane: self.plane,
            column,
            row,
        })
    }

    /// The corner next to a point of the cell; the lower or left one of two as near.
    pub(super) fn nearest_corner(&self, point: Point) -> Point {
        let nearest = |[low, high]: [u32; 2], at: u32| if at - low <= high - at { low } else { high };
        Point {
            plane: self.plane,
            column: nearest(self.columns, point.column),
            row: nearest(self.rows, point.row),
        }
    }

    /// All points, edges included.
    pub(super) fn points(&self) -> impl Iterator<Item = Point> {
        let Cell { plane, columns, rows } = *self;
        (rows[0]..=rows[1])
            .flat_map(move |row| (columns[0]..=columns[1]).map(move |column| Point { plane, column, row }))
    }

    /// Whether it has points beside its corners.
    pub(super) fn can_be_divided(&self) -> bool {
        [self.columns, self.rows].iter().any(|[low, high]| high - low > 1)
    }

    /// Its halves or quarters.
    pub(super) fn parts(&self) -> Vec<Cell> {
        let halves = |[low, high]: [u32; 2]| {
            if high - low > 1 {
                let middle = low + (high - low).next_power_of_two() / 2;
                vec![[low, middle], [middle, high]]
            } else {
                vec![[low, high]]
            }
        };
        let columns = halves(self.columns);
        let parts =
            |rows: [u32; 2]| columns.iter().map(move |columns| Cell { columns: *columns, rows, ..*self });
        halves(self.rows).into_iter().flat_map(parts).collect()
    }
}
