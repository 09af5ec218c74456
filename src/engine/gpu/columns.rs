//! Instances as rows, buffers as columns: word by word.

use rayon::prelude::*;

use crate::engine::gpu::run::ChunkResult;
use crate::engine::kernel::scalar::Real;

/// Rows of words, word by word.
pub(super) fn word_major<'a, T: bytemuck::Pod + Send + Sync>(
    words: usize,
    rows: usize,
    row: impl Fn(usize) -> &'a Vec<T> + Sync,
) -> Vec<T> {
    let mut columns = vec![T::zeroed(); words * rows];
    columns.par_chunks_mut(rows.max(1)).enumerate().for_each(|(word, column)| {
        for (index, value) in column.iter_mut().enumerate() {
            *value = row(index)[word];
        }
    });
    columns
}

/// State and flags, of so many words each, of lane `lane` of `count`.
pub(super) fn lane_words<R: Real>(
    result: &ChunkResult<R>,
    [state, flags]: [usize; 2],
    lane: usize,
    count: usize,
) -> (Vec<R>, Vec<u32>) {
    let of_lane = |word: usize| word * count + lane;
    let state = (0..state).map(|word| result.state[of_lane(word)]).collect();
    let flags = (0..flags).map(|word| result.flags[of_lane(word)]).collect();
    (state, flags)
}
