//! One integration binary, one module per topic.

mod bad_input;
mod cli;
mod common;
mod export;
mod linear;
mod response;
mod spec;
mod sweeps;
mod synthetic;
