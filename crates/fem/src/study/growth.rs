//! What counts as growth.

use faer::c64;

/// Whether a mode counts as growing. What rounding leaves of an undamped mode is some 1e-8 of its frequency where two are near each other. In a study in which
/// something damps modes that nothing damps are near nothing: they have rounding alone.
#[must_use]
pub fn grows(lambda: c64, damped: bool) -> bool {
    const COUPLED: f64 = 1e-6;
    const ALONE: f64 = 1e-11;
    lambda.re > if damped { ALONE } else { COUPLED } * lambda.norm()
}
