//! Signals as sensors on one instance would record them: channels sampled at one rate, each with its own delay.
//!
//! Samples are taken from the series of the integration, exactly at their instants; a trajectory
//! ([`crate::study::trace::run`]) has rows at events too, which no data logger has.

use crate::engine::plan::Plan;
use crate::engine::reference::observer::Observer;
use crate::engine::reference::observer::Step;
use crate::engine::scene::Scene;
use crate::model::instance::Instance;
use crate::model::status::Status;

/// How an instance is recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recording {
    /// Samples per second, Hz.
    pub rate: f64,
    /// Length, s.
    pub duration: f64,
    /// Delay of the normal acceleration behind the tangential one, s, at least 0.
    pub skew: f64,
    /// Delay of both forces behind the tangential acceleration, s, at least 0.
    pub force_skew: f64,
}

/// One sample of every channel, SI units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Time since the start of the recording, s.
    pub t: f64,
    /// Tangential acceleration `ẍ2`, m/s².
    pub tangential_acceleration: f64,
    /// Normal acceleration `ÿ1`, m/s².
    pub normal_acceleration: f64,
    /// Tangential contact force `T`, N.
    pub tangential_force: f64,
    /// Normal contact force `N`, N.
    pub normal_force: f64,
    /// Belt velocity `V`, m/s.
    pub belt_velocity: f64,
}

/// The recording of an instance: samples `k / rate`, and how the instance ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Signals {
    /// The samples in order of time; fewer than asked for when the instance failed.
    pub samples: Vec<Sample>,
    /// [`Status::Ok`], or why the instance ended early.
    pub status: Status,
}

/// Groups of channels with a common delay: tangential acceleration and belt, normal acceleration, forces.
const GROUPS: usize = 3;

/// Integrates an instance from the start of `plan` (its durations are not used) and records it.
#[must_use]
pub fn record(instance: &Instance, plan: &Plan, recording: &Recording) -> Signals {
    let fail = |status| Signals { samples: Vec::new(), status };
    let scene = match Scene::new(instance, plan.start) {
        Ok(scene) => scene,
        Err(status) => return fail(status),
    };
    let delays = [0.0, recording.skew, recording.force_skew];
    let latest = delays.into_iter().fold(0.0, f64::max);
    let mut logger = Logger {
        scene: &scene,
        spacing: 1.0 / (recording.rate * scene.units.time),
        from: delays.map(|delay| (latest - delay) / scene.units.time),
        taken: [0; GROUPS],
        samples: Vec::new(),
        rate: recording.rate,
    };
    let mut integrator = match scene.integrator(plan) {
        Ok(integrator) => integrator,
        Err(status) => return fail(status),
    };
    let length = (recording.duration + latest) / scene.units.time;
    let status = scene.advance(&mut integrator, length, &mut logger).err().unwrap_or(Status::Ok);
    // The last samples of the delayed channels may be missing.
    let whole = logger.taken.into_iter().min().unwrap_or(0);
    logger.samples.truncate(whole);
    Signals { samples: logger.samples, status }
}

/// Turns steps into samples.
struct Logger<'a> {
    scene: &'a Scene,
    /// Between samples, scaled time.
    spacing: f64,
    /// The instant of sample 0 of every group, scaled time.
    from: [f64; GROUPS],
    taken: [usize; GROUPS],
    samples: Vec<Sample>,
    rate: f64,
}

impl Logger<'_> {
    /// The row of sample `k`, made when it does not exist yet.
    fn row(&mut self, k: usize) -> &mut Sample {
        while self.samples.len() <= k {
            let t = self.samples.len() as f64 / self.rate;
            self.samples.push(Sample { t, ..Sample::default() });
        }
        &mut self.samples[k]
    }
}

impl Observer for Logger<'_> {
    fn step(&mut self, step: &Step) {
        let units = self.scene.units;
        for group in 0..GROUPS {
            loop {
                let k = self.taken[group];
                let time = self.from[group] + k as f64 * self.spacing;
                let tau = time - step.start;
                if tau > step.duration {
                    break;
                }
                // An instant on the end of the last step is that of the state after its event.
                let tau = tau.max(0.0);
                let motion = step.expansion.motion(tau);
                let (tangential, normal) = step.expansion.forces(tau);
                let belt = self.scene.belt(time).velocity;
                let row = self.row(k);
                match group {
                    0 => {
                        row.tangential_acceleration = motion.acceleration[0] * units.acceleration;
                        row.belt_velocity = belt * units.velocity;
                    }
                    1 => row.normal_acceleration = motion.acceleration[2] * units.acceleration,
                    _ => {
                        row.tangential_force = tangential * units.force;
                        row.normal_force = normal * units.force;
                    }
                }
                self.taken[group] += 1;
            }
        }
    }
}
