//! The rows of Z: how each degree of freedom of the mesh moves with the unknowns.

use std::collections::{BTreeMap, HashSet};

use super::Point;
use super::Supports;
use crate::Error;
use crate::mesh::Mesh;

/// u = Z q + g.
#[derive(Debug, Clone)]
pub struct Numbering {
    /// The node that each node moves with: itself where nothing bonds it.
    pub leader: Vec<usize>,
    /// Row of Z of degree of freedom 3 node + axis: unknowns and their factors.
    pub rows: Vec<Vec<(usize, f64)>>,
    /// g, m.
    pub given: Vec<f64>,
    /// Number of unknowns.
    pub unknowns: usize,
}

/// What becomes of a degree of freedom of a leading node.
#[derive(Clone)]
enum Fate {
    Free(usize),
    Given(f64),
    Follows(Vec<(usize, f64)>),
}

impl Numbering {
    /// Numbers the unknowns of a mesh.
    ///
    /// # Errors
    /// Supports that contradict each other or a contact; a node that is slave of one contact and master of another.
    pub fn new(mesh: &Mesh, supports: &Supports, contact: &[Point]) -> Result<Self, Error> {
        known(mesh, supports, contact)?;
        let leader = leaders(mesh.nodes.len(), &supports.same);
        let mut used = vec![false; mesh.nodes.len()];
        for (_, _, _, nodes) in mesh.elements() {
            for node in nodes {
                used[leader[*node]] = true;
            }
        }
        let mut fate: Vec<Option<Fate>> = vec![None; 3 * mesh.nodes.len()];
        for ((node, axis), displacement) in &supports.prescribed {
            let dof = 3 * leader[*node] + axis;
            if let Some(Fate::Given(other)) = &fate[dof]
                && (other - displacement).abs() > 0.0
            {
                let name = ["x", "y", "z"][*axis];
                let what = format!(
                    "node {node} is to move by {displacement} m along {name}, a node bonded to it by {other} m: \
                     prescribe one of both"
                );
                return Err(Error::Support { what });
            }
            fate[dof] = Some(Fate::Given(*displacement));
        }
        let masters: HashSet<usize> = contact
            .iter()
            .flat_map(|p| &p.masters)
            .chain(supports.tied.iter().flat_map(|tie| &tie.masters))
            .map(|(node, _)| leader[*node])
            .collect();
        for tie in &supports.tied {
            let slave = leader[tie.slave];
            if masters.contains(&slave) || (0..3).any(|axis| fate[3 * slave + axis].is_some()) {
                let what = format!(
                    "node {} is bonded to a surface, and supported, bonded to a second one or the master of a contact: leave \
                     it out of all but one of them, or change the sides of the bond",
                    tie.slave
                );
                return Err(Error::Support { what });
            }
            for axis in 0..3 {
                let terms = tie.masters.iter().map(|(node, w)| (3 * leader[*node] + axis, *w)).collect();
                fate[3 * slave + axis] = Some(Fate::Follows(terms));
            }
        }
        for point in contact {
            if masters.contains(&leader[point.slave]) {
                let what = format!(
                    "node {} slides on one surface and carries another: let its body be the master of both",
                    point.slave
                );
                return Err(Error::Support { what });
            }
            let (dof, terms) = follow(point, &leader, &fate)?;
            fate[dof] = Some(Fate::Follows(terms));
        }
        let mut unknowns = 0;
        for (dof, fate) in fate.iter_mut().enumerate() {
            // Nodes that no element uses have no stiffness.
            if !used[dof / 3] {
                *fate = Some(Fate::Given(0.0));
            } else if fate.is_none() {
                *fate = Some(Fate::Free(unknowns));
                unknowns += 1;
            }
        }
        let fate: Vec<Fate> = fate.into_iter().flatten().collect();
        let (mut rows, mut given) = (Vec::with_capacity(fate.len()), Vec::with_capacity(fate.len()));
        for dof in 0..fate.len() {
            let (row, g) = expand(3 * leader[dof / 3] + dof % 3, &fate);
            rows.push(row);
            given.push(g);
        }
        Ok(Self { leader, rows, given, unknowns })
    }

    /// Where each unknown lies: at the node that moves with it alone.
    #[must_use]
    pub fn places(&self, mesh: &Mesh) -> Vec<[f64; 3]> {
        let mut places = vec![[0.0; 3]; self.unknowns];
        for (dof, row) in self.rows.iter().enumerate().rev() {
            if let [(unknown, 1.0)] = row.as_slice() {
                places[*unknown] = mesh.nodes[dof / 3];
            }
        }
        places
    }

    /// The displacements of all nodes for some unknowns, without what is prescribed.
    #[must_use]
    pub fn spread(&self, q: &[f64]) -> Vec<[f64; 3]> {
        let at = |dof: usize| self.rows[dof].iter().map(|(i, f)| f * q[*i]).sum();
        (0..self.leader.len()).map(|node| [at(3 * node), at(3 * node + 1), at(3 * node + 2)]).collect()
    }
}

/// Checks that supports and contacts name nodes and axes that there are.
fn known(mesh: &Mesh, supports: &Supports, contact: &[Point]) -> Result<(), Error> {
    let count = mesh.nodes.len();
    let named = supports.prescribed.keys().map(|(node, _)| *node);
    let tied = supports
        .tied
        .iter()
        .flat_map(|tie| std::iter::once(tie.slave).chain(tie.masters.iter().map(|(node, _)| *node)));
    let bonded = supports.same.iter().flat_map(|(a, b)| [*a, *b]).chain(tied);
    let touching =
        contact.iter().flat_map(|p| std::iter::once(p.slave).chain(p.masters.iter().map(|(m, _)| *m)));
    if let Some(node) = named.chain(bonded).chain(touching).find(|node| *node >= count) {
        let what = format!("a support, bond or contact names node {node}, but there are only {count}");
        return Err(Error::Support { what });
    }
    if let Some((node, axis)) = supports.prescribed.keys().find(|(_, axis)| *axis > 2) {
        let what = format!("node {node} is supported along axis {axis}, but axes are 0, 1 and 2");
        return Err(Error::Support { what });
    }
    Ok(())
}

/// Each node's leader: the smallest node of those bonded with it.
fn leaders(nodes: usize, same: &[(usize, usize)]) -> Vec<usize> {
    fn top(leader: &mut [usize], mut node: usize) -> usize {
        while leader[node] != node {
            leader[node] = leader[leader[node]];
            node = leader[node];
        }
        node
    }
    let mut leader: Vec<usize> = (0..nodes).collect();
    for (a, b) in same {
        let (a, b) = (top(&mut leader, *a), top(&mut leader, *b));
        leader[a.max(b)] = a.min(b);
    }
    (0..nodes).map(|node| top(&mut leader, node)).collect()
}

/// The tied normal displacement n·u_s = Σ w n·u_m, solved for the degree of freedom of the slave that is free yet and counts most: an edge slides
/// on two surfaces.
fn follow(
    point: &Point,
    leader: &[usize],
    fate: &[Option<Fate>],
) -> Result<(usize, Vec<(usize, f64)>), Error> {
    /// What counts as nothing beside the normal.
    const NOTHING: f64 = 1e-9;
    let slave = 3 * leader[point.slave];
    let given = |axis: usize| {
        let what = format!(
            "node {} is in sliding contact, but its motion along {} is already given by a support, a bond or another \
             contact: leave the node out of one of them",
            point.slave,
            ["x", "y", "z"][axis]
        );
        Error::Support { what }
    };
    let supported = |axis: &usize| {
        point.normal[*axis].abs() > 1e-12 && matches!(fate[slave + axis], Some(Fate::Given(_)))
    };
    if let Some(axis) = (0..3).find(supported) {
        return Err(given(axis));
    }
    // What moves along the normal, with what other contacts say of it.
    let mut moves: BTreeMap<usize, f64> = BTreeMap::new();
    for axis in 0..3 {
        for (dof, factor) in followed(slave + axis, point.normal[axis], &|dof| fate[dof].as_ref()) {
            *moves.entry(dof).or_default() += factor;
        }
    }
    let most = |a: &usize, b: &usize| {
        let counts = |axis: &usize| moves.get(&(slave + axis)).map_or(0.0, |factor| factor.abs());
        counts(a).total_cmp(&counts(b))
    };
    let axis = (0..3).rev().max_by(most).unwrap_or(0);
    let dof = slave + axis;
    let Some(own) = moves.remove(&dof).filter(|own| fate[dof].is_none() && own.abs() > NOTHING) else {
        let along = |a: &usize, b: &usize| point.normal[*a].abs().total_cmp(&point.normal[*b].abs());
        return Err(given((0..3).max_by(along).unwrap_or(0)));
    };
    for (master, weight) in &point.masters {
        for axis in 0..3 {
            *moves.entry(3 * leader[*master] + axis).or_default() -= weight * point.normal[axis];
        }
    }
    let terms = moves.into_iter().filter(|(_, factor)| *factor != 0.0);
    Ok((dof, terms.map(|(other, factor)| (other, -factor / own)).collect()))
}

/// A multiple of a degree of freedom in terms of those that follow nothing. No two follow each other.
fn followed<'a>(dof: usize, factor: f64, fate: &impl Fn(usize) -> Option<&'a Fate>) -> Vec<(usize, f64)> {
    match fate(dof) {
        Some(Fate::Follows(terms)) => {
            terms.iter().flat_map(|(other, share)| followed(*other, factor * share, fate)).collect()
        }
        _ => vec![(dof, factor)],
    }
}

/// A degree of freedom in terms of unknowns.
fn expand(dof: usize, fate: &[Fate]) -> (Vec<(usize, f64)>, f64) {
    let (mut row, mut given): (Vec<(usize, f64)>, f64) = (Vec::new(), 0.0);
    for (other, factor) in followed(dof, 1.0, &|dof| Some(&fate[dof])) {
        match &fate[other] {
            Fate::Free(unknown) => match row.iter_mut().find(|(known, _)| known == unknown) {
                Some((_, sum)) => *sum += factor,
                None => row.push((*unknown, factor)),
            },
            Fate::Given(value) => given += factor * value,
            Fate::Follows(_) => {}
        }
    }
    (row, given)
}
