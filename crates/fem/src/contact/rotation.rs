//! The direction of sliding on a disc that turns.

use super::Point;
use super::matching::axes;
use crate::Error;
use crate::mesh::Mesh;

/// Lets the slaves slide as the masters turn backwards below them: the direction at each point is `axis` × (place − `origin`), the
/// velocity of a body that turns about the axis.
///
/// # Errors
/// A point on the axis, or a direction that leaves the surface: the axis is not the disc's.
pub fn rotating(
    mesh: &Mesh,
    points: Vec<Point>,
    origin: [f64; 3],
    axis: [f64; 3],
) -> Result<Vec<Point>, Error> {
    let turn = |mut point: Point| {
        let x = mesh.nodes[point.slave];
        let r = [0, 1, 2].map(|i| x[i] - origin[i]);
        let along = [
            axis[1] * r[2] - axis[2] * r[1],
            axis[2] * r[0] - axis[0] * r[2],
            axis[0] * r[1] - axis[1] * r[0],
        ];
        point.direction = axes(point.normal, along)?.1;
        Ok(point)
    };
    points.into_iter().map(turn).collect()
}
