//! Every engine behind one face: what holds for one has to hold for all, or to be written down.

use std::sync::atomic::AtomicBool;

use crate::twin;
use squealmap::engine::lanes::Lanes;
use squealmap::engine::lanes::outcomes::outcomes;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::Plan;
use squealmap::engine::reference::respond::respond;
use squealmap::model::instance::Instance;

/// What computes a transient, in which precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Engine {
    Reference,
    CpuF64,
    CpuF32,
    /// The kernel of a GPU, by its twin.
    KernelF64,
    KernelF32,
}

impl Engine {
    pub(crate) const ALL: [Engine; 5] =
        [Engine::Reference, Engine::CpuF64, Engine::CpuF32, Engine::KernelF64, Engine::KernelF32];

    /// The name in a table.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Engine::Reference => "reference",
            Engine::CpuF64 => "cpu f64",
            Engine::CpuF32 => "cpu f32",
            Engine::KernelF64 => "gpu f64",
            Engine::KernelF32 => "gpu f32",
        }
    }

    /// How many times longer a step takes than one of the reference: the twin carries out its kernel word by word.
    pub(crate) fn slower(self) -> f64 {
        match self {
            Engine::Reference | Engine::CpuF64 | Engine::CpuF32 => 1.0,
            Engine::KernelF64 | Engine::KernelF32 => 20.0,
        }
    }

    /// The transients of some instances.
    pub(crate) fn run_all(self, instances: &[Instance], plan: &Plan) -> Vec<Outcome> {
        match self {
            Engine::Reference => instances.iter().map(|one| respond(one, plan)).collect(),
            Engine::CpuF64 => lanes::<f64>(instances, plan),
            Engine::CpuF32 => lanes::<f32>(instances, plan),
            Engine::KernelF64 => twin::outcomes::<f64>(instances, plan),
            Engine::KernelF32 => twin::outcomes::<f32>(instances, plan),
        }
    }

    /// The transient of one instance.
    pub(crate) fn run(self, instance: &Instance, plan: &Plan) -> Outcome {
        self.run_all(std::slice::from_ref(instance), plan)[0]
    }
}

fn lanes<T: Lanes>(instances: &[Instance], plan: &Plan) -> Vec<Outcome> {
    outcomes::<T>(instances, plan, &AtomicBool::new(false)).expect("nobody stops it")
}
