//! The series of a step written out in WGSL: every coefficient is a variable of its own, so that it can stay in a register.
//!
//! Time runs from 0 to 1 over a step, as in the engine of the CPU: coefficients carry the powers of the step, forces are
//! times its square. Variables are `x0 …` and `w0 …` (the series of `x2` and `y1`), `n0 …` (the normal force; in flight the
//! gap) and `d0 …` (the event function that is searched). While it sticks, `x2` is a parabola: `x3 …` then hold the series of
//! the tangential force, as if it were a velocity.

use std::fmt::Write;

use crate::engine::march::curved;
use crate::engine::march::rows::{line, row, scaled, sliding, slower, twice, velocities};

/// The series of a step of some order and all that is done with them.
#[must_use]
pub fn text(order: usize) -> String {
    let mut text = String::new();
    line!(text, "// The second series of the event functions at degree 1; above it is that of the velocity.");
    line!(text, "var<private> second: real;");
    for (name, terms) in [("x", order + 1), ("w", order + 1), ("n", order + 1), ("d", order + 1)] {
        for k in 0..terms {
            line!(text, "var<private> {name}{k}: real;");
        }
    }
    slip(&mut text, order);
    curved::text(&mut text, order);
    stick(&mut text, order);
    flight(&mut text, order);
    reach(&mut text, order);
    function(&mut text, order);
    shift(&mut text, order);
    search(&mut text, order);
    advance(&mut text, order);
    motion(&mut text, order);
    text
}

/// Slip in either direction on a straight piece.
fn slip(text: &mut String, order: usize) {
    line!(text, "fn expand_slip(h: real, q: Friction, inertia: real) {{");
    sliding(text);
    line!(text, "  let stiff = -(piece.slope * reciprocal / h);");
    for k in 0..=order - 2 {
        line!(text, "  {{");
        velocities(text, k);
        let constant = if k == 0 { " + push" } else { "" };
        line!(text, "    var a = {}{constant};", row("a", k));
        if k > 0 {
            let mut sum = format!("{} * n{}", slower(k), 0);
            for j in (1..k).rev() {
                sum = format!("{} * n{} + ({sum})", slower(j), k - j);
            }
            line!(text, "    a = stiff * ({sum}) + a;");
        }
        let load = if k == 0 { " + load * square" } else { "" };
        line!(text, "    n{k} = {}{load} - kappa * a;", row("m", k));
        line!(text, "    x{} = a * {:?}; w{} = ({}) * {:?};", k + 2, twice(k), k + 2, row("b", k), twice(k));
        line!(text, "  }}");
    }
    line!(text, "  second = {};", slower(1));
    line!(text, "  n{} = 0.0; n{order} = 0.0;", order - 1);
    line!(text, "}}");
}

/// Stick: the belt moves `x2`.
fn stick(text: &mut String, order: usize) {
    line!(text, "fn expand_stick(h: real) {{");
    line!(text, "  let square = h * h;");
    scaled(text, "a", "INPUT_R");
    scaled(text, "m", "INPUT_W");
    scaled(text, "b", "INPUT_H");
    line!(text, "  let load = input(INPUT_N0, instance) * square; let mu = input(INPUT_MU_STICK, instance);");
    line!(text, "  x2 = 0.5 * (drive * square);");
    for k in 0..=order - 2 {
        // Degrees of x2 above the second are 0.
        let [mut tangential, mut normal, mut beyond] = ["a", "m", "b"].map(|name| row(name, k));
        line!(text, "  {{");
        if k <= 2 {
            let u = ["x1", "2.0 * x2", "real(0.0)"][k];
            line!(text, "    let u = {u}; let o = {}.0 * w{};", k + 1, k + 1);
        } else {
            line!(text, "    let o = {}.0 * w{};", k + 1, k + 1);
        }
        if k > 2 {
            [tangential, normal, beyond] =
                ["a", "m", "b"].map(|name| format!("{name}2 * w{k} + {name}5 * o"));
        }
        let (push, press) = if k == 0 {
            (" + drive * square", " - input(INPUT_KAPPA, instance) * (drive * square)")
        } else {
            ("", "")
        };
        line!(text, "    let t = {tangential}{push}; let n = {normal}{press};");
        if k == 0 {
            // Without the static load, whose rounding would decide at the edge of the cone.
            line!(text, "    let held = mu * n;");
            line!(text, "    ahead = input(INPUT_CONE, instance) * square + held - t;");
            line!(text, "    back = input(INPUT_CONE + 1u, instance) * square + held + t;");
            line!(text, "    n0 = n + load;");
        } else {
            let target = if k == 1 { "second".to_owned() } else { format!("x{}", k + 1) };
            let part = if k == 1 { 1.0 } else { 1.0 / (k + 1) as f64 };
            line!(text, "    n{k} = n; {target} = t * {:?};", -part);
        }
        line!(text, "    w{} = ({beyond}) * {:?};", k + 2, twice(k));
        line!(text, "  }}");
    }
    line!(text, "  x{order} = 0.0; n{} = 0.0; n{order} = 0.0;", order - 1);
    line!(text, "}}");
}

/// Free flight: the gap takes the place of the normal force.
fn flight(text: &mut String, order: usize) {
    line!(text, "fn expand_flight(h: real) {{");
    line!(text, "  let square = h * h;");
    for (name, word) in [("a", "INPUT_FLIGHT_X"), ("m", "INPUT_FLIGHT_Y"), ("b", "INPUT_H")] {
        scaled(text, name, word);
        line!(
            text,
            "  let {name}1 = input({word} + 1u, instance) * square; let {name}4 = input({word} + 4u, instance) * h;"
        );
    }
    line!(text, "  n0 = py; n1 = vy * h;");
    for k in 0..=order - 2 {
        line!(text, "  {{");
        velocities(text, k);
        line!(text, "    let g = {}.0 * n{};", k + 1, k + 1);
        for (name, target, fall) in [("a", "x", "INPUT_FALL"), ("m", "n", "INPUT_FALL + 1u"), ("b", "w", "")]
        {
            let fall = if k == 0 && !fall.is_empty() {
                format!(" + input({fall}, instance) * square")
            } else {
                String::new()
            };
            let sum = format!("{} + ({name}1 * n{k} + {name}4 * g){fall}", row(name, k));
            line!(text, "    let {target} = {sum};");
        }
        line!(
            text,
            "    x{} = x * {:?}; n{} = n * {:?}; w{} = w * {:?};",
            k + 2,
            twice(k),
            k + 2,
            twice(k),
            k + 2,
            twice(k)
        );
        line!(text, "  }}");
    }
    line!(text, "}}");
}

/// The largest coefficients of degree `k`.
fn largest(k: usize) -> String {
    let held = if k > 2 { "moves * " } else { "" };
    format!("max({held}abs(x{k}), max(abs(w{k}), gap * abs(n{k})))")
}

/// How far the series hold.
fn reach(text: &mut String, order: usize) {
    let power = (2..=order).fold(1.0, |power, _| power * 1.4);
    line!(text, "fn reach(tolerance: real) -> Reach {{");
    line!(text, "  let gap = select(real(0.0), real(1.0), contact == FREE);");
    line!(text, "  let moves = select(real(1.0), real(0.0), contact == STICK);");
    line!(text, "  let bound = tolerance * max({}, max({}, {}));", largest(0), largest(1), largest(2));
    line!(text, "  let before = {}; let last = {};", largest(order - 1), largest(order));
    line!(text, "  let roomy = max(before, last * LONGER) * {power:?} <= bound;");
    line!(text, "  let worst = max(before, last);");
    line!(text, "  if worst <= bound {{ return Reach(1.0, roomy); }}");
    line!(text, "  return Reach(sqrt(sqrt(sqrt(bound / worst))) * MARGIN, roomy);");
    line!(text, "}}");
}

/// The event function with its own value at the start: `share` of the normal force and `sign` of the second series.
fn function(text: &mut String, order: usize) {
    line!(text, "fn put_together(start: real, share: real, sign: real) {{");
    line!(text, "  d0 = start;");
    for k in 1..=order {
        if k == 1 {
            line!(text, "  d1 = share * n1 + sign * second;");
        } else if k < order {
            line!(text, "  d{k} = share * n{k} + sign * ({}.0 * x{});", k + 1, k + 1);
        } else {
            line!(text, "  d{k} = share * n{k};");
        }
    }
    line!(text, "}}");
    // A bound from below: Bernstein coefficients of the terms to the sixth, less what is above.
    line!(text, "fn least() -> real {{");
    line!(
        text,
        "  let c1 = d1 * (1.0 / 6.0); let c2 = d2 * (1.0 / 15.0); let c3 = d3 * (1.0 / 20.0); let c4 = d4 * (1.0 / 15.0); let c5 = d5 * (1.0 / 6.0);"
    );
    line!(
        text,
        "  let low = min(min(min(c1, 2.0 * c1 + c2), min(3.0 * (c1 + c2) + c3, 4.0 * (c1 + c3) + (6.0 * c2 + c4))),"
    );
    line!(
        text,
        "    min(min(5.0 * (c1 + c4) + (10.0 * (c2 + c3) + c5), ((d1 + d2) + (d3 + d4)) + (d5 + d6)), 0.0));"
    );
    let rest: Vec<String> = (7..=order).map(|k| format!("abs(d{k})")).collect();
    line!(text, "  return d0 + low - ({});", rest.join(" + "));
    line!(text, "}}");
}

/// The function without a root at the start.
fn shift(text: &mut String, order: usize) {
    line!(text, "fn without_root() {{");
    for k in 0..order {
        line!(text, "  d{k} = d{};", k + 1);
    }
    line!(text, "  d{order} = 0.0;");
    line!(text, "}}");
}

/// The function and its slope.
fn search(text: &mut String, order: usize) {
    line!(text, "fn searched(t: real) -> vec2<real> {{");
    line!(text, "  var value = d{order}; var slope = real(0.0);");
    for k in (0..order).rev() {
        line!(text, "  slope = slope * t + value; value = value * t + d{k};");
    }
    line!(text, "  return vec2<real>(value, slope);");
    line!(text, "}}");
}

/// The motion at a place in the step: what is added to the start is small, and is rounded once.
fn advance(text: &mut String, order: usize) {
    line!(text, "fn advance(t: real, rate: real) {{");
    for (series, p, v) in [("x", "px", "vx"), ("w", "pw", "vw"), ("n", "py", "vy")] {
        if series == "n" {
            line!(text, "  if contact != FREE {{ return; }}");
        }
        if series == "x" {
            // The belt carries what sticks.
            line!(text, "  if contact == STICK {{ px = (x2 * t + x1) * t + x0; }} else {{");
        } else {
            line!(text, "  {{");
        }
        line!(text, "    var q = {series}{order}; var slope = real(0.0);");
        for k in (2..order).rev() {
            line!(text, "    slope = slope * t + q; q = q * t + {series}{k};");
        }
        line!(text, "    {p} = (q * t + {series}1) * t + {series}0;");
        line!(text, "    {v} = ((slope * t + (q + q)) * t) * rate + {v};");
        line!(text, "  }}");
    }
    line!(text, "}}");
}

/// Positions, velocities and accelerations of `x2` and `y1` at a place in the step, for what is observed; and the velocity
/// of `x2` with its slope alone.
fn motion(text: &mut String, order: usize) {
    line!(text, "fn motion(t: real, rate: real) -> Motion {{");
    for series in ["x", "w"] {
        line!(
            text,
            "  var {series} = {series}{order}; var {series}v = real(0.0); var {series}a = real(0.0);"
        );
        for k in (0..order).rev() {
            line!(
                text,
                "  {series}a = {series}a * t + {series}v; {series}v = {series}v * t + {series}; {series} = {series} * t + {series}{k};"
            );
        }
    }
    line!(text, "  if contact == STICK {{ xa = x2; xv = 2.0 * (x2 * t) + x1; x = (x2 * t + x1) * t + x0; }}");
    line!(text, "  let twice = (rate + rate) * rate;");
    line!(text, "  return Motion(x, xv * rate, xa * twice, w, wv * rate, wa * twice);");
    line!(text, "}}");
    line!(text, "fn velocity(t: real) -> vec2<real> {{");
    line!(text, "  var v = {order}.0 * x{order}; var slope = real(0.0);");
    for k in (1..order).rev() {
        line!(text, "  slope = slope * t + v; v = v * t + {k}.0 * x{k};");
    }
    line!(text, "  if contact == STICK {{ v = 2.0 * (x2 * t) + x1; slope = 2.0 * x2; }}");
    line!(text, "  return vec2<real>(v, slope);");
    line!(text, "}}");
}
