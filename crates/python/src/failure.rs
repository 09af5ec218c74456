//! Why there is no result, as a Python exception with the sentence of the program.

use std::error::Error as _;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use squealmap_input::quote::message;

/// Whose fault it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Input,
    Run,
    Panic,
}

/// Why there is no result.
#[derive(Debug)]
pub(crate) struct Failure {
    kind: Kind,
    sentence: String,
    /// What the sentence follows from, the nearest first.
    causes: Vec<String>,
}

impl Failure {
    /// Input that is refused.
    pub(crate) fn input(sentence: impl Into<String>) -> Failure {
        Failure { kind: Kind::Input, sentence: message(&sentence.into()), causes: Vec::new() }
    }

    /// Work that has no result.
    pub(crate) fn run(sentence: impl Into<String>) -> Failure {
        Failure { kind: Kind::Run, sentence: message(&sentence.into()), causes: Vec::new() }
    }

    /// A fault of the program itself.
    pub(crate) fn panic(said: &str) -> Failure {
        let sentence = format!(
            "squealmap has a fault: {said}; please report it with what you called, see the page of the package"
        );
        Failure { kind: Kind::Panic, sentence, causes: Vec::new() }
    }

    /// As an exception of the package.
    pub(crate) fn raised(&self, py: Python<'_>) -> PyErr {
        let name = match self.kind {
            Kind::Input => "InputError",
            Kind::Run | Kind::Panic => "Error",
        };
        let made = py.import("squealmap._errors").and_then(|module| module.getattr(name));
        let error = match made.and_then(|class| class.call1((self.sentence.as_str(),))) {
            Ok(exception) => PyErr::from_value(exception),
            Err(_) => PyRuntimeError::new_err(self.sentence.clone()),
        };
        let mut causes = self.causes.iter().rev();
        if let Some(last) = causes.next() {
            let first = causes.fold(PyRuntimeError::new_err(last.clone()), |below, cause| {
                let error = PyRuntimeError::new_err(cause.clone());
                error.set_cause(py, Some(below));
                error
            });
            error.set_cause(py, Some(first));
        }
        error
    }
}

impl<E: Into<squealmap::Error>> From<E> for Failure {
    fn from(why: E) -> Failure {
        let why: squealmap::Error = why.into();
        let causes = std::iter::successors(why.source(), |cause: &&(dyn std::error::Error + 'static)| {
            (*cause).source()
        });
        Failure {
            kind: if why.is_bad_input() { Kind::Input } else { Kind::Run },
            sentence: message(&why.to_string()),
            causes: causes.map(|cause| message(&cause.to_string())).collect(),
        }
    }
}
