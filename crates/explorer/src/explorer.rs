//! Questions to a sweep that is open.

use serde::Deserialize;
use squealmap::sweep::spec::Spec;

use crate::answer::Answer;
use crate::device::OnDevice;
use crate::opened::Opened;
use crate::{about, cell, file, region};

/// A question, by its key `ask`.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "lowercase", deny_unknown_fields)]
pub enum Question {
    /// What varies, what may be varied, which columns there are: see [`about`].
    About {},
    /// The cells of a rectangle: see [`region`].
    Region(region::Region),
    /// One instance: see [`cell`].
    Cell(cell::Wanted),
    /// A region as a sweep file: see [`mod@file`].
    File(region::Region),
}

/// A sweep that is open, to be asked.
#[derive(Clone, Debug)]
pub struct Explorer(Opened);

impl Explorer {
    /// See [`Opened::described`].
    ///
    /// # Errors
    /// Those of it.
    pub fn open(description: &[u8]) -> Result<Explorer, String> {
        Opened::described(description).map(Explorer)
    }

    /// See [`Opened::new`].
    ///
    /// # Errors
    /// Those of it.
    pub fn new(spec: Spec) -> Result<Explorer, String> {
        Opened::new(spec).map(Explorer)
    }

    /// A region that a GPU is to compute.
    ///
    /// # Errors
    /// When it cannot; see [`OnDevice::new`].
    pub fn on_device(&self, question: &str) -> Result<OnDevice, String> {
        let region = serde_json::from_str(question).map_err(|why| format!("this is no region: {why}"))?;
        OnDevice::new(&region, &self.0)
    }

    /// The answer to a question; an error is a sentence.
    ///
    /// # Errors
    /// When the question is none, names what is not there, or asks for more than may be asked for at once.
    pub fn answer(&self, question: &str) -> Result<Answer, String> {
        let question = serde_json::from_str(question).map_err(|why| format!("this is no question: {why}"))?;
        match question {
            Question::About {} => Ok(about::about(&self.0)),
            Question::Region(region) => region.answer(&self.0),
            Question::Cell(wanted) => wanted.answer(&self.0),
            Question::File(region) => file::file(&self.0, &region),
        }
    }
}
