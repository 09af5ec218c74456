//! Sums and extremes of long slices, by four side by side: one operation need not wait for the one before.

const LANES: usize = 4;

/// `Σ of(a)`.
fn total(a: &[f64], of: impl Fn(f64) -> f64) -> f64 {
    let (chunks, rest) = a.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for a in chunks {
        sums.iter_mut().zip(a).for_each(|(sum, a)| *sum += of(*a));
    }
    sums.into_iter().chain(rest.iter().map(|a| of(*a))).sum()
}

/// `Σ a`.
pub(super) fn sum(a: &[f64]) -> f64 {
    total(a, |a| a)
}

/// `Σ |a|`.
pub(super) fn sizes(a: &[f64]) -> f64 {
    total(a, f64::abs)
}

/// `Σ (a − from)²`.
pub(super) fn squares(a: &[f64], from: f64) -> f64 {
    total(a, |a| (a - from) * (a - from))
}

/// `Σ a b` of slices of one length.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    let mut sums = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        sums.iter_mut().zip(a.iter().zip(b)).for_each(|(sum, (a, b))| *sum += a * b);
    }
    sums.into_iter().chain(a_rest.iter().zip(b_rest).map(|(a, b)| a * b)).sum()
}

/// `Σ k a_k`.
pub(super) fn moment(a: &[f64]) -> f64 {
    let (chunks, rest) = a.as_chunks::<LANES>();
    let (mut sums, mut at) = ([0.0; LANES], [0.0, 1.0, 2.0, 3.0]);
    for a in chunks {
        for ((sum, at), a) in sums.iter_mut().zip(&mut at).zip(a) {
            *sum += *at * a;
            *at += LANES as f64;
        }
    }
    sums.into_iter().chain(rest.iter().zip(at).map(|(a, at)| a * at)).sum()
}

/// Adds `start + k slope` to `a_k`.
pub(super) fn add_line(a: &mut [f64], [start, slope]: [f64; 2]) {
    let (chunks, rest) = a.as_chunks_mut::<LANES>();
    let mut at = [0.0, 1.0, 2.0, 3.0];
    for a in chunks {
        for (at, a) in at.iter_mut().zip(a) {
            *a += start + *at * slope;
            *at += LANES as f64;
        }
    }
    rest.iter_mut().zip(at).for_each(|(a, at)| *a += start + at * slope);
}

/// The larger one of two numbers; neither is NaN, for which `f64::max` would look.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller one likewise.
pub(super) fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// What is left of `start` and all of `a` when each pair leaves one.
fn chosen(a: &[f64], start: f64, one: impl Fn(f64, f64) -> f64) -> f64 {
    let (chunks, rest) = a.as_chunks::<LANES>();
    let mut best = [start; LANES];
    for a in chunks {
        best.iter_mut().zip(a).for_each(|(best, a)| *best = one(*best, *a));
    }
    best.into_iter().chain(rest.iter().copied()).fold(start, one)
}

/// The highest of `a`; −∞ of none.
pub(super) fn highest(a: &[f64]) -> f64 {
    chosen(a, f64::NEG_INFINITY, larger)
}

/// The lowest of `a`; ∞ of none.
pub(super) fn lowest(a: &[f64]) -> f64 {
    chosen(a, f64::INFINITY, smaller)
}

/// `Σ |a_{k+1} − a_k|`, and the least of them; 0 and ∞ of fewer than two.
pub(super) fn steps(a: &[f64]) -> [f64; 2] {
    let next = a.get(1..).unwrap_or_default();
    let ((a, a_rest), (next, next_rest)) = (a[..next.len()].as_chunks::<LANES>(), next.as_chunks::<LANES>());
    let (mut sums, mut least) = ([0.0; LANES], [f64::INFINITY; LANES]);
    for (a, next) in a.iter().zip(next) {
        for k in 0..LANES {
            let step = (next[k] - a[k]).abs();
            sums[k] += step;
            least[k] = smaller(least[k], step);
        }
    }
    let rest = a_rest.iter().zip(next_rest).map(|(a, next)| (next - a).abs());
    [sums.into_iter().chain(rest.clone()).sum(), least.into_iter().chain(rest).fold(f64::INFINITY, f64::min)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_every_length() {
        for length in 1..23_u32 {
            let a: Vec<f64> = (0..length).map(|k| f64::from(k * k) - 7.0).collect();
            let b: Vec<f64> = (0..length).map(|k| 3.0 - f64::from(k)).collect();
            let found = [sum(&a), dot(&a, &b), moment(&a)];
            let products = a.iter().zip(&b).map(|(a, b)| a * b).sum();
            let moments = a.iter().enumerate().map(|(k, a)| k as f64 * a).sum();
            // Whole numbers: exact in every order. No zero has a sign.
            let bits = |sum: f64| (sum + 0.0).to_bits();
            assert_eq!(found.map(bits), [a.iter().sum(), products, moments].map(bits));
            let (found, off) = (squares(&a, 2.0), a.iter().map(|a| (a - 2.0).powi(2)).sum());
            assert_eq!(bits(found), bits(off));
            let mut line = a.clone();
            add_line(&mut line, [7.0, -2.0]);
            for (k, found) in (0..length).zip(line) {
                assert_eq!(bits(found), bits(f64::from(k * k) - 2.0 * f64::from(k)));
            }
            assert_eq!(bits(steps(&b)[1]), bits(if length > 1 { 1.0 } else { f64::INFINITY }));
            let found = [sizes(&b), steps(&b)[0], highest(&b), lowest(&b)];
            let sizes = b.iter().map(|b| b.abs()).sum();
            let last = 4.0 - f64::from(length);
            assert_eq!(found.map(bits), [sizes, f64::from(length - 1), 3.0, last].map(bits));
        }
    }
}
