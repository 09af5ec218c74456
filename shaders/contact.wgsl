// Twin: src/engine/kernel/contact.rs
// What an event does to the contact of one instance.

struct Belt {
    velocity: real,
    acceleration: real,
}

fn transition(event: u32, belt: Belt) {
    switch event {
        case LOWER_KINK: {
            lane.piece -= 1u;
            lane.disarmed = UPPER_KINK;
        }
        case UPPER_KINK: {
            lane.piece += 1u;
            lane.disarmed = LOWER_KINK;
        }
        case REST: {
            at_rest(belt);
        }
        case CONE_FORWARD: {
            slip_or_free(real(1.0), real(0.0), true);
        }
        case CONE_BACKWARD: {
            slip_or_free(real(-1.0), real(0.0), true);
        }
        case LIFT_OFF: {
            enter(FREE, false);
        }
        default: {
            impact(belt);
        }
    }
}

fn loads() -> vec2<real> {
    let x = lane.body.p[0];
    let y = lane.body.p[1];
    let w = lane.body.p[2];
    let vx = lane.body.v[0];
    let vy = lane.body.v[1];
    let vw = lane.body.v[2];
    let h = scene.k2 * (x * scene.s + y * scene.c - w) + scene.c2 * (vx * scene.s + vy * scene.c - vw);
    let g = scene.k1 * (x * scene.c - y * scene.s) + scene.c1 * (vx * scene.c - vy * scene.s);
    return vec2<real>(scene.c * g + scene.s * h, scene.c * h - scene.s * g);
}

fn slip_or_free(direction: real, speed: real, rests: bool) {
    let piece = piece_at(speed);
    let v = direction * speed;
    let q = friction(piece_of(piece), direction, v, scene.v0 - v).q;
    if real(1.0) + scene.kappa * q <= real(0.0) {
        lane.status = STATUS_PAINLEVE;
        return;
    }
    let rw = loads();
    // A body that lands again and again without time between is held: the force is zero within rounding, and
    // flight does not open the gap.
    let held = lane.contact == FREE && lane.at_once >= HELD_FROM;
    if held || (rw.y + scene.n0) + scene.kappa * (rw.x + scene.t0) > real(0.0) {
        lane.piece = piece;
        enter(select(REVERSE, SLIP, direction > real(0.0)), rests);
    } else {
        enter(FREE, false);
    }
}

fn enter(contact: u32, rests: bool) {
    lane.contact = contact;
    lane.disarmed = NOTHING;
    if contact == FREE {
        lane.disarmed = GAP;
    } else if contact <= REVERSE && rests {
        lane.disarmed = REST;
    }
}

fn at_rest(belt: Belt) {
    lane.body.v[0] = belt.velocity;
    let rw = loads();
    let tangential = rw.x + belt.acceleration;
    let normal = rw.y - scene.kappa * belt.acceleration;
    let forward = scene.mu_stick * normal - tangential + scene.cone_forward;
    let backward = scene.mu_stick * normal + tangential + scene.cone_backward;
    if forward >= real(0.0) && backward >= real(0.0) {
        enter(STICK, true);
    } else {
        slip_or_free(select(real(-1.0), real(1.0), tangential + scene.t0 >= real(0.0)), real(0.0), true);
    }
}

fn enter_contact(belt: Belt) {
    let v = belt.velocity - lane.body.v[0];
    if v > real(0.0) {
        slip_or_free(real(1.0), v, false);
    } else if v < real(0.0) {
        slip_or_free(real(-1.0), -v, false);
    } else {
        at_rest(belt);
    }
}

fn tangential_jump(q: real, change: real) -> real {
    let inertia = real(1.0) + scene.kappa * q;
    if inertia <= real(0.0) {
        lane.status = STATUS_PAINLEVE;
        return real(0.0);
    }
    return (scene.normal_mass * q + scene.kappa) / inertia * change;
}

fn impact(belt: Belt) {
    let vx = lane.body.v[0];
    let vy = min(lane.body.v[1], real(0.0));
    var rebound = -(scene.restitution * vy);
    if rebound < scene.slowest_rebound {
        rebound = real(0.0);
    }
    let change = rebound - vy;
    let relative = belt.velocity - vx;
    var after = belt.velocity;
    if scene.impact_friction > real(0.0) {
        let limit = mu(abs(relative));
        let q = select(limit, -limit, relative < real(0.0));
        let jump = tangential_jump(q, change);
        let tangential = relative - scene.kappa * change;
        let normal = scene.normal_mass * change - scene.kappa * relative;
        if (relative - jump) * relative > real(0.0) {
            after = vx + jump;
        } else if abs(tangential) > limit * normal {
            after = vx + tangential_jump(-q, change);
        }
    } else {
        after = vx + tangential_jump(real(0.0), change);
    }
    lane.body.p[1] = real(0.0);
    lane.body.v[0] = after;
    lane.body.v[1] = rebound;
    if rebound > real(0.0) {
        enter(FREE, false);
    } else {
        enter_contact(belt);
    }
}
