//! The plane of two undamped modes. It turns slowly with friction, also where the two become one and their shapes change fast.

use faer::c64;

use super::growth::grows;
use crate::modes::Pair;

/// Two orthonormal directions in the coordinates of a basis.
pub(super) struct Plane([Vec<f64>; 2]);

/// Two modes that lie in a plane.
pub(super) enum Two<'a> {
    /// One that grows; the other is its conjugate.
    Grow(&'a Pair),
    /// Each vibrates by itself.
    Apart,
}

impl Plane {
    /// The plane of a mode that grows and its conjugate.
    pub(super) fn of(pair: &Pair) -> Self {
        // Turned so that the real part is the longest one and the imaginary part across it.
        let square: c64 = pair.vector.iter().map(|x| x * x).sum();
        let turn = c64::from_polar(1.0, -0.5 * square.arg());
        let turned: Vec<c64> = pair.vector.iter().map(|x| x * turn).collect();
        Self([unit(turned.iter().map(|x| x.re).collect()), unit(turned.iter().map(|x| x.im).collect())])
    }

    /// Whether a shape lies in it rather than across; directions that a basis has taken in since are across.
    pub(super) fn holds(&self, shape: &[f64]) -> bool {
        let whole: f64 = shape.iter().map(|x| x * x).sum();
        let along = |axis: &Vec<f64>| axis.iter().zip(shape).map(|(a, x)| a * x).sum::<f64>().powi(2);
        self.0.iter().map(along).sum::<f64>() > 0.5 * whole
    }

    /// The part of a shape that lies in it, 0 to 1.
    fn part(&self, vector: &[c64]) -> f64 {
        let along = |axis: &Vec<f64>| axis.iter().zip(vector).map(|(a, x)| x * *a).sum::<c64>().norm_sqr();
        self.0.iter().map(along).sum()
    }

    /// Which two of all modes lie in it, of eigenvalues near `lambda`; `None` without two.
    pub(super) fn two<'a>(&self, all: &'a [Pair], lambda: c64) -> Option<Two<'a>> {
        let worth = |pair: &Pair| {
            // Of an eigenvalue that several modes have, any shapes that span theirs may come out.
            let alike = all.iter().filter(|other| same(other.lambda, pair.lambda));
            let part: f64 = alike.map(|other| self.part(&other.vector)).sum();
            let both = (pair.lambda.norm() + lambda.norm()).max(f64::MIN_POSITIVE);
            part.min(1.0) - (pair.lambda - lambda).norm() / both
        };
        let grown = all.iter().filter(|pair| grows(pair.lambda, false));
        let grown = grown.map(|pair| (2.0 * worth(pair), pair)).max_by(|a, b| a.0.total_cmp(&b.0));
        let still = |pair: &&Pair| !grows(pair.lambda, false) && !grows(-pair.lambda.conj(), false);
        let mut still: Vec<(f64, c64)> =
            all.iter().filter(still).map(|pair| (worth(pair), pair.lambda)).collect();
        still.sort_by(|a, b| b.0.total_cmp(&a.0));
        still.dedup_by(|a, b| same(a.1, b.1));
        let apart = still.first().zip(still.get(1)).map(|(a, b)| a.0 + b.0);
        match (grown, apart) {
            (Some((worth, pair)), apart) if apart.is_none_or(|apart| worth > apart) => Some(Two::Grow(pair)),
            (_, apart) => apart.map(|_| Two::Apart),
        }
    }
}

/// Whether two eigenvalues are one but for rounding.
fn same(a: c64, b: c64) -> bool {
    const ROUNDING: f64 = 1e-7;
    (a - b).norm() <= ROUNDING * a.norm()
}

/// A vector of length 1; one that is next to nothing stays so.
fn unit(mut vector: Vec<f64>) -> Vec<f64> {
    let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
    for x in &mut vector {
        *x /= length;
    }
    vector
}
