//! The models whose eigenvalues are known, and how numbers are compared.

pub(crate) mod apart;
pub(crate) mod brake;
pub(crate) mod layer;
pub(crate) mod pin;
pub(crate) mod plane_waves;

use squealmap_fem::material::Material;

/// E = 210 GPa, ν = 0.3, ρ = 7800 kg/m³.
pub(crate) fn steel() -> Material {
    Material::isotropic("steel", 210e9, 0.3, 7800.0).expect("the constants of steel")
}
