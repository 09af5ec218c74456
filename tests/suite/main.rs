//! One integration binary, one module per topic.

mod common;
mod events;
mod extremes;
mod linear;
mod properties;
mod response;
