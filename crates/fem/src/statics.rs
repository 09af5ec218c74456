//! The static step: a load presses the bodies together while they slide; what gapes is left out.

use std::collections::HashSet;

use faer::Mat;

use crate::Error;
use crate::assembly::{Loads, Model, Numbering, Pencil, assemble, load_vector};
use crate::contact::{Point, SHARE, Surface, pressures};
use crate::mesh::FaceRef;
use crate::modes::{Factor, Ordering};

/// Bodies at rest under a load, in steady sliding.
#[derive(Debug)]
pub struct Settled {
    /// The model with the contact points that are pressed.
    pub model: Model,
    /// Its numbering and matrices.
    pub numbering: Numbering,
    /// Its matrices.
    pub pencil: Pencil,
    /// Displacements of all nodes, m.
    pub displacement: Vec<[f64; 3]>,
    /// Normal force N0 of each pressed point, N. A point that follows open corners hands a fifth of it on to each.
    pub forces: Vec<f64>,
    /// The normal force of the whole contact, N.
    pub force: f64,
    /// Pressure at each pressed point, Pa.
    pub pressures: Vec<f64>,
    /// The slaves' side.
    pub surface: Surface,
    /// Contact points that gape.
    pub open: Vec<Point>,
}

impl Settled {
    /// The matrices with the geometric stiffness of the bodies' stress: what it changes is for the caller to compare.
    ///
    /// # Errors
    /// Bad elements.
    pub fn stiffened(&self) -> Result<Pencil, Error> {
        let stressed = Some(self.displacement.clone());
        Ok(assemble(&Model { stressed, ..self.model.clone() })?.1)
    }
}

/// Solves (K + μ Sᵀ K_n) q = f + μ Sᵀ f_n, takes out the points that are pulled, puts back those that overlap, until none is left of
/// either. `faces` are those of the slaves.
///
/// The middle of an edge of a quadratic face is held at a fifth of the gaps at the corners beside it: that gap and the force which presses
/// it (see [`Surface::pressing`]) are conjugate, so that without friction there is one state in which each point is pressed or open.
///
/// # Errors
/// A body that can move without a force; a contact of which nothing stays pressed; no end to opening and closing.
pub fn settle(model: &Model, faces: &[FaceRef], loads: &Loads, mu: f64) -> Result<Settled, Error> {
    /// Each round moves the edge of the pressed area by an element or so.
    const ROUNDS: usize = 60;
    /// Rounds that change one point only, the worst, once a state comes again.
    const SINGLE: usize = 20;
    /// What rounding makes of zero, over the largest force or gap.
    const ZERO: f64 = 1e-9;
    let all = &model.contact;
    let numbering = Numbering::new(&model.mesh, &model.supports, &[])?;
    let whole = Surface::new(model, &numbering, faces, all);
    // Where a stiffness holds the points, each has its own gap.
    let middles = if model.penalty.is_some() { Vec::new() } else { whole.middles() };
    let mut pressed: Vec<bool> = vec![true; all.len()];
    let mut met = HashSet::new();
    let mut single = false;
    let (mut rounds, mut left) = (0, ROUNDS);
    while left > 0 {
        (rounds, left) = (rounds + 1, left - 1);
        if !single && !met.insert(pressed.clone()) {
            (single, left) = (true, SINGLE);
        }
        let mut now = model.clone();
        now.contact = held(all, &pressed, &middles);
        if now.contact.is_empty() && !all.is_empty() {
            let what =
                "the surfaces are pulled apart, so that nothing of the contact stays pressed: turn the sign of the load or \
                        displacement round (a pressure or force above 0 pushes onto the faces of its set)"
                    .to_owned();
            return Err(Error::Contact { what });
        }
        let (numbering, pencil) = assemble(&now)?;
        let (displacement, forces) = slide(&now, &numbering, &pencil, loads, mu)?;
        let largest = |a: f64, u: &f64| if u.is_finite() { a.max(u.abs()) } else { f64::INFINITY };
        let farthest = displacement.iter().flatten().fold(0.0, largest);
        if farthest > now.mesh.extent() {
            // Points on one line let a body turn: the matrix is singular but for rounding. All of them do not.
            return Err(if rounds > 1 { tips(rounds, mu) } else { moves(farthest, now.mesh.extent()) });
        }
        let surface = Surface::new(&now, &numbering, faces, &now.contact);
        // How much each point is on the wrong side: pulled, or overlapping.
        let pressing = surface.pressing(&forces);
        let gaps = gaps(all, &middles, &displacement);
        let [largest, widest] =
            [&pressing, &gaps].map(|all| all.iter().fold(0.0, |a: f64, b| a.max(b.abs())));
        let mut pressing = pressing.iter();
        let wrong = pressed.iter().zip(&gaps).map(|(on, gap)| {
            let force = if *on { pressing.next() } else { None };
            let gape = gap / widest;
            force.map_or(-gape, |force| {
                let pulled = -force / largest;
                // Forces of a face that lies on its master in part have both signs, by a stiffness though it overlaps.
                if now.penalty.is_some() { pulled.min(gape) } else { pulled }
            })
        });
        let wrong: Vec<f64> = wrong.collect();
        let most = (0..wrong.len()).max_by(|a, b| wrong[*a].total_cmp(&wrong[*b]));
        let Some(most) = most.filter(|most| wrong[*most] > ZERO) else {
            let open: Vec<Point> =
                all.iter().zip(&pressed).filter(|(_, on)| !**on).map(|(p, _)| p.clone()).collect();
            let areas = surface.matrix(&vec![1.0; forces.len()]);
            let pressures = pressures(&areas, &forces);
            return Ok(Settled {
                numbering,
                pencil,
                displacement,
                force: total(&now.contact, &forces, &open),
                model: now,
                forces,
                pressures,
                surface,
                open,
            });
        };
        for (i, on) in pressed.iter_mut().enumerate() {
            if if single { i == most } else { wrong[i] > ZERO } {
                *on = !*on;
            }
        }
    }
    Err(tips(rounds, mu))
}

fn moves(farthest: f64, size: f64) -> Error {
    let what = format!(
        "the bodies are moved by {farthest:.1e} m, which must be much less than their size of {size:.1e} m: lower the load or displacement \
         (units are N, Pa and m), or check that Young's moduli are in Pa"
    );
    Error::Contact { what }
}

fn tips(rounds: usize, mu: f64) -> Error {
    let what = format!(
        "no state of the contact was found in {rounds} rounds in which each point is pressed or open"
    );
    let why = if mu == 0.0 {
        "the bodies may touch at an edge only; press them over a face, hold them against turning, or mesh the edge finer".to_owned()
    } else {
        format!(
            "static friction of {mu} may tip a body over its edge; lower it, hold the body against turning, or mesh the edge finer"
        )
    };
    Error::Contact { what: format!("{what}: {why}") }
}

/// The points that are pressed; a middle of an edge follows the corners beside it that are open.
fn held(all: &[Point], pressed: &[bool], middles: &[(usize, Vec<usize>)]) -> Vec<Point> {
    let mut points = all.to_vec();
    for (middle, corners) in middles {
        for corner in corners.iter().filter(|corner| !pressed[**corner]) {
            let Point { slave, masters, .. } = &all[*corner];
            let of = &mut points[*middle].masters;
            for (node, w) in
                std::iter::once((*slave, SHARE)).chain(masters.iter().map(|(m, w)| (*m, -SHARE * w)))
            {
                match of.iter_mut().find(|(known, _)| *known == node) {
                    Some((_, sum)) => *sum += w,
                    None => of.push((node, w)),
                }
            }
        }
    }
    points.into_iter().zip(pressed).filter(|(_, on)| **on).map(|(point, _)| point).collect()
}

/// The sum of the forces on all nodes of the slaves, N.
fn total(pressed: &[Point], forces: &[f64], open: &[Point]) -> f64 {
    let slaves: HashSet<usize> = open.iter().map(|point| point.slave).collect();
    let kept = |point: &Point| {
        1.0 - point.masters.iter().filter(|(node, _)| slaves.contains(node)).map(|(_, w)| w).sum::<f64>()
    };
    pressed.iter().zip(forces).map(|(point, force)| force * kept(point)).sum()
}

/// The gaps that are conjugate to what presses the points, but for a positive factor, m.
fn gaps(all: &[Point], middles: &[(usize, Vec<usize>)], displacement: &[[f64; 3]]) -> Vec<f64> {
    let own: Vec<f64> = all.iter().map(|point| gap(point, displacement)).collect();
    let mut gaps = own.clone();
    for (middle, corners) in middles {
        gaps[*middle] -= SHARE * corners.iter().map(|corner| own[*corner]).sum::<f64>();
    }
    gaps
}

/// n·(u_s − Σ w u_m), m.
fn gap(point: &Point, displacement: &[[f64; 3]]) -> f64 {
    let along = |node: usize| (0..3).map(|i| point.normal[i] * displacement[node][i]).sum::<f64>();
    along(point.slave) - point.masters.iter().map(|(master, w)| w * along(*master)).sum::<f64>()
}

/// Displacements and normal forces of one set of pressed points.
fn slide(
    model: &Model,
    numbering: &Numbering,
    pencil: &Pencil,
    loads: &Loads,
    mu: f64,
) -> Result<(Vec<[f64; 3]>, Vec<f64>), Error> {
    let (load, normal_load) = load_vector(model, numbering, loads)?;
    let ordering = Ordering::best(&pencil.stiffness.pattern, &numbering.places(&model.mesh))?;
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0)?;
    let respond = |force: &[f64]| -> Vec<f64> {
        let mut q = Mat::from_fn(force.len(), 1, |i, _| force[i]);
        factor.solve(q.as_mut());
        q.col(0).iter().copied().collect()
    };
    // The normal forces are K_n q − f_n with K q = f − μ Sᵀ N: a linear system for N alone.
    let normal = |q: &[f64]| -> Vec<f64> { pencil.normal_stiffness.times(q) };
    let without: Vec<f64> = normal(&respond(&load)).iter().zip(&normal_load).map(|(k, f)| k - f).collect();
    let forces = if mu == 0.0 {
        without
    } else {
        gmres(&without, |n| {
            let mut friction = vec![0.0; load.len()];
            pencil.slip.add_transposed(n, &mut friction);
            normal(&respond(&friction)).iter().zip(n).map(|(k, n)| n + mu * k).collect()
        })?
    };
    let mut total = load;
    let friction: Vec<f64> = forces.iter().map(|n| -mu * n).collect();
    pencil.slip.add_transposed(&friction, &mut total);
    let mut displacement = numbering.spread(&respond(&total));
    for (node, u) in displacement.iter_mut().enumerate() {
        (0..3).for_each(|i| u[i] += numbering.given[3 * node + i]);
    }
    Ok((displacement, forces))
}

/// Solves A x = b by GMRES without restarts: friction makes few directions.
fn gmres(b: &[f64], apply: impl Fn(&[f64]) -> Vec<f64>) -> Result<Vec<f64>, Error> {
    const SMALL: f64 = 1e-12;
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let beta = dot(b, b).sqrt();
    if beta == 0.0 {
        return Ok(b.to_vec());
    }
    let mut basis = vec![b.iter().map(|x| x / beta).collect::<Vec<f64>>()];
    // Columns of the Hessenberg matrix, turned to a triangle by rotations; the right-hand side with them.
    let mut triangle: Vec<Vec<f64>> = Vec::new();
    let mut turns: Vec<(f64, f64)> = Vec::new();
    let mut rhs = vec![beta];
    for step in 0..b.len() {
        let mut w = apply(&basis[step]);
        let mut column = vec![0.0; step + 1];
        for _ in 0..2 {
            for (h, v) in column.iter_mut().zip(&basis) {
                let part = dot(v, &w);
                *h += part;
                w.iter_mut().zip(v).for_each(|(w, v)| *w -= part * v);
            }
        }
        let next = dot(&w, &w).sqrt();
        for (i, (c, s)) in turns.iter().enumerate() {
            (column[i], column[i + 1]) =
                (c * column[i] + s * column[i + 1], c * column[i + 1] - s * column[i]);
        }
        let length = column[step].hypot(next);
        let (c, s) = (column[step] / length, next / length);
        column[step] = length;
        turns.push((c, s));
        triangle.push(column);
        rhs.push(-s * rhs[step]);
        rhs[step] *= c;
        if rhs[step + 1].abs() <= SMALL * beta || step + 1 == b.len() {
            let mut y = rhs[..=step].to_vec();
            for i in (0..=step).rev() {
                let known: f64 = (i + 1..=step).map(|j| triangle[j][i] * y[j]).sum();
                y[i] = (y[i] - known) / triangle[i][i];
            }
            return Ok((0..b.len()).map(|i| y.iter().zip(&basis).map(|(y, v)| y * v[i]).sum()).collect());
        }
        for w in &mut w {
            *w /= next;
        }
        basis.push(w);
    }
    Err(Error::Solver {
        what: "the normal forces did not converge: friction is too high for steady sliding".to_owned(),
    })
}
