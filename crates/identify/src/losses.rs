//! What the structure loses along the contact, read from the power of friction in a sustained vibration.
//!
//! Along the contact `m ẍ + c ẋ + k x = δT` but for the inclination. Over whole periods inertia and spring give nothing, so
//! `c = ⟨δT ẋ⟩/⟨ẋ²⟩`, whatever the motion does within the period: no mass and no stiffness enters. A falling law alone makes
//! sliding unstable where `−N dμ/dv > c`.

use crate::cross::Measured;
use crate::inertia::OPEN;
use crate::lanes::sum;

/// Delay of the forces that is not known, as an angle of the oscillation, rad: 3°, as for the power at growth.
const LATE: f64 = 0.052;

/// The share of samples with an open contact from which on nothing is read: the impacts that follow change the velocity between two
/// samples, which no acceleration shows.
const FEW: f64 = 0.002;

/// Sums over samples of a sustained vibration: deviations of `T` and `N`, motion `ẋ` and acceleration `ẍ`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Losses {
    count: f64,
    open: f64,
    tangential_motion: f64,
    tangential_acceleration: f64,
    normal_motion: f64,
    tangential: f64,
    motion: f64,
    acceleration: f64,
}

impl Losses {
    /// Reads whole periods: motion `ẋ` (m/s), acceleration `ẍ` (m/s²), forces (N).
    pub(super) fn read(motion: &[f64], acceleration: &[f64], tangential: &[f64], normal: &[f64]) -> Losses {
        let mean = |values: &[f64]| sum(values) / values.len().max(1) as f64;
        let means = [motion, acceleration, tangential, normal].map(mean);
        let mut sums = Losses::default();
        for k in 0..motion.len() {
            let [v, a, t, n] = [
                motion[k] - means[0],
                acceleration[k] - means[1],
                tangential[k] - means[2],
                normal[k] - means[3],
            ];
            sums.count += 1.0;
            sums.open += f64::from(u8::from(normal[k] < OPEN * means[3]));
            sums.tangential_motion += t * v;
            sums.tangential_acceleration += t * a;
            sums.normal_motion += n * v;
            sums.tangential += t * t;
            sums.motion += v * v;
            sums.acceleration += a * a;
        }
        sums
    }

    pub(super) fn add(&mut self, other: &Losses) {
        self.count += other.count;
        self.open += other.open;
        self.tangential_motion += other.tangential_motion;
        self.tangential_acceleration += other.tangential_acceleration;
        self.normal_motion += other.normal_motion;
        self.tangential += other.tangential;
        self.motion += other.motion;
        self.acceleration += other.acceleration;
    }

    /// Whether the contact opens.
    pub(super) fn opens(&self) -> bool {
        self.open > FEW * self.count
    }

    /// The damping `c`, N s/m, for an inclination of up to `inclination` (rad); `None` where nothing moves,
    /// or where the contact opens.
    pub(super) fn damping(&self, inclination: f64) -> Option<Measured> {
        let value = self.tangential_motion / self.motion;
        let omega = (self.acceleration / self.motion).sqrt();
        // The inclined spring takes its part of the normal force.
        let inclined = inclination.tan() * self.normal_motion / self.motion;
        let late = LATE * self.tangential_acceleration / (omega * self.motion);
        // As if all of the force were noise.
        let noise = (self.tangential / self.motion / self.count).sqrt();
        let error = inclined.hypot(late).hypot(noise);
        (value.is_finite() && error.is_finite() && !self.opens()).then_some(Measured { value, error })
    }
}
