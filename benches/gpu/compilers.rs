//! The compilers of GPUs that may be installed, none of which needs a card, and what one of them makes of a kernel.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use naga::back::spv;
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};
use naga::valid::{Capabilities, ValidationFlags, Validator};

use crate::cuda;
use crate::figures::Figures;
use crate::kernels::Variant;

/// The variable with the root of a Debian of newer compilers: a folder as `debootstrap` makes it.
pub(crate) const ROOT: &str = "SQUEALMAP_MESA_ROOT";

/// A driver of Mesa, without a card.
struct Mesa {
    /// The driver's description for the loader, `X_icd…json`.
    icd: &'static str,
    /// Its stand-in for a card, a library to be loaded before others; empty where the driver brings one.
    shim: &'static str,
    /// The variable that names the card.
    card: (&'static str, &'static str),
}

enum How {
    /// The driver of this machine.
    Here(Mesa),
    /// That of the root at [`ROOT`].
    Root(Mesa),
    /// NVIDIA's own, for one architecture.
    Cuda(&'static str),
}

/// A compiler, and the card it compiles for.
pub(crate) struct Compiler {
    /// Its name in the rows.
    pub(crate) name: &'static str,
    how: How,
}

const RADV: &str = "radeon";

/// Mesa's RADV of this machine, which needs no card.
const fn radv(name: &'static str, card: &'static str) -> Compiler {
    let mesa = Mesa { icd: RADV, shim: "", card: ("RADV_FORCE_FAMILY", card) };
    Compiler { name, how: How::Here(mesa) }
}

/// A driver of the newer Mesa.
const fn root(
    name: &'static str,
    icd: &'static str,
    shim: &'static str,
    card: (&'static str, &'static str),
) -> Compiler {
    Compiler { name, how: How::Root(Mesa { icd, shim, card }) }
}

/// Every compiler that is known of; the first ones are those of a distribution.
pub(crate) const ALL: &[Compiler] = &[
    radv("navi21", "navi21"),
    radv("vega20", "vega20"),
    root("navi21, newer Mesa", RADV, "amdgpu", ("AMDGPU_GPU_ID", "navi21")),
    root("navi31", RADV, "amdgpu", ("AMDGPU_GPU_ID", "navi31")),
    root("Ampere, NAK", "nouveau", "nouveau", ("NOUVEAU_CHIPSET", "172")),
    root("Apple M1", "asahi", "asahi", ("ASAHI_MESA_DEBUG", "")),
    root("Adreno 740", "freedreno", "freedreno", ("FD_GPU_ID", "740")),
    Compiler { name: "sm_90, ptxas", how: How::Cuda("sm_90") },
];

impl Compiler {
    /// Whether it is part of a distribution, so that its figures can be held everywhere.
    pub(crate) fn is_of_distribution(&self) -> bool {
        matches!(self.how, How::Here(_))
    }

    /// Whether its card computes in f64: compilers of those that do not take minutes and gigabytes to fail.
    pub(crate) fn has_f64(&self) -> bool {
        !matches!(self.how, How::Root(Mesa { icd: "asahi" | "freedreno", .. }))
    }

    /// Why it is not there, if it is not.
    pub(crate) fn missing(&self) -> Option<String> {
        let absent = |path: &Path| (!path.exists()).then(|| format!("{} is not there", path.display()));
        match &self.how {
            How::Here(mesa) => absent(&description(Path::new("/"), mesa.icd))
                .map(|why| format!("{why}: install mesa-vulkan-drivers and libvulkan1")),
            How::Root(mesa) => match std::env::var_os(ROOT).map(PathBuf::from) {
                None => Some(format!("{ROOT} is not set, see docs/gpu.md")),
                Some(root) => {
                    absent(&description(&root, mesa.icd)).or_else(|| absent(&shim(&root, mesa.shim)))
                }
            },
            How::Cuda(_) => cuda::missing(),
        }
    }

    /// What it makes of a kernel: its version and its figures.
    ///
    /// # Errors
    /// What it says against the kernel.
    pub(crate) fn compile(
        &self,
        variant: &Variant,
        folder: &Path,
    ) -> Result<(String, Figures), Box<dyn Error>> {
        let mesa = match &self.how {
            How::Cuda(architecture) => return cuda::compile(variant, architecture, folder),
            How::Here(mesa) | How::Root(mesa) => mesa,
        };
        let spirv = folder.join("kernel.spv");
        let words = words(&variant.source)?;
        std::fs::write(&spirv, words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>())?;
        let output = self.command(mesa, folder)?.arg("--of-driver").arg(&spirv).output()?;
        let text = succeeded(&output)?;
        let mut lines = text.lines();
        let version = lines.next().and_then(|line| line.split_once('\t')).map_or("", |(_, version)| version);
        let version = version.to_owned();
        let told: Vec<(&str, f64)> = lines
            .filter_map(|line| line.split_once('\t'))
            .filter_map(|(name, value)| Some((name, value.parse().ok()?)))
            .collect();
        Ok((version, Figures::of_mesa(&told)))
    }

    /// This program, to be run with the driver.
    fn command(&self, mesa: &Mesa, folder: &Path) -> Result<Command, Box<dyn Error>> {
        let own = std::env::current_exe()?;
        let (mut command, icd) = if let How::Root(_) = self.how {
            let root = PathBuf::from(std::env::var_os(ROOT).ok_or("no root of newer compilers")?);
            // The libraries of the other root by its own loader: nothing has to be mounted, and nobody has to be root.
            let libraries = root.join(LIBRARIES);
            let mut command = Command::new(root.join("lib64/ld-linux-x86-64.so.2"));
            command.arg("--library-path").arg(&libraries);
            command.arg("--preload").arg(shim(&root, mesa.shim)).arg(own);
            (command, moved(&root, mesa.icd, folder)?)
        } else {
            (Command::new(own), description(Path::new("/"), mesa.icd))
        };
        command
            .env("VK_DRIVER_FILES", &icd)
            .env("VK_ICD_FILENAMES", &icd)
            .env("NODEVICE_SELECT", "1")
            .env("MESA_SHADER_CACHE_DISABLE", "true")
            .env("XDG_RUNTIME_DIR", folder)
            .env(mesa.card.0, mesa.card.1);
        Ok(command)
    }
}

/// A kernel as wgpu hands it to a driver whose access to buffers is robust: loops are bounded and indices clamped, those of
/// buffers left to the driver.
fn words(source: &str) -> Result<Vec<u32>, Box<dyn Error>> {
    let module = naga::front::wgsl::parse_str(source)?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module)?;
    let unchecked = BoundsCheckPolicy::Unchecked;
    let options = spv::Options {
        flags: spv::WriterFlags::empty(),
        bounds_check_policies: BoundsCheckPolicies {
            index: BoundsCheckPolicy::Restrict,
            buffer: unchecked,
            image_load: unchecked,
            binding_array: unchecked,
        },
        force_loop_bounding: true,
        ..spv::Options::default()
    };
    Ok(spv::write_vec(&module, &info, &options, None)?)
}

/// Where a Debian on this processor has its libraries.
const LIBRARIES: &str = "usr/lib/x86_64-linux-gnu";

/// The driver's description for the loader, which has the processor in its name or not.
fn description(root: &Path, icd: &str) -> PathBuf {
    let folder = root.join("usr/share/vulkan/icd.d");
    let plain = folder.join(format!("{icd}_icd.json"));
    if plain.exists() { plain } else { folder.join(format!("{icd}_icd.x86_64.json")) }
}

fn shim(root: &Path, name: &str) -> PathBuf {
    root.join(LIBRARIES).join(format!("lib{name}_noop_drm_shim.so"))
}

/// The description of a driver under a root that is not this machine's, with the place where its library is.
fn moved(root: &Path, icd: &str, folder: &Path) -> Result<PathBuf, Box<dyn Error>> {
    let text = std::fs::read_to_string(description(root, icd))?;
    let mut value: serde_json::Value = serde_json::from_str(&text)?;
    let library = value["ICD"]["library_path"].as_str().ok_or("a driver's description names no library")?;
    let name = Path::new(library).file_name().ok_or("a driver's library has no name")?;
    let library = root.join(LIBRARIES).join(name);
    value["ICD"]["library_path"] = library.to_string_lossy().into();
    let path = folder.join(format!("{icd}.json"));
    std::fs::write(&path, value.to_string())?;
    Ok(path)
}

/// What a program has printed.
///
/// # Errors
/// Its complaint, if it has failed.
pub(crate) fn succeeded(output: &Output) -> Result<String, Box<dyn Error>> {
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() {
        return Ok(text);
    }
    let complaint = String::from_utf8_lossy(&output.stderr);
    let last = complaint.lines().chain(text.lines()).rfind(|line| !line.trim().is_empty());
    Err(format!("{}: {}", output.status, last.unwrap_or("no word")).into())
}
