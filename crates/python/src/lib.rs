//! The part of the Python package `squealmap` that is compiled: sweeps and studies as columns, and the program itself.
//!
//! | question | where |
//! |---|---|
//! | a sweep from Python, and what computes it | `sweep` |
//! | maps, the lines of maps; tiles of a directory | `map`, `refine`, `tiles` |
//! | eigenvalues along an axis, one instance in time | `modes`, `trace` |
//! | measured signals and friction | `signals`, `material` |
//! | bodies in contact | `bodies` |
//! | columns as Python sees them; tables of text | `dataset`, `table` |
//! | figures; the program | `figure`, `program` |
//! | work beside the interpreter; why there is no result | `watch`, `failure` |
//!
//! What users see stands in `crates/python/python/squealmap`; the names here are its own business.

#![expect(clippy::needless_pass_by_value, reason = "Python hands values over")]

mod bodies;
mod dataset;
mod failure;
mod figure;
mod map;
mod material;
mod modes;
mod program;
mod refine;
mod signals;
mod sweep;
mod table;
mod tiles;
mod trace;
mod watch;

use pyo3::prelude::*;

/// The compiled part of the package `squealmap`.
#[pymodule(name = "_squealmap")]
mod module {
    #[pymodule_export]
    use crate::bodies::fem;
    #[pymodule_export]
    use crate::figure::{figure, rendered, write_table};
    #[pymodule_export]
    use crate::map::run;
    #[pymodule_export]
    use crate::material::fit;
    #[pymodule_export]
    use crate::modes::modes;
    #[pymodule_export]
    use crate::program::main;
    #[pymodule_export]
    use crate::refine::refine;
    #[pymodule_export]
    use crate::signals::identify;
    #[pymodule_export]
    use crate::tiles::Tiles;
    #[pymodule_export]
    use crate::trace::trace;
    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("version", squealmap::version::VERSION)?;
        module.add("commit", squealmap::version::COMMIT)
    }
}
