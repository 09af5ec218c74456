//! One integration binary, one module per topic.

mod bad_input;
mod spec;
