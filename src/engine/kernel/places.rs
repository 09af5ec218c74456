//! Where the words of instances stand in a buffer of a kernel.
//!
//! Those of [`TOGETHER`] instances lie together, word by word. A warp reads neighbours then, how far it is from word to word is
//! known when a kernel is compiled, and the host finds all words of an instance close by.

use rayon::prelude::*;

/// Instances whose words lie together.
pub const TOGETHER: usize = 32;

/// Such groups of instances that a task takes at least.
const TASK: usize = 8;

/// How many instances a buffer has room for that holds so many.
#[must_use]
pub const fn room(count: usize) -> usize {
    count.next_multiple_of(TOGETHER)
}

/// The place of the word `word` of `words` of an instance.
#[must_use]
pub const fn place([word, words]: [usize; 2], instance: usize) -> usize {
    (instance / TOGETHER * words + word) * TOGETHER + instance % TOGETHER
}

/// Writes the words of `count` instances into a buffer that has room for them, each a row; what there is room for beyond the
/// last is the last.
pub fn fill<'a, T: Copy + Send + Sync + 'a>(
    buffer: &mut [T],
    words: usize,
    count: usize,
    row: impl Fn(usize) -> &'a [T] + Sync,
) {
    let group = |(number, group): (usize, &mut [T])| {
        let rows: [&[T]; TOGETHER] = std::array::from_fn(|k| row((number * TOGETHER + k).min(count - 1)));
        for (word, line) in group.chunks_exact_mut(TOGETHER).enumerate() {
            for (place, row) in line.iter_mut().zip(&rows) {
                *place = row[word];
            }
        }
    };
    if words > 0 {
        buffer.par_chunks_mut(words * TOGETHER).with_min_len(TASK).enumerate().for_each(group);
    }
}

/// A buffer of the words of so many instances, each a row.
pub fn filled<'a, T: bytemuck::Pod + Send + Sync>(
    words: usize,
    count: usize,
    row: impl Fn(usize) -> &'a [T] + Sync,
) -> Vec<T> {
    let mut buffer = vec![T::zeroed(); words * room(count)];
    fill(&mut buffer, words, count, row);
    buffer
}

/// Reads the `words` words of instances that lie together, the group of this number in a buffer, into rows. Line by line: a row
/// at a time would fetch all of them from afar for every row.
pub fn read<T: Copy>(rows: &mut [&mut [T]], buffer: &[T], words: usize, group: usize) {
    let of_group = &buffer[place([0, words], group * TOGETHER)..][..words * TOGETHER];
    for (word, line) in of_group.chunks_exact(TOGETHER).enumerate() {
        for (row, value) in rows.iter_mut().zip(line) {
            row[word] = *value;
        }
    }
}

/// The words of one instance.
pub fn row<T: Copy>(buffer: &[T], words: usize, instance: usize) -> impl Iterator<Item = T> {
    (0..words).map(move |word| buffer[place([word, words], instance)])
}
