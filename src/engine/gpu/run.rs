//! One chunk of instances through a kernel: upload, dispatch until all are finished, read back, check.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::engine::error::{Error, Result};
use crate::engine::fields::words;
use crate::engine::gpu::device::Device;
use crate::engine::gpu::kernel::Compiled;
use crate::engine::kernel::places::{place, room};
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::source::{
    FLAG_STATUS, Kernel, PROGRESS_WORDS, SETTING_WORDS, Settings, WORKGROUP_SIZE,
};
use crate::model::status::Status;

/// Most loop iterations of an invocation in one dispatch. A software driver silently stops after 65 535 iterations of all
/// loops together; on hardware only the loop over the steps counts.
pub const MAX_LOOPS: u32 = 60_000;

/// A dispatch aims at this time: long enough to cost nothing, short enough for every watchdog and for Ctrl-C.
const AIM: Duration = Duration::from_millis(75);

/// Steps per dispatch grow at most by this factor from one dispatch to the next.
const GROWTH: f64 = 4.0;

/// Steps of the first dispatch.
pub(super) const FIRST: u32 = 64;

/// How a kernel is driven.
#[derive(Clone, Copy)]
pub struct Drive<'a> {
    /// Index of the chunk's first instance.
    pub offset: usize,
    /// Kernel-specific words of the settings.
    pub settings: [u32; SETTING_WORDS],
    /// Most dispatches; more mean that the kernel does not come to an end.
    pub most_dispatches: u64,
    /// Set to stop: between two dispatches.
    pub cancel: &'a AtomicBool,
    /// Gets the number of newly finished instances.
    pub progress: &'a (dyn Fn(usize) + Sync),
}

/// The results of a chunk, as they stand in the buffers.
#[derive(Clone, Debug, PartialEq)]
pub struct ChunkResult<R> {
    /// The words of `state`.
    pub state: Vec<R>,
    /// The words of `flags`.
    pub flags: Vec<u32>,
    /// Whether it was cancelled: instances that were not finished by then are unwritten.
    pub cancelled: bool,
}

impl<R: Real> ChunkResult<R> {
    /// The result of `count` instances that were cancelled before they began.
    #[must_use]
    pub fn nothing(kernel: &Kernel, count: usize) -> ChunkResult<R> {
        ChunkResult {
            state: vec![R::ZERO; room(count) * words(kernel.state)],
            flags: vec![Status::Unwritten as u32; room(count) * words(kernel.flags)],
            cancelled: count > 0,
        }
    }
}

/// Runs a chunk from its start to its end: inputs, and how many instances they are of.
///
/// # Errors
/// When the device fails or is lost, the run is cancelled before an instance is finished, the kernel does not
/// end, or leaves an instance unwritten.
pub fn run<R: Real>(
    device: &Device,
    compiled: &Compiled,
    (inputs, count): (&[R], usize),
    drive: &Drive,
) -> Result<ChunkResult<R>> {
    let sizes = sizes(compiled, inputs, count)?;
    let buffers =
        device.checked("allocating buffers", || Buffers::new(device, compiled, inputs, None, sizes))?;
    let finished = dispatch(device, compiled, &buffers, count, drive)?;
    let cancelled = finished < count;
    if cancelled && finished == 0 {
        return Err(Error::Cancelled { done: 0, total: count });
    }
    let result = result(device, &buffers, sizes, cancelled)?;
    device.meter.carry(size_of_val(inputs), sizes[0] + sizes[1]);
    check(&result, count, compiled.words())?;
    Ok(result)
}

/// Takes a chunk some dispatches further, of so many steps each; `before` are its state and flags.
///
/// # Errors
/// When the device fails or is lost.
pub fn advance<R: Real>(
    device: &Device,
    compiled: &Compiled,
    (inputs, count): (&[R], usize),
    before: &(Vec<R>, Vec<u32>),
    (settings, [dispatches, steps]): ([u32; SETTING_WORDS], [u32; 2]),
) -> Result<ChunkResult<R>> {
    let sizes = sizes(compiled, inputs, count)?;
    let (state, flags) = before;
    for (name, found, wanted) in
        [("state", size_of_val(&state[..]), sizes[0]), ("flags", size_of_val(&flags[..]), sizes[1])]
    {
        if found != wanted {
            return Err(Error::ShortBuffer { name, found, wanted });
        }
    }
    let buffers = device
        .checked("allocating buffers", || Buffers::new(device, compiled, inputs, Some(before), sizes))?;
    let steps = steps.min(most_steps(device, &compiled.kernel));
    let settings = Settings::new([count, compiled.words()[1]], steps, 0, settings);
    device.queue.write_buffer(&buffers.settings, 0, bytemuck::bytes_of(&settings));
    for _ in 0..dispatches {
        device.checked(&format!("dispatching the {} kernel", compiled.kernel.name), || {
            submit(device, compiled, &buffers, count);
        })?;
        device.wait()?;
    }
    result(device, &buffers, sizes, false)
}

/// The bytes of state and flags of so many instances.
fn sizes<R: Real>(compiled: &Compiled, inputs: &[R], count: usize) -> Result<[usize; 2]> {
    let [input_words, state_words, flag_words] = compiled.words().map(|words| words * room(count));
    if input_words != inputs.len() {
        return Err(Error::ShortBuffer { name: "inputs", found: inputs.len(), wanted: input_words });
    }
    Ok([state_words * size_of::<R>(), flag_words * 4])
}

/// What stands in the buffers.
fn result<R: Real>(
    device: &Device,
    buffers: &Buffers,
    sizes: [usize; 2],
    cancelled: bool,
) -> Result<ChunkResult<R>> {
    let [state, flags] = read(device, [&buffers.state, &buffers.flags], sizes)?;
    Ok(ChunkResult { state: cast(&state), flags: cast(&flags), cancelled })
}

/// The lengths of a result, and that no instance of it is unwritten unless it was cancelled.
///
/// # Errors
/// A short buffer, or the first unwritten instance of the chunk.
pub fn check<R>(result: &ChunkResult<R>, count: usize, [_, state, flags]: [usize; 3]) -> Result<()> {
    for (name, found, wanted) in [
        ("state", result.state.len(), state * room(count)),
        ("flags", result.flags.len(), flags * room(count)),
    ] {
        if found != wanted {
            return Err(Error::ShortBuffer { name, found, wanted });
        }
    }
    let is_known = |instance: &usize| {
        let code = result.flags[place([FLAG_STATUS, flags], *instance)];
        Status::from_code(code).is_some() || result.cancelled && code == Status::Unwritten as u32
    };
    match (0..count).find(|instance| !is_known(instance)) {
        Some(instance) => Err(Error::Unwritten { instance }),
        None => Ok(()),
    }
}

/// The buffers of a chunk.
struct Buffers {
    settings: wgpu::Buffer,
    state: wgpu::Buffer,
    flags: wgpu::Buffer,
    progress: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl Buffers {
    fn new<R: Real>(
        device: &Device,
        compiled: &Compiled,
        inputs: &[R],
        before: Option<&(Vec<R>, Vec<u32>)>,
        [state, flags]: [usize; 2],
    ) -> Buffers {
        use wgpu::BufferUsages as Usage;
        let buffer = |label, size: usize, usage| {
            device.raw.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: size as u64,
                usage,
                mapped_at_creation: false,
            })
        };
        let settings = buffer("settings", size_of::<Settings>(), Usage::UNIFORM | Usage::COPY_DST);
        let input = buffer("inputs", size_of_val(inputs), Usage::STORAGE | Usage::COPY_DST);
        device.queue.write_buffer(&input, 0, bytemuck::cast_slice(inputs));
        let state = buffer("state", state, Usage::STORAGE | Usage::COPY_SRC | Usage::COPY_DST);
        let flags = buffer("flags", flags, Usage::STORAGE | Usage::COPY_SRC | Usage::COPY_DST);
        if let Some((words, counters)) = before {
            device.queue.write_buffer(&state, 0, bytemuck::cast_slice(words));
            device.queue.write_buffer(&flags, 0, bytemuck::cast_slice(counters));
        }
        let progress = buffer("progress", PROGRESS_WORDS * 4, Usage::STORAGE | Usage::COPY_SRC);
        let bound = [&settings, &input, &state, &flags, &progress];
        let entries: Vec<wgpu::BindGroupEntry> = (0..)
            .zip(bound)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let group = device.raw.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(compiled.kernel.name),
            layout: &compiled.layout,
            entries: &entries,
        });
        Buffers { settings, state, flags, progress, group }
    }
}

/// Dispatches until every instance is finished or the run is cancelled; the number of the finished.
fn dispatch(
    device: &Device,
    compiled: &Compiled,
    buffers: &Buffers,
    count: usize,
    drive: &Drive,
) -> Result<usize> {
    let name = compiled.kernel.name;
    let most = most_steps(device, &compiled.kernel);
    let mut steps = FIRST.min(most);
    let mut finished = 0;
    for _ in 0..drive.most_dispatches {
        if drive.cancel.load(Ordering::Relaxed) {
            return Ok(finished);
        }
        let settings = Settings::new([count, compiled.words()[1]], steps, drive.offset, drive.settings);
        let began = Instant::now();
        device.checked(&format!("dispatching the {name} kernel"), || {
            device.queue.write_buffer(&buffers.settings, 0, bytemuck::bytes_of(&settings));
            submit(device, compiled, buffers, count);
        })?;
        device.wait()?;
        let elapsed = began.elapsed();
        let [words] = read(device, [&buffers.progress], [4])?;
        let done = cast::<u32>(&words).first().map_or(0, |done| *done as usize);
        if done > count || done < finished {
            return Err(Error::Miscounted { kernel: name, found: done, wanted: count });
        }
        (drive.progress)(done - finished);
        finished = done;
        if finished == count {
            return Ok(count);
        }
        steps = adapted(steps, elapsed).clamp(1, most);
    }
    Err(Error::Endless { kernel: name, finished, count, dispatches: drive.most_dispatches })
}

/// Most steps of a kernel in one dispatch.
#[must_use]
pub fn most_steps(device: &Device, kernel: &Kernel) -> u32 {
    let per_step = if device.is_software() { kernel.loops_per_step.max(1) } else { 1 };
    (MAX_LOOPS / per_step).max(1)
}

/// The steps that bring a dispatch of `steps` in `elapsed` to the time it aims at.
pub(super) fn adapted(steps: u32, elapsed: Duration) -> u32 {
    let factor = (AIM.as_secs_f64() / elapsed.as_secs_f64().max(1e-9)).min(GROWTH);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturates, and is not negative"
    )]
    let next = (f64::from(steps) * factor) as u32;
    next
}

/// One dispatch, in two dimensions when one cannot hold all workgroups.
fn submit(device: &Device, compiled: &Compiled, buffers: &Buffers, count: usize) {
    let (x, y) = workgroups(count, device.limits().max_compute_workgroups_per_dimension);
    let mut encoder = device.raw.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&compiled.pipeline);
        pass.set_bind_group(0, &buffers.group, &[]);
        pass.dispatch_workgroups(x, y, 1);
    }
    device.queue.submit([encoder.finish()]);
}

/// Workgroups in x and y that hold `count` invocations, at most `limit` in each.
#[must_use]
pub fn workgroups(count: usize, limit: u32) -> (u32, u32) {
    let groups = count.div_ceil(WORKGROUP_SIZE as usize);
    let groups = u32::try_from(groups).unwrap_or(u32::MAX).max(1);
    let rows = groups.div_ceil(limit.max(1));
    (groups.div_ceil(rows), rows)
}

/// The bytes of some buffers.
fn read<const N: usize>(
    device: &Device,
    sources: [&wgpu::Buffer; N],
    sizes: [usize; N],
) -> Result<[Vec<u8>; N]> {
    let staging = device.checked("reading back", || {
        let mut encoder = device.raw.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut copy = |source: &wgpu::Buffer, size: usize| {
            let buffer = device.raw.create_buffer(&wgpu::BufferDescriptor {
                label: Some("staging"),
                size: size as u64,
                usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            encoder.copy_buffer_to_buffer(source, 0, &buffer, 0, size as u64);
            buffer
        };
        let mut pairs = sources.into_iter().zip(sizes);
        let buffers: [Option<wgpu::Buffer>; N] =
            std::array::from_fn(|_| pairs.next().map(|(source, size)| copy(source, size)));
        device.queue.submit([encoder.finish()]);
        for buffer in buffers.iter().flatten() {
            buffer.map_async(wgpu::MapMode::Read, .., |_| {});
        }
        buffers
    })?;
    device.wait()?;
    let mut bytes = [const { Vec::new() }; N];
    for (bytes, buffer) in bytes.iter_mut().zip(staging.iter().flatten()) {
        let view = buffer
            .get_mapped_range(..)
            .map_err(|why| Error::Device { what: "reading back".to_owned(), why: why.to_string() })?;
        bytes.extend_from_slice(&view);
    }
    Ok(bytes)
}

/// Bytes as words.
fn cast<T: bytemuck::Pod>(bytes: &[u8]) -> Vec<T> {
    bytemuck::pod_collect_to_vec(bytes)
}
