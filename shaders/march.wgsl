// One instance step by step: the method of the CPU engine. The series of a step, `x0 …`, are written out by
// src/engine/march/series.rs; what is observed on the way is in march_window.wgsl.

struct Event {
    at: real,
    function: u32,
}

struct Friction {
    q: real,
    less: real,
    // What the recurrence of a curved law carries along: of an exponential its distance from the floor, however far down; of
    // others q.
    law: real,
}

// exp(x) − 1 and exp(x).
struct Exponential {
    change: real,
    ratio: real,
}

struct Piece {
    at_zero: real,
    slope: real,
    // Of a straight piece its longest step.
    rate: real,
    offset: real,
}

// How far the series of a step hold, and whether the next may be longer.
struct Reach {
    end: real,
    roomy: bool,
}

var<private> instance: u32;
var<private> px: real;
var<private> py: real;
var<private> pw: real;
var<private> vx: real;
var<private> vy: real;
var<private> vw: real;
var<private> belt: real;
var<private> drive: real;
var<private> contact: u32;
var<private> at: u32;
// The event function that begins at zero: 1 to 3, or none.
var<private> disarmed: u32;
var<private> at_once: u32;
var<private> status: u32;
// Steps of the leg, its section, the time left in the stretch, and the longest step that the last one lets expect.
var<private> steps: u32;
var<private> section: u32;
var<private> left: real;
var<private> pace: real;
var<private> piece: Piece;
// What the second and the third event function begin with, in units of the step.
var<private> ahead: real;
var<private> back: real;

fn body_is_finite() -> bool {
    return is_finite(px) && is_finite(py) && is_finite(pw) && is_finite(vx) && is_finite(vy) && is_finite(vw);
}

fn store_body(word: u32) {
    store(word, instance, px);
    store(word + 1u, instance, py);
    store(word + 2u, instance, pw);
    store(word + 3u, instance, vx);
    store(word + 4u, instance, vy);
    store(word + 5u, instance, vw);
}

fn piece_of(index: u32) -> Piece {
    let word = INPUT_PIECES + index * PIECE_WORDS;
    return Piece(
        input(word + PIECE_AT_ZERO, instance),
        input(word + PIECE_SLOPE, instance),
        input(word + PIECE_RATE, instance),
        input(word + PIECE_OFFSET, instance),
    );
}

fn upper_kink(index: u32) -> real {
    return input(INPUT_PIECES + index * PIECE_WORDS + PIECE_KINK, instance);
}

// q = σ μ and q − μ0 at the relative velocity v; lag = V0 − v, known without cancellation.
fn friction(p: Piece, sigma: real, v: real, lag: real) -> Friction {
    let forward = sigma > 0.0;
    if LAW == LAW_PIECES {
        let q = p.slope * v + sigma * p.at_zero;
        return Friction(q, select(q - input(INPUT_MU0, instance), p.offset - p.slope * lag, forward), q);
    }
    if LAW == LAW_EXPONENTIAL {
        // From the equilibrium, without cancellation, or from rest, where that is too far down.
        let ahead = p.rate * lag;
        let near = forward && ahead <= NEAR;
        let base = select(p.slope, p.offset, near);
        let e = exponential(select(-(p.rate * max(sigma * v, 0.0)), ahead, near));
        let law = base * e.ratio;
        let q = sigma * (p.at_zero + law);
        return Friction(q, select(q - input(INPUT_MU0, instance), base * e.change, near), law);
    }
    let reciprocal = 1.0 / (p.rate * sigma * v + 1.0);
    let q = sigma * p.at_zero * reciprocal;
    let less = p.at_zero * p.rate * lag * reciprocal * p.offset;
    return Friction(q, select(q - input(INPUT_MU0, instance), less, forward), q);
}

// The longest step of a curved law, near whose rest friction changes within a layer of speeds: see Layer in
// src/engine/method/pace.rs.
fn longest_in_layer(q: Friction, inertia: real, sigma: real, relative: real) -> real {
    let normal = form(INPUT_W);
    let force = (q.q * normal + (q.less * input(INPUT_N0, instance) - form(INPUT_R))) / inertia;
    let faster = sigma * (drive - force);
    let acceleration = abs(faster);
    let load = max(normal - input(INPUT_KAPPA, instance) * force, 0.0) + input(INPUT_N0, instance);
    let share = abs(q.law) * load / inertia;
    let widths = piece.rate * max(sigma * relative, 0.0);
    let away = widths + 1.0;
    let reach = input(INPUT_LAYER, instance);
    let along = input(INPUT_LAYER + 1u, instance);
    var held = real(0.0);
    var toward = (acceleration * reach + share * along) / away;
    if LAW == LAW_EXPONENTIAL {
        let square = widths * widths;
        let behind = select(0.0, square * square * LEFT_BEHIND, faster > 0.0);
        let root = sqrt(min(acceleration, share * HIDDEN)) + sqrt(share);
        let slope = select(share, share * HARDER, q.law > 0.0);
        held = max(root * root * 0.25 * reach, slope * along);
        toward = acceleration * reach / (away + behind);
    }
    toward *= piece.rate;
    let turning = piece.rate * reach * abs(q.q * changing(INPUT_W) - changing(INPUT_R)) / (inertia * away);
    let double = toward + sqrt(toward * toward + (turning + turning));
    return 1.0 / max(max(piece.rate * held, double * 0.5), real(1e-30));
}

// How fast a force of springs changes.
fn changing(word: u32) -> real {
    return input(word, instance) * vx + input(word + 2u, instance) * vw;
}

fn form(word: u32) -> real {
    return input(word, instance) * px + (input(word + 2u, instance) * pw
        + (input(word + 3u, instance) * vx + input(word + 5u, instance) * vw));
}

fn mu_of(index: u32, speed: real) -> real {
    return friction(piece_of(index), 1.0, speed, input(INPUT_V0, instance) - speed).q;
}

fn piece_at(speed: real) -> u32 {
    var index = 0u;
    while index + 1u < PIECES && speed >= upper_kink(index) {
        index += 1u;
    }
    return index;
}

// Newton's impact with friction inside its cone.
fn impact() {
    let kappa = input(INPUT_KAPPA, instance);
    let mass = input(INPUT_NORMAL_MASS, instance);
    let down = min(vy, 0.0);
    var rebound = -(input(INPUT_RESTITUTION, instance) * down);
    if rebound < SLOWEST_REBOUND {
        rebound = 0.0;
    }
    let change = rebound - down;
    let relative = belt - vx;
    let rubs = input(INPUT_IMPACT_FRICTION, instance) > 0.0;
    let limit = mu_of(piece_at(abs(relative)), abs(relative));
    var q = select(0.0, select(limit, -limit, relative < 0.0), rubs);
    let jump = (mass * q + kappa) / (1.0 + kappa * q) * change;
    let slides = !rubs || (relative - jump) * relative > 0.0;
    let turns = !slides && abs(relative - kappa * change) > limit * (mass * change - kappa * relative);
    if 1.0 + kappa * q <= 0.0 || (turns && 1.0 - kappa * q <= 0.0) {
        status = STATUS_PAINLEVE;
    }
    let turned = vx + (kappa - mass * q) / (1.0 - kappa * q) * change;
    vx = select(select(belt, turned, turns), vx + jump, slides);
    py = 0.0;
    vy = rebound;
}

// Carries out the event of one of the three functions.
fn carry_out(event: u32) {
    // Whether it ends at the velocity of the belt, or slides, and how.
    var rests = false;
    var slides = false;
    var forward = event == 2u;
    var speed = real(0.0);
    if contact == FREE {
        impact();
        disarmed = 1u;
        if vy <= 0.0 {
            rests = belt - vx == 0.0;
            slides = !rests;
            forward = belt > vx;
            speed = abs(belt - vx);
        }
    } else if event == 1u {
        contact = FREE;
        disarmed = 1u;
    } else if contact == STICK {
        slides = true;
    } else if event == 2u && at == 0u {
        rests = true;
    } else {
        at = select(at - 1u, at + 1u, event == 3u);
        disarmed = select(3u, 2u, event == 3u);
    }
    if !rests && !slides {
        return;
    }
    if speed == 0.0 {
        vx = belt;
    }
    let kappa = input(INPUT_KAPPA, instance);
    let tangential = form(INPUT_R);
    let normal = form(INPUT_W);
    let index = piece_at(speed);
    let mu = mu_of(index, speed);
    // Slip at rest whose inertia is not positive has passed the place where that vanishes.
    let passed = rests && contact <= REVERSE && 1.0 + kappa * select(-mu, mu, contact == SLIP) <= 0.0;
    if passed {
        status = STATUS_PAINLEVE;
        return;
    }
    if rests {
        let pushed = tangential + drive;
        let held = input(INPUT_MU_STICK, instance) * (normal - kappa * drive);
        if held - pushed + input(INPUT_CONE, instance) >= 0.0 && held + pushed + input(INPUT_CONE + 1u, instance) >= 0.0 {
            contact = STICK;
            at = 0u;
            disarmed = 0u;
            return;
        }
        forward = pushed + input(INPUT_T0, instance) >= 0.0;
    }
    if 1.0 + kappa * select(-mu, mu, forward) <= 0.0 {
        status = STATUS_PAINLEVE;
        return;
    }
    // A body that lands again and again without time between is held: the force is zero within rounding.
    let held = contact == FREE && at_once >= HELD_FROM;
    if held || (normal + input(INPUT_N0, instance)) + kappa * (tangential + input(INPUT_T0, instance)) > 0.0 {
        at = index;
        contact = select(REVERSE, SLIP, forward);
        disarmed = select(0u, 2u, speed == 0.0);
    } else {
        contact = FREE;
        disarmed = 1u;
    }
}

// Where the function `d0 …` first falls below zero, if that is before `end`; else `end`.
//
// One loop over its samples, its dips and its root, so that lanes that are at different ones go on together.
fn first_root(end: real) -> real {
    let gap = real(1.0 / 8.0);
    var low = real(0.0);
    var high = real(0.0);
    var low_slope = d1;
    var low_value = d0;
    var t = gap;
    var next = gap;
    var mode = SAMPLES;
    for (var i = 0u; i < 40u; i++) {
        let found = searched(t);
        let value = found.x;
        let slope = found.y;
        if mode == SAMPLES {
            if value <= 0.0 {
                high = t;
                mode = ROOT;
                t = t - gap * (0.0 - value) / (low_value - value);
                continue;
            }
            // Between two slopes that fall and rise it may dip: not where their lines meet above zero.
            let meets = low_value + low_slope * ((value - low_value - slope * gap) / (low_slope - slope));
            if low_slope < 0.0 && slope > 0.0 && meets <= 0.0 {
                high = t;
                next = t;
                mode = DIP;
                t = t - gap * slope / (slope - low_slope);
                continue;
            }
            low = t;
            low_slope = slope;
            low_value = value;
            if low >= end {
                return end;
            }
            t = t + gap;
            continue;
        }
        if mode == DIP {
            if value <= 0.0 {
                high = t;
                mode = ROOT;
                t = 0.5 * (low + high);
                continue;
            }
            if slope < 0.0 {
                low = t;
            } else {
                high = t;
            }
            // It has come to its least, or its line stays above zero to the end of the bracket.
            if high - low < 1e-3 || value - abs(slope) * (high - low) > 0.0 {
                mode = SAMPLES;
                t = next;
                low_slope = 0.0;
                continue;
            }
            t = 0.5 * (low + high);
            continue;
        }
        if value > 0.0 {
            low = t;
        } else {
            high = t;
        }
        let newton = t - value / slope;
        let inside = slope < 0.0 && newton >= low && newton <= high;
        let better = select(0.5 * (low + high), newton, inside);
        let change = abs(better - t);
        t = better;
        if change * change < ENOUGH * EPSILON {
            return min(t, end);
        }
    }
    return select(end, min(t, end), mode == ROOT);
}

// The order of zeros at the start that are looked through, each by a line below.
const_assert HIGHEST_ORDER == 3u;

// Takes a root at the start from the function; whether it still begins at zero, within `bound`.
fn is_zero_without_root(bound: ptr<function, real>, h: real, begins: bool) -> bool {
    without_root();
    *bound = *bound * h;
    return d0 <= 0.0 && d0 >= -select(0.0, *bound, begins);
}

// The first event in the step up to `end`: its place and the number of its function.
fn first_event(end: real, h: real, tolerance: real) -> Event {
    var first = Event(end, 0u);
    let flies = contact == FREE;
    let sticks = contact == STICK;
    var functions = select(3u, 1u, flies);
    for (var f = 1u; f <= functions; f++) {
        let share = select(select(0.0, input(INPUT_MU_STICK, instance), sticks), 1.0, f == 1u);
        let slower = select(real(1.0), real(-1.0), contact == SLIP);
        let sign = select(select(slower, -slower, f == 3u), 0.0, f == 1u);
        let start = select(select(ahead, back, f == 3u), n0, f == 1u);
        put_together(start, share, sign);
        var begins = disarmed == f;
        if !begins && least() > 0.0 {
            continue;
        }
        let of_force = !flies && (f == 1u || sticks);
        if begins || (of_force && d0 <= 0.0) {
            let rate = 1.0 / h;
            let size = (input(INPUT_MU_STICK, instance) + 1.0) * input(INPUT_N0, instance) + abs(n0) * (rate * rate);
            let motion = (max(abs(x2), abs(w2)) * rate + max(abs(x1), abs(w1))) * rate + max(abs(x0), abs(w0));
            let band = ROUNDINGS * EPSILON * size + tolerance * input(INPUT_STIFFNESS, instance) * motion;
            var bound = band * h * select(1.0, h, of_force);
            if flies {
                bound = band * input(INPUT_INV_DET, instance);
            }
            // A loop over the orders of a zero is written out by some compilers with all that follows.
            var zero = begins || d0 >= -band * h * h;
            if zero {
                zero = is_zero_without_root(&bound, h, begins);
            }
            if zero {
                zero = is_zero_without_root(&bound, h, begins);
            }
            if zero {
                zero = is_zero_without_root(&bound, h, begins);
            }
            if zero {
                continue;
            }
            if least() > 0.0 {
                continue;
            }
        }
        var root = real(0.0);
        if d0 > 0.0 {
            root = first_root(first.at);
        }
        if root < first.at {
            first = Event(root, f);
        }
    }
    return first;
}
