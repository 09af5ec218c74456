//! One integration binary, one module per topic.

mod cli;
mod colour;
mod common;
mod engine;
mod engines;
mod floors;
mod instances;
mod model;
mod results;
mod store;
mod study;
mod sweep;
mod synthetic;
mod twin;
