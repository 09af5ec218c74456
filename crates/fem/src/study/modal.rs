//! `modes.toml`: the projected problem as a small model of its own.
//!
//! With x in the coordinates of n vectors, λ² (M + μ M_f) x + λ (C + μ C_f + p μ' D) x + (K + μ K_f) x = 0, where μ' is the slope
//! dμ/dV and p the normal force over that of the study, which is N0/(1 + w μ).

use std::fmt::Write as _;

use faer::{Mat, c64};
use serde::Deserialize;

use crate::Error;
use crate::modes::{Pair, Small};

/// The version of the format.
const VERSION: u32 = 2;
/// No more vectors than this.
pub(super) const MOST: usize = 64;

/// A projected problem.
#[derive(Debug, Clone)]
pub struct Modal {
    /// What stands above figures.
    pub title: String,
    /// First and last coefficient of friction for which the vectors were chosen.
    pub mu: [f64; 2],
    /// Number of the lowest modes for which they were chosen.
    pub modes: usize,
    /// K, M and C.
    pub symmetric: [Mat<f64>; 3],
    /// K_f, M_f and C_f: what one unit of friction adds.
    pub friction: [Mat<f64>; 3],
    /// D: what a slope dμ/dV of 1 s/m adds to C under the load; zero where nothing presses.
    pub slope: Mat<f64>,
    /// N0: the sum of the normal forces without friction, N; 0 where nothing presses.
    pub load: f64,
    /// w: how much friction takes off the normal forces, which are N0/(1 + w μ).
    pub wedge: f64,
    /// The contact stiffness, where the vectors hold for more than one.
    pub contact: Option<Contact>,
}

/// How a projected problem changes with the contact stiffness kn, Pa/m: K + (kn − kn0) `K_c`, and `K_f` kn/kn0.
#[derive(Debug, Clone)]
pub struct Contact {
    /// kn0: that of K and `K_f`.
    pub stiffness: f64,
    /// The least and the largest for which the vectors were chosen.
    pub range: [f64; 2],
    /// `K_c`.
    pub per_stiffness: Mat<f64>,
}

impl Modal {
    /// Number of vectors.
    #[must_use]
    pub fn size(&self) -> usize {
        self.symmetric[0].nrows()
    }

    /// The problem at a coefficient of friction and a slope dμ/dV (s/m), under the load.
    #[must_use]
    pub fn at(&self, mu: f64, slope: f64) -> Small {
        let sum = |i: usize| &self.symmetric[i] + faer::Scale(mu) * &self.friction[i];
        let damping = sum(2) + faer::Scale(slope / (1.0 + self.wedge * mu)) * &self.slope;
        let damped = damping.norm_max() > 0.0;
        Small { stiffness: sum(0), mass: sum(1), damping: damped.then_some(damping) }
    }

    /// The same with another contact stiffness, where the file knows what that changes.
    #[must_use]
    pub fn with_contact(&self, kn: f64) -> Option<Self> {
        let contact = self.contact.as_ref()?;
        let mut other = self.clone();
        other.symmetric[0] += faer::Scale(kn - contact.stiffness) * &contact.per_stiffness;
        other.friction[0] = faer::Scale(kn / contact.stiffness) * &self.friction[0];
        Some(other)
    }

    /// The file.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut text = format!(
            "# A projected problem of finite elements: lambda^2 (mass + mu mass_friction) + lambda (damping + mu damping_friction + slope\n\
             # damping_slope/(1 + wedge mu)) + (stiffness + mu stiffness_friction), in SI units and coordinates in which shapes have a mass\n\
             # of 1 kg; slope is d mu/d velocity, under the load. Matrices that are zero are left out.\n\
             kind = \"modal\"\nversion = {VERSION}\ntitle = {}\nmu = [{:e}, {:e}]\nmodes = {}\nload = {:e}\nwedge = {:e}\n",
            toml::Value::String(self.title.clone()),
            self.mu[0],
            self.mu[1],
            self.modes,
            self.load,
            self.wedge
        );
        if let Some(Contact { stiffness, range: [low, high], .. }) = &self.contact {
            let _ = writeln!(
                text,
                "# With another contact stiffness kn (Pa/m) stiffness gets (kn - contact_stiffness) stiffness_contact, and\n\
                 # stiffness_friction is multiplied by kn/contact_stiffness.\n\
                 contact_stiffness = {stiffness:e}\ncontact_range = [{low:e}, {high:e}]"
            );
        }
        let contact = self.contact.as_ref().map(|contact| (&CONTACT, &contact.per_stiffness));
        let others = NAMES.iter().zip(self.matrices()).filter(|(_, matrix)| matrix.norm_max() > 0.0);
        for (name, matrix) in others.chain(contact) {
            let _ = writeln!(text, "{name} = [");
            for i in 0..matrix.nrows() {
                // The shortest digits that give the same number again.
                let row: Vec<String> = (0..matrix.ncols()).map(|j| format!("{:e}", matrix[(i, j)])).collect();
                let _ = writeln!(text, "    [{}],", row.join(", "));
            }
            text.push_str("]\n");
        }
        text.into_bytes()
    }

    fn matrices(&self) -> [&Mat<f64>; 7] {
        let ([k, m, c], [kf, mf, cf]) = (&self.symmetric, &self.friction);
        [k, m, c, kf, mf, cf, &self.slope]
    }

    /// Reads a file.
    ///
    /// # Errors
    /// What is no TOML or another kind or version of file; matrices that are not square, of different sizes, too large or with entries that
    /// are no finite numbers; a stiffness or mass without friction that is not symmetric, a stiffness with an eigenvalue below 0; a range of
    /// friction that falls, a load below 0, no modes or more than vectors.
    pub fn read(text: &str) -> Result<Self, Error> {
        let file: File = super::document::parsed(text)?;
        if file.kind != "modal" {
            return Err(Error::at(
                "kind",
                format!("\"{}\" is another kind of file, it must be \"modal\"", file.kind),
            ));
        }
        if file.version != VERSION {
            return Err(Error::at(
                "version",
                format!("{} is not known, it must be {VERSION}: write the file again", file.version),
            ));
        }
        let size = file.stiffness.len();
        if size == 0 || size > MOST {
            return Err(Error::at("stiffness", format!("there are {size} rows, it must be 1 to {MOST}")));
        }
        check_numbers(&file, size)?;
        let rows = [
            Some(file.stiffness),
            Some(file.mass),
            file.damping,
            file.stiffness_friction,
            file.mass_friction,
            file.damping_friction,
            file.damping_slope,
        ];
        let mut matrices = Vec::with_capacity(rows.len());
        for (name, rows) in NAMES.iter().zip(rows).chain([(&CONTACT, file.stiffness_contact)]) {
            let Some(rows) = rows else {
                matrices.push(Mat::zeros(size, size));
                continue;
            };
            if let Some(wrong) =
                std::iter::once(rows.len()).chain(rows.iter().map(Vec::len)).find(|n| *n != size)
            {
                let what = format!(
                    "it has a row or column of {wrong} entries, where stiffness has {size}: all are square and as large"
                );
                return Err(Error::at(*name, what));
            }
            if let Some(x) = rows.iter().flatten().find(|x| !x.is_finite()) {
                return Err(Error::at(*name, format!("{x} is no finite number")));
            }
            matrices.push(Mat::from_fn(size, size, |i, j| rows[i][j]));
        }
        let per_stiffness = matrices.pop().unwrap_or_else(|| Mat::zeros(size, size));
        for (name, matrix) in NAMES.iter().zip(&matrices[..3]).chain([(&CONTACT, &per_stiffness)]) {
            let apart = (matrix - matrix.transpose()).norm_max();
            if apart > SYMMETRIC * matrix.norm_max() {
                return Err(Error::at(
                    *name,
                    format!("it differs from its transpose by {apart:e}: without friction it is symmetric"),
                ));
            }
        }
        check_resists(&matrices[0])?;
        let Ok([k, m, c, kf, mf, cf, slope]) = <[Mat<f64>; 7]>::try_from(matrices) else {
            return Err(Error::at("stiffness", "a matrix is missing"));
        };
        let contact = match (file.contact_stiffness, file.contact_range, per_stiffness.norm_max() > 0.0) {
            (Some(stiffness), Some([low, high]), true)
                if stiffness > 0.0 && low > 0.0 && low <= high && stiffness.max(high).is_finite() =>
            {
                Some(Contact { stiffness, range: [low, high], per_stiffness })
            }
            (None, None, false) => None,
            _ => {
                let what = "contact_stiffness, contact_range and stiffness_contact belong together: positive numbers, the range rising, \
                            and a matrix that is not zero, or none of the three";
                return Err(Error::at("contact_stiffness", what));
            }
        };
        let File { title, mu, modes, load, wedge, .. } = file;
        Ok(Self {
            title,
            mu,
            modes,
            symmetric: [k, m, c],
            friction: [kf, mf, cf],
            slope,
            load,
            wedge,
            contact,
        })
    }
}

/// Refuses a load, a number of modes or a range of friction that cannot be.
fn check_numbers(file: &File, size: usize) -> Result<(), Error> {
    if !(file.load >= 0.0 && file.load.is_finite() && file.wedge.is_finite()) {
        let what = format!(
            "the load is {} N and the wedge {}, they must be finite numbers, the load not below 0",
            file.load, file.wedge
        );
        return Err(Error::at("load", what));
    }
    if file.modes == 0 || file.modes > size {
        let what = format!("there are {} modes, it must be 1 to {size}, the rows of stiffness", file.modes);
        return Err(Error::at("modes", what));
    }
    if !(0.0 <= file.mu[0] && file.mu[0] <= file.mu[1] && file.mu[1].is_finite()) {
        let what = format!(
            "the range is {:?}, it must rise from 0 or more: first and last coefficient of friction",
            file.mu
        );
        return Err(Error::at("mu", what));
    }
    Ok(())
}

/// Refuses a stiffness without friction that pushes a motion on.
fn check_resists(stiffness: &Mat<f64>) -> Result<(), Error> {
    /// Of the largest eigenvalue, what rounding makes of a motion without stiffness.
    const NOTHING: f64 = 1e-9;
    let wrong = |what: String| Error::at(NAMES[0], what);
    let values = stiffness.self_adjoint_eigenvalues(faer::Side::Lower);
    let values =
        values.map_err(|_| wrong("its eigenvalues do not converge: write the file again".to_owned()))?;
    let most = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    match values.iter().copied().reduce(f64::min) {
        Some(least) if least < -NOTHING * most => Err(wrong(format!(
            "it has the eigenvalue {least:e}, where none may be below 0: without friction a structure resists every motion"
        ))),
        _ => Ok(()),
    }
}

/// Rounding of a symmetric matrix.
const SYMMETRIC: f64 = 1e-12;

/// The matrices' names, in the order of [`File`].
const NAMES: [&str; 7] = [
    "stiffness",
    "mass",
    "damping",
    "stiffness_friction",
    "mass_friction",
    "damping_friction",
    "damping_slope",
];

/// The name of the matrix of [`Contact`].
const CONTACT: &str = "stiffness_contact";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    kind: String,
    version: u32,
    title: String,
    mu: [f64; 2],
    modes: usize,
    #[serde(default)]
    load: f64,
    #[serde(default)]
    wedge: f64,
    stiffness: Vec<Vec<f64>>,
    mass: Vec<Vec<f64>>,
    damping: Option<Vec<Vec<f64>>>,
    stiffness_friction: Option<Vec<Vec<f64>>>,
    mass_friction: Option<Vec<Vec<f64>>>,
    damping_friction: Option<Vec<Vec<f64>>>,
    damping_slope: Option<Vec<Vec<f64>>>,
    contact_stiffness: Option<f64>,
    contact_range: Option<[f64; 2]>,
    stiffness_contact: Option<Vec<Vec<f64>>>,
}

/// At most `most` directions, orthonormal, that hold vectors best: the first left singular vectors of their real and imaginary parts.
///
/// # Errors
/// Where the singular values do not converge.
pub(super) fn directions(vectors: &[&Pair], most: usize) -> Result<Mat<f64>, Error> {
    /// Directions that hold less of the vectors than this are rounding.
    const NOTHING: f64 = 1e-13;
    let size = vectors.first().map_or(0, |pair| pair.vector.len());
    let parts: [fn(&c64) -> f64; 2] = [|z| z.re, |z| z.im];
    let columns = Mat::from_fn(size, 2 * vectors.len(), |i, j| parts[j % 2](&vectors[j / 2].vector[i]));
    let svd = columns.svd().map_err(|_| Error::Solver {
        what: format!("the singular values of {} shapes did not converge", vectors.len()),
    })?;
    let values = svd.S().column_vector();
    let largest = if values.nrows() > 0 { values[0] } else { 0.0 };
    let kept = values.iter().take(most).filter(|s| **s > NOTHING * largest).count();
    Ok(svd.U().subcols(0, kept).to_owned())
}
