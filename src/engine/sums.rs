//! The running sums of a run, in the order in which every engine has them.

/// Sums over time of a half of the window; positions count from where the window began.
pub mod sum {
    crate::engine::fields::fields! {
        TIME 1, "Time.";
        X 1, "`∫x2`.";
        XX 1, "`∫x2²`.";
        Y 1, "`∫y1`.";
        YY 1, "`∫y1²`.";
        AX 1, "`∫ẍ2²`.";
        AY 1, "`∫ÿ1²`.";
        SPEED 1, "`∫(ẋ2² + ẏ1²)`.";
        TANGENTIAL 1, "`∫T`.";
        NORMAL 1, "`∫N`.";
        STICK 1, "Time in stick.";
        FREE 1, "Time in free flight.";
        REVERSE 1, "Time in reversed slip.";
    }
}

/// Largest values in the window.
pub mod peak {
    crate::engine::fields::fields! {
        AX 1, "Largest `|ẍ2|`.";
        AY 1, "Largest `|ÿ1|`.";
        NORMAL 1, "Largest `N`.";
    }
}

/// Sums over time before the first event.
pub mod growth {
    /// What is sampled: `x2`, its velocity, its acceleration, that of `y1`.
    pub const SAMPLED: usize = 4;

    crate::engine::fields::fields! {
        TIME 1, "Time.";
        SAMPLES SAMPLED, "The samples.";
        PRODUCTS SAMPLED * (SAMPLED + 1) / 2, "Their products, upper triangle by rows.";
    }
}

/// Fourier components at the frequency of the response.
pub mod phase {
    crate::engine::fields::fields! {
        OMEGA 1, "Angular frequency.";
        CARRIER 2, "`exp(−iωt)`.";
        X 2, "Component of `ẍ2`.";
        Y 2, "Component of `ÿ1`.";
    }
}
