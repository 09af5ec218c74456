//! What an operation does to the registers of all lanes.

use naga::BinaryOperator as Binary;

/// What the bits of a register mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    F32,
    F64,
    U32,
    Bool,
}

/// An operation without any effect but on the register it is for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Does {
    Copy,
    Two(Binary, Kind),
    Negate(Kind),
    Not,
    Abs(Kind),
    Sqrt(Kind),
    Min(Kind),
    Max(Kind),
    /// The third where the first is true, else the second.
    Select,
    Convert(Kind, Kind),
    /// The first and so many times the second.
    Along(u32),
}

/// `out = does(a, b, c)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Operation {
    pub(crate) does: Does,
    pub(crate) out: u32,
    pub(crate) from: [u32; 3],
}

/// A register of every lane.
pub(crate) type Register<const W: usize> = [u64; W];

fn f32_of(bits: u64) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "the lower half holds it")]
    f32::from_bits(bits as u32)
}

fn of_f32(value: f32) -> u64 {
    u64::from(value.to_bits())
}

fn u32_of(bits: u64) -> u32 {
    #[expect(clippy::cast_possible_truncation, reason = "the lower half holds it")]
    let low = bits as u32;
    low
}

fn one<const W: usize>(a: &Register<W>, f: impl Fn(u64) -> u64) -> Register<W> {
    std::array::from_fn(|lane| f(a[lane]))
}

fn two<const W: usize>(a: &Register<W>, b: &Register<W>, f: impl Fn(u64, u64) -> u64) -> Register<W> {
    std::array::from_fn(|lane| f(a[lane], b[lane]))
}

/// An operation on two numbers of one kind, by expressions in `$x` and `$y`.
macro_rules! numbers {
    ($a:expr, $b:expr, $kind:expr, |$x:ident, $y:ident| $float:expr, $whole:expr) => {
        match $kind {
            Kind::F32 => two($a, $b, |a, b| {
                let ($x, $y) = (f32_of(a), f32_of(b));
                of_f32($float)
            }),
            Kind::F64 => two($a, $b, |a, b| {
                let ($x, $y) = (f64::from_bits(a), f64::from_bits(b));
                ($float).to_bits()
            }),
            Kind::U32 | Kind::Bool => two($a, $b, |a, b| {
                let ($x, $y) = (u32_of(a), u32_of(b));
                u64::from($whole)
            }),
        }
    };
}

/// A comparison of two numbers of one kind.
macro_rules! compared {
    ($a:expr, $b:expr, $kind:expr, $operator:tt) => {
        match $kind {
            Kind::F32 => two($a, $b, |a, b| u64::from(f32_of(a) $operator f32_of(b))),
            Kind::F64 => two($a, $b, |a, b| u64::from(f64::from_bits(a) $operator f64::from_bits(b))),
            Kind::U32 | Kind::Bool => two($a, $b, |a, b| u64::from(a $operator b)),
        }
    };
}

impl Operation {
    /// Carries it out in every lane, whether it takes part or not.
    pub(crate) fn apply<const W: usize>(&self, registers: &mut [Register<W>]) {
        let [a, b, c] = self.from.map(|from| &registers[from as usize]);
        let value = match self.does {
            Does::Copy => *a,
            Does::Two(operator, kind) => binary(operator, kind, a, b),
            Does::Negate(Kind::F64) => one(a, |a| (-f64::from_bits(a)).to_bits()),
            Does::Negate(_) => one(a, |a| of_f32(-f32_of(a))),
            Does::Not => one(a, |a| a ^ 1),
            Does::Abs(Kind::F64) => one(a, |a| f64::from_bits(a).abs().to_bits()),
            Does::Abs(_) => one(a, |a| of_f32(f32_of(a).abs())),
            Does::Sqrt(Kind::F64) => one(a, |a| f64::from_bits(a).sqrt().to_bits()),
            Does::Sqrt(_) => one(a, |a| of_f32(f32_of(a).sqrt())),
            Does::Min(kind) => numbers!(a, b, kind, |x, y| if y < x { y } else { x }, x.min(y)),
            Does::Max(kind) => numbers!(a, b, kind, |x, y| if x < y { y } else { x }, x.max(y)),
            Does::Select => std::array::from_fn(|lane| if a[lane] == 0 { b[lane] } else { c[lane] }),
            Does::Convert(from, to) => one(a, |a| convert(a, from, to)),
            Does::Along(stride) => two(a, b, |a, b| a.wrapping_add(u64::from(stride) * b)),
        };
        registers[self.out as usize] = value;
    }
}

#[expect(clippy::float_cmp, reason = "the kernel's own comparison")]
fn binary<const W: usize>(operator: Binary, kind: Kind, a: &Register<W>, b: &Register<W>) -> Register<W> {
    match operator {
        Binary::Add => numbers!(a, b, kind, |x, y| x + y, x.wrapping_add(y)),
        Binary::Subtract => numbers!(a, b, kind, |x, y| x - y, x.wrapping_sub(y)),
        Binary::Multiply => numbers!(a, b, kind, |x, y| x * y, x.wrapping_mul(y)),
        // By nothing: as naga has it.
        Binary::Divide => numbers!(a, b, kind, |x, y| x / y, x.checked_div(y).unwrap_or(x)),
        Binary::Modulo => numbers!(a, b, kind, |x, y| x % y, x.checked_rem(y).unwrap_or(0)),
        Binary::Equal => compared!(a, b, kind, ==),
        Binary::NotEqual => compared!(a, b, kind, !=),
        Binary::Less => compared!(a, b, kind, <),
        Binary::LessEqual => compared!(a, b, kind, <=),
        Binary::Greater => compared!(a, b, kind, >),
        Binary::GreaterEqual => compared!(a, b, kind, >=),
        Binary::And | Binary::LogicalAnd => two(a, b, |a, b| a & b),
        Binary::InclusiveOr | Binary::LogicalOr => two(a, b, |a, b| a | b),
        Binary::ExclusiveOr => two(a, b, |a, b| a ^ b),
        Binary::ShiftLeft => two(a, b, |a, b| u64::from(u32_of(a) << (b & 31))),
        Binary::ShiftRight => two(a, b, |a, b| u64::from(u32_of(a) >> (b & 31))),
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "the kernel's own conversion"
)]
fn convert(bits: u64, from: Kind, to: Kind) -> u64 {
    match (from, to) {
        (Kind::F32, Kind::F64) => f64::from(f32_of(bits)).to_bits(),
        (Kind::F64, Kind::F32) => of_f32(f64::from_bits(bits) as f32),
        (Kind::U32 | Kind::Bool, Kind::F32) => of_f32(u32_of(bits) as f32),
        (Kind::U32 | Kind::Bool, Kind::F64) => f64::from(u32_of(bits)).to_bits(),
        (Kind::F32, Kind::U32) => u64::from(f32_of(bits) as u32),
        (Kind::F64, Kind::U32) => u64::from(f64::from_bits(bits) as u32),
        (_, Kind::Bool) => u64::from(bits != 0),
        (Kind::F32, Kind::F32) | (Kind::F64, Kind::F64) | (Kind::U32 | Kind::Bool, Kind::U32) => bits,
    }
}
