//! One integration binary, one module per topic.

mod export;
mod synthetic;
