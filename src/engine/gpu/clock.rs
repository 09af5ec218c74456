//! The clock of a device: how long it computes in a round.

use crate::engine::gpu::device::Device;

/// Bytes of a moment, and of both of a round.
const MOMENT: u64 = 8;
pub(super) const MOMENTS: u64 = 2 * MOMENT;

/// The moments at which a round begins and ends.
#[derive(Debug)]
pub(super) struct Clock {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    /// Nanoseconds of a tick.
    tick: f64,
}

impl Clock {
    /// Of a device; `None` where it has none.
    pub(super) fn new(device: &Device) -> Option<Clock> {
        if !device.raw.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        let queries = device.raw.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("clock"),
            ty: wgpu::QueryType::Timestamp,
            count: 2,
        });
        let resolved = device.raw.create_buffer(&wgpu::BufferDescriptor {
            label: Some("clock"),
            size: MOMENTS,
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        Some(Clock { queries, resolved, tick: f64::from(device.queue.get_timestamp_period()) })
    }

    /// What a pass is given whose time is wanted.
    pub(super) fn writes(&self) -> wgpu::ComputePassTimestampWrites<'_> {
        wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        }
    }

    /// Has both moments written into a buffer.
    pub(super) fn read(&self, encoder: &mut wgpu::CommandEncoder, buffer: &wgpu::Buffer, at: u64) {
        encoder.resolve_query_set(&self.queries, 0..2, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, buffer, at, MOMENTS);
    }

    /// The time between two moments, ns; 0 where the clock went back.
    pub(super) fn between(&self, moments: &[u8]) -> f64 {
        let moments: Vec<u64> = bytemuck::pod_collect_to_vec(moments);
        match moments[..] {
            [begin, end] => end.saturating_sub(begin) as f64 * self.tick,
            _ => 0.0,
        }
    }
}
