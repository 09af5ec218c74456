//! The projected problem.

use faer::Mat;

/// A small dense problem λ² M + λ C + K.
#[derive(Debug, Clone)]
pub struct Small {
    /// K.
    pub stiffness: Mat<f64>,
    /// M.
    pub mass: Mat<f64>,
    /// C; `None` where nothing damps.
    pub damping: Option<Mat<f64>>,
}
