//! Where two modes become one, and where a damped mode begins to grow: by Newton's method on a bordered matrix.
//!
//! With B = [P b; cᵀ 0], B [x; g] = [0; 1] and Bᵀ [y; g] = [0; 1], the scalar g vanishes where P is singular, and for every
//! parameter p of P: g_p = −yᵀ P_p x (Griewank and Reddien, Characterization and computation of generalized turning points,
//! SIAM J. Numer. Anal. 21, 1984). Two eigenvalues θ coalesce where g = 0 and g_θ = 0.

use faer::linalg::solvers::Solve;
use faer::{Mat, c64};

use super::{Basis, Factor, Pair, dense};
use crate::Error;
use crate::assembly::{Pencil, Rows};

/// Two undamped modes that have become one.
#[derive(Debug, Clone)]
pub struct Coalescence {
    /// The coefficient of friction μ_c.
    pub mu: f64,
    /// ω² of both, 1/s².
    pub omega2: f64,
    /// How far the last step of Newton moved μ.
    pub step: f64,
    /// Number of steps.
    pub steps: usize,
    /// Right and left vector in the coordinates of the basis.
    pub vectors: [Vec<f64>; 2],
}

impl Coalescence {
    /// Frequency of both modes, Hz.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        self.omega2.max(0.0).sqrt() / std::f64::consts::TAU
    }
}

/// The last step of Newton may be this large: far below what is asked for, far above rounding.
const STEP: f64 = 1e-10;
/// Newton doubles the digits each time, from one digit on; more than this is no convergence.
const STEPS: usize = 40;

/// Finds where two undamped modes of the projected problem coalesce, from a coefficient of friction near it and a pair near the
/// coalescence.
///
/// # Errors
/// Where Newton's method does not converge.
pub fn coalescence_small(basis: &Basis, mu: f64, pair: &Pair) -> Result<Coalescence, Error> {
    let size = basis.vectors.ncols();
    let (friction_k, friction_m) = basis.per_friction();
    // θ in units of its guess, so that both unknowns are of size 1.
    let unit = -(pair.lambda * pair.lambda).re;
    let (mut theta, mut mu) = (1.0, mu);
    let mut border = [real_part(&pair.vector), real_part(&pair.vector)];
    for steps in 1..=STEPS {
        let small = basis.at(mu, &Rows::default());
        let (k, m) = (&small.stiffness, &small.mass);
        let p = Mat::from_fn(size, size, |i, j| k[(i, j)] / unit - theta * m[(i, j)]);
        let p_mu = Mat::from_fn(size, size, |i, j| friction_k[(i, j)] / unit - theta * friction_m[(i, j)]);
        let p_theta = Mat::from_fn(size, size, |i, j| -m[(i, j)]);
        let p_theta_mu = Mat::from_fn(size, size, |i, j| -friction_m[(i, j)]);
        let scale = p.norm_max();
        let bordered = |transposed: bool| {
            Mat::from_fn(size + 1, size + 1, |i, j| match (i < size, j < size) {
                (true, true) if transposed => p[(j, i)],
                (true, true) => p[(i, j)],
                (true, false) => scale * border[usize::from(!transposed)][i],
                (false, true) => scale * border[usize::from(transposed)][j],
                (false, false) => 0.0,
            })
        };
        let (right, left) = (bordered(false).partial_piv_lu(), bordered(true).partial_piv_lu());
        let solve = |lu: &faer::linalg::solvers::PartialPivLu<f64>, top: Option<Mat<f64>>| {
            let mut b = Mat::zeros(size + 1, 1);
            match top {
                Some(top) => (0..size).for_each(|i| b[(i, 0)] = -top[(i, 0)]),
                None => b[(size, 0)] = scale,
            }
            let solution = lu.solve(&b);
            (solution.subrows(0, size).to_owned(), solution[(size, 0)])
        };
        let ((x, g), (y, _)) = (solve(&right, None), solve(&left, None));
        let form = |a: &Mat<f64>, p: &Mat<f64>, b: &Mat<f64>| (a.transpose() * (p * b))[(0, 0)];
        let (g_theta, g_mu) = (-form(&y, &p_theta, &x), -form(&y, &p_mu, &x));
        let second = |p_q: &Mat<f64>, p_theta_q: Option<&Mat<f64>>| {
            let x_q = solve(&right, Some(p_q * &x)).0;
            let y_q = solve(&left, Some(p_q.transpose() * &y)).0;
            let mixed = p_theta_q.map_or(0.0, |p| form(&y, p, &x));
            -(form(&y_q, &p_theta, &x) + mixed + form(&y, &p_theta, &x_q))
        };
        let (g_theta_theta, g_theta_mu) = (second(&p_theta, None), second(&p_mu, Some(&p_theta_mu)));
        // [g_θ g_μ; g_θθ g_θμ] [dθ; dμ] = −[g; g_θ], where the border is scaled, and g with it.
        let determinant = g_theta * g_theta_mu - g_mu * g_theta_theta;
        let d_theta = (-g * scale * g_theta_mu + g_theta * g_mu) / determinant;
        let d_mu = (-g_theta * g_theta + g_theta_theta * g * scale) / determinant;
        theta += d_theta;
        mu += d_mu;
        if !(theta.is_finite() && mu.is_finite()) {
            break;
        }
        border = [normed(&x), normed(&y)];
        if d_mu.abs() <= STEP && d_theta.abs() <= STEP {
            return Ok(Coalescence { mu, omega2: theta * unit, step: d_mu.abs(), steps, vectors: border });
        }
    }
    let what = format!(
        "no coalescence was found near mu = {mu:.6} and {:.1} Hz: start nearer to it",
        pair.frequency()
    );
    Err(Error::Solver { what })
}

/// The same on the full problem: the basis takes in what the right and the left vector lack, until μ_c stands still.
///
/// # Errors
/// Where Newton's method does not converge, or μ_c does not stand still.
pub fn coalescence(
    pencil: &Pencil,
    factor: &Factor,
    basis: &mut Basis,
    mu: f64,
    pair: &Pair,
) -> Result<Coalescence, Error> {
    /// μ_c is asked for to 1e-6; the space is good enough when it moves by less than this.
    const STILL: f64 = 1e-9;
    const ROUNDS: usize = 40;
    let mut found = coalescence_small(basis, mu, pair)?;
    for _ in 0..ROUNDS {
        let size = pencil.size();
        let sides = Mat::from_fn(basis.vectors.ncols(), 2, |i, j| found.vectors[j][i]);
        let lifted = &basis.vectors * sides;
        let [x, y] = [0, 1].map(|j| super::columns::column(&lifted, j));
        let minus = |a: Vec<f64>, b: Vec<f64>| -> Vec<f64> {
            a.into_iter().zip(b).map(|(a, b)| a - found.omega2 * b).collect()
        };
        let right = minus(pencil.stiffness_times(found.mu, &x), pencil.mass_times(found.mu, &x));
        // Pᵀ y = (K − θ M) y + μ (K_n − θ M_n)ᵀ S y.
        let mut left = minus(pencil.stiffness.times(&y), pencil.mass.times(&y));
        let slip: Vec<f64> = pencil.slip.times(&y).iter().map(|s| found.mu * s).collect();
        let mut normal = [vec![0.0; size], vec![0.0; size]];
        pencil.normal_stiffness.add_transposed(&slip, &mut normal[0]);
        pencil.normal_mass.add_transposed(&slip, &mut normal[1]);
        let [normal_k, normal_m] = normal;
        left.iter_mut().zip(minus(normal_k, normal_m)).for_each(|(l, n)| *l += n);
        let mut corrections = Mat::from_fn(size, 2, |i, j| if j == 0 { right[i] } else { left[i] });
        factor.solve(corrections.as_mut());
        let old = basis.vectors.ncols();
        if basis.extend(pencil, &corrections) == 0 {
            return Ok(found);
        }
        let widened = |v: &Vec<f64>| {
            let mut v: Vec<c64> = v.iter().map(|x| c64::new(*x, 0.0)).collect();
            v.resize(v.len() + basis.vectors.ncols() - old, c64::new(0.0, 0.0));
            v
        };
        let start = Pair { lambda: c64::new(0.0, found.omega2.sqrt()), vector: widened(&found.vectors[0]) };
        let next = coalescence_small(basis, found.mu, &start)?;
        let moved = (next.mu - found.mu).abs();
        found = next;
        if moved <= STILL {
            return Ok(found);
        }
    }
    let what = format!(
        "the coalescence near mu = {} did not stand still within {ROUNDS} rounds: use more real modes",
        found.mu
    );
    Err(Error::Solver { what })
}

/// The first value of μ among rising ones at which some pair below a frequency (Hz) grows faster than `growth` (1/s), by its index,
/// and that pair; `None` where all are stable.
///
/// # Errors
/// Where the eigenvalues do not converge.
pub fn first_unstable(
    basis: &Basis,
    mus: &[f64],
    slope: &Rows,
    below: f64,
    growth: f64,
) -> Result<Option<(usize, Pair)>, Error> {
    for (i, mu) in mus.iter().enumerate() {
        let pairs = dense::pairs(&basis.at(*mu, slope))?;
        if let Some(pair) = pairs.into_iter().find(|p| p.frequency() <= below && p.growth() > growth) {
            return Ok(Some((i, pair)));
        }
    }
    Ok(None)
}

fn real_part(vector: &[c64]) -> Vec<f64> {
    // A complex vector is free up to a factor: turn its largest entry to the real axis.
    let largest =
        vector.iter().copied().max_by(|a, b| a.norm().total_cmp(&b.norm())).unwrap_or(c64::new(1.0, 0.0));
    let turned: Vec<f64> = vector.iter().map(|x| (x / largest).re).collect();
    let norm = turned.iter().map(|x| x * x).sum::<f64>().sqrt();
    turned.iter().map(|x| x / norm).collect()
}

fn normed(vector: &Mat<f64>) -> Vec<f64> {
    let norm = vector.norm_l2();
    (0..vector.nrows()).map(|i| vector[(i, 0)] / norm).collect()
}
