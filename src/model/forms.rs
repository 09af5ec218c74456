//! The equations of motion of each contact state as rows: linear forms of coordinates and velocities, with constants.
//!
//! Springs and dampers of the model become numbers here. Whoever steps the rows knows their coordinates by number alone:
//! a model is its parameters, its equilibrium and its rows.

use crate::model::scaled::Scaled;

/// A linear form of `N` coordinates and of their velocities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Form<const N: usize> {
    /// Coefficients of the coordinates.
    pub positions: [f64; N],
    /// Coefficients of their velocities.
    pub velocities: [f64; N],
}

impl<const N: usize> Form<N> {
    /// Each coefficient from those that some forms have at its place.
    fn zip<const F: usize>(forms: [&Form<N>; F], value: impl Fn([f64; F]) -> f64) -> Form<N> {
        Form {
            positions: std::array::from_fn(|i| value(forms.map(|form| form.positions[i]))),
            velocities: std::array::from_fn(|i| value(forms.map(|form| form.velocities[i]))),
        }
    }
}

/// The rows of a model of `N` coordinates whose contact moves by two of them, along the belt and away from it; as
/// deviations from the sliding equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rows<const N: usize> {
    /// `R`, the tangential spring force at the contact.
    pub tangential: Form<N>,
    /// `W`, the normal spring force at the contact.
    pub normal: Form<N>,
    /// The accelerations of the coordinate that does not touch the belt.
    pub beyond: Form<N>,
    /// The accelerations of the contact in free flight, along the belt and away from it.
    pub flight: [Form<N>; 2],
    /// The accelerations of the contact in free flight at the sliding equilibrium, where belt and spring forces balance.
    pub fall: [f64; 2],
}

impl Scaled {
    /// The rows of the two-mass model; coordinates `x2 y2 y1`.
    #[must_use]
    pub fn rows(&self) -> Rows<3> {
        let (s, c) = (self.s, self.c);
        // h = k2 (x s + y c − w) and g = k1 (x c − y s), likewise with the dampers.
        let form = |cosine: f64, sine: f64| -> Form<3> {
            let part =
                |g: f64, h: f64| [sine * h * s + cosine * g * c, sine * h * c - cosine * g * s, -sine * h];
            Form { positions: part(self.k1, self.k2), velocities: part(self.c1, self.c2) }
        };
        let (r, w, h) = (form(c, s), form(-s, c), form(0.0, 1.0));
        let inv_det = 1.0 / self.det;
        let combine = |[on_r, on_w]: [f64; 2]| Form::zip([&r, &w], |[r, w]| on_r * r + on_w * w);
        let along = [-self.normal_mass * inv_det, -self.kappa * inv_det];
        let away = [-self.kappa * inv_det, -inv_det];
        let (n0, t0) = (self.n0, self.mu0 * self.n0);
        Rows {
            tangential: r,
            normal: w,
            beyond: Form::zip([&h], |[h]| h / self.m1),
            flight: [combine(along), combine(away)],
            fall: [along, away].map(|[on_r, on_w]| on_r * t0 + on_w * n0),
        }
    }
}
