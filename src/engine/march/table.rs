//! The words of the march by name: what stands where in its buffers.

use crate::engine::fields::{Field, first_word};

/// Sections of a leg: the time before the window, and its two halves.
pub const SECTIONS: usize = 3;

/// The word of the settings that is 1 where legs have not begun.
pub const SETTING_FRESH: usize = first_word(&SETTINGS, "fresh");

/// The kernel's own settings.
pub const SETTINGS: [Field; 2] = [Field::one("tolerance"), Field::one("fresh")];

/// What one instance hands to the kernel before the pieces of its law: the constants of [`crate::engine::lanes::constants`], in
/// their order, and its leg.
pub mod head {
    use crate::engine::march::table::{SECTIONS, flag, state};

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
        STEP SECTIONS, "The longest step of each section.";
        BEYOND 1, "Time from the end of the leg to that of the window.";
        DRIVE 1, "Belt acceleration.";
        LAYER 2, "How far a step of a curved law may go.";
        START state::SENT, "The first words of the state before the leg.";
        COUNTS flag::SENT, "The first words of the flags before it, as numbers.";
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

/// What is carried of a lane between dispatches, and what it has seen in its leg.
pub mod state {
    use crate::engine::lanes::spectrum::COMPONENTS;
    use crate::engine::march::table::history;
    use crate::engine::sums::{growth, peak, sum};

    crate::engine::fields::fields! {
        BODY 6, "Positions `x2 y2 y1` and velocities.";
        BELT 1, "Belt velocity.";
        PREVIOUS 1, "`ẋ2` at the end of the step before.";
        OMEGA 1, "The guess of the frequency.";
        START 6, "Positions and velocities at the start of the window.";
        LEFT 1, "Time left in the stretch.";
        PACE 1, "The longest step that the last one lets expect.";
        TIME 1, "Time since the stretch began.";
        BASE 1, "Time from the start of the leg's window to that of the stretch.";
        FROM 1, "Time of the first crossing since the leg's window began.";
        TO 1, "Time of the last crossing since then.";
        CARRIER 2, "`exp(−iω′t)`, from the start of the stretch.";
        SCALE 1, "`1/T`.";
        CLOSING 1, "The time from which crossings are noted.";
        GROWTH growth::WORDS, "Sums of the stretch before the first event.";
        WINDOW sum::WORDS, "Sums of the stretch in the window.";
        SPECTRUM COMPONENTS, "Fourier sums of the stretch up to now.";
        FIRST 1, "Time of the first crossing since its stretch began.";
        LAST 1, "Time of the last crossing since its stretch began.";
        GROWN growth::WORDS, "Sums of the leg before the first event.";
        SEEN 2 * sum::WORDS, "Sums of both halves of the window.";
        PEAKS peak::WORDS, "Largest values.";
        NOTED COMPONENTS, "Fourier sums of its stretch up to the last crossing that was noted.";
        HISTORY history::MOST * history::WORDS, "The stretches of the window that are over.";
    }

    /// How many of the words, from the first on, stand in the inputs of a leg; before it has begun the others are 0.
    pub const SENT: usize = LEFT;

    /// How many of the words, from the first on, a leg reads or writes that has so many stretches in the window.
    #[must_use]
    pub const fn words_of(stretches: usize) -> usize {
        HISTORY + stretches * history::WORDS
    }
}

/// A stretch of the window that is over.
pub mod history {
    use crate::engine::lanes::spectrum::COMPONENTS;

    crate::engine::fields::fields! {
        OMEGA 1, "The guess of the frequency.";
        TIME 1, "Its length.";
        SPECTRUM COMPONENTS, "Its Fourier sums.";
    }

    /// Most stretches of the window in a leg.
    pub const MOST: usize = 8;
}

/// Counters and switches of a lane.
pub mod flag {
    use crate::engine::march::table::SECTIONS;

    crate::engine::fields::fields! {
        STATUS 1, "Status.";
        STEPS 1, "Steps done of the leg.";
        PART 1, "The part of the run that it is in.";
        SECTION 1, "The section that it is in.";
        WHOLE SECTIONS, "Steps that each section is still to begin, of its longest.";
        CONTACT 1, "Contact state.";
        PIECE 1, "Piece of the law.";
        DISARMED 1, "The event function that begins at zero.";
        AT_ONCE 1, "Events at this instant.";
        LEFT_STEPS 1, "The most steps of the leg.";
        GROWING 1, "1 until the first event of the run.";
        OPENED 1, "1 once the window has begun.";
        BEGUN 1, "1 from the first crossing of the window on.";
        BEFORE 1, "Stretches of the window before those of the leg.";
        AT_START 1, "Contact state, piece and event function at the start of the window.";
        MOST_STEPS 1, "The most steps up to the end of the stretch.";
        MOST_EVENTS 1, "The most events of the stretch.";
        COUNTED 1, "Events of the stretch.";
        GROWN 1, "Steps at the end of growth.";
        SETTLED 1, "Steps at the start of the window.";
        CROSSINGS 1, "Upward crossings of `ẋ2`: of the stretch, in the window of the leg.";
        IMPACTS 1, "Impacts.";
        EVENTFUL 1, "1 once there was an event in the window.";
        STRETCH 1, "Stretches of the window that are over.";
        FIRST_IN 1, "The stretch with the first crossing.";
        LAST_IN 1, "The stretch with the last crossing.";
        FRESH 1, "1 when the last crossing has been noted.";
    }

    /// How many of the words, from the first on, stand in the inputs of a leg, too; before it has begun the others are 0.
    pub const SENT: usize = MOST_STEPS;
}
