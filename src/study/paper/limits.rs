//! Every threshold by which a claim counts as reproduced, and the figures the paper prints.

use crate::engine::regime::THRESHOLDS;
use crate::study::paper::Trial;

/// The numbers that the paper prints, and how near to them a result has to come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The paper's critical friction coefficient of the constant law …
    pub critical_friction: f64,
    /// … and what it may differ by: one unit of its last digit.
    pub critical_friction_within: f64,
    /// The paper's frequency at which the modes merge, Hz …
    pub coalescence_frequency: f64,
    /// … and what it may differ by, Hz: half a unit of its last digit.
    pub coalescence_frequency_within: f64,
    /// The critical velocity may differ from the knee of the law by this much, m/s.
    pub critical_velocity_within: f64,
    /// A vibration has grown when its largest acceleration is this multiple of what disturbs it: the
    /// acceleration of the first kick, or of the belt.
    pub growth: f64,
    /// A vibration that does not grow stays below this multiple of what it was.
    pub steady: f64,
    /// A limit cycle has shrunk when it falls below this part of its largest acceleration.
    pub shrunk: f64,
    /// A course is a straight line from this coefficient of determination on.
    pub straight: f64,
    /// A zone in which an amplitude is almost stable, within [`Limits::steady`], takes this share of the ramp.
    pub zone: f64,
    /// Free flight counts from this share of the time on: that of the regimes.
    pub detached: f64,
    /// A vibration beats when the largest accelerations of its cycles swell and fade by this part of their mean.
    pub beat: f64,
    /// Amplitudes are similar when neither is more than this multiple of the other.
    pub similar: f64,
    /// In phase: at most this far from 0°.
    pub in_phase: f64,
    /// In quadrature: at most this far from 90°, lagging or leading.
    pub quadrature: f64,
    /// A threshold separates two mechanisms when it is right on this share of the instances of each.
    pub separates: f64,
}

/// The limits in use.
pub const LIMITS: Limits = Limits {
    critical_friction: 0.22,
    critical_friction_within: 0.01,
    coalescence_frequency: 34.0,
    coalescence_frequency_within: 0.5,
    critical_velocity_within: 0.05,
    growth: 10.0,
    steady: 1.05,
    shrunk: 0.5,
    straight: 0.99,
    zone: 0.25,
    detached: THRESHOLDS.state_counts,
    beat: 0.1,
    similar: 1.25,
    in_phase: 22.5,
    quadrature: 22.5,
    separates: 0.95,
};

impl Limits {
    /// Whether the vibration of every case has grown in a trial.
    #[must_use]
    pub fn grown(&self, trial: &Trial) -> bool {
        let grown = |peaks: [f64; 2]| peaks[0] >= self.growth * trial.disturbance;
        trial.complete().is_some_and(|peaks| peaks.into_iter().all(grown))
    }
}
