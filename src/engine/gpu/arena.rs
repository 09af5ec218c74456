//! Lanes of a device: buffers that stay, and one dispatch at a time of every group of lanes that share a kernel.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::engine::error::{Error, Result};
use crate::engine::gpu::buffers::Buffers;
use crate::engine::gpu::chunks::Session;
use crate::engine::gpu::device::Device;
use crate::engine::gpu::run::{FIRST, adapted, most_steps, workgroups};
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::source::{PROGRESS_WORDS, SETTING_WORDS, Settings};
use crate::engine::march::marching::Form;
use crate::engine::march::round::{ALIGNED, Group, Lane, Round};

/// Buffers are made larger than they have to be by one part in so many.
const SPARE: usize = 4;

/// What is known of the time of a step is trusted less by this factor in each round.
const FORGOTTEN: f64 = 1.1;

/// Most steps of a round: a few times those of a stretch.
const MOST_STEPS: u32 = 1024;

/// Lanes on a device.
pub(super) struct Arena<R> {
    device: Device,
    /// None before the first round.
    buffers: Option<Buffers>,
    round: Round<R>,
    /// Steps of a dispatch.
    steps: u32,
    /// The time of a step of all lanes, s, as far as is known.
    step: f64,
    submitted: Option<(wgpu::SubmissionIndex, Instant)>,
    ready: Arc<AtomicBool>,
}

impl<R: Real> Arena<R> {
    /// On a device, without a lane.
    pub(super) fn new(device: &Device) -> Arena<R> {
        Arena {
            device: device.clone(),
            buffers: None,
            round: Round::new(),
            // A dispatch of a software driver ends with its stretches, however long that takes on cores that others use, too.
            steps: if device.is_software() { MOST_STEPS } else { FIRST },
            step: f64::INFINITY,
            submitted: None,
            ready: Arc::default(),
        }
    }

    /// Whether a round is under way.
    pub(super) fn is_busy(&self) -> bool {
        self.submitted.is_some()
    }

    /// Whether the round under way has come to its end, as far as is known.
    pub(super) fn is_ready(&self) -> bool {
        self.submitted.is_some() && self.ready.load(Ordering::Acquire)
    }

    /// Begins a round: every lane goes on for some steps. The lanes are sorted by their kernels.
    ///
    /// # Errors
    /// When the device fails or is lost.
    pub(super) fn submit<T: Sync>(
        &mut self,
        session: &mut Session,
        lanes: &mut [Box<Lane<R, T>>],
        settings: [u32; SETTING_WORDS],
    ) -> Result<()> {
        self.round.stage(lanes);
        let compiled: Vec<usize> =
            self.round.groups.iter().map(|group| compiled(session, group.form)).collect::<Result<_>>()?;
        let Round { inputs, state, flags, .. } = &self.round;
        let sizes = [size_of_val(&inputs[..]), size_of_val(&state[..]), size_of_val(&flags[..])];
        let buffers = match self.buffers.take().filter(|had| (0..3).all(|k| sizes[k] <= had.sizes[k])) {
            Some(large_enough) => large_enough,
            None => Buffers::new(&self.device, sizes.map(|size| size + size / SPARE))?,
        };
        let start = || self.start(&buffers, session, &compiled, settings);
        let index = self.device.checked("starting a round", start)??;
        self.buffers = Some(buffers);
        self.submitted = Some((index, Instant::now()));
        Ok(())
    }

    /// Sends what is staged, dispatches every group and asks for what comes of it.
    fn start(
        &self,
        buffers: &Buffers,
        session: &Session,
        compiled: &[usize],
        settings: [u32; SETTING_WORDS],
    ) -> Result<wgpu::SubmissionIndex> {
        let heads: Vec<u8> = self.round.groups.iter().flat_map(|group| self.head(group, settings)).collect();
        let sections: [(&[u8], &wgpu::Buffer); 4] = [
            (bytemuck::cast_slice(&self.round.inputs), &buffers.inputs),
            (bytemuck::cast_slice(&self.round.state), &buffers.state),
            (bytemuck::cast_slice(&self.round.flags), &buffers.flags),
            (&heads, &buffers.settings),
        ];
        let total = sections.iter().map(|(bytes, _)| bytes.len()).sum::<usize>();
        {
            let mut view = buffers.up.get_mapped_range_mut(..total as u64).map_err(|why| unmapped(&why))?;
            let mut at = 0;
            for (bytes, _) in sections {
                view.slice(at..at + bytes.len()).copy_from_slice(bytes);
                at += bytes.len();
            }
        }
        buffers.up.unmap();
        let mut encoder = self.device.raw.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut at = 0;
        for (bytes, buffer) in sections {
            encoder.copy_buffer_to_buffer(&buffers.up, at, buffer, 0, bytes.len() as u64);
            at += bytes.len() as u64;
        }
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            for (number, (group, compiled)) in self.round.groups.iter().zip(compiled).enumerate() {
                let compiled = session.at(*compiled);
                pass.set_pipeline(&compiled.pipeline);
                pass.set_bind_group(0, &self.bind(buffers, &compiled.layout, group, number), &[]);
                let most = self.device.limits().max_compute_workgroups_per_dimension;
                let (x, y) = workgroups(group.lanes, most);
                pass.dispatch_workgroups(x, y, 1);
            }
        }
        let [state, flags] = [sections[1].0.len() as u64, sections[2].0.len() as u64];
        encoder.copy_buffer_to_buffer(&buffers.state, 0, &buffers.back, 0, state);
        encoder.copy_buffer_to_buffer(&buffers.flags, 0, &buffers.back, state, flags);
        let index = self.device.queue.submit([encoder.finish()]);
        self.ready.store(false, Ordering::Release);
        let ready = Arc::clone(&self.ready);
        buffers.up.map_async(wgpu::MapMode::Write, .., |_| {});
        buffers
            .back
            .map_async(wgpu::MapMode::Read, ..state + flags, move |_| ready.store(true, Ordering::Release));
        self.device.meter.carry(total, sections[1].0.len() + sections[2].0.len());
        Ok(index)
    }

    /// The settings of a group, with what lies between them and the next.
    fn head(&self, group: &Group, settings: [u32; SETTING_WORDS]) -> Vec<u8> {
        let steps =
            self.steps.min(group.form.kernel().map_or(1, |(kernel, _)| most_steps(&self.device, kernel)));
        group.head(steps, settings)
    }

    /// The buffers bound for a group.
    fn bind(
        &self,
        buffers: &Buffers,
        layout: &wgpu::BindGroupLayout,
        group: &Group,
        number: usize,
    ) -> wgpu::BindGroup {
        let part = |buffer, first: usize, words: usize, size: usize| wgpu::BufferBinding {
            buffer,
            offset: (first * size) as u64,
            size: std::num::NonZeroU64::new((words * size) as u64),
        };
        let [inputs, state, flags] = group.words();
        let scalar = size_of::<R>();
        let bound = [
            part(&buffers.settings, number * ALIGNED, size_of::<Settings>(), 1),
            part(&buffers.inputs, group.first[0], inputs, scalar),
            part(&buffers.state, group.first[1], state, scalar),
            part(&buffers.flags, group.first[2], flags, size_of::<u32>()),
            part(&buffers.progress, 0, PROGRESS_WORDS, size_of::<u32>()),
        ];
        let entry =
            |(binding, part)| wgpu::BindGroupEntry { binding, resource: wgpu::BindingResource::Buffer(part) };
        let entries: Vec<wgpu::BindGroupEntry> = (0..).zip(bound).map(entry).collect();
        self.device.raw.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout,
            entries: &entries,
        })
    }

    /// Waits for the end of the round under way and gives every lane to `take`, with the steps that it has gone.
    ///
    /// # Errors
    /// When the device is lost or does not answer; the first of `take`.
    pub(super) fn collect<T: Send>(
        &mut self,
        lanes: &mut [Box<Lane<R, T>>],
        take: impl Fn(&mut Lane<R, T>, u32) -> Result<()> + Sync,
    ) -> Result<()> {
        let (Some((index, began)), Some(buffers)) = (self.submitted.take(), &self.buffers) else {
            return Ok(());
        };
        self.device.wait_for(index)?;
        let bytes = size_of_val(&self.round.state[..]);
        let all = bytes + size_of_val(&self.round.flags[..]);
        let (taken, ended) = {
            let view = buffers.back.get_mapped_range(..all as u64).map_err(|why| unmapped(&why))?;
            let words = (bytemuck::cast_slice(&view[..bytes]), bytemuck::cast_slice(&view[bytes..]));
            self.round.collect(lanes, words, take)
        };
        self.device.meter.step(taken.steps, taken.of_warps);
        buffers.back.unmap();
        // A host that is busy elsewhere comes late, and a device may have waited for another arena: the shortest time counts,
        // and is forgotten by and by.
        if self.device.is_software() {
            return ended;
        }
        let step = began.elapsed().as_secs_f64() / f64::from(self.steps);
        self.step = step.min(self.step * FORGOTTEN);
        self.steps = adapted(self.steps, Duration::from_secs_f64(self.step * f64::from(self.steps)));
        self.steps = self.steps.clamp(1, MOST_STEPS);
        ended
    }
}

/// The place of the kernel of a form.
fn compiled(session: &mut Session, form: Form) -> Result<usize> {
    let (kernel, choices) = form.kernel().ok_or(Error::Unwritten { instance: 0 })?;
    session.compiled(kernel, &choices)
}

/// The error of a buffer that is not mapped.
fn unmapped(why: &wgpu::MapRangeError) -> Error {
    Error::Device { what: "reading and writing buffers".to_owned(), why: why.to_string() }
}
