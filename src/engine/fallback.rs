//! Why `auto` takes no GPU, and whether the CPU engine may then compute what was asked for.

use crate::engine::error::{Error, Result};
use crate::engine::options::Options;
use squealmap_input::quote::list;

/// Why there is no GPU to take.
#[derive(Debug)]
pub(crate) enum NoGpu {
    /// The search for one, or its opening, ended with an error.
    Failed(Error),
    /// The best of those asked for is a program on the CPU.
    Software(String),
}

impl NoGpu {
    /// The reason as a note: what is missing and what to do where a GPU is wanted.
    pub(crate) fn note(&self) -> String {
        match self {
            NoGpu::Failed(why) => why.to_string(),
            NoGpu::Software(adapter) => format!("the only adapter, {adapter}, is software"),
        }
    }

    /// Nothing where the CPU engine may take over.
    ///
    /// # Errors
    /// When something was asked for that it cannot honour: it would be dropped without a word.
    pub(crate) fn allows_cpu(&self, options: &Options) -> Result<()> {
        let asked = only_on_gpu(options);
        if asked.is_empty() { Ok(()) } else { Err(self.refusal(&asked, options.require_gpu)) }
    }

    /// The error that names `asked`, which this stands in the way of.
    pub(crate) fn refusal(&self, asked: &[String], require_gpu: bool) -> Error {
        let (cause, remedy) = self.parts(require_gpu);
        let asked: Vec<&str> = asked.iter().map(String::as_str).collect();
        Error::OnlyOnGpu { asked: list(&asked), cause, remedy }
    }

    /// The reason, and what helps against it, apart: the advice of the errors is to give up the GPU.
    fn parts(&self, require_gpu: bool) -> (String, String) {
        let parts = |cause: String, remedy: &str| (cause, remedy.to_owned());
        match self {
            NoGpu::Software(adapter) => parts(
                format!("{adapter} is no hardware GPU"),
                if require_gpu {
                    "install the driver of a GPU"
                } else {
                    "take it all the same with --backend gpu"
                },
            ),
            NoGpu::Failed(Error::WithoutGpu) => {
                parts("this is built without the feature `gpu`".to_owned(), "build it with that")
            }
            NoGpu::Failed(Error::NoAdapter { remedy }) => {
                parts("no adapter answers through Vulkan, Metal or DX12".to_owned(), remedy)
            }
            NoGpu::Failed(Error::NoF64 { adapter }) => {
                parts(format!("{adapter} does not compute in f64 (SHADER_F64)"), "use --precision f32")
            }
            NoGpu::Failed(Error::NoStrict { adapter }) => parts(
                format!("{adapter} cannot compute strictly, which needs Vulkan"),
                "choose another with --adapter",
            ),
            NoGpu::Failed(Error::LongTable { rows, limit }) => parts(
                format!(
                    "a friction table of {rows} rows, or two of a material together, is too long for a GPU, which takes {limit}"
                ),
                "thin it out",
            ),
            NoGpu::Failed(Error::CyclesOnGpu) => parts(
                "settle = \"cycle\" in [response] finds cycles on the CPU only".to_owned(),
                "write settle = \"auto\"",
            ),
            NoGpu::Failed(Error::ModalOnGpu) => {
                parts("no kernel of one computes a modal model".to_owned(), "compute it on the CPU")
            }
            NoGpu::Failed(Error::OpenDevice { adapter, why }) => {
                parts(format!("{adapter} cannot be opened ({why})"), "choose another with --adapter")
            }
            NoGpu::Failed(other) => parts(other.to_string(), "choose another with --adapter"),
        }
    }
}

/// The options that only a GPU can honour, as they are written on the command line.
pub(crate) fn only_on_gpu(options: &Options) -> Vec<String> {
    let mut asked = Vec::new();
    if options.strict {
        asked.push("--strict".to_owned());
    }
    asked.extend(options.adapters.iter().map(|name| format!("--adapter {name}")));
    if options.require_gpu {
        asked.push("--require-gpu".to_owned());
    }
    asked
}
