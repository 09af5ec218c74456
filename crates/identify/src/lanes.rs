//! Sums of long slices, by four sums side by side: one addition need not wait for the one before.

const LANES: usize = 4;

/// `Σ a`.
pub(super) fn sum(a: &[f64]) -> f64 {
    let (chunks, rest) = a.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for a in chunks {
        sums.iter_mut().zip(a).for_each(|(sum, a)| *sum += a);
    }
    sums.into_iter().chain(rest.iter().copied()).sum()
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
        }
    }
}
