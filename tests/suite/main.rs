//! One integration binary, one module per topic.

mod bad_input;
mod common;
mod linear;
mod response;
mod spec;
