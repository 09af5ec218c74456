//! The exact eigenvalues of an elastic layer in plane strain, clamped above, on a rigid plane that it slides along.
//!
//! With e^{ikx} and potentials φ = A cosh py + B sinh(py)/p, ψ = C cosh qy + D sinh(qy)/q, where p² = k² − ω²/c_p² and
//! q² = k² − ω²/c_s²: u = ikφ + ψ', v = φ' − ikψ, τ = G (2ikφ' + (q² + k²) ψ), σ = (λ (p² − k²) + 2 G p²) φ − 2 i G k ψ'.
//! v(0) = 0, τ(0) = μ σ(0), u(h) = v(h) = 0 have a solution where their determinant vanishes.

use faer::c64;

/// Steel, 10 mm thick, a period of 20 mm.
const YOUNG: f64 = 210e9;
const POISSON: f64 = 0.3;
const DENSITY: f64 = 7800.0;
const HEIGHT: f64 = 0.01;
const PERIOD: f64 = 0.02;

/// The determinant as a function of ω², with stresses over G.
fn determinant(waves: f64, mu: f64, omega2: c64) -> c64 {
    let i = c64::new(0.0, 1.0);
    let k = std::f64::consts::TAU * waves / PERIOD;
    let lame_over_g = 2.0 * POISSON / (1.0 - 2.0 * POISSON);
    let g = YOUNG / (2.0 * (1.0 + POISSON));
    let (cs2, cp2) = (g / DENSITY, g * (lame_over_g + 2.0) / DENSITY);
    let (p2, q2) = (k * k - omega2 / cp2, k * k - omega2 / cs2);
    let (p, q) = (p2.sqrt(), q2.sqrt());
    let (cp, sp) = ((p * HEIGHT).cosh(), (p * HEIGHT).sinh() / p);
    let (cq, sq) = ((q * HEIGHT).cosh(), (q * HEIGHT).sinh() / q);
    let (zero, one) = (c64::new(0.0, 0.0), c64::new(1.0, 0.0));
    let normal = lame_over_g * (p2 - k * k) + 2.0 * p2;
    let rows = [
        [zero, one, -i * k, zero],
        [-mu * normal, 2.0 * i * k, q2 + k * k, mu * 2.0 * i * k],
        [i * k * cp, i * k * sp, q2 * sq, cq],
        [p2 * sp, cp, -i * k * cq, -i * k * sq],
    ];
    determinant_of(&rows.map(|row| row.to_vec()))
}

/// By Laplace's expansion.
fn determinant_of(rows: &[Vec<c64>]) -> c64 {
    if rows.len() == 1 {
        return rows[0][0];
    }
    let mut sum = c64::new(0.0, 0.0);
    for column in 0..rows.len() {
        let minor: Vec<Vec<c64>> = rows[1..]
            .iter()
            .map(|row| row.iter().enumerate().filter(|(j, _)| *j != column).map(|(_, x)| *x).collect())
            .collect();
        let sign = if column % 2 == 0 { 1.0 } else { -1.0 };
        sum += sign * rows[0][column] * determinant_of(&minor);
    }
    sum
}

/// A root ω² by the secant method, from a start near it.
fn root(waves: f64, mu: f64, start: c64) -> c64 {
    let (mut a, mut b) = (start * 1.0001, start);
    let mut fa = determinant(waves, mu, a);
    for _ in 0..200 {
        let fb = determinant(waves, mu, b);
        let step = fb * (b - a) / (fb - fa);
        if step.norm() <= 1e-14 * b.norm() {
            break;
        }
        (a, fa) = (b, fb);
        b -= step;
    }
    b
}

/// Followed from μ = 0 and the n-th root there to a friction; λ with the growth of the pair that grows.
fn followed(waves: f64, start_hz: f64, mu: f64) -> c64 {
    const STEPS: i32 = 200;
    let omega = std::f64::consts::TAU * start_hz;
    // Off the real axis, so that two real roots can part into the complex plane.
    let mut omega2 = c64::new(omega * omega, 0.0);
    for step in 0..=STEPS {
        omega2 = root(waves, mu * f64::from(step) / f64::from(STEPS), omega2);
    }
    let omega = omega2.sqrt();
    c64::new(omega.im.abs(), omega.re)
}

/// λ of the roots that belong to real frequencies at μ = 0 found by signs of the determinant up to a frequency (Hz).
pub(crate) fn exact(waves: u8, mu: f64, up_to_hz: f64) -> Vec<c64> {
    let waves = f64::from(waves);
    let at = |hz: f64| {
        let omega = std::f64::consts::TAU * hz;
        determinant(waves, 0.0, c64::new(omega * omega, 0.0))
    };
    let mut found = Vec::new();
    // Fine enough for every root below 1 MHz: they are tens of kHz apart.
    let step = 500.3;
    let mut hz = 1000.0;
    // The determinant at μ = 0 is real or imaginary as a whole.
    let part = |z: c64| if z.re.abs() > z.im.abs() { z.re } else { z.im };
    while hz < up_to_hz {
        let (a, b) = (part(at(hz)), part(at(hz + step)));
        if a * b < 0.0 {
            found.push(followed(waves, hz + step * a / (a - b), mu));
        }
        hz += step;
    }
    found
}
