//! Sparse matrices: symmetric ones that share a pattern, and the few rows of a contact.

use std::sync::Arc;

use rayon::prelude::*;

/// Where a symmetric matrix has entries, both triangles, column by column.
#[derive(Debug, Clone, PartialEq)]
pub struct Pattern {
    /// First entry of each column, and the number of all.
    pub start: Vec<usize>,
    /// Rows of the entries, rising in each column.
    pub row: Vec<usize>,
}

impl Pattern {
    /// The pattern that groups of unknowns make, each coupled to all of its group.
    #[must_use]
    pub fn of(size: usize, groups: &[Vec<usize>]) -> Self {
        let mut touching: Vec<Vec<usize>> = vec![Vec::new(); size];
        for (i, group) in groups.iter().enumerate() {
            for unknown in group {
                touching[*unknown].push(i);
            }
        }
        let (mut start, mut row) = (vec![0], Vec::new());
        let mut column = Vec::new();
        for touching in &touching {
            column.clear();
            for i in touching {
                column.extend_from_slice(&groups[*i]);
            }
            column.sort_unstable();
            column.dedup();
            row.extend_from_slice(&column);
            start.push(row.len());
        }
        Self { start, row }
    }

    /// Number of rows.
    #[must_use]
    pub fn size(&self) -> usize {
        self.start.len() - 1
    }

    /// Index of an entry, `None` where the pattern has none.
    #[must_use]
    pub fn find(&self, row: usize, column: usize) -> Option<usize> {
        let from = self.start[column];
        self.row[from..self.start[column + 1]].binary_search(&row).ok().map(|i| from + i)
    }
}

/// A symmetric matrix; several share a pattern.
#[derive(Debug, Clone)]
pub struct Symmetric {
    /// Where its entries are.
    pub pattern: Arc<Pattern>,
    /// Their values.
    pub values: Vec<f64>,
}

impl Symmetric {
    /// All entries zero.
    #[must_use]
    pub fn zero(pattern: Arc<Pattern>) -> Self {
        let values = vec![0.0; pattern.row.len()];
        Self { pattern, values }
    }

    /// A x.
    #[must_use]
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        let one: Vec<[f64; 1]> = x.iter().map(|x| [*x]).collect();
        self.times_rows(&one).into_iter().map(|[y]| y).collect()
    }

    /// A X for a few columns, each row of X together.
    #[must_use]
    pub fn times_rows<const N: usize>(&self, x: &[[f64; N]]) -> Vec<[f64; N]> {
        /// Rows that are worth another thread.
        const SHARE: usize = 1000;
        let Pattern { start, row } = &*self.pattern;
        // Symmetric: the entries of column i are those of row i.
        let line = |i: usize| {
            let mut sum = [0.0; N];
            for k in start[i]..start[i + 1] {
                let (value, x) = (self.values[k], &x[row[k]]);
                (0..N).for_each(|j| sum[j] += value * x[j]);
            }
            sum
        };
        (0..x.len()).into_par_iter().with_min_len(SHARE).map(line).collect()
    }

    /// A + scale · B, of one pattern.
    #[must_use]
    pub fn plus(&self, scale: f64, other: &Self) -> Self {
        let values = self.values.iter().zip(&other.values).map(|(a, b)| a + scale * b).collect();
        Self { pattern: self.pattern.clone(), values }
    }
}

/// A matrix of few rows, row by row.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rows {
    /// Entries (column, value) of each row, columns rising.
    pub rows: Vec<Vec<(usize, f64)>>,
}

impl Rows {
    /// A x.
    #[must_use]
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        self.rows.iter().map(|row| row.iter().map(|(i, a)| a * x[*i]).sum()).collect()
    }

    /// The matrix times a number.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.rows.iter_mut().flatten().for_each(|(_, value)| *value *= factor);
        self
    }

    /// y + Aᵀ x.
    pub fn add_transposed(&self, x: &[f64], y: &mut [f64]) {
        for (row, x) in self.rows.iter().zip(x) {
            for (i, a) in row {
                y[*i] += a * x;
            }
        }
    }
}
