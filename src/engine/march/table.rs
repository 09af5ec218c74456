//! The words of the march by name: what stands where in its buffers.

/// What one instance hands to the kernel before the pieces of its law: the constants of [`crate::engine::lanes::constants`], in
/// their order, and its stretch.
pub mod head {
    crate::engine::fields::fields! {
        R 6, "The tangential spring force, by positions and velocities.";
        W 6, "The normal spring force.";
        H 6, "The acceleration of `m1`.";
        FLIGHT_X 6, "The tangential acceleration of `m2` in free flight.";
        FLIGHT_Y 6, "The normal acceleration of `m2` in free flight.";
        FALL 2, "Both in free flight at the equilibrium.";
        KAPPA 1, "`κ = m1 s c`.";
        N0 1, "Normal force of the equilibrium.";
        T0 1, "Tangential force of the equilibrium.";
        MU0 1, "μ of the equilibrium.";
        V0 1, "Belt velocity of the equilibrium.";
        MU_STICK 1, "Limit of stick.";
        CONE 2, "Margins of the stick cone at the equilibrium, forwards and backwards.";
        STIFFNESS 1, "`k1 + k2`.";
        INV_DET 1, "`1/det` of the mass matrix of `(x2, y2)`.";
        LONGEST 4, "The longest step of slip, of reversed slip, of free flight, of stick.";
        NORMAL_MASS 1, "`m2 + m1 s²`.";
        RESTITUTION 1, "Newton restitution.";
        IMPACT_FRICTION 1, "1 with a Coulomb impulse, else 0.";
        STEP 1, "The longest step of the stretch.";
        DRIVE 1, "Belt acceleration.";
        LAYER 2, "How far a step of a curved law may go.";
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

/// What is carried of a lane between dispatches, and what it has seen in its stretch.
pub mod state {
    use crate::engine::lanes::job::Part;
    use crate::engine::lanes::spectrum::COMPONENTS;
    use crate::engine::sums::{growth, peak, sum};

    crate::engine::fields::fields! {
        BODY 6, "Positions `x2 y2 y1` and velocities.";
        BELT 1, "Belt velocity.";
        LEFT 1, "Time left in the stretch.";
        PACE 1, "The longest step that the last one lets expect.";
        TIME 1, "Time since the stretch began.";
        PREVIOUS 1, "`ẋ2` at the end of the step before.";
        FIRST 1, "Time of the first crossing.";
        LAST 1, "Time of the last crossing.";
        GROWTH growth::WORDS, "Sums before the first event.";
        ORIGIN 2, "`x2` and `y1` at the start of the window.";
        WINDOW sum::WORDS, "Sums of the window.";
        PEAKS peak::WORDS, "Largest values.";
        OMEGA 1, "The guess of the frequency.";
        CARRIER 2, "`exp(−iω′(t − t_m))`.";
        SCALE 1, "`1/T`.";
        CLOSING 1, "The time from which crossings are noted.";
        SPECTRUM COMPONENTS, "Fourier sums up to now.";
        NOTED COMPONENTS, "Fourier sums up to the last crossing that was noted.";
    }

    /// How many of the words, from the first on, a part of a run reads or writes.
    #[must_use]
    pub const fn words_of(part: Part) -> usize {
        match part {
            Part::Settle => GROWTH,
            Part::Growth => ORIGIN,
            _ => WORDS,
        }
    }
}

/// Counters and switches of a lane.
pub mod flag {
    crate::engine::fields::fields! {
        STATUS 1, "Status.";
        STEPS 1, "Steps done of the stretch.";
        CONTACT 1, "Contact state.";
        PIECE 1, "Piece of the law.";
        DISARMED 1, "The event function that begins at zero.";
        AT_ONCE 1, "Events at this instant.";
        COUNTED 1, "Events of the stretch.";
        MOST_STEPS 1, "The most steps of the stretch.";
        MOST_EVENTS 1, "The most events of the stretch.";
        CROSSINGS 1, "Upward crossings of `ẋ2`.";
        IMPACTS 1, "Impacts.";
        EVENTFUL 1, "1 once there was an event.";
        GROWING 1, "1 until the first event of the run.";
        BEGUN 1, "1 from the first crossing of the window on.";
        FRESH 1, "1 when the last crossing has been noted.";
    }
}
