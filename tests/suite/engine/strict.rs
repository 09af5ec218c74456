//! Strict kernels without a GPU: every operation on floats is decorated once, and nothing else has changed.

use std::collections::{HashMap, HashSet};

use crate::engine::kernels::kernels;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use squealmap::engine::kernel::spirv::{Strict, decorated, written};
use squealmap::engine::precision::Precision;

/// The numbers of SPIR-V's specification, typed here again so that the pass cannot vouch for itself.
const EXT_INST_IMPORT: u32 = 11;
const EXT_INST: u32 = 12;
const TYPE_VOID: u32 = 19;
const TYPE_FLOAT: u32 = 22;
const TYPE_VECTOR: u32 = 23;
const TYPE_MATRIX: u32 = 24;
const DECORATE: u32 = 71;
const NO_CONTRACTION: u32 = 42;
const ARITHMETIC: [u32; 14] = [127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148];

/// The instructions of a module: number and operands.
fn instructions(module: &[u32]) -> Result<Vec<(u32, &[u32])>, String> {
    let [0x0723_0203, 0x0001_0000, _, _, 0, ..] = module else {
        return Err("a header of another kind".to_owned());
    };
    let mut rest = &module[5..];
    let mut found = Vec::new();
    while let Some(first) = rest.first() {
        let length = (first >> 16) as usize;
        if length == 0 || length > rest.len() {
            return Err(format!("an instruction of {length} words where {} are left", rest.len()));
        }
        let (instruction, behind) = rest.split_at(length);
        found.push((first & 0xffff, &instruction[1..]));
        rest = behind;
    }
    Ok(found)
}

/// The number of operations on floats in a module where each is decorated `NoContraction`, once, in the right
/// part of the module, and nothing else is.
fn checked(module: &[u32]) -> Result<usize, String> {
    let bound = module.get(3).copied().unwrap_or(0);
    let all = instructions(module)?;
    let mut decorations: HashMap<u32, u32> = HashMap::new();
    let mut floats = HashSet::new();
    let mut sets = 0;
    let mut operations = Vec::new();
    let mut types = false;
    for (op, operands) in all {
        types |= op == TYPE_VOID || op == TYPE_FLOAT;
        match (op, operands) {
            (EXT_INST_IMPORT, _) => sets += 1,
            (DECORATE, [target, NO_CONTRACTION]) => {
                if types || *target >= bound {
                    return Err(format!("{target} is decorated too late or out of bounds"));
                }
                *decorations.entry(*target).or_default() += 1;
            }
            (TYPE_FLOAT, [id, _]) => {
                floats.insert(*id);
            }
            (TYPE_VECTOR | TYPE_MATRIX, [id, of, _]) if floats.contains(of) => {
                floats.insert(*id);
            }
            (EXT_INST, [kind, result, ..]) if floats.contains(kind) => operations.push(*result),
            (op, [kind, result, ..]) if ARITHMETIC.contains(&op) => {
                if !floats.contains(kind) {
                    return Err(format!("{result} is no float"));
                }
                operations.push(*result);
            }
            _ => {}
        }
    }
    if sets > 1 {
        return Err("more than one set of extended instructions".to_owned());
    }
    for result in &operations {
        match decorations.remove(result) {
            Some(1) => {}
            count => return Err(format!("{result} is decorated {} times", count.unwrap_or(0))),
        }
    }
    match decorations.keys().next() {
        Some(other) => Err(format!("{other} is decorated and no operation on floats")),
        None => Ok(operations.len()),
    }
}

/// Every kernel as a strict module, with naga's words.
fn every_kernel(mut with: impl FnMut(&str, Precision, &[u32], &[u32])) {
    for (kernel, choices) in kernels() {
        for precision in [Precision::F32, Precision::F64] {
            let text = kernel.source(precision, &choices);
            let strict = Strict::new(&text, precision).expect("a strict kernel");
            let plain = written(&text, precision).expect("SPIR-V");
            with(&format!("{} in {precision}", kernel.name), precision, strict.words(), &plain);
        }
    }
}

#[test]
fn every_operation_of_every_kernel_is_decorated_once() {
    every_kernel(|name, _, strict, _| {
        let operations = checked(strict).unwrap_or_else(|why| panic!("{name}: {why}"));
        println!("{name}: {operations} operations");
        assert!(operations > 90, "{name}: {operations}");
    });
}

#[test]
fn nothing_else_is_changed() {
    every_kernel(|name, _, strict, plain| {
        let is_added =
            |(op, operands): &(u32, &[u32])| *op == DECORATE && operands.get(1) == Some(&NO_CONTRACTION);
        let mut rest = instructions(strict).expect(name);
        rest.retain(|one| !is_added(one));
        assert_eq!(rest, instructions(plain).expect(name), "{name}");
        assert_eq!(strict[..5], plain[..5], "{name}");
        assert_eq!(decorated(strict).as_deref(), Ok(strict), "{name}: once is enough");
    });
}

#[test]
fn naga_reads_every_strict_kernel() {
    every_kernel(|name, precision, strict, _| {
        let bytes: Vec<u8> = strict.iter().flat_map(|word| word.to_le_bytes()).collect();
        let module = naga::front::spv::parse_u8_slice(&bytes, &naga::front::spv::Options::default())
            .unwrap_or_else(|why| panic!("{name}: {why}"));
        let capabilities = match precision {
            Precision::F32 => Capabilities::empty(),
            Precision::F64 => Capabilities::FLOAT64,
        };
        let validated = Validator::new(ValidationFlags::all(), capabilities).validate(&module);
        assert!(validated.is_ok(), "{name}: {:?}", validated.err().map(naga::WithSpan::into_inner));
        assert_eq!(module.entry_points.len(), 1, "{name}");
    });
}

#[test]
fn vectors_matrices_and_functions_are_decorated() {
    let text = "@group(0) @binding(2) var<storage, read_write> state: array<f32>;
        @compute @workgroup_size(1)
        fn main() {
            let v = vec3<f32>(state[0], state[1], state[2]);
            let m = mat3x3<f32>(v, v, v);
            let w = m * v + v * m + (m * m * 2.0) * v;
            state[3] = dot(v, w) - length(v * state[0]) % 3.0;
            state[4] = -fma(state[0], exp(state[1]), w.x / w.y);
            state[5] = f32(u32(state[5]) * 3u);
        }";
    let module = Strict::new(text, Precision::F32).expect("a strict module");
    // * + - / % dot and negation, and the four functions length, exp, fma and whatever bounds the conversion.
    assert!(checked(module.words()).expect("decorated") >= 16);
}

#[test]
fn the_check_sees_what_is_not_decorated_once() {
    every_kernel(|name, _, strict, plain| {
        assert!(checked(plain).is_err_and(|why| why.contains("decorated 0 times")), "{name}");
        let pair = |words: &[u32]| words[0] == 3 << 16 | DECORATE && words[2] == NO_CONTRACTION;
        let first = strict.windows(3).position(pair).expect("a decoration");
        let mut less = strict.to_vec();
        less.drain(first..first + 3);
        assert!(checked(&less).is_err(), "{name}: one is missing");
        let mut twice = strict.to_vec();
        twice.splice(first..first, strict[first..first + 3].to_vec());
        assert!(checked(&twice).is_err(), "{name}: one stands twice");
        let mut other = strict.to_vec();
        other[first + 1] += 1;
        assert!(checked(&other).is_err(), "{name}: one is elsewhere");
    });
}

#[test]
fn words_that_are_no_module_are_refused() {
    assert!(decorated(&[]).is_err());
    assert!(decorated(&[7; 20]).is_err());
    let plain = written(&kernels()[0].0.source(Precision::F32, &[]), Precision::F32).expect("SPIR-V");
    assert!(decorated(&plain[..plain.len() - 1]).is_ok(), "a module may end behind any instruction");
    let mut cut = plain.clone();
    cut[5] = 0;
    assert!(decorated(&cut).is_err(), "an instruction of no words");
    cut[5] = plain[5] | 0xffff << 16;
    assert!(decorated(&cut).is_err(), "an instruction beyond the end");
    assert!(Strict::new("fn main() -> f32 { return 1u; }", Precision::F32).is_err());
    assert!(Strict::new("@compute @workgroup_size(1) fn main() { let x = 1.0lf; }", Precision::F32).is_err());
}
