//! Flops of a step, counted on the method in scalars: what one lane cannot do
//! without. Not counted: redone and shortened steps, masked lanes, the look-out for events and their search,
//! transitions, observables, the bound on the truncation, minima, maxima and comparisons.
//!
//! The series of order `n` has `n − 1` degrees `k = 0 … n − 2`. Each takes, with
//! constants of the degree folded (`·` a multiplication or division, `±` an addition or subtraction):
//!
//! | what | contact only, 4 states | in flight too, 6 states |
//! |---|---|---|
//! | `ẋ2`, `ẏ1` (and `ẏ2`) of degree `k`: `(k + 1) x_{k+1}` | 2· | 3· |
//! | `h = k2 (s x + c y − w) + c2 (s ẋ + c ẏ − ẇ)` | 4· 3± | 6· 5± |
//! | `g = k1 (c x − s y) + c1 (c ẋ − s ẏ)` | 4· 1± | 6· 3± |
//! | `R = c g + s h`, `W = c h − s g` | 4· 2± | the same |
//! | `q0 W − R` and `Σ_{j=1..k} q_j N_{k−j}` | (1 + k)· (1 + k)± | the same |
//! | `ẍ2 = force/(1 + κ q0)`, `N = W − κ ẍ2`, `T = R + ẍ2` | 2· 2± | the same |
//! | flight: `ẍ2 = −(M R + κ W)/det`, `ÿ2 = −(κ R + W)/det` | | 5· 2± |
//! | `ÿ1 = h/m1`; coefficients of degree `k + 2` | 3· | 4· |
//! | `v_{k+1}`, `q_{k+1} = slope · v_{k+1}` | 2· | the same |
//!
//! which is `31 + 2k` and `48 + 2k`. Once a step come the static loads (4), the friction coefficient, its
//! difference to that of the equilibrium and the reciprocal inertia (11); once a step position and velocity at
//! its end by Horner's rule, `2n + 2(n − 1)` per coordinate.

/// Flops of a step in contact with the states `x2 y1 ẋ2 ẏ1`, order `n`.
pub(crate) fn contact_only(order: usize) -> f64 {
    series(order, 31) + 2.0 * end(order)
}

/// Flops of a step that could as well be in flight, with all six states.
pub(crate) fn all_modes(order: usize) -> f64 {
    series(order, 48) + 3.0 * end(order)
}

/// The series, with `per_degree` flops aside from the product of friction and normal force.
fn series(order: usize, per_degree: usize) -> f64 {
    const ONCE: usize = 4 + 11;
    let degrees = order - 1;
    // Σ 2k over k = 0 … n − 2.
    let product = degrees * (degrees - 1);
    (degrees * per_degree + product + ONCE) as f64
}

/// Position and velocity of one coordinate at the end of the step.
fn end(order: usize) -> f64 {
    (2 * order + 2 * (order - 1)) as f64
}
