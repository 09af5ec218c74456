//! Figures of finite-element studies, as those of `gallery.rs`.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fmt::Write as _;

use squealmap::results::figure::look::Look;
use squealmap::study::Kind;
use squealmap::study::fem::{Bodies, Curve, Curves, State, Transition};

use crate::results::gallery::{Piece, piece};

/// Three modes over friction, two of which coalesce; the files are those of `squealmap fem`.
pub(super) fn a_finite_element_study() -> Piece {
    let mut table = "mu,mode,frequency,growth_rate,damping_ratio,unstable,residual,direct\n".to_owned();
    let mus: Vec<f64> = (0..21).map(|k| f64::from(k) / 50.0).collect();
    let states = |mu: f64| {
        let apart = 0.21 - mu;
        let (split, growth) =
            if apart > 0.0 { (800.0 * apart.sqrt(), 0.0) } else { (0.0, 9000.0 * (-apart).sqrt()) };
        [(12_000.0, 0.0), (14_500.0 - split, growth), (14_500.0 + split, 0.0 - growth)]
    };
    for mu in &mus {
        for (k, (frequency, growth)) in states(*mu).into_iter().enumerate() {
            let unstable = u8::from(growth > 0.0);
            writeln!(table, "{mu},{},{frequency},{growth},0,{unstable},1e-9,0", k + 4).unwrap();
        }
    }
    let transition =
        serde_json::json!({ "event": "coalescence", "mu_c": 0.21, "frequency": 14500.0, "modes": [5, 6] });
    let manifest = serde_json::json!({
        "kind": "fem", "program": "squealmap 0.1.0", "title": "Two samples", "damped": false, "transitions": [transition],
    });
    let curve = |k: usize| {
        let state = |mu: &f64| {
            let (frequency, growth) = states(*mu)[k];
            State { frequency, growth, grows: growth > 0.0 }
        };
        Curve { mode: k + 4, states: mus.iter().map(state).collect() }
    };
    let event = "coalescence".to_owned();
    let curves = Curves {
        title: "Two samples".to_owned(),
        over: None,
        at: None,
        mus: mus.clone(),
        damped: false,
        modes: (0..3).map(curve).collect(),
        transitions: vec![Transition { event, mu: 0.21, frequency: 14_500.0, modes: vec![5, 6] }],
    };
    let svg = curves.svg(&Look::default()).unwrap();
    piece(Kind::Fem, svg, [table.into_bytes(), manifest.to_string().into_bytes()])
}

/// Two modes over the contact stiffness, the files those of `squealmap fem`.
pub(super) fn a_varied_study() -> Piece {
    let values = [1e12, 1e13, 1e14, 1e15];
    let mut table =
        "contact_stiffness,mode,frequency,growth_rate,damping_ratio,unstable,residual\n".to_owned();
    let states = |k: f64| [(9000.0 + 500.0 * k.log10(), -3.0), (16_000.0, 4.0 * (k.log10() - 13.5))];
    for value in values {
        for (mode, (frequency, growth)) in states(value).into_iter().enumerate() {
            let unstable = u8::from(growth > 0.0);
            writeln!(table, "{value:e},{},{frequency},{growth},0,{unstable},1e-9", mode + 1).unwrap();
        }
    }
    let manifest = serde_json::json!({
        "kind": "fem", "program": "squealmap 0.1.0", "title": "A soft layer",
        "varied": { "parameter": "contact_stiffness", "quantity": "Contact stiffness", "unit": "Pa/m", "mu": 0.35, "damped": true },
    });
    let curve = |mode: usize| {
        let state = |value: f64| {
            let (frequency, growth) = states(value)[mode];
            State { frequency, growth, grows: growth > 0.0 }
        };
        Curve { mode: mode + 1, states: values.map(state).to_vec() }
    };
    let curves = Curves {
        title: "A soft layer".to_owned(),
        over: Some(["Contact stiffness", "Pa/m"].map(str::to_owned)),
        at: Some(0.35),
        mus: values.to_vec(),
        damped: true,
        modes: vec![curve(0), curve(1)],
        transitions: Vec::new(),
    };
    let svg = curves.svg(&Look::default()).unwrap();
    piece(Kind::Vary, svg, [table.into_bytes(), manifest.to_string().into_bytes()])
}

/// A coarse pin on a block, computed: its mesh, or its modes.
pub(super) fn bodies(kind: Kind) -> Piece {
    let text = include_str!("../../../crates/fem/tests/suite/study/pin.toml");
    let text =
        text.replace("hex20", "hex8").replace("points = 26", "points = 2").replace("count = 7", "count = 1")
            + "\n[output]\nshapes_at = [0.0]\n";
    let document = squealmap_fem::study::document::Document::read(&text).unwrap();
    let study = squealmap_fem::study::Study::new(document, &|_| Err("no file".to_owned())).unwrap();
    let outcome = squealmap_fem::study::compute(&study, &mut |_| ()).unwrap();
    let bodies = Bodies::of(&study, &outcome);
    let look = Look::default();
    let svg = if kind == Kind::Mesh { bodies.mesh_svg(&look) } else { bodies.shapes_svg(&look).unwrap() };
    let shapes = squealmap_fem::study::shapes(&study, &outcome);
    piece(kind, svg, [shapes, squealmap_fem::study::manifest(&study, &outcome, &text, "squealmap 0.1.0")])
}
