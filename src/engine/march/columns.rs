//! Instances as rows, buffers as columns: word by word.

use rayon::prelude::*;

/// Rows that a task takes: enough that its own few allocations count for nothing.
const TASK: usize = 256;

/// Words of a cache line.
const LINE: usize = 16;

/// The length of columns for so many rows: an odd number of cache lines, so that the words of a row do not lie where they
/// drive each other out of the cache.
pub(super) fn length(rows: usize) -> usize {
    (rows.div_ceil(LINE) | 1) * LINE
}

/// Writes `rows` rows of words into `columns` of a length, word by word.
pub(super) fn fill<'a, T: Copy + Send + Sync + 'a>(
    columns: &mut [T],
    [length, rows]: [usize; 2],
    row: impl Fn(usize) -> &'a [T] + Sync,
) {
    let words = columns.len() / length;
    let mut tasks: Vec<Vec<&mut [T]>> = (0..rows.div_ceil(TASK)).map(|_| Vec::with_capacity(words)).collect();
    for column in columns.chunks_exact_mut(length) {
        for (task, piece) in tasks.iter_mut().zip(column[..rows].chunks_mut(TASK)) {
            task.push(piece);
        }
    }
    tasks.into_par_iter().enumerate().for_each(|(task, mut columns)| {
        let count = columns.first().map_or(0, |column| column.len());
        for first in (0..count).step_by(LINE) {
            let some = LINE.min(count - first);
            // A line at a time; the last one again for those that there are not.
            let rows: [&[T]; LINE] =
                std::array::from_fn(|index| row(task * TASK + first + index.min(some - 1)));
            for (word, column) in columns.iter_mut().enumerate() {
                let values = rows.map(|row| row[word]);
                column[first..first + some].copy_from_slice(&values[..some]);
            }
        }
    });
}

/// Reads one row of words from columns of a length.
pub(super) fn row<T: Copy>(words: &mut [T], columns: &[T], length: usize, row: usize) {
    let mut at = row;
    for word in words {
        *word = columns[at];
        at += length;
    }
}
