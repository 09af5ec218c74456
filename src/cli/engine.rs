//! The options that choose an engine; every command with one has them.

use std::sync::atomic::AtomicBool;

use clap::{Args, ValueEnum};
use squealmap::engine::backend::Backend;
use squealmap::engine::options::Options;
use squealmap::engine::precision::Precision;
use squealmap::store::directory::Note;

/// Arguments that choose an engine.
#[derive(Debug, Args)]
pub(crate) struct EngineArgs {
    /// Worker threads, 1 to 1024 [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// What computes: `auto` takes a hardware GPU where there is one, else the CPU; `reference` is the
    /// slow, accurate judge of the others
    #[arg(long, value_enum, default_value_t)]
    pub(crate) backend: BackendName,
    /// Arithmetic [default: f64 on the CPU, f32 on a GPU]
    #[arg(long, value_enum)]
    pub(crate) precision: Option<PrecisionName>,
    /// A GPU rounds every operation by itself, like the twin of its kernel on the CPU; needs Vulkan
    #[arg(long)]
    pub(crate) strict: bool,
    /// Only a GPU with this in its name; see `squealmap adapters`
    #[arg(long, value_name = "NAME")]
    pub(crate) adapter: Option<String>,
    /// Fail unless a hardware GPU computes
    #[arg(long)]
    pub(crate) require_gpu: bool,
}

/// The values of `--backend`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum BackendName {
    #[default]
    Auto,
    Gpu,
    Cpu,
    Reference,
}

/// The values of `--precision`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum PrecisionName {
    F32,
    F64,
}

impl From<BackendName> for Backend {
    fn from(name: BackendName) -> Backend {
        match name {
            BackendName::Auto => Backend::Auto,
            BackendName::Gpu => Backend::Gpu,
            BackendName::Cpu => Backend::Cpu,
            BackendName::Reference => Backend::Reference,
        }
    }
}

impl From<PrecisionName> for Precision {
    fn from(name: PrecisionName) -> Precision {
        match name {
            PrecisionName::F32 => Precision::F32,
            PrecisionName::F64 => Precision::F64,
        }
    }
}

impl EngineArgs {
    /// The engine that is asked for.
    pub(crate) fn options<'a>(&'a self, cancel: &'a AtomicBool, note: Note<'a>) -> Options<'a> {
        Options {
            backend: self.backend.into(),
            precision: self.precision.map(Precision::from),
            strict: self.strict,
            require_gpu: self.require_gpu,
            adapter: self.adapter.as_deref(),
            chunk: None,
            cancel: Some(cancel),
            note: Some(note),
        }
    }
}
