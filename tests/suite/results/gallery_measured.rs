//! Figures of measurements, made by hand as those of the gallery.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::results::gallery::{Piece, piece};
use squealmap::model::friction::LawKind;
use squealmap::results::figure::look::Look;
use squealmap::study::campaign::figure::campaign_svg;
use squealmap::study::campaign::row::{Said, StrokeRow, VelocityLaw, strokes_csv};
use squealmap::study::{Kind, campaign, fit};
use squealmap_identify::{Point, Stroke};

/// Strokes at three temperatures, of two laws of the velocity.
pub(super) fn a_campaign() -> Piece {
    let row = |k: usize| {
        let (temperature, falling, forward) = ([100.0, 300.0, 500.0][k % 3], k / 3 % 2 == 1, k % 12 < 6);
        let x = k as f64;
        let vibrating = if temperature > 200.0 { (0.2 + 0.04 * x).min(1.0) } else { 0.0 };
        let quarters = if falling { [0.04, 0.03, 0.02, 0.01] } else { [0.02; 4] };
        let stroke = Stroke {
            rows: [1000 * k as u64, 900],
            forward,
            quarters: Some(quarters),
            friction: Some(0.35 + 2e-4 * temperature + 0.003 * x),
            temperature: Some(temperature + x),
        };
        let said = Said {
            time: [x, x + 0.9],
            forward,
            law: Some(VelocityLaw::of(quarters)),
            speed: Some(quarters.iter().sum::<f64>() / 4.0),
            temperature: stroke.temperature,
            friction: stroke.friction,
            vibrating,
            vibration: (vibrating > 0.0).then_some([14_500.0 - 10.0 * x, 3.0 * (0.3 * x).exp()]),
            shares: [1.0 - vibrating, 0.0, 0.0, 0.5 * vibrating, 0.25 * vibrating, 0.25 * vibrating, 0.0],
        };
        let (record, told) = (format!("r{k}.csv"), String::new());
        StrokeRow { record, number: 1, stroke: Some(stroke), said: Ok(said), told }
    };
    let mut rows: Vec<StrokeRow> = (0..18).map(row).collect();
    let said: Vec<Said> = rows.iter().map(|row| row.said.clone().unwrap()).collect();
    rows[0].said = Err("broken".to_owned());
    let svg = campaign_svg("A campaign", &said[1..], &Look::default());
    piece(
        Kind::Campaign,
        svg,
        [strokes_csv(&rows).unwrap(), campaign::read::document("A campaign", 18).unwrap()],
    )
}

/// A falling law at two temperatures among scattered points.
pub(super) fn a_fit() -> Piece {
    let point = |k: usize| {
        let (velocity, temperature) = (0.1 * (k / 2) as f64, [100.0, 300.0][k % 2]);
        let friction = 0.4 + 3e-4 * temperature - 0.1 * f64::min(velocity / 2.5, 1.0);
        Point { velocity, half_range: 0.0, temperature, friction: friction + 0.01 * (7.0 * k as f64).sin() }
    };
    let points: Vec<Point> = (0..80).map(point).collect();
    let found = fit::fit(&points, LawKind::Bilinear, &[100.0, 300.0], None).unwrap();
    let shown = fit::course::Shown::new(&found, fit::course::courses(&found, &points), &points, "Points");
    let svg = fit::figure::fit_svg(&shown, &Look::default());
    let table = fit::table::residuals_csv(&found, &points).unwrap();
    piece(Kind::Fit, svg, [table, shown.document().unwrap()])
}
