//! Keys of a study beside those of the pin: what they build and what they refuse.

use std::f64::consts::{PI, TAU};

use squealmap_fem::study::document::Document;
use squealmap_fem::study::{Outcome, Study, compute, place, table, vary_table};

const PIN: &str = include_str!("study/pin.toml");

fn study(text: &str) -> Study {
    Study::new(Document::read(text).expect("TOML"), &|_| Err(String::new())).expect("a study")
}

fn computed(text: &str) -> (Study, Outcome) {
    let study = study(text);
    let outcome = compute(&study, &mut |_| ()).expect("results");
    (study, outcome)
}

/// The pin pressed with a force.
fn pressed(force: f64) -> String {
    PIN.replace(
        "set = \"pin.z1\"\n",
        &format!("set = \"pin.z1\"\naxes = \"xy\"\n\n[[loads]]\nset = \"pin.z1\"\nforce = {force}\n"),
    )
}

/// The pin pressed by its clamped end, of which two modes coalesce.
fn pushed() -> String {
    PIN.replace(
        "set = \"pin.z1\"\n",
        "set = \"pin.z1\"\naxes = \"xy\"\n\n[[supports]]\nset = \"pin.z1\"\naxes = \"z\"\ndisplacement = -1e-6\n",
    )
}

/// A part on the block in the place of the pin.
fn round(part: &str) -> Study {
    let from = PIN.find("[parts.pin]").expect("the pin");
    let to = PIN.find("[materials.steel]").expect("steel");
    study(&format!("{}[parts.pin]\n{part}\nmaterial = \"steel\"\n\n{}", &PIN[..from], &PIN[to..]))
}

/// A cylinder and a sector of a ring lie where they should; straight edges of cubic sums take volumes to a few 1e-4.
#[test]
fn round_parts_have_their_volume() {
    let cylinder = round(
        "kind = \"cylinder\"\nelement = \"hex20\"\ncentre = [0.015, 0.005, 0.01]\nradius = 0.004\nheight = 0.02\ncells = [2, 2, 3]",
    );
    let ring = round(
        "kind = \"ring\"\nelement = \"hex20\"\ncentre = [0.015, 0.0, 0.01]\nradii = [0.002, 0.006]\ndegrees = [60, 120]\nheight = 0.02\ncells = [2, 4, 3]",
    );
    for (study, area) in
        [(cylinder, PI * 0.004_f64.powi(2)), (ring, PI / 6.0 * (0.006_f64.powi(2) - 0.002_f64.powi(2)))]
    {
        // A unit pressure on an end is a force of its area.
        let faces = study.model.mesh.face_set("pin.z1").expect("an end").to_vec();
        let loads = squealmap_fem::assembly::Loads { pressure: vec![(faces, 1.0)], ..Default::default() };
        let force: f64 =
            squealmap_fem::assembly::nodal_forces(&study.model, &loads).iter().map(|f| f[2]).sum();
        assert!((force / area + 1.0).abs() < 1e-3, "{force} {area}");
        let top = study.model.mesh.nodes.iter().map(|x| x[2]).fold(0.0, f64::max);
        assert!((top - 0.03).abs() < 1e-12);
        assert!(study.model.contact.len() > 10);
    }
}

#[test]
fn round_parts_that_cannot_be_are_named() {
    let ring = "kind = \"ring\"\nelement = \"hex8\"\ncentre = [0, 0, 0.01]\nradii = [0.002, 0.006]\ndegrees = [0, 60]\nheight = 0.02\ncells = [1, 2, 1]";
    let from = PIN.find("[parts.pin]").expect("the pin");
    let to = PIN.find("[materials.steel]").expect("steel");
    for (old, new, wanted) in [
        ("height = 0.02", "height = 0", "parts.pin.height: 0 m is no length, it must be above 0"),
        ("[1, 2, 1]", "[1, 0, 1]", "parts.pin.cells: [1, 0, 1] elements, there must be at least 1 each way"),
        (
            "[0, 60]",
            "[60, 0]",
            "parts.pin.degrees: a ring goes from 60 to 0 degrees, which must rise, by 360 at most",
        ),
        (
            "[1, 2, 1]",
            "[1000, 1000, 1000]",
            "parts.pin: the block has 1000 x 1000 x 1000 elements, it may have 2000000",
        ),
    ] {
        assert!(ring.contains(old), "{old}");
        let part = ring.replacen(old, new, 1);
        let text = format!("{}[parts.pin]\n{part}\nmaterial = \"steel\"\n\n{}", &PIN[..from], &PIN[to..]);
        let read = Document::read(&text).and_then(|document| Study::new(document, &|_| Err(String::new())));
        let error = read.map(drop).expect_err(new).to_string();
        assert!(error.starts_with(wanted), "{error}");
    }
}

/// A band without modes is no empty table.
#[test]
fn a_band_has_to_hold_a_mode() {
    let text = PIN.replace("points = 26", "points = 2").replace("count = 7", "count = 7\nband = [1e6, 2e6]");
    let error = compute(&study(&text), &mut |_| ()).map(drop).expect_err("no mode").to_string();
    assert!(
        error.starts_with(
            "modes.band: none of the 7 modes that are followed lies in the band; the highest has 64"
        ),
        "{error}"
    );
}

/// Damping of a mode by itself and by its material together may not stop it from vibrating.
#[test]
fn ratios_that_add_up_to_one_are_refused() {
    let text = PIN
        .replace("points = 26", "points = 2")
        .replace("density = 7800", "density = 7800\nloss_factor = 1.0");
    let text = text.replace("count = 7", "count = 2\ndamping_ratios = [0.0, 0.5]");
    let error = compute(&study(&text), &mut |_| ()).map(drop).expect_err("half and half").to_string();
    assert!(
        error.starts_with(
            "modes.damping_ratios: with half the loss of its materials the ratio of mode 2 is 1.000"
        ),
        "{error}"
    );
}

/// A table at a temperature between two rows is the material half-way: frequencies go with the root of its modulus.
#[test]
fn a_table_is_read_at_the_temperature() {
    let few = PIN.replace("points = 26", "points = 2");
    let (_, plain) = computed(&few);
    let rows = "table = [{ temperature = 20, young = 210e9, poisson = 0.3 }, { temperature = 220, young = 130e9, poisson = 0.3 }]";
    let hot = few.replace("young = 210e9\npoisson = 0.3", rows);
    let hot = hot.replacen("title", "temperature = 120.0\ntitle", 1);
    let (_, hot) = computed(&hot);
    for (a, b) in plain.real.iter().zip(&hot.real) {
        assert!((b / a - (170.0_f64 / 210.0).sqrt()).abs() < 1e-9, "{a} {b}");
    }
}

/// Without friction a mode decays with ζ ω: by its own ratio, and by half the loss factor where one material has all energy.
#[test]
fn modes_are_damped_one_by_one() {
    let text = PIN
        .replace("points = 26", "points = 2")
        .replace("count = 7", "count = 7\ndamping_ratios = [0.01, 0.0, 0.003]");
    let lossy = text.replace("density = 7800", "density = 7800\nloss_factor = 0.004");
    for (text, more) in [(text, 0.0), (lossy, 0.002)] {
        let (_, outcome) = computed(&text);
        assert!(outcome.damped);
        for (mode, own) in outcome.modes.iter().zip([0.01, 0.0, 0.003, 0.0, 0.0, 0.0, 0.0]) {
            let lambda = mode.states[0].lambda;
            assert!((-lambda.re / lambda.norm() - own - more).abs() < 1e-9, "{lambda} {own}");
        }
    }
}

/// Attribution of a mode that falling friction alone makes grow: without the slope nothing is left of it, without the feedback all at μ = 0.
#[test]
fn one_mechanism_alone_stands_in_the_table() {
    let text = pushed().replace("points = 26 }", "points = 26 }\nslope = -0.01");
    let (study, outcome) = computed(&text);
    let file = String::from_utf8(table(&study, &outcome)).expect("UTF-8");
    let rows: Vec<Vec<f64>> = file
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|word| word.parse().expect("a number")).collect())
        .collect();
    let flat = computed(&pushed()).1;
    for row in &rows {
        if row[0] == 0.0 {
            // No feedback at μ = 0, and no growth without the slope.
            assert!((row[9] - row[3]).abs() < 1e-6 * row[3].abs().max(1.0) && row[8].abs() < 1e-3, "{row:?}");
        }
    }
    // Without the slope the modes are those of the study without it.
    let last = rows.iter().filter(|row| (row[0] - 0.5).abs() < 1e-12);
    let grown = |growths: Vec<f64>| growths.into_iter().fold(0.0, f64::max);
    let without = grown(last.map(|row| row[8]).collect());
    let own = grown(flat.modes.iter().map(|mode| mode.states[25].lambda.re).collect());
    assert!(own > 1000.0 && (without - own).abs() < 1e-6 * own, "{without} {own}");
}

/// A variation over the load leaves undamped modes alone, one over the moduli moves them with the root, and both stand in a table.
#[test]
fn another_parameter_is_varied() {
    let few = pressed(1700.0).replace("points = 26", "points = 2");
    for (parameter, power) in [("\"load\"", 0.0), ("\"stiffness\"\nmaterial = \"steel\"", 0.5)] {
        let text = format!(
            "{few}\n[vary]\nparameter = {parameter}\nmu = 0.1\nvalues = {{ values = [0.5, 1.0, 2.0] }}\n"
        );
        let (study, outcome) = computed(&text);
        let file = String::from_utf8(vary_table(&study, &outcome).expect("a table")).expect("UTF-8");
        assert_eq!(file.lines().count(), 1 + 3 * outcome.modes.len());
        let found = outcome.variation.expect("a variation");
        for mode in &found.modes {
            for (state, value) in mode.states.iter().zip(&found.values) {
                let wanted = mode.states[1].lambda.im * value.powf(power);
                assert!(
                    (state.lambda.im / wanted - 1.0).abs() < 1e-7,
                    "{value}: {} {wanted}",
                    state.lambda.im / TAU
                );
            }
        }
    }
}

/// The stress of the static step: what is reported without it are the frequencies of the study without it.
#[test]
fn stress_stiffens_and_its_effect_is_reported() {
    let few = pressed(20_000.0).replace("points = 26", "points = 2");
    let (_, plain) = computed(&few);
    let (_, stressed) = computed(&few.replace("count = 7", "count = 7\nstressed = true"));
    let without = stressed.unstressed.expect("frequencies");
    for ((a, b), with) in plain.real.iter().zip(&without).zip(&stressed.real) {
        assert!((a / b - 1.0).abs() < 1e-10, "{a} {b}");
        assert!(with < a, "compression softens: {with} {a}");
    }
}

#[test]
#[expect(clippy::too_many_lines, reason = "a row for every input")]
fn bad_keys_are_named_with_their_place() {
    let varied = |rest: &str| format!("[vary]\n{rest}\n\n[modes]");
    let range = "values = { values = [1.0, 2.0] }";
    for (old, new, wanted, at) in [
        ("poisson = 0.3\n", "", "materials.steel: it needs either young and poisson, or a table", "steel"),
        (
            "young = 210e9\npoisson = 0.3\n",
            "table = [{ temperature = 20, young = 1e9, poisson = 0.3 }]\n",
            "materials.steel.table: it has a table over temperature, but the study has no temperature",
            "[{ temperature = 20, young = 1e9, poisson = 0.3 }]",
        ),
        (
            "density = 7800",
            "density = 7800\nloss_factor = 3.0",
            "materials.steel.loss_factor: 3 is no loss factor",
            "3.0",
        ),
        (
            "count = 7",
            "count = 2\ndamping_ratios = [0.1, 0.1, 0.1]",
            "modes.damping_ratios: there are 3 for 2 modes",
            "[0.1, 0.1, 0.1]",
        ),
        (
            "count = 7",
            "count = 2\ndamping_ratios = [1.0]",
            "modes.damping_ratios: 1 is no damping ratio",
            "[1.0]",
        ),
        (
            "count = 7",
            "count = 7\nstressed = true",
            "modes.stressed: the stress is that of a load, but nothing presses",
            "true",
        ),
        (
            "[modes]",
            &varied(&format!("parameter = \"load\"\nmu = 0.1\n{range}")),
            "vary.parameter: it acts through the pressure",
            "\"load\"",
        ),
        (
            "[modes]",
            &varied(&format!("parameter = \"stiffness\"\nmu = 0.1\n{range}")),
            "vary.material: none is named: name the material",
            "vary",
        ),
        (
            "[modes]",
            &varied(&format!("parameter = \"damping\"\nmu = 0.1\n{range}")),
            "vary.parameter: no material has Rayleigh damping",
            "\"damping\"",
        ),
        (
            "[modes]",
            &varied(&format!("parameter = \"contact_stiffness\"\nmu = 0.1\n{range}")),
            "vary.parameter: the surfaces do not overlap",
            "\"contact_stiffness\"",
        ),
        (
            "[modes]",
            &varied(&format!("parameter = \"colour\"\nmu = 0.1\n{range}")),
            "line 40: vary.parameter: unknown variant `colour`",
            "\"colour\"",
        ),
        (
            "[modes]",
            &varied("parameter = \"slope\"\nmu = 0.1\nvalues = { values = [2.0, 1.0] }"),
            "vary.values: 1 follows 2: let the values rise",
            "values",
        ),
        (
            "[modes]",
            "[output]\nmodal = true\nkn = [1e12, 1e14]\n\n[modes]",
            "output.kn: the surfaces do not overlap",
            "[1e12, 1e14]",
        ),
        (
            "[modes]",
            "[output]\nkn = [1e14, 1e12]\n\n[modes]",
            "output.kn: the range is 1e14 to 1e12 Pa/m, it must rise",
            "[1e14, 1e12]",
        ),
        (
            "cells = [2, 2, 5]",
            "cells = [2, 0, 5]",
            "parts.pin.cells: [2, 0, 5] elements, there must be at least 1 each way",
            "[2, 0, 5]",
        ),
        (
            "density = 7800",
            "density = 7800\nloss_factor = 2.0",
            "materials.steel.loss_factor: 2 is no loss factor, it must be 0 or more and below 2",
            "2.0",
        ),
        (
            "points = 26 }",
            "points = 26 }\ncontact_stiffness = 1e11\n\n[output]\nmodal = true\nkn = [1e12, 1e14]",
            "output.kn: the range is 1e12 to 1e14 Pa/m, but friction.contact_stiffness is 1e11",
            "[1e12, 1e14]",
        ),
        // What `run` would refuse is refused before hours are spent on it.
        (
            "[modes]",
            "[output]\nmodal = true\n\n[modes]",
            "output.modal: maps need a load, which a slope of friction acts on, but nothing presses",
            "true",
        ),
        (
            "points = 26 }",
            "points = 26 }\nstatic_mu = 0.3",
            "friction.static_mu: it is the friction of the static step, but nothing presses",
            "0.3",
        ),
        (
            "[modes]",
            "[[loads]]\nset = \"pin.z1\"\nforce = 1.0\n\n[modes]",
            "loads[0].set: supports hold all nodes of \"pin.z1\" along the load, so that it presses nothing",
            "\"pin.z1\"",
        ),
        (
            "direction = [1, 0, 0]",
            "direction = [nan, 0, 0]",
            "sliding[0].direction: NaN is no finite number",
            "[nan, 0, 0]",
        ),
        (
            "young = 210e9",
            "young = 1e300",
            "material steel: Young's modulus is 1e300 Pa, it must be 1e-100 to 1e100: check its unit",
            "steel",
        ),
        // Parts by their keys, each at its place.
        (
            "cells = [2, 2, 5]",
            "cells = [2, 2.5, 5]",
            "line 17: parts.pin.cells: invalid type: floating point `2.5`, expected a whole number",
            "2.5",
        ),
        (
            "cells = [2, 2, 5]",
            "cells = [2, 2, 5]\nradius = 0.1",
            "parts.pin.radius: a block has no such key, it has element, origin, size, cells, material",
            "0.1",
        ),
        (
            "cells = [2, 2, 5]\n",
            "",
            "parts.pin.cells: it is missing: a block has element, origin, size, cells, material",
            "pin",
        ),
        (
            "cells = [2, 2, 5]",
            "cellls = [2, 2, 5]",
            "line 17: unknown field `cellls`, expected one of `kind`",
            "cellls",
        ),
        ("[modes]", "[axes]\nmu_s = 1\n\n[modes]", "line 39: unknown field `axes`", "axes"),
    ] {
        assert!(PIN.contains(old), "{old}");
        let text = PIN.replacen(old, new, 1);
        let read = Document::read(&text).and_then(|document| Study::new(document, &|_| Err(String::new())));
        let error = read.map(drop).expect_err(new);
        let said = error.to_string();
        assert!(said.starts_with(wanted) && !said.contains('\n'), "{said}\n{wanted}");
        let span = place(&text, &error).expect("a place");
        assert_eq!(&text[span], at, "{said}");
    }
}
