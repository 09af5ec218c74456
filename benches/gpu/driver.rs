//! What a Vulkan driver says of a pipeline that it has compiled, whether there is a card or not.
//!
//! A process of its own: which driver the loader finds is said by the environment, and a driver that fails takes no other
//! with it. It prints the device and the version of its driver, then each statistic and its value: a line each, with a tab between.

#![expect(unsafe_code, reason = "Vulkan as the driver has it: wgpu opens no device without a card behind it")]

use std::error::Error;
use std::ffi::CStr;
use std::path::Path;

use ash::vk;
use squealmap::engine::kernel::source::BINDINGS;

/// Prints what the first device of the environment makes of a file of SPIR-V.
pub(crate) fn print(spirv: &Path) -> Result<(), Box<dyn Error>> {
    let words = ash::util::read_spv(&mut std::fs::File::open(spirv)?)?;
    // SAFETY: every handle comes from the call before it and lives until this process ends, as do the arrays that the
    // structures point to until the call that takes them has returned.
    unsafe { print_of(&words) }
}

/// As [`print`].
///
/// # Safety
/// The words have to be a valid module with the entry point `main` and the bindings of the kernels.
unsafe fn print_of(words: &[u32]) -> Result<(), Box<dyn Error>> {
    // SAFETY: as said above.
    unsafe {
        let entry = ash::Entry::load()?;
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_2);
        let instance =
            entry.create_instance(&vk::InstanceCreateInfo::default().application_info(&application), None)?;
        let physical = *instance.enumerate_physical_devices()?.first().ok_or("no device")?;
        let mut driver = vk::PhysicalDeviceDriverProperties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
        instance.get_physical_device_properties2(physical, &mut properties);
        let name = properties.properties.device_name_as_c_str()?.to_string_lossy().into_owned();
        println!("{name}\t{}", driver.driver_info_as_c_str()?.to_string_lossy());

        let queue = [vk::DeviceQueueCreateInfo::default().queue_priorities(&[1.0])];
        let extensions = [ash::khr::pipeline_executable_properties::NAME.as_ptr()];
        let features = instance.get_physical_device_features(physical);
        let mut statistics = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default()
            .pipeline_executable_info(true);
        let device = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queue)
            .enabled_extension_names(&extensions)
            .enabled_features(&features)
            .push_next(&mut statistics);
        let device = instance.create_device(physical, &device, None)?;

        let module = device.create_shader_module(&vk::ShaderModuleCreateInfo::default().code(words), None)?;
        let bindings: Vec<_> = (0..).take(BINDINGS.len()).map(binding).collect();
        let layout = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        let layouts = [device.create_descriptor_set_layout(&layout, None)?];
        let layout = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts);
        let layout = device.create_pipeline_layout(&layout, None)?;
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module)
            .name(c"main");
        let pipeline = vk::ComputePipelineCreateInfo::default()
            .flags(vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR)
            .stage(stage)
            .layout(layout);
        let pipelines = device
            .create_compute_pipelines(vk::PipelineCache::null(), &[pipeline], None)
            .map_err(|(_, why)| why)?;

        let told = ash::khr::pipeline_executable_properties::Device::new(&instance, &device);
        let info = vk::PipelineInfoKHR::default().pipeline(pipelines[0]);
        let executables = told.get_pipeline_executable_properties(&info)?;
        println!("Subgroup size\t{}", executables.first().ok_or("nothing was compiled")?.subgroup_size);
        let info = vk::PipelineExecutableInfoKHR::default().pipeline(pipelines[0]);
        for statistic in told.get_pipeline_executable_statistics(&info)? {
            let name = CStr::from_ptr(statistic.name.as_ptr()).to_string_lossy();
            println!("{name}\t{}", value(&statistic));
        }
    }
    Ok(())
}

/// One binding of the kernels: the settings, or a buffer.
fn binding(number: u32) -> vk::DescriptorSetLayoutBinding<'static> {
    let kind =
        if number == 0 { vk::DescriptorType::UNIFORM_BUFFER } else { vk::DescriptorType::STORAGE_BUFFER };
    vk::DescriptorSetLayoutBinding::default()
        .binding(number)
        .descriptor_type(kind)
        .descriptor_count(1)
        .stage_flags(vk::ShaderStageFlags::COMPUTE)
}

/// The number of a statistic.
fn value(statistic: &vk::PipelineExecutableStatisticKHR) -> f64 {
    let number = statistic.value;
    // SAFETY: the format says which of the four was written.
    unsafe {
        match statistic.format {
            vk::PipelineExecutableStatisticFormatKHR::BOOL32 => f64::from(number.b32),
            vk::PipelineExecutableStatisticFormatKHR::INT64 => number.i64 as f64,
            vk::PipelineExecutableStatisticFormatKHR::UINT64 => number.u64 as f64,
            _ => number.f64,
        }
    }
}
