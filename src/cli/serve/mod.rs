//! A server for the page of one sweep, on this machine alone: it answers what the page asks by the engines of the program.
//!
//! | question | where |
//! |---|---|
//! | a request, read within bounds | `request.rs` |
//! | which requests are let in | `guard.rs` |
//! | what is answered, and how it is written | `reply.rs` |
//! | the page with what it needs to ask here | `served.rs` |
//! | a question at work, dropped when nobody waits for it | [`work`] |
//! | connections | [`server`] |
//! | the browser of whoever looks | `browser.rs` |

pub(crate) mod browser;
mod guard;
mod reply;
mod request;
pub(crate) mod served;
pub mod server;
pub mod work;
