//! Fits with a law's velocity for each temperature, where the points ask for it.

use crate::model::Param;
use crate::model::friction::LawKind;
use crate::study::fit::fault::FitFault;
use crate::study::fit::information::information;
use crate::study::fit::problem::sum_of_squares;
use crate::study::fit::shape::Shape;
use crate::study::fit::squares::{Fit, Point, together};

/// By so much has the `AICc` to fall before every temperature has a velocity of its own: smaller differences tell nothing.
const TELLS: f64 = 2.0;

/// Fits `law` with rows at `temperatures` (°C, rising; points outside count to the nearest row) and the law's velocity
/// (`knee_velocity` or `stribeck_velocity`, m/s). `None`: it is found, one for all temperatures; where the points lie at the
/// temperatures of the rows and one does not describe them, one for each.
///
/// # Errors
/// When the points do not determine the material.
pub fn fit(
    points: &[Point],
    law: LawKind,
    temperatures: &[f64],
    velocity: Option<f64>,
) -> Result<Fit, FitFault> {
    let one = together(points, law, temperatures, velocity)?;
    let several =
        temperatures.len() > 1 && velocity.is_none() && matches!(Shape::of(law), Shape::Falling(..));
    let each = if several { each_alone(points, law, temperatures) } else { None };
    let aicc = |of: &Fit| criteria(of, false).map_or(f64::INFINITY, |[aicc, _]| aicc);
    Ok(each.filter(|each| aicc(each) + TELLS < aicc(&one)).unwrap_or(one))
}

/// The law's velocity, where every temperature has its own.
pub(super) fn own_velocity(fit: &Fit) -> Option<Param> {
    let Shape::Falling(_, velocity) = Shape::of(fit.law) else { return None };
    let (_, values) = fit.columns.iter().find(|(param, _)| *param == velocity)?;
    values.windows(2).any(|pair| pair[0].total_cmp(&pair[1]).is_ne()).then_some(velocity)
}

/// The fits of every temperature alone as one; `None` where points lie between the rows, or do not determine one of them.
fn each_alone(points: &[Point], law: LawKind, temperatures: &[f64]) -> Option<Fit> {
    let row = |point: &Point| {
        let last = temperatures.len() - 1;
        let inside = point.temperature.clamp(temperatures[0], temperatures[last]);
        temperatures.iter().position(|temperature| temperature.total_cmp(&inside).is_eq())
    };
    let rows: Vec<usize> = points.iter().map(row).collect::<Option<_>>()?;
    let mut residuals = vec![0.0; points.len()];
    let mut alone = Vec::with_capacity(temperatures.len());
    for (number, temperature) in temperatures.iter().enumerate() {
        let here: Vec<usize> = (0..points.len()).filter(|place| rows[*place] == number).collect();
        let those: Vec<Point> = here.iter().map(|place| points[*place]).collect();
        let fit = together(&those, law, &[*temperature], None).ok()?;
        if fit.open || fit.errors.iter().any(Option::is_none) {
            return None;
        }
        for (place, residual) in here.iter().zip(&fit.residuals) {
            residuals[*place] = *residual;
        }
        alone.push(fit);
    }
    let params: Vec<Param> = alone[0].columns.iter().map(|(param, _)| *param).collect();
    let column = |k: usize| alone.iter().map(|fit| fit.columns[k].1[0]).collect();
    let errors = |k: usize| alone.iter().map(|fit| fit.errors[k].as_ref().map(|errors| errors[0])).collect();
    let squares = sum_of_squares(&residuals);
    let free = points.len().checked_sub(params.len() * temperatures.len()).filter(|free| *free > 0)?;
    Some(Fit {
        law,
        temperature: temperatures.to_vec(),
        columns: params.iter().enumerate().map(|(k, param)| (*param, column(k))).collect(),
        errors: (0..params.len()).map(errors).collect(),
        residual: (squares / points.len() as f64).sqrt(),
        deviation: Some((squares / free as f64).sqrt()),
        residuals,
        open: false,
        points: points.len(),
    })
}

/// How many values a fit has whose velocity was `given`, or found.
fn values(fit: &Fit, given: bool) -> usize {
    let (rows, own) = (fit.temperature.len(), own_velocity(fit).is_some());
    let of = |(param, _): &(Param, Vec<f64>)| match Shape::of(fit.law) {
        Shape::Falling(_, velocity) if *param == velocity && !own => usize::from(!given),
        _ => rows,
    };
    fit.columns.iter().map(of).sum()
}

/// `AICc` and `BIC` of a fit whose velocity was `given`, or found.
pub(super) fn criteria(fit: &Fit, given: bool) -> Option<[f64; 2]> {
    information(fit.points, values(fit, given), fit.points as f64 * fit.residual * fit.residual)
}
