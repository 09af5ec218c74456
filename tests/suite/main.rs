//! One integration binary, one module per topic.

mod common;
mod linear;
mod response;
