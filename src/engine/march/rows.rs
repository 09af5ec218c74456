//! What the series of every contact state are made of, written out in WGSL.

use std::fmt::Write;

/// A line of text.
macro_rules! line {
    ($text:ident, $($format:tt)*) => {{
        let _ = writeln!($text, $($format)*);
    }};
}
pub(super) use line;

/// `1/((k + 1)(k + 2))`: from an acceleration to the position.
pub(super) fn twice(k: usize) -> f64 {
    1.0 / ((k + 1) * (k + 2)) as f64
}

/// Products of rows with the coordinates and velocities of degree `k`: a row is four variables `{row}0 {row}2 {row}3 {row}5`.
pub(super) fn row(row: &str, k: usize) -> String {
    format!("{row}0 * x{k} + ({row}2 * w{k} + ({row}3 * u + {row}5 * o))")
}

/// The velocities of degree `k`, in whole steps.
pub(super) fn velocities(text: &mut String, k: usize) {
    line!(text, "    let u = {}.0 * x{}; let o = {}.0 * w{};", k + 1, k + 1, k + 1, k + 1);
}

/// Four words of a form of the state, times the powers of the step.
pub(super) fn scaled(text: &mut String, row: &str, word: &str) {
    for (i, power) in [(0, "square"), (2, "square"), (3, "h"), (5, "h")] {
        line!(text, "  let {row}{i} = input({word} + {i}u, instance) * {power};");
    }
}

/// The rows of slip in either direction, and its constants.
pub(super) fn sliding(text: &mut String) {
    line!(
        text,
        "  let square = h * h; let reciprocal = 1.0 / inertia; let scale = reciprocal * square; let damp = reciprocal * h;"
    );
    scaled(text, "m", "INPUT_W");
    scaled(text, "b", "INPUT_H");
    for (i, power) in [(0, "scale"), (2, "scale"), (3, "damp"), (5, "damp")] {
        line!(
            text,
            "  let a{i} = (q.q * input(INPUT_W + {i}u, instance) - input(INPUT_R + {i}u, instance)) * {power};"
        );
    }
    line!(text, "  let load = input(INPUT_N0, instance);");
    line!(text, "  let push = q.less * load * scale;");
    line!(text, "  let kappa = input(INPUT_KAPPA, instance);");
}

/// The relative velocity of degree `j` is less that of `x2`, but for the belt's: in whole steps.
pub(super) fn slower(j: usize) -> String {
    if j == 1 { "(2.0 * x2 - drive * square)".to_owned() } else { format!("({}.0 * x{})", j + 1, j + 1) }
}
