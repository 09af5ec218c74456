//! Every kernel, without a GPU: naga validates it, writes it for every API, and agrees with Rust's tables.

use naga::back::{hlsl, msl, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, Module, Scalar, ScalarKind, StorageAccess, TypeInner};
use squealmap::engine::fields::words;
use squealmap::engine::kernel::source::{BINDINGS, Constant, Kernel, Settings, WORKGROUP_SIZE};
use squealmap::engine::kernel::{linear, source};
use squealmap::engine::lanes::job::Part;
use squealmap::engine::march::kernel::PIECES;
use squealmap::engine::march::marching::Form;
use squealmap::engine::precision::Precision;
use squealmap::model::piece::LawForm;

/// A Rust file and its WGSL twin, with the functions that only one of them needs.
struct Twin {
    name: &'static str,
    /// Made for the host: constructors, narrowing, what WGSL keeps in globals or writes in place.
    rust_only: &'static [&'static str],
    /// Access to buffers, and what Rust writes in place or as a closure.
    wgsl_only: &'static [&'static str],
}

const TWINS: &[Twin] = &[
    // is_finite belongs to the host's file in WGSL.
    Twin { name: "linear", rust_only: &["code", "all_finite"], wgsl_only: &[] },
];

/// What is chosen in a kernel.
type Choices = Vec<(&'static str, Constant)>;

/// Every kernel there is, in every form.
pub(crate) fn kernels() -> Vec<(Kernel, Choices)> {
    let march = |pieces: usize, part, law, ramp| {
        let (kernel, choices) = Form { law, pieces, ramp }.kernel(part).expect("a kernel");
        (*kernel, choices)
    };
    let mut all = vec![(linear::KERNEL, Vec::new())];
    for (index, pieces) in PIECES.into_iter().enumerate() {
        let part = [Part::Growth, Part::Settle, Part::Window][index % 3];
        all.push(march(pieces, part, LawForm::Pieces, index % 2 == 0));
    }
    for part in [Part::Growth, Part::Settle, Part::Window] {
        all.push(march(1, part, LawForm::Exponential, true));
        all.push(march(1, part, LawForm::Rational, false));
    }
    all
}

fn parsed(kernel: &Kernel, choices: &[(&str, Constant)], precision: Precision) -> (Module, ModuleInfo) {
    let text = kernel.source(precision, choices);
    let module = naga::front::wgsl::parse_str(&text)
        .unwrap_or_else(|why| panic!("{}: {}", kernel.name, why.emit_to_string(&text)));
    let capabilities = match precision {
        Precision::F32 => Capabilities::empty(),
        Precision::F64 => Capabilities::FLOAT64,
    };
    let info = Validator::new(ValidationFlags::all(), capabilities)
        .validate(&module)
        .unwrap_or_else(|why| panic!("{}: {}", kernel.name, why.emit_to_string(&text)));
    (module, info)
}

#[test]
fn every_kernel_is_valid_in_both_scalars() {
    for (kernel, choices) in kernels() {
        for precision in [Precision::F32, Precision::F64] {
            let (module, info) = parsed(&kernel, &choices, precision);
            let options = spv::Options::default();
            let words = spv::write_vec(&module, &info, &options, None).expect("SPIR-V");
            assert_eq!(words[0], 0x0723_0203, "{}: the magic number of SPIR-V", kernel.name);
        }
    }
}

#[test]
fn every_kernel_can_be_written_for_metal_and_dx12() {
    for (kernel, choices) in kernels() {
        let (module, info) = parsed(&kernel, &choices, Precision::F32);
        let mut options = msl::Options { fake_missing_bindings: true, ..msl::Options::default() };
        options.lang_version = (2, 0);
        let (text, _) = msl::write_string(&module, &info, &options, &msl::PipelineOptions::default())
            .unwrap_or_else(|why| panic!("{}: {why}", kernel.name));
        assert!(text.contains("kernel void"), "{text}");

        let options = hlsl::Options { fake_missing_bindings: true, ..hlsl::Options::default() };
        let pipeline = hlsl::PipelineOptions::default();
        let mut text = String::new();
        hlsl::Writer::new(&mut text, &options, &pipeline)
            .write(&module, &info, None)
            .unwrap_or_else(|why| panic!("{}: {why}", kernel.name));
        assert!(text.contains("[numthreads(64, 1, 1)]"), "{text}");
    }
}

#[test]
fn bindings_strides_and_sizes_are_those_of_rust() {
    for (kernel, choices) in kernels() {
        for precision in [Precision::F32, Precision::F64] {
            let (module, _) = parsed(&kernel, &choices, precision);
            for (number, name) in (0..).zip(BINDINGS) {
                let (_, variable) = module
                    .global_variables
                    .iter()
                    .find(|(_, variable)| variable.name.as_deref() == Some(name))
                    .unwrap_or_else(|| panic!("{}: no {name}", kernel.name));
                let binding = variable.binding.expect("a binding");
                assert_eq!((binding.group, binding.binding), (0, number), "{name}");
                let read_only = AddressSpace::Storage { access: StorageAccess::LOAD };
                match (number, variable.space) {
                    (0, AddressSpace::Uniform) => {}
                    (1, space) => assert_eq!(space, read_only, "{name}"),
                    (_, AddressSpace::Storage { access }) => {
                        assert!(access.contains(StorageAccess::LOAD | StorageAccess::STORE), "{name}");
                    }
                    (_, space) => panic!("{name} is in {space:?}"),
                }
                let stride = match &module.types[variable.ty].inner {
                    TypeInner::Array { stride, .. } => *stride as usize,
                    TypeInner::Struct { span, .. } => *span as usize,
                    other => panic!("{name} is {other:?}"),
                };
                let wanted = [size_of::<Settings>(), precision.bytes(), precision.bytes(), 4, 4];
                assert_eq!(stride, wanted[number as usize], "{name}");
            }
            let entry = &module.entry_points[0];
            assert_eq!((module.entry_points.len(), entry.name.as_str()), (1, "main"));
            assert_eq!(entry.workgroup_size, [WORKGROUP_SIZE, 1, 1]);
        }
    }
}

#[test]
fn the_settings_have_the_same_members_at_the_same_places() {
    let (module, _) = parsed(&linear::KERNEL, &[], Precision::F32);
    let members = module
        .types
        .iter()
        .find_map(|(_, ty)| match &ty.inner {
            TypeInner::Struct { members, .. } if ty.name.as_deref() == Some("Settings") => Some(members),
            _ => None,
        })
        .expect("Settings");
    let wanted = [
        ("count", std::mem::offset_of!(Settings, count)),
        ("iterations", std::mem::offset_of!(Settings, iterations)),
        ("offset", std::mem::offset_of!(Settings, offset)),
        ("zero", std::mem::offset_of!(Settings, zero)),
        ("zero_real", std::mem::offset_of!(Settings, zero_real)),
        ("one_real", std::mem::offset_of!(Settings, one_real)),
        ("state_words", std::mem::offset_of!(Settings, state_words)),
        ("spare", std::mem::offset_of!(Settings, spare)),
        ("words", std::mem::offset_of!(Settings, words)),
    ];
    let found: Vec<(&str, usize)> =
        members.iter().map(|one| (one.name.as_deref().unwrap_or(""), one.offset as usize)).collect();
    assert_eq!(found, wanted);
}

#[test]
fn the_scalar_is_the_only_float_of_the_buffers() {
    for (kernel, choices) in kernels() {
        let (module, _) = parsed(&kernel, &choices, Precision::F64);
        let wide = Scalar { kind: ScalarKind::Float, width: 8 };
        let buffers = ["inputs", "state"];
        for (_, variable) in module.global_variables.iter() {
            if buffers.contains(&variable.name.as_deref().unwrap_or("")) {
                let TypeInner::Array { base, .. } = module.types[variable.ty].inner else {
                    panic!("an array");
                };
                assert_eq!(module.types[base].inner, TypeInner::Scalar(wide));
            }
        }
    }
}

#[test]
fn flags_begin_with_status_and_steps() {
    for (kernel, _) in kernels() {
        assert!(kernel.flags[source::FLAG_STATUS].name.eq_ignore_ascii_case("status"));
        assert!(kernel.flags[source::FLAG_STEPS].name.eq_ignore_ascii_case("steps"));
        assert!(words(kernel.settings) <= source::SETTING_WORDS);
    }
}

/// The names of the functions in a text, in order, without some.
fn functions<'a>(text: &'a str, without: &[&str]) -> Vec<&'a str> {
    let name = |line: &'a str| {
        let line = line.trim_start();
        let line = line.strip_prefix("pub ").or(line.strip_prefix("pub(crate) ")).unwrap_or(line);
        let line = line.strip_prefix("const ").unwrap_or(line);
        line.strip_prefix("fn ")?.split(['(', '<']).next()
    };
    text.lines().filter_map(name).filter(|name| !without.contains(name)).collect()
}

#[test]
fn twins_have_the_same_functions_in_the_same_order() {
    for Twin { name, rust_only, wgsl_only } in TWINS {
        let paths = [format!("src/engine/kernel/{name}.rs"), format!("shaders/{name}.wgsl")];
        let [rust, wgsl] = paths.clone().map(|path| std::fs::read_to_string(path).expect("a twin"));
        let [ours, theirs] = [functions(&rust, rust_only), functions(&wgsl, wgsl_only)];
        assert_eq!(ours, theirs, "{name}");
        assert!(ours.len() > 2, "{name}: {ours:?}");
        for (text, only) in [(&rust, rust_only), (&wgsl, wgsl_only)] {
            let all = functions(text, &[]);
            assert!(only.iter().all(|one| all.contains(one)), "{name}: of {only:?} some are gone");
        }
        assert!(rust.starts_with(&format!("//! Twin: {}\n", paths[1])), "{name}");
        assert!(wgsl.starts_with(&format!("// Twin: {}\n", paths[0])), "{name}");
    }
}
