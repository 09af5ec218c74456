//! What a user wrote: files, places in them, and how a sentence quotes them.

pub mod files;
pub mod place;
pub mod quote;
