//! One small figure of every kind, made by hand and left in a directory as its command would leave it.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::f64::consts::TAU;

use crate::results::gallery_fem::{a_finite_element_study, a_varied_study, bodies};
use crate::results::gallery_measured::{a_campaign, a_fit};
use crate::synthetic::{axis, map, number, paper_like, record, span, spec};
use num_complex::Complex64;
use squealmap::engine::backend::Backend;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::record::Record;
use squealmap::engine::reference::records::in_f64;
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::contact::ContactState;
use squealmap::model::kind::InstabilityType;
use squealmap::model::status::Status;
use squealmap::results::figure::heading::Heading;
use squealmap::results::figure::look::Look;
use squealmap::results::figure::map::map_svg;
use squealmap::results::refined::OfParts;
use squealmap::results::{csv, manifest, refined};
use squealmap::store::description::Description;
use squealmap::store::refinement::Refinement;
use squealmap::study::Kind;
use squealmap::study::curves::seek::PlaneCurves;
use squealmap::study::cycles::branch::BranchPoint;
use squealmap::study::cycles::curve::{self, CurvePoint, End};
use squealmap::study::cycles::special::Special;
use squealmap::study::hysteresis::follow::Hysteresis;
use squealmap::study::identify::shown::{Colour, Coloured};
use squealmap::study::identify::spectrogram::spectrogram_nc;
use squealmap::study::paper::figures::{Growing, Shown, Slowdown};
use squealmap::study::paper::{Figure, PhaseTrial, Settings, Stretch, Study, Trial, Witness};
use squealmap::study::trace::run::{Trace, TraceRow};
use squealmap::study::{curves, hysteresis, identify, modes, trace, tradeoff};
use squealmap::sweep::accuracy::row::{Row, from_csv, to_csv};
use squealmap::sweep::grid::{AxisKey, Grid, Value};
use squealmap::sweep::label::Label;
use squealmap::sweep::refine;
use squealmap::sweep::sheet::Sheet;
use squealmap::sweep::spec::refine::Settings as Refining;
use squealmap_identify::{Clip, Instant, Spectrogram};
use tempfile::TempDir;

/// A figure and the directory that it can be drawn from.
pub(crate) struct Piece {
    pub(crate) kind: Kind,
    pub(crate) directory: TempDir,
    /// The picture of the command itself.
    pub(crate) svg: String,
}

/// Leaves files in a directory.
pub(super) fn piece(kind: Kind, svg: String, files: [Vec<u8>; 2]) -> Piece {
    let directory = tempfile::tempdir().unwrap();
    for (name, bytes) in kind.files().into_iter().zip(files) {
        std::fs::write(directory.path().join(name), bytes).unwrap();
    }
    Piece { kind, directory, svg }
}

/// One of every kind.
pub(crate) fn all() -> Vec<Piece> {
    let mut pieces = vec![
        a_map(),
        a_refined_map(),
        a_trace(),
        a_hysteresis(),
        some_curves(),
        some_modes(),
        a_tradeoff(),
        an_identification(),
        a_campaign(),
        a_fit(),
        a_finite_element_study(),
        a_varied_study(),
    ];
    pieces.extend([Kind::Shapes, Kind::Mesh].map(bodies));
    pieces.extend(Figure::ALL.map(of_the_paper));
    pieces
}

/// A map like the paper's, of three velocities.
fn a_map() -> Piece {
    let axes = vec![
        span(Param::MuS, 0.0, 0.6, 13),
        span(Param::MuD, 0.0, 0.6, 13),
        axis(Param::BeltVelocity, &[0.5, 3.0, 6.0]),
    ];
    let map = map(Grid::Axes(axes), |_, at| paper_like(number(at[0]), number(at[1]), number(at[2])));
    let files = [manifest::manifest_json(&map).unwrap(), csv::map_csv(&map).unwrap()];
    piece(Kind::Map, map_svg(&map).unwrap(), files)
}

/// A map of two planes, refined from few of its instances.
fn a_refined_map() -> Piece {
    let axes = vec![
        span(Param::MuS, 0.0, 0.6, 65),
        span(Param::MuD, 0.0, 0.6, 65),
        axis(Param::BeltVelocity, &[1.0, 4.9]),
    ];
    let mut sweep = spec(Grid::Axes(axes));
    "Few points".clone_into(&mut sweep.title);
    let computation = |method: &str| in_f64(Backend::Reference, method.to_owned());
    let engine = [computation("closed form"), computation("rk4")];
    let sheet = Sheet::new(&sweep, engine.each_ref().map(Some));
    let mut points = csv::MapCsv::new(sheet, Vec::new()).unwrap();
    let settings = Refining { coarse: 8, sample: 50, seed: 3 };
    let found = refine::refine::<squealmap::results::error::Error>(&sweep.grid, settings, &mut |instances| {
        let at = |index: &usize| sweep.grid.coordinates(*index).into_iter().map(number).collect::<Vec<_>>();
        let records: Vec<Record> =
            instances.iter().map(at).map(|at| paper_like(at[0], at[1], at[2])).collect();
        points.add_some(instances, &records)?;
        Ok(records.iter().map(Label::from).collect())
    })
    .unwrap();
    assert!(found.computed < sweep.grid.len() / 2);
    let svg = refined::figure(sheet, &found).look(&Look::default());
    let points = points.finish();
    let of = OfParts { files: vec![("points.csv", manifest::Sum::of(&points))], ..OfParts::default() };
    let description = Description::new(&sweep, engine.clone().map(Some), 1 << 16);
    let document = refined::document(&Refinement { description, settings }, &found, &of).unwrap();
    piece(Kind::Refined, svg, [points, document])
}

/// A growing oscillation with its spectrogram.
fn an_identification() -> Piece {
    let (columns, rows) = (40, 12);
    let level = |k: usize| {
        let (column, row) = (k / rows, k % rows);
        let off = row as f32 - 4.0 - 0.05 * column as f32;
        (-0.5 * off * off).exp()
    };
    let normalised: Vec<f32> = (0..columns * rows).map(level).collect();
    let spectrogram = Spectrogram {
        time: [0.0125, 1.9875],
        frequency: [0.0, 3000.0],
        window: 0.025,
        columns,
        rows,
        decibel: normalised.iter().map(|level| 20.0 * level.max(1e-4).log10()).collect(),
        normalised,
    };
    let wave = |k: u32, size: f64| {
        let swing = size * (0.06 * f64::from(k)).exp().min(8.0);
        [-swing, 0.9 * swing]
    };
    let instant = |k: u32| Instant {
        time: 0.1 + 0.045 * f64::from(k),
        velocity: Some(3.0 - 0.05 * f64::from(k)),
        temperature: Some(500.0),
        phase: (k > 4).then_some(if k < 25 { -90.0 } else { -5.0 }),
        coherence: (k > 4).then_some(0.98),
    };
    let zoom = |middle: f64| {
        let accelerations =
            [0.0, 1.5].map(|late| (0..120).map(|k| 4.0 * (0.3 * f64::from(k) - late).sin()).collect());
        Clip { start: middle - 0.03, step: 5e-4, accelerations }
    };
    let shown = identify::report::Shown {
        title: "A stroke".to_owned(),
        verdict: "Verdict: mode coupling (confidence 0.97)".to_owned(),
        time: [0.0, 2.0],
        accelerations: [1.0, 0.4].map(|size| (0..60).map(|k| wave(k, size)).collect()),
        friction_time: [0.1, 1.9],
        friction: (0..30).map(|k| [0.4 - 1e-3 * f64::from(k), 0.41 + 1.0 / 3e3 * f64::from(k)]).collect(),
        course: (0..40).map(instant).collect(),
        segments: vec![
            Coloured { time: [0.1, 0.3], verdict: Colour::NoInstability },
            Coloured { time: [0.3, 1.1], verdict: Colour::ModeCoupling },
            Coloured { time: [1.1, 1.5], verdict: Colour::AnyCoupling },
            Coloured { time: [1.5, 1.9], verdict: Colour::Both },
        ],
        zooms: [0.5, 1.2, 1.6].map(zoom).to_vec(),
        spectrogram,
    };
    let svg = identify::report::identify_svg(&shown, &Look::default()).unwrap();
    piece(Kind::Identify, svg, [spectrogram_nc(&shown.spectrogram, &shown.title), shown.document().unwrap()])
}

/// A sine that sticks, flies and slides back, long enough for a second column.
fn a_trace() -> Piece {
    const FREQUENCY: f64 = 20.0;
    let row = |k: u32| {
        let t = f64::from(k) / 400.0;
        let (sin, cos) = (FREQUENCY * TAU * t).sin_cos();
        TraceRow {
            t,
            position: [0.01 * sin / 3.0, 0.0, -0.01],
            velocity: [1.2 * cos, 0.0, 0.0],
            acceleration: [-150.0 * sin, 0.0, 100.0 * cos],
            normal_force: 1000.0 + 300.0 * cos,
            tangential_force: 400.0 - 80.0 * sin,
            state: ContactState::ALL[k as usize / 7 % 4],
        }
    };
    let outcome = Outcome { status: Status::Ok, response_frequency: Some(FREQUENCY), ..Outcome::default() };
    let found = Trace { rows: (0..300).map(row).collect(), outcome };
    let heading = Heading::new("A sine", "mu_s=0.4, mu_d = 0.3,law=bilinear,belt_velocity=3,k1=2e6");
    let svg = trace::table::trace_svg(&found, &heading, &Look::default()).unwrap();
    piece(
        Kind::Trace,
        svg,
        [trace::table::trace_csv(&found).unwrap(), trace::table::document(&found, &heading).unwrap()],
    )
}

/// A cycle that lives from one half of the range to two thirds beside a stable equilibrium.
fn a_hysteresis() -> Piece {
    let values: Vec<f64> = (0..13).map(|k| 0.1 + f64::from(k) / 30.0).collect();
    let at = |cycle: bool, k: usize| {
        let kind = if k < 6 { InstabilityType::NegativeSlope } else { InstabilityType::Stable };
        let regime = if cycle { Regime::StickSlip } else { Regime::Equilibrium };
        let x2_std = Some(if cycle { 1e-3 * values[k] } else { 1e-9 });
        let outcome = Outcome { status: Status::Ok, x2_std, ..Outcome::default() };
        Record { outcome: Some(Box::new(outcome)), ..record(kind, regime, true) }
    };
    let branch = |end: usize| (0..values.len()).map(|k| at(k < end, k)).collect();
    let found = Hysteresis { param: Param::MuS, up: branch(9), down: branch(6), values, cycles: Vec::new() };
    let heading = Heading::new("A loop", "belt_velocity=1.5");
    let sweep = spec(found.grid());
    let svg = hysteresis::table::hysteresis_svg(&found, &heading, &Look::default());
    let files = [
        hysteresis::table::hysteresis_csv(&sweep, &found).unwrap(),
        hysteresis::table::document(&found, &heading).unwrap(),
    ];
    piece(Kind::Hysteresis, svg, files)
}

/// A fold and a Hopf curve in two planes.
fn some_curves() -> Piece {
    let axes = vec![
        span(Param::MuS, 0.0, 0.6, 5),
        span(Param::MuD, 0.0, 0.6, 5),
        axis(Param::BeltVelocity, &[1.0, 3.0]),
    ];
    let sweep = spec(Grid::Axes(axes));
    let point = |values: [f64; 2], special: Special| CurvePoint {
        values,
        cycle: BranchPoint {
            value: values[0],
            unstable: 0,
            special: Some(special),
            record: record(InstabilityType::ModeCoupling, Regime::StickSlip, true),
        },
    };
    let line = |special: Special, at: f64| {
        let points = (0..5).map(|k| 0.15 * f64::from(k)).map(|x| point([x, at + 0.2 * x], special)).collect();
        curve::Curve { special, points, ends: [End::Edge; 2] }
    };
    let plane = |velocity: f64| PlaneCurves {
        params: [Param::MuS, Param::MuD],
        others: vec![(AxisKey::Param(Param::BeltVelocity), Value::Number(velocity))],
        curves: vec![line(Special::Hopf, 0.1), line(Special::Fold, 0.1 * velocity)],
        alone: Vec::new(),
    };
    let planes = [plane(1.0), plane(3.0)];
    let svg = curves::figure::curves_svg(&sweep, &curves::figure::overlays(&planes), &Look::default());
    let table = curves::table::curves_csv(&sweep, &planes).unwrap();
    let document = curves::table::document(&sweep, &table).unwrap();
    piece(Kind::Curves, svg, [table, document])
}

/// Two modes that merge, at two velocities.
fn some_modes() -> Piece {
    let axes = vec![span(Param::MuD, 0.0, 0.5, 11), axis(Param::BeltVelocity, &[1.0, 2.5])];
    let sweep = spec(Grid::Axes(axes));
    let two = |spec: &squealmap::sweep::spec::Spec, index: usize| {
        let at = spec.grid.coordinates(index);
        let (mu, v) = (number(at[0]), number(at[1]));
        let apart = 0.3 * v - mu;
        let (split, growth) = if apart > 0.0 { (apart, 0.0) } else { (0.0, -apart) };
        let [a, b] = [(1.0, -1.0), (-1.0, 1.0)]
            .map(|(side, sign)| Complex64::new(sign * 40.0 * growth - 0.5, 200.0 - side * 60.0 * split));
        Some(vec![a, a.conj(), b, b.conj()])
    };
    let found = modes::follow::follow(&sweep, &two).unwrap();
    let svg = modes::follow::draw(&sweep, &found, &Look::default());
    let files =
        [modes::follow::table(&sweep, &found).unwrap(), modes::follow::document(&sweep, &found).unwrap()];
    piece(Kind::Modes, svg, files)
}

/// Two engines, the reference and one to compare with.
fn a_tradeoff() -> Piece {
    let engine = |backend: &str, precision: &str, steps: u32, speed: f64, error: f64, frontier: bool| {
        let row = serde_json::json!({
            "scene": "pieces", "backend": backend, "adapter": null, "precision": precision,
            "steps_per_period": steps, "per_cpu_second": speed, "per_second": 2.0 * speed,
            "types": 0.0, "regimes": 0.0, "statuses": 0.0, "beyond_scatter_p95": 0.0, "frontier": frontier,
        });
        let mut row = row.as_object().unwrap().clone();
        for name in ["x2_std", "ax_rms", "ay_rms", "response_frequency", "worst", "stick"] {
            for (quantile, factor) in [("p50", 0.3), ("p95", 1.0), ("p99", 3.0)] {
                row.insert(format!("{name}_{quantile}"), (factor * error).into());
            }
        }
        serde_json::from_value::<Row>(row.into()).unwrap()
    };
    let mut rows = vec![engine("reference", "f64", 12, 180.0, 3e-9, true)];
    for (k, steps) in [24, 12, 8, 5].into_iter().enumerate() {
        let k = k as f64;
        rows.push(engine("cpu", "f64", steps, 2000.0 * 1.5_f64.powf(k), 2e-8 * 20_f64.powf(k), k < 2.0));
        rows.push(engine("cpu", "f32", steps, 3900.0 * 1.5_f64.powf(k), 1e-6 * 5_f64.powf(k), true));
    }
    rows.push(engine("located RK4", "f64", 20, 170.0, 1.6e-3, false));
    let table = to_csv(&rows).unwrap();
    assert_eq!(from_csv(&table).unwrap(), rows, "every number comes back");
    let document = serde_json::json!({ "title": "Speed", "program": { "version": "0.1.0" } });
    let svg = tradeoff::report::figure("Speed", &rows, &Look::default());
    piece(Kind::Tradeoff, svg, [table, document.to_string().into_bytes()])
}

/// A figure of the paper: what is dear is made up.
fn of_the_paper(figure: Figure) -> Piece {
    let shown = match figure {
        Figure::Accelerations => Shown::Accelerations(trials()),
        Figure::Phase => Shown::Phase(phases()),
        Figure::Figure7 => Shown::Growth(growths()),
        Figure::Figure2 | Figure::Figure3 => {
            Shown::compute(figure, &Study::new(Settings::default())).unwrap()
        }
        Figure::Figure4 => Shown::Ramp(ramp(Some(5.0))),
        _ => Shown::Ramp(ramp(None)),
    };
    let svg = shown.svg(&Look::default());
    piece(Kind::Paper(figure), svg, [shown.csv().unwrap(), shown.document().unwrap()])
}

/// A ramp of 10 s on which the vibration grows, sticks and dies down.
fn ramp(knee: Option<f64>) -> Slowdown {
    const DURATION: f64 = 10.0;
    let stretches = |count: u32| {
        let stretch = |k: u32| {
            let at = |k: u32| DURATION * f64::from(k) / f64::from(count);
            let time = [at(k), at(k + 1)];
            let size = 100.0 * at(k).min(1.2 * (DURATION - at(k)));
            Stretch {
                time,
                velocity: time.map(|t| 7.0 + (0.0 - 7.0) * t / DURATION),
                tangential: [-size, 1.1 * size],
                normal: [-0.4 * size - 3.0, 0.5 * size],
                stick: 0.02 * at(k),
                free: 0.01 * (DURATION - at(k)),
            }
        };
        (0..count).map(stretch).collect()
    };
    Slowdown {
        heading: "Belt from 7 m/s to rest".to_owned(),
        knee,
        duration: DURATION,
        velocity: [7.0, 0.0],
        columns: stretches(90),
        parts: stretches(28),
    }
}

/// Two vibrations that grow, one in phase and one in quadrature.
fn growths() -> Vec<Growing> {
    let growing = |words: &str, friction: [f64; 2], lag: f64| {
        let sample = |k: u32| {
            let t = f64::from(k) / 400.0;
            let (size, angle) = ((4.0 * t).exp(), TAU * 16.0 * t);
            [t, 5.0 - 2.0 * t, size * angle.sin(), 0.2 * size * (angle - lag).sin()]
        };
        let samples = (0..200).map(sample).collect();
        let lag = lag.to_degrees();
        let phases = (lag < 50.0).then_some([[-lag - 2.0, -lag + 1.0], [-lag, -lag + 0.3]]);
        Growing { words: words.to_owned(), friction, phases, samples }
    };
    vec![growing("negative slope", [0.07, 0.02], 0.2), growing("mode coupling", [0.8, 0.8], 1.0)]
}

fn trials() -> Vec<Trial> {
    let trial = |k: u32| {
        let (duration, kick) = ([0.5, 2.0, 10.0][k as usize / 3], [1e-4, 3e-4, 1e-3][k as usize % 3]);
        let peak = |base: f64| (k != 4).then(|| [base + f64::from(k), 0.5 * base]);
        Trial {
            duration,
            kick,
            disturbance: 3.0 * f64::from(k),
            peaks: [peak(80.0), peak(120.0), peak(125.0)],
        }
    };
    (0..9).map(trial).collect()
}

fn phases() -> PhaseTrial {
    let kinds = [
        InstabilityType::Stable,
        InstabilityType::NegativeSlope,
        InstabilityType::ModeCoupling,
        InstabilityType::Coexistence,
    ];
    let witness = |k: usize| {
        let (v, i, j) = (k / 36, k / 6 % 6, k % 6);
        let kind = kinds[(i + j) / 3];
        let phase = 7.0 * (i + 2 * j) as f64;
        Witness {
            velocity: [0.5, 1.0, 3.0, 4.9][v],
            friction: [0.1 * i as f64, 0.1 * j as f64],
            kind: Some(kind),
            phases: [Some(phase), (j > 0).then_some(0.9 * phase), (i != j).then_some(0.5 * phase)],
        }
    };
    PhaseTrial { witnesses: (0..144).map(witness).collect() }
}
