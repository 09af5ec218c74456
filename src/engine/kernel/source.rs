//! The contract between host and kernels; twin of `shaders/host.wgsl`.
//!
//! All bindings are in group 0. [`places`](crate::engine::kernel::places) says where a word of an instance is.
//!
//! | binding | name | type | what |
//! |---|---|---|---|
//! | 0 | `settings` | uniform `Settings` | counts, and numbers that a compiler cannot know |
//! | 1 | `inputs` | `array<real>`, read only | the words of each instance |
//! | 2 | `state` | `array<real>` | what is carried between dispatches, and results |
//! | 3 | `flags` | `array<u32>` | word 0: status, 0 is unwritten; word 1: steps done |
//! | 4 | `progress` | `array<atomic<u32>>` | word 0: instances that are finished |
//!
//! No number is typed on both sides: where a word stands, codes and constants reach WGSL as a header made
//! from the tables here.

use crate::engine::fields::{Field, words};
use crate::engine::kernel::places::TOGETHER;
use crate::engine::precision::Precision;
use crate::model::status::Status;
use std::fmt::Write;

/// Invocations of a workgroup.
pub const WORKGROUP_SIZE: u32 = 64;

/// Kernel-specific 32-bit words of the settings.
pub const SETTING_WORDS: usize = 4 * SETTING_VECTORS as usize;

/// Vectors of four words that hold them.
pub const SETTING_VECTORS: u32 = 4;

/// Words of `progress`.
pub const PROGRESS_WORDS: usize = 4;

/// The flag word that holds the status: 0 is unwritten, others as [`Status`].
pub const FLAG_STATUS: usize = 0;

/// The flag word that counts the steps of the kernel.
pub const FLAG_STEPS: usize = 1;

/// Names of the bindings of group 0, by their number.
pub const BINDINGS: [&str; 5] = ["settings", "inputs", "state", "flags", "progress"];

/// The declarations that every kernel begins with.
pub const HOST: (&str, &str) = ("shaders/host.wgsl", include_str!("../../../shaders/host.wgsl"));

/// The head of the settings: `Settings` in WGSL, without the kernel-specific words that follow it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Settings {
    /// Instances of the chunk.
    pub count: u32,
    /// Steps an invocation takes at most in this dispatch.
    pub iterations: u32,
    /// Index of the chunk's first instance, lower 32 bits.
    pub offset: u32,
    /// 0 that a compiler cannot know: XOR with it keeps a sum from being reassociated.
    pub zero: u32,
    /// 0.0 that a compiler cannot know.
    pub zero_real: f32,
    /// 1.0 that a compiler cannot know: a product with it keeps a sum from being reassociated.
    pub one_real: f32,
    /// Words of the state of an instance.
    pub state_words: u32,
    /// Nothing yet.
    pub spare: u32,
    /// The words of the kernel's own settings.
    pub words: [u32; SETTING_WORDS],
}

impl Settings {
    /// The settings of a dispatch of so many instances, each with so many words of state, over so many steps; `offset` is the index of the
    /// first.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a chunk is below 2^32 words; the offset is its low half"
    )]
    pub fn new(
        [count, state_words]: [usize; 2],
        iterations: u32,
        offset: usize,
        words: [u32; SETTING_WORDS],
    ) -> Settings {
        let [count, state_words, offset] = [count, state_words, offset].map(|number| number as u32);
        let (zero, zero_real, one_real, spare) = (0, 0.0, 1.0, 0);
        Settings { count, iterations, offset, zero, zero_real, one_real, state_words, spare, words }
    }
}

/// A constant of the header.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Constant {
    /// `const NAME: u32`.
    U32(u32),
    /// `const NAME: real`.
    Real(f64),
    /// `const NAME: bool`, for what a scene selects.
    Bool(bool),
}

impl Constant {
    /// A number of words, or the place of one.
    fn count(count: usize) -> Constant {
        Constant::U32(u32::try_from(count).unwrap_or(u32::MAX))
    }
}

/// A compute kernel: its WGSL files and its words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kernel {
    /// Its name in errors and logs.
    pub name: &'static str,
    /// Path and text of each WGSL file behind [`HOST`], in order. The last one holds the entry point `main`.
    pub files: &'static [(&'static str, &'static str)],
    /// Fields of `inputs`, `INPUT_…` in WGSL.
    pub inputs: &'static [Field],
    /// Fields of `state`, `STATE_…` in WGSL.
    pub state: &'static [Field],
    /// Fields of `flags`, `FLAG_…` in WGSL; the first two are `status` and `steps`.
    pub flags: &'static [Field],
    /// Kernel-specific fields of the settings, `SETTING_…` in WGSL.
    pub settings: &'static [Field],
    /// Runs of named words that stand inside others or beside them, by prefix: `PREFIX_…` in WGSL, and `PREFIX_WORDS`.
    pub tables: &'static [(&'static str, &'static [Field])],
    /// Constants by name.
    pub constants: &'static [(&'static str, Constant)],
    /// Most loop iterations that one step may cost, for the limit of a dispatch.
    pub loops_per_step: u32,
}

impl Kernel {
    /// The WGSL text for one scalar; `choices` are further constants, e.g. what a scene selects.
    #[must_use]
    pub fn source(&self, precision: Precision, choices: &[(&str, Constant)]) -> String {
        self.source_with(precision, choices, self.files)
    }

    /// As [`Kernel::source`], with other files behind the header: a probe of single functions.
    #[must_use]
    pub fn source_with(
        &self,
        precision: Precision,
        choices: &[(&str, Constant)],
        files: &[(&str, &str)],
    ) -> String {
        let mut text = header(precision);
        for (prefix, fields) in
            [("INPUT", self.inputs), ("STATE", self.state), ("FLAG", self.flags), ("SETTING", self.settings)]
        {
            places(&mut text, prefix, fields);
        }
        for (prefix, fields) in [("INPUT", self.inputs), ("FLAG", self.flags)].iter().chain(self.tables) {
            constant(&mut text, &format!("{prefix}_WORDS"), Constant::count(words(fields)));
        }
        for (prefix, fields) in self.tables {
            places(&mut text, prefix, fields);
        }
        for (name, value) in self.constants.iter().chain(choices) {
            constant(&mut text, name, *value);
        }
        for (path, file) in std::iter::once(&HOST).chain(files) {
            let _ = write!(text, "\n// {path}\n{file}");
        }
        text
    }
}

/// The header of every kernel: the scalar, its epsilon, sizes and status codes.
fn header(precision: Precision) -> String {
    let mut text = format!("alias real = {precision};\n");
    let epsilon = match precision {
        Precision::F32 => f64::from(f32::EPSILON),
        Precision::F64 => f64::EPSILON,
    };
    constant(&mut text, "EPSILON", Constant::Real(epsilon));
    constant(&mut text, "WORKGROUP_SIZE", Constant::U32(WORKGROUP_SIZE));
    constant(&mut text, "SETTING_VECTORS", Constant::U32(SETTING_VECTORS));
    constant(&mut text, "TOGETHER", Constant::count(TOGETHER));
    for status in std::iter::once(Status::Unwritten).chain(Status::ALL) {
        let name = format!("STATUS_{}", status.name().to_uppercase());
        constant(&mut text, &name, Constant::U32(status as u32));
    }
    text
}

/// The first words of fields.
fn places(text: &mut String, prefix: &str, fields: &[Field]) {
    let mut first = 0;
    for field in fields {
        constant(text, &format!("{prefix}_{}", field.name.to_uppercase()), Constant::count(first));
        first += field.words;
    }
}

fn constant(text: &mut String, name: &str, value: Constant) {
    let _ = match value {
        Constant::U32(value) => writeln!(text, "const {name}: u32 = {value}u;"),
        Constant::Real(value) => writeln!(text, "const {name}: real = {value:?};"),
        Constant::Bool(value) => writeln!(text, "const {name}: bool = {value};"),
    };
}
