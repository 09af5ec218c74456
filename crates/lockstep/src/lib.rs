//! A compute kernel in WGSL, run on the CPU as it stands.
//!
//! naga reads the text; the tree that it makes is carried out operation by operation, each rounded by itself in the order of
//! the text. So the kernel has a twin without a second text: what a driver makes of it with every operation rounded by itself
//! has to be the same in every bit, whatever compiled it.
//!
//! Invocations go side by side as in the warps of a GPU: those of one warp are at one place of the program, and an
//! operation that any of them needs passes all of them by. Both are counted, which says how well a kernel fills a warp.
//!
//! What kernels here do not use (textures, barriers, arrays that are indexed at run time outside of buffers, signed integers)
//! is refused when a program is made.
//!
//! | question | where |
//! |---|---|
//! | what a compiled kernel is made of; from naga's tree to that | `code.rs`, `compile.rs`, `values.rs` |
//! | what an operation does | `operation.rs` |
//! | which lanes take part | `machine.rs` |

mod code;
mod compile;
mod machine;
mod operation;
mod values;

use std::iter::Sum;
use std::ops::AddAssign;

use naga::valid::{Capabilities, ValidationFlags, Validator};

use code::Code;
use compile::compile;
use machine::Machine;

impl AddAssign for Count {
    fn add_assign(&mut self, other: Count) {
        self.issued += other.issued;
        self.useful += other.useful;
    }
}

impl Sum for Count {
    fn sum<I: Iterator<Item = Count>>(counts: I) -> Count {
        counts.fold(Count::default(), |mut all, one| {
            all += one;
            all
        })
    }
}

/// A kernel ready to be run.
#[derive(Debug)]
pub struct Program {
    code: Code,
}

/// What a run has cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Operations of warps, each with some of its lanes.
    pub issued: u64,
    /// Operations of lanes that took part.
    pub useful: u64,
}

impl Program {
    /// The kernel of a text: its entry point `main`, and buffers of group 0.
    ///
    /// # Errors
    /// What naga says of the text, or what in it is not known here.
    pub fn new(source: &str) -> Result<Program, String> {
        let module = naga::front::wgsl::parse_str(source).map_err(|why| why.emit_to_string(source))?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::FLOAT64)
            .validate(&module)
            .map_err(|why| why.emit_to_string(source))?;
        compile(&module, &info).map(|code| Program { code })
    }

    /// The names of the functions of the kernel, `main` first.
    #[must_use]
    pub fn functions(&self) -> &[String] {
        &self.code.functions
    }

    /// How many operations its text has, functions written out where they are called, and without
    /// branches that constants close.
    #[must_use]
    pub fn operations(&self) -> u64 {
        self.code.operations()
    }

    /// Runs `count` invocations in warps of `W` (64 at most). A buffer of a binding holds one scalar a word: the bits of an
    /// f32 or u32 as the lower half. An index beyond a buffer is that of its last word. Gives what each of its
    /// [`functions`](Program::functions) has cost, without those that it calls.
    ///
    /// # Panics
    /// When there are fewer buffers than bindings, or one of them is empty.
    pub fn run<const W: usize>(&self, count: usize, buffers: &mut [Vec<u64>]) -> Vec<Count> {
        const { assert!(W >= 1 && W <= 64, "a mask has 64 bits") };
        let mut machine = Machine::<W>::new(&self.code, buffers);
        for first in (0..count).step_by(W) {
            machine.warp(first, count);
        }
        machine.counts
    }
}
