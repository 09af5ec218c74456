// What is seen of the motion: sums over the window and before the first event, crossings, Fourier components.
//
// Sums stand in the buffer of the state and are added to once a step, so that they take no registers.

struct Motion {
    x: real,
    vx: real,
    ax: real,
    w: real,
    vw: real,
    aw: real,
}

// Largest values of |ẍ2|, |ÿ1| and N on the way through the samples of a step: that of the samples so far, with the slopes
// on both sides of it, and the last two samples.
struct Tops {
    top: vec3<real>,
    left: vec3<real>,
    right: vec3<real>,
    before: vec3<real>,
    per_width: vec3<real>,
    one: vec3<real>,
    two: vec3<real>,
}

// Time since the stretch began.
var<private> time: real;
// ẋ2 at the end of the step before.
var<private> previous: real;

fn add(word: u32, value: real) {
    store(word, instance, load(word, instance) + value);
}

// The fraction of a step of a sample: its start, three nodes, its end.
fn sample_time(i: u32) -> real {
    let inner = select(select(NODE_2, NODE_1, i == 2u), NODE_0, i == 1u);
    return select(select(inner, real(1.0), i == 4u), real(0.0), i == 0u);
}

// That of a sample between the ends.
fn sample_weight(i: u32) -> real {
    return select(WEIGHT_0, WEIGHT_1, i == 2u);
}

fn rotation(angle: real) -> vec2<real> {
    let s = angle * angle;
    let cosine = 1.0 - s * (1.0 / 2.0) * (1.0 - s * (1.0 / 12.0) * (1.0 - s * (1.0 / 30.0) * (1.0
        - s * (1.0 / 56.0) * (1.0 - s * (1.0 / 90.0) * (1.0 - s * (1.0 / 132.0))))));
    let sine = 1.0 - s * (1.0 / 6.0) * (1.0 - s * (1.0 / 20.0) * (1.0 - s * (1.0 / 42.0) * (1.0
        - s * (1.0 / 72.0) * (1.0 - s * (1.0 / 110.0) * (1.0 - s * (1.0 / 156.0))))));
    return vec2<real>(cosine, sine * angle);
}

// z exp(−iφ).
fn turned(z: vec2<real>, by: vec2<real>) -> vec2<real> {
    return vec2<real>(z.x * by.x + z.y * by.y, z.y * by.x - z.x * by.y);
}

// Notes an upward crossing this long after the step began.
fn note(after: real) {
    let moment = time + after;
    let crossings = flag(FLAG_CROSSINGS, instance);
    let number = flag(FLAG_STRETCH, instance);
    let since = load(STATE_BASE, instance) + moment;
    if crossings == 0u {
        store(STATE_FIRST, instance, moment);
        if PART == PART_WINDOW {
            store(STATE_FROM, instance, since);
            set_flag(FLAG_FIRST_IN, instance, number);
        }
    }
    store(STATE_LAST, instance, moment);
    if PART == PART_WINDOW {
        store(STATE_TO, instance, since);
        set_flag(FLAG_LAST_IN, instance, number);
    }
    set_flag(FLAG_CROSSINGS, instance, crossings + 1u);
}

// Counts upward crossings of ẋ2 from end to end of the steps, on straight lines.
fn guess_crossings(before: real, after: real, tau: real) {
    if (previous < 0.0 && before >= 0.0) || (before < 0.0 && after >= 0.0 && tau > 0.0) {
        let rises = before < 0.0;
        note(select(0.0, before / min(before - after, real(-1e-30)) * tau, rises));
    }
    previous = after;
}

// Adds a step before the first event: position, velocity and accelerations at its end.
fn observe_growth(tau: real, end: Motion) {
    let a = vec4<real>(end.x, end.vx, end.ax, end.aw);
    add(STATE_GROWTH, tau);
    for (var i = 0u; i < 4u; i++) {
        let one = select(select(a.w, a.z, i == 2u), select(a.y, a.x, i == 0u), i < 2u);
        let weighted = tau * one;
        add(STATE_GROWTH + 1u + i, weighted);
        // The upper triangle by rows.
        let row = STATE_GROWTH + 5u + i * (9u - i) / 2u;
        if i < 1u {
            add(row, weighted * a.x);
        }
        if i < 2u {
            add(row + 1u - i, weighted * a.y);
        }
        if i < 3u {
            add(row + 2u - i, weighted * a.z);
        }
        add(row + 3u - i, weighted * a.w);
    }
}

// The Fourier sums up to `moment` of the step, noted at a crossing.
fn note_spectrum(moment: real, h: real) {
    let begun = flag(FLAG_BEGUN, instance) == 1u;
    let tau = moment * h;
    let rate = 1.0 / h;
    let omega = load(STATE_OMEGA, instance);
    let scale = load(STATE_SCALE, instance);
    var carrier = vec2<real>(load(STATE_CARRIER, instance), load(STATE_CARRIER + 1u, instance));
    var first = vec4<real>();
    var second = vec4<real>();
    var third = vec4<real>();
    for (var i = 1u; i < 4u; i++) {
        let here = sample_time(i);
        carrier = turned(carrier, rotation(omega * tau * (here - sample_time(i - 1u))));
        let m = motion(moment * here, rate);
        let weight = tau * sample_weight(i);
        let term = vec4<real>(m.ax * carrier, m.aw * carrier) * weight;
        let u = (time + tau * here) * scale - 1.0;
        first += term;
        second += term * u;
        third += term * (u * u);
    }
    for (var j = 0u; j < 12u; j++) {
        let powers = select(select(third, second, j < 8u), first, j < 4u);
        let k = j % 4u;
        let part = select(select(powers.w, powers.z, k == 2u), select(powers.y, powers.x, k == 0u), k < 2u);
        let sum = load(STATE_SPECTRUM + j, instance);
        store(STATE_NOTED + j, instance, select(0.0, sum + part, begun));
        if !begun {
            // What comes before the first crossing in the step does not count.
            store(STATE_SPECTRUM + j, instance, -part);
        }
    }
    set_flag(FLAG_BEGUN, instance, 1u);
}

// Notes the crossing between two samples of a step of length h: places, velocities and accelerations.
fn cross(low: real, high: real, v: vec2<real>, a: vec2<real>, h: real) {
    let span = high - low;
    let ends = a * (span * h);
    let rise = v.y - v.x;
    var s = -v.x / max(rise, real(1e-30));
    let square = 3.0 * rise - (ends.x + ends.x + ends.y);
    let cube = ends.x + ends.y - rise - rise;
    let here = ((cube * s + square) * s + ends.x) * s + v.x;
    let slope = (3.0 * cube * s + (square + square)) * s + ends.x;
    if slope > 0.0 {
        s = min(max(s - here / slope, 0.0), real(1.0));
    }
    var t = s * span + low;
    let late = load(STATE_CLOSING, instance) <= time + t * h;
    let counts = late || flag(FLAG_BEGUN, instance) == 0u;
    if counts {
        for (var k = 0u; k < 3u; k++) {
            let found = velocity(t);
            if found.y > 0.0 {
                t = min(max(t - found.x / found.y, low), high);
            }
        }
        note_spectrum(t, h);
    }
    note(t * h);
    set_flag(FLAG_FRESH, instance, select(0u, 1u, counts));
}

// On to the next sample of a step, `way` behind the last one, which was `way_in` behind that before it.
fn higher(tops: Tops, value: vec3<real>, i: u32, way_in: real, way: real) -> Tops {
    var next = tops;
    if i == 0u {
        next.top = value;
    } else if i > 1u {
        let up = tops.one > tops.top;
        next.top = select(tops.top, tops.one, up);
        next.left = select(tops.left, (tops.one - tops.two) / way_in, up);
        next.right = select(tops.right, (value - tops.one) / way, up);
        next.before = select(tops.before, vec3<real>(way_in), up);
        next.per_width = select(tops.per_width, vec3<real>(1.0 / (way_in + way)), up);
    }
    next.two = tops.one;
    next.one = value;
    return next;
}

// The maximum of a smooth function from its samples: on the parabola through three of them.
fn highest(tops: Tops) -> vec3<real> {
    let curvature = (tops.right - tops.left) * tops.per_width;
    let tangent = curvature * tops.before + tops.left;
    let bent = select(vec3<bool>(), tops.one <= tops.top, curvature < vec3<real>());
    let rise = tangent * tangent / select(vec3<real>(1.0), curvature * -4.0, bent);
    return select(max(tops.top, tops.one), tops.top + rise, bent);
}

// Adds the part of the step up to `end` to the window; returns the motion at its end.
fn observe_window(end: real, h: real) -> Motion {
    let tau = end * h;
    let rate = 1.0 / h;
    let flies = contact == FREE;
    let t0 = input(INPUT_T0, instance);
    let origin = vec2<real>(load(STATE_START, instance), load(STATE_START + 2u, instance));
    let omega = load(STATE_OMEGA, instance);
    let scale = load(STATE_SCALE, instance);
    var carrier = vec2<real>(load(STATE_CARRIER, instance), load(STATE_CARRIER + 1u, instance));
    // x, x², w, w²; ẍ², ẅ², speed²; T, N.
    var places = vec4<real>();
    var squares = vec3<real>();
    var forces = vec2<real>();
    var first = vec4<real>();
    var second = vec4<real>();
    var third = vec4<real>();
    var tops = Tops();
    var m = Motion();
    var v = previous;
    var a = real(0.0);
    var before = real(0.0);
    var last = real(0.0);
    var way_in = real(0.0);
    for (var i = 0u; i < 5u; i++) {
        let here = sample_time(i);
        let t = end * here;
        let way = here - last;
        if i == 0u {
            let twice = (rate + rate) * rate;
            m = Motion(x0, x1 * rate, x2 * twice, w0, w1 * rate, w2 * twice);
        } else {
            m = motion(t, rate);
            // The end has the velocity with which the next step begins, or a crossing there could count in both.
            m.vx = select(m.vx, vx, i == 4u);
        }
        let pressed = input(INPUT_W, instance) * m.x + (input(INPUT_W + 2u, instance) * m.w
            + (input(INPUT_W + 3u, instance) * m.vx + input(INPUT_W + 5u, instance) * m.vw))
            + input(INPUT_N0, instance) - input(INPUT_KAPPA, instance) * m.ax;
        let normal = select(pressed, 0.0, flies);
        tops = higher(tops, vec3<real>(abs(m.ax), abs(m.aw), normal), i, way_in, way);
        if i > 0u {
            carrier = turned(carrier, rotation(omega * tau * way));
        }
        // The ends of the step have no weight.
        if i > 0u && i < 4u {
            let tangential = input(INPUT_R, instance) * m.x + (input(INPUT_R + 2u, instance) * m.w
                + (input(INPUT_R + 3u, instance) * m.vx + input(INPUT_R + 5u, instance) * m.vw)) + m.ax + t0;
            let weight = tau * sample_weight(i);
            let d = vec2<real>(m.x, m.w) - origin;
            places += weight * vec4<real>(d.x, d.x * d.x, d.y, d.y * d.y);
            squares += weight * vec3<real>(m.ax * m.ax, m.aw * m.aw, m.vx * m.vx + m.vw * m.vw);
            forces += weight * vec2<real>(select(tangential, 0.0, flies), normal);
            let term = vec4<real>(m.ax * carrier, m.aw * carrier) * weight;
            let u = (time + tau * here) * scale - 1.0;
            first += term;
            second += term * u;
            third += term * (u * u);
        }
        // The first sample crosses where it is above and the end of the step before was not.
        var low = before;
        var high = t;
        var speeds = vec2<real>(v, m.vx);
        var accelerations = vec2<real>(a, m.ax);
        var crosses = v < 0.0 && m.vx >= 0.0;
        if i == 0u {
            speeds = vec2<real>(-1.0, 0.0);
            accelerations = vec2<real>();
        } else if (v < 0.0 && m.vx < 0.0 && a > 0.0 && m.ax < 0.0) || (v >= 0.0 && m.vx >= 0.0 && a < 0.0 && m.ax > 0.0) {
            // An extremum that may reach over zero.
            let bend = (m.ax - a) / max(high - low, real(1e-30));
            var turn = low - a / bend;
            var found = vec2<real>();
            for (var k = 0u; k < 4u; k++) {
                found = velocity(turn);
                if k < 3u {
                    turn = min(max(turn - found.y * (rate * rate) / bend, low), high);
                }
            }
            let depth = found.x * rate;
            if v < 0.0 && depth >= 0.0 {
                crosses = true;
                high = turn;
                speeds.y = depth;
                accelerations.y = 0.0;
            } else if v >= 0.0 && depth < 0.0 {
                crosses = true;
                low = turn;
                speeds.x = depth;
                accelerations.x = 0.0;
            }
        }
        // Reversed slip and stick are not below the velocity of the belt, which is not below 0, but for a rounding.
        if crosses && (i == 0u || contact == SLIP || contact == FREE) {
            cross(low, high, speeds, accelerations, h);
        }
        before = t;
        last = here;
        way_in = way;
        v = m.vx;
        a = m.ax;
    }
    previous = v;
    add(STATE_WINDOW + SUM_TIME, tau);
    add(STATE_WINDOW + select(select(SUM_REVERSE, SUM_STICK, contact == STICK), SUM_FREE, flies),
        select(tau, 0.0, contact == SLIP));
    add(STATE_WINDOW + SUM_X, places.x);
    add(STATE_WINDOW + SUM_XX, places.y);
    add(STATE_WINDOW + SUM_Y, places.z);
    add(STATE_WINDOW + SUM_YY, places.w);
    add(STATE_WINDOW + SUM_AX, squares.x);
    add(STATE_WINDOW + SUM_AY, squares.y);
    add(STATE_WINDOW + SUM_SPEED, squares.z);
    add(STATE_WINDOW + SUM_TANGENTIAL, forces.x);
    add(STATE_WINDOW + SUM_NORMAL, forces.y);
    let peaks = highest(tops);
    store(STATE_PEAKS, instance, max(load(STATE_PEAKS, instance), peaks.x));
    store(STATE_PEAKS + 1u, instance, max(load(STATE_PEAKS + 1u, instance), peaks.y));
    store(STATE_PEAKS + 2u, instance, max(load(STATE_PEAKS + 2u, instance), peaks.z));
    if flag(FLAG_BEGUN, instance) == 1u {
        for (var j = 0u; j < 12u; j++) {
            let powers = select(select(third, second, j < 8u), first, j < 4u);
            let k = j % 4u;
            add(STATE_SPECTRUM + j, select(select(powers.w, powers.z, k == 2u), select(powers.y, powers.x, k == 0u), k < 2u));
        }
    }
    store(STATE_CARRIER, instance, carrier.x);
    store(STATE_CARRIER + 1u, instance, carrier.y);
    return m;
}

// What a part of the run sees of a step up to `end`; `before` is its velocity at the start, and the body is at its end.
fn observe(end: real, h: real, before: real) {
    let tau = end * h;
    if PART == PART_WINDOW {
        let m = observe_window(end, h);
        if flag(FLAG_GROWING, instance) == 1u {
            observe_growth(tau, m);
        }
    } else {
        guess_crossings(before, vx, tau);
        if PART == PART_GROWTH {
            observe_growth(tau, motion(end, 1.0 / h));
        }
    }
    time += tau;
}
