//! The spine: spec → records → map.

use std::time::Instant;

use crate::backend::cpu;
use crate::error::Result;
use crate::map::{Map, Provenance};
use crate::spec::Spec;

/// Computes a sweep on the rayon pool it is called in; `progress` gets the number of newly finished instances.
///
/// # Errors
/// When an instance was left unwritten.
pub fn run(spec: Spec, progress: &(dyn Fn(usize) + Sync)) -> Result<Map> {
    let began = Instant::now();
    let records = cpu::records(&spec, progress);
    let provenance = Provenance {
        backend: cpu::NAME.to_owned(),
        precision: "f64".to_owned(),
        method: cpu::METHOD.to_owned(),
        threads: rayon::current_num_threads(),
        elapsed: began.elapsed(),
    };
    Ok(Map { spec, records, provenance })
}
