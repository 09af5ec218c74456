//! The series of slip on a law that is no straight line, written out in WGSL.
//!
//! Each degree of friction is a sum of all before it: `l0 …` is the series that the recurrence of a law carries along, `c0 …`
//! that of the relative velocity as the recurrence takes it, `q1 …` that of `q = σ μ`. What the two forms have of their own is
//! chosen by the constant `LAW`.

use crate::engine::lanes::words::{DOUBLINGS, DOWN, EXP_DEGREE, FARTHEST, POWER};
use crate::engine::march::rows::{line, row, sliding, slower, twice, velocities};
use std::fmt::Write;

pub(super) fn text(text: &mut String, order: usize) {
    exponential(text);
    line!(text, "fn expand_curved(h: real, q: Friction, inertia: real, sigma: real, relative: real) {{");
    sliding(text);
    line!(text, "  let exponential = LAW == LAW_EXPONENTIAL; let per_step = -1.0 / h;");
    line!(text, "  let bend = -(piece.rate * sigma);");
    line!(text, "  let pole = 1.0 / select(1.0 + piece.rate * sigma * relative, 1.0, exponential);");
    line!(text, "  let l0 = q.law;");
    for k in 1..=order - 2 {
        line!(text, "  var l{k}: real; var c{k}: real; var q{k}: real;");
    }
    for k in 0..=order - 2 {
        line!(text, "  {{");
        velocities(text, k);
        let push = if k == 0 { " + push" } else { "" };
        line!(text, "    var a = {}{push};", row("a", k));
        if k > 0 {
            line!(text, "    a = reciprocal * ({}) + a;", products("q", "n", k));
        }
        let press = if k == 0 { " + load * square" } else { "" };
        line!(text, "    n{k} = {}{press} - kappa * a;", row("m", k));
        line!(text, "    x{} = a * {:?}; w{} = ({}) * {:?};", k + 2, twice(k), k + 2, row("b", k), twice(k));
        let next = k + 1;
        if next <= order - 2 {
            line!(
                text,
                "    c{next} = {} * per_step * select(real(1.0), real({next}.0), exponential);",
                slower(next)
            );
            let sum = products("c", "l", next);
            line!(text, "    l{next} = bend * ({sum}) * select(pole, {:?}, exponential);", 1.0 / next as f64);
            line!(text, "    q{next} = select(l{next}, sigma * l{next}, exponential);");
        }
        line!(text, "  }}");
    }
    line!(text, "  second = {};", slower(1));
    line!(text, "  n{} = 0.0; n{order} = 0.0;", order - 1);
    line!(text, "}}");
}

/// `Σ left_j right_(k − j)` over `j` from 1 to `k`.
fn products(left: &str, right: &str, k: usize) -> String {
    let first = format!("{left}{k} * {right}0");
    (1..k).rev().fold(first, |sum, j| format!("{left}{j} * {right}{} + ({sum})", k - j))
}

/// `exp(x) − 1` and `exp(x)` for `x` in [−80, 80], each to its own last digits: a series for `|x| ≤ 1/2`, doubled by
/// `(1 + e)² − 1 = e (2 + e)`; far down the second is a power of `exp(x/16)`, on the way to the first, and 0 beyond.
fn exponential(text: &mut String) {
    line!(text, "fn exponential(x: real) -> Exponential {{");
    line!(
        text,
        "  let bounded = min(max(x, real(-{FARTHEST:?})), real({FARTHEST:?})); let large = abs(bounded) > 0.5;"
    );
    line!(text, "  let y = bounded * select(real(1.0), real({:?}), large);", 0.5_f64.powi(DOUBLINGS));
    line!(text, "  var sum = real(1.0);");
    for k in (2..=EXP_DEGREE).rev() {
        line!(text, "  sum = y * {:?} * sum + 1.0;", 1.0 / f64::from(k));
    }
    line!(text, "  var e = y * sum; var power = real(0.0);");
    line!(text, "  if large {{");
    for doubling in 0..DOUBLINGS {
        if doubling == DOUBLINGS - POWER {
            line!(text, "    power = 1.0 + e;");
        }
        line!(text, "    e = e * (e + 2.0);");
    }
    for _ in 0..POWER {
        line!(text, "    power = power * power;");
    }
    line!(text, "  }}");
    line!(text, "  let down = select(power, 0.0, x < -{FARTHEST:?});");
    line!(text, "  return Exponential(e, select(1.0 + e, down, x < {DOWN:?}));");
    line!(text, "}}");
}
