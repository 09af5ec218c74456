//! The program as its user meets it.

pub(crate) mod bad_input;
pub(crate) mod examples;
pub(crate) mod failed_sweeps;
pub(crate) mod hostile;
pub(crate) mod http;
pub(crate) mod loader;
pub(crate) mod newcomer;
pub(crate) mod no_driver;
pub(crate) mod no_threads;
pub(crate) mod program;
pub(crate) mod readme;
pub(crate) mod refine_report;
pub(crate) mod served;
pub(crate) mod stumbles;
pub(crate) mod talk;
pub(crate) mod terminal;
