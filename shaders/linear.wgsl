// Twin: src/engine/kernel/linear.rs
// Eigenvalues of one sliding equilibrium and their attribution; the formulas stand in the twin.

struct Quartic {
    p: real,
    g: real,
    k: real,
    e: real,
}

struct Factors {
    p1: real,
    q1: real,
    t1: real,
    p2: real,
    q2: real,
    t2: real,
}

struct Root {
    re: real,
    im: real,
    p: real,
    q: real,
    t: real,
}

fn split(quartic: Quartic) -> real {
    let two = real(2.0);
    let three = real(3.0);
    let four = real(4.0);
    let half = real(0.5);
    let b = four - quartic.g;
    let c = quartic.k;
    let f = quartic.e * quartic.e;
    var low = real(0.0);
    var high = real(1.0) + max(max(abs(b), abs(c)), f);
    if b > real(0.0) {
        let root = sqrt(c * c + four * b * f);
        if c < real(0.0) {
            high = (root - c) / (two * b);
        } else if f > real(0.0) {
            high = two * f / (root + c);
        } else {
            high = real(0.0);
        }
    }
    var y = high;
    for (var k = 0u; k < MAX_STEPS; k++) {
        let value = ((two * y + b) * y + c) * y - f;
        let slope = (three * two * y + two * b) * y + c;
        if value > real(0.0) {
            high = y;
        } else {
            low = y;
        }
        let newton = y - value / slope;
        let inside = newton >= low && newton <= high;
        let next = select(half * (low + high), newton, inside);
        let step = abs(next - y);
        y = next;
        if step <= NEGLIGIBLE_EPSILONS * EPSILON * next {
            break;
        }
    }
    return y;
}

fn factors(quartic: Quartic) -> Factors {
    let two = real(2.0);
    let y = split(quartic);
    let r = sqrt(y * (two + y));
    let product = quartic.e + quartic.p * y;
    let square = (two * y - quartic.g) + quartic.p * quartic.p;
    var w = sqrt(max(square, real(0.0)));
    // The one of the two ways to w that has no cancellation.
    if quartic.g > real(0.0) && r > real(0.0) {
        w = product / r;
    } else if product < real(0.0) {
        w = -w;
    }
    let t1 = y + r;
    let q1 = real(1.0) + t1;
    let q2 = real(1.0) / q1;
    let p1 = quartic.p + w;
    var p2 = quartic.p - w;
    // c = p1 q2 + p2 q1 knows a p2 that is small beside p1 better than the sum does.
    if abs(p1) > abs(p2) {
        p2 = (two * (quartic.p - quartic.e) - p1 * q2) / q1;
    }
    return Factors(p1, q1, t1, p2, q2, -(t1 * q2));
}

fn quadratic(p: real, q: real, t: real) -> Root {
    let half = -real(0.5) * p;
    let discriminant = half * half - q;
    if discriminant < real(0.0) {
        return Root(half, sqrt(-discriminant), p, q, t);
    }
    let root = sqrt(discriminant);
    if half >= real(0.0) {
        return Root(half + root, real(0.0), p, q, t);
    }
    return Root(q / (half - root), real(0.0), p, q, t);
}

fn rightmost(quartic: Quartic) -> Root {
    let both = factors(quartic);
    let first = quadratic(both.p1, both.q1, both.t1);
    let second = quadratic(both.p2, both.q2, both.t2);
    if second.re > first.re || (second.re == first.re && second.im > first.im) {
        return second;
    }
    return first;
}

fn is_unstable(root: Root) -> bool {
    let size = sqrt(root.re * root.re + root.im * root.im);
    return root.re > UNSTABLE_ABOVE * size;
}

fn type_of(full: bool, flat: bool, frozen: bool) -> u32 {
    if !full {
        return TYPE_STABLE;
    }
    if flat && frozen {
        return TYPE_COEXISTENCE;
    }
    if flat {
        return TYPE_MODE_COUPLING;
    }
    if frozen {
        return TYPE_NEGATIVE_SLOPE;
    }
    return TYPE_INTERACTION;
}

fn polynomial(first: u32, instance: u32) -> Quartic {
    return Quartic(
        input(first, instance),
        input(first + 1u, instance),
        input(first + 2u, instance),
        input(first + 3u, instance),
    );
}

fn analyse(instance: u32) {
    let full = rightmost(polynomial(INPUT_FULL, instance));
    let flat = rightmost(polynomial(INPUT_FLAT, instance));
    let frozen = rightmost(polynomial(INPUT_FROZEN, instance));
    let mass = input(INPUT_NORMAL_MASS, instance);
    let gap = input(INPUT_NORMAL_GAP, instance);
    let damping = input(INPUT_NORMAL_DAMPING, instance);
    let above_re = real(1.0) + damping * full.re;
    let above_im = damping * full.im;
    let below = damping - mass * full.p;
    let near = abs(full.t) < real(0.5);
    let below_re = select(real(1.0) - mass * full.q, gap - mass * full.t, near) + below * full.re;
    let below_im = below * full.im;
    let ratio_re = above_re * below_re + above_im * below_im;
    let ratio_im = above_im * below_re - above_re * below_im;
    store(STATE_GROWTH_RATE, instance, full.re);
    store(STATE_FREQUENCY, instance, full.im);
    store(STATE_RATIO_RE, instance, ratio_re);
    store(STATE_RATIO_IM, instance, ratio_im);
    store(STATE_GROWTH_RATE_FLAT, instance, flat.re);
    store(STATE_GROWTH_RATE_FROZEN, instance, frozen.re);
    set_flag(FLAG_TYPE, instance, type_of(is_unstable(full), is_unstable(flat), is_unstable(frozen)));
    set_flag(FLAG_STEPS, instance, POLYNOMIALS);
    let finite = is_finite(full.re) && is_finite(full.im) && is_finite(ratio_re) && is_finite(ratio_im)
        && is_finite(flat.re) && is_finite(frozen.re);
    finish(instance, select(STATUS_NON_FINITE, STATUS_OK, finite));
}
