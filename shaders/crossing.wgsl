// Twin: src/engine/kernel/crossing.rs
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

fn lowest(degree: u32, start: u32, sample: real, curvature: real) -> real {
    let gap = real(1.0) / real(SAMPLES);
    var t = sample;
    for (var i = 0u; i < DIP_ITERATIONS; i++) {
        let slope = deflated(degree, start, t).y;
        let next = t - slope * (gap * gap) / curvature;
        t = min(max(next, sample - gap), sample + gap);
    }
    return t;
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
        while start <= HIGHEST_ORDER && sg[start] == real(0.0) {
            start += 1u;
        }
        if start > HIGHEST_ORDER {
            return NEVER;
        }
    }
    if sb[start] <= real(0.0) {
        return real(0.0);
    }
    var low = real(0.0);
    var high = real(0.0);
    let two = real(2.0);
    let gap = real(1.0) / real(SAMPLES);
    var before = sb[start];
    var here = before;
    for (var i = 1u; i <= SAMPLES; i++) {
        let t = real(i) / real(SAMPLES);
        if high <= real(0.0) {
            let value = deflated(degree, start, t).x;
            var curvature = before - two * here + value;
            var falls = before - here;
            if i == 1u {
                falls = -(sb[start + 1u] * gap);
                curvature = two * ((value - here) + falls);
            }
            if value <= real(0.0) {
                high = t;
            } else if falls > real(0.0) && here <= value && here <= DIP * curvature {
                let bottom = lowest(degree, start, t - gap, curvature);
                if deflated(degree, start, bottom).x <= real(0.0) {
                    high = bottom;
                    low = max(t - two * gap, real(0.0));
                }
            }
            if high <= real(0.0) {
                low = t;
            }
            before = here;
            here = value;
        }
    }
    if high <= real(0.0) {
        let rise = deflated(degree, start, real(1.0)).y * gap;
        let curvature = two * (rise + (before - here));
        if rise > real(0.0) && here < before && here <= DIP * curvature {
            let bottom = lowest(degree, start, real(1.0), curvature);
            if deflated(degree, start, bottom).x <= real(0.0) {
                high = bottom;
                low = real(1.0) - gap;
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
