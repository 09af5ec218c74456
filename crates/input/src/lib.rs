//! The input of a user: files, places in them, and quotations from them in sentences.

pub mod files;
pub mod place;
pub mod quote;
