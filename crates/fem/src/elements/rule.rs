//! Points of integration.
//!
//! Gauss's rules on a line; their products on bricks and quadrilaterals; on triangles and tetrahedra the products in collapsed
//! coordinates x = u, y = v (1 − u), z = w (1 − u)(1 − v), whose Jacobian (1 − u)²(1 − v) raises the degree along u by
//! two and along v by one.

use super::{FaceKind, Kind};

/// A point of integration: place in the reference element and weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// ξ, η, ζ.
    pub at: [f64; 3],
    /// Weight.
    pub weight: f64,
}

/// Gauss's rule on −1 to 1: places and weights.
fn gauss(points: usize) -> Vec<(f64, f64)> {
    match points {
        2 => [-1.0, 1.0].map(|s| (s / 3f64.sqrt(), 1.0)).to_vec(),
        3 => {
            let a = 0.6f64.sqrt();
            vec![(-a, 5.0 / 9.0), (0.0, 8.0 / 9.0), (a, 5.0 / 9.0)]
        }
        _ => {
            let root = (1.2f64).sqrt() * 2.0 / 7.0;
            let (a, b) = ((3.0 / 7.0 - root).sqrt(), (3.0 / 7.0 + root).sqrt());
            let (wa, wb) = ((18.0 + 30f64.sqrt()) / 36.0, (18.0 - 30f64.sqrt()) / 36.0);
            vec![(-b, wb), (-a, wa), (a, wa), (b, wb)]
        }
    }
}

/// The same on 0 to 1.
fn gauss_unit(points: usize) -> Vec<(f64, f64)> {
    gauss(points).into_iter().map(|(x, w)| (f64::midpoint(1.0, x), w / 2.0)).collect()
}

fn brick(points: usize) -> Vec<Point> {
    let line = gauss(points);
    let mut rule = Vec::with_capacity(points.pow(3));
    for (z, c) in &line {
        for (y, b) in &line {
            rule.extend(line.iter().map(|(x, a)| Point { at: [*x, *y, *z], weight: a * b * c }));
        }
    }
    rule
}

/// Exact on the triangle up to degree 4 with 3 points along each direction, and up to degree 6 with 4.
fn triangle(points: usize) -> Vec<Point> {
    let mut rule = Vec::with_capacity(points * points);
    for (u, a) in gauss_unit(points) {
        rule.extend(
            gauss_unit(points)
                .into_iter()
                .map(|(v, b)| Point { at: [u, v * (1.0 - u), 0.0], weight: a * b * (1.0 - u) }),
        );
    }
    rule
}

/// Exact up to degree 6 on the triangle, as products of the shape functions of Quad8 are.
#[must_use]
pub fn triangle_rule() -> Vec<([f64; 2], f64)> {
    triangle(4).into_iter().map(|p| ([p.at[0], p.at[1]], p.weight)).collect()
}

/// Exact up to degree 4 on the tetrahedron.
fn tetrahedron() -> Vec<Point> {
    let mut rule = Vec::with_capacity(36);
    for (u, a) in gauss_unit(4) {
        for (v, b) in gauss_unit(3) {
            for (w, c) in gauss_unit(3) {
                let at = [u, v * (1.0 - u), w * (1.0 - u) * (1.0 - v)];
                rule.push(Point { at, weight: a * b * c * (1.0 - u) * (1.0 - u) * (1.0 - v) });
            }
        }
    }
    rule
}

fn wedge(triangle: &[Point]) -> Vec<Point> {
    let along = |(z, c): (f64, f64)| {
        triangle
            .iter()
            .map(move |p| Point { at: [p.at[0], p.at[1], z], weight: p.weight * c })
            .collect::<Vec<_>>()
    };
    gauss(3).into_iter().flat_map(along).collect()
}

/// The points at which the stiffness of an element is integrated.
#[must_use]
pub fn stiffness_rule(kind: Kind) -> Vec<Point> {
    match kind {
        Kind::Hex8 | Kind::Hex20Reduced => brick(2),
        Kind::Hex20 => brick(3),
        Kind::Tet4 => vec![Point { at: [0.25; 3], weight: 1.0 / 6.0 }],
        // Exact up to degree 2: the strains of a straight-sided element are linear.
        Kind::Tet10 => {
            let (a, b) = ((5.0 + 3.0 * 5f64.sqrt()) / 20.0, (5.0 - 5f64.sqrt()) / 20.0);
            let weight = 1.0 / 24.0;
            [[b, b, b], [a, b, b], [b, a, b], [b, b, a]].map(|at| Point { at, weight }).to_vec()
        }
        // Nine points, as Abaqus and CalculiX take for C3D15.
        Kind::Wedge15 => {
            let (a, b, weight) = (2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0);
            wedge(&[[b, b], [a, b], [b, a]].map(|[x, y]| Point { at: [x, y, 0.0], weight }))
        }
    }
}

/// Where the mass of an element is integrated.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Inertia {
    /// At enough points for products of shape functions, where edges are straight and opposite faces parallel.
    #[default]
    Exact,
    /// As CalculiX does: at the points of the stiffness, which are too few for Hex20R, Tet4, Tet10 and Wedge15.
    Calculix,
}

/// The points at which the mass of an element is integrated.
#[must_use]
pub fn mass_rule(kind: Kind, inertia: Inertia) -> Vec<Point> {
    match kind {
        _ if inertia == Inertia::Calculix => stiffness_rule(kind),
        Kind::Hex8 => brick(2),
        Kind::Hex20 | Kind::Hex20Reduced => brick(3),
        Kind::Tet4 | Kind::Tet10 => tetrahedron(),
        Kind::Wedge15 => wedge(&triangle(3)),
    }
}

/// The points at which a face is integrated.
#[must_use]
pub fn face_rule(kind: FaceKind) -> Vec<([f64; 2], f64)> {
    match kind {
        FaceKind::Tri3 | FaceKind::Tri6 => {
            triangle(3).into_iter().map(|p| ([p.at[0], p.at[1]], p.weight)).collect()
        }
        FaceKind::Quad4 | FaceKind::Quad8 => {
            let line = gauss(3);
            line.iter().flat_map(|(y, b)| line.iter().map(move |(x, a)| ([*x, *y], a * b))).collect()
        }
    }
}
