//! `--accuracy`: what may compute a sweep as accurately as is asked for.

use crate::cli::frontier;
use clap::Args;
use squealmap::engine::backend::Backend;
use squealmap::engine::gpu::adapter::Adapter;
use squealmap::engine::options::Options;
use squealmap::sweep::accuracy::configuration::Configuration;
use squealmap::sweep::accuracy::frontier::{Choice, Chosen};
use squealmap::sweep::accuracy::level::Level;
use squealmap::sweep::error::{Error, Result};
use squealmap::sweep::spec::Spec;

/// The argument.
#[derive(Debug, Args)]
pub(crate) struct AccuracyArgs {
    /// The fastest engine, arithmetic and steps per period with this relative error of deviation, accelerations and
    /// frequency in 95 % of the settled oscillations: draft (1e-2), standard (1e-3), paper (1e-4), reference,
    /// or a number up to 0.1; see `squealmap tradeoff`
    #[arg(long, value_name = "LEVEL", value_parser = Level::parse)]
    pub(crate) accuracy: Option<Level>,
}

/// What may compute a sweep with an accuracy, the fastest first; `None` where there is nothing to choose.
///
/// # Errors
/// When something that it chooses is given too, or nothing is accurate enough.
pub fn ranked(level: Level, spec: &Spec, options: &Options) -> Result<Option<Vec<Choice>>> {
    let note = |text: &str| options.note.iter().for_each(|note| note(text));
    let beside = |option: String| Error::AccuracyBeside { option, accuracy: level.to_string() };
    if let Some(at) = &spec.steps_given {
        let key = "`steps_per_period` in [response]".to_owned();
        let other = format!("--accuracy {level}, which chooses it");
        return Err(Error::Conflict { at: at.clone(), key, other });
    }
    if let Some(precision) = options.precision {
        return Err(beside(format!("--precision {precision}")));
    }
    let only_gpu = options.strict || options.require_gpu || !options.adapters.is_empty();
    let backend = match options.backend {
        Backend::Auto => only_gpu.then_some(Backend::Gpu),
        asked => Some(asked),
    };
    if let (Level::Reference, Some(other @ (Backend::Gpu | Backend::Cpu))) = (level, backend) {
        return Err(beside(format!("--backend {}", other.name())));
    }
    if !spec.analysis.response {
        note("--accuracy has nothing to choose: this sweep asks for no response");
        return Ok(None);
    }
    let allowed = |one: &Configuration| backend.is_none_or(|backend| backend == one.backend) && is_here(one);
    frontier::of(spec, &note).ranked(level, spec, &allowed).map(Some)
}

/// What was chosen, and why, in sentences.
#[must_use]
pub fn said(chosen: &Chosen) -> Vec<String> {
    let mut said = vec![format!("--accuracy {}: {}", chosen.asked, chosen.configuration), chosen.why.clone()];
    if let (Some(bound), Some(trial)) = (chosen.bound, chosen.trial) {
        said.push(trial.sentence(bound));
    }
    said
}

/// Whether this machine has what a configuration needs: a GPU may have gone since it was measured.
fn is_here(configuration: &Configuration) -> bool {
    let adapter = configuration.adapter.as_deref();
    configuration.backend != Backend::Gpu
        || Adapter::best(configuration.precision, adapter).is_ok_and(|adapter| !adapter.is_software())
}
