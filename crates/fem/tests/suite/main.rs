//! One integration binary, one module per topic.

mod cases;
mod damping;
mod elements;
mod layer;
mod patch;
mod pin;
mod statics;
