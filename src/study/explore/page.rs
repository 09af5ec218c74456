//! The page of a sweep: its map, computed where it is looked at.
//!
//! The page is one file that asks nothing of anywhere: engines as WebAssembly, styles, program, and the sweep. `crates/explorer`
//! makes it; here the sweep is put in.

use serde_json::{Value as Json, json};

use crate::engine::backend::Backend;
use crate::engine::options::Options;
use crate::results::figure::palette::{Class, Colouring};
use crate::store::description::Description;
use crate::study::error::{Error, Result};
use crate::sweep::solver::Solver;
use crate::sweep::spec::Spec;

/// Where the sweep goes in the page.
const PLACE: &str = "<!--sweep-->";

/// The page of a sweep, which stands in a `file` of this name, from the page without one.
///
/// # Errors
/// When the sweep has no two axes of numbers, or the page has no place for it.
pub fn page(spec: &Spec, file: &str, empty: &str) -> Result<Vec<u8>> {
    if spec.grid.axes_of_numbers().count() < 2 {
        return Err(Error::NothingToExplore);
    }
    let options = Options { backend: Backend::Cpu, ..Options::default() };
    let computations = Solver::new(spec, &options).map_err(crate::sweep::error::Error::from)?.computations();
    let description = Description::new(spec, computations, spec.grid.len()).to_json();
    let given = json!({
        // As a text: a browser would write its numbers in other digits, and the sweep has a checksum.
        "description": description.to_string(),
        "file": file,
        "classes": { "type": classes(Colouring::Type), "regime": classes(Colouring::Regime) },
    });
    // A program inside of HTML ends at `</script`.
    let given = given.to_string().replace('<', "\\u003c");
    let (before, after) = empty.split_once(PLACE).ok_or(Error::NoPage)?;
    Ok([before, r#"<script id="sweep" type="application/json">"#, &given, "</script>", after]
        .concat()
        .into_bytes())
}

/// The classes of a colouring, as legends have them.
fn classes(colouring: Colouring) -> Vec<Json> {
    let one = |class: &Class| json!({ "name": class.name, "label": class.label, "fill": class.fill });
    colouring.classes().iter().map(one).collect()
}
