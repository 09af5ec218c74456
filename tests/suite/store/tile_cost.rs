//! The estimator of the benchmark of tiles.

#[path = "../../../benches/tiles/overhead.rs"]
mod overhead;

use crate::common::close;
use overhead::overhead;

#[test]
fn the_cost_of_tiles_has_its_error() {
    let [share, error] = overhead(&[[1.0, 1.1], [2.0, 2.2], [4.0, 4.4]]);
    close("share", share, 0.1, 1e-12);
    assert!(error < 1e-12);
    // Residuals of 0.1 and −0.1 around a mean of 1: 0.1 divided by the root of one degree of freedom.
    let [share, error] = overhead(&[[1.0, 1.1], [1.0, 0.9]]);
    assert!(share.abs() < 1e-12);
    close("error", error, 0.1, 1e-12);
}
