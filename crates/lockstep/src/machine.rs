//! The lanes of a warp: which of them take part, and what they read and write.

use crate::Count;
use crate::code::{CONSTANTS, Code, Node, Place};
use crate::operation::Register;

/// One warp after the other.
pub(crate) struct Machine<'a, const W: usize> {
    code: &'a Code,
    buffers: &'a mut [Vec<u64>],
    registers: Vec<Register<W>>,
    /// What each function has cost, without those that it calls.
    pub(crate) counts: Vec<Count>,
    /// The function that is carried out.
    function: usize,
}

/// Lanes that have left the loop, or this turn of it.
#[derive(Clone, Copy, Default)]
struct Left {
    broken: u64,
    continued: u64,
}

impl<'a, const W: usize> Machine<'a, W> {
    pub(crate) fn new(code: &'a Code, buffers: &'a mut [Vec<u64>]) -> Self {
        let mut registers = vec![[0; W]; code.registers as usize];
        for (register, bits) in registers[..CONSTANTS as usize].iter_mut().zip(&code.constants) {
            *register = [*bits; W];
        }
        let counts = vec![Count::default(); code.functions.len()];
        Machine { code, buffers, registers, counts, function: 0 }
    }

    /// Runs the invocations of a warp from `first` on, of `count` in all.
    pub(crate) fn warp(&mut self, first: usize, count: usize) {
        let code = self.code;
        let size = code.workgroup as usize;
        for (place, register) in &code.arguments {
            self.registers[*register as usize] = std::array::from_fn(|lane| {
                let invocation = first + lane;
                let value = match place {
                    Place::Workgroup => invocation / size,
                    Place::Workgroups => count.div_ceil(size),
                    Place::Local => invocation % size,
                    Place::Global => invocation,
                    Place::Zero => 0,
                    Place::One => 1,
                };
                value as u64
            });
        }
        let lanes = (count - first).min(W);
        let active = if lanes == 64 { u64::MAX } else { (1 << lanes) - 1 };
        self.block(&code.body, active, &mut Left::default());
    }

    /// Carries out a block; the lanes that come to its end.
    fn block(&mut self, nodes: &[Node], mut active: u64, left: &mut Left) -> u64 {
        for node in nodes {
            if active == 0 {
                break;
            }
            active = self.node(node, active, left);
        }
        active
    }

    fn node(&mut self, node: &Node, active: u64, left: &mut Left) -> u64 {
        match node {
            Node::Operations { list, counted } => {
                for operation in list {
                    operation.apply(&mut self.registers);
                }
                self.counts(*counted, active);
                active
            }
            Node::Put { to, from } => {
                let value = self.registers[*from as usize];
                let register = &mut self.registers[*to as usize];
                for lane in 0..W {
                    if active >> lane & 1 == 1 {
                        register[lane] = value[lane];
                    }
                }
                active
            }
            Node::Load { to, buffer, base, offset } => {
                let words = &self.buffers[*buffer];
                let base = base.map(|base| self.registers[base as usize]);
                self.registers[*to as usize] = std::array::from_fn(|lane| {
                    words[address(words.len(), base.map(|base| base[lane]), *offset)]
                });
                self.counts(1, active);
                active
            }
            Node::Store { from, buffer, base, offset } => {
                self.each_word([*from, *offset], *buffer, *base, active, |word, value| *word = value);
                active
            }
            Node::Add { from, buffer, base, offset, before } => {
                let mut was = [0; W];
                let mut lanes = (0..W).filter(|lane| active >> lane & 1 == 1);
                self.each_word([*from, *offset], *buffer, *base, active, |word, value| {
                    was[lanes.next().unwrap_or(0)] = *word;
                    *word += value;
                });
                if let Some(before) = before {
                    self.registers[*before as usize] = was;
                }
                active
            }
            Node::If { condition, accept, reject } => {
                let yes = self.lanes(*condition) & active;
                let accepted = self.block(accept, yes, left);
                accepted | self.block(reject, active & !yes, left)
            }
            Node::Loop { body, continuing, break_if } => {
                let outer = std::mem::take(left);
                let mut running = active;
                let mut out = 0;
                while running != 0 {
                    let ended = self.block(body, running, left);
                    out |= std::mem::take(&mut left.broken);
                    running = ended | std::mem::take(&mut left.continued);
                    running = self.block(continuing, running, left);
                    if let Some(condition) = break_if {
                        let breaks = self.lanes(*condition) & running;
                        out |= breaks;
                        running &= !breaks;
                    }
                }
                *left = outer;
                out
            }
            Node::Call { function, body } => {
                let caller = std::mem::replace(&mut self.function, *function);
                self.block(body, active, &mut Left::default());
                self.function = caller;
                active
            }
            Node::Break => {
                left.broken |= active;
                0
            }
            Node::Continue => {
                left.continued |= active;
                0
            }
            // They go on behind the call, or not at all.
            Node::Return => 0,
        }
    }

    /// Does something to the word of a buffer of every lane that takes part, with the lane's value of a register.
    fn each_word(
        &mut self,
        [from, offset]: [u32; 2],
        buffer: usize,
        base: Option<u32>,
        active: u64,
        mut does: impl FnMut(&mut u64, u64),
    ) {
        let (values, words) = (&self.registers[from as usize], &mut self.buffers[buffer]);
        let base = base.map(|base| &self.registers[base as usize]);
        let length = words.len();
        for lane in (0..W).filter(|lane| active >> lane & 1 == 1) {
            does(&mut words[address(length, base.map(|base| base[lane]), offset)], values[lane]);
        }
        self.counts(1, active);
    }

    /// The lanes in which a register is true.
    fn lanes(&self, register: u32) -> u64 {
        let values = &self.registers[register as usize];
        values.iter().enumerate().fold(0, |mask, (lane, value)| mask | u64::from(*value != 0) << lane)
    }

    fn counts(&mut self, operations: u64, active: u64) {
        self.counts[self.function] +=
            Count { issued: operations, useful: operations * u64::from(active.count_ones()) };
    }
}

/// The word of a buffer at a base and an offset, no further than its last.
fn address(length: usize, base: Option<u64>, offset: u32) -> usize {
    let at = base.unwrap_or(0) + u64::from(offset);
    usize::try_from(at).unwrap_or(usize::MAX).min(length - 1)
}
