//! `shapes.vtu`: complex modes and the static step for ParaView.

use super::{Outcome, Shape, Study};
use crate::output::{Field, vtu};

impl Shape {
    /// Its name in the file.
    pub(super) fn name(&self) -> String {
        format!(
            "mode {} at mu {}, {:.1} Hz, {:.1} 1/s",
            self.mode + 1,
            self.mu,
            self.lambda.im / std::f64::consts::TAU,
            // Zero without a sign.
            self.lambda.re + 0.0
        )
    }
}

/// The mesh with the shapes of the modes (largest component 1) and the displacements of the static step (m).
#[must_use]
pub fn shapes(study: &Study, outcome: &Outcome) -> Vec<u8> {
    let modes = outcome.shapes.iter().map(|shape| (shape.name(), Field::Complex(shape.displacement.clone())));
    let pressed = outcome
        .pressed
        .iter()
        .map(|pressed| ("static displacement".to_owned(), Field::Real(pressed.displacement.clone())));
    let all: Vec<(String, Field)> = pressed.chain(modes).collect();
    let named: Vec<(&str, Field)> = all.iter().map(|(name, field)| (name.as_str(), field.clone())).collect();
    vtu(&study.model.mesh, &named).into_bytes()
}
