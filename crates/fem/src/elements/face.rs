//! Faces of the solid elements: shape functions in two coordinates.

/// A kind of face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FaceKind {
    /// Triangle of 3 nodes.
    Tri3,
    /// Triangle of 6 nodes.
    Tri6,
    /// Quadrilateral of 4 nodes.
    Quad4,
    /// Quadrilateral of 8 nodes.
    Quad8,
}

impl FaceKind {
    /// Number of corners.
    #[must_use]
    pub fn corners(self) -> usize {
        match self {
            Self::Tri3 | Self::Tri6 => 3,
            Self::Quad4 | Self::Quad8 => 4,
        }
    }
}

/// Values and derivatives ∂/∂ξ, ∂/∂η of the shape functions of a face at a point of its reference face.
#[must_use]
pub fn face_shape(kind: FaceKind, at: [f64; 2]) -> (Vec<f64>, Vec<[f64; 2]>) {
    match kind {
        FaceKind::Tri3 | FaceKind::Tri6 => triangle(kind, at),
        FaceKind::Quad4 | FaceKind::Quad8 => quadrilateral(kind, at),
    }
}

fn triangle(kind: FaceKind, at: [f64; 2]) -> (Vec<f64>, Vec<[f64; 2]>) {
    let l = [1.0 - at[0] - at[1], at[0], at[1]];
    let slopes = [[-1., -1.], [1., 0.], [0., 1.]];
    if kind == FaceKind::Tri3 {
        return (l.to_vec(), slopes.to_vec());
    }
    let mut value: Vec<f64> = l.iter().map(|l| l * (2.0 * l - 1.0)).collect();
    let mut gradient: Vec<[f64; 2]> = (0..3).map(|i| slopes[i].map(|d| d * (4.0 * l[i] - 1.0))).collect();
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        value.push(4.0 * l[i] * l[j]);
        gradient.push([0, 1].map(|k| 4.0 * (slopes[i][k] * l[j] + l[i] * slopes[j][k])));
    }
    (value, gradient)
}

fn quadrilateral(kind: FaceKind, at: [f64; 2]) -> (Vec<f64>, Vec<[f64; 2]>) {
    const CORNERS: [[f64; 2]; 4] = [[-1., -1.], [1., -1.], [1., 1.], [-1., 1.]];
    const MIDDLES: [[f64; 2]; 4] = [[0., -1.], [1., 0.], [0., 1.], [-1., 0.]];
    let [x, y] = at;
    let (mut value, mut gradient) = (Vec::with_capacity(8), Vec::with_capacity(8));
    for [a, b] in CORNERS {
        let (f, g, s) = (1.0 + x * a, 1.0 + y * b, x * a + y * b - 1.0);
        if kind == FaceKind::Quad4 {
            value.push(f * g / 4.0);
            gradient.push([a * g / 4.0, f * b / 4.0]);
        } else {
            value.push(f * g * s / 4.0);
            gradient.push([a * g * (s + f) / 4.0, b * f * (s + g) / 4.0]);
        }
    }
    if kind == FaceKind::Quad8 {
        for [a, b] in MIDDLES {
            if a == 0.0 {
                value.push((1.0 - x * x) * (1.0 + y * b) / 2.0);
                gradient.push([-x * (1.0 + y * b), (1.0 - x * x) * b / 2.0]);
            } else {
                value.push((1.0 + x * a) * (1.0 - y * y) / 2.0);
                gradient.push([a * (1.0 - y * y) / 2.0, -y * (1.0 + x * a)]);
            }
        }
    }
    (value, gradient)
}
