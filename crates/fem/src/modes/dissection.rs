//! Nested dissection: an order of elimination that makes few new entries (George, Nested dissection of a regular finite element mesh,
//! SIAM J. Numer. Anal. 10, 1973).
//!
//! A plane parts the unknowns by where they lie. Of those that have neighbours on the other side as few as can be are taken out and
//! eliminated last, so that nothing couples the two halves; these are parted in the same way.

use std::collections::{HashMap, VecDeque};

use faer::{Mat, Side};

use crate::assembly::Pattern;

/// Unknowns with the same neighbours, as those of a node are, taken as one.
struct Graph {
    members: Vec<Vec<usize>>,
    neighbours: Vec<Vec<usize>>,
    places: Vec<[f64; 3]>,
}

/// Parts of at most so many nodes are eliminated as they come.
const LEAF: usize = 12;

/// The unknowns in the order in which they are to be eliminated. `places` says where each unknown lies, m.
pub(super) fn dissected(pattern: &Pattern, places: &[[f64; 3]]) -> Vec<usize> {
    let graph = Graph::new(pattern, places);
    let all: Vec<usize> = (0..graph.members.len()).collect();
    let order = graph.order(all);
    order.into_iter().flat_map(|node| graph.members[node].iter().copied()).collect()
}

impl Graph {
    fn new(pattern: &Pattern, places: &[[f64; 3]]) -> Self {
        let column = |i: usize| &pattern.row[pattern.start[i]..pattern.start[i + 1]];
        let mut known: HashMap<&[usize], usize> = HashMap::new();
        let mut members: Vec<Vec<usize>> = Vec::new();
        let node_of: Vec<usize> = (0..pattern.size())
            .map(|i| {
                let node = *known.entry(column(i)).or_insert_with(|| {
                    members.push(Vec::new());
                    members.len() - 1
                });
                members[node].push(i);
                node
            })
            .collect();
        let neighbours = members
            .iter()
            .enumerate()
            .map(|(node, members)| {
                let mut neighbours: Vec<usize> =
                    column(members[0]).iter().map(|i| node_of[*i]).filter(|other| *other != node).collect();
                neighbours.sort_unstable();
                neighbours.dedup();
                neighbours
            })
            .collect();
        let places = members.iter().map(|members| places[members[0]]).collect();
        Self { members, neighbours, places }
    }

    fn order(&self, nodes: Vec<usize>) -> Vec<usize> {
        if nodes.len() <= LEAF {
            return nodes;
        }
        let [left, right, between] = self.part(&nodes);
        let (mut order, right) = rayon::join(|| self.order(left), || self.order(right));
        order.extend(right);
        order.extend(between);
        order
    }

    /// Two parts of some nodes that nothing couples, and the nodes between them.
    fn part(&self, nodes: &[usize]) -> [Vec<usize>; 3] {
        let index: HashMap<usize, usize> = nodes.iter().enumerate().map(|(i, node)| (*node, i)).collect();
        let inside: Vec<Vec<usize>> = nodes
            .iter()
            .map(|node| self.neighbours[*node].iter().filter_map(|n| index.get(n).copied()).collect())
            .collect();
        let mut best: Option<(usize, Vec<bool>)> = None;
        for direction in self.directions(nodes) {
            let height = |i: &usize| -> f64 {
                let x = self.places[nodes[*i]];
                (0..3).map(|k| direction[k] * x[k]).sum()
            };
            let mut sorted: Vec<usize> = (0..nodes.len()).collect();
            sorted.sort_by(|a, b| height(a).total_cmp(&height(b)));
            for from in cuts(&sorted.iter().map(height).collect::<Vec<f64>>()) {
                let mut upper = vec![true; nodes.len()];
                sorted[..from].iter().for_each(|i| upper[*i] = false);
                let border = |side: bool| -> usize {
                    (0..nodes.len())
                        .filter(|i| upper[*i] == side && inside[*i].iter().any(|j| upper[*j] != side))
                        .map(|i| self.members[nodes[i]].len())
                        .sum()
                };
                let width = border(false).min(border(true));
                if best.as_ref().is_none_or(|(least, _)| width < *least) {
                    best = Some((width, upper));
                }
            }
        }
        let upper = best.map(|(_, upper)| upper).unwrap_or_default();
        let cover = cover(&inside, &upper);
        let mut parts = [Vec::new(), Vec::new(), Vec::new()];
        for (i, node) in nodes.iter().enumerate() {
            parts[if cover[i] { 2 } else { usize::from(upper[i]) }].push(*node);
        }
        parts
    }

    /// The axes, and the principal axes of the nodes' places: planes across a bent part.
    fn directions(&self, nodes: &[usize]) -> Vec<[f64; 3]> {
        let count = nodes.len() as f64;
        let centre = [0, 1, 2].map(|k| nodes.iter().map(|n| self.places[*n][k]).sum::<f64>() / count);
        let spread = Mat::from_fn(3, 3, |i, j| {
            let apart = |n: &usize, k: usize| self.places[*n][k] - centre[k];
            nodes.iter().map(|n| apart(n, i) * apart(n, j)).sum::<f64>() / count
        });
        let mut directions = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        if let Ok(eigen) = spread.self_adjoint_eigen(Side::Lower) {
            directions.extend((0..3).map(|j| [0, 1, 2].map(|i| eigen.U()[(i, j)])));
        }
        directions
    }
}

/// Where to cut a sorted list of heights: between layers near the middle, the nearest first; where there are no layers, in the middle.
fn cuts(heights: &[f64]) -> Vec<usize> {
    /// Layers are farther apart than this part of the height of all.
    const APART: f64 = 1e-6;
    /// So many places are tried.
    const CUTS: usize = 6;
    let count = heights.len();
    let gap = APART * (heights[count - 1] - heights[0]);
    // Both sides have two fifths of the nodes at least.
    let least = count * 2 / 5;
    let mut cuts: Vec<usize> =
        (least..count - least).filter(|i| heights[*i] - heights[*i - 1] > gap).collect();
    cuts.sort_by_key(|i| (2 * i).abs_diff(count));
    cuts.truncate(CUTS);
    if cuts.is_empty() {
        cuts.push(count / 2);
    }
    cuts
}

/// The fewest nodes without which the two sides do not touch: as many as pairs of neighbours across can be joined, each node once (König).
fn cover(neighbours: &[Vec<usize>], upper: &[bool]) -> Vec<bool> {
    let count = neighbours.len();
    let across = |i: usize| neighbours[i].iter().copied().filter(move |j| upper[i] != upper[*j]);
    let mut mate: Vec<Option<usize>> = vec![None; count];
    let below: Vec<usize> = (0..count).filter(|i| !upper[*i] && across(*i).next().is_some()).collect();
    for i in &below {
        if let Some(j) = across(*i).find(|j| mate[*j].is_none()) {
            (mate[*i], mate[j]) = (Some(j), Some(*i));
        }
    }
    // A search from a node without a mate that ends at another one makes one pair more.
    let mut seen = vec![usize::MAX; count];
    for start in below.iter().filter(|i| mate[**i].is_none()).copied().collect::<Vec<_>>() {
        let mut from: HashMap<usize, usize> = HashMap::new();
        let mut queue = VecDeque::from([start]);
        'search: while let Some(i) = queue.pop_front() {
            for j in across(i) {
                if seen[j] == start {
                    continue;
                }
                seen[j] = start;
                from.insert(j, i);
                if let Some(next) = mate[j] {
                    queue.push_back(next);
                    continue;
                }
                let mut j = Some(j);
                while let Some(end) = j {
                    let i = from[&end];
                    j = mate[i];
                    (mate[i], mate[end]) = (Some(end), Some(i));
                }
                break 'search;
            }
        }
    }
    let mut reached = vec![false; count];
    let mut queue: VecDeque<usize> = below.iter().copied().filter(|i| mate[*i].is_none()).collect();
    for i in &queue {
        reached[*i] = true;
    }
    while let Some(i) = queue.pop_front() {
        for j in across(i) {
            if !reached[j] {
                reached[j] = true;
                if let Some(next) = mate[j].filter(|next| !reached[*next]) {
                    reached[next] = true;
                    queue.push_back(next);
                }
            }
        }
    }
    (0..count).map(|i| mate[i].is_some() && reached[i] == upper[i]).collect()
}
