//! The frequency of an oscillation over windows of which some have another one, such as a harmonic that is louder there.

/// Relative difference of frequencies that are one.
const SAME: f64 = 0.2;

/// Sums of power and of frequency times power, of up to two frequencies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Pitch([[f64; 2]; 2]);

impl Pitch {
    /// That of one window: its frequency (Hz) and power.
    pub(super) fn of(frequency: f64, power: f64) -> Pitch {
        let mut pitch = Pitch::default();
        pitch.take(frequency, power);
        pitch
    }

    /// Takes a frequency (Hz) with its power.
    fn take(&mut self, frequency: f64, power: f64) {
        if power.is_nan() || power <= 0.0 {
            return;
        }
        let apart = |[sum, part]: [f64; 2]| {
            if sum > 0.0 { (part / sum / frequency).ln().abs() } else { SAME }
        };
        let [one, other] = self.0.map(apart);
        // A third frequency goes to the nearer one.
        let place = usize::from(self.0[0][0] > 0.0 && one > SAME && other < one);
        self.0[place][0] += power;
        self.0[place][1] += frequency * power;
    }

    pub(super) fn add(&mut self, other: &Pitch) {
        for [sum, part] in other.0 {
            self.take(part / sum, sum);
        }
    }

    /// That of the most power, Hz; 0 without any.
    pub(super) fn frequency(&self) -> f64 {
        let [sum, part] = if self.0[1][0] > self.0[0][0] { self.0[1] } else { self.0[0] };
        part / sum.max(f64::MIN_POSITIVE)
    }
}
