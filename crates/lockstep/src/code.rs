//! A kernel as operations on registers, one scalar each, and the statements around them.

use crate::operation::Operation;

/// Registers of constants, before all others.
pub(crate) const CONSTANTS: u32 = 1024;

/// A compiled kernel.
#[derive(Debug)]
pub(crate) struct Code {
    pub(crate) body: Vec<Node>,
    /// The values of the first registers.
    pub(crate) constants: Vec<u64>,
    /// All registers.
    pub(crate) registers: u32,
    /// What is known of an invocation, and the registers that have it.
    pub(crate) arguments: Vec<(Place, u32)>,
    /// Invocations of a workgroup.
    pub(crate) workgroup: u32,
}

/// A statement.
#[derive(Debug)]
pub(crate) enum Node {
    /// Operations that every lane may carry out, and how many of them count.
    Operations {
        list: Vec<Operation>,
        counted: u64,
    },
    /// Sets a variable.
    Put {
        to: u32,
        from: u32,
    },
    /// Reads a word of a buffer.
    Load {
        to: u32,
        buffer: usize,
        base: Option<u32>,
        offset: u32,
    },
    /// Writes a word of a buffer.
    Store {
        from: u32,
        buffer: usize,
        base: Option<u32>,
        offset: u32,
    },
    /// Adds to a word of a buffer, and remembers what was there.
    Add {
        from: u32,
        buffer: usize,
        base: Option<u32>,
        offset: u32,
        before: Option<u32>,
    },
    If {
        condition: u32,
        accept: Vec<Node>,
        reject: Vec<Node>,
    },
    Loop {
        body: Vec<Node>,
        continuing: Vec<Node>,
        break_if: Option<u32>,
    },
    /// A function, written out where it is called.
    Call(Vec<Node>),
    Break,
    Continue,
    Return,
}

/// What an argument of the entry point is of an invocation.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Place {
    Workgroup,
    Workgroups,
    Local,
    Global,
    Zero,
    One,
}
