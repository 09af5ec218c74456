//! The options that choose an engine; every command with one has them.

use std::sync::atomic::AtomicBool;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
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
    #[arg(long, value_parser = named(Backend::OFFERED, Backend::name), default_value = Backend::default().name())]
    pub(crate) backend: Backend,
    /// Arithmetic [default: f64 on the CPU, f32 on a GPU]
    #[arg(long, value_parser = named(Precision::ALL, Precision::name))]
    pub(crate) precision: Option<Precision>,
    /// A GPU rounds every operation by itself, like the twin of its kernel on the CPU; needs Vulkan
    #[arg(long)]
    pub(crate) strict: bool,
    /// A GPU with this in its name, see `squealmap adapters`; given several times, that many GPUs share the work
    #[arg(long, value_name = "NAME")]
    pub(crate) adapter: Vec<String>,
    /// Fail unless a hardware GPU computes
    #[arg(long)]
    pub(crate) require_gpu: bool,
}

/// One of some values by its name on the command line.
fn named<T: Copy + Send + Sync + 'static, const N: usize>(
    all: [T; N],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(all.map(name))
        .try_map(move |said| all.into_iter().find(|one| name(*one) == said).ok_or("no such value"))
}

impl EngineArgs {
    /// The engine that is asked for.
    pub(crate) fn options<'a>(&'a self, cancel: &'a AtomicBool, note: Note<'a>) -> Options<'a> {
        Options {
            backend: self.backend,
            precision: self.precision,
            strict: self.strict,
            require_gpu: self.require_gpu,
            adapters: &self.adapter,
            chunk: None,
            cancel: Some(cancel),
            note: Some(note),
        }
    }
}
