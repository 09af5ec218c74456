//! One integration binary, one module per topic.

mod colour;
mod export;
mod figure;
mod synthetic;
