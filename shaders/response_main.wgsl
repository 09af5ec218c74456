// Twin: src/engine/kernel/record.rs
// A lane between dispatches, and the entry point: settings.iterations steps of every running lane.

fn load_lane() {
    for (var i = 0u; i < 3u; i++) {
        lane.body.p[i] = load(STATE_BODY + i, instance);
        lane.body.v[i] = load(STATE_BODY + 3u + i, instance);
        sums.peaks[i] = load(STATE_PEAKS + i, instance);
    }
    lane.rest = load(STATE_REST, instance);
    for (var i = 0u; i < SUM_WORDS; i++) {
        block[i] = load(STATE_BLOCK + i, instance);
    }
    for (var i = 0u; i < GROWTH_WORDS; i++) {
        growth[i] = load(STATE_GROWTH + i, instance);
    }
    sums.previous = load(STATE_PREVIOUS, instance);
    sums.first = Moment(
        flag(FLAG_FIRST, instance), flag(FLAG_FIRST + 1u, instance), load(STATE_FIRST, instance),
    );
    sums.last = Moment(
        flag(FLAG_LAST, instance), flag(FLAG_LAST + 1u, instance), load(STATE_LAST, instance),
    );
    phase.omega = load(STATE_PHASE + PHASE_OMEGA, instance);
    phase.carrier = vec2<real>(load(STATE_PHASE + PHASE_CARRIER, instance), load(STATE_PHASE + PHASE_CARRIER + 1u, instance));
    phase.x = vec2<real>(load(STATE_PHASE + PHASE_X, instance), load(STATE_PHASE + PHASE_X + 1u, instance));
    phase.y = vec2<real>(load(STATE_PHASE + PHASE_Y, instance), load(STATE_PHASE + PHASE_Y + 1u, instance));
    lane.status = STATUS_UNWRITTEN;
    lane.iterations = flag(FLAG_STEPS, instance);
    lane.segment = flag(FLAG_SEGMENT, instance);
    lane.index = flag(FLAG_INDEX, instance);
    lane.contact = flag(FLAG_CONTACT, instance);
    lane.piece = flag(FLAG_PIECE, instance);
    lane.disarmed = flag(FLAG_DISARMED, instance);
    lane.at_once = flag(FLAG_AT_ONCE, instance);
    lane.counted = flag(FLAG_COUNTED, instance);
    lane.parts = flag(FLAG_PARTS, instance);
    lane.second_pass = flag(FLAG_SECOND_PASS, instance);
    sums.half = flag(FLAG_HALF, instance);
    sums.has_previous = flag(FLAG_HAS_PREVIOUS, instance);
    sums.impacts = flag(FLAG_IMPACTS, instance);
    sums.crossings = flag(FLAG_CROSSINGS, instance);
    sums.growth_closed = flag(FLAG_GROWTH_CLOSED, instance);
}

fn store_lane() {
    for (var i = 0u; i < 3u; i++) {
        store(STATE_BODY + i, instance, lane.body.p[i]);
        store(STATE_BODY + 3u + i, instance, lane.body.v[i]);
        store(STATE_PEAKS + i, instance, sums.peaks[i]);
    }
    store(STATE_REST, instance, lane.rest);
    for (var i = 0u; i < SUM_WORDS; i++) {
        store(STATE_BLOCK + i, instance, block[i]);
    }
    for (var i = 0u; i < GROWTH_WORDS; i++) {
        store(STATE_GROWTH + i, instance, growth[i]);
    }
    store(STATE_PREVIOUS, instance, sums.previous);
    set_flag(FLAG_FIRST, instance, sums.first.segment);
    set_flag(FLAG_FIRST + 1u, instance, sums.first.index);
    store(STATE_FIRST, instance, sums.first.fraction);
    set_flag(FLAG_LAST, instance, sums.last.segment);
    set_flag(FLAG_LAST + 1u, instance, sums.last.index);
    store(STATE_LAST, instance, sums.last.fraction);
    store(STATE_PHASE + PHASE_OMEGA, instance, phase.omega);
    store(STATE_PHASE + PHASE_CARRIER, instance, phase.carrier.x);
    store(STATE_PHASE + PHASE_CARRIER + 1u, instance, phase.carrier.y);
    store(STATE_PHASE + PHASE_X, instance, phase.x.x);
    store(STATE_PHASE + PHASE_X + 1u, instance, phase.x.y);
    store(STATE_PHASE + PHASE_Y, instance, phase.y.x);
    store(STATE_PHASE + PHASE_Y + 1u, instance, phase.y.y);
    set_flag(FLAG_STEPS, instance, lane.iterations);
    set_flag(FLAG_SEGMENT, instance, lane.segment);
    set_flag(FLAG_INDEX, instance, lane.index);
    set_flag(FLAG_CONTACT, instance, lane.contact);
    set_flag(FLAG_PIECE, instance, lane.piece);
    set_flag(FLAG_DISARMED, instance, lane.disarmed);
    set_flag(FLAG_AT_ONCE, instance, lane.at_once);
    set_flag(FLAG_COUNTED, instance, lane.counted);
    set_flag(FLAG_PARTS, instance, lane.parts);
    set_flag(FLAG_SECOND_PASS, instance, lane.second_pass);
    set_flag(FLAG_HALF, instance, sums.half);
    set_flag(FLAG_HAS_PREVIOUS, instance, sums.has_previous);
    set_flag(FLAG_IMPACTS, instance, sums.impacts);
    set_flag(FLAG_CROSSINGS, instance, sums.crossings);
    set_flag(FLAG_GROWTH_CLOSED, instance, sums.growth_closed);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    instance = instance_of(workgroup, workgroups, local);
    if instance >= settings.count || flag(FLAG_STATUS, instance) != STATUS_UNWRITTEN {
        return;
    }
    read_scene();
    if flag(FLAG_STARTED, instance) == 0u {
        set_flag(FLAG_STARTED, instance, 1u);
        start_lane();
    } else {
        load_lane();
    }
    let tolerance = real(bitcast<f32>(setting(SETTING_TOLERANCE)));
    for (var i = 0u; i < settings.iterations; i++) {
        if lane.status == STATUS_UNWRITTEN {
            iterate(tolerance);
        }
    }
    store_lane();
    if lane.status != STATUS_UNWRITTEN {
        finish(instance, lane.status);
    }
}
