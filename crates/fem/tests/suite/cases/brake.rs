//! A disc brake: a disc of cast iron between two linings with backs of steel.

use squealmap_fem::Error;
use squealmap_fem::assembly::Model;
use squealmap_fem::contact::{bonded, rotating, sliding};
use squealmap_fem::elements::Kind;
use squealmap_fem::material::{Material, Orthotropic};
use squealmap_fem::mesh::Ring;

/// A disc with radii of 60 and 130 mm and 12 mm thick, clamped inside; linings from 80 to 120 mm over 60 degrees and 10 mm thick, on backs
/// of 5 mm that are held along the axis behind and in the plane at both ends. `radial` is cut in 7 parts, `around` in 6; a lining
/// and a back have half as many elements along the axis as the disc.
pub(crate) fn model(kind: Kind, [radial, around, axial]: [usize; 3]) -> Result<Model, Error> {
    let sector = 60_f64.to_radians();
    let pad = |from: f64, height: f64| Ring {
        centre: [0.0, 0.0, from],
        radii: [0.08, 0.12],
        angles: [0.0, sector],
        height,
        cells: [(4 * radial / 7).into(), (around / 6).into(), (axial / 2).max(1).into()],
        kind,
    };
    let disc = Ring {
        centre: [0.0; 3],
        radii: [0.06, 0.13],
        angles: [0.0, std::f64::consts::TAU],
        height: 0.012,
        cells: [radial.into(), around.into(), axial.into()],
        kind,
    };
    let iron = Material::isotropic("cast iron", 120e9, 0.26, 7200.0)?;
    // The same in every direction of the plane.
    let constants =
        Orthotropic { young: [8e9, 8e9, 4e9], poisson: [0.25, 0.2, 0.2], shear: [3.2e9, 1.5e9, 1.5e9] };
    let lining = Material::orthotropic("lining", constants, 2500.0)?;
    let mut model =
        Model { mesh: disc.mesh()?, materials: vec![iron, lining, super::steel()], ..Model::default() };
    model.mesh.add(pad(0.012, 0.01).mesh()?, "upper.", 1);
    model.mesh.add(pad(0.022, 0.005).mesh()?, "upper back.", 2);
    model.mesh.add(pad(-0.01, 0.01).mesh()?, "lower.", 1);
    model.mesh.add(pad(-0.015, 0.005).mesh()?, "lower back.", 2);
    let mesh = &model.mesh;
    model.supports.clamp(mesh.node_set("r0")?);
    for (pad, inside, outside, normal) in [("upper", "z0", "z1", 1.0), ("lower", "z1", "z0", -1.0)] {
        let set = |part: &str, side: &str| mesh.node_set(&format!("{pad}{part}.{side}"));
        model.supports.prescribe(set(" back", outside)?, 2, 0.0);
        for end in ["a0", "a1"] {
            for axis in 0..2 {
                model.supports.prescribe(set(" back", end)?, axis, 0.0);
            }
        }
        model.supports.bond(bonded(mesh, set(" back", inside)?, set("", outside)?)?);
        let slaves = set("", inside)?;
        let points = sliding(mesh, slaves, mesh.node_set(outside)?, [0.0, 0.0, normal], [1.0, 0.0, 0.0])?;
        model.contact.extend(rotating(mesh, points, [0.0; 3], [0.0, 0.0, 1.0])?);
    }
    Ok(model)
}
