//! One integration binary, one module per topic.

mod arrays;
mod bad_input;
mod claims;
mod cli;
mod colour;
mod common;
mod events;
mod export;
mod extremes;
mod figure;
mod fit;
mod identify;
mod instances;
#[cfg(unix)]
mod interrupt;
mod kernel_linear;
mod kernel_response;
mod kernels;
#[cfg(unix)]
mod killed;
mod label;
mod linear;
mod modes_figure;
mod no_driver;
mod observables;
mod paper;
mod plot;
mod properties;
mod regimes;
mod response;
mod resume;
mod settle;
mod shards;
mod simd;
mod single;
mod spec;
mod start;
mod stopped;
mod stretches;
mod strict;
mod strokes;
mod sweeps;
mod synthetic;
mod tile_cost;
mod tiles;
mod trace_figure;
