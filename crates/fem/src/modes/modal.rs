//! Damping mode by mode: a damping ratio of each real mode, measured or from the loss factors of the materials.

use faer::Mat;

use super::RealModes;
use super::columns::{column, times};
use crate::Error;
use crate::assembly::{Modal, Model, Numbering, Pencil};

/// Damps the lowest real modes by ratios ζ of the critical damping: C = Σ 2 ζ ω (M φ)(M φ)ᵀ is added. Its forces act on the nodes as
/// inertia does, also on those of the contact. A basis is to be made after this.
///
/// # Errors
/// More ratios than modes; a ratio that is no number.
pub fn damp(pencil: &mut Pencil, modes: &RealModes, ratios: &[f64]) -> Result<(), Error> {
    let count = modes.omega2.len();
    if let Some(ratio) = ratios.iter().find(|ratio| !ratio.is_finite()) {
        return Err(Error::Solver { what: format!("a damping ratio is {ratio}, it must be a number") });
    }
    if ratios.len() > count {
        let what =
            format!("{} damping ratios are given for {count} modes: give as many at most", ratios.len());
        return Err(Error::Solver { what });
    }
    let modal = (0..ratios.len()).map(|k| {
        let shape = column(&modes.shapes, k);
        let factor = 2.0 * ratios[k] * modes.omega2[k].max(0.0).sqrt();
        Modal { factor, image: pencil.mass.times(&shape), normal: pencil.normal_mass.times(&shape) }
    });
    pencil.modal = modal.collect();
    Ok(())
}

/// The damping ratios of real modes by the loss factors η of the materials: half of η, each by its share of the strain energy (the modal
/// strain energy method: Ungar and Kerwin, Loss factors of viscoelastic systems in terms of energy concepts, J. Acoust. Soc. Am. 34, 1962).
///
/// # Errors
/// Not one loss factor for each material; bad elements.
pub fn loss_ratios(
    model: &Model,
    numbering: &Numbering,
    modes: &RealModes,
    loss: &[f64],
) -> Result<Vec<f64>, Error> {
    if loss.len() != model.materials.len() {
        let what = format!(
            "{} loss factors are given for {} materials: give one for each",
            loss.len(),
            model.materials.len()
        );
        return Err(Error::Mesh { what });
    }
    let moved: Vec<Vec<[f64; 3]>> =
        (0..modes.omega2.len()).map(|k| numbering.spread(&column(&modes.shapes, k))).collect();
    let mut sums = vec![[0.0; 2]; moved.len()];
    for (element, kind, material, nodes) in model.mesh.elements() {
        let (matrices, _) = model.element(element, kind, material, nodes)?;
        for (sums, moved) in sums.iter_mut().zip(&moved) {
            let u: Vec<f64> = nodes.iter().flat_map(|node| moved[*node]).collect();
            let energy = |stiffness: &[f64]| -> f64 {
                let rows = stiffness.chunks_exact(u.len()).zip(&u);
                rows.map(|(row, u_i)| u_i * row.iter().zip(&u).map(|(k, u)| k * u).sum::<f64>()).sum()
            };
            sums[0] += loss[material] * energy(matrices.elastic());
            sums[1] += energy(&matrices.stiffness);
        }
    }
    Ok(sums.into_iter().map(|[lost, all]| 0.5 * lost / all).collect())
}

/// C V without friction, `None` where nothing damps.
pub(super) fn damping_columns(pencil: &Pencil, vectors: &Mat<f64>) -> Option<Mat<f64>> {
    if !pencil.is_damped() {
        return None;
    }
    let mut images = match &pencil.damping {
        Some(damping) => times(damping, vectors),
        None => Mat::zeros(vectors.nrows(), vectors.ncols()),
    };
    add(&mut images, pencil, vectors, |modal| &modal.image);
    Some(images)
}

/// Adds what the damped modes make of vectors: along `of` of each mode.
pub(super) fn add(
    images: &mut Mat<f64>,
    pencil: &Pencil,
    vectors: &Mat<f64>,
    of: impl Fn(&Modal) -> &Vec<f64>,
) {
    for modal in &pencil.modal {
        for j in 0..vectors.ncols() {
            let part: f64 = modal.image.iter().zip(vectors.col(j).iter()).map(|(m, v)| m * v).sum();
            images.col_mut(j).iter_mut().zip(of(modal)).for_each(|(y, m)| *y += modal.factor * part * m);
        }
    }
}
