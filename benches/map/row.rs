//! One line of the result: a case on a map, measured and judged.

use crate::clock::Elapsed;
use crate::engine::{Case, Engine, Output};
use crate::flops;
use crate::judge::Errors;
use crate::machine::Machine;

/// A case on a map.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) case: Case,
    pub(crate) instances: usize,
    /// Best wall and CPU time of the map, s.
    pub(crate) best: Elapsed,
    /// Steps of the map.
    pub(crate) steps: u64,
    /// Instances that did not end as `ok`.
    pub(crate) failed: usize,
    pub(crate) errors: Errors,
    /// The adapter; empty on the CPU.
    pub(crate) adapter: String,
    /// Whether the CPU does the work: not on a hardware GPU.
    pub(crate) on_cpu: bool,
    /// Peak memory of the process after the first run of this row, MiB.
    pub(crate) memory: Option<f64>,
}

impl Row {
    /// Takes the times of another round.
    pub(crate) fn improve(&mut self, again: Elapsed) {
        self.best.wall = self.best.wall.min(again.wall);
        self.best.cpu = self.best.cpu.zip(again.cpu).map(|(a, b)| a.min(b));
    }

    /// Takes what came of its map.
    pub(crate) fn take(&mut self, output: &Output, errors: Errors) {
        (self.steps, self.failed, self.errors) = (output.steps, output.failed.len(), errors);
    }

    pub(crate) fn per_second(&self) -> f64 {
        self.instances as f64 / self.best.wall
    }

    /// Instances per CPU-second; unknown where a GPU does the work.
    pub(crate) fn per_cpu_second(&self) -> Option<f64> {
        let cpu = self.best.cpu.filter(|seconds| self.on_cpu && *seconds > 0.0)?;
        Some(self.instances as f64 / cpu)
    }

    pub(crate) fn steps_per_instance(&self) -> f64 {
        self.steps as f64 / self.instances as f64
    }

    pub(crate) fn steps_per_second(&self) -> f64 {
        self.steps_per_instance() * self.per_second()
    }

    pub(crate) fn steps_per_cpu_second(&self) -> Option<f64> {
        Some(self.steps_per_instance() * self.per_cpu_second()?)
    }

    /// Share of the FMA peak of the cores in use, contact-only steps and steps of all modes.
    pub(crate) fn share_of_peak(&self, machine: &Machine) -> Option<[f64; 2]> {
        let order = self.case.order();
        let steps = self.steps_per_cpu_second()? / machine.peak(self.case.arithmetic()).flops;
        Some([flops::contact_only(order) * steps, flops::all_modes(order) * steps])
    }

    /// How many times the work per CPU-second of the row in `rows` that is this one in scalar code, of the same order, steps
    /// and bound.
    pub(crate) fn over_scalar(&self, rows: &[Row]) -> Option<f64> {
        if self.case.engine != Engine::Simd {
            return None;
        }
        let is_it = |row: &&Row| row.case == Case { engine: Engine::Scalar, ..self.case };
        let scalar = rows.iter().find(is_it)?;
        Some(self.per_cpu_second()? / scalar.per_cpu_second()?)
    }

    /// What is the same in a later run.
    pub(crate) fn key(&self) -> [String; 5] {
        let Case { engine, steps_per_period, .. } = self.case;
        [
            engine.name().to_owned(),
            self.case.scalar(),
            steps_per_period.to_string(),
            self.instances.to_string(),
            self.adapter.clone(),
        ]
    }
}
