//! One integration binary, one module per topic.

#![allow(clippy::doc_markdown, reason = "symbols of equations, such as μ_c or K_n, are no code")]
#![allow(clippy::needless_range_loop, reason = "indices of directions and nodes are those of the formulas")]
#![allow(clippy::neg_cmp_op_on_partial_ord, reason = "what is no number takes the branch of what is wrong")]

mod bad_input;
mod bonds;
mod cards;
mod cases;
mod contact;
mod critical;
mod cylinder;
mod damping;
mod elements;
mod files;
mod keys;
mod layer;
mod loads;
mod modal;
mod mortar;
mod nested;
mod order;
mod patch;
mod penalty;
mod picture;
mod pin;
mod real;
mod statics;
mod stressed;
mod study;
mod sweep;
mod turns;
mod two_masses;
mod vary;
