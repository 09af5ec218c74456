//! The table and the figure of a trajectory.

use crate::colour::rgb;
use crate::results::figure::{colour, draw, frames};
use squealmap::engine::outcome::Outcome;
use squealmap::model::contact::ContactState;
use squealmap::model::status::Status;
use squealmap::results::figure::heading::Heading;
use squealmap::results::figure::look::Look;
use squealmap::study::trace::run::{Trace, TraceRow};
use squealmap::study::trace::table::{trace_csv, trace_svg};

/// A sine of 34 Hz that sticks in the second half.
fn trajectory(samples: usize, seconds: f64, frequency: Option<f64>) -> Trace {
    let omega = 34.0 * std::f64::consts::TAU;
    let row = |i: usize| {
        let t = seconds * i as f64 / (samples.max(2) - 1) as f64;
        let (sin, cos) = (omega * t).sin_cos();
        TraceRow {
            t,
            position: [0.01 * sin / 3.0, 0.0, -0.01],
            velocity: [0.01 * omega * cos, 0.0, 0.0],
            acceleration: [-0.01 * omega * omega * sin, 0.0, 100.0 * cos],
            normal_force: 1000.0 + 300.0 * cos,
            tangential_force: 400.0,
            state: if t < 0.5 * seconds { ContactState::Slip } else { ContactState::Stick },
        }
    };
    let outcome = Outcome { status: Status::Ok, response_frequency: frequency, ..Outcome::default() };
    Trace { rows: (0..samples).map(row).collect(), outcome }
}

#[test]
fn the_table_reads_back_to_the_same_bits() {
    let trace = trajectory(50, 0.1, None);
    let bytes = trace_csv(&trace).expect("a table");
    let mut reader = csv::Reader::from_reader(bytes.as_slice());
    let header: Vec<&str> = reader.headers().expect("a header").iter().collect();
    assert_eq!(header.join(" "), "t x2 y2 y1 vx2 vy2 vy1 ax2 ay2 ay1 N T state");
    let rows: Vec<csv::StringRecord> = reader.records().map(|row| row.expect("an even row")).collect();
    assert_eq!(rows.len(), 50);
    for (text, row) in rows.iter().zip(&trace.rows) {
        let number = |i: usize| text[i].parse::<f64>().expect("a number").to_bits();
        assert_eq!(number(0), row.t.to_bits());
        assert_eq!(number(1), row.position[0].to_bits());
        assert_eq!(number(4), row.velocity[0].to_bits());
        assert_eq!(number(9), row.acceleration[2].to_bits());
        assert_eq!(number(10), row.normal_force.to_bits());
        assert_eq!(number(11), row.tangential_force.to_bits());
        assert_eq!(&text[12], row.state.name());
    }
}

#[test]
fn states_are_shaded_where_they_are() {
    let svg =
        trace_svg(&trajectory(500, 0.2, None), &"A short run".into(), &Look::default()).expect("a figure");
    let picture = draw(&svg, "trace_short");
    let frames = frames(&svg);
    assert_eq!(frames.len(), 4, "a short run has no second column");
    // Near the upper edge there is no curve.
    assert_eq!(colour(&picture, frames[3], (0.3, 0.98)), [255; 3]);
    assert_eq!(colour(&picture, frames[3], (0.7, 0.98)), rgb("#CDEBE2"));
    assert!(svg.contains(">stick<") && !svg.contains(">free flight<"));
}

#[test]
fn long_runs_stay_small_and_show_their_last_periods() {
    let svg = trace_svg(&trajectory(200_000, 9.0, Some(34.0)), &"A long run".into(), &Look::default())
        .expect("a figure");
    draw(&svg, "trace_long");
    assert_eq!(frames(&svg).len(), 8);
    assert!(svg.len() < 700_000, "{} bytes", svg.len());
    // Thinning keeps the extremes: the highest point of x2 stands one headroom below the frame.
    let frame = frames(&svg)[0];
    let top = frame[1] + frame[3] * 0.07 / 1.14;
    let curve = svg.lines().find(|line| line.contains("#1F3F8F")).expect("a curve");
    let heights =
        curve.split(['M', 'L']).skip(1).filter_map(|p| p.split([' ', '"']).nth(1)?.parse::<f64>().ok());
    assert!((heights.fold(f64::MAX, f64::min) - top).abs() < 0.1);
}

#[test]
fn odd_trajectories_are_drawn() {
    for samples in [0, 1, 2] {
        draw(
            &trace_svg(&trajectory(samples, 1.0, Some(34.0)), &Heading::default(), &Look::default())
                .expect("a figure"),
            "trace_odd",
        );
    }
    let mut broken = trajectory(100, 0.1, None);
    broken.rows[40].position[0] = f64::NAN;
    broken.rows[41].normal_force = f64::INFINITY;
    let svg = trace_svg(&broken, &Heading::default(), &Look::default()).expect("a figure");
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    draw(&svg, "trace_broken");
}
