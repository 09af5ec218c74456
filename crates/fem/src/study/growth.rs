//! What counts as growth.

use faer::c64;

/// Whether a mode counts as growing. What rounding leaves of an undamped mode is some 1e-8 of its frequency.
#[must_use]
pub fn grows(lambda: c64, damped: bool) -> bool {
    const ROUNDING: f64 = 1e-6;
    if damped { lambda.re > 0.0 } else { lambda.re > ROUNDING * lambda.norm() }
}
