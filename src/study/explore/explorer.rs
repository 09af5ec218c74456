//! Questions to a sweep that is open.

use serde::Deserialize;

use crate::study::explore::answer::Answer;
use crate::study::explore::by::By;
use crate::study::explore::finished::Finished;
use crate::study::explore::opened::Opened;
use crate::study::explore::{about, cell, file, region};
use crate::sweep::spec::Spec;

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

    /// The same, with what a run has computed of it.
    #[must_use]
    pub fn with(mut self, finished: Finished) -> Explorer {
        self.0.finished = Some(finished);
        self
    }

    /// What is open.
    #[must_use]
    pub fn opened(&self) -> &Opened {
        &self.0
    }

    /// The answer to a question by the engine of the CPU; an error is a sentence.
    ///
    /// # Errors
    /// When the question is none, names what is not there, or asks for more than may be asked for at once.
    pub fn answer(&self, question: &str) -> Result<Answer, String> {
        self.answer_by(question, &By::cpu())
    }

    /// The answer to a question by an engine; an error is a sentence.
    ///
    /// # Errors
    /// Those of [`Explorer::answer`], and when the engine cannot compute it or is stopped.
    pub fn answer_by(&self, question: &str, by: &By<'_>) -> Result<Answer, String> {
        let question = serde_json::from_str(question).map_err(|why| format!("this is no question: {why}"))?;
        match question {
            Question::About {} => Ok(about::about(&self.0)),
            Question::Region(region) => region.answer(&self.0, by),
            Question::Cell(wanted) => wanted.answer(&self.0),
            Question::File(region) => file::file(&self.0, &region),
        }
    }
}
