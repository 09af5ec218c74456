//! Why there is no figure.

/// Why a document could not be drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The document is not the SVG it should be.
    #[error("the figure could not be read as SVG")]
    ReadSvg(#[source] resvg::usvg::Error),
    /// Elements within elements beyond measure.
    #[error("the figure has {depth} elements within one another, but at most {most} are drawn")]
    Nested {
        /// How many.
        depth: usize,
        /// How many are drawn.
        most: usize,
    },
    /// A figure is too large for an image, or its encoding failed.
    #[error("a picture of {width} × {height} pixels could not be made; plot fewer panels or points")]
    Rasterize {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// A PDF that cannot be made.
    #[error("the figure could not be written as PDF: {why}")]
    Pdf {
        /// What the library says.
        why: String,
    },
}

/// The result of drawing.
pub type Result<T> = std::result::Result<T, Error>;
