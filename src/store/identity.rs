//! Which sweep a tile belongs to: everything that its numbers depend on, in one canonical text, and its hash.

use crate::engine::computation::Computation;
use crate::store::grid_json::{GRID, PHYSICS, Whole, to_json};
use crate::sweep::grid::Rows;
use crate::sweep::spec::Spec;
use crate::version::{COMMIT, VERSION};
use std::fmt;
use std::io::{BufWriter, Write};

use serde_json::{Map as Object, Value as Json, json};

/// BLAKE3 of a canonical text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Id(pub [u8; 32]);

impl Id {
    /// The id of a JSON value: keys sorted, no blanks, every number in the shortest form that reads back to the
    /// same bits.
    #[must_use]
    pub fn of(value: &Json) -> Id {
        Id::of_whole(&Whole { json: value, rows: None, sorted: true })
    }

    /// The id of an [`identity`] whose rows, if it has any, stand beside it.
    #[must_use]
    pub fn with_rows(value: &Json, rows: Option<&Rows>) -> Id {
        Id::of_whole(&Whole { json: value, rows, sorted: true })
    }

    /// The text goes into the hash as it is made: that of many rows is never held.
    fn of_whole(whole: &Whole) -> Id {
        let mut text = BufWriter::new(blake3::Hasher::new());
        serde_json::to_writer(&mut text, whole).expect("a hash takes any text");
        text.flush().expect("a hash takes any text");
        Id(*text.get_ref().finalize().as_bytes())
    }
}

impl fmt::Display for Id {
    /// 64 hexadecimal digits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(blake3::Hash::from_bytes(self.0).to_hex().as_str())
    }
}

/// What the numbers of a sweep depend on: the physics with all defaults, the program, the methods. Titles, threads
/// and the name of an adapter are left out. The rows of a file of points stand beside it, see [`to_json`].
#[must_use]
pub fn identity(spec: &Spec, computations: &[Option<Computation>; 2]) -> Json {
    let mut physics = Object::new();
    if let Json::Object(entries) = spec.resolved() {
        for (key, value) in entries {
            match key.as_str() {
                "title" => {}
                // With the order of the axes, and with the rows of a file of tuples.
                "axes" | "points" => drop(physics.insert(GRID.to_owned(), to_json(&spec.grid))),
                _ => drop(physics.insert(key, value)),
            }
        }
    }
    let [linear, response] = computations.each_ref().map(|made| {
        made.as_ref().map(|made| {
            json!({
                "backend": made.backend, "precision": made.precision, "method": made.method,
                "strict": made.strict,
            })
        })
    });
    json!({
        "program": { "name": env!("CARGO_PKG_NAME"), "version": VERSION, "git_commit": COMMIT },
        "linear": linear,
        "response": response,
        PHYSICS: physics,
    })
}

/// The engine of a sweep in a few words: `cpu f64`, `gpu f32 strict`.
#[must_use]
pub fn kind(computations: &[Option<Computation>; 2]) -> String {
    let [linear, response] = computations;
    response.as_ref().or(linear.as_ref()).map_or_else(String::new, |made| {
        let strict = if made.strict == Some(true) { " strict" } else { "" };
        format!("{} {}{strict}", made.backend, made.precision)
    })
}
