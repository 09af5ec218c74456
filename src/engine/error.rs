//! Why no engine computes, or why one stopped.

/// Why no engine computes, or why one stopped. Every message is one sentence: where, the key, the value, the limit, what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A GPU is asked of a crate that is built without it.
    #[error("this is built without the feature `gpu`; build it with that, or use --backend cpu")]
    WithoutGpu,
    /// No adapter at all.
    #[error(
        "no GPU was found: no adapter answers through Vulkan, Metal or DX12; {remedy}, or use --backend cpu"
    )]
    NoAdapter {
        /// What to install.
        remedy: &'static str,
    },
    /// No adapter of the name that was asked for.
    #[error("no adapter has `{name}` in its name; there are: {names}; choose one with --adapter")]
    NoSuchAdapter {
        /// The part of a name.
        name: String,
        /// What there is.
        names: String,
    },
    /// A name that is given more often than there are adapters that have it.
    #[error(
        "--adapter {name} asks for {wanted} adapters with that in their names, but there are {found}; remove one"
    )]
    TooFewAdapters {
        /// The part of a name.
        name: String,
        /// How many are asked for.
        wanted: usize,
        /// How many there are.
        found: usize,
    },
    /// An adapter without 64-bit arithmetic.
    #[error("{adapter} does not compute in f64 (SHADER_F64); use --precision f32 or --backend cpu")]
    NoF64 {
        /// The best adapter.
        adapter: String,
    },
    /// An adapter that cannot round every operation by itself.
    #[error(
        "{adapter} cannot compute strictly, which needs Vulkan; choose another with --adapter or remove --strict"
    )]
    NoStrict {
        /// The best adapter.
        adapter: String,
    },
    /// A hardware GPU is required but a software adapter would compute.
    #[error("--require-gpu: {instead} would compute; remove the flag or install a GPU driver")]
    NoHardware {
        /// What would compute.
        instead: String,
    },
    /// Something is asked for that only a GPU can honour, and none is taken.
    #[error("{asked}: this needs a GPU, but {cause}; {remedy}, or remove {asked}")]
    OnlyOnGpu {
        /// The options.
        asked: String,
        /// Why no GPU is taken.
        cause: String,
        /// What helps against it.
        remedy: String,
    },
    /// Cycles by shooting are asked of a GPU.
    #[error(
        "settle = \"cycle\" finds cycles on the CPU only; use --backend cpu, or settle = \"auto\" in [response]"
    )]
    CyclesOnGpu,
    /// An adapter without a name.
    #[error(
        "--adapter is `{name}` but must be a part of an adapter's name as `squealmap adapters` prints it; \
         give one or remove --adapter"
    )]
    EmptyAdapter {
        /// The blanks that were given, if any.
        name: String,
    },
    /// A friction table that no kernel holds.
    #[error(
        "a friction table of {rows} rows, or two of a material together, is too long for a GPU, which takes {limit}; thin it out, \
         or use --backend cpu"
    )]
    LongTable {
        /// Rows of the table.
        rows: usize,
        /// The most there may be.
        limit: usize,
    },
    /// A modal model asked of a GPU.
    #[error("no kernel of a GPU computes a modal model, which --backend cpu does")]
    ModalOnGpu,
    /// The reference asked to compute in f32.
    #[error("the reference computes in f64 only; remove --precision f32 or use --backend cpu")]
    ReferencePrecision,
    /// The CPU engine asked to be strict.
    #[error("--strict is about how a GPU rounds; remove --strict or use --backend gpu")]
    CpuStrict,
    /// The CPU engine asked to use an adapter.
    #[error("the CPU engine uses no adapter; remove --adapter {name} or use --backend gpu")]
    CpuAdapter {
        /// The part of a name that was given.
        name: String,
    },
    /// The CPU engine asked to be a GPU.
    #[error("the CPU engine is no GPU; remove --require-gpu or use --backend gpu")]
    CpuRequireGpu,
    /// An adapter that cannot be opened.
    #[error("cannot open {adapter}: {why}; use --backend cpu")]
    OpenDevice {
        /// The adapter.
        adapter: String,
        /// What it says.
        why: String,
    },
    /// A device that rejects what it is given.
    #[error("the GPU failed while {what}: {why}; use --backend cpu")]
    Device {
        /// During what.
        what: String,
        /// What it says.
        why: String,
    },
    /// A device that is gone.
    #[error("the GPU was lost: {why}")]
    DeviceLost {
        /// What it says.
        why: String,
    },
    /// A device that was opened again and lost again.
    #[error(
        "the GPU was lost twice: {why}; {done} of {total} instances were done; \
         use --backend cpu or fewer instances"
    )]
    DeviceLostAgain {
        /// What it says.
        why: String,
        /// Finished instances.
        done: usize,
        /// All instances.
        total: usize,
    },
    /// A buffer with too few or too many words.
    #[error("the buffer `{name}` has {found} words instead of {wanted}; nothing was exported")]
    ShortBuffer {
        /// The buffer.
        name: &'static str,
        /// Its words.
        found: usize,
        /// What it should have.
        wanted: usize,
    },
    /// A kernel whose counters are not what they should be.
    #[error("the {kernel} kernel counted {found} instead of {wanted}; nothing was exported")]
    Miscounted {
        /// The kernel.
        kernel: &'static str,
        /// Its count.
        found: usize,
        /// What it should be.
        wanted: usize,
    },
    /// A kernel that does not come to an end.
    #[error(
        "the {kernel} kernel finished {finished} of {count} instances in {dispatches} dispatches; nothing was exported"
    )]
    Endless {
        /// The kernel.
        kernel: &'static str,
        /// Finished instances.
        finished: usize,
        /// Instances of the chunk.
        count: usize,
        /// Dispatches.
        dispatches: u64,
    },
    /// An engine that failed before anything was done.
    #[error("{why}")]
    Engine {
        /// What it says.
        why: String,
    },
    /// A map holds an instance that was never computed, without a reason.
    #[error("instance {instance} was never computed; nothing was exported")]
    Unwritten {
        /// The first such instance.
        instance: usize,
    },
    /// A run that was stopped from outside before anything was done, or a chunk of one.
    #[error("stopped after {done} of {total} instances; nothing was written")]
    Cancelled {
        /// Finished instances.
        done: usize,
        /// All instances.
        total: usize,
    },
}

impl Error {
    /// Whether a run was stopped from outside.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        matches!(self, Error::Cancelled { .. })
    }

    /// Whether the input (file, arguments, output directory) is at fault, as opposed to the run.
    #[must_use]
    pub fn is_bad_input(&self) -> bool {
        matches!(
            self,
            Error::WithoutGpu
                | Error::NoAdapter { .. }
                | Error::NoSuchAdapter { .. }
                | Error::TooFewAdapters { .. }
                | Error::NoF64 { .. }
                | Error::NoStrict { .. }
                | Error::NoHardware { .. }
                | Error::OnlyOnGpu { .. }
                | Error::EmptyAdapter { .. }
                | Error::LongTable { .. }
                | Error::CyclesOnGpu
                | Error::ReferencePrecision
                | Error::CpuStrict
                | Error::CpuAdapter { .. }
                | Error::CpuRequireGpu
                | Error::ModalOnGpu
        )
    }
}

/// The result of this floor.
pub type Result<T> = std::result::Result<T, Error>;
