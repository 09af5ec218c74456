//! The words of the response kernel by name: what stands where in its buffers.

/// What one instance hands to a kernel, before its segments and the pieces of its law.
pub mod head {
    crate::engine::fields::fields! {
        SIN 1, "`sin θ`.";
        COS 1, "`cos θ`.";
        INV_M1 1, "`1/m1`.";
        K1 1, "Tangential stiffness.";
        K2 1, "Normal stiffness.";
        C1 1, "Tangential damping.";
        C2 1, "Normal damping.";
        KAPPA 1, "`κ = m1 s c`.";
        INV_DET 1, "`1/det` of the mass matrix of `(x2, y2)`.";
        NORMAL_MASS 1, "`m2 + m1 s²`.";
        N0 1, "Normal force of the equilibrium.";
        T0 1, "Tangential force of the equilibrium.";
        MU0 1, "μ of the equilibrium.";
        V0 1, "Belt velocity of the equilibrium.";
        MU_STICK 1, "Limit of stick.";
        CONE 2, "Margins of the stick cone at the equilibrium, forwards and backwards.";
        RESTITUTION 1, "Newton restitution.";
        IMPACT_FRICTION 1, "1 with a Coulomb impulse, else 0.";
        START 4, "Start: `x2`, `y1`, `ẋ2`, `ẏ1`.";
        SLOWEST_REBOUND 1, "Smallest rebound.";
        LONGEST 4, "The longest step of each contact state.";
        LAYER 2, "How far a step of a curved law may go.";
    }
}

/// A stretch of constant belt acceleration and step.
pub mod segment {
    crate::engine::fields::fields! {
        STEPS 1, "Steps; 0 for an unused segment.";
        STEP 1, "Length of a step.";
        VELOCITY 1, "Belt velocity at its start.";
        ACCELERATION 1, "Belt acceleration.";
        PART 1, "The part of the run.";
    }
}

/// A piece of the friction law.
pub mod piece {
    crate::engine::fields::fields! {
        AT_ZERO 1, "μ continued to `|v| = 0`.";
        SLOPE 1, "`dμ/d|v|`.";
        RATE 1, "Decay rate, or the longest step on a straight piece.";
        OFFSET 1, "μ at the initial belt velocity less μ of the equilibrium.";
        KINK 1, "Upper end in `|v|`.";
    }
}

/// What is carried of a lane between dispatches.
pub mod state {
    use crate::engine::sums::{growth, peak, phase, sum};

    crate::engine::fields::fields! {
        BODY 6, "Positions and velocities.";
        REST 1, "What is left of a step.";
        BLOCK sum::WORDS, "Sums since the last flush.";
        TOTAL 2 * sum::WORDS, "Sums of both halves of the window.";
        PEAKS peak::WORDS, "Largest values in the window.";
        PREVIOUS 1, "`ẋ2` at the end of the step before.";
        FIRST 1, "Fraction of a step of the first crossing.";
        LAST 1, "Fraction of a step of the last crossing.";
        GROWTH growth::WORDS, "Sums before the first event.";
        PHASE phase::WORDS, "Fourier components.";
        SNAPSHOT 6, "Positions and velocities at the start of the window.";
    }
}

/// Counters and switches of a lane.
pub mod flag {
    crate::engine::fields::fields! {
        STATUS 1, "Status.";
        STEPS 1, "Steps done.";
        STARTED 1, "1 once the lane has its start.";
        SEGMENT 1, "Segment.";
        INDEX 1, "Whole steps in it.";
        CONTACT 1, "Contact state.";
        PIECE 1, "Piece of the law.";
        DISARMED 1, "The event that is not looked for.";
        AT_ONCE 1, "Events at this instant.";
        COUNTED 1, "Events of this period.";
        PARTS 1, "Parts of the present step.";
        SECOND_PASS 1, "Whether the window is passed a second time.";
        HALF 1, "The half that the block belongs to.";
        HAS_PREVIOUS 1, "Whether there is a step before.";
        IMPACTS 1, "Impacts in the window.";
        CROSSINGS 1, "Upward crossings of `ẋ2`.";
        GROWTH_CLOSED 1, "Whether the first event has come.";
        FIRST 2, "Segment and step of the first crossing.";
        LAST 2, "Segment and step of the last crossing.";
        SNAPSHOT 3, "Contact state, piece and event not looked for at the start of the window.";
    }
}
