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

use nalgebra::{DMatrix, DVector};

use crate::model::Param;
use crate::model::friction::LawKind;

/// Condition of the normal equations above which a row of the material is not determined by the data.
const DETERMINED: f64 = 1e-9;
/// Values of the law's velocity that are tried before the best one is refined, even in the logarithm.
const TRIALS: usize = 40;
/// Refinements by the golden section: to 1e-7 of the interval.
const REFINEMENTS: usize = 34;

/// One measured point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Sliding velocity, m/s; its sign does not matter.
    pub velocity: f64,
    /// Friction coefficient.
    pub friction: f64,
    /// Temperature, °C.
    pub temperature: f64,
}

/// A fitted material.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The law.
    pub law: LawKind,
    /// Rising temperatures of the rows, °C.
    pub temperature: Vec<f64>,
    /// The columns of the material: a parameter with its value in every row.
    pub columns: Vec<(Param, Vec<f64>)>,
    /// Root mean square of what the law leaves of the friction coefficients.
    pub residual: f64,
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
    let velocity = match (law, velocity) {
        (LawKind::Constant, _) => 1.0,
        (_, Some(velocity)) => velocity,
        (_, None) => problem.best_velocity(fastest),
    };
    let (solution, residual) = problem.solve(velocity)?;
    let mut columns: Vec<(Param, Vec<f64>)> = Vec::new();
    for (k, param) in params.iter().enumerate() {
        let values: Vec<f64> = (0..temperatures.len()).map(|row| solution[row * params.len() + k]).collect();
        if let Some((row, value)) = values.iter().enumerate().find(|(_, value)| **value < 0.0) {
            let (param, temperature) = (param.info().name, temperatures[row]);
            return Err(FitFault::Negative { param, value: *value, temperature });
        }
        columns.push((*param, values));
    }
    let constant = match law {
        LawKind::Bilinear => Some(Param::KneeVelocity),
        LawKind::Exponential => Some(Param::StribeckVelocity),
        _ => None,
    };
    columns.extend(constant.map(|param| (param, vec![velocity; temperatures.len()])));
    Ok(Fit { law, temperature: temperatures.to_vec(), columns, residual, points: points.len() })
}

/// A fit with its law's velocity open.
struct Problem<'a> {
    points: &'a [Point],
    law: LawKind,
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
    fn rows(&self, temperature: f64) -> [(usize, f64); 2] {
        let upper =
            self.temperatures.partition_point(|&row| row < temperature).min(self.temperatures.len() - 1);
        let lower = upper.saturating_sub(1);
        let (t0, t1) = (self.temperatures[lower], self.temperatures[upper]);
        let part = if t1 > t0 { ((temperature - t0) / (t1 - t0)).clamp(0.0, 1.0) } else { 1.0 };
        [(lower, 1.0 - part), (upper, part)]
    }

    /// Values of all rows and the root mean square residual.
    fn solve(&self, velocity: f64) -> Result<(DVector<f64>, f64), FitFault> {
        let kinds = self.params.len();
        let unknowns = kinds * self.temperatures.len();
        let mut normal = DMatrix::<f64>::zeros(unknowns, unknowns);
        let mut right = DVector::<f64>::zeros(unknowns);
        let weights = |point: &Point| -> Vec<(usize, f64)> {
            let parts = self.parts(point.velocity.abs(), velocity);
            let rows = self.rows(point.temperature);
            rows.into_iter()
                .flat_map(|(row, share)| (0..kinds).map(move |k| (row * kinds + k, share * parts[k])))
                .filter(|(_, weight)| *weight != 0.0)
                .collect()
        };
        for point in self.points {
            let weights = weights(point);
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
        let solution = solution.ok_or_else(|| self.undetermined(0))?;
        let squares: f64 = self
            .points
            .iter()
            .map(|point| {
                let model: f64 = weights(point).iter().map(|(i, a)| a * solution[*i]).sum();
                (model - point.friction).powi(2)
            })
            .sum();
        Ok((solution, (squares / self.points.len() as f64).sqrt()))
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
        let residual = |log: f64| self.solve(log.exp()).map_or(f64::INFINITY, |(_, residual)| residual);
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
