//! A sweep that is open.

use crate::store::description::Description;
use crate::study::explore::finished::Finished;
use crate::sweep::grid::{Axis, Grid};
use crate::sweep::spec::Spec;

/// A sweep that is open.
#[derive(Clone, Debug)]
pub struct Opened {
    /// The sweep.
    pub spec: Spec,
    /// Its axes.
    pub axes: Vec<Axis>,
    /// What a run has computed of it.
    pub finished: Option<Finished>,
}

impl Opened {
    /// Opens the sweep of a description, which is that of a directory of tiles.
    ///
    /// # Errors
    /// A sentence, when it is none of this version, or the sweep has not two axes of numbers.
    pub fn described(description: &[u8]) -> Result<Opened, String> {
        let json =
            serde_json::from_slice(description).map_err(|why| format!("the sweep is no JSON: {why}"))?;
        let description = Description::from_json(&json).map_err(|why| format!("the sweep: {why}"))?;
        let spec =
            description.spec_as_read().ok_or("the sweep was described by another version of this program")?;
        Opened::new(spec)
    }

    /// Opens a sweep.
    ///
    /// # Errors
    /// A sentence, when it has not two axes of numbers.
    pub fn new(spec: Spec) -> Result<Opened, String> {
        let Grid::Axes(axes) = &spec.grid else {
            return Err("a sweep of single points has no plane to look into; give it `[axes]`".to_owned());
        };
        let axes = axes.clone();
        if spec.grid.axes_of_numbers().count() < 2 {
            return Err("a map to look into needs two axes of numbers in `[axes]`".to_owned());
        }
        Ok(Opened { spec, axes, finished: None })
    }
}
