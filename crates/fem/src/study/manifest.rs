//! `manifest.json`: what was computed, from what, and how.

use serde_json::{Value, json};

use super::{COLUMNS, Outcome, Study};

/// The manifest, with the text of the description in it. `program` is the name and version of what computed it.
#[must_use]
pub fn manifest(study: &Study, outcome: &Outcome, description: &str, program: &str) -> Vec<u8> {
    let friction = &study.document.friction;
    let columns: Vec<Value> =
        COLUMNS.iter().map(|c| json!({ "name": c.name, "unit": c.unit, "meaning": c.meaning })).collect();
    let transition = |t: &super::Transition| {
        json!({
            "event": t.event.name(),
            "mu_c": t.mu,
            "frequency": t.frequency,
            "modes": t.modes.iter().map(|m| m + 1).collect::<Vec<_>>(),
        })
    };
    let parts: Vec<Value> = study
        .parts
        .iter()
        .map(|(name, nodes, elements)| json!({ "name": name, "nodes": nodes, "elements": elements }))
        .collect();
    let contact = match friction.contact_stiffness {
        Some(k) => json!({ "kind": "penalty", "contact_stiffness": k, "contact_stiffness_unit": "Pa/m" }),
        None => json!({ "kind": "multipliers", "contact_stiffness": null }),
    };
    let pressed = outcome.pressed.as_ref().map(|pressed| {
        json!({
            "mu": friction.static_mu,
            "normal_force": pressed.force,
            "normal_force_unit": "N",
            "open_points": pressed.open,
        })
    });
    let sliding = study.model.contact.first().map(|point| {
        json!({
            "points": study.model.contact.len(),
            "direction": point.direction,
            "normal": point.normal,
            "turns": study.document.sliding.iter().any(|one| one.axis.is_some()),
        })
    });
    let varied = study.document.vary.as_ref().zip(outcome.variation.as_ref()).map(|(vary, found)| {
        let [quantity, unit] = vary.words();
        json!({
            "parameter": vary.parameter.name(),
            "quantity": quantity,
            "unit": unit,
            "material": vary.material,
            "mu": vary.mu,
            "damped": found.damped,
        })
    });
    let shapes = outcome.shapes.iter().map(|shape| {
        json!({
            "name": shape.name(),
            "mode": shape.mode + 1,
            "mu": shape.mu,
            "angular_frequency": shape.lambda.im,
            "growth_rate": shape.lambda.re + 0.0,
        })
    });
    let seconds: serde_json::Map<String, Value> =
        outcome.seconds.iter().map(|(name, s)| ((*name).to_owned(), json!(s))).collect();
    let remarks: Vec<&String> = study.remarks.iter().chain(&outcome.remarks).collect();
    let document = json!({
        "kind": "fem",
        "program": program,
        "library": concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION")),
        "title": study.document.title,
        "parts": parts,
        "remarks": remarks,
        "unknowns": outcome.unknowns,
        "contact": contact,
        "contact_points": outcome.points,
        "matching": study.matching,
        "sliding": sliding,
        "static_step": pressed,
        "temperature": study.document.temperature,
        "temperature_unit": "°C",
        "stressed": outcome.unstressed.is_some(),
        "real_frequencies_without_stress": outcome.unstressed,
        "damping_ratios": outcome.ratios,
        "varied": varied,
        "slope": friction.slope,
        "slope_unit": "s/m",
        "damped": outcome.damped,
        "mu": { "from": study.mus.first(), "to": study.mus.last(), "values": study.mus.len() },
        "transitions": outcome.transitions.iter().map(transition).collect::<Vec<_>>(),
        "shapes": shapes.collect::<Vec<_>>(),
        "real_frequencies": outcome.real,
        "real_frequencies_unit": "Hz",
        "modes_followed": outcome.modes.len(),
        "vectors": outcome.vectors,
        "largest_residual": outcome.residual(),
        "factor_entries": outcome.entries,
        "seconds": seconds,
        "columns": columns,
        "description": description,
    });
    let mut text = serde_json::to_string_pretty(&document).unwrap_or_default();
    text.push('\n');
    text.into_bytes()
}
