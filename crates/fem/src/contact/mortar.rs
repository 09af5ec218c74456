//! Flat surfaces whose nodes do not match: the normal displacements are tied in the mean, weighted by the shape functions of the slaves.
//!
//! ∫ N_a (u_s − u_m) dA = 0 for each slave node a gives D u_s = G u_m with D_ab = ∫ N_a N_b dA and G_aj = ∫ N_a N_j dA over the area
//! that both surfaces share. The rows of D⁻¹ G are the weights of the masters. The overlaps of faces are cut out exactly, so that
//! a constant pressure and a linear displacement pass through.

use std::collections::BTreeMap;

use faer::Mat;
use faer::linalg::solvers::Solve;

use super::Point;
use super::matching::axes;
use crate::Error;
use crate::assembly::{Partly, Tie};
use crate::elements::{FaceKind, face_shape, triangle_rule};
use crate::mesh::{Face, FaceRef, Mesh};

type Plane = [f64; 2];
/// Entries of a matrix by two nodes.
type Entries = BTreeMap<(usize, usize), f64>;
/// A slave with its masters and their weights.
type Weighted = (usize, Vec<(usize, f64)>);

/// A face in the coordinates of the surface.
pub(super) struct Flat {
    kind: FaceKind,
    pub(super) nodes: Vec<usize>,
    /// Places of all nodes.
    at: Vec<Plane>,
    /// Corners, counter-clockwise.
    corners: Vec<Plane>,
    /// The box around it.
    low: Plane,
    high: Plane,
}

/// Sliding contact of two flat surfaces whose nodes need not match. Slaves that share no area with the masters are left free.
///
/// # Errors
/// Directions that are zero or not across each other; surfaces that do not lie in one plane, or share no area.
pub fn mortar(
    mesh: &Mesh,
    slaves: &[FaceRef],
    masters: &[FaceRef],
    normal: [f64; 3],
    direction: [f64; 3],
) -> Result<Vec<Point>, Error> {
    let (normal, direction) = axes(normal, direction)?;
    let [n, t] = [normal, direction];
    let across = [n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2], n[0] * t[1] - n[1] * t[0]];
    let slave_faces = mesh.resolve(slaves);
    let master_faces = mesh.resolve(masters);
    one_plane(mesh, normal, slave_faces.iter().chain(&master_faces))?;
    let flat = |faces: &[Face]| -> Vec<Flat> {
        faces.iter().map(|face| Flat::new(mesh, face, direction, across)).collect()
    };
    let (slaves, masters) = (flat(&slave_faces), flat(&master_faces));
    // D and G by node numbers.
    let mut d: Entries = BTreeMap::new();
    let mut g: Entries = BTreeMap::new();
    let rule = triangle_rule();
    for slave in &slaves {
        for (master, corners) in overlaps(slave, &masters) {
            integrate([slave, master], corners, &rule, &mut d, &mut g);
        }
    }
    weights(&d, &g).map(|rows| {
        rows.into_iter().map(|(slave, masters)| Point { slave, masters, normal, direction }).collect()
    })
}

/// Places and areas by which a field on slave faces is integrated that lie on the masters in part only, or not at all. The normal is a unit vector.
#[must_use]
pub fn overhangs(mesh: &Mesh, slaves: &[FaceRef], masters: &[FaceRef], normal: [f64; 3]) -> Partly {
    /// A part of a face up to which it lies on the masters wholly but for rounding.
    const ROUNDING: f64 = 1e-9;
    let [along, sideways] = across(normal);
    let flat = |face: &Face| Flat::new(mesh, face, along, sideways);
    let masters: Vec<Flat> = mesh.resolve(masters).iter().map(flat).collect();
    let rule = triangle_rule();
    let mut found = Partly::new();
    for face in mesh.resolve(slaves) {
        let slave = flat(&face);
        let (mut places, mut shared) = (Vec::new(), 0.0);
        for (_, [a, b, c]) in overlaps(&slave, &masters) {
            let twice = 2.0 * area(&[a, b, c]);
            shared += 0.5 * twice;
            let part =
                |([u, v], weight): &(Plane, f64)| (slave.local(inside([a, b, c], [*u, *v])), weight * twice);
            places.extend(rule.iter().map(part));
        }
        if shared < (1.0 - ROUNDING) * area(&slave.corners) {
            found.insert(face.of, places);
        }
    }
    found
}

/// Bonds two flat surfaces whose nodes need not match, for [`crate::assembly::Supports::tied`].
///
/// # Errors
/// Surfaces that do not lie in one plane, or share no area.
pub fn bonded_mortar(
    mesh: &Mesh,
    slaves: &[FaceRef],
    masters: &[FaceRef],
    normal: [f64; 3],
) -> Result<Vec<Tie>, Error> {
    let points = mortar(mesh, slaves, masters, normal, across(normal)[0])?;
    Ok(points.into_iter().map(|Point { slave, masters, .. }| Tie { slave, masters }).collect())
}

/// Two directions across a normal, unit vectors across each other where the normal is one.
pub(super) fn across(normal: [f64; 3]) -> [[f64; 3]; 2] {
    let least = (0..3).min_by(|a, b| normal[*a].abs().total_cmp(&normal[*b].abs())).unwrap_or(0);
    // n × the axis that it points along least.
    let (j, k) = ((least + 1) % 3, (least + 2) % 3);
    let length = normal[j].hypot(normal[k]);
    let mut first = [0.0; 3];
    (first[j], first[k]) = (normal[k] / length, -normal[j] / length);
    let [n, t] = [normal, first];
    [t, [n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2], n[0] * t[1] - n[1] * t[0]]]
}

/// D⁻¹ G, row by row.
fn weights(d: &Entries, g: &Entries) -> Result<Vec<Weighted>, Error> {
    /// A slave node that shares less than this part of the largest area only touches the other surface's edge.
    const TOUCHES: f64 = 1e-9;
    /// Weights below this are what rounding makes of zero.
    const ZERO: f64 = 1e-13;
    let largest = d.iter().filter(|((a, b), _)| a == b).map(|(_, v)| *v).fold(0.0, f64::max);
    let rows: Vec<usize> =
        d.iter().filter(|((a, b), v)| a == b && **v > TOUCHES * largest).map(|((a, _), _)| *a).collect();
    let mut columns: Vec<usize> = g.keys().map(|(_, j)| *j).collect();
    columns.sort_unstable();
    columns.dedup();
    if rows.is_empty() {
        let what =
            "the two surfaces of a contact share no area: move them together, or name other faces".to_owned();
        return Err(Error::Contact { what });
    }
    let entry = |of: &Entries, a: usize, b: usize| of.get(&(a, b)).copied().unwrap_or(0.0);
    let left = Mat::from_fn(rows.len(), rows.len(), |i, j| entry(d, rows[i], rows[j]));
    let right = Mat::from_fn(rows.len(), columns.len(), |i, j| entry(g, rows[i], columns[j]));
    let solved = left.partial_piv_lu().solve(&right);
    let row = |i: usize| {
        let all = columns.iter().enumerate().map(|(j, master)| (*master, solved[(i, j)]));
        all.filter(|(_, w)| w.abs() > ZERO).collect()
    };
    Ok(rows.iter().enumerate().map(|(i, slave)| (*slave, row(i))).collect())
}

pub(super) fn one_plane<'a>(
    mesh: &Mesh,
    normal: [f64; 3],
    faces: impl Iterator<Item = &'a Face>,
) -> Result<(), Error> {
    /// How far surfaces may lie apart, over the size of the mesh.
    const FLAT: f64 = 1e-6;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for node in faces.flat_map(|face| &face.nodes) {
        let height: f64 = (0..3).map(|i| normal[i] * mesh.nodes[*node][i]).sum();
        (low, high) = (low.min(height), high.max(height));
    }
    let limit = FLAT * mesh.extent();
    if high - low > limit {
        let what = format!(
            "the surfaces of a contact lie up to {:.2e} m apart along its normal, they may lie {limit:.1e} m apart: they have to be flat \
             and meet",
            high - low
        );
        return Err(Error::Contact { what });
    }
    Ok(())
}

impl Flat {
    pub(super) fn new(mesh: &Mesh, face: &Face, along: [f64; 3], across: [f64; 3]) -> Self {
        let on = |node: &usize| {
            let x = mesh.nodes[*node];
            [along, across].map(|axis| (0..3).map(|i| axis[i] * x[i]).sum::<f64>())
        };
        let at: Vec<Plane> = face.nodes.iter().map(on).collect();
        let mut corners = at[..face.kind.corners()].to_vec();
        if area(&corners) < 0.0 {
            corners.reverse();
        }
        let fold =
            |f: fn(f64, f64) -> f64, from: f64| [0, 1].map(|i| corners.iter().map(|c| c[i]).fold(from, f));
        let (low, high) = (fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY));
        Self { kind: face.kind, nodes: face.nodes.clone(), at, corners, low, high }
    }

    fn near(&self, other: &Self) -> bool {
        (0..2).all(|i| self.low[i] < other.high[i] && other.low[i] < self.high[i])
    }

    /// How far a place lies outside, m; below 0 inside. Edges are taken as straight.
    pub(super) fn outside(&self, place: Plane) -> f64 {
        let corners = &self.corners;
        let beyond = |i: usize| {
            let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
            let (along, to) = ([b[0] - a[0], b[1] - a[1]], [place[0] - a[0], place[1] - a[1]]);
            (along[1] * to[0] - along[0] * to[1]) / along[0].hypot(along[1])
        };
        (0..corners.len()).map(beyond).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Shape functions at a place.
    pub(super) fn shape_at(&self, place: Plane) -> Vec<f64> {
        face_shape(self.kind, self.local(place)).0
    }

    /// The coordinates of a place in the reference face, by Newton's method.
    fn local(&self, place: Plane) -> Plane {
        const STEPS: usize = 30;
        let mut at = if self.kind.corners() == 3 { [1.0 / 3.0; 2] } else { [0.0; 2] };
        for _ in 0..STEPS {
            let (value, gradient) = face_shape(self.kind, at);
            let (mut left, mut jacobian) = (place, [[0.0; 2]; 2]);
            for (node, x) in self.at.iter().enumerate() {
                for i in 0..2 {
                    left[i] -= value[node] * x[i];
                    (0..2).for_each(|j| jacobian[i][j] += gradient[node][j] * x[i]);
                }
            }
            let [[a, b], [c, d]] = jacobian;
            let determinant = a * d - b * c;
            let step = [(d * left[0] - b * left[1]) / determinant, (a * left[1] - c * left[0]) / determinant];
            at = [at[0] + step[0], at[1] + step[1]];
            if step[0].abs() + step[1].abs() < 1e-14 {
                break;
            }
        }
        at
    }
}

fn area(polygon: &[Plane]) -> f64 {
    let twice: f64 = (0..polygon.len())
        .map(|i| {
            let (a, b) = (polygon[i], polygon[(i + 1) % polygon.len()]);
            a[0] * b[1] - a[1] * b[0]
        })
        .sum();
    twice / 2.0
}

/// The part of a convex polygon inside another (Sutherland and Hodgman), both counter-clockwise.
fn clip(polygon: &[Plane], window: &[Plane]) -> Vec<Plane> {
    let mut kept = polygon.to_vec();
    for i in 0..window.len() {
        let (a, b) = (window[i], window[(i + 1) % window.len()]);
        let inside = |p: Plane| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
        let mut next = Vec::with_capacity(kept.len() + 1);
        for j in 0..kept.len() {
            let (p, q) = (kept[j], kept[(j + 1) % kept.len()]);
            let (dp, dq) = (inside(p), inside(q));
            if dp >= 0.0 {
                next.push(p);
            }
            if (dp > 0.0 && dq < 0.0) || (dp < 0.0 && dq > 0.0) {
                let s = dp / (dp - dq);
                next.push([p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])]);
            }
        }
        kept = next;
    }
    kept
}

/// The triangles that a slave face shares with each master; none where that is next to nothing of it: nodes that press on a sliver alone would be
/// known by rounding.
fn overlaps<'a>(slave: &Flat, masters: &'a [Flat]) -> Vec<(&'a Flat, [Plane; 3])> {
    /// That part of the face.
    const SLIVER: f64 = 5e-3;
    let (mut found, mut shared) = (Vec::new(), 0.0);
    for master in masters.iter().filter(|master| slave.near(master)) {
        let overlap = clip(&slave.corners, &master.corners);
        for i in 1..overlap.len().saturating_sub(1) {
            let corners = [overlap[0], overlap[i], overlap[i + 1]];
            shared += area(&corners);
            found.push((master, corners));
        }
    }
    if shared < SLIVER * area(&slave.corners) { Vec::new() } else { found }
}

/// A place in a triangle by its coordinates in the reference one.
fn inside([a, b, c]: [Plane; 3], [u, v]: Plane) -> Plane {
    [0, 1].map(|i| a[i] + u * (b[i] - a[i]) + v * (c[i] - a[i]))
}

/// Adds the integrals over one triangle of an overlap.
fn integrate(
    [slave, master]: [&Flat; 2],
    [a, b, c]: [Plane; 3],
    rule: &[(Plane, f64)],
    d: &mut Entries,
    g: &mut Entries,
) {
    let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if !(twice > 0.0) {
        return;
    }
    for ([u, v], weight) in rule {
        let place = inside([a, b, c], [*u, *v]);
        let (own, other) = (slave.shape_at(place), master.shape_at(place));
        for (node, n) in slave.nodes.iter().zip(&own) {
            for (with, m) in slave.nodes.iter().zip(&own) {
                *d.entry((*node, *with)).or_default() += weight * twice * n * m;
            }
            for (with, m) in master.nodes.iter().zip(&other) {
                *g.entry((*node, *with)).or_default() += weight * twice * n * m;
            }
        }
    }
}
