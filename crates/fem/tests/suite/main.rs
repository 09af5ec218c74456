//! One integration binary, one module per topic.

mod cases;
mod elements;
mod layer;
mod patch;
mod pin;
