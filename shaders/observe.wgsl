// Twin: src/engine/kernel/observe.rs
// Running reductions of one lane. Sums since the last flush are private; totals live in the state buffer.

struct Moment {
    segment: u32,
    index: u32,
    fraction: real,
}

struct Sums {
    half: u32,
    peaks: array<real, 3>,
    previous: real,
    has_previous: u32,
    impacts: u32,
    crossings: u32,
    first: Moment,
    last: Moment,
    growth_closed: u32,
}

struct Phase {
    omega: real,
    carrier: vec2<real>,
    x: vec2<real>,
    y: vec2<real>,
}

var<private> sums: Sums;
var<private> block: array<real, SUMS>;
var<private> growth: array<real, 15>;
var<private> phase: Phase;

fn sample_time(i: u32) -> real {
    var times = array<real, 5>(real(0.0), NODE_0, real(0.5), NODE_2, real(1.0));
    return times[i];
}

fn node_weight(i: u32) -> real {
    return select(real(5.0 / 18.0), real(8.0 / 18.0), i == 1u);
}

fn flush() {
    for (var i = 0u; i < SUMS; i++) {
        let word = STATE_TOTAL + sums.half * SUMS + i;
        store(word, instance, load(word, instance) + block[i]);
        block[i] = real(0.0);
    }
}

fn observe_window(origin: vec2<real>, t0: real, contact: u32, part: u32, at: Moment, step: real, tau: real) {
    sums.half = select(1u, 0u, part == FIRST_HALF);
    block[0] += tau;
    if contact == STICK {
        block[10] += tau;
    } else if contact == FREE {
        block[11] += tau;
    } else if contact == REVERSE {
        block[12] += tau;
    }
    let closed = select(t0, real(0.0), contact == FREE);
    var ax: array<real, 5>;
    var ay: array<real, 5>;
    var normal: array<real, 5>;
    var velocity: array<real, 5>;
    var acceleration: array<real, 5>;
    for (var i = 0u; i < 5u; i++) {
        let t = sample_time(i) * tau;
        let x = evaluate(&sx, t);
        let w = evaluate(&sw, t);
        velocity[i] = x.v;
        acceleration[i] = x.a;
        ax[i] = abs(x.a);
        ay[i] = abs(w.a);
        normal[i] = value(&sn, t);
        if i > 0u && i < 4u {
            let weight = node_weight(i - 1u) * tau;
            let dx = x.p - origin.x;
            let dw = w.p - origin.y;
            block[1] += weight * dx;
            block[2] += weight * (dx * dx);
            block[3] += weight * dw;
            block[4] += weight * (dw * dw);
            block[5] += weight * (x.a * x.a);
            block[6] += weight * (w.a * w.a);
            block[7] += weight * (x.v * x.v + w.v * w.v);
            block[8] += weight * (value(&st, t) + closed);
            block[9] += weight * normal[i];
        }
    }
    sums.peaks[0] = max(sums.peaks[0], maximum(ax));
    sums.peaks[1] = max(sums.peaks[1], maximum(ay));
    sums.peaks[2] = max(sums.peaks[2], maximum(normal));
    cross_upwards(velocity, acceleration, at, step, tau);
}

fn cross_upwards(
    velocity_in: array<real, 5>,
    acceleration_in: array<real, 5>,
    at: Moment,
    step: real,
    tau: real,
) {
    var velocity = velocity_in;
    var acceleration = acceleration_in;
    if sums.has_previous == 1u && sums.previous < real(0.0) && velocity[0] >= real(0.0) {
        note(at);
    }
    for (var i = 0u; i < 4u; i++) {
        var low = sample_time(i) * tau;
        var high = sample_time(i + 1u) * tau;
        let below = velocity[i] < real(0.0);
        if below == (velocity[i + 1u] < real(0.0)) {
            let before = acceleration[i];
            let after = acceleration[i + 1u];
            let rises = before > real(0.0) && after < real(0.0);
            let falls = before < real(0.0) && after > real(0.0);
            if !((below && rises) || (!below && falls)) {
                continue;
            }
            let extremum = turn(low, high, below);
            if (evaluate(&sx, extremum).v < real(0.0)) == below {
                continue;
            }
            if below {
                high = extremum;
            } else {
                low = extremum;
            }
        } else if !below {
            continue;
        }
        for (var j = 0u; j < BISECTIONS; j++) {
            let middle = real(0.5) * (low + high);
            if evaluate(&sx, middle).v < real(0.0) {
                low = middle;
            } else {
                high = middle;
            }
        }
        note(Moment(at.segment, at.index, at.fraction + high / step));
    }
    sums.previous = velocity[4];
    sums.has_previous = 1u;
}

fn note(moment: Moment) {
    if sums.crossings == 0u {
        sums.first = moment;
    }
    sums.last = moment;
    sums.crossings += 1u;
}

fn observe_growth(tau: real) {
    if sums.growth_closed == 1u {
        return;
    }
    let x = evaluate(&sx, tau);
    let w = evaluate(&sw, tau);
    var sample = array<real, 4>(x.p, x.v, x.a, w.a);
    growth[0] += tau;
    var word = 5u;
    for (var i = 0u; i < 4u; i++) {
        growth[1u + i] += tau * sample[i];
        for (var j = i; j < 4u; j++) {
            growth[word] += tau * (sample[i] * sample[j]);
            word += 1u;
        }
    }
}

fn turn(from_in: real, to_in: real, positive: bool) -> real {
    var low = from_in;
    var high = to_in;
    for (var i = 0u; i < BISECTIONS; i++) {
        let middle = real(0.5) * (low + high);
        if (evaluate(&sx, middle).a > real(0.0)) == positive {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

fn maximum(values_in: array<real, 5>) -> real {
    var values = values_in;
    var top = 0u;
    for (var i = 1u; i < 5u; i++) {
        if values[i] > values[top] {
            top = i;
        }
    }
    if top == 0u || top == 4u {
        return values[top];
    }
    let left = (values[top] - values[top - 1u]) / (sample_time(top) - sample_time(top - 1u));
    let right = (values[top + 1u] - values[top]) / (sample_time(top + 1u) - sample_time(top));
    let curvature = (right - left) / (sample_time(top + 1u) - sample_time(top - 1u));
    let tangent = left + curvature * (sample_time(top) - sample_time(top - 1u));
    if curvature < real(0.0) {
        return values[top] - tangent * tangent / (real(4.0) * curvature);
    }
    return values[top];
}

fn prepare_phase() -> bool {
    if sums.crossings < 2u {
        return false;
    }
    let span = since_start(sums.last) - since_start(sums.first);
    if span <= real(0.0) {
        return false;
    }
    phase.omega = TAU * real(sums.crossings - 1u) / span;
    return true;
}

fn observe_phase(at: Moment, step: real, tau: real) {
    let low = clipped(sums.first, at, step, tau);
    let span = clipped(sums.last, at, step, tau) - low;
    if span <= real(0.0) {
        return;
    }
    for (var i = 0u; i < 3u; i++) {
        let along = sample_time(i + 1u) * span;
        let weight = node_weight(i) * span;
        let carrier = rotate(phase.carrier, phase.omega * along);
        let ax = evaluate(&sx, low + along).a * weight;
        let ay = evaluate(&sw, low + along).a * weight;
        phase.x.x += ax * carrier.x;
        phase.x.y += ax * carrier.y;
        phase.y.x += ay * carrier.x;
        phase.y.y += ay * carrier.y;
    }
    phase.carrier = rotate(phase.carrier, phase.omega * span);
}

fn clipped(moment: Moment, at: Moment, step: real, tau: real) -> real {
    if moment.segment < at.segment || (moment.segment == at.segment && moment.index < at.index) {
        return real(0.0);
    }
    if moment.segment > at.segment || moment.index > at.index {
        return tau;
    }
    return min(max((moment.fraction - at.fraction) * step, real(0.0)), tau);
}

fn since_start(moment: Moment) -> real {
    var time = real(0.0);
    for (var i = 0u; i < SEGMENTS; i++) {
        let segment = segment_of(i);
        if i < moment.segment {
            time += segment.steps * segment.step;
        } else if i == moment.segment {
            time += (real(moment.index) + moment.fraction) * segment.step;
        }
    }
    return time;
}

fn rotate(z: vec2<real>, angle: real) -> vec2<real> {
    let square = angle * angle;
    var cosine = real(1.0);
    var sine = real(1.0);
    for (var k = 7u; k >= 1u; k--) {
        let n = real(2u * k);
        cosine = real(1.0) - square * cosine / (n * (n - real(1.0)));
        sine = real(1.0) - square * sine / (n * (n + real(1.0)));
    }
    sine = sine * angle;
    let re = z.x * cosine + z.y * sine;
    let im = z.y * cosine - z.x * sine;
    let length = real(1.5) - real(0.5) * (re * re + im * im);
    return vec2<real>(re * length, im * length);
}
