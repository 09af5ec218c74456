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

/// Writes the words of `count` instances into a buffer that has room for them, each a row that `row` writes; what there is room for
/// beyond the last is the last.
pub fn fill<T: bytemuck::Pod + Send + Sync>(
    buffer: &mut [T],
    words: usize,
    count: usize,
    row: impl Fn(usize, &mut [T]) + Sync,
) {
    let blank = || vec![T::zeroed(); words * TOGETHER];
    let group = |rows: &mut Vec<T>, (number, group): (usize, &mut [T])| {
        for (place, words) in rows.chunks_exact_mut(words).enumerate() {
            row((number * TOGETHER + place).min(count - 1), words);
        }
        for (word, line) in group.chunks_exact_mut(TOGETHER).enumerate() {
            for (place, row) in line.iter_mut().zip(rows.chunks_exact(words)) {
                *place = row[word];
            }
        }
    };
    if words > 0 {
        let groups = buffer.par_chunks_mut(words * TOGETHER).with_min_len(TASK);
        groups.enumerate().for_each_init(blank, group);
    }
}

/// A buffer of the words of so many instances, each a row.
pub fn filled<'a, T: bytemuck::Pod + Send + Sync>(
    words: usize,
    count: usize,
    row: impl Fn(usize) -> &'a [T] + Sync,
) -> Vec<T> {
    let mut buffer = vec![T::zeroed(); words * room(count)];
    fill(&mut buffer, words, count, |instance, words| words.copy_from_slice(row(instance)));
    buffer
}

/// The words of one instance, where they stand.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a, T> {
    words: &'a [T],
    /// How far it is from word to word.
    apart: usize,
}

impl<'a, T: Copy> Column<'a, T> {
    /// Those of a row.
    #[must_use]
    pub const fn of_row(words: &'a [T]) -> Column<'a, T> {
        Column { words, apart: 1 }
    }

    /// The `words` words of an instance in a buffer.
    #[must_use]
    pub fn of_buffer(buffer: &'a [T], words: usize, instance: usize) -> Column<'a, T> {
        let [first, end] = [[0, words], [words, words]].map(|word| place(word, instance));
        Column { words: &buffer[first..end + 1 - TOGETHER], apart: TOGETHER }
    }

    /// A word.
    #[must_use]
    pub fn at(&self, word: usize) -> T {
        self.words[word * self.apart]
    }

    /// Those from a word on.
    #[must_use]
    pub fn from(&self, word: usize) -> Column<'a, T> {
        Column { words: &self.words[word * self.apart..], ..*self }
    }

    /// All, one after the other.
    pub fn iter(&self) -> impl Iterator<Item = T> + use<'a, T> {
        self.words.iter().step_by(self.apart).copied()
    }
}
