// Twin: src/engine/kernel/observe.rs
// Running reductions of one lane. Sums since the last flush are private; totals live in the state buffer.

struct Moment {
    segment: u32,
    index: u32,
    fraction: real,
}

struct Sums {
    half: u32,
    peaks: array<real, PEAK_WORDS>,
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
var<private> block: array<real, SUM_WORDS>;
var<private> growth: array<real, GROWTH_WORDS>;
var<private> phase: Phase;

fn sample_time(i: u32) -> real {
    var times = array<real, STEP_SAMPLES>(real(0.0), NODE_0, NODE_1, NODE_2, real(1.0));
    return times[i];
}

fn node_weight(i: u32) -> real {
    var weights = array<real, NODES>(WEIGHT_0, WEIGHT_1, WEIGHT_2);
    return weights[i];
}

fn flush() {
    for (var i = 0u; i < SUM_WORDS; i++) {
        let word = STATE_TOTAL + sums.half * SUM_WORDS + i;
        store(word, instance, load(word, instance) + block[i]);
        block[i] = real(0.0);
    }
}

fn observe_window(origin: vec2<real>, t0: real, contact: u32, part: u32, at: Moment, step: real, tau: real) {
    sums.half = select(1u, 0u, part == FIRST_HALF);
    block[SUM_TIME] += tau;
    if contact == STICK {
        block[SUM_STICK] += tau;
    } else if contact == FREE {
        block[SUM_FREE] += tau;
    } else if contact == REVERSE {
        block[SUM_REVERSE] += tau;
    }
    let closed = select(t0, real(0.0), contact == FREE);
    var ax: array<real, STEP_SAMPLES>;
    var ay: array<real, STEP_SAMPLES>;
    var normal: array<real, STEP_SAMPLES>;
    var velocity: array<real, STEP_SAMPLES>;
    var acceleration: array<real, STEP_SAMPLES>;
    for (var i = 0u; i < STEP_SAMPLES; i++) {
        let t = sample_time(i) * tau;
        let x = evaluate(&sx, t);
        let w = evaluate(&sw, t);
        velocity[i] = x.v;
        acceleration[i] = x.a;
        ax[i] = abs(x.a);
        ay[i] = abs(w.a);
        normal[i] = value(&sn, t);
        if i > 0u && i + 1u < STEP_SAMPLES {
            let weight = node_weight(i - 1u) * tau;
            let dx = x.p - origin.x;
            let dw = w.p - origin.y;
            block[SUM_X] += weight * dx;
            block[SUM_XX] += weight * (dx * dx);
            block[SUM_Y] += weight * dw;
            block[SUM_YY] += weight * (dw * dw);
            block[SUM_AX] += weight * (x.a * x.a);
            block[SUM_AY] += weight * (w.a * w.a);
            block[SUM_SPEED] += weight * (x.v * x.v + w.v * w.v);
            block[SUM_TANGENTIAL] += weight * (value(&st, t) + closed);
            block[SUM_NORMAL] += weight * normal[i];
        }
    }
    sums.peaks[PEAK_AX] = max(sums.peaks[PEAK_AX], maximum(ax));
    sums.peaks[PEAK_AY] = max(sums.peaks[PEAK_AY], maximum(ay));
    sums.peaks[PEAK_NORMAL] = max(sums.peaks[PEAK_NORMAL], maximum(normal));
    cross_upwards(velocity, acceleration, at, step, tau);
}

fn cross_upwards(
    velocity_in: array<real, STEP_SAMPLES>,
    acceleration_in: array<real, STEP_SAMPLES>,
    at: Moment,
    step: real,
    tau: real,
) {
    var velocity = velocity_in;
    var acceleration = acceleration_in;
    if sums.has_previous == 1u && sums.previous < real(0.0) && velocity[0] >= real(0.0) {
        note(at);
    }
    for (var i = 0u; i + 1u < STEP_SAMPLES; i++) {
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
    sums.previous = velocity[STEP_SAMPLES - 1u];
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
    var sample = array<real, GROWTH_SAMPLED>(x.p, x.v, x.a, w.a);
    growth[GROWTH_TIME] += tau;
    var word = GROWTH_PRODUCTS;
    for (var i = 0u; i < GROWTH_SAMPLED; i++) {
        growth[GROWTH_SAMPLES + i] += tau * sample[i];
        for (var j = i; j < GROWTH_SAMPLED; j++) {
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

fn maximum(values_in: array<real, STEP_SAMPLES>) -> real {
    var values = values_in;
    var top = 0u;
    for (var i = 1u; i < STEP_SAMPLES; i++) {
        if values[i] > values[top] {
            top = i;
        }
    }
    if top == 0u || top == STEP_SAMPLES - 1u {
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
    for (var i = 0u; i < NODES; i++) {
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
    for (var k = ROTATION_TERMS; k >= 1u; k--) {
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
