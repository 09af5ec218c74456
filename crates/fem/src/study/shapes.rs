//! `shapes.vtu`: complex modes and the static step for ParaView.

use super::{Outcome, Study};
use crate::output::{Field, vtu};

/// The mesh with the shapes of the modes (largest component 1) and the displacements of the static step (m).
#[must_use]
pub fn shapes(study: &Study, outcome: &Outcome) -> Vec<u8> {
    let modes = outcome.shapes.iter().map(|shape| {
        let name = format!(
            "mode {} at mu {}, {:.1} Hz, {:.1} 1/s",
            shape.mode + 1,
            shape.mu,
            shape.lambda.im / std::f64::consts::TAU,
            // Zero without a sign.
            shape.lambda.re + 0.0
        );
        (name, Field::Complex(shape.displacement.clone()))
    });
    let pressed = outcome
        .pressed
        .iter()
        .map(|pressed| ("static displacement".to_owned(), Field::Real(pressed.displacement.clone())));
    let all: Vec<(String, Field)> = pressed.chain(modes).collect();
    let named: Vec<(&str, Field)> = all.iter().map(|(name, field)| (name.as_str(), field.clone())).collect();
    vtu(&study.model.mesh, &named).into_bytes()
}
