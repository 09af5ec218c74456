// The entry point of the march: settings.iterations steps of every lane that is in this part of its run.

// State and flags before a leg: their first words stand in its inputs, the others are 0.
fn begin_lane() {
    // Numbers that a compiler does not know: the loops stay loops.
    let sent = STATE_SENT + settings.zero;
    for (var i = 0u; i < settings.state_words; i++) {
        store(i, instance, 0.0);
    }
    for (var i = 0u; i < sent; i++) {
        store(i, instance, input(INPUT_START + i, instance));
    }
    for (var i = 0u; i < FLAG_WORDS + settings.zero; i++) {
        set_flag(i, instance, 0u);
    }
    for (var i = 0u; i < FLAG_SENT + settings.zero; i++) {
        set_flag(i, instance, u32(input(INPUT_COUNTS + i, instance)));
    }
}

fn load_lane() {
    px = load(STATE_BODY, instance);
    py = load(STATE_BODY + 1u, instance);
    pw = load(STATE_BODY + 2u, instance);
    vx = load(STATE_BODY + 3u, instance);
    vy = load(STATE_BODY + 4u, instance);
    vw = load(STATE_BODY + 5u, instance);
    belt = load(STATE_BELT, instance);
    time = load(STATE_TIME, instance);
    previous = load(STATE_PREVIOUS, instance);
    drive = 0.0;
    if RAMP {
        drive = input(INPUT_DRIVE, instance);
    }
    left = load(STATE_LEFT, instance);
    pace = load(STATE_PACE, instance);
    steps = flag(FLAG_STEPS, instance);
    section = 0u;
    if PART == PART_WINDOW {
        section = flag(FLAG_SECTION, instance);
    }
    contact = flag(FLAG_CONTACT, instance);
    at = flag(FLAG_PIECE, instance);
    disarmed = flag(FLAG_DISARMED, instance);
    at_once = flag(FLAG_AT_ONCE, instance);
    status = STATUS_UNWRITTEN;
}

fn store_lane() {
    store_body(STATE_BODY);
    store(STATE_BELT, instance, belt);
    store(STATE_TIME, instance, time);
    store(STATE_PREVIOUS, instance, previous);
    store(STATE_LEFT, instance, left);
    store(STATE_PACE, instance, pace);
    set_flag(FLAG_STEPS, instance, steps);
    set_flag(FLAG_SECTION, instance, section);
    set_flag(FLAG_CONTACT, instance, contact);
    set_flag(FLAG_PIECE, instance, at);
    set_flag(FLAG_DISARMED, instance, disarmed);
    set_flag(FLAG_AT_ONCE, instance, at_once);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    instance = instance_of(workgroup, workgroups, local);
    if instance >= settings.count {
        return;
    }
    if PART == PART_GROWTH && setting(SETTING_FRESH) == 1u {
        begin_lane();
    }
    if flag(FLAG_STATUS, instance) != STATUS_UNWRITTEN || flag(FLAG_PART, instance) != PART {
        return;
    }
    load_lane();
    var grows = PART == PART_GROWTH && flag(FLAG_GROWING, instance) == 1u;
    let tolerance = real(bitcast<f32>(setting(SETTING_TOLERANCE)));
    for (var i = 0u; i < settings.iterations; i++) {
        if left <= 0.0 || (PART == PART_GROWTH && !grows) {
            turn_over();
        }
        if status != STATUS_UNWRITTEN || left <= 0.0 || (PART == PART_GROWTH && !grows) {
            break;
        }
        let slips = contact <= REVERSE;
        let longest = input(INPUT_LONGEST + select(contact, 5u - contact, contact >= STICK), instance);
        pace = min(min(pace, input(INPUT_STEP + section, instance)), longest);
        var q = Friction(0.0, 0.0, 0.0);
        var inertia = real(1.0);
        let sigma = select(real(-1.0), real(1.0), contact == SLIP);
        if contact == STICK {
            vx = belt;
        }
        let relative = belt - vx;
        if slips {
            piece = piece_of(at);
            q = friction(piece, sigma, relative, vx - (belt - input(INPUT_V0, instance)));
            inertia = 1.0 + input(INPUT_KAPPA, instance) * q.q;
            if LAW == LAW_PIECES {
                pace = min(pace, piece.rate);
            }
        }
        let last = left <= pace * 1.001;
        let asked = select(pace, left, last);
        var h = asked;
        if LAW != LAW_PIECES && slips {
            h = min(h, longest_in_layer(q, inertia, sigma, relative));
        }
        x0 = px;
        w0 = pw;
        x1 = vx * h;
        w1 = vw * h;
        if slips {
            let speed = sigma * relative;
            ahead = h * (speed - select(0.0, upper_kink(max(at, 1u) - 1u), at > 0u));
            back = h * (upper_kink(at) - speed);
            if LAW == LAW_PIECES {
                expand_slip(h, q, inertia);
            } else {
                expand_curved(h, q, inertia, sigma, relative);
            }
        } else if contact == STICK {
            expand_stick(h);
        } else {
            expand_flight(h);
        }
        let reached = reach(tolerance);
        let holds = reached.end >= SHORTEST && longest * longest >= EPSILON;
        if !holds || !(inertia > 0.0) || steps > flag(FLAG_MOST_STEPS, instance) {
            status = select(STATUS_STEP_TOO_LARGE, STATUS_PAINLEVE, !(inertia > 0.0));
            status = select(STATUS_NON_FINITE, status, body_is_finite());
            break;
        }
        if reached.end < FAR {
            // Far too long: once more, over less.
            pace = reached.end * h;
            continue;
        }
        steps += 1u;
        let event = first_event(reached.end, h, tolerance);
        let before = vx;
        advance(event.at, 1.0 / h);
        observe(event.at, h, before);
        let tau = event.at * h;
        left = select(left - tau, 0.0, last && event.at >= 1.0 && asked <= h);
        belt = drive * tau + belt;
        if event.at > 0.0 {
            disarmed = 0u;
        }
        let possible = reached.end * h;
        pace = select(select(pace, pace * LONGER, reached.roomy), possible, possible < asked);
        if event.function > 0u {
            if PART == PART_WINDOW {
                set_flag(FLAG_EVENTFUL, instance, 1u);
            }
            grows = false;
            set_flag(FLAG_GROWING, instance, 0u);
            at_once = select(at_once + 1u, 0u, event.at > 0.0);
            let counted = flag(FLAG_COUNTED, instance) + 1u;
            set_flag(FLAG_COUNTED, instance, counted);
            if contact == REVERSE {
                // What comes down to the velocity of the belt has not gone below it, which matters where that is 0.
                previous = max(previous, belt);
            }
            if contact == FREE {
                pace = input(INPUT_STEP + section, instance);
                if PART == PART_WINDOW {
                    set_flag(FLAG_IMPACTS, instance, flag(FLAG_IMPACTS, instance) + 1u);
                }
            }
            carry_out(event.function);
            if at_once > EVENTS_AT_ONCE || counted > flag(FLAG_MOST_EVENTS, instance) {
                status = STATUS_EVENT_LIMIT;
            }
        }
    }
    store_lane();
    if status != STATUS_UNWRITTEN {
        finish(instance, status);
    }
}
