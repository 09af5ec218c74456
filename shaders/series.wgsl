// Twin: src/engine/kernel/series.rs
// The Taylor series of the motion on one contact state; order and equations stand in the twin.

struct Body {
    p: array<real, 3>,
    v: array<real, 3>,
}

struct Value {
    p: real,
    v: real,
    a: real,
}

// The series of one step: x2, y2, y1, T − μ0 N0, N, v.
var<private> sx: array<real, SERIES>;
var<private> sy: array<real, SERIES>;
var<private> sw: array<real, SERIES>;
var<private> st: array<real, SERIES>;
var<private> sn: array<real, SERIES>;
var<private> sv: array<real, SERIES>;
var<private> sq: array<real, SERIES>;
var<private> decay: array<real, SERIES>;

fn springs(k: u32) -> array<real, 3> {
    let next = real(k + 1u);
    let x = sx[k];
    let y = sy[k];
    let w = sw[k];
    let vx = next * sx[k + 1u];
    let vy = next * sy[k + 1u];
    let vw = next * sw[k + 1u];
    let h = scene.k2 * (x * scene.s + y * scene.c - w) + scene.c2 * (vx * scene.s + vy * scene.c - vw);
    let g = scene.k1 * (x * scene.c - y * scene.s) + scene.c1 * (vx * scene.c - vy * scene.s);
    return array<real, 3>(h, scene.c * g + scene.s * h, scene.c * h - scene.s * g);
}

fn push(k: u32, ax: real, ay: real, aw: real) {
    let twice = real(1.0) / real((k + 1u) * (k + 2u));
    sx[k + 2u] = ax * twice;
    sy[k + 2u] = ay * twice;
    sw[k + 2u] = aw * twice;
}

fn expand(body: Body, contact: u32, piece: Piece, belt_velocity: real, belt_acceleration: real) {
    for (var k = 0u; k < SERIES; k++) {
        sx[k] = real(0.0);
        sy[k] = real(0.0);
        sw[k] = real(0.0);
        st[k] = real(0.0);
        sn[k] = real(0.0);
        sv[k] = real(0.0);
    }
    sx[0] = body.p[0];
    sy[0] = body.p[1];
    sw[0] = body.p[2];
    sx[1] = body.v[0];
    sy[1] = body.v[1];
    sw[1] = body.v[2];
    sv[0] = belt_velocity - body.v[0];
    if contact == STICK {
        sx[1] = belt_velocity;
        sv[0] = real(0.0);
        expand_stick(belt_acceleration);
    } else if contact == FREE {
        expand_free(belt_acceleration);
    } else {
        expand_slip(select(real(-1.0), real(1.0), contact == SLIP), piece, belt_velocity, belt_acceleration);
    }
}

fn expand_slip(sigma: real, piece: Piece, belt_velocity: real, belt_acceleration: real) {
    for (var k = 0u; k < SERIES; k++) {
        sq[k] = real(0.0);
        decay[k] = real(0.0);
    }
    let lag = sx[1] - (belt_velocity - scene.v0);
    let f = friction(piece, sigma, sv[0], lag);
    sq[0] = f.q;
    if LAW == LAW_EXPONENTIAL {
        decay[0] = sigma * f.q - piece.at_zero;
    }
    let reciprocal_inertia = real(1.0) / (real(1.0) + scene.kappa * f.q);
    for (var k = 0u; k <= ORDER - 2u; k++) {
        let hrw = springs(k);
        var force = f.q * hrw[2] - hrw[1];
        var normal = hrw[2];
        if k == 0u {
            force += f.less * scene.n0;
            normal += scene.n0;
        }
        for (var j = 1u; j <= k; j++) {
            force += sq[j] * sn[k - j];
        }
        let a = force * reciprocal_inertia;
        sn[k] = normal - scene.kappa * a;
        st[k] = hrw[1] + a;
        push(k, a, real(0.0), hrw[0] * scene.inv_m1);
        let drive = select(real(0.0), belt_acceleration, k == 0u);
        sv[k + 1u] = (drive - a) / real(k + 1u);
        sq[k + 1u] = friction_term(piece, sigma, k + 1u);
    }
}

// A branch for each form: the last one stands without a condition.
const_assert LAW == LAW_PIECES || LAW == LAW_EXPONENTIAL || LAW == LAW_RATIONAL;

fn friction_term(piece: Piece, sigma: real, k: u32) -> real {
    if LAW == LAW_PIECES {
        return piece.slope * sv[k];
    }
    if LAW == LAW_EXPONENTIAL {
        var sum = real(0.0);
        for (var j = 1u; j <= k; j++) {
            sum += real(j) * sv[j] * decay[k - j];
        }
        decay[k] = -(sigma * piece.rate * sum) / real(k);
        return sigma * decay[k];
    }
    var sum = real(0.0);
    for (var j = 1u; j <= k; j++) {
        sum += sv[j] * sq[k - j];
    }
    return -(piece.rate * sigma * sum) / (real(1.0) + piece.rate * sigma * sv[0]);
}

fn expand_stick(belt_acceleration: real) {
    for (var k = 0u; k <= ORDER - 2u; k++) {
        let drive = select(real(0.0), belt_acceleration, k == 0u);
        let hrw = springs(k);
        let normal = select(hrw[2], hrw[2] + scene.n0, k == 0u);
        st[k] = hrw[1] + drive;
        sn[k] = normal - scene.kappa * drive;
        push(k, drive, real(0.0), hrw[0] * scene.inv_m1);
    }
}

fn expand_free(belt_acceleration: real) {
    for (var k = 0u; k <= ORDER - 2u; k++) {
        let hrw = springs(k);
        var r = hrw[1];
        var w = hrw[2];
        var drive = real(0.0);
        if k == 0u {
            r += scene.t0;
            w += scene.n0;
            drive = belt_acceleration;
        }
        let ax = -(scene.normal_mass * r + scene.kappa * w) * scene.inv_det;
        let ay = -(scene.kappa * r + w) * scene.inv_det;
        push(k, ax, ay, hrw[0] * scene.inv_m1);
        sv[k + 1u] = (drive - ax) / real(k + 1u);
    }
}

fn evaluate(series: ptr<private, array<real, SERIES>>, tau: real) -> Value {
    var p = real(0.0);
    var v = real(0.0);
    var a = real(0.0);
    for (var i = 0u; i < SERIES; i++) {
        a = a * tau + v;
        v = v * tau + p;
        p = p * tau + (*series)[ORDER - i];
    }
    return Value(p, v, a + a);
}

fn value(series: ptr<private, array<real, SERIES>>, tau: real) -> real {
    var p = real(0.0);
    for (var i = 0u; i < SERIES; i++) {
        p = p * tau + (*series)[ORDER - i];
    }
    return p;
}

fn largest(k: u32) -> real {
    return max(max(abs(sx[k]), abs(sy[k])), abs(sw[k]));
}

fn step_length(longest: real, tolerance: real) -> real {
    let l0 = largest(0u);
    let l1 = largest(1u);
    let l2 = largest(2u);
    let f7 = largest(ORDER - 1u);
    let f8 = largest(ORDER);
    var step = longest;
    for (var i = 0u; i < MAX_HALVINGS; i++) {
        let square = step * step;
        let power = square * square * square * step;
        let size = max(max(l0, l1 * step), l2 * square);
        if max(f7, f8 * step) * power <= tolerance * size {
            return step;
        }
        step = step * real(0.5);
    }
    return real(0.0);
}
