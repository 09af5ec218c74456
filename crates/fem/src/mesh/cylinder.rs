//! Rings, sectors of rings and cylinders: blocks that are bent.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use super::{Block, Grading, Group, Mesh};
use crate::Error;
use crate::elements::Kind;

/// A ring about an axis along z, or a sector of one. Its sides are the sets r0, r1, z0, z1 of nodes and of faces, those of a sector a0
/// and a1, too. Nodes in the middle of edges lie on the circles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// The middle of the lower end, m.
    pub centre: [f64; 3],
    /// Inner and outer radius, m.
    pub radii: [f64; 2],
    /// Where the sector begins and ends, rad from the axis x towards y; a full turn makes a ring.
    pub angles: [f64; 2],
    /// Length along z, m.
    pub height: f64,
    /// Elements along the radius, around and along z, cut as those of a [`Block`].
    pub cells: [Grading; 3],
    /// Kind of element.
    pub kind: Kind,
}

/// A cylinder about an axis along z: a core of n × n elements in four bent sides of n elements around each. Its sides are the sets r1, z0, z1
/// of nodes and of faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// The middle of the lower end, m.
    pub centre: [f64; 3],
    /// Radius, m.
    pub radius: f64,
    /// Length along z, m.
    pub height: f64,
    /// Elements along each side of the core, from the core to the outside, and along z.
    pub cells: [usize; 3],
    /// Bricks or wedges.
    pub kind: Kind,
}

impl Ring {
    /// The mesh, of material 0.
    ///
    /// # Errors
    /// Radii, angles or a height that make no ring; no elements along an edge; fewer than three around a whole ring.
    pub fn mesh(&self) -> Result<Mesh, Error> {
        let ([inner, outer], [from, to]) = (self.radii, self.angles);
        let turn = to - from;
        let whole = (turn - TAU).abs() < 1e-9;
        let what = if !(inner > 0.0 && outer > inner && outer.is_finite()) {
            format!("a ring has radii of {inner} m and {outer} m, they must rise from above 0")
        } else if !(turn > 0.0 && (turn <= TAU || whole)) {
            format!("a ring goes around by {turn} rad, it must be above 0 and a full turn at most")
        } else if whole && self.cells[1].elements < 3 {
            format!("a whole ring has {} elements around, it needs at least 3", self.cells[1].elements)
        } else {
            String::new()
        };
        if !what.is_empty() {
            return Err(Error::Mesh { what });
        }
        let origin = [inner, from, 0.0];
        let size = [outer - inner, turn, self.height];
        let mut mesh = Block { origin, size, cells: self.cells, kind: self.kind }.mesh()?;
        for node in &mut mesh.nodes {
            let [r, angle, z] = *node;
            *node = [0, 1, 2].map(|i| self.centre[i] + [r * angle.cos(), r * angle.sin(), z][i]);
        }
        for (block, ring) in [("x0", "r0"), ("x1", "r1"), ("y0", "a0"), ("y1", "a1")] {
            rename(&mut mesh, block, ring);
        }
        if whole {
            for end in ["a0", "a1"] {
                mesh.node_sets.remove(end);
                mesh.face_sets.remove(end);
            }
            mesh.weld();
        }
        Ok(mesh)
    }
}

impl Cylinder {
    /// The mesh, of material 0.
    ///
    /// # Errors
    /// A radius or a height that is not positive; no elements along an edge; tetrahedra, whose cuts would not fit.
    pub fn mesh(&self) -> Result<Mesh, Error> {
        /// Half a side of the core over the radius, and how far the sides bulge: angles stay between 60 and 130 degrees.
        const CORE: f64 = 0.5;
        const BULGE: f64 = 0.15;
        if !(self.radius > 0.0 && self.radius.is_finite()) {
            return Err(Error::Mesh {
                what: format!("a cylinder has a radius of {} m, it must be above 0", self.radius),
            });
        }
        if matches!(self.kind, Kind::Tet4 | Kind::Tet10) {
            return Err(Error::Mesh {
                what: "a cylinder is built of bricks or wedges, not of tetrahedra".to_owned(),
            });
        }
        let [core, outside, along] = self.cells;
        let part = |first: f64, length: f64, cells: [usize; 2]| {
            let (origin, size) = ([first, -1.0, 0.0], [length, 2.0, self.height]);
            Block { origin, size, cells: [cells[0].into(), cells[1].into(), along.into()], kind: self.kind }
                .mesh()
        };
        let bent = |u: f64, v: f64| {
            [(u, v), (v, u)].map(|(a, b)| self.radius * CORE * a * (1.0 + BULGE * (1.0 - b * b)))
        };
        let mut mesh = part(-1.0, 2.0, [core, core])?;
        for node in &mut mesh.nodes {
            let [x, y] = bent(node[0], node[1]);
            *node = [x, y, node[2]];
        }
        for side in ["x0", "x1", "y0", "y1"] {
            rename(&mut mesh, side, "");
        }
        for quarter in 0..4_u8 {
            let mut side = part(0.0, 1.0, [outside, core])?;
            let (sin, cos) = (f64::from(quarter) * FRAC_PI_2).sin_cos();
            for node in &mut side.nodes {
                let [s, v, z] = *node;
                let (edge, angle) = (bent(1.0, v), v * FRAC_PI_4);
                let circle = [self.radius * angle.cos(), self.radius * angle.sin()];
                let [x, y] = [0, 1].map(|i| (1.0 - s) * edge[i] + s * circle[i]);
                *node = [cos * x - sin * y, sin * x + cos * y, z];
            }
            let prefix = quarter.to_string();
            mesh.add(side, &prefix, 0);
            for (from, to) in [("z0", "z0"), ("z1", "z1"), ("x1", "r1"), ("x0", ""), ("y0", ""), ("y1", "")] {
                rename(&mut mesh, &format!("{prefix}{from}"), to);
            }
        }
        for node in &mut mesh.nodes {
            (0..3).for_each(|i| node[i] += self.centre[i]);
        }
        let elements = mesh.groups.drain(..).flat_map(|group| group.elements).collect();
        mesh.groups.push(Group { kind: self.kind, material: 0, elements });
        mesh.weld();
        Ok(mesh)
    }
}

/// Moves the nodes and faces of one set to another; to none where that has no name.
fn rename(mesh: &mut Mesh, from: &str, to: &str) {
    let (nodes, faces) = (mesh.node_sets.remove(from), mesh.face_sets.remove(from));
    if to.is_empty() {
        return;
    }
    mesh.node_sets.entry(to.to_owned()).or_default().extend(nodes.into_iter().flatten());
    mesh.face_sets.entry(to.to_owned()).or_default().extend(faces.into_iter().flatten());
}
