//! The clamped layer on a moving rigid plane, as finite elements.

use squealmap_fem::Error;
use squealmap_fem::assembly::Model;
use squealmap_fem::contact::{periodic, sliding_on_rigid};
use squealmap_fem::elements::Kind;
use squealmap_fem::mesh::Block;

/// The layer with `n` elements through its height and 2 n along its period: one element thick, all nodes above each other across the
/// plane of strain move as one, in the plane.
pub(crate) fn model(kind: Kind, n: usize) -> Result<Model, Error> {
    let thick = 0.01 / n as f64;
    let block = Block {
        origin: [0.0; 3],
        size: [0.02, 0.01, thick],
        cells: [(2 * n).into(), n.into(), 1.into()],
        kind,
    };
    let mesh = block.mesh()?;
    let mut model = Model { materials: vec![super::steel()], ..Model::default() };
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
    let at = |z: f64| mesh.nodes_where(move |x| near(x[2], z));
    let bottom = at(0.0);
    // Nodes in the middle of edges across the plane, and of faces' diagonals, hang on those below them.
    model.supports.bond(periodic(&mesh, &at(thick), &bottom, [0.0, 0.0, -thick])?);
    let straight: Vec<usize> = at(thick / 2.0)
        .into_iter()
        .filter(|node| {
            let x = mesh.nodes[*node];
            bottom.iter().any(|b| near(mesh.nodes[*b][0], x[0]) && near(mesh.nodes[*b][1], x[1]))
        })
        .collect();
    model.supports.bond(periodic(&mesh, &straight, &bottom, [0.0, 0.0, -thick / 2.0])?);
    model.supports.bond(periodic(&mesh, mesh.node_set("x1")?, mesh.node_set("x0")?, [-0.02, 0.0, 0.0])?);
    let all: Vec<usize> = (0..mesh.nodes.len()).collect();
    model.supports.prescribe(&all, 2, 0.0);
    model.supports.clamp(mesh.node_set("y1")?);
    // Each node of the plane once: not those that repeat one, a period or a thickness away.
    let plane: Vec<usize> = mesh
        .node_set("y0")?
        .iter()
        .copied()
        .filter(|node| mesh.nodes[*node][0] < 0.02 - 1e-9 && near(mesh.nodes[*node][2], 0.0))
        .collect();
    model.contact = sliding_on_rigid(&plane, [0.0, 1.0, 0.0], [1.0, 0.0, 0.0])?;
    model.mesh = mesh;
    Ok(model)
}
