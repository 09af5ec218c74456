// Twin: src/engine/kernel/scene.rs
// One instance: its words, its friction law, its segments. The words stay in the input buffer; those of
// the equations are read once per dispatch.

struct Scene {
    s: real,
    c: real,
    inv_m1: real,
    k1: real,
    k2: real,
    c1: real,
    c2: real,
    kappa: real,
    inv_det: real,
    normal_mass: real,
    n0: real,
    t0: real,
    mu0: real,
    v0: real,
    mu_stick: real,
    cone_forward: real,
    cone_backward: real,
    restitution: real,
    impact_friction: real,
    slowest_rebound: real,
}

struct Piece {
    at_zero: real,
    slope: real,
    rate: real,
    offset: real,
    kink: real,
}

struct Segment {
    steps: real,
    step: real,
    velocity: real,
    acceleration: real,
    part: real,
}

// q = σ μ and q − μ0.
struct Friction {
    q: real,
    less: real,
}

var<private> instance: u32;
var<private> scene: Scene;

fn read_scene() {
    scene.s = input(INPUT_SIN, instance);
    scene.c = input(INPUT_COS, instance);
    scene.inv_m1 = input(INPUT_INV_M1, instance);
    scene.k1 = input(INPUT_K1, instance);
    scene.k2 = input(INPUT_K2, instance);
    scene.c1 = input(INPUT_C1, instance);
    scene.c2 = input(INPUT_C2, instance);
    scene.kappa = input(INPUT_KAPPA, instance);
    scene.inv_det = input(INPUT_INV_DET, instance);
    scene.normal_mass = input(INPUT_NORMAL_MASS, instance);
    scene.n0 = input(INPUT_N0, instance);
    scene.t0 = input(INPUT_T0, instance);
    scene.mu0 = input(INPUT_MU0, instance);
    scene.v0 = input(INPUT_V0, instance);
    scene.mu_stick = input(INPUT_MU_STICK, instance);
    scene.cone_forward = input(INPUT_CONE, instance);
    scene.cone_backward = input(INPUT_CONE + 1u, instance);
    scene.restitution = input(INPUT_RESTITUTION, instance);
    scene.impact_friction = input(INPUT_IMPACT_FRICTION, instance);
    scene.slowest_rebound = input(INPUT_SLOWEST_REBOUND, instance);
}

fn piece_of(index: u32) -> Piece {
    let word = INPUT_PIECES + index * PIECE_WORDS;
    return Piece(
        input(word + PIECE_AT_ZERO, instance),
        input(word + PIECE_SLOPE, instance),
        input(word + PIECE_RATE, instance),
        input(word + PIECE_OFFSET, instance),
        input(word + PIECE_KINK, instance),
    );
}

fn segment_of(index: u32) -> Segment {
    let word = INPUT_SEGMENTS + index * SEGMENT_WORDS;
    var acceleration = real(0.0);
    if RAMP {
        acceleration = input(word + SEGMENT_ACCELERATION, instance);
    }
    return Segment(
        input(word + SEGMENT_STEPS, instance),
        input(word + SEGMENT_STEP, instance),
        input(word + SEGMENT_VELOCITY, instance),
        acceleration,
        input(word + SEGMENT_PART, instance),
    );
}

// The functions below have a branch for each form: the last one stands without a condition.
const_assert LAW == LAW_PIECES || LAW == LAW_EXPONENTIAL || LAW == LAW_RATIONAL;

fn friction(piece: Piece, sigma: real, v: real, lag: real) -> Friction {
    let forward = sigma > real(0.0);
    if LAW == LAW_PIECES {
        let q = sigma * piece.at_zero + piece.slope * v;
        return Friction(q, select(q - scene.mu0, piece.offset - piece.slope * lag, forward));
    }
    if LAW == LAW_EXPONENTIAL {
        let ahead = piece.rate * lag;
        let near = forward && ahead <= FAR;
        let base = select(piece.slope, piece.offset, near);
        let less = base * exp_m1(select(-(piece.rate * max(sigma * v, real(0.0))), ahead, near));
        let q = sigma * (piece.at_zero + (base + less));
        return Friction(q, select(q - scene.mu0, less, near));
    }
    let reciprocal = real(1.0) / (real(1.0) + piece.rate * sigma * v);
    let q = sigma * piece.at_zero * reciprocal;
    let less = piece.at_zero * piece.rate * lag * reciprocal * piece.offset;
    return Friction(q, select(q - scene.mu0, less, forward));
}

fn longest_in_layer(piece: Piece, q: real, v: real, acceleration: real) -> real {
    let narrowing = real(1.0) / (real(1.0) + piece.rate * abs(v));
    var sloped = abs(q) * narrowing;
    if LAW == LAW_EXPONENTIAL {
        sloped = abs(abs(q) - piece.at_zero);
    }
    let across = input(INPUT_LAYER, instance);
    let along = input(INPUT_LAYER + 1u, instance);
    let inverse = piece.rate * (abs(acceleration) * narrowing * across + sloped * along);
    return real(1.0) / max(inverse, real(1.0) / NO_KINK);
}

fn mu(speed: real) -> real {
    return friction(piece_of(piece_at(speed)), real(1.0), speed, scene.v0 - speed).q;
}

fn piece_at(speed: real) -> u32 {
    var index = 0u;
    loop {
        if index + 1u >= PIECES {
            break;
        }
        if speed < input(INPUT_PIECES + index * PIECE_WORDS + PIECE_KINK, instance) {
            break;
        }
        index += 1u;
    }
    return index;
}

fn exp_m1(x: real) -> real {
    var y = min(max(x, real(-80.0)), real(80.0));
    var doublings = 0u;
    while abs(y) > real(0.5) {
        y = y * real(0.5);
        doublings += 1u;
    }
    var sum = real(1.0);
    for (var k = EXP_DEGREE; k >= 2u; k--) {
        sum = real(1.0) + y * sum / real(k);
    }
    var e = y * sum;
    for (var i = 0u; i < doublings; i++) {
        e = e * (real(2.0) + e);
    }
    return e;
}
