//! What can be wrong with a model, as sentences.

/// Why a model cannot be solved. Each variant's sentence names the thing, its value and what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An element is turned inside out or has no volume.
    #[error(
        "element {element} ({kind}) has a Jacobian determinant of {determinant:.3e} at a corner or a point of \
         integration, which must be above 0: order its nodes as the format asks, or mesh that place again"
    )]
    Inverted {
        /// Index of the element in the mesh, from 0.
        element: usize,
        /// Name of its kind.
        kind: &'static str,
        /// The determinant, m³.
        determinant: f64,
    },
    /// An element names a node that is not there, or has the wrong number of them.
    #[error("element {element} ({kind}) {what}")]
    Connectivity {
        /// Index of the element in the mesh, from 0.
        element: usize,
        /// Name of its kind.
        kind: &'static str,
        /// What is wrong.
        what: String,
    },
    /// Constants of a material that no stable solid has.
    #[error("material {name}: {what}")]
    Material {
        /// Name of the material.
        name: String,
        /// The constant, its value and its limit.
        what: String,
    },
    /// A set that the mesh does not have.
    #[error("the mesh has no set \"{name}\"; it has {known}")]
    MissingSet {
        /// The name asked for.
        name: String,
        /// Names that there are.
        known: String,
    },
    /// Parts that nothing joins.
    #[error(
        "parts of the mesh hang on nothing, {count} in all, the smallest of {elements} elements: bond them by nodes or contact, \
         support them, or leave them out"
    )]
    Unconnected {
        /// Number of parts without any support.
        count: usize,
        /// Elements in the smallest one.
        elements: usize,
    },
    /// Sizes or counts that make no mesh.
    #[error("{what}")]
    Mesh {
        /// A sentence with the value and its limit.
        what: String,
    },
    /// Surfaces that do not match where they have to.
    #[error("{what}")]
    Contact {
        /// A sentence with the value and its limit.
        what: String,
    },
    /// Supports that contradict one another or are not enough.
    #[error("{what}")]
    Support {
        /// A sentence with the value and its limit.
        what: String,
    },
    /// A body that nothing holds in some direction.
    #[error(
        "the stiffness matrix is singular: a body can move without a force; hold it by supports in the directions in which it is free"
    )]
    Free,
    /// A factorisation or an iteration that did not come to an end.
    #[error("{what}")]
    Solver {
        /// A sentence with the value and its limit.
        what: String,
    },
    /// A key of a description that has a value it cannot have, or what is wrong with the thing it describes.
    #[error("{key}: {what}")]
    Key {
        /// The key, as `parts.pin.cells` or `loads[1].force`.
        key: String,
        /// A sentence with the value, its limit and what to do.
        what: String,
    },
    /// A description that is no TOML, or has keys that there are not.
    #[error("line {line}: {what}")]
    Description {
        /// Line of the text, from 1.
        line: usize,
        /// Its bytes.
        span: std::ops::Range<usize>,
        /// A sentence.
        what: String,
    },
    /// A file that cannot be read.
    #[error("line {line}: {what}")]
    File {
        /// Line of the file, from 1.
        line: usize,
        /// A sentence with the value and its limit.
        what: String,
    },
}

impl Error {
    /// What is wrong with the thing that a key describes.
    #[expect(clippy::needless_pass_by_value, reason = "sentences and errors are made where they are given")]
    pub(crate) fn at(key: impl Into<String>, what: impl ToString) -> Self {
        Self::Key { key: key.into(), what: what.to_string() }
    }
}
