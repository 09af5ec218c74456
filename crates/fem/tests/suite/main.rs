//! One integration binary, one module per topic.

mod bad_input;
mod cases;
mod damping;
mod elements;
mod files;
mod layer;
mod mortar;
mod patch;
mod pin;
mod statics;
