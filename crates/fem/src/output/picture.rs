//! The outside of a deformed mesh as flat pieces that a picture is painted with, hidden ones left out.

use std::collections::HashMap;

use crate::elements::face_shape;
use crate::mesh::{Face, Mesh};

/// A piece of the surface on the plane of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Facet {
    /// Its corners, m: x to the right, y upwards.
    pub outline: Vec<[f64; 2]>,
    /// Which sides of the outline are edges of an element: side i goes from corner i to the next.
    pub edges: Vec<bool>,
    /// The mean of the values at its corners.
    pub value: f64,
    /// Depth of its middle, m: larger is nearer to the eye.
    pub depth: f64,
    /// Whether nothing hides any of it, so that its edges may be drawn over all else.
    pub whole: bool,
}

/// From where a mesh is seen: to the right, upwards, towards the eye, unit vectors.
pub type View = [[f64; 3]; 3];

/// Along the diagonal of a cube, x to the lower right, y to the upper right, z upwards: all three axes are drawn equally long.
#[must_use]
pub fn isometric() -> View {
    let (a, b, c) = (0.5_f64.sqrt(), (1.0 / 6.0_f64).sqrt(), (1.0 / 3.0_f64).sqrt());
    [[a, a, 0.0], [-b, b, 2.0 * b], [c, -c, c]]
}

/// The pieces that can be seen, in the order in which they are painted: from the farthest to the nearest, but what nothing hides last, as
/// it covers what is seen in part. `displacement` (m) moves the nodes, `values` are those of the nodes,
/// pieces are cut no longer than `size` (m) or one element; those that are hidden in part are cut further.
#[must_use]
pub fn facets(mesh: &Mesh, displacement: &[[f64; 3]], values: &[f64], view: &View, size: f64) -> Vec<Facet> {
    let places: Vec<[f64; 3]> = mesh
        .nodes
        .iter()
        .zip(displacement)
        .map(|(x, u)| view.map(|axis| (0..3).map(|i| axis[i] * (x[i] + u[i])).sum()))
        .collect();
    let mut all: Vec<Piece> = mesh.skin().iter().flat_map(|face| cut(face, &places, values, size)).collect();
    all.retain(|piece| area(&piece.corners) > 0.0);
    let front = Front::new(&all, size);
    let mut seen = Vec::with_capacity(all.len());
    for (index, piece) in all.iter().enumerate() {
        front.keep(piece.clone(), index, 0, &mut seen);
    }
    let mut seen: Vec<Facet> = seen.into_iter().map(|(piece, whole)| piece.facet(whole)).collect();
    seen.sort_by(|a, b| a.whole.cmp(&b.whole).then(a.depth.total_cmp(&b.depth)));
    seen
}

/// A piece in space: corners are x, y, depth.
#[derive(Debug, Clone)]
struct Piece {
    corners: Vec<[f64; 3]>,
    values: Vec<f64>,
    edges: Vec<bool>,
}

impl Piece {
    fn middle(&self) -> [f64; 3] {
        [0, 1, 2].map(|i| self.corners.iter().map(|c| c[i]).sum::<f64>() / self.corners.len() as f64)
    }

    fn facet(self, whole: bool) -> Facet {
        let depth = self.middle()[2];
        let value = self.values.iter().sum::<f64>() / self.values.len() as f64;
        Facet {
            outline: self.corners.iter().map(|c| [c[0], c[1]]).collect(),
            edges: self.edges,
            value,
            depth,
            whole,
        }
    }

    /// The depth of its plane at a place.
    fn depth_at(&self, at: [f64; 2]) -> f64 {
        let [o, a, b] = [0, 1, self.corners.len() - 1].map(|i| self.corners[i]);
        let (u, v) = ([0, 1, 2].map(|i| a[i] - o[i]), [0, 1, 2].map(|i| b[i] - o[i]));
        let to = [at[0] - o[0], at[1] - o[1]];
        let determinant = u[0] * v[1] - u[1] * v[0];
        let (s, t) =
            ((to[0] * v[1] - to[1] * v[0]) / determinant, (u[0] * to[1] - u[1] * to[0]) / determinant);
        o[2] + s * u[2] + t * v[2]
    }

    /// Four pieces of half the length.
    fn quarters(&self) -> Vec<Self> {
        let n = self.corners.len();
        let between = |i: usize, j: usize| {
            let place = [0, 1, 2].map(|k| f64::midpoint(self.corners[i][k], self.corners[j][k]));
            (place, f64::midpoint(self.values[i], self.values[j]))
        };
        let sides: Vec<([f64; 3], f64)> = (0..n).map(|i| between(i, (i + 1) % n)).collect();
        let corner = |i: usize| (self.corners[i], self.values[i]);
        let make = |points: Vec<([f64; 3], f64)>, edges: Vec<bool>| {
            let (corners, values) = points.into_iter().unzip();
            Self { corners, values, edges }
        };
        let centre = (self.middle(), self.values.iter().sum::<f64>() / n as f64);
        let at_corner = |i: usize| {
            let before = (i + n - 1) % n;
            let edges = [self.edges[i], self.edges[before]];
            match n {
                3 => make(vec![corner(i), sides[i], sides[before]], vec![edges[0], false, edges[1]]),
                _ => make(
                    vec![corner(i), sides[i], centre, sides[before]],
                    vec![edges[0], false, false, edges[1]],
                ),
            }
        };
        let mut quarters: Vec<Self> = (0..n).map(at_corner).collect();
        if n == 3 {
            quarters.push(make(sides.clone(), vec![false; 3]));
        }
        quarters
    }
}

/// Pieces of one face. Places are x, y, depth.
fn cut(face: &Face, places: &[[f64; 3]], values: &[f64], size: f64) -> Vec<Piece> {
    /// More pieces of one face no print resolves.
    const MOST: usize = 64;
    let corners = face.kind.corners();
    let length = |i: usize| {
        let (a, b) = (places[face.nodes[i]], places[face.nodes[(i + 1) % corners]]);
        (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
    };
    let longest = (0..corners).map(length).fold(0.0, f64::max);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to few")]
    // A side as long as the size is not cut for its rounding.
    let n = (longest / size - 1e-6).ceil().clamp(1.0, MOST as f64) as usize;
    // The sides that are edges of the element.
    let mut pieces: Vec<(Vec<[f64; 2]>, Vec<bool>)> = Vec::new();
    if corners == 4 {
        let at = |i: usize, j: usize| [i, j].map(|k| 2.0 * k as f64 / n as f64 - 1.0);
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let outline = vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            pieces.push((outline, vec![j == 0, i + 1 == n, j + 1 == n, i == 0]));
        }
    } else {
        let at = |i: usize, j: usize| [i, j].map(|k| k as f64 / n as f64);
        for (i, j) in (0..n).flat_map(|i| (0..n - i).map(move |j| (i, j))) {
            let outline = vec![at(i, j), at(i + 1, j), at(i, j + 1)];
            pieces.push((outline, vec![j == 0, i + j + 1 == n, i == 0]));
            if i + j + 2 <= n {
                pieces.push((vec![at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], vec![false; 3]));
            }
        }
    }
    let make = |(outline, edges): (Vec<[f64; 2]>, Vec<bool>)| {
        let on = |at: &[f64; 2]| {
            let (mut place, mut value) = ([0.0; 3], 0.0);
            for (node, n) in face.nodes.iter().zip(&face_shape(face.kind, *at).0) {
                (0..3).for_each(|k| place[k] += n * places[*node][k]);
                value += n * values[*node];
            }
            (place, value)
        };
        let (corners, values) = outline.iter().map(on).unzip();
        Piece { corners, values, edges }
    };
    pieces.into_iter().map(make).collect()
}

/// The area on the picture, below 0 where a piece is seen from behind.
fn area(corners: &[[f64; 3]]) -> f64 {
    let side = |i: usize| {
        let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
        a[0] * b[1] - a[1] * b[0]
    };
    0.5 * (0..corners.len()).map(side).sum::<f64>()
}

/// What is seen, by the squares of the picture.
struct Front<'a> {
    all: &'a [Piece],
    squares: HashMap<[i64; 2], Vec<usize>>,
    size: f64,
}

impl<'a> Front<'a> {
    fn new(all: &'a [Piece], size: f64) -> Self {
        let mut squares: HashMap<[i64; 2], Vec<usize>> = HashMap::new();
        for (index, piece) in all.iter().enumerate() {
            let fold = |f: fn(f64, f64) -> f64, from: f64| {
                square([0, 1].map(|i| piece.corners.iter().map(|c| c[i]).fold(from, f)), size)
            };
            let (low, high) = (fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY));
            for x in low[0]..=high[0] {
                for y in low[1]..=high[1] {
                    squares.entry([x, y]).or_default().push(index);
                }
            }
        }
        Self { all, squares, size }
    }

    /// Keeps what is seen of a piece, cut from the one with this index: all, nothing, or some of its quarters; with each, whether
    /// nothing hides any of it.
    fn keep(&self, piece: Piece, index: usize, cuts: usize, seen: &mut Vec<(Piece, bool)>) {
        /// So far corners are drawn in: a corner itself lies on its neighbours. Less hidden than this is not cut,
        const INWARDS: f64 = 0.1;
        /// and less than this is not hidden.
        const WHOLE: f64 = 0.05;
        /// Pieces are cut so often; what is hidden in part then is all there or all gone.
        const CUTS: usize = 3;
        let middle = piece.middle();
        let covered = |inwards: f64| {
            let inner = piece.corners.iter().map(|c| [0, 1, 2].map(|i| c[i] + inwards * (middle[i] - c[i])));
            inner.filter(|place| self.covers(*place, index)).count()
        };
        let gone = self.covers(middle, index);
        match covered(INWARDS) {
            0 if !gone => {
                let whole = covered(WHOLE) == 0;
                seen.push((piece, whole));
            }
            all if all == piece.corners.len() && gone => {}
            _ if cuts < CUTS => {
                piece.quarters().into_iter().for_each(|part| self.keep(part, index, cuts + 1, seen));
            }
            _ if !gone => seen.push((piece, false)),
            _ => {}
        }
    }

    /// Whether something lies before a place of a piece, which does not hide itself: bent, it is not its plane.
    fn covers(&self, place: [f64; 3], index: usize) -> bool {
        /// Surfaces that touch do not hide each other; over the length of a piece.
        const TOUCHES: f64 = 1e-3;
        let at = [place[0], place[1]];
        let near = self.squares.get(&square(at, self.size));
        let limit = place[2] + TOUCHES * self.size;
        near.into_iter()
            .flatten()
            .filter(|i| **i != index)
            .map(|i| &self.all[*i])
            .any(|other| inside(&other.corners, at) && other.depth_at(at) > limit)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a picture has few squares")]
fn square(at: [f64; 2], size: f64) -> [i64; 2] {
    at.map(|x| (x / size).floor() as i64)
}

/// Whether a place lies in a convex outline, counter-clockwise.
fn inside(corners: &[[f64; 3]], at: [f64; 2]) -> bool {
    (0..corners.len()).all(|i| {
        let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
        (b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0]) >= 0.0
    })
}
