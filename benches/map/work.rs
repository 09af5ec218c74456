//! The map of the benchmarks: what is computed, by what plan, and a sample of it for the judge.

use squealmap::engine::method::Method;
use squealmap::engine::method::taylor::REFERENCE_ORDER;
use squealmap::engine::plan::{Duration, Plan, STEP_TOLERANCE, StartKind};
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::motion::Motion;
use squealmap::model::{Param, Params};
use squealmap::sweep::grid::{AxisKey, Grid, Value};
use squealmap::sweep::spec::Spec;

/// Belt velocities, m/s.
const VELOCITIES: [f64; 4] = [0.5, 1.0, 3.0, 6.0];

/// Largest friction coefficient.
const LARGEST_MU: f64 = 0.6;

/// Knee of the bilinear law, m/s.
const KNEE: f64 = 5.0;

/// Velocity added to the sliding equilibrium at the start, as a share of the belt's.
const KICK: f64 = 0.3;

/// Periods before and in the measuring window.
const SETTLE: f64 = 100.0;
const MEASURE: f64 = 40.0;

/// Knuth's linear congruential generator, and where it begins.
const MULTIPLIER: u64 = 6_364_136_223_846_793_005;
const INCREMENT: u64 = 1_442_695_040_888_963_407;
const SEED: u64 = 20_261_121;

/// The paper's model with `side`² friction coefficients (`mu_s` × `mu_d`) at four belt velocities, the velocity
/// varying slowest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Work {
    side: usize,
}

impl Work {
    /// The map nearest to `size` instances.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
    pub(crate) fn of_size(size: usize) -> Work {
        let side = (size as f64 / VELOCITIES.len() as f64).sqrt().round();
        Work { side: (side as usize).max(2) }
    }

    /// Periods that all instances run.
    #[allow(dead_code, reason = "the bench of the kernels takes it")]
    pub(crate) fn periods(self) -> f64 {
        (SETTLE + MEASURE) * self.len() as f64
    }

    pub(crate) fn len(self) -> usize {
        VELOCITIES.len() * self.side * self.side
    }

    /// `mu_s`, `mu_d`, belt velocity and kick of an instance.
    pub(crate) fn values(self, index: usize) -> [f64; 4] {
        let coefficient = |k: usize| LARGEST_MU * k as f64 / (self.side - 1) as f64;
        let velocity = VELOCITIES[index / (self.side * self.side)];
        let [row, column] = [index / self.side % self.side, index % self.side];
        [coefficient(row), coefficient(column), velocity, KICK * velocity]
    }

    pub(crate) fn instance(self, index: usize) -> Instance {
        let [mu_s, mu_d, velocity, kick] = self.values(index);
        let mut params = Params::default();
        params.set(Param::BeltVelocity, velocity);
        params.set(Param::StartVelocity, kick);
        let law = FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: KNEE };
        Instance { params, law, impact_friction: true, motion: Motion::Ramp, heating: None, modal: None }
    }

    /// The same as a sweep.
    pub(crate) fn spec(self) -> squealmap::error::Result<Spec> {
        let text = format!(
            "analysis = [\"response\"]\n[friction]\nlaw = \"bilinear\"\nmu_s = 0.1\nmu_d = 0.1\n\
             knee_velocity = {KNEE:?}\n[belt]\nbelt_velocity = 1.0\n\
             [response]\nsettle = \"{SETTLE} periods\"\nmeasure = \"{MEASURE} periods\"\ncheck = false\n"
        );
        let mut spec = Spec::parse(&text, "benches/map", ".".as_ref())?;
        spec.grid = Grid::Tuples {
            keys: [Param::MuS, Param::MuD, Param::BeltVelocity, Param::StartVelocity]
                .map(AxisKey::Param)
                .to_vec(),
            rows: (0..self.len()).map(|index| self.values(index).map(Value::Number).to_vec()).collect(),
        };
        Ok(spec)
    }

    /// The indices of at most `most` instances, rising: all, or one from each of `most` equal parts, drawn from
    /// a sequence that is the same in every run.
    pub(crate) fn sample(self, most: usize) -> Vec<usize> {
        let total = self.len();
        if total <= most {
            return (0..total).collect();
        }
        let mut random = SEED;
        (0..most)
            .map(|part| {
                random = random.wrapping_mul(MULTIPLIER).wrapping_add(INCREMENT);
                let (low, high) = (part * total / most, (part + 1) * total / most);
                low + (random >> 33) as usize % (high - low)
            })
            .collect()
    }
}

/// The run of every instance, at `steps_per_period` by a series of `order` whose truncation is bounded.
pub(crate) fn plan(steps_per_period: u32, order: usize, tolerance: f64) -> Plan {
    Plan {
        start: StartKind::Kick,
        settle: Duration::Periods(SETTLE),
        settle_limit: None,
        hunts: false,
        measure: Duration::Periods(MEASURE),
        steps_per_period,
        method: Method::Taylor,
        order,
        tolerance,
    }
}

/// The run of the reference.
pub(crate) fn reference_plan(steps_per_period: u32) -> Plan {
    plan(steps_per_period, REFERENCE_ORDER, STEP_TOLERANCE)
}
