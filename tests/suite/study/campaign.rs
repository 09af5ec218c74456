//! Strokes of records, and what those of one condition have in common.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::io::{Cursor, Read};

use crate::cli::program::squealmap;
use squealmap::study::campaign::condition::{Condition, conditions};
use squealmap::study::campaign::row::{Said, VelocityLaw};
use squealmap::study::identify::shown::Colour;
use squealmap_identify::{Settings, Stroke, identify, strokes};

/// Samples per second.
const RATE: f64 = 20_000.0;
/// Samples of a rest: no multiple of the blocks in which a record is looked at.
const REST: usize = 2003;

/// A record of strokes between rests: each its direction, first and last speed (m/s), duration (s), and frequency of what vibrates in
/// it, Hz, or 0; noise by a fixed sequence.
fn record(of: &[(f64, [f64; 2], f64, f64)], temperature: f64) -> String {
    let mut text = String::from("t,ax2,ay1,T,N,V,temperature\n");
    let (mut row, mut seed) = (0_u64, 7_u64);
    let mut noise = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let mut add = |speed: f64, vibration: f64| {
        let t = row as f64 / RATE;
        let (n, mu) = (17.0 + 0.01 * noise(), 0.4 * speed.signum() * f64::from(u8::from(speed != 0.0)));
        let (ax, ay) = (vibration + 0.05 * noise(), 0.6 * vibration + 0.05 * noise());
        let _ = writeln!(text, "{t},{ax},{ay},{},{n},{speed},{temperature}", mu * n + 0.01 * noise());
        row += 1;
    };
    for &(direction, [first, last], duration, frequency) in of {
        (0..REST).for_each(|_| add(0.0, 0.0));
        let times =
            (0..u32::MAX).map(|k| f64::from(k) / RATE).take_while(|time| *time < duration - 0.5 / RATE);
        for time in times {
            let part = time / duration;
            let sound = if frequency > 0.0 { 40.0 * (TAU * frequency * time).sin() } else { 0.0 };
            add(direction * (first + part * (last - first)), sound);
        }
    }
    (0..REST).for_each(|_| add(0.0, 0.0));
    text
}

fn open(text: &str) -> impl Fn() -> std::io::Result<Box<dyn Read>> + '_ {
    || Ok(Box::new(Cursor::new(text.as_bytes().to_vec())))
}

fn found(text: &str) -> Vec<Stroke> {
    strokes(open(text), "record", &Settings::default()).expect("a record")
}

const THREE: [(f64, [f64; 2], f64, f64); 3] =
    [(1.0, [0.2, 0.02], 0.4, 0.0), (-1.0, [0.1, 0.1], 0.3, 3000.0), (1.0, [0.05, 0.2], 0.2, 0.0)];

#[test]
fn strokes_lie_between_rests_and_turns() {
    let text = record(&THREE, 300.0);
    let all = found(&text);
    let laws: Vec<_> =
        all.iter().map(|stroke| VelocityLaw::of(stroke.quarters.expect("a velocity"))).collect();
    assert_eq!(laws, [VelocityLaw::Falling, VelocityLaw::Constant, VelocityLaw::Rising]);
    for stroke in &all {
        let near = |value: Option<f64>, to: f64| value.is_some_and(|value| (value - to).abs() < 1e-3 * to);
        assert!(near(stroke.friction, 0.4) && near(stroke.temperature, 300.0), "{stroke:?}");
    }
    assert_eq!(all.iter().map(|stroke| stroke.forward).collect::<Vec<_>>(), [true, false, true]);
    let mut before = 0.0;
    for (stroke, (_, [first, last], duration, _)) in all.iter().zip(THREE) {
        before += REST as f64;
        let [from, rows] = stroke.rows.map(|rows| rows as f64);
        // Blocks of 16 rows, and what moves at 5 % of the fastest or below is at rest.
        assert!((from - before).abs() <= 16.0 && (rows - duration * RATE).abs() <= 32.0, "{stroke:?}");
        let [begins, .., ends] = stroke.quarters.expect("a velocity");
        let eighth = 0.125 * (last - first);
        assert!((begins - first - eighth).abs() < 2e-3 && (ends - last + eighth).abs() < 2e-3, "{stroke:?}");
        before += duration * RATE;
    }
    // Without a velocity the force tells; without both the record is one stroke.
    let forces = found(&text.replace("T,N,V", "T,N,speed"));
    assert_eq!(forces.len(), 3);
    assert!(forces.iter().all(|stroke| stroke.quarters.is_none()));
    assert_eq!(found(&text.replace("T,N,V", "force,N,speed")).len(), 1);
}

#[test]
fn a_stroke_of_a_record_says_what_a_file_of_it_says() {
    let text = record(&THREE, 300.0);
    let stroke = found(&text)[1];
    let settings = Settings { rows: Some(stroke.rows), ..Settings::default() };
    let inside = identify(open(&text), "record", &settings, &mut |_, _| {}).expect("a stroke");
    let [before, rows] = stroke.rows.map(|rows| usize::try_from(rows).expect("a few"));
    let lines: Vec<&str> = text.lines().collect();
    let alone = format!("{}\n{}\n", lines[0], lines[1 + before..1 + before + rows].join("\n"));
    let alone = identify(open(&alone), "record", &Settings::default(), &mut |_, _| {}).expect("a file");
    let said = Said::new(&inside, &stroke);
    assert_eq!(said, Said::new(&alone, &stroke));
    assert!((said.time[0] - before as f64 / RATE).abs() < 1e-9, "{said:?}");
    assert!(said.vibrating > 0.9, "{said:?}");
    assert!(said.vibration.is_some_and(|[frequency, _]| (frequency - 3000.0).abs() < 3.0), "{said:?}");
    // Its neighbours do not vibrate.
    let settings = Settings { rows: Some(found(&text)[0].rows), ..Settings::default() };
    let quiet = identify(open(&text), "record", &settings, &mut |_, _| {}).expect("a stroke");
    assert!(Said::new(&quiet, &stroke).vibrating < 0.1);
}

#[test]
fn strokes_of_one_temperature_and_law_are_one_condition() {
    let said = |law, speed: f64, temperature: f64, vibrating: f64, seconds: f64| Said {
        time: [1.0, 1.0 + seconds],
        forward: true,
        law: Some(law),
        speed: Some(speed),
        temperature: Some(temperature),
        friction: Some(0.4),
        vibrating,
        vibration: (vibrating > 0.0).then_some([100.0 * temperature, 1.0]),
        shares: [1.0 - vibrating, 0.0, 0.0, vibrating, 0.0, 0.0, 0.0],
    };
    let rows = [
        said(VelocityLaw::Falling, 0.1, 305.0, 1.0, 3.0),
        said(VelocityLaw::Constant, 0.1, 498.0, 0.5, 1.0),
        said(VelocityLaw::Falling, 0.11, 295.0, 0.0, 1.0),
        said(VelocityLaw::Constant, 0.1, 301.0, 0.25, 1.0),
        said(VelocityLaw::Constant, 0.2, 300.0, 0.25, 1.0),
    ];
    let all = conditions(&rows);
    let of: Vec<_> = all.iter().map(|one| (one.law, one.strokes)).collect();
    let [constant, falling] = [VelocityLaw::Constant, VelocityLaw::Falling].map(Some);
    // Twice as fast is another condition, a tenth faster is not.
    assert_eq!(of, [(constant, 1), (constant, 1), (falling, 2), (constant, 1)]);
    // Small steps from one end to the other are no one condition.
    let heating = (0..12).map(|k| said(VelocityLaw::Constant, 0.1, 100.0 + 5.0 * f64::from(k), 0.5, 1.0));
    let heated = conditions(&heating.collect::<Vec<_>>());
    let means: Vec<f64> = heated.iter().filter_map(|one| one.temperature).collect();
    assert!(heated.len() > 1 && heated.iter().all(|one| one.strokes <= 8), "{means:?}");
    assert!(means.windows(2).all(|two| two[0] < two[1]), "{means:?}");
    let falling = &all[2];
    assert!(falling.speed.is_some_and(|mean| (mean - 0.1025).abs() < 1e-12));
    // Weighted by time: three seconds at 305, one at 295.
    assert!(falling.temperature.is_some_and(|mean| (mean - 302.5).abs() < 1e-12));
    assert!((falling.vibrating - 0.75).abs() < 1e-12);
    assert_eq!(falling.vibration, Some([30_500.0, 1.0]));
    assert!((falling.shares[Colour::ModeCoupling as usize] - 0.75).abs() < 1e-12);
    let told = falling.to_string();
    assert!(told.ends_with("at 30500.0 Hz; no instability 25 %, mode coupling 75 %"), "{told}");
    // Every verdict by its own name.
    for colour in Colour::ALL {
        let mut shares = [0.0; Colour::ALL.len()];
        shares[colour as usize] = 1.0;
        let told = Condition { shares, ..falling.clone() }.to_string();
        let name = colour.name().replace('_', " ");
        assert!(told.ends_with(&format!("; {name} 100 %")), "{told}");
    }
}

#[test]
fn a_folder_of_records_is_a_campaign_and_a_broken_one_says_why() {
    let directory = tempfile::tempdir().expect("a directory");
    let here = directory.path();
    std::fs::create_dir(here.join("records")).expect("a folder");
    for (name, temperature) in [("hot.csv", 500.0), ("warm.csv", 300.0)] {
        std::fs::write(here.join("records").join(name), record(&THREE, temperature)).expect("written");
    }
    std::fs::write(here.join("records/broken.csv"), "t,ax2\n0,1\n1,x\n").expect("written");
    // Without a velocity the force tells the direction, and the stroke back is turned.
    let forces = record(&THREE, 100.0).replace("T,N,V", "T,N,speed");
    std::fs::write(here.join("records/no_velocity.csv"), forces).expect("written");
    std::fs::write(here.join("records/notes.md"), "none").expect("written");
    // Whatever is given twice counts once.
    let ended = squealmap(here, &["campaign", "records", "records/../records/hot.csv", "-o", "out"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let told = ended.err;
    assert!(told.contains("`records/../records/hot.csv` is given twice and counts once"), "{told}");
    assert!(told.contains("broken.csv") && told.contains("`x`"), "{told}");
    let read = |name: &str| std::fs::read_to_string(here.join("out").join(name)).expect("a table");
    let table = read("strokes.csv");
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 1 + 1 + 3 + 3 + 3, "{table}");
    assert!(rows[1][0].ends_with("broken.csv") && rows[1][21] != "ok", "{table}");
    assert!(rows[2..].iter().all(|row| row[21] == "ok"), "{table}");
    assert_eq!(
        rows[5..8].iter().map(|row| row[4]).collect::<Vec<_>>(),
        ["forward", "back", "forward"],
        "{table}"
    );
    let laws: Vec<&str> = rows[2..5].iter().map(|row| row[9]).collect();
    assert_eq!(laws, ["falling", "constant", "rising"]);
    let conditions = read("conditions.csv");
    assert_eq!(conditions.lines().count(), 1 + 1 + 6, "{conditions}");
    for (given, why) in [("nothing", "nothing"), ("out", "no record")] {
        std::fs::create_dir_all(here.join("empty")).expect("a folder");
        let given = if given == "out" { "empty" } else { given };
        let ended = squealmap(here, &["campaign", given, "-o", "other"]);
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        let told = ended.err;
        assert!(told.contains(why), "{told}");
    }
}
