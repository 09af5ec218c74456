//! Fields on the sliding surface: pressures from forces, damping from pressures.
//!
//! The forces that a uniform pressure makes on the nodes of a quadratic face have both signs (a corner of Quad8 is pulled): what is
//! pressed and what is pulled is not seen on them.

use std::collections::{BTreeMap, HashMap};

use super::{Model, Numbering, Point, Rows};
use crate::elements::{face_rule, face_shape};
use crate::mesh::{Face, FaceRef};

/// The slaves' side of a contact.
#[derive(Debug, Clone)]
pub struct Surface {
    faces: Vec<Pressed>,
}

/// A face of the slaves.
#[derive(Debug, Clone)]
struct Pressed {
    face: Face,
    /// The contact point at each node.
    at: Vec<Option<usize>>,
    /// Places where a field is integrated, and the area of each, m².
    places: Vec<([f64; 2], f64)>,
}

impl Surface {
    /// The faces of the slaves, and the contact points on them. On an edge that two surfaces have in common each face takes the points that it
    /// presses.
    #[must_use]
    pub fn new(model: &Model, numbering: &Numbering, faces: &[FaceRef], points: &[Point]) -> Self {
        let mesh = &model.mesh;
        let mut index: HashMap<usize, Vec<usize>> = HashMap::new();
        for (i, point) in points.iter().enumerate() {
            index.entry(numbering.leader[point.slave]).or_default().push(i);
        }
        let pressed = |face: Face| {
            let area = |at: [f64; 2]| face.area(&face_shape(face.kind, at).1, &mesh.nodes);
            let rule = face_rule(face.kind);
            let outward = rule.first().map_or([0.0; 3], |(at, _)| area(*at));
            let presses = |i: &usize| {
                let along: f64 = (0..3).map(|k| -outward[k] * points[*i].normal[k]).sum();
                along > std::f64::consts::FRAC_1_SQRT_2 * length(outward)
            };
            let point = |node: &usize| index.get(&numbering.leader[*node])?.iter().copied().find(presses);
            let at = face.nodes.iter().map(point).collect();
            let whole = || rule.iter().map(|(at, weight)| (*at, weight * length(area(*at)))).collect();
            let places = model.partly.get(&face.of).cloned().unwrap_or_else(whole);
            Pressed { face, at, places }
        };
        Self { faces: mesh.resolve(faces).into_iter().map(pressed).collect() }
    }

    /// ∫ f N_a N_b dA between contact points, of a field f by its values at the contact points: with f = 1 the areas by which pressures
    /// become forces, with f = p0 μ'(V) the damping (N s/m) that a slope of friction makes.
    #[must_use]
    pub fn matrix(&self, field: &[f64]) -> Rows {
        let mut sums: Vec<BTreeMap<usize, f64>> = vec![BTreeMap::new(); field.len()];
        for Pressed { face, at, places } in &self.faces {
            for (place, area) in places {
                let (value, _) = face_shape(face.kind, *place);
                let f: f64 = at.iter().zip(&value).filter_map(|(p, n)| p.map(|p| n * field[p])).sum();
                for (p, np) in at.iter().zip(&value).filter_map(|(p, n)| p.map(|p| (p, n))) {
                    for (q, nq) in at.iter().zip(&value).filter_map(|(q, n)| q.map(|q| (q, n))) {
                        *sums[p].entry(q).or_default() += area * f * np * nq;
                    }
                }
            }
        }
        Rows { rows: sums.into_iter().map(|row| row.into_iter().collect()).collect() }
    }
}

fn length(vector: [f64; 3]) -> f64 {
    vector.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// The part of a force in the middle of an edge that each corner takes over.
pub const SHARE: f64 = 0.2;

impl Surface {
    /// Contact points in the middles of edges, with those at the corners beside each.
    #[must_use]
    pub fn middles(&self) -> Vec<(usize, Vec<usize>)> {
        let mut found = BTreeMap::new();
        for Pressed { face, at, .. } in &self.faces {
            let corners = face.kind.corners();
            for (i, middle) in at[corners..].iter().enumerate() {
                // An edge inside the surface is met twice.
                let Some(middle) = *middle else { continue };
                let beside = [at[i], at[(i + 1) % corners]];
                found.insert(middle, beside.into_iter().flatten().collect());
            }
        }
        found.into_iter().collect()
    }

    /// What presses each contact point, N, from the forces on the nodes: corners of quadratic faces take over a fifth of the forces
    /// in the middles of their edges, by which a uniform pressure presses everywhere (Popp, Wohlmuth, Gee and Wall, Dual quadratic
    /// mortar finite element methods for 3D finite deformation contact, SIAM J. Sci. Comput. 34, 2012).
    #[must_use]
    pub fn pressing(&self, forces: &[f64]) -> Vec<f64> {
        let mut pressing = forces.to_vec();
        for (middle, corners) in self.middles() {
            pressing[middle] -= 2.0 * SHARE * forces[middle];
            for corner in corners {
                pressing[corner] += SHARE * forces[middle];
            }
        }
        pressing
    }
}

/// The pressures (Pa) at contact points that make these normal forces (N), by conjugate gradients on the matrix of areas.
#[must_use]
pub fn pressures(areas: &Rows, forces: &[f64]) -> Vec<f64> {
    /// The matrix of areas has a condition of some tens: rounding is reached long before.
    const STEPS: usize = 500;
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let diagonal: Vec<f64> = areas
        .rows
        .iter()
        .enumerate()
        .map(|(i, row)| row.iter().find(|(j, _)| *j == i).map_or(1.0, |(_, a)| *a))
        .collect();
    let scaled = |r: &[f64]| -> Vec<f64> { r.iter().zip(&diagonal).map(|(r, d)| r / d).collect() };
    let mut x = vec![0.0; forces.len()];
    let mut r = forces.to_vec();
    let mut z = scaled(&r);
    let mut p = z.clone();
    let mut rho = dot(&r, &z);
    let end = 1e-30 * rho;
    for _ in 0..STEPS {
        if !(rho > end) {
            break;
        }
        let image = areas.times(&p);
        let step = rho / dot(&p, &image);
        x.iter_mut().zip(&p).for_each(|(x, p)| *x += step * p);
        r.iter_mut().zip(&image).for_each(|(r, i)| *r -= step * i);
        z = scaled(&r);
        let next = dot(&r, &z);
        p.iter_mut().zip(&z).for_each(|(p, z)| *p = z + next / rho * *p);
        rho = next;
    }
    x
}
