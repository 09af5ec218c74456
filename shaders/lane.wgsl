// Twin: src/engine/kernel/lane.rs
// One instance advanced by iterations, one step or part of a step each.

struct Located {
    tau: real,
    event: u32,
}

struct Lane {
    body: Body,
    rest: real,
    status: u32,
    iterations: u32,
    segment: u32,
    index: u32,
    contact: u32,
    piece: u32,
    disarmed: u32,
    at_once: u32,
    counted: u32,
    parts: u32,
    second_pass: u32,
}

var<private> lane: Lane;
// The present search of the first event.
var<private> located: Located;

fn start_lane() {
    lane.body.p[0] = input(INPUT_START, instance);
    lane.body.p[1] = real(0.0);
    lane.body.p[2] = input(INPUT_START + 1u, instance);
    lane.body.v[0] = input(INPUT_START + 2u, instance);
    lane.body.v[1] = real(0.0);
    lane.body.v[2] = input(INPUT_START + 3u, instance);
    lane.rest = real(1.0);
    lane.status = STATUS_UNWRITTEN;
    phase.carrier = vec2<real>(real(1.0), real(0.0));
    let first = segment_of(0u);
    enter_contact(Belt(first.velocity, first.acceleration));
    take_snapshot();
}

fn iterate(tolerance: real) {
    let segment = segment_of(lane.segment);
    if real(lane.index) >= segment.steps {
        next_segment();
        return;
    }
    lane.iterations += 1u;
    let elapsed = real(lane.index) + (real(1.0) - lane.rest);
    let belt = Belt(
        segment.velocity + segment.acceleration * (elapsed * segment.step),
        segment.acceleration,
    );
    if lane.contact == STICK {
        lane.body.v[0] = belt.velocity;
    }
    let piece = piece_of(lane.piece);
    expand(lane.body, lane.contact, piece, belt.velocity, belt.acceleration);
    var on_law = NO_KINK;
    if lane.contact <= REVERSE {
        let q = friction(piece, sigma(), sv[0], scene.v0 - sv[0]).q;
        if real(1.0) + scene.kappa * q <= real(0.0) {
            lane.status = STATUS_PAINLEVE;
            return;
        }
        on_law = piece.rate;
        if LAW != LAW_PIECES {
            on_law = longest_in_layer(piece, q, sv[0], sv[1]);
        }
    }
    let remaining = lane.rest * segment.step;
    let allowed = input(INPUT_LONGEST + lane.contact, instance);
    var longest = real(0.0);
    // Shorter steps leave a position where it is.
    if allowed * allowed >= EPSILON {
        longest = step_length(min(min(remaining, allowed), on_law), tolerance);
    }
    if longest <= real(0.0) {
        lane.status = select(STATUS_NON_FINITE, STATUS_STEP_TOO_LARGE, body_is_finite());
        return;
    }
    first_event(longest, tolerance);
    let tau = located.tau;
    let event = located.event;
    if tau > real(0.0) {
        observe(segment, belt, tau);
        let x = evaluate(&sx, tau);
        let y = evaluate(&sy, tau);
        let w = evaluate(&sw, tau);
        lane.body.p[0] = x.p;
        lane.body.p[1] = y.p;
        lane.body.p[2] = w.p;
        lane.body.v[0] = x.v;
        lane.body.v[1] = y.v;
        lane.body.v[2] = w.v;
        lane.disarmed = NOTHING;
    }
    if !body_is_finite() {
        lane.status = STATUS_NON_FINITE;
        return;
    }
    advance_time(segment, tau, tau >= remaining * (real(1.0) - LEAST_REST * EPSILON));
    if event != NOTHING {
        count_event(tau);
        carry_out(event, Belt(belt.velocity + belt.acceleration * tau, belt.acceleration));
    }
}

fn body_is_finite() -> bool {
    return is_finite(lane.body.p[0]) && is_finite(lane.body.p[1]) && is_finite(lane.body.p[2])
        && is_finite(lane.body.v[0]) && is_finite(lane.body.v[1]) && is_finite(lane.body.v[2]);
}

fn sigma() -> real {
    return select(real(-1.0), real(1.0), lane.contact == SLIP);
}

fn advance_time(segment: Segment, tau: real, whole: bool) {
    lane.parts += 1u;
    if whole {
        lane.rest = real(1.0);
        lane.index += 1u;
        if lane.index % STEPS_PER_SUM == 0u {
            flush();
        }
        if lane.index % max(u32(TAU / segment.step), 1u) == 0u {
            lane.counted = 0u;
            lane.parts = 0u;
        }
    } else {
        lane.rest = lane.rest - tau / segment.step;
    }
    // The second pass takes no step that the first has not.
    let endless = lane.iterations > MOST_STEPS && lane.second_pass == 0u;
    if lane.parts > MAX_STEPS_PER_PERIOD || endless {
        lane.status = STATUS_STEP_TOO_LARGE;
    }
}

fn count_event(tau: real) {
    lane.at_once = select(lane.at_once + 1u, 0u, tau > real(0.0));
    lane.counted += 1u;
    if lane.at_once > EVENTS_AT_ONCE || lane.counted > MAX_EVENTS_PER_PERIOD {
        lane.status = STATUS_EVENT_LIMIT;
    }
}

fn next_segment() {
    flush();
    let before = part_of(segment_of(lane.segment));
    lane.segment += 1u;
    lane.index = 0u;
    var done = lane.segment >= SEGMENTS;
    if !done {
        done = segment_of(lane.segment).steps <= real(0.0);
    }
    if done {
        if lane.second_pass == 1u || before == OPEN_HALF || !prepare_phase() {
            lane.status = STATUS_OK;
            return;
        }
        lane.second_pass = 1u;
        restore_snapshot();
        lane.segment = 0u;
        while part_of(segment_of(lane.segment)) == SETTLE {
            lane.segment += 1u;
        }
        return;
    }
    let after = part_of(segment_of(lane.segment));
    if before == SETTLE && after == FIRST_HALF && lane.second_pass == 0u {
        take_snapshot();
    }
}

fn take_snapshot() {
    for (var i = 0u; i < 3u; i++) {
        store(STATE_SNAPSHOT + i, instance, lane.body.p[i]);
        store(STATE_SNAPSHOT + 3u + i, instance, lane.body.v[i]);
    }
    set_flag(FLAG_SNAPSHOT, instance, lane.contact);
    set_flag(FLAG_SNAPSHOT + 1u, instance, lane.piece);
    set_flag(FLAG_SNAPSHOT + 2u, instance, lane.disarmed);
}

fn restore_snapshot() {
    for (var i = 0u; i < 3u; i++) {
        lane.body.p[i] = load(STATE_SNAPSHOT + i, instance);
        lane.body.v[i] = load(STATE_SNAPSHOT + 3u + i, instance);
    }
    lane.contact = flag(FLAG_SNAPSHOT, instance);
    lane.piece = flag(FLAG_SNAPSHOT + 1u, instance);
    lane.disarmed = flag(FLAG_SNAPSHOT + 2u, instance);
}

fn observe(segment: Segment, belt: Belt, tau: real) {
    let part = part_of(segment);
    let at = Moment(lane.segment, lane.index, real(1.0) - lane.rest);
    if lane.second_pass == 1u {
        observe_phase(at, segment.step, tau);
        return;
    }
    if part != SETTLE {
        let origin = vec2<real>(load(STATE_SNAPSHOT, instance), load(STATE_SNAPSHOT + 2u, instance));
        observe_window(origin, scene.t0, lane.contact, part, at, segment.step, tau);
        if lane.contact == REVERSE {
            sums.previous = max(sums.previous, belt.velocity + belt.acceleration * tau);
        }
    }
    observe_growth(tau);
}

fn watch(degree: u32, from_zero: bool, event: u32, rounding: real) {
    if located.tau > real(0.0) {
        let of_state = event == GAP || event <= UPPER_KINK;
        let near = select(rounding, real(0.0), of_state);
        let at = first_crossing(degree, located.tau, from_zero, near, rounding);
        if at > NEVER {
            located.tau = at;
            located.event = event;
        }
    }
}

fn first_event(longest: real, tolerance: real) {
    located = Located(longest, NOTHING);
    let size = scene.n0 * (real(1.0) + scene.mu_stick) + abs(sn[0]) + abs(st[0]);
    let motion = largest(0u) + largest(1u) + largest(2u);
    let rounding = tolerance * (scene.k1 + scene.k2) * motion + ROUNDINGS * EPSILON * size;
    if lane.contact == FREE {
        sg = sy;
        watch(ORDER, lane.disarmed == GAP, GAP, rounding * scene.inv_det);
    } else if lane.contact == STICK {
        for (var k = 0u; k <= ORDER - 2u; k++) {
            let normal = select(sn[k], sn[k] - scene.n0, k == 0u);
            sg[k] = scene.mu_stick * normal - st[k];
        }
        sg[0] = sg[0] + scene.cone_forward;
        watch(ORDER - 2u, false, CONE_FORWARD, rounding);
        for (var k = 0u; k <= ORDER - 2u; k++) {
            let normal = select(sn[k], sn[k] - scene.n0, k == 0u);
            sg[k] = scene.mu_stick * normal + st[k];
        }
        sg[0] = sg[0] + scene.cone_backward;
        watch(ORDER - 2u, false, CONE_BACKWARD, rounding);
        sg = sn;
        watch(ORDER - 2u, false, LIFT_OFF, rounding);
    } else {
        sg = sn;
        watch(ORDER - 2u, false, LIFT_OFF, rounding);
        let direction = sigma();
        for (var k = 0u; k < ORDER; k++) {
            sg[k] = direction * sv[k];
        }
        let start = sg[0];
        if lane.piece == 0u {
            watch(ORDER - 1u, lane.disarmed == REST, REST, rounding);
        } else {
            sg[0] = start - piece_of(lane.piece - 1u).kink;
            watch(ORDER - 1u, lane.disarmed == LOWER_KINK, LOWER_KINK, rounding);
        }
        if lane.piece + 1u < PIECES {
            for (var k = 0u; k < ORDER; k++) {
                sg[k] = -(direction * sv[k]);
            }
            sg[0] = piece_of(lane.piece).kink - start;
            watch(ORDER - 1u, lane.disarmed == UPPER_KINK, UPPER_KINK, rounding);
        }
    }
}

fn carry_out(event: u32, belt: Belt) {
    sums.growth_closed = 1u;
    let in_window = part_of(segment_of(lane.segment)) != SETTLE;
    if event == GAP && in_window && lane.second_pass == 0u {
        sums.impacts += 1u;
    }
    transition(event, belt);
}

fn part_of(segment: Segment) -> u32 {
    if segment.part < real(0.5) {
        return SETTLE;
    }
    if segment.part < real(1.5) {
        return FIRST_HALF;
    }
    if segment.part < real(2.5) {
        return SECOND_HALF;
    }
    return OPEN_HALF;
}
