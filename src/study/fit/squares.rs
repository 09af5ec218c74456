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

use nalgebra::{DMatrix, DVector};

use crate::model::Param;
use crate::model::friction::LawKind;
use crate::study::fit::errors;
pub use squealmap_identify::Point;

/// Condition of the normal equations above which a row of the material is not determined by the data.
pub(super) const DETERMINED: f64 = 1e-9;
/// Values of the law's velocity that are tried before the best one is refined, even in the logarithm.
const TRIALS: usize = 40;
/// Refinements by the golden section: to 1e-7 of the interval.
const REFINEMENTS: usize = 34;

/// A fitted material.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The law.
    pub law: LawKind,
    /// Rising temperatures of the rows, °C.
    pub temperature: Vec<f64>,
    /// The columns of the material: a parameter with its value in every row.
    pub columns: Vec<(Param, Vec<f64>)>,
    /// Standard errors of the columns, in their order: for independent errors of friction that are alike at all points.
    /// `None` for a velocity that was given, and for all columns where the points do not tell ([`Fit::open`], or as many values as points).
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

/// Why there is no fit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitFault {
    /// Fewer points than unknowns.
    #[error(
        "{points} point(s) do not determine {unknowns} value(s); measure more, or ask for fewer rows with --temperatures"
    )]
    TooFew {
        /// Points.
        points: usize,
        /// Values to find.
        unknowns: usize,
    },
    /// Rows that do not rise.
    #[error(
        "the temperatures of the rows are {first} and then {second} °C but must rise; sort --temperatures"
    )]
    NotRising {
        /// One temperature, °C.
        first: f64,
        /// The next, °C.
        second: f64,
    },
    /// Points that do not tell the parameters apart.
    #[error(
        "the points near {temperature} °C do not determine `{param}`: they cover velocities from {low} to {high} m/s; measure more velocities there, choose --law constant, or other --temperatures"
    )]
    Undetermined {
        /// The row, °C.
        temperature: f64,
        /// The parameter.
        param: &'static str,
        /// Lowest velocity near it, m/s.
        low: f64,
        /// Highest velocity near it, m/s.
        high: f64,
    },
    /// A law that cannot be fitted this way.
    #[error(
        "the law `{law}` is not linear in its coefficients; choose bilinear, exponential or constant with --law"
    )]
    Law {
        /// Its name.
        law: &'static str,
    },
    /// A negative friction coefficient.
    #[error(
        "`{param}` would be {value:.4} at {temperature} °C, but friction coefficients are not negative; choose another law, or other --temperatures"
    )]
    Negative {
        /// The parameter.
        param: &'static str,
        /// Its value.
        value: f64,
        /// The row, °C.
        temperature: f64,
    },
}

/// Fits `law` with rows at `temperatures` (°C, rising; points outside count to the nearest row) and the law's velocity
/// (`knee_velocity` or `stribeck_velocity`, m/s; `None`: found).
///
/// # Errors
/// When the points do not determine the material.
pub fn fit(
    points: &[Point],
    law: LawKind,
    temperatures: &[f64],
    velocity: Option<f64>,
) -> Result<Fit, FitFault> {
    let params: &[Param] = match law {
        LawKind::Constant => &[Param::MuD],
        LawKind::Bilinear | LawKind::Exponential => &[Param::MuS, Param::MuD],
        LawKind::Rational | LawKind::Table => return Err(FitFault::Law { law: law.name() }),
    };
    if let Some(pair) = temperatures.windows(2).find(|pair| pair[0] >= pair[1]) {
        return Err(FitFault::NotRising { first: pair[0], second: pair[1] });
    }
    let unknowns = params.len() * temperatures.len();
    if points.len() < unknowns || unknowns == 0 {
        return Err(FitFault::TooFew { points: points.len(), unknowns });
    }
    let problem = Problem { points, law, temperatures, params };
    let fastest = points.iter().map(|point| point.velocity.abs()).fold(0.0, f64::max);
    let (velocity, is_found) = match (law, velocity) {
        (LawKind::Constant, _) => (1.0, false),
        (_, Some(velocity)) => (velocity, false),
        (_, None) => (problem.best_velocity(fastest), true),
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
    let constant = match law {
        LawKind::Bilinear => Some(Param::KneeVelocity),
        LawKind::Exponential => Some(Param::StribeckVelocity),
        _ => None,
    };
    if let Some(param) = constant {
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

fn sum_of_squares(residuals: &[f64]) -> f64 {
    residuals.iter().map(|residual| residual * residual).sum()
}

/// A fit with its law's velocity open.
pub(super) struct Problem<'a> {
    pub(super) points: &'a [Point],
    pub(super) law: LawKind,
    temperatures: &'a [f64],
    params: &'a [Param],
}

impl Problem<'_> {
    /// The parts of `μ_s` and `μ_d` (or of `μ_d` alone) at a velocity.
    fn parts(&self, speed: f64, velocity: f64) -> [f64; 2] {
        let w = match self.law {
            LawKind::Bilinear => (speed / velocity).min(1.0),
            LawKind::Exponential => 1.0 - (-speed / velocity).exp(),
            _ => return [1.0, 0.0],
        };
        [1.0 - w, w]
    }

    /// The rows on either side of a temperature with their shares.
    pub(super) fn rows(&self, temperature: f64) -> [(usize, f64); 2] {
        let upper =
            self.temperatures.partition_point(|&row| row < temperature).min(self.temperatures.len() - 1);
        let lower = upper.saturating_sub(1);
        let (t0, t1) = (self.temperatures[lower], self.temperatures[upper]);
        let part = if t1 > t0 { ((temperature - t0) / (t1 - t0)).clamp(0.0, 1.0) } else { 1.0 };
        [(lower, 1.0 - part), (upper, part)]
    }

    /// What each value of the rows counts for in the friction of a point; those that count for something.
    pub(super) fn weights(&self, point: &Point, velocity: f64) -> Vec<(usize, f64)> {
        let kinds = self.params.len();
        let parts = self.parts(point.velocity.abs(), velocity);
        let rows = self.rows(point.temperature);
        rows.into_iter()
            .flat_map(|(row, share)| (0..kinds).map(move |k| (row * kinds + k, share * parts[k])))
            .filter(|(_, weight)| *weight != 0.0)
            .collect()
    }

    /// Measured less fitted friction of every point.
    fn residuals(&self, solution: &DVector<f64>, velocity: f64) -> Vec<f64> {
        let fitted = |point: &Point| -> f64 {
            self.weights(point, velocity).iter().map(|(i, weight)| weight * solution[*i]).sum()
        };
        self.points.iter().map(|point| point.friction - fitted(point)).collect()
    }

    /// Whether the points bound the law's velocity: whether the one of the fastest point fits them worse than the best one
    /// (with a sum of `squares`) by more than errors of this variance make likely.
    fn bounds(&self, fastest: f64, squares: f64, variance: f64) -> bool {
        /// Two standard deviations: the sum of squares rises by their square times the variance.
        const LIKELY: f64 = 4.0;
        self.squares(fastest) - squares > LIKELY * variance
    }

    /// The sum of squares that a velocity leaves; infinite where the points do not determine the values.
    fn squares(&self, velocity: f64) -> f64 {
        self.solve(velocity)
            .map_or(f64::INFINITY, |solution| sum_of_squares(&self.residuals(&solution, velocity)))
    }

    /// Values of all rows.
    fn solve(&self, velocity: f64) -> Result<DVector<f64>, FitFault> {
        let unknowns = self.params.len() * self.temperatures.len();
        let mut normal = DMatrix::<f64>::zeros(unknowns, unknowns);
        let mut right = DVector::<f64>::zeros(unknowns);
        for point in self.points {
            let weights = self.weights(point, velocity);
            for &(i, a) in &weights {
                right[i] += a * point.friction;
                for &(j, b) in &weights {
                    normal[(i, j)] += a * b;
                }
            }
        }
        let eigen = normal.clone().symmetric_eigen();
        let largest = eigen.eigenvalues.max();
        let least = eigen.eigenvalues.imin();
        if eigen.eigenvalues[least].partial_cmp(&(DETERMINED * largest)) != Some(std::cmp::Ordering::Greater)
        {
            return Err(self.undetermined(eigen.eigenvectors.column(least).icamax()));
        }
        let solution = normal.cholesky().map(|factors| factors.solve(&right));
        solution.ok_or_else(|| self.undetermined(0))
    }

    /// The value that the points leave most open.
    fn undetermined(&self, index: usize) -> FitFault {
        let (row, param) = (index / self.params.len(), self.params[index % self.params.len()]);
        let near = self.points.iter().filter(|point| {
            self.rows(point.temperature).into_iter().any(|(near, share)| near == row && share > 0.0)
        });
        let speeds = near.map(|point| point.velocity.abs());
        let (low, high) =
            speeds.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), v| (low.min(v), high.max(v)));
        FitFault::Undetermined {
            temperature: self.temperatures[row],
            param: param.info().name,
            low: if low.is_finite() { low } else { 0.0 },
            high,
        }
    }

    /// The velocity of the law with the least residual, up to the fastest point (m/s).
    fn best_velocity(&self, fastest: f64) -> f64 {
        /// The slowest velocity tried, relative to the fastest point.
        const SLOWEST: f64 = 1e-3;
        /// 1/golden ratio.
        const GOLDEN: f64 = 0.618_033_988_749_894_8;
        let residual = |log: f64| self.squares(log.exp());
        let top = fastest.max(f64::MIN_POSITIVE).ln();
        let step = -SLOWEST.ln() / TRIALS as f64;
        let trials = (0..=TRIALS).map(|k| top - k as f64 * step);
        let best = trials.min_by(|a, b| residual(*a).total_cmp(&residual(*b))).unwrap_or(top);
        let (mut low, mut high) = (best - step, (best + step).min(top));
        for _ in 0..REFINEMENTS {
            let (a, b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
            if residual(a) <= residual(b) { high = b } else { low = a }
        }
        (0.5 * (low + high)).exp()
    }
}
