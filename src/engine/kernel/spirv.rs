//! A kernel as SPIR-V in which every operation on floats is rounded by itself.
//!
//! A driver may contract `a * b + c` to one rounding and rearrange sums. WGSL has no word against it; SPIR-V
//! has the decoration `NoContraction`, which naga cannot write. So naga writes the module, and a pass over
//! its words decorates the result of every operation on floats.

use std::collections::HashSet;

use naga::ResourceBinding;
use naga::back::spv;
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use spirv::{Decoration, Op};

use crate::engine::kernel::source::BINDINGS;
use crate::engine::precision::Precision;

/// Words before the first instruction.
const HEADER: usize = 5;

/// The extended instructions that naga uses: `Sqrt`, `FAbs`, `FMin` and their like.
const EXTENDED: &[u8] = b"GLSL.std.450";

/// A strict kernel: naga's own output of a validated module, decorated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Strict(Vec<u32>);

impl Strict {
    /// Compiles a WGSL text with one scalar.
    ///
    /// # Errors
    /// What naga says of the text.
    pub fn new(source: &str, precision: Precision) -> Result<Strict, String> {
        decorated(&written(source, precision)?).map(Strict)
    }

    /// The words of the module.
    #[must_use]
    pub fn words(&self) -> &[u32] {
        &self.0
    }
}

/// The SPIR-V of a WGSL text as naga writes it.
///
/// Version 1.0 is what every Vulkan takes. As in wgpu loops are bounded and indices clamped; those of buffers
/// too, which wgpu leaves to drivers with robust access.
///
/// # Errors
/// What naga says of the text.
pub fn written(source: &str, precision: Precision) -> Result<Vec<u32>, String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|why| why.emit_to_string(source))?;
    let (allowed, capability) = match precision {
        Precision::F32 => (Capabilities::empty(), None),
        Precision::F64 => (Capabilities::FLOAT64, Some(spv::Capability::Float64)),
    };
    let info = Validator::new(ValidationFlags::all(), allowed)
        .validate(&module)
        .map_err(|why| why.emit_to_string(source))?;
    let options = spv::Options {
        lang_version: (1, 0),
        flags: spv::WriterFlags::empty(),
        fake_missing_bindings: false,
        binding_map: (0..).take(BINDINGS.len()).map(place).collect(),
        capabilities: Some([spv::Capability::Shader].into_iter().chain(capability).collect()),
        bounds_check_policies: BoundsCheckPolicies {
            index: BoundsCheckPolicy::Restrict,
            buffer: BoundsCheckPolicy::Restrict,
            image_load: BoundsCheckPolicy::Restrict,
            binding_array: BoundsCheckPolicy::Restrict,
        },
        force_loop_bounding: true,
        emit_int_div_checks: true,
        ..spv::Options::default()
    };
    spv::write_vec(&module, &info, &options, None).map_err(|why| why.to_string())
}

/// Where a binding of the contract is found: where it was declared, as wgpu numbers them from 0.
fn place(binding: u32) -> (ResourceBinding, spv::BindingInfo) {
    let info = spv::BindingInfo { descriptor_set: 0, binding, binding_array_size: None };
    (ResourceBinding { group: 0, binding }, info)
}

/// A module with the result of every operation on floats decorated `NoContraction`, once.
///
/// # Errors
/// When the words are no SPIR-V.
pub fn decorated(module: &[u32]) -> Result<Vec<u32>, String> {
    if module.len() < HEADER || module[0] != spirv::MAGIC_NUMBER {
        return Err("the words do not begin like SPIR-V".to_owned());
    }
    let mut floats = HashSet::new();
    let mut sets = HashSet::new();
    let mut done = HashSet::new();
    let mut results = Vec::new();
    let mut behind_annotations = module.len();
    let mut at = HEADER;
    while at < module.len() {
        let (code, length) = (module[at] & 0xffff, (module[at] >> 16) as usize);
        let operands = module.get(at + 1..at + length);
        let (Some(op), Some(operands)) = (Op::from_u32(code), operands) else {
            return Err(format!("word {at} of the SPIR-V begins no instruction"));
        };
        if !is_before_types(op) {
            behind_annotations = behind_annotations.min(at);
        }
        match (op, operands) {
            (Op::ExtInstImport, [set, name @ ..]) if is_named(name, EXTENDED) => {
                sets.insert(*set);
            }
            (Op::Decorate, [target, what, ..]) if *what == Decoration::NoContraction as u32 => {
                done.insert(*target);
            }
            (Op::TypeFloat, [float, ..]) => {
                floats.insert(*float);
            }
            (Op::TypeVector | Op::TypeMatrix, [several, one, ..]) if floats.contains(one) => {
                floats.insert(*several);
            }
            (Op::ExtInst, [kind, result, set, ..]) if floats.contains(kind) && sets.contains(set) => {
                results.push(*result);
            }
            (_, [_, result, ..]) if is_arithmetic(op) => results.push(*result),
            _ => {}
        }
        at += length;
    }
    let (before, behind) = module.split_at(behind_annotations);
    let decorations = results.into_iter().filter(|result| !done.contains(result)).flat_map(decoration);
    Ok(before.iter().copied().chain(decorations).chain(behind.iter().copied()).collect())
}

/// `OpDecorate result NoContraction`.
fn decoration(result: u32) -> [u32; 3] {
    [3 << 16 | Op::Decorate as u32, result, Decoration::NoContraction as u32]
}

/// Whether the words of a literal string are `name`: four bytes each, the first one lowest.
fn is_named(words: &[u32], name: &[u8]) -> bool {
    words.iter().flat_map(|word| word.to_le_bytes()).take_while(|byte| *byte != 0).eq(name.iter().copied())
}

/// Whether the operation is arithmetic on floats, whatever its operands.
fn is_arithmetic(op: Op) -> bool {
    matches!(
        op,
        Op::FNegate
            | Op::FAdd
            | Op::FSub
            | Op::FMul
            | Op::FDiv
            | Op::FRem
            | Op::FMod
            | Op::VectorTimesScalar
            | Op::MatrixTimesScalar
            | Op::VectorTimesMatrix
            | Op::MatrixTimesVector
            | Op::MatrixTimesMatrix
            | Op::OuterProduct
            | Op::Dot
    )
}

/// Whether an instruction stands in the part of a module that ends with its annotations.
fn is_before_types(op: Op) -> bool {
    matches!(
        op,
        Op::Capability
            | Op::Extension
            | Op::ExtInstImport
            | Op::MemoryModel
            | Op::EntryPoint
            | Op::ExecutionMode
            | Op::String
            | Op::Source
            | Op::SourceContinued
            | Op::SourceExtension
            | Op::Name
            | Op::MemberName
            | Op::ModuleProcessed
            | Op::Decorate
            | Op::MemberDecorate
            | Op::DecorationGroup
            | Op::GroupDecorate
            | Op::GroupMemberDecorate
    )
}
