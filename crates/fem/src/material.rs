//! Elastic constants and density.

use crate::Error;

/// The least density, kg/m³: below are those of files in t/mm³.
const LIGHTEST: f64 = 1e-3;

/// A linear elastic material in the axes of the mesh.
///
/// Strains are ordered xx, yy, zz, xy, yz, zx, shear strains as angles (γ = 2 ε).
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name, for messages.
    pub name: String,
    /// Stress per strain, Pa.
    pub stiffness: [[f64; 6]; 6],
    /// Mass per volume, kg/m³.
    pub density: f64,
    /// Rayleigh damping C = α M + β K: α in 1/s, β in s.
    pub rayleigh: [f64; 2],
}

/// The nine constants of an orthotropic material in the axes of the mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orthotropic {
    /// Young's moduli along x, y, z, Pa.
    pub young: [f64; 3],
    /// Poisson's ratios ν_xy, ν_yz, ν_xz: contraction along the second axis when pulled along the first.
    pub poisson: [f64; 3],
    /// Shear moduli of the planes xy, yz, zx, Pa.
    pub shear: [f64; 3],
}

/// Elastic constants as tables of them have them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Constants {
    /// Young's modulus (Pa) and Poisson's ratio.
    Isotropic(f64, f64),
    /// Those of three axes.
    Orthotropic(Orthotropic),
}

impl Material {
    /// The same in every direction: Young's modulus in Pa, Poisson's ratio, density in kg/m³.
    ///
    /// # Errors
    /// A modulus or a density that is not positive, a Poisson's ratio outside −1 to 0.5.
    pub fn isotropic(name: &str, young: f64, poisson: f64, density: f64) -> Result<Self, Error> {
        if !(poisson > -1.0 && poisson < 0.5) {
            return Err(bad(name, format!("Poisson's ratio is {poisson}, it must lie between -1 and 0.5")));
        }
        let shear = young / (2.0 * (1.0 + poisson));
        let constants = Orthotropic { young: [young; 3], poisson: [poisson; 3], shear: [shear; 3] };
        Self::orthotropic(name, constants, density)
    }

    /// Different along the three axes, as brake linings are.
    ///
    /// # Errors
    /// Moduli or a density that are not positive; ratios for which some strain would give energy back.
    pub fn orthotropic(name: &str, constants: Orthotropic, density: f64) -> Result<Self, Error> {
        /// Pa: the determinant of the compliance, of the order of 1/E³, has to be a number.
        const LEAST: f64 = 1e-100;
        const MOST: f64 = 1e100;
        let Orthotropic { young, poisson, shear } = constants;
        for (value, what) in
            young.iter().map(|e| (*e, "Young's modulus")).chain(shear.map(|g| (g, "a shear modulus")))
        {
            if !(value > 0.0 && value.is_finite()) {
                return Err(bad(name, format!("{what} is {value} Pa, it must be above 0")));
            }
            if !(LEAST..=MOST).contains(&value) {
                let what =
                    format!("{what} is {value:e} Pa, it must be {LEAST:e} to {MOST:e}: check its unit");
                return Err(bad(name, what));
            }
        }
        if !(density >= LIGHTEST && density.is_finite()) {
            return Err(bad(
                name,
                format!(
                    "the density is {density} kg/m3, it must be {LIGHTEST} or more: constants are in SI units (Pa, kg/m3), whatever the unit of \
                     lengths"
                ),
            ));
        }
        let [xy, yz, xz] = poisson;
        let compliance = [
            [1.0 / young[0], -xy / young[0], -xz / young[0]],
            [-xy / young[0], 1.0 / young[1], -yz / young[1]],
            [-xz / young[0], -yz / young[1], 1.0 / young[2]],
        ];
        // Sylvester: a symmetric matrix is positive definite where its leading minors are.
        let minor = compliance[0][0] * compliance[1][1] - compliance[0][1] * compliance[1][0];
        let (inverse, determinant) = inverse3(&compliance);
        if !(minor > 0.0 && determinant > 0.0) {
            return Err(bad(
                name,
                format!("with Poisson's ratios {xy}, {yz}, {xz} some strain would give energy: lower them"),
            ));
        }
        let mut stiffness = [[0.0; 6]; 6];
        for i in 0..3 {
            stiffness[i][..3].copy_from_slice(&inverse[i]);
            stiffness[i + 3][i + 3] = shear[i];
        }
        Ok(Self { name: name.to_owned(), stiffness, density, rayleigh: [0.0; 2] })
    }

    /// At a temperature (°C) by a table of rising temperatures: each constant on the straight line between two rows, that of the first or
    /// last row outside.
    ///
    /// # Errors
    /// A table without rows, temperatures that do not rise, isotropic and orthotropic rows in one table, constants of no stable solid.
    pub fn at(name: &str, celsius: f64, table: &[(f64, Constants)], density: f64) -> Result<Self, Error> {
        if let Some(rows) = table.windows(2).find(|rows| !(rows[1].0 > rows[0].0)) {
            let what =
                format!("{} °C follows {} °C: temperatures of a table must rise", rows[1].0, rows[0].0);
            return Err(bad(name, what));
        }
        let [Some(first), Some(last)] = [table.first(), table.last()] else {
            return Err(bad(name, "the table has no row, it needs at least 1".to_owned()));
        };
        let at = celsius.clamp(first.0, last.0);
        let above = table.partition_point(|row| row.0 < at);
        let (low, high) = (&table[above.saturating_sub(1)], &table[above]);
        let part = if high.0 > low.0 { (at - low.0) / (high.0 - low.0) } else { 0.0 };
        let between = |a: f64, b: f64| a + part * (b - a);
        let each = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i| between(a[i], b[i]));
        match (low.1, high.1) {
            (Constants::Isotropic(young, poisson), Constants::Isotropic(other, ratio)) => {
                Self::isotropic(name, between(young, other), between(poisson, ratio), density)
            }
            (Constants::Orthotropic(a), Constants::Orthotropic(b)) => {
                let constants = Orthotropic {
                    young: each(a.young, b.young),
                    poisson: each(a.poisson, b.poisson),
                    shear: each(a.shear, b.shear),
                };
                Self::orthotropic(name, constants, density)
            }
            _ => Err(bad(name, "a table has isotropic and orthotropic rows: use one kind".to_owned())),
        }
    }

    /// The same material with Rayleigh damping: α in 1/s, β in s.
    #[must_use]
    pub fn damped(mut self, alpha: f64, beta: f64) -> Self {
        self.rayleigh = [alpha, beta];
        self
    }
}

fn bad(name: &str, what: String) -> Error {
    Error::Material { name: name.to_owned(), what }
}

/// Inverse and determinant of a 3 × 3 matrix, by cofactors.
pub(crate) fn inverse3(a: &[[f64; 3]; 3]) -> ([[f64; 3]; 3], f64) {
    let mut inverse = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            let (r1, r2, c1, c2) = ((j + 1) % 3, (j + 2) % 3, (i + 1) % 3, (i + 2) % 3);
            inverse[i][j] = a[r1][c1] * a[r2][c2] - a[r1][c2] * a[r2][c1];
        }
    }
    let determinant = a[0][0] * inverse[0][0] + a[0][1] * inverse[1][0] + a[0][2] * inverse[2][0];
    (inverse.map(|row| row.map(|cofactor| cofactor / determinant)), determinant)
}
