//! Numbers that look random but depend on a seed and an index alone. So a draw gives the same on every machine, and for any
//! number of threads, tiles and shards.

use std::ops::Range;

/// A number that looks random (the output function of `SplitMix64`).
#[must_use]
pub fn mixed(seed: u64, index: u64) -> u64 {
    let mut z = seed ^ index.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Draws one instance from each of `count` equal parts of `total`, and gives those inside `range` in rising order. Every
/// instance has the same chance, and no part is missed. However the whole is cut into ranges, together they draw the same
/// instances.
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "counts and offsets below the total")]
pub fn spread(seed: u64, count: usize, total: usize, range: Range<usize>) -> Vec<usize> {
    let count = count.min(total);
    if count == 0 || range.is_empty() {
        return Vec::new();
    }
    // Products of three counts need 128 bits; the quotients are counts again.
    let quotient = |a: usize, b: usize, c: usize| (a as u128 * b as u128 / c as u128) as usize;
    let bound = |part: usize| quotient(part, total, count);
    let part_of = |index: usize| quotient(index, count, total);
    let first = part_of(range.start).saturating_sub(1);
    let last = (part_of(range.end - 1) + 2).min(count);
    (first..last)
        .map(|part| {
            let (low, high) = (bound(part), bound(part + 1));
            let within = mixed(seed, part as u64) % (high - low) as u64;
            low + within as usize
        })
        .filter(|index| range.contains(index))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn the_cut_into_ranges_does_not_matter() {
        for (count, total) in [(0, 10), (1, 1), (7, 7), (9, 7), (13, 1000), (100, 12_345)] {
            let whole = spread(5, count, total, 0..total);
            assert_eq!(whole.len(), count.min(total));
            for size in [1, 3, 64, 1000] {
                let parts: Vec<usize> = (0..total.div_ceil(size))
                    .flat_map(|part| spread(5, count, total, part * size..((part + 1) * size).min(total)))
                    .collect();
                assert_eq!(parts, whole, "{count} of {total} in ranges of {size}");
            }
        }
        assert_ne!(spread(5, 13, 1000, 0..1000), spread(6, 13, 1000, 0..1000));
    }

    #[test]
    fn every_instance_has_its_chance() {
        // 40 of 400 by 2000 seeds: each is drawn 200 times in the mean, with a deviation of 13.4.
        let mut counts = [0_u32; 400];
        for seed in 0..2000 {
            for index in spread(seed, 40, 400, 0..400) {
                counts[index] += 1;
            }
        }
        assert!(counts.iter().all(|count| (130..270).contains(count)), "{counts:?}");
    }
}
