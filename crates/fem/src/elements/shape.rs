//! Shape functions of the solid elements and their derivatives in the reference element.

use super::Kind;

/// Values and derivatives of all shape functions at one point.
#[derive(Debug, Clone)]
pub struct Shape {
    /// N of each node.
    pub value: Vec<f64>,
    /// ∂N/∂ξ, ∂N/∂η, ∂N/∂ζ of each node.
    pub gradient: Vec<[f64; 3]>,
}

/// The shape functions of a kind at the point (ξ, η, ζ) of its reference element.
#[must_use]
pub fn shape(kind: Kind, at: [f64; 3]) -> Shape {
    match kind {
        Kind::Hex8 => hex8(at),
        Kind::Hex20 | Kind::Hex20Reduced => hex20(at),
        Kind::Tet4 => tet4(at),
        Kind::Tet10 => tet10(at),
        Kind::Wedge15 => wedge15(at),
    }
}

/// N = (1 + ξ ξ_i)(1 + η η_i)(1 + ζ ζ_i)/8.
fn hex8(at: [f64; 3]) -> Shape {
    let (mut value, mut gradient) = (Vec::with_capacity(8), Vec::with_capacity(8));
    for node in Kind::Hex8.reference() {
        let f = [0, 1, 2].map(|i| 1.0 + at[i] * node[i]);
        value.push(f[0] * f[1] * f[2] / 8.0);
        gradient.push([0, 1, 2].map(|i| node[i] * f[(i + 1) % 3] * f[(i + 2) % 3] / 8.0));
    }
    Shape { value, gradient }
}

/// Serendipity. Corners: N = (1 + ξ ξ_i)(1 + η η_i)(1 + ζ ζ_i)(ξ ξ_i + η η_i + ζ ζ_i − 2)/8; the middle of an edge along
/// ξ: N = (1 − ξ²)(1 + η η_i)(1 + ζ ζ_i)/4.
fn hex20(at: [f64; 3]) -> Shape {
    let (mut value, mut gradient) = (Vec::with_capacity(20), Vec::with_capacity(20));
    for node in Kind::Hex20.reference() {
        if let Some(along) = node.iter().position(|x| *x == 0.0) {
            let (p, q) = ((along + 1) % 3, (along + 2) % 3);
            let (a, b, c) = (1.0 - at[along] * at[along], 1.0 + at[p] * node[p], 1.0 + at[q] * node[q]);
            value.push(a * b * c / 4.0);
            let mut d = [0.0; 3];
            d[along] = -2.0 * at[along] * b * c / 4.0;
            d[p] = a * node[p] * c / 4.0;
            d[q] = a * b * node[q] / 4.0;
            gradient.push(d);
        } else {
            let f = [0, 1, 2].map(|i| 1.0 + at[i] * node[i]);
            let s = at[0] * node[0] + at[1] * node[1] + at[2] * node[2] - 2.0;
            value.push(f[0] * f[1] * f[2] * s / 8.0);
            gradient.push([0, 1, 2].map(|i| node[i] * f[(i + 1) % 3] * f[(i + 2) % 3] * (s + f[i]) / 8.0));
        }
    }
    Shape { value, gradient }
}

/// Coordinates L of a triangle or tetrahedron and their derivatives.
const TET_SLOPES: [[f64; 3]; 4] = [[-1., -1., -1.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];

/// N = L_i.
fn tet4(at: [f64; 3]) -> Shape {
    let l = [1.0 - at[0] - at[1] - at[2], at[0], at[1], at[2]];
    Shape { value: l.to_vec(), gradient: TET_SLOPES.to_vec() }
}

/// Corners: N = L_i (2 L_i − 1); middles: N = 4 L_i L_j.
fn tet10(at: [f64; 3]) -> Shape {
    let l = [1.0 - at[0] - at[1] - at[2], at[0], at[1], at[2]];
    let mut value: Vec<f64> = l.iter().map(|l| l * (2.0 * l - 1.0)).collect();
    let mut gradient: Vec<[f64; 3]> = (0..4).map(|i| TET_SLOPES[i].map(|d| d * (4.0 * l[i] - 1.0))).collect();
    for [a, b] in Kind::Tet10.edges() {
        value.push(4.0 * l[*a] * l[*b]);
        gradient.push([0, 1, 2].map(|i| 4.0 * (TET_SLOPES[*a][i] * l[*b] + l[*a] * TET_SLOPES[*b][i])));
    }
    Shape { value, gradient }
}

/// With L of the triangle and s = ±1 of the node's end: corners N = L (2 L − 1)(1 + s ζ)/2 − L (1 − ζ²)/2, middles of
/// the triangles' edges N = 2 L_i L_j (1 + s ζ), middles between the triangles N = L (1 − ζ²).
fn wedge15(at: [f64; 3]) -> Shape {
    let l = [1.0 - at[0] - at[1], at[0], at[1]];
    let slopes = [[-1., -1.], [1., 0.], [0., 1.]];
    let z = at[2];
    let bubble = 1.0 - z * z;
    let (mut value, mut gradient) = (Vec::with_capacity(15), Vec::with_capacity(15));
    for s in [-1.0, 1.0] {
        for i in 0..3 {
            let end = f64::midpoint(1.0, s * z);
            value.push(l[i] * (2.0 * l[i] - 1.0) * end - l[i] * bubble / 2.0);
            let d = (4.0 * l[i] - 1.0) * end - bubble / 2.0;
            gradient.push([
                d * slopes[i][0],
                d * slopes[i][1],
                l[i] * (2.0 * l[i] - 1.0) * s / 2.0 + l[i] * z,
            ]);
        }
    }
    for s in [-1.0, 1.0] {
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let end = 2.0 * (1.0 + s * z);
            value.push(l[i] * l[j] * end);
            let d = [0, 1].map(|k| (slopes[i][k] * l[j] + l[i] * slopes[j][k]) * end);
            gradient.push([d[0], d[1], 2.0 * s * l[i] * l[j]]);
        }
    }
    for i in 0..3 {
        value.push(l[i] * bubble);
        gradient.push([slopes[i][0] * bubble, slopes[i][1] * bubble, -2.0 * z * l[i]]);
    }
    Shape { value, gradient }
}
