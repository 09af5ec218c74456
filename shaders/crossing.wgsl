// Twin: src/kernel/crossing.rs
// The first downward crossing of an event function inside a step.

// The event function under test, and its coefficients scaled to the step.
var<private> sg: array<real, SERIES>;
var<private> sb: array<real, SERIES>;

fn lower_bound(degree: u32) -> real {
    let c1 = sb[1] * real(0.25);
    let c2 = sb[2] * real(1.0 / 6.0);
    let c3 = sb[3] * real(0.25);
    let two = real(2.0);
    let three = real(3.0);
    let b1 = sb[0] + c1;
    let b2 = sb[0] + two * c1 + c2;
    let b3 = sb[0] + three * c1 + three * c2 + c3;
    let b4 = sb[0] + sb[1] + sb[2] + sb[3] + sb[4];
    var rest = real(0.0);
    for (var k = 5u; k <= degree; k++) {
        rest += abs(sb[k]);
    }
    return min(min(min(min(sb[0], b1), b2), b3), b4) - rest;
}

fn deflated(degree: u32, start: u32, t: real) -> vec2<real> {
    var value = real(0.0);
    var slope = real(0.0);
    for (var i = start; i <= degree; i++) {
        slope = slope * t + value;
        value = value * t + sb[degree - (i - start)];
    }
    return vec2<real>(value, slope);
}

fn first_crossing(degree: u32, step: real, from_zero: bool, near: real, rounding: real) -> real {
    var power = real(1.0);
    for (var k = 0u; k <= degree; k++) {
        sb[k] = sg[k] * power;
        power = power * step;
    }
    if !from_zero && lower_bound(degree) > real(0.0) {
        return NEVER;
    }
    var start = 0u;
    if from_zero {
        start = 1u;
        while start <= HIGHEST_ORDER && sg[start] <= real(0.0) && sg[start] >= -rounding {
            start += 1u;
        }
        if start > HIGHEST_ORDER {
            return NEVER;
        }
    } else if sg[0] <= real(0.0) && sg[0] >= -near {
        start = 1u;
    }
    if sb[start] <= real(0.0) {
        return real(0.0);
    }
    var low = real(0.0);
    var high = real(0.0);
    for (var i = 1u; i <= SAMPLES; i++) {
        let t = real(i) / real(SAMPLES);
        if high <= real(0.0) {
            if deflated(degree, start, t).x <= real(0.0) {
                high = t;
            } else {
                low = t;
            }
        }
    }
    if high <= real(0.0) {
        return NEVER;
    }
    var t = real(0.5) * (low + high);
    for (var i = 0u; i < SOLVER_ITERATIONS; i++) {
        let d = deflated(degree, start, t);
        if d.x > real(0.0) {
            low = t;
        } else {
            high = t;
        }
        var next = real(0.5) * (low + high);
        if d.y < real(0.0) {
            let newton = t - d.x / d.y;
            if newton >= low && newton <= high {
                next = newton;
            }
        }
        t = next;
    }
    return t * step;
}
