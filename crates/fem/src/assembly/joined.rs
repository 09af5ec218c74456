//! Which parts of a mesh hang together.

use super::{Model, Numbering};
use crate::Error;

/// Checks that every part has a support, or that there is one part only: elements hang together by nodes, bonds and contact.
///
/// # Errors
/// Where a part is left to itself.
pub fn check_joined(model: &Model, numbering: &Numbering) -> Result<(), Error> {
    let mut part: Vec<usize> = (0..numbering.leader.len()).collect();
    let mut join = |nodes: &mut dyn Iterator<Item = usize>| {
        let mut nodes = nodes.map(|node| numbering.leader[node]);
        let Some(first) = nodes.next() else { return };
        for node in nodes {
            let (a, b) = (top(&mut part, first), top(&mut part, node));
            part[a.max(b)] = a.min(b);
        }
    };
    for (_, _, _, nodes) in model.mesh.elements() {
        join(&mut nodes.iter().copied());
    }
    for point in &model.contact {
        join(&mut std::iter::once(point.slave).chain(point.masters.iter().map(|(node, _)| *node)));
    }
    for tie in &model.supports.tied {
        join(&mut std::iter::once(tie.slave).chain(tie.masters.iter().map(|(node, _)| *node)));
    }
    let mut elements: std::collections::BTreeMap<usize, usize> = std::collections::BTreeMap::new();
    for (_, _, _, nodes) in model.mesh.elements() {
        *elements.entry(top(&mut part, numbering.leader[nodes[0]])).or_default() += 1;
    }
    if elements.len() > 1 {
        for (node, _) in model.supports.prescribed.keys() {
            elements.remove(&top(&mut part, numbering.leader[*node]));
        }
        if let Some(smallest) = elements.values().min() {
            return Err(Error::Unconnected { count: elements.len(), elements: *smallest });
        }
    }
    Ok(())
}

fn top(part: &mut [usize], mut node: usize) -> usize {
    while part[node] != node {
        part[node] = part[part[node]];
        node = part[node];
    }
    node
}
