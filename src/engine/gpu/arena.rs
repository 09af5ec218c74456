//! Lanes of a device: buffers that stay, and one dispatch at a time of every part of a run for every group of lanes that share
//! their kernels.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::engine::error::{Error, Result};
use crate::engine::gpu::buffers::{Buffers, write};
use crate::engine::gpu::chunks::Session;
use crate::engine::gpu::clock::{Clock, MOMENTS};
use crate::engine::gpu::device::Device;
use crate::engine::gpu::kernel::Compiled;
use crate::engine::gpu::run::{FIRST, adapted, most_steps, workgroups};
use crate::engine::kernel::source::{PROGRESS_WORDS, SETTING_WORDS, Settings};
use crate::engine::lanes::Lanes;
use crate::engine::march::asked::Asked;
use crate::engine::march::flow::Flow;
use crate::engine::march::kernel::kernel_for;
use crate::engine::march::lane::Lane;
use crate::engine::march::marching::{Form, PARTS};
use crate::engine::march::round::{ALIGNED, Group, Round};

/// Buffers are made larger than they have to be by one part in so many.
const SPARE: usize = 16;

/// What is known of the time of a step is trusted less by this factor in each round.
const FORGOTTEN: f64 = 1.1;

/// Most steps of a part of a run in a round: more than most take of any.
const MOST_STEPS: u32 = 2048;

/// Lanes on a device.
#[derive(Debug)]
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
    clock: Option<Clock>,
    /// How many of the buffers of the round under way the host may read and write again.
    mapped: Arc<AtomicUsize>,
}

impl<R: Lanes> Arena<R> {
    /// On a device, without a lane.
    pub(super) fn new(device: &Device) -> Arena<R> {
        Arena {
            device: device.clone(),
            buffers: None,
            round: Round::new(false),
            // A dispatch of a software driver takes what it takes, on cores that others use, too.
            steps: if device.is_software() { MOST_STEPS } else { FIRST },
            step: f64::INFINITY,
            submitted: None,
            clock: Clock::new(device),
            mapped: Arc::default(),
        }
    }

    /// Waits for the end of the round under way. What is wrong with its device comes to light in [`Arena::collect`].
    pub(super) fn wait(&self) {
        let Some((index, began)) = &self.submitted else { return };
        let mut waits = self.device.wait_for(index.clone());
        // Both, that which is sent and that which comes back; another thread may be about to tell of them.
        while waits.is_ok() && self.mapped.load(Ordering::Acquire) < 2 {
            waits = self.device.listen(began.elapsed());
            std::thread::yield_now();
        }
    }

    /// Begins a round: every lane goes on for some steps. The lanes are sorted by their kernels.
    ///
    /// # Errors
    /// When the device fails or is lost.
    pub(super) fn submit(
        &mut self,
        session: &Mutex<&mut Session>,
        lanes: &mut [Lane<R>],
        settings: [u32; SETTING_WORDS],
    ) -> Result<()> {
        self.round.place(lanes);
        let kernels = {
            let mut session = session.lock().unwrap_or_else(PoisonError::into_inner);
            let groups = self.round.groups.iter();
            groups.map(|group| compiled(&mut session, group.form)).collect::<Result<Vec<_>>>()?
        };
        let [inputs, state, flags] = self.round.words();
        let sizes = [inputs * size_of::<R>(), state * size_of::<R>(), flags * size_of::<u32>()];
        let buffers = match self.buffers.take().filter(|had| (0..3).all(|k| sizes[k] <= had.sizes[k])) {
            Some(large_enough) => large_enough,
            None => Buffers::new(&self.device, sizes.map(|size| size + size / SPARE))?,
        };
        let start = || self.start(&buffers, lanes, &kernels, settings);
        let index = self.device.checked("starting a round", start)??;
        self.buffers = Some(buffers);
        self.submitted = Some((index, Instant::now()));
        Ok(())
    }

    /// Sends the words of the lanes, dispatches the parts of a run of every group and asks for what comes of them.
    fn start(
        &self,
        buffers: &Buffers,
        lanes: &[Lane<R>],
        kernels: &[Vec<Compiled>],
        settings: [u32; SETTING_WORDS],
    ) -> Result<wgpu::SubmissionIndex> {
        let groups = &self.round.groups;
        let heads: Vec<u8> = groups.iter().flat_map(|group| self.head(group, settings)).collect();
        let begins = self.round.begins_sent();
        let [.., of_heads] = begins;
        let total = of_heads + heads.len();
        {
            let mut view = buffers.up.get_mapped_range_mut(..total as u64).map_err(|why| unmapped(&why))?;
            let mut put = |at: usize, part: &[u8]| write(view.slice(at..at + part.len()), part);
            self.round.send(lanes, &mut put);
            put(of_heads, &heads);
        }
        buffers.up.unmap();
        let mut encoder = self.device.raw.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let targets =
            [(&buffers.inputs, size_of::<R>()), (&buffers.state, size_of::<R>()), (&buffers.flags, 4)];
        for (k, (buffer, size)) in targets.into_iter().enumerate() {
            for group in groups {
                let places = [group.sent[k], group.first[k], group.words_sent()[k]];
                let [from, to, sent] = places.map(|count| (count * size) as u64);
                if sent > 0 {
                    encoder.copy_buffer_to_buffer(&buffers.up, begins[k] as u64 + from, buffer, to, sent);
                }
            }
        }
        encoder.copy_buffer_to_buffer(&buffers.up, of_heads as u64, &buffers.settings, 0, heads.len() as u64);
        {
            let timestamp_writes = self.clock.as_ref().map(Clock::writes);
            let mut pass =
                encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: None, timestamp_writes });
            for part in 0..PARTS.len() {
                for (number, (group, kernels)) in groups.iter().zip(kernels).enumerate() {
                    let compiled = &kernels[part];
                    pass.set_pipeline(&compiled.pipeline);
                    pass.set_bind_group(0, &self.bind(buffers, &compiled.layout, group, number), &[]);
                    let most = self.device.limits().max_compute_workgroups_per_dimension;
                    let (x, y) = workgroups(group.lanes, most);
                    pass.dispatch_workgroups(x, y, 1);
                }
            }
        }
        let [state, flags] = self.back();
        encoder.copy_buffer_to_buffer(&buffers.state, 0, &buffers.back, 0, state);
        encoder.copy_buffer_to_buffer(&buffers.flags, 0, &buffers.back, state, flags);
        let mut all = state + flags;
        if let Some(clock) = &self.clock {
            clock.read(&mut encoder, &buffers.back, all);
            all += MOMENTS;
        }
        let index = self.device.queue.submit([encoder.finish()]);
        self.mapped.store(0, Ordering::Release);
        let tell = || {
            let mapped = Arc::clone(&self.mapped);
            move |_| {
                mapped.fetch_add(1, Ordering::AcqRel);
            }
        };
        buffers.up.map_async(wgpu::MapMode::Write, .., tell());
        buffers.back.map_async(wgpu::MapMode::Read, ..all, tell());
        #[expect(clippy::cast_possible_truncation, reason = "it was a size")]
        self.device.meter.carry(total, (state + flags) as usize);
        Ok(index)
    }

    /// Bytes of the state and of the flags that come back.
    fn back(&self) -> [u64; 2] {
        let [_, state, flags] = self.round.words();
        [state * size_of::<R>(), flags * size_of::<u32>()].map(|size| size as u64)
    }

    /// The settings of a group, with what lies between them and the next.
    fn head(&self, group: &Group, settings: [u32; SETTING_WORDS]) -> Vec<u8> {
        let most = kernel_for(group.form.pieces).map_or(1, |(kernel, _)| most_steps(&self.device, kernel));
        group.head(self.steps.min(most), settings)
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

    /// Takes the end of the round that was under way, and gives every lane what has come of it.
    ///
    /// # Errors
    /// When the device was lost or does not answer; the first of [`Flow::take`].
    pub(super) fn collect(&mut self, lanes: &mut [Lane<R>], flow: &Flow<R>, asked: &Asked) -> Result<()> {
        let (Some((index, began)), Some(buffers)) = (self.submitted.take(), &self.buffers) else {
            return Ok(());
        };
        self.device.wait_for(index)?;
        // A host that is busy elsewhere comes late: the clock of the device knows better, where it has one.
        let mut elapsed = began.elapsed();
        let [state, flags] = self.back();
        let (steps, ended) = {
            let all = state + flags + if self.clock.is_some() { MOMENTS } else { 0 };
            let view = buffers.back.get_mapped_range(..all).map_err(|why| unmapped(&why))?;
            let [_, of_state, of_flags] = self.round.words();
            let (state, others) = view.split_at(size_of::<R>() * of_state);
            let (flags, moments) = others.split_at(size_of::<u32>() * of_flags);
            if let Some(clock) = &self.clock {
                let computed = clock.between(moments);
                self.device.meter.compute(computed);
                elapsed = Duration::from_secs_f64(1e-9 * computed);
            }
            let words = (bytemuck::cast_slice(state), bytemuck::cast_slice(flags));
            self.round.collect(lanes, words, flow, asked)
        };
        self.device.meter.step(steps.gone, steps.of_warps);
        buffers.back.unmap();
        // A device may have waited for another arena: the shortest time counts, and is forgotten by and by.
        if self.device.is_software() {
            return ended;
        }
        let step = elapsed.as_secs_f64() / f64::from(self.steps);
        self.step = step.min(self.step * FORGOTTEN);
        self.steps = adapted(self.steps, Duration::from_secs_f64(self.step * f64::from(self.steps)));
        self.steps = self.steps.clamp(1, MOST_STEPS);
        ended
    }
}

/// The kernels of a form, one for each part of a run.
fn compiled(session: &mut Session, form: Form) -> Result<Vec<Compiled>> {
    let kernel = |part| {
        let (kernel, choices) = form.kernel(part).ok_or(Error::Unwritten { instance: 0 })?;
        let place = session.compiled(kernel, &choices)?;
        Ok(session.at(place).clone())
    };
    PARTS.into_iter().map(kernel).collect()
}

/// The error of a buffer that is not mapped.
fn unmapped(why: &wgpu::MapRangeError) -> Error {
    Error::Device { what: "reading and writing buffers".to_owned(), why: why.to_string() }
}
