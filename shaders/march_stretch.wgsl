// From stretch to stretch of a leg, and from part to part of a run.
//
// A leg has three sections of whole steps: the time before the window, and its two halves. A stretch is some of these steps:
// sums over it are short and keep their digits, and a guess of the frequency holds for it.

// Adds sums of the stretch to those of the leg, and begins them anew.
fn sum_up(total: u32, sums: u32, words: u32) {
    // A number that a compiler does not know: written out, the loops would make a sixth of the window's code.
    let count = words + settings.zero;
    for (var i = 0u; i < count; i++) {
        add(total + i, load(sums + i, instance));
        store(sums + i, instance, 0.0);
    }
}

// The guess of the frequency from so many crossings within a span.
fn guess_frequency(crossings: u32, span: real) {
    if crossings > 2u && span > 0.0 {
        store(STATE_OMEGA, instance, TAU * real(crossings - 1u) / span);
    }
}

// Begins a stretch of at most so many steps of a section; what is left of that.
fn open_stretch(most: u32) {
    let whole = flag(FLAG_WHOLE + section, instance);
    let some = min(whole, most);
    set_flag(FLAG_WHOLE + section, instance, whole - some);
    pace = input(INPUT_STEP + section, instance);
    left = real(some) * pace;
    time = 0.0;
    let periods = max(left * (1.0 / TAU), 1.0);
    let limit = steps + u32(periods * STEPS_PER_PERIOD);
    set_flag(FLAG_MOST_STEPS, instance, min(limit, flag(FLAG_LEFT_STEPS, instance)));
    set_flag(FLAG_MOST_EVENTS, instance, u32(periods * EVENTS_PER_PERIOD));
    set_flag(FLAG_COUNTED, instance, 0u);
}

// Before the window: closes a stretch and opens the next, or goes on to another part of the run.
fn turn_before() {
    if PART == PART_GROWTH {
        sum_up(STATE_GROWN, STATE_GROWTH, GROWTH_WORDS);
    }
    guess_frequency(flag(FLAG_CROSSINGS, instance), load(STATE_LAST, instance) - load(STATE_FIRST, instance));
    set_flag(FLAG_CROSSINGS, instance, 0u);
    time = 0.0;
    if PART == PART_GROWTH && flag(FLAG_GROWING, instance) == 0u {
        // The rest of the stretch is gone through without those sums.
        set_flag(FLAG_GROWN, instance, steps);
        set_flag(FLAG_PART, instance, PART_SETTLE);
        return;
    }
    let whole = flag(FLAG_WHOLE, instance);
    if whole == 0u {
        if PART == PART_GROWTH {
            set_flag(FLAG_GROWN, instance, steps);
        }
        set_flag(FLAG_SETTLED, instance, steps);
        set_flag(FLAG_PART, instance, PART_WINDOW);
        return;
    }
    // The last stretch guesses the frequency: it is late, and not too short.
    let settles = min(LONG_STRETCH, select(whole, whole - LAST_STRETCH, whole > LAST_STRETCH));
    open_stretch(select(settles, STRETCH, PART == PART_GROWTH));
}

// In the window: closes a stretch and opens the next, or ends the leg.
fn turn_in_window() {
    let number = flag(FLAG_STRETCH, instance);
    if time > 0.0 {
        sum_up(STATE_SEEN + (section - 1u) * SUM_WORDS, STATE_WINDOW, SUM_WORDS);
        sum_up(STATE_GROWN, STATE_GROWTH, GROWTH_WORDS);
        let over = STATE_HISTORY + number * HISTORY_WORDS;
        store(over + HISTORY_OMEGA, instance, load(STATE_OMEGA, instance));
        store(over + HISTORY_TIME, instance, time);
        sum_up(over + HISTORY_SPECTRUM, STATE_SPECTRUM, COMPONENTS);
        set_flag(FLAG_STRETCH, instance, number + 1u);
        let base = load(STATE_BASE, instance);
        guess_frequency(
            flag(FLAG_CROSSINGS, instance),
            load(STATE_TO, instance) - load(STATE_FROM, instance),
        );
        store(STATE_BASE, instance, base + time);
    }
    section = max(section, 1u);
    if flag(FLAG_WHOLE + section, instance) == 0u {
        section = 2u;
    }
    if flag(FLAG_WHOLE + section, instance) == 0u {
        status = select(STATUS_NON_FINITE, STATUS_OK, body_is_finite());
        return;
    }
    if flag(FLAG_OPENED, instance) == 0u {
        set_flag(FLAG_OPENED, instance, 1u);
        set_flag(FLAG_AT_START, instance, (at << 4u) | (disarmed << 2u) | contact);
        previous = 0.0;
        store_body(STATE_START);
    }
    // The guess of the first one is the worst.
    let first = FIRST_STRETCH * (1u + flag(FLAG_BEFORE, instance) + flag(FLAG_STRETCH, instance));
    open_stretch(min(STRETCH, first));
    store(STATE_CARRIER, instance, 1.0);
    store(STATE_CARRIER + 1u, instance, 0.0);
    store(STATE_SCALE, instance, 2.0 / left);
    var end = left + input(INPUT_BEYOND, instance);
    for (var k = 1u; k < 3u; k++) {
        end += real(flag(FLAG_WHOLE + k, instance)) * input(INPUT_STEP + k, instance);
    }
    store(STATE_CLOSING, instance, end - CLOSING * TAU / load(STATE_OMEGA, instance));
}

fn turn_over() {
    if PART == PART_WINDOW {
        turn_in_window();
    } else {
        turn_before();
    }
}
