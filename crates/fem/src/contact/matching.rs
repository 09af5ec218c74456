//! Surfaces whose nodes lie at the same places.

use super::Point;
use crate::Error;
use crate::mesh::{Face, FaceRef, Mesh, Places};
use std::collections::{BTreeMap, BTreeSet};

/// Pairs each slave node with the master node at its place plus a shift (m).
fn pairs(
    mesh: &Mesh,
    slaves: &[usize],
    masters: &[usize],
    shift: [f64; 3],
) -> Result<Vec<(usize, usize)>, Error> {
    let mut places = Places::new(mesh.extent());
    for master in masters {
        places.insert(*master, mesh.nodes[*master]);
    }
    let near = places.near;
    let mut pairs = Vec::with_capacity(slaves.len());
    for slave in slaves {
        let x = [0, 1, 2].map(|i| mesh.nodes[*slave][i] + shift[i]);
        let Some(master) = places.at(x) else {
            let what = format!(
                "node {slave} of the contact at ({:.6}, {:.6}, {:.6}) m has no partner on the other surface within {near:.1e} m: the \
                 surfaces do not match or do not meet",
                x[0], x[1], x[2]
            );
            return Err(Error::Contact { what });
        };
        pairs.push((*slave, master));
    }
    Ok(pairs)
}

/// Bonds two surfaces with matching nodes: pairs for [`crate::assembly::Supports::bond`].
///
/// # Errors
/// A node of the first surface without a partner on the second.
pub fn bonded(mesh: &Mesh, first: &[usize], second: &[usize]) -> Result<Vec<(usize, usize)>, Error> {
    pairs(mesh, first, second, [0.0; 3])
}

/// Whether two surfaces are one mesh where they meet, by pairs of a slave and a master: each face of the slaves lies on one of the masters,
/// or all nodes of both have a partner. Where the masters have nodes between those of the slaves, pairs of nodes leave these free.
#[must_use]
pub fn conforms(mesh: &Mesh, slaves: &[FaceRef], masters: &[FaceRef], pairs: &[(usize, usize)]) -> bool {
    let partner: BTreeMap<usize, usize> = pairs.iter().copied().collect();
    let sorted = |mut nodes: Vec<usize>| {
        nodes.sort_unstable();
        nodes
    };
    let slaves = mesh.resolve(slaves);
    let below: BTreeSet<Vec<usize>> =
        mesh.resolve(masters).into_iter().map(|face| sorted(face.nodes)).collect();
    let on = |face: &Face| {
        let partners: Option<Vec<usize>> = face.nodes.iter().map(|node| partner.get(node).copied()).collect();
        partners.is_some_and(|partners| below.contains(&sorted(partners)))
    };
    let paired: BTreeSet<usize> = partner.values().copied().collect();
    slaves.iter().all(on) || below.iter().flatten().all(|node| paired.contains(node))
}

/// Makes a body periodic: each node of the first surface moves as the node of the second that lies `shift` (m) from it.
///
/// # Errors
/// A node of the first surface without a partner on the second.
pub fn periodic(
    mesh: &Mesh,
    first: &[usize],
    second: &[usize],
    shift: [f64; 3],
) -> Result<Vec<(usize, usize)>, Error> {
    pairs(mesh, first, second, shift)
}

/// Sliding contact of two flat surfaces with matching nodes. `normal` points from the masters to the slaves, the slaves slide along
/// `direction`.
///
/// # Errors
/// A slave without a partner, directions that are zero or not across each other.
pub fn sliding(
    mesh: &Mesh,
    slaves: &[usize],
    masters: &[usize],
    normal: [f64; 3],
    direction: [f64; 3],
) -> Result<Vec<Point>, Error> {
    let (normal, direction) = axes(normal, direction)?;
    let point = |(slave, master)| Point { slave, masters: vec![(master, 1.0)], normal, direction };
    Ok(pairs(mesh, slaves, masters, [0.0; 3])?.into_iter().map(point).collect())
}

/// Sliding contact on a rigid plane.
///
/// # Errors
/// Directions that are zero or not across each other.
pub fn sliding_on_rigid(
    slaves: &[usize],
    normal: [f64; 3],
    direction: [f64; 3],
) -> Result<Vec<Point>, Error> {
    let (normal, direction) = axes(normal, direction)?;
    Ok(slaves.iter().map(|slave| Point { slave: *slave, masters: Vec::new(), normal, direction }).collect())
}

/// Both as unit vectors.
pub(super) fn axes(normal: [f64; 3], direction: [f64; 3]) -> Result<([f64; 3], [f64; 3]), Error> {
    /// A direction may leave the surface by this much, as an angle: more is a mistake.
    const ACROSS: f64 = 1e-6;
    let unit = |v: [f64; 3]| {
        let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        v.map(|c| c / length)
    };
    let (n, t) = (unit(normal), unit(direction));
    let dot: f64 = (0..3).map(|i| n[i] * t[i]).sum();
    if dot.is_nan() {
        let what = "the normal of a contact or its direction of sliding is zero: give it a length".to_owned();
        return Err(Error::Contact { what });
    }
    if dot.abs() > ACROSS {
        let what = format!(
            "the direction of sliding leaves the surface: it is {dot:.3} along the normal, it must be across it"
        );
        return Err(Error::Contact { what });
    }
    Ok((n, unit([0, 1, 2].map(|i| t[i] - dot * n[i]))))
}
