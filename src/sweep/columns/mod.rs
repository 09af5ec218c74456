//! The one table of output columns.
//!
//! A row says of a column its name, unit and meaning, its name in print, which analysis has it, whether it is of the
//! measuring window, and where its values stand in a record. Tables, manifest, arrays, tiles, figures, readers and
//! `squealmap keys` read it: a column is added by a row of `table.rs` and a field that holds its value.

mod cell;
mod class;
mod column;
mod list;
mod table;
mod values;

pub use cell::Cell;
pub use class::Class;
pub use column::{Column, Group, LARGE_SUFFIX, Reading, Window};
pub use list::{columns, computed, find, numbers, shares};
pub use table::{REGIME, STATUS, TYPE};
pub use values::{Content, Place, Share, Values};
