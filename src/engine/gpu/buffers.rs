//! The buffers that a device computes in, and those through which it is reached.

use rayon::prelude::*;

use crate::engine::error::Result;
use crate::engine::gpu::device::Device;
use crate::engine::kernel::source::PROGRESS_WORDS;
use crate::engine::march::round::ALIGNED;

/// Most groups of a round: by forms of laws, numbers of pieces, ramps, and whether their legs have begun.
const GROUPS: usize = 128;

/// Bytes that a thread copies at a time.
const PIECE: usize = 1 << 16;

/// Buffers of a device, of so many bytes.
#[derive(Debug)]
pub(super) struct Buffers {
    pub(super) sizes: [usize; 3],
    pub(super) inputs: wgpu::Buffer,
    pub(super) state: wgpu::Buffer,
    pub(super) flags: wgpu::Buffer,
    pub(super) settings: wgpu::Buffer,
    pub(super) progress: wgpu::Buffer,
    /// What goes to the device, and what comes from it.
    pub(super) up: wgpu::Buffer,
    pub(super) back: wgpu::Buffer,
}

impl Buffers {
    /// Buffers for inputs, state and flags of so many bytes.
    pub(super) fn new(device: &Device, sizes: [usize; 3]) -> Result<Buffers> {
        use wgpu::BufferUsages as Usage;
        let [inputs, state, flags] = sizes;
        let settings = GROUPS * ALIGNED;
        device.checked("allocating buffers", || {
            let buffer = |label, size: usize, usage, mapped_at_creation| {
                let descriptor = wgpu::BufferDescriptor {
                    label: Some(label),
                    size: size as u64,
                    usage,
                    mapped_at_creation,
                };
                device.raw.create_buffer(&descriptor)
            };
            let both = Usage::STORAGE | Usage::COPY_SRC | Usage::COPY_DST;
            let all = inputs + state + flags + settings;
            Buffers {
                sizes,
                inputs: buffer("inputs", inputs, Usage::STORAGE | Usage::COPY_DST, false),
                state: buffer("state", state, both, false),
                flags: buffer("flags", flags, both, false),
                settings: buffer("settings", settings, Usage::UNIFORM | Usage::COPY_DST, false),
                progress: buffer("progress", PROGRESS_WORDS * 4, Usage::STORAGE, false),
                up: buffer("up", all, Usage::MAP_WRITE | Usage::COPY_SRC, true),
                back: buffer("back", state + flags + ALIGNED, Usage::MAP_READ | Usage::COPY_DST, false),
            }
        })
    }
}

/// Copies bytes into mapped memory, by all threads: one alone takes as long for it as all together for what the bytes are made of.
pub(super) fn write(to: wgpu::WriteOnly<[u8]>, bytes: &[u8]) {
    let (pieces, mut rest) = to.into_chunks::<PIECE>();
    let from = bytes.chunks_exact(PIECE);
    rest.copy_from_slice(from.remainder());
    let pieces: Vec<(wgpu::WriteOnly<[u8; PIECE]>, &[u8])> = pieces.into_iter().zip(from).collect();
    pieces
        .into_par_iter()
        .for_each(|(piece, from)| wgpu::WriteOnly::<[u8]>::from(piece).copy_from_slice(from));
}
