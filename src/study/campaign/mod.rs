//! A campaign of braking tests: what each stroke of its records says, and what strokes of one condition have in common.

pub mod condition;
pub mod figure;
pub mod read;
pub mod row;
