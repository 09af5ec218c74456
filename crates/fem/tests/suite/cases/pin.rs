//! A pin of 10 × 10 × 25 mm on a block of 30 × 10 × 10 mm, both of steel.

use squealmap_fem::Error;
use squealmap_fem::assembly::Model;
use squealmap_fem::contact::sliding;
use squealmap_fem::elements::Kind;
use squealmap_fem::mesh::Block;

/// Elements of 5 mm over `n`; the bottom of the block and the top of the pin are clamped; the pin slides along x.
pub(crate) fn model(kind: Kind, n: usize) -> Result<Model, Error> {
    let cells = |x: usize, y: usize, z: usize| [(x * n).into(), (y * n).into(), (z * n).into()];
    let block = Block { origin: [0.0; 3], size: [0.03, 0.01, 0.01], cells: cells(6, 2, 2), kind };
    let pin = Block { origin: [0.01, 0.0, 0.01], size: [0.01, 0.01, 0.025], cells: cells(2, 2, 5), kind };
    let mut model = Model { materials: vec![super::steel()], ..Model::default() };
    model.mesh = block.mesh()?;
    model.mesh.add(pin.mesh()?, "pin.", 0);
    let mesh = &model.mesh;
    model.supports.clamp(mesh.node_set("z0")?);
    model.supports.clamp(mesh.node_set("pin.z1")?);
    model.contact =
        sliding(mesh, mesh.node_set("pin.z0")?, mesh.node_set("z1")?, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0])?;
    Ok(model)
}
