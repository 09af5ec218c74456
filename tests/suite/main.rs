//! One integration binary, one module per topic.

mod accuracy;
mod arrays;
mod bad_input;
mod bistable;
mod bistable_files;
mod checks;
mod claims;
mod cli;
mod colour;
mod common;
mod crossings;
mod engines;
mod events;
mod exact;
mod export;
mod extremes;
mod fastest;
mod figure;
mod fit;
mod fuzz;
mod hysteresis;
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
mod limits;
mod linear;
mod methods;
mod modes_figure;
mod no_driver;
mod observables;
mod paper;
mod parquet;
mod plot;
mod promise;
mod properties;
mod refine;
mod regimes;
mod response;
mod resume;
mod reuse;
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
#[cfg(unix)]
mod submit;
mod sweeps;
mod synthetic;
mod tile_cost;
mod tiles;
mod trace_figure;
#[cfg(unix)]
mod unwritable;
