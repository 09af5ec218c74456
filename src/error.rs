//! The one error type.

/// Why a run failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A map holds fewer or more records than its grid has instances.
    #[error("the map holds {records} records for {instances} instances; nothing was exported")]
    Incomplete {
        /// Records in the map.
        records: usize,
        /// Instances of the grid.
        instances: usize,
    },
    /// A map holds an instance that was never computed.
    #[error("instance {instance} was never computed; nothing was exported")]
    Unwritten {
        /// The first such instance.
        instance: usize,
    },
    /// A table could not be written.
    #[error("the table could not be written")]
    WriteTable(#[source] csv::Error),
    /// The manifest could not be written.
    #[error("the manifest could not be written")]
    WriteManifest(#[source] serde_json::Error),
    /// A figure is not a picture that can be drawn.
    #[error("the figure could not be read as SVG")]
    ReadSvg(#[source] resvg::usvg::Error),
    /// A figure is too large for an image, or its encoding failed.
    #[error("a picture of {width} × {height} pixels could not be made; plot fewer panels or points")]
    Rasterize {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// `modes` needs a numeric axis with at least two values.
    #[error(
        "modes needs an axis of numbers with at least 2 values, and [axes] has none; add one, e.g. mu_d = {{ from = 0.0, to = 0.6, points = 601 }}"
    )]
    NoModesAxis,
}

/// The crate's result.
pub type Result<T> = std::result::Result<T, Error>;
