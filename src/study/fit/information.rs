//! What a number of values is worth.
//!
//! With `n` points, residuals `r`, `σ² = Σ r²/n`, and `k` values, the variance among them,
//!
//! ```text
//! AICc = n ln σ² + 2k + 2k (k + 1)/(n − k − 1)        BIC = n ln σ² + k ln n
//! ```

/// No friction coefficient is known better than this: exact points do not make a law better that rounding favours.
const KNOWN: f64 = 1e-9;

/// `AICc` and `BIC` of so many values, beside the variance, that leave this sum of `squares` of so many `points`.
pub(super) fn information(points: usize, values: usize, squares: f64) -> Option<[f64; 2]> {
    let (n, k) = (points as f64, (values + 1) as f64);
    let free = n - k - 1.0;
    let fits = n * (squares / n).max(KNOWN * KNOWN).ln();
    (free > 0.0).then(|| [fits + 2.0 * k + 2.0 * k * (k + 1.0) / free, fits + k * n.ln()])
}
