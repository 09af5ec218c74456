//! Lanes of a device: buffers that stay, and one dispatch at a time of every group of lanes that share a kernel.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use rayon::prelude::*;

use crate::engine::error::{Error, Result};
use crate::engine::gpu::buffers::{ALIGNED, Buffers};
use crate::engine::gpu::chunks::Session;
use crate::engine::gpu::columns::{fill, length, row};
use crate::engine::gpu::device::Device;
use crate::engine::gpu::meter::WARP;
use crate::engine::gpu::run::{FIRST, adapted, most_steps, workgroups};
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::source::{FLAG_STATUS, FLAG_STEPS, PROGRESS_WORDS, SETTING_WORDS, Settings};
use crate::engine::lanes::job::Part;
use crate::engine::march::marching::Form;
use crate::engine::march::table::{flag, state};
use crate::engine::march::words::Words;
use crate::model::piece::LawForm;
use crate::model::status::Status;

/// Buffers are made larger than they have to be by one part in so many.
const SPARE: usize = 4;

/// What is known of the time of a step is trusted less by this factor in each round.
const FORGOTTEN: f64 = 1.1;

/// Most steps of a round: a few times those of a stretch.
const MOST_STEPS: u32 = 1024;

/// Words of a lane, and where it is in the present round.
#[derive(Clone, Debug)]
pub(super) struct Lane<R, T> {
    /// What selects its kernel.
    pub(super) form: Form,
    /// Its words: what is sent, then what has come back.
    pub(super) words: Words<R>,
    /// Something to remember with it.
    pub(super) memory: T,
    /// Steps of the stretch before the present round.
    steps: u32,
    before: u32,
    /// Its group, and its place in that.
    at: [usize; 2],
}

impl<R: Real, T> Lane<R, T> {
    /// A lane whose words are still to be filled, for [`Lane::begin`].
    pub(super) fn new(memory: T) -> Lane<R, T> {
        let form = Form { part: Part::Growth, law: LawForm::Pieces, pieces: 1, ramp: false };
        Lane { form, words: Words::blank(), memory, steps: 0, before: 0, at: [0; 2] }
    }

    /// Begins the stretch that its words are.
    pub(super) fn begin(&mut self, form: Form) {
        self.before = if form.part == self.form.part { self.steps } else { 0 };
        (self.form, self.steps) = (form, 0);
    }

    /// Steps of the stretch before, where it was of the same part.
    pub(super) fn before(&self) -> u32 {
        self.before
    }
}

/// Lanes that share a kernel: where their words begin in each buffer, in words of that.
struct Group {
    form: Form,
    lanes: usize,
    /// The number of its first warp.
    warp: usize,
    inputs: usize,
    state: usize,
    flags: usize,
    /// Words of a lane in each buffer.
    each: [usize; 3],
}

/// Lanes on a device.
pub(super) struct Arena<R> {
    device: Device,
    /// None before the first round.
    buffers: Option<Buffers>,
    /// What goes to the device, on the host.
    staged_inputs: Vec<R>,
    staged_state: Vec<R>,
    staged_flags: Vec<u32>,
    groups: Vec<Group>,
    /// Steps of a dispatch.
    steps: u32,
    /// The time of a step of all lanes, s, as far as is known.
    step: f64,
    submitted: Option<(wgpu::SubmissionIndex, Instant)>,
    ready: Arc<AtomicBool>,
}

/// The next multiple of [`ALIGNED`] bytes.
fn aligned<T>(count: usize) -> usize {
    count.next_multiple_of(ALIGNED / size_of::<T>())
}

impl<R: Real> Arena<R> {
    /// On a device, without a lane.
    pub(super) fn new(device: &Device) -> Arena<R> {
        Arena {
            device: device.clone(),
            buffers: None,
            staged_inputs: Vec::new(),
            staged_state: Vec::new(),
            staged_flags: Vec::new(),
            groups: Vec::new(),
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
        let [inputs, state, flags] = self.place(lanes);
        self.staged_inputs.resize(inputs, R::ZERO);
        self.staged_state.resize(state, R::ZERO);
        self.staged_flags.resize(flags, 0);
        let mut first = 0;
        for group in &self.groups {
            let of = |index: usize| &lanes[first + index].words;
            let ([inputs, state, flags], size) = (group.words(), [group.length(), group.lanes]);
            fill(&mut self.staged_inputs[group.inputs..][..inputs], size, |index| &of(index).inputs[..]);
            fill(&mut self.staged_state[group.state..][..state], size, |index| &of(index).state[..]);
            let flags = &mut self.staged_flags[group.flags..][..flags];
            fill(flags, size, |index| &of(index).flags[..]);
            // What is no lane has ended.
            flags[FLAG_STATUS * size[0]..][..size[0]][size[1]..].fill(Status::Ok as u32);
            first += size[1];
        }
        let compiled: Vec<usize> =
            self.groups.iter().map(|group| compiled(session, group.form)).collect::<Result<_>>()?;
        let sizes = [inputs * size_of::<R>(), state * size_of::<R>(), flags * size_of::<u32>()];
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

    /// Gives every lane its place; how many words of each buffer there are.
    fn place<T>(&mut self, lanes: &mut [Box<Lane<R, T>>]) -> [usize; 3] {
        self.groups.clear();
        let mut next = [0; 3];
        for lane in lanes {
            if self.groups.last().is_none_or(|group| group.form != lane.form) {
                next = self.groups.last().map_or([0; 3], Group::end::<R>);
                let [inputs, state, flags] = next;
                let warp = self.groups.last().map_or(0, |last| last.warp + last.lanes.div_ceil(WARP));
                let (form, of_state) = (lane.form, state::words_of(lane.form.part));
                let each = [form.inputs(), of_state, flag::WORDS];
                self.groups.push(Group { form, lanes: 0, warp, inputs, state, flags, each });
            }
            let number = self.groups.len() - 1;
            let group = &mut self.groups[number];
            lane.at = [number, group.lanes];
            group.lanes += 1;
        }
        self.groups.last().map_or(next, Group::end::<R>)
    }

    /// Sends what is staged, dispatches every group and asks for what comes of it.
    fn start(
        &self,
        buffers: &Buffers,
        session: &Session,
        compiled: &[usize],
        settings: [u32; SETTING_WORDS],
    ) -> Result<wgpu::SubmissionIndex> {
        let heads: Vec<u8> = self.groups.iter().flat_map(|group| self.head(group, settings)).collect();
        let sections: [(&[u8], &wgpu::Buffer); 4] = [
            (bytemuck::cast_slice(&self.staged_inputs), &buffers.inputs),
            (bytemuck::cast_slice(&self.staged_state), &buffers.state),
            (bytemuck::cast_slice(&self.staged_flags), &buffers.flags),
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
            for (number, (group, compiled)) in self.groups.iter().zip(compiled).enumerate() {
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
        #[expect(clippy::cast_possible_truncation, reason = "a round has less than 2^32 lanes")]
        let head = Settings::new(group.length() as u32, steps, 0, settings);
        let mut bytes = bytemuck::bytes_of(&head).to_vec();
        bytes.resize(ALIGNED, 0);
        bytes
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
            part(&buffers.inputs, group.inputs, inputs, scalar),
            part(&buffers.state, group.state, state, scalar),
            part(&buffers.flags, group.flags, flags, size_of::<u32>()),
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
        let [_, state, flags] = self.groups.last().map_or([0; 3], Group::end::<R>);
        let bytes = state * size_of::<R>();
        let ended = {
            let view =
                buffers.back.get_mapped_range(..(bytes + flags * 4) as u64).map_err(|why| unmapped(&why))?;
            let (all_state, all_flags): (&[R], &[u32]) =
                (bytemuck::cast_slice(&view[..bytes]), bytemuck::cast_slice(&view[bytes..]));
            let most: Vec<AtomicU32> =
                (0..lanes.len() / WARP + self.groups.len()).map(|_| AtomicU32::new(0)).collect();
            let taken = AtomicU64::new(0);
            let ended = lanes.par_iter_mut().try_for_each(|lane| {
                let [group, at] = lane.at;
                let warp = &most[self.groups[group].warp + at / WARP];
                let group = &self.groups[group];
                let [_, state, flags] = group.words();
                let length = group.length();
                let used = state / length;
                row(&mut lane.words.state[..used], &all_state[group.state..][..state], length, at);
                row(&mut lane.words.flags, &all_flags[group.flags..][..flags], length, at);
                let steps = lane.words.flags[FLAG_STEPS].saturating_sub(lane.steps);
                warp.fetch_max(steps, Ordering::Relaxed);
                taken.fetch_add(u64::from(steps), Ordering::Relaxed);
                lane.steps += steps;
                take(lane, steps)
            });
            let of_warps = most.iter().map(|most| u64::from(most.load(Ordering::Relaxed))).sum::<u64>();
            self.device.meter.step(taken.into_inner(), WARP as u64 * of_warps);
            ended
        };
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

impl Group {
    /// The length of its columns.
    fn length(&self) -> usize {
        length(self.lanes)
    }

    /// Its words of each buffer.
    fn words(&self) -> [usize; 3] {
        self.each.map(|words| words * self.length())
    }

    /// Where the next group begins.
    fn end<R>(&self) -> [usize; 3] {
        let [inputs, state, flags] = self.words();
        [
            aligned::<R>(self.inputs + inputs),
            aligned::<R>(self.state + state),
            aligned::<u32>(self.flags + flags),
        ]
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
