//! Which adapters there are, what they can do, and which one is taken.

use std::fmt;

use crate::engine::error::{Error, Result};
use crate::engine::gpu::arithmetic::Arithmetic;
use crate::engine::precision::Precision;

/// The APIs in use; with GL, "no Vulkan" would silently become a slow software device.
const BACKENDS: wgpu::Backends =
    wgpu::Backends::VULKAN.union(wgpu::Backends::METAL).union(wgpu::Backends::DX12);

/// Says what to install where no adapter is found.
pub const MISSING_DRIVER: &str = if cfg!(all(target_os = "linux", target_feature = "crt-static")) {
    "this program is linked statically and can load no driver: take the one built for x86_64-unknown-linux-gnu"
} else if cfg!(target_os = "linux") {
    "install the Vulkan loader and a driver (Debian and Ubuntu: libvulkan1, and mesa-vulkan-drivers or the vendor's driver)"
} else if cfg!(target_os = "macos") {
    "Metal needs macOS 10.13 or newer on a Mac with a supported GPU"
} else {
    "install the graphics driver of the vendor, with Vulkan or DX12"
};

/// An adapter that wgpu found.
#[derive(Clone, Debug)]
pub struct Adapter {
    pub(super) raw: wgpu::Adapter,
}

/// An adapter: its name, its kind, and its abilities.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Description {
    /// The name the driver gives it.
    pub name: String,
    /// `vulkan`, `metal` or `dx12`.
    pub api: String,
    /// `discrete GPU`, `integrated GPU`, `virtual GPU`, `software`, `other`.
    pub device_type: &'static str,
    /// Driver and its version.
    pub driver: String,
    /// Whether it computes in f64.
    pub f64: bool,
    /// Whether it can round every operation by itself: through Vulkan, which takes SPIR-V as it is.
    pub strict: bool,
    /// Most bytes of one storage binding.
    pub max_binding: u64,
    /// Most bytes of one buffer.
    pub max_buffer: u64,
    /// Most workgroups in one dimension.
    pub max_workgroups: u32,
}

impl fmt::Display for Description {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({}, {}, {})", self.name, self.device_type, self.api, self.driver)
    }
}

impl Adapter {
    /// Every adapter of this machine, in the order of the system.
    #[must_use]
    pub fn all() -> Vec<Adapter> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = BACKENDS;
        descriptor.flags = wgpu::InstanceFlags::empty();
        let instance = wgpu::Instance::new(descriptor);
        let found = pollster::block_on(instance.enumerate_adapters(BACKENDS));
        found.into_iter().map(|raw| Adapter { raw }).collect()
    }

    /// The best adapter: discrete before integrated, virtual, other and software; the first among equals.
    /// With `name` only adapters whose name contains it, in any case.
    ///
    /// # Errors
    /// When there is none, or none that has the arithmetic.
    pub fn best(arithmetic: impl Into<Arithmetic>, name: Option<&str>) -> Result<Adapter> {
        let all = Adapter::all();
        let best = best_of(&all, arithmetic.into(), name)?;
        Ok(all[best].clone())
    }

    /// For each of the names the best adapter that has it and is not taken before; without any, the best one with all hardware
    /// adapters that are as it is, whose results are the same.
    ///
    /// # Errors
    /// As [`Adapter::best`]; when a name is given more often than there are adapters of it.
    pub fn several(arithmetic: impl Into<Arithmetic>, names: &[String]) -> Result<Vec<Adapter>> {
        let arithmetic = arithmetic.into();
        let mut all = Adapter::all();
        if names.is_empty() {
            let best = all[best_of(&all, arithmetic, None)?].clone();
            if best.may_be_software() {
                return Ok(vec![best]);
            }
            all.retain(|one| one.describe() == best.describe());
            return Ok(all);
        }
        let (mut left, mut taken): (Vec<Adapter>, Vec<Adapter>) = (all.clone(), Vec::new());
        for name in names {
            let before = taken.iter().filter(|one| one.is_called(name)).count();
            if before > 0 && !left.iter().any(|one| one.is_called(name)) {
                return Err(Error::TooFewAdapters { name: name.clone(), found: before, wanted: before + 1 });
            }
            if left.is_empty() {
                left.clone_from(&all);
            }
            let best = best_of(&left, arithmetic, Some(name))?;
            taken.push(left.remove(best));
        }
        Ok(taken)
    }

    /// Whether its name contains `name`, in any case.
    fn is_called(&self, name: &str) -> bool {
        self.describe().name.to_lowercase().contains(&name.to_lowercase())
    }

    /// Whether it is a program on the CPU.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.raw.get_info().device_type == wgpu::DeviceType::Cpu
    }

    /// Whether it is a program on the CPU, or does not say what it is.
    #[must_use]
    pub fn may_be_software(&self) -> bool {
        matches!(self.raw.get_info().device_type, wgpu::DeviceType::Cpu | wgpu::DeviceType::Other)
    }

    fn rank(&self) -> u32 {
        match self.raw.get_info().device_type {
            wgpu::DeviceType::DiscreteGpu => 0,
            wgpu::DeviceType::IntegratedGpu => 1,
            wgpu::DeviceType::VirtualGpu => 2,
            wgpu::DeviceType::Other => 3,
            wgpu::DeviceType::Cpu => 4,
        }
    }

    /// Its name, its kind, and its abilities.
    #[must_use]
    pub fn describe(&self) -> Description {
        let (info, limits, features) = (self.raw.get_info(), self.raw.limits(), self.raw.features());
        Description {
            name: info.name,
            api: info.backend.to_string(),
            device_type: match info.device_type {
                wgpu::DeviceType::DiscreteGpu => "discrete GPU",
                wgpu::DeviceType::IntegratedGpu => "integrated GPU",
                wgpu::DeviceType::VirtualGpu => "virtual GPU",
                wgpu::DeviceType::Cpu => "software",
                wgpu::DeviceType::Other => "other",
            },
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
            f64: features.contains(wgpu::Features::SHADER_F64),
            strict: info.backend == wgpu::Backend::Vulkan
                && features.contains(wgpu::Features::PASSTHROUGH_SHADERS),
            max_binding: limits.max_storage_buffer_binding_size,
            max_buffer: limits.max_buffer_size,
            max_workgroups: limits.max_compute_workgroups_per_dimension,
        }
    }
}

/// The place of the best of some adapters, see [`Adapter::best`].
fn best_of(
    all: &[Adapter],
    Arithmetic { precision, strict }: Arithmetic,
    name: Option<&str>,
) -> Result<usize> {
    if all.is_empty() {
        return Err(Error::NoAdapter { remedy: MISSING_DRIVER });
    }
    let mut places: Vec<usize> =
        (0..all.len()).filter(|place| name.is_none_or(|name| all[*place].is_called(name))).collect();
    if let (Some(name), true) = (name, places.is_empty()) {
        let names: Vec<String> = all.iter().map(|adapter| adapter.describe().name).collect();
        return Err(Error::NoSuchAdapter { name: name.to_owned(), names: names.join(", ") });
    }
    places.sort_by_key(|place| all[*place].rank());
    let without = all[places[0]].describe().to_string();
    places.retain(|place| precision == Precision::F32 || all[*place].describe().f64);
    let Some(first) = places.first() else { return Err(Error::NoF64 { adapter: without }) };
    let without = all[*first].describe().to_string();
    let found = places.into_iter().find(|place| !strict || all[*place].describe().strict);
    found.ok_or(Error::NoStrict { adapter: without })
}
