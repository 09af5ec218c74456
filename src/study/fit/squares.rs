//! Measured friction → a material: law parameters against temperature, by least squares.
//!
//! Every law that is offered is linear in `μ_s` and `μ_d` once its velocity is fixed:
//!
//! ```text
//! bilinear      μ = μ_s (1 − w) + μ_d w      w = min(|v|/v_k, 1)
//! exponential   the same with                w = 1 − exp(−|v|/v_0)
//! constant      μ = μ_d                      (w = 1)
//! ```
//!
//! and a material is linear in temperature between its rows, so all rows follow from one linear least-squares problem
//! with hat functions of temperature. The velocity is either given or found by minimising the residual over it.
//!

use crate::model::Param;
use crate::model::friction::LawKind;
use crate::study::fit::errors;
use crate::study::fit::fault::FitFault;
use crate::study::fit::problem::{Problem, sum_of_squares};
use crate::study::fit::shape::Shape;

pub(super) use squealmap_identify::Point;

/// A fitted material.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The law.
    pub law: LawKind,
    /// Rising temperatures of the rows, °C.
    pub temperature: Vec<f64>,
    /// The columns of the material: a parameter with its value in every row.
    pub columns: Vec<(Param, Vec<f64>)>,
    /// Standard errors of the columns, in their order, if the errors of friction are independent and alike at all points.
    /// `None` for a velocity that was given. `None` for all columns where the points do not tell: with [`Fit::open`], or
    /// with as many values as points.
    pub errors: Vec<Option<Vec<f64>>>,
    /// Measured less fitted friction, in the order of the points.
    pub residuals: Vec<f64>,
    /// Root mean square of the residuals.
    pub residual: f64,
    /// Standard deviation of the friction coefficients about the law: the residuals for as many points as there are more than
    /// values. `None` where there are no more.
    pub deviation: Option<f64>,
    /// Whether the law's velocity was looked for and the points do not bound it: the fastest one fits as well.
    pub open: bool,
    /// Points used.
    pub points: usize,
}

/// Fits `law` with rows at `temperatures`, as [`crate::study::fit::fit`] does, and one velocity for all of them.
///
/// # Errors
/// When the points do not determine the material.
pub(super) fn together(
    points: &[Point],
    law: LawKind,
    temperatures: &[f64],
    velocity: Option<f64>,
) -> Result<Fit, FitFault> {
    let (params, part): (&[Param], _) = match Shape::of(law) {
        Shape::Level => (&[Param::MuD], None),
        Shape::Falling(part, velocity) => (&[Param::MuS, Param::MuD], Some((part, velocity))),
        Shape::Other => return Err(FitFault::Law { law: law.name() }),
    };
    if let Some(pair) = temperatures.windows(2).find(|pair| pair[0] >= pair[1]) {
        return Err(FitFault::NotRising { first: pair[0], second: pair[1] });
    }
    if points.is_empty() {
        return Err(FitFault::NoPoints);
    }
    let unknowns = params.len() * temperatures.len();
    if points.len() < unknowns || unknowns == 0 {
        return Err(FitFault::TooFew { points: points.len(), unknowns });
    }
    let problem = Problem { points, part: part.map(|(part, _)| part), temperatures, params };
    let fastest = points.iter().map(|point| point.velocity.abs()).fold(0.0, f64::max);
    let (velocity, is_found) = match (part, velocity) {
        (None, _) => (1.0, false),
        (Some(_), Some(velocity)) => (velocity, false),
        (Some(_), None) => (problem.best_velocity(fastest), true),
    };
    let solution = problem.solve(velocity)?;
    let residuals = problem.residuals(&solution, velocity);
    let squares = sum_of_squares(&residuals);
    let free = points.len().checked_sub(unknowns + usize::from(is_found)).filter(|free| *free > 0);
    let variance = free.map(|free| squares / free as f64);
    let open = is_found && !problem.bounds(fastest, squares, variance.unwrap_or_default());
    let errors = variance
        .filter(|_| !open)
        .and_then(|variance| errors::standard_errors(&problem, &solution, (velocity, is_found), variance));
    let error_of = |unknown: usize| errors.as_ref().map(|errors| errors[unknown]);
    let rows = 0..temperatures.len();
    let (mut columns, mut errors_of_columns) = (Vec::new(), Vec::new());
    for (k, param) in params.iter().enumerate() {
        let place = |row: usize| row * params.len() + k;
        let values: Vec<f64> = rows.clone().map(|row| solution[place(row)]).collect();
        if let Some((row, value)) = values.iter().enumerate().find(|(_, value)| **value < 0.0) {
            let (param, temperature) = (param.info().name, temperatures[row]);
            return Err(FitFault::Negative { param, value: *value, temperature });
        }
        columns.push((*param, values));
        errors_of_columns.push(rows.clone().map(|row| error_of(place(row))).collect());
    }
    if let Some((_, param)) = part {
        columns.push((param, vec![velocity; temperatures.len()]));
        let error = is_found.then(|| error_of(unknowns)).flatten();
        errors_of_columns.push(rows.map(|_| error).collect());
    }
    Ok(Fit {
        law,
        temperature: temperatures.to_vec(),
        columns,
        errors: errors_of_columns,
        residual: (squares / points.len() as f64).sqrt(),
        deviation: variance.map(f64::sqrt),
        residuals,
        open,
        points: points.len(),
    })
}

/// The lowest and the highest value of points.
#[must_use]
pub fn range(points: &[Point], of: impl Fn(&Point) -> f64) -> [f64; 2] {
    points
        .iter()
        .map(of)
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}
