//! A strict kernel handed to the driver: the one place without wgpu's own checks, and why that is sound.

use crate::engine::gpu::device::Device;
use crate::engine::kernel::source::WORKGROUP_SIZE;
use crate::engine::kernel::spirv::Strict;

/// The shader module of a strict kernel. The device must be strict; errors go to its error scopes.
#[expect(unsafe_code, reason = "wgpu takes SPIR-V, the only form that can be strict, unseen")]
pub(super) fn module(device: &Device, name: &str, kernel: &Strict) -> wgpu::ShaderModule {
    let workgroup_size = (WORKGROUP_SIZE, 1, 1);
    let entries = [wgpu::PassthroughShaderEntryPoint { name: "main".into(), workgroup_size }];
    let descriptor = wgpu::ShaderModuleDescriptorPassthrough {
        label: Some(name),
        entry_points: entries.as_slice().into(),
        spirv: Some(kernel.words().into()),
        ..wgpu::ShaderModuleDescriptorPassthrough::default()
    };
    // SAFETY: what wgpu leaves unchecked here is that the module is valid and stays inside its buffers. A
    // `Strict` can only be made from WGSL that naga has parsed, validated and written, as wgpu would have had
    // it do, with every index into arrays and buffers clamped and every loop bounded. The decorations that are
    // added change how sums are rounded: no instruction, no type, no access to memory. That the buffers bound
    // to it are large enough to clamp to is in the layout of `Compiled`, which wgpu checks.
    unsafe { device.raw.create_shader_module_passthrough(descriptor) }
}
