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
    /// The names of the functions, `main` first.
    pub(crate) functions: Vec<String>,
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
    /// A function by its number, written out where it is called.
    Call {
        function: usize,
        body: Vec<Node>,
    },
    Break,
    Continue,
    Return,
}

impl Code {
    /// How many operations stand in its text, each once however often it is carried out; what no lane can come to aside.
    pub(crate) fn operations(&self) -> u64 {
        self.within(&self.body)
    }

    fn within(&self, nodes: &[Node]) -> u64 {
        let of = |node: &Node| match node {
            Node::Operations { counted, .. } => *counted,
            Node::Load { .. } | Node::Store { .. } | Node::Add { .. } => 1,
            Node::If { condition, accept, reject } => match self.constants.get(*condition as usize) {
                Some(0) => self.within(reject),
                Some(_) => self.within(accept),
                None => self.within(accept) + self.within(reject),
            },
            Node::Loop { body, continuing, .. } => self.within(body) + self.within(continuing),
            Node::Call { body, .. } => self.within(body),
            Node::Put { .. } | Node::Break | Node::Continue | Node::Return => 0,
        };
        nodes.iter().map(of).sum()
    }
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
