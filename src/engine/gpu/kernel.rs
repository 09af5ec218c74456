//! A kernel compiled for a device and a scalar, and the buffers of one chunk bound to it.

use std::num::NonZeroU64;

use crate::engine::error::{Error, Result};
use crate::engine::fields::words;
use crate::engine::gpu::device::Device;
use crate::engine::gpu::strict;
use crate::engine::kernel::source::{BINDINGS, Constant, Kernel, Settings};
use crate::engine::kernel::spirv::Strict;

/// A kernel ready to be dispatched; clones are the same kernel.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// The kernel that it was compiled from.
    pub kernel: Kernel,
    pub(super) pipeline: wgpu::ComputePipeline,
    pub(super) layout: wgpu::BindGroupLayout,
}

impl Compiled {
    /// Compiles a kernel for the device's scalar; `choices` are constants that the scene selects.
    ///
    /// # Errors
    /// When the device rejects it.
    pub fn new(device: &Device, kernel: &Kernel, choices: &[(&str, Constant)]) -> Result<Compiled> {
        Compiled::from_source(device, kernel, &kernel.source(device.precision(), choices))
    }

    /// Compiles a text with the bindings and words of `kernel`, e.g. a probe of its functions.
    ///
    /// # Errors
    /// When the device rejects it.
    pub fn from_source(device: &Device, kernel: &Kernel, source: &str) -> Result<Compiled> {
        let what = format!("compiling the {} kernel", kernel.name);
        let strict = if device.strict() {
            let module = Strict::new(source, device.precision());
            Some(module.map_err(|why| Error::Device { what: what.clone(), why })?)
        } else {
            None
        };
        let (pipeline, layout) = device.checked(&what, || {
            let module = match &strict {
                Some(module) => strict::module(device, kernel.name, module),
                None => device.raw.create_shader_module(wgpu::ShaderModuleDescriptor {
                    label: Some(kernel.name),
                    source: wgpu::ShaderSource::Wgsl(source.into()),
                }),
            };
            pipeline(device, kernel, &module)
        })?;
        Ok(Compiled { kernel: *kernel, pipeline, layout })
    }

    /// Words per instance of the bindings `inputs`, `state` and `flags`.
    #[must_use]
    pub fn words(&self) -> [usize; 3] {
        [words(self.kernel.inputs), words(self.kernel.state), words(self.kernel.flags)]
    }
}

/// The pipeline of a module, with the layout of the contract.
fn pipeline(
    device: &Device,
    kernel: &Kernel,
    module: &wgpu::ShaderModule,
) -> (wgpu::ComputePipeline, wgpu::BindGroupLayout) {
    let scalar = device.precision().bytes();
    let least: [usize; BINDINGS.len()] =
        [size_of::<Settings>(), scalar, scalar, size_of::<u32>(), size_of::<u32>()];
    let entries: Vec<wgpu::BindGroupLayoutEntry> =
        (0..).zip(least).map(|(binding, least)| entry(binding, least)).collect();
    let layout = device.raw.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(kernel.name),
        entries: &entries,
    });
    let pipeline_layout = device.raw.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(kernel.name),
        bind_group_layouts: &[Some(&layout)],
        immediate_size: 0,
    });
    let pipeline = device.raw.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(kernel.name),
        layout: Some(&pipeline_layout),
        module,
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    (pipeline, layout)
}

/// One binding of the contract, of at least so many bytes.
fn entry(binding: u32, least: usize) -> wgpu::BindGroupLayoutEntry {
    let ty = match binding {
        0 => wgpu::BufferBindingType::Uniform,
        1 => wgpu::BufferBindingType::Storage { read_only: true },
        _ => wgpu::BufferBindingType::Storage { read_only: false },
    };
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset: false,
            min_binding_size: NonZeroU64::new(least as u64),
        },
        count: None,
    }
}
