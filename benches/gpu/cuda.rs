//! A kernel by NVIDIA's own compiler: HLSL by naga, CUDA by Slang, PTX by NVRTC, machine code by `ptxas`.
//!
//! That is the front end of CUDA, not that of a Vulkan driver; what assigns the registers is of the same family.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;

use naga::back::hlsl;
use naga::valid::{Capabilities, ValidationFlags, Validator};

use crate::compilers::succeeded;
use crate::figures::Figures;
use crate::kernels::Variant;

/// The variable with the environment of Python that holds the packages.
pub(crate) const PYTHON: &str = "SQUEALMAP_CUDA";

/// A program or library under the packages of the environment, by the end of its path.
fn found(end: &str) -> Option<PathBuf> {
    let root = PathBuf::from(std::env::var_os(PYTHON)?);
    let folders = std::fs::read_dir(root.join("lib")).ok()?;
    folders
        .filter_map(Result::ok)
        .map(|folder| folder.path().join("site-packages").join(end))
        .find(|path| path.exists())
}

const SLANG: &str = "slangtorch/bin/slangc";
const NVRTC: &str = "nvidia/cuda_nvrtc/lib/libnvrtc.so.12";
const PTXAS: &str = "nvidia/cuda_nvcc/bin/ptxas";
const INCLUDE: &str = "nvidia/cuda_runtime/include";

/// Why it is not there, if it is not.
pub(crate) fn missing() -> Option<String> {
    if std::env::var_os(PYTHON).is_none() {
        return Some(format!("{PYTHON} is not set, see docs/gpu.md"));
    }
    [SLANG, NVRTC, PTXAS, INCLUDE]
        .into_iter()
        .find(|end| found(end).is_none())
        .map(|end| format!("{end} is not under {PYTHON}"))
}

/// What it makes of a kernel.
pub(crate) fn compile(
    variant: &Variant,
    architecture: &str,
    folder: &Path,
) -> Result<(String, Figures), Box<dyn Error>> {
    let path = |end: &str| found(end).ok_or_else(|| format!("{end} is not under {PYTHON}"));
    let [hlsl, cuda, ptx, cubin] =
        ["kernel.hlsl", "kernel.cu", "kernel.ptx", "kernel.cubin"].map(|name| folder.join(name));
    std::fs::write(&hlsl, translated(&variant.source)?)?;
    let slang = Command::new(path(SLANG)?)
        .arg(&hlsl)
        .args(["-lang", "hlsl", "-entry", "main", "-stage", "compute", "-target", "cuda", "-o"])
        .arg(&cuda)
        .output()?;
    succeeded(&slang)?;
    let python = PathBuf::from(std::env::var_os(PYTHON).unwrap_or_default()).join("bin/python3");
    let nvrtc = Command::new(python)
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/gpu/nvrtc.py"))
        .args([path(NVRTC)?, cuda, ptx.clone()])
        .arg(format!("--gpu-architecture={}", architecture.replace("sm_", "compute_")))
        .arg(format!("--include-path={}", path(INCLUDE)?.display()))
        .output()?;
    succeeded(&nvrtc)?;
    let ptxas = Command::new(path(PTXAS)?)
        .args(["-v", &format!("-arch={architecture}"), "-o"])
        .args([&cubin, &ptx])
        .output()?;
    succeeded(&ptxas)?;
    let told = String::from_utf8_lossy(&ptxas.stderr).into_owned();
    let mut figures = Figures {
        registers: before(&told, " registers"),
        spills: before(&told, " bytes spill stores"),
        scratch: before(&told, " bytes stack frame"),
        width: Some(32.0),
        ..Figures::default()
    };
    if let Some(code) = code_of(&std::fs::read(&cubin)?) {
        // Every instruction has 16 bytes since Volta.
        figures.code = Some(code);
        figures.instructions = Some(code / 16.0);
    }
    let version = Command::new(path(PTXAS)?).arg("--version").output()?;
    let version = succeeded(&version)?;
    let version = version.lines().rev().find_map(|line| line.strip_prefix("Build ")).unwrap_or("unknown");
    Ok((format!("ptxas {version}"), figures))
}

/// The kernel in HLSL.
fn translated(source: &str) -> Result<String, Box<dyn Error>> {
    let module = naga::front::wgsl::parse_str(source)?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module)?;
    let options = hlsl::Options { shader_model: hlsl::ShaderModel::V6_0, ..hlsl::Options::default() };
    let mut text = String::new();
    let pipeline = hlsl::PipelineOptions::default();
    hlsl::Writer::new(&mut text, &options, &pipeline).write(&module, &info, None)?;
    Ok(text)
}

/// The last number that stands right before some words.
fn before(text: &str, words: &str) -> Option<f64> {
    let at = text.rfind(words)?;
    text[..at].rsplit(|c: char| !c.is_ascii_digit()).next()?.parse().ok()
}

/// Bytes of the section `.text.main` of an ELF file of 64 bits.
fn code_of(elf: &[u8]) -> Option<f64> {
    let number = |at: usize, bytes: usize| -> Option<usize> {
        let slice = elf.get(at..at + bytes)?;
        Some(slice.iter().rev().fold(0, |sum, byte| sum << 8 | usize::from(*byte)))
    };
    let (table, size, count, names) = (number(40, 8)?, number(58, 2)?, number(60, 2)?, number(62, 2)?);
    let strings = number(table + names * size + 24, 8)?;
    (0..count).find_map(|section| {
        let at = table + section * size;
        let name = elf.get(strings + number(at, 4)?..)?;
        name.starts_with(b".text.").then(|| number(at + 32, 8).map(|bytes| bytes as f64))?
    })
}
