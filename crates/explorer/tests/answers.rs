//! Answers against what the library says of the same sweep, and questions that are none.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use serde_json::json;
use squealmap::study::explore::Explorer;
use squealmap::sweep::spec::Spec;
use squealmap::{Backend, Options};

const MAP: &str = "[model]\ntheta = 0.01\n[friction]\nlaw = \"bilinear\"\nknee_velocity = 5\n[response]\nsettle = \"20 periods\"\n\
    measure = \"10 periods\"\ncheck = false\n[axes]\nmu_s = { from = 0.0, to = 0.6, points = 7 }\n\
    mu_d = { from = 0.0, to = 0.5, points = 6 }\nbelt_velocity = { values = [1.0, 3.0] }\n";

fn parse(text: &str) -> Spec {
    Spec::parse(text, "s.toml", ".".as_ref()).unwrap()
}

fn open() -> Explorer {
    Explorer::new(parse(MAP)).unwrap()
}

fn region(response: bool, columns: &[&str]) -> serde_json::Value {
    json!({
        "ask": "region",
        "x": { "key": "mu_d", "from": 0.0, "to": 0.5, "points": 6 },
        "y": { "key": "mu_s", "from": 0.0, "to": 0.6, "points": 7 },
        "at": { "belt_velocity": 3.0 },
        "response": response,
        "columns": columns,
    })
}

/// The name with a code.
fn named(names: &[String], code: f64) -> Option<String> {
    (0..names.len())
        .find(|place| (*place as f64).to_bits() == code.to_bits())
        .map(|place| names[place].clone())
}

/// The cells of a region are those of a run: every name, and every number to the bit.
#[test]
fn a_region_is_what_a_run_computes() {
    let options = Options { backend: Backend::Cpu, ..Options::default() };
    let text = MAP.replace("values = [1.0, 3.0]", "values = [3.0]");
    let map = squealmap::sweep::run::run(parse(&text), &options, &|_| ()).unwrap();
    let names = ["type", "regime"];
    let numbers = ["growth_rate", "x2_std", "ax_rms", "stick"];
    let answer = open().answer(&region(true, &[&names[..], &numbers].concat()).to_string()).unwrap();
    assert_eq!(answer.head["shape"], json!([7, 6]));
    let about = open().answer(r#"{"ask":"about"}"#).unwrap().head;
    let codes = |name: &str| -> Vec<String> {
        let columns = about["columns"].as_array().unwrap();
        let column = columns.iter().find(|column| column["name"] == name).unwrap();
        column["names"].as_array().unwrap().iter().map(|name| name.as_str().unwrap().to_owned()).collect()
    };
    let mut seen = std::collections::BTreeSet::new();
    for (name, found) in names.into_iter().zip(answer.numbers.chunks(42)) {
        let codes = codes(name);
        let found: Vec<Option<String>> = found.iter().map(|code| named(&codes, *code)).collect();
        assert_eq!(found, map.names(name).unwrap(), "{name}");
        seen.extend(found.into_iter().flatten());
    }
    assert!(seen.len() > 5, "types and regimes of several kinds: {seen:?}");
    for (name, found) in numbers.into_iter().zip(answer.numbers[84..].chunks(42)) {
        let known = map.column(name).unwrap();
        assert!(
            found.iter().zip(&known).all(|(a, b)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()),
            "{name}"
        );
    }
}

/// The sweep file of a region gives the region again.
#[test]
fn the_file_of_a_region_is_its_sweep() {
    let mut wanted = region(true, &[]);
    wanted["ask"] = json!("file");
    wanted["at"]["theta"] = json!(0.02);
    let toml = open().answer(&wanted.to_string()).unwrap().head["toml"].as_str().unwrap().to_owned();
    let spec = parse(&toml);
    let options = Options { backend: Backend::Cpu, ..Options::default() };
    let map = squealmap::sweep::run::run(spec, &options, &|_| ()).unwrap();
    wanted["ask"] = json!("region");
    wanted["columns"] = json!(["growth_rate", "x2_std"]);
    let answer = open().answer(&wanted.to_string()).unwrap();
    assert_eq!(map.column("theta").unwrap(), [0.02; 42]);
    for (name, found) in ["growth_rate", "x2_std"].into_iter().zip(answer.numbers.chunks(42)) {
        let known = map.column(name).unwrap();
        assert!(
            found.iter().zip(&known).all(|(a, b)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()),
            "{name}"
        );
    }
}

/// The matrices of the two masses by hand: mass `m1` sits on the normal spring, and follows `m2` along the inclined contact.
#[test]
fn the_eigenvalues_of_a_cell_solve_its_characteristic_equation() {
    let wanted = json!({ "ask": "cell", "at": { "mu_s": 0.4, "mu_d": 0.2, "belt_velocity": 3.0 }, "periods": 0, "samples": 1 });
    let answer = open().answer(&wanted.to_string()).unwrap();
    let (m1, m2, k1, k2, c1, c2, theta) = (2.12, 0.18, 1e5, 1.01e5, 0.1, 0.1, 0.01_f64);
    let (s, c) = theta.sin_cos();
    let (mu, slope) = (0.4 - 0.2 * 3.0 / 5.0, -0.2 / 5.0);
    // T = μ N along, N = cos h − sin (m1 cos ẍ + g), statically N = c F − s k1 x: the equilibrium's normal force.
    let normal = answer.head["equilibrium"]["normal_force"].as_f64().unwrap();
    for (kind, mu, slope) in [("full", mu, slope), ("flat", mu, 0.0), ("frozen", 0.0, slope)] {
        let roots = answer.head["eigenvalues"][kind].as_array().unwrap();
        assert_eq!(roots.len(), 4);
        for root in roots {
            let part = |k: usize| root[k].as_f64().unwrap();
            let z = num_complex::Complex64::new(part(0), part(1));
            let (g, h) = (k1 + c1 * z, k2 + c2 * z);
            // Rows of x2 and y1: (m2 + m1 c²) ẍ + c g + s h = μ (c h − s (m1 c ẍ + g)) − μ' N0 ẋ, and m1 ÿ1 = h.
            let xx = z * z * (m2 + m1 * c * c + mu * m1 * c * s)
                + g * (c * c + mu * s * c)
                + h * (s * s - mu * c * s)
                + slope * normal * z;
            let xy = h * (mu * c - s);
            let yx = -h * s;
            let yy = m1 * z * z + h;
            let size = xx.norm() * yy.norm() + (xy * yx).norm();
            let scale = (m1 * z.norm_sqr() + k2).powi(2).max(size);
            assert!((xx * yy - xy * yx).norm() < 1e-9 * scale, "{kind}: {z}");
        }
    }
}

/// Whatever is asked, the answer is an answer or a sentence.
#[test]
fn questions_that_are_none_get_a_sentence() {
    let explorer = open();
    let with = |path: &[&str], value: serde_json::Value| {
        let mut question = region(false, &["type"]);
        let mut at = &mut question;
        for key in path {
            at = &mut at[*key];
        }
        *at = value;
        question.to_string()
    };
    let bad = [
        ("nonsense".to_owned(), "no question"),
        ("{}".to_owned(), "no question"),
        (r#"{"ask":"everything"}"#.to_owned(), "no question"),
        (with(&["x", "key"], json!("mu_q")), "`mu_q`"),
        (with(&["x", "key"], json!("law")), "`law`"),
        (with(&["x", "key"], json!("mu_s")), "both sides"),
        (with(&["x", "from"], json!(-0.1)), "`mu_d` is -0.1"),
        (with(&["x", "from"], json!("a")), "no question"),
        (with(&["x", "points"], json!(0)), "has 0 points"),
        (with(&["x", "points"], json!(2_000_000)), "2000000 points"),
        (with(&["y", "points"], json!(200_000)), "6 x 200000 cells"),
        (with(&["x", "values"], json!([0.0, 0.5])), "the 2 `values` of `mu_d` have to be 6 from 0 to 0.5"),
        (with(&["x", "values"], json!([0.0, 0.1, 0.2, -1.0, 0.4, 0.5])), "`mu_d` is -1"),
        (with(&["x", "log"], json!(true)), "above 0"),
        (with(&["at"], json!({})), "`belt_velocity`"),
        (with(&["at", "belt_velocity"], json!(-1)), "`belt_velocity` is -1"),
        (with(&["at", "belt_velocity"], json!("fast")), "has to be a number"),
        (with(&["at", "mu_d"], json!(0.1)), "on a side and in `at`"),
        (with(&["at", "law"], json!(3)), "has to be a name"),
        (with(&["columns"], json!(["depth"])), "no column `depth`"),
        (with(&["columns"], json!(["x2_std"])), "no column `x2_std`"),
        (r#"{"ask":"cell","at":{},"periods":1,"samples":10}"#.to_owned(), "mu_s"),
        (
            r#"{"ask":"cell","at":{"mu_s":0.1,"mu_d":0.1,"belt_velocity":1},"periods":1e9,"samples":10}"#
                .to_owned(),
            "2000",
        ),
        (
            r#"{"ask":"cell","at":{"mu_s":0.1,"mu_d":0.1,"belt_velocity":1},"periods":1,"samples":0}"#
                .to_owned(),
            "`samples` is 0",
        ),
    ];
    for (question, part) in bad {
        let sentence = explorer.answer(&question).unwrap_err();
        assert!(sentence.contains(part) && !sentence.contains('\n'), "{question}: {sentence}");
    }
    assert!(Explorer::open(b"{}").unwrap_err().contains("the sweep"));
}

/// A belt that moves is a part of the sweep: of its regions, of its file, and of what has no effect.
#[test]
fn a_stroke_stays_a_stroke() {
    let belt = "[belt]\nmotion = \"sine\"\nramp_duration = 0.2\n[axes]\n";
    let text =
        MAP.replace("settle = \"20 periods\"\nmeasure = \"10 periods\"\n", "").replace("[axes]\n", belt);
    let sine = Explorer::new(parse(&text)).unwrap();
    let asked = region(true, &["x2_std"]);
    let found = sine.answer(&asked.to_string()).unwrap().numbers;
    let mut wanted = asked.clone();
    wanted["ask"] = json!("file");
    let file = sine.answer(&wanted.to_string()).unwrap().head;
    let written = file["toml"].as_str().unwrap();
    let options = Options { backend: Backend::Cpu, ..Options::default() };
    let map = squealmap::sweep::run::run(parse(written), &options, &|_| ()).unwrap();
    let bits = |numbers: &[f64]| numbers.iter().map(|number| number.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&found), bits(&map.column("x2_std").unwrap()));
    let steady = open().answer(&asked.to_string()).unwrap().numbers;
    assert!(
        found.iter().zip(&steady).any(|(a, b)| (a - b).abs() > 0.1 * b.abs()),
        "a steady belt does something else"
    );

    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("stroke.csv"), "time,velocity\n0,0\n0.1,3\n0.2,1\n").unwrap();
    let text = "[belt]\nmotion = \"table\"\nmotion_table = \"stroke.csv\"\n[axes]\n\
                mu_s = { from = 0.0, to = 0.6, points = 7 }\nmu_d = { from = 0.0, to = 0.5, points = 6 }\n";
    let table = Explorer::new(Spec::parse(text, "s.toml", directory.path()).unwrap()).unwrap();
    let why = table.answer(&asked.to_string()).unwrap_err();
    assert!(why.contains("`belt_velocity` has no effect here"), "{why}");
    let about = table.answer(r#"{"ask":"about"}"#).unwrap().head;
    assert!(
        about["fixed"].as_array().unwrap().iter().all(|one| one["key"] != "belt_velocity"),
        "no slider without effect"
    );
    let mut asked = asked;
    asked["at"] = json!({});
    table.answer(&asked.to_string()).unwrap();
    asked["ask"] = json!("file");
    let why = table.answer(&asked.to_string()).unwrap_err();
    assert!(why.contains("`motion_table` of [belt] stands in a file of its own"), "{why}");
}
