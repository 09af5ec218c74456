//! The models whose eigenvalues are known, and how numbers are compared.

pub(crate) mod apart;
pub(crate) mod brake;
pub(crate) mod layer;
pub(crate) mod pin;
pub(crate) mod plane_waves;

use squealmap_fem::material::Material;
use squealmap_fem::study::document::Document;
use squealmap_fem::study::{Outcome, Study, compute};

/// E = 210 GPa, ν = 0.3, ρ = 7800 kg/m³.
pub(crate) fn steel() -> Material {
    Material::isotropic("steel", 210e9, 0.3, 7800.0).expect("the constants of steel")
}

/// A block in a description, by its origin and size (m).
pub(crate) fn block(
    name: &str,
    element: &str,
    [origin, size]: [[f64; 3]; 2],
    cells: [usize; 3],
    material: &str,
) -> String {
    format!(
        "[parts.{name}]\nkind = \"block\"\nelement = \"{element}\"\norigin = {origin:?}\nsize = {size:?}\ncells = {cells:?}\nmaterial = \"{material}\"\n"
    )
}

/// A support in a description.
pub(crate) fn support(set: &str, axes: &str) -> String {
    format!("[[supports]]\nset = \"{set}\"\naxes = \"{axes}\"\n")
}

/// Two surfaces that slide in a description.
pub(crate) fn slides(slaves: &str, masters: &str, direction: [f64; 3]) -> String {
    format!("[[sliding]]\nslaves = \"{slaves}\"\nmasters = \"{masters}\"\ndirection = {direction:?}\n")
}

/// What a description without files computes.
pub(crate) fn outcome(text: &str) -> Outcome {
    let study =
        Study::new(Document::read(text).expect("a description"), &|path| Err(format!("{path} is no file")));
    compute(&study.expect("a study"), &mut |_| {}).expect("modes")
}
