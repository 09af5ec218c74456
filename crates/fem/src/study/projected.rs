//! From a study to its projected problem: which vectors are taken.

use faer::Mat;

use super::Study;
use super::modal::{Contact, MOST, Modal, directions};
use super::space::{MORE, ROUNDS, spread_over};
use crate::Error;
use crate::assembly::{Model, Numbering, Pencil, Rows, assemble};
use crate::modes::{Basis, Factor, Ordering, Pair, Small, lowest, pairs, refine};

/// What has been computed of a study.
pub(super) struct Projected<'a> {
    pub(super) study: &'a Study,
    /// With the points that stay closed.
    pub(super) model: &'a Model,
    pub(super) pencil: &'a Pencil,
    pub(super) basis: &'a Basis,
    /// The damping by the study's slope of friction, and by one of 1 s/m.
    pub(super) slope: &'a Rows,
    pub(super) per_slope: &'a Rows,
    /// Of the lowest modes.
    pub(super) count: usize,
    /// N.
    pub(super) load: f64,
}

/// Values of the contact stiffness at which vectors are taken, in equal ratios.
const STIFFNESSES: i32 = 7;
/// Directions that each of them gives at most.
const EACH: usize = 40;

impl Projected<'_> {
    /// The problem on the space of the lowest modes at all coefficients of friction, and all contact stiffnesses that are asked for.
    pub(super) fn modal(&self) -> Result<Modal, Error> {
        let output = &self.study.document.output;
        let most = output.vectors.unwrap_or(MOST);
        let kn0 = self.study.document.friction.contact_stiffness;
        let (Some(range), Some(kn0)) = (output.kn, kn0) else {
            let mut all = Vec::new();
            for mu in &self.study.mus {
                all.extend(self.lowest(&self.basis.at(*mu, self.slope))?);
            }
            return self.within(self.basis, &all, most, None);
        };
        let mut basis = self.basis.clone();
        let ratio = range[1] / range[0];
        let values: Vec<f64> = (0..STIFFNESSES)
            .map(|i| range[0] * ratio.powf(f64::from(i) / f64::from(STIFFNESSES - 1)))
            .collect();
        for kn in &values {
            basis.extend(self.pencil, &self.vectors(*kn)?);
        }
        let per_stiffness = self.per_stiffness(&basis, kn0)?;
        let mut all = Vec::new();
        for kn in &values {
            for mu in spread_over(&self.study.mus) {
                let mut small = basis.at(mu, self.slope);
                small.stiffness += faer::Scale(kn - kn0) * &per_stiffness
                    + faer::Scale(mu * (kn / kn0 - 1.0)) * basis.per_friction().0;
                all.extend(self.lowest(&small)?);
            }
        }
        self.within(&basis, &all, most, Some(Contact { stiffness: kn0, range, per_stiffness }))
    }

    fn lowest(&self, small: &Small) -> Result<Vec<Pair>, Error> {
        let mut found = pairs(small)?;
        found.truncate(self.count);
        Ok(found)
    }

    /// The problem in the coordinates that hold these pairs best.
    fn within(
        &self,
        basis: &Basis,
        all: &[Pair],
        most: usize,
        contact: Option<Contact>,
    ) -> Result<Modal, Error> {
        let coordinates = directions(&all.iter().collect::<Vec<_>>(), most)?;
        let (symmetric, friction, slope) = basis.within(&coordinates, self.per_slope);
        let contact = contact.map(|contact| {
            let matrix = coordinates.transpose() * &contact.per_stiffness * &coordinates;
            Contact { per_stiffness: both(&matrix), ..contact }
        });
        let (mus, title) = (&self.study.mus, self.study.document.title.clone());
        let mu = [mus[0], mus[mus.len() - 1]];
        // No more modes than vectors.
        let (modes, load) = (self.count.min(coordinates.ncols()), self.load);
        Ok(Modal { title, mu, modes, symmetric, friction, slope, load, wedge: 0.0, contact })
    }

    /// The matrices with another contact stiffness.
    fn stiffened(&self, kn: f64) -> Result<(Numbering, Pencil), Error> {
        let mut model = self.model.clone();
        if let Some(penalty) = &mut model.penalty {
            penalty.stiffness = kn;
        }
        assemble(&model)
    }

    /// Vectors that hold the lowest modes with another contact stiffness.
    fn vectors(&self, kn: f64) -> Result<Mat<f64>, Error> {
        let (numbering, pencil) = self.stiffened(kn)?;
        let ordering = Ordering::best(&pencil.stiffness.pattern, &numbering.places(&self.study.model.mesh))?;
        let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0)?;
        let real = lowest(&pencil, &factor, (self.count + MORE).min(pencil.size()))?;
        let mut basis = Basis::new(&pencil, &real.shapes);
        let (mus, bound) = (spread_over(&self.study.mus), self.study.document.modes.residual);
        refine(&pencil, &factor, &mut basis, &mus, self.slope, self.count, bound, ROUNDS)?;
        let mut all = Vec::new();
        for mu in mus {
            all.extend(self.lowest(&basis.at(mu, self.slope))?);
        }
        Ok(&basis.vectors * directions(&all.iter().collect::<Vec<_>>(), EACH)?)
    }

    /// What one unit of contact stiffness adds to the stiffness within a space.
    fn per_stiffness(&self, basis: &Basis, kn0: f64) -> Result<Mat<f64>, Error> {
        let twice = Basis::projected_stiffness(&self.stiffened(2.0 * kn0)?.1, &basis.vectors);
        let once = Basis::projected_stiffness(self.pencil, &basis.vectors);
        Ok(both(&(faer::Scale(1.0 / kn0) * (twice - once))))
    }
}

/// Symmetric to the last bit.
fn both(matrix: &Mat<f64>) -> Mat<f64> {
    Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| f64::midpoint(matrix[(i, j)], matrix[(j, i)]))
}
