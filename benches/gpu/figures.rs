//! What a compiler says of a kernel, in one set of names.

/// The figures of a kernel by a compiler; `None` where it does not say.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Figures {
    /// Registers of an invocation, 32 bits each.
    pub(crate) registers: Option<f64>,
    /// Registers that had no room: their number, or the stores that spill them.
    pub(crate) spills: Option<f64>,
    /// Memory of an invocation beside its registers, bytes.
    pub(crate) scratch: Option<f64>,
    /// Code, bytes.
    pub(crate) code: Option<f64>,
    /// Instructions.
    pub(crate) instructions: Option<f64>,
    /// Subgroups that fit a SIMD or multiprocessor at a time.
    pub(crate) subgroups: Option<f64>,
    /// Invocations of a subgroup.
    pub(crate) width: Option<f64>,
}

impl Figures {
    /// Names of [`Figures::values`], as columns.
    pub(crate) const NAMES: [&str; 7] =
        ["registers", "spills", "scratch_bytes", "code_bytes", "instructions", "subgroups", "subgroup_size"];

    /// Those that have to stay low, by their place in [`Figures::values`].
    pub(crate) const HELD: [usize; 5] = [0, 1, 2, 3, 4];

    /// One for each of [`Figures::NAMES`].
    pub(crate) fn values(&self) -> [Option<f64>; 7] {
        [self.registers, self.spills, self.scratch, self.code, self.instructions, self.subgroups, self.width]
    }

    /// Those of [`Figures::HELD`].
    pub(crate) fn held_mut(&mut self) -> [&mut Option<f64>; 5] {
        [&mut self.registers, &mut self.spills, &mut self.scratch, &mut self.code, &mut self.instructions]
    }

    /// From the statistics of a driver of Mesa, each of which has its own names.
    pub(crate) fn of_mesa(told: &[(&str, f64)]) -> Figures {
        let of = |names: &[&str]| {
            names.iter().find_map(|name| told.iter().find(|(one, _)| one == name)).map(|(_, value)| *value)
        };
        // Adreno counts registers of four words.
        let vectors = of(&["Registers used"]).map(|vectors| 4.0 * vectors);
        Figures {
            registers: of(&["VGPRs", "Number of GPRs", "GPRs"]).or(vectors),
            spills: of(&["Spilled VGPRs", "Spills to memory", "Spills", "STP Count"]),
            scratch: of(&["Scratch size", "SLM size", "Scratch"]),
            code: of(&["Code size"]),
            instructions: of(&["Instructions", "Instruction count", "Instruction Count"]),
            subgroups: of(&["Subgroups per SIMD", "Max warps/SM", "Max Waves Per Core"]),
            width: of(&["Subgroup size"]),
        }
    }
}
