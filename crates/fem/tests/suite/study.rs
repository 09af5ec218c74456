//! Studies from descriptions in TOML: what is computed, and what is refused.

use squealmap_fem::Error;
use squealmap_fem::assembly::{Model, assemble};
use squealmap_fem::modes::{Factor, Ordering, lowest};
use squealmap_fem::study::document::Document;
use squealmap_fem::study::{COLUMNS, Event, Outcome, Study, compute, estimate, manifest, shapes, table};

const PIN: &str = include_str!("study/pin.toml");

fn no_file(path: &str) -> Result<String, String> {
    Err(format!("{path} is not there"))
}

fn read(text: &str) -> Result<Study, Error> {
    Study::new(Document::read(text)?, &no_file)
}

fn computed(text: &str) -> (Study, Outcome) {
    let study = read(text).expect("a study");
    let mut steps = Vec::new();
    let outcome = compute(&study, &mut |step| steps.push(step.to_owned())).expect("results");
    assert_eq!(steps, outcome.seconds.iter().map(|(name, _)| *name).collect::<Vec<_>>());
    (study, outcome)
}

/// The pin on the block as a description: the numbers of an independent program.
#[test]
fn the_pin_comes_from_its_description() {
    let (study, outcome) = computed(PIN);
    for (published, found) in
        [16_087.39, 16_690.00, 30_126.49, 55_767.81, 63_371.81].iter().zip(&outcome.real)
    {
        assert!((published - found).abs() < 0.006, "{published} {found}");
    }
    let [only] = outcome.transitions.as_slice() else { panic!("{:?}", outcome.transitions) };
    assert_eq!(only.event, Event::Coalescence);
    assert!((only.mu - 0.38838).abs() < 6e-6, "{}", only.mu);
    // Those of 63.86 and 64.42 kHz.
    assert_eq!(only.modes, [5, 6]);

    let text = String::from_utf8(table(&study, &outcome)).expect("UTF-8");
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("a heading").split(',').collect();
    assert_eq!(names, COLUMNS.map(|column| column.name));
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|word| word.parse().expect("a number")).collect()).collect();
    assert_eq!(rows.len(), 26 * 7);
    let unstable: Vec<&Vec<f64>> = rows.iter().filter(|row| row[5] > 0.5).collect();
    // One of both grows at 0.4, 0.42, …, 0.5.
    assert_eq!(unstable.len(), 6, "{unstable:?}");
    let first = unstable[0];
    assert!((first[0] - 0.4).abs() < 1e-15);
    assert!((first[2] - 64_170.82).abs() < 0.006 && (first[3] - 431.41).abs() < 0.006, "{first:?}");
    let omega = std::f64::consts::TAU * first[2];
    assert!((first[4] + first[3] / omega.hypot(first[3])).abs() < 1e-14, "{first:?}");
    assert!(rows.iter().all(|row| row[6] <= 1e-6 && row[7] == 0.0));

    let manifest: serde_json::Value =
        serde_json::from_slice(&manifest(&study, &outcome, PIN, "squealmap 1")).expect("JSON");
    assert_eq!(manifest["unknowns"], 873);
    assert_eq!(manifest["contact"]["kind"], "multipliers");
    assert_eq!(manifest["transitions"][0]["modes"], serde_json::json!([6, 7]));
    assert_eq!(manifest["description"], PIN);

    // By default the two modes of the transition at both ends of the range.
    let marks: Vec<(usize, f64)> = outcome.shapes.iter().map(|shape| (shape.mode, shape.mu)).collect();
    assert_eq!(marks, [(5, 0.0), (6, 0.0), (5, 0.5), (6, 0.5)]);
    let file = String::from_utf8(shapes(&study, &outcome)).expect("UTF-8");
    assert!(file.contains("Name=\"mode 6 at mu 0, 63864.1 Hz, 0.0 1/s real\""), "{}", &file[..2000]);
    for shape in &outcome.shapes {
        let largest = shape.displacement.iter().flatten().map(|z| z.norm()).fold(0.0, f64::max);
        assert!((largest - 1.0).abs() < 1e-12);
        // Clamped nodes stand still.
        let held = study.model.mesh.node_set("block.z0").expect("a side");
        assert!(held.iter().all(|node| shape.displacement[*node].iter().all(|z| z.norm() == 0.0)));
    }
}

/// The band says what is written, the number of modes what is followed.
#[test]
fn a_band_leaves_modes_out() {
    let text =
        PIN.replace("count = 7", "count = 50\nband = [30e3, 64e3]").replace("points = 26", "points = 2");
    let (study, outcome) = computed(&text);
    // 16.1, 16.7, 30.1, 55.8, 63.4, 63.9 kHz lie below 64 kHz.
    assert_eq!(outcome.modes.len(), 6);
    let text = String::from_utf8(table(&study, &outcome)).expect("UTF-8");
    assert_eq!(text.lines().count(), 1 + 2 * 4);
}

/// With damping β times the stiffness of everything, friction included, λ² + β θ λ + θ = 0 with the θ of the undamped problem. Where its
/// root begins to grow is found here by bisection.
#[test]
fn a_damped_mode_begins_to_grow_where_it_should() {
    let beta = 1e-9;
    let text = PIN.replace("density = 7800", &format!("density = 7800\nrayleigh = [0.0, {beta}]"));
    let (study, damped) = computed(&text);
    assert!(damped.damped);
    let [onset] = damped.transitions.as_slice() else { panic!("{:?}", damped.transitions) };
    assert_eq!(onset.event, Event::Onset);
    let growth = |mu: f64| -> f64 {
        let one = PIN.replace("{ from = 0.0, to = 0.5, points = 26 }", &format!("{{ values = [{mu}] }}"));
        let (_, outcome) = computed(&one);
        let grown =
            outcome.modes.iter().map(|mode| mode.states[0].lambda).max_by(|a, b| a.re.total_cmp(&b.re));
        let lambda = grown.expect("a mode");
        let theta = -(lambda * lambda);
        // The root with a positive frequency.
        let root = (theta * theta * beta * beta / 4.0 - theta).sqrt();
        let root = if root.im < 0.0 { -root } else { root };
        (root - theta * (beta / 2.0)).re
    };
    let (mut low, mut high) = (0.385, 0.42);
    assert!(growth(low) < 0.0 && growth(high) > 0.0);
    for _ in 0..24 {
        let middle = f64::midpoint(low, high);
        if growth(middle) > 0.0 { high = middle } else { low = middle }
    }
    assert!(onset.mu > 0.3884, "later than without damping");
    assert!((onset.mu - low).abs() < 1e-7, "{} {low}", onset.mu);
    assert!(study.model.materials[0].rayleigh[1] > 0.0);
}

/// Falling friction makes two modes grow that differ by a few percent; each ends to grow where it does itself, not where the other does.
#[test]
fn a_mode_that_ends_to_grow_is_not_taken_for_its_neighbour() {
    let text = include_str!("study/disc.toml");
    let (_, outcome) = computed(text);
    assert!(outcome.transitions.len() > 1);
    for t in &outcome.transitions {
        let values = format!("{{ values = [{}, {}] }}", t.mu - 1e-6, t.mu + 1e-6);
        let (_, near) = computed(&text.replace("{ from = 0.0, to = 0.5, points = 11 }", &values));
        let growth = |i: usize| {
            let states = near.modes.iter().map(|mode| mode.states[i].lambda);
            let apart = |lambda: &faer::c64| (lambda.im / std::f64::consts::TAU - t.frequency).abs();
            states.min_by(|a, b| apart(a).total_cmp(&apart(b))).expect("a mode").re
        };
        let [before, after] = [growth(0), growth(1)];
        assert!(
            before * after < 0.0 && (before < 0.0) == (t.event == Event::Onset),
            "{t:?}: {before} {after}"
        );
    }
}

/// A contact stiffness stands in the manifest, and a stiff one comes to the multipliers.
#[test]
fn a_contact_stiffness_is_stated() {
    let text = PIN.replace("points = 26 }", "points = 26 }\ncontact_stiffness = 1e18");
    let (study, outcome) = computed(&text);
    assert!((outcome.transitions[0].mu - 0.38838).abs() < 1e-4, "{:?}", outcome.transitions);
    let manifest: serde_json::Value =
        serde_json::from_slice(&manifest(&study, &outcome, &text, "squealmap 1")).expect("JSON");
    assert_eq!(manifest["contact"]["contact_stiffness"], 1e18);
}

/// A force is spread over its surface, and all of it arrives in the contact.
#[test]
fn a_force_presses_the_surfaces() {
    let text = PIN.replace(
        "set = \"pin.z1\"\n",
        "set = \"pin.z1\"\naxes = \"xy\"\n\n[[loads]]\nset = \"pin.z1\"\nforce = 17.0\n",
    );
    let (study, outcome) = computed(&text.replace("points = 26", "points = 2"));
    let pressed = outcome.pressed.expect("a static step");
    assert!((pressed.force - 17.0).abs() < 1e-9, "{}", pressed.force);
    assert_eq!(pressed.open, 0);
    let pressure = study.loads.pressure[0].1;
    assert!((pressure * 1e-4 - 17.0).abs() < 1e-9, "{pressure} Pa on a square centimetre");
}

#[test]
fn a_cost_is_told_before() {
    let study = read(PIN).expect("a study");
    let cost = estimate(&study).expect("a cost");
    let (_, pencil) = assemble(&study.model).expect("matrices");
    assert_eq!((cost.unknowns, cost.points), (pencil.size(), 21));
    // Two factors at a time.
    assert!(cost.memory > 16.0 * cost.entries as f64 && cost.seconds > 0.0);
}

/// What the first lines of a message have to be, for a description in which one text takes the place of another.
#[test]
#[expect(clippy::too_many_lines, reason = "a row for every input")]
fn bad_descriptions_are_named() {
    for (old, new, wanted) in [
        ("title", "titel", "line 2: unknown field `titel`, expected one of"),
        (
            "cells = [6, 2, 2]",
            "cells = [6, 2]",
            "line 9: parts.block.cells: invalid length 2, expected an array of length 3",
        ),
        (
            "cells = [6, 2, 2]",
            "cells = [6, 0, 2]",
            "parts.block.cells: [6, 0, 2] elements, there must be at least 1 each way",
        ),
        (
            "element = \"hex20\"\norigin = [0.0,",
            "element = \"hex21\"\norigin = [0.0,",
            "parts.block.element: \"hex21\" is no element, it must be",
        ),
        (
            "size = [0.03,",
            "size = [-0.03,",
            "parts.block: the block is -0.03 m long along x, it must be longer than 0",
        ),
        (
            "kind = \"block\"\nelement = \"hex20\"\norigin = [0.0,",
            "kind = \"ball\"\nelement = \"hex20\"\norigin = [0.0,",
            "line 5: parts.block.kind: unknown variant `ball`, expected one of `block`, `cylinder`, `ring`, `mesh`",
        ),
        (
            "[materials.steel]",
            "[materials.iron]",
            "parts.block.material: there is no material \"steel\" (iron): describe it as [materials.steel]",
        ),
        (
            "poisson = 0.3",
            "poisson = 0.5",
            "material steel: Poisson's ratio is 0.5, it must lie between -1 and 0.5",
        ),
        (
            "poisson = 0.3",
            "poisson = [0.3, 0.3, 0.3]",
            "materials.steel: young and poisson are one number each, or three each",
        ),
        (
            "young = 210e9",
            "young = \"stiff\"",
            "line 21: materials.steel.young: \"stiff\" is neither a number nor three of them in brackets",
        ),
        (
            "density = 7800",
            "density = 7800\nrayleigh = [-1.0, 0.0]",
            "materials.steel.rayleigh: -1 must be 0 or more",
        ),
        (
            "set = \"block.z0\"",
            "set = \"block.z2\"",
            "supports[0].set: the mesh has no set \"block.z2\"; it has block.x0, block.x1,",
        ),
        (
            "set = \"block.z0\"",
            "set = \"block.z0\"\naxes = \"xw\"",
            "supports[0].axes: \"xw\" names no axes, it must be of x, y and z",
        ),
        (
            "[[supports]]\nset = \"block.z0\"",
            "[[supports]]\nset = \"pin.z1\"\naxes = \"z\"\ndisplacement = -1e-6\n[[supports]]\nset = \"pin.z1\"\n[[supports]]\nset = \"block.z0\"",
            "supports[0].displacement: -0.000001 m is given to \"pin.z1\", but supports after it hold all",
        ),
        (
            "slaves = \"pin.z0\"",
            "slaves = \"pin.foot\"",
            "sliding[0].slaves: the mesh has no set \"pin.foot\"",
        ),
        ("masters = \"block.z1\"", "masters = \"pin.z0\"", "sliding[0]: \"pin.z0\" and \"pin.z0\" have node"),
        (
            "masters = \"block.z1\"",
            "masters = \"block.x1\"",
            "sliding[0]: the surfaces of a contact lie up to",
        ),
        (
            "origin = [0.01, 0.0, 0.01]",
            "origin = [0.05, 0.0, 0.01]",
            "sliding[0]: the two surfaces of a contact share no area",
        ),
        (
            "direction = [1, 0, 0]",
            "direction = [1, 0, 1]",
            "sliding[0]: the direction of sliding leaves the surface",
        ),
        (
            "direction = [1, 0, 0]",
            "axis = [0, 0, 1]",
            "sliding[0]: it needs either a direction, or an axis and its origin",
        ),
        ("[[sliding]]\nslaves", "[[bonds]]\nslaves", "line 34: unknown field `direction`, expected one of"),
        (
            "{ from = 0.0, to = 0.5, points = 26 }",
            "{ from = 0.0, to = 0.5, points = 1 }",
            "friction.mu.points: there are 1 points, a range has 2 to",
        ),
        (
            "{ from = 0.0, to = 0.5, points = 26 }",
            "{ from = 0.0, to = 0.5 }",
            "friction.mu: it needs either from, to and points, or values",
        ),
        (
            "{ from = 0.0, to = 0.5, points = 26 }",
            "{ values = [0.2, 0.1] }",
            "friction.mu: 0.1 follows 0.2: let the values rise",
        ),
        (
            "{ from = 0.0, to = 0.5, points = 26 }",
            "{ values = [-0.2] }",
            "friction.mu: -0.2 is no coefficient of friction",
        ),
        (
            "points = 26 }",
            "points = 26 }\ncontact_stiffness = 0.0",
            "friction.contact_stiffness: 0 Pa/m is no stiffness, it must be above 0",
        ),
        (
            "points = 26 }",
            "points = 26 }\nslope = -0.01",
            "friction.slope: a slope acts on the pressure, but nothing presses",
        ),
        ("count = 7", "count = 0", "modes.count: 0 modes are asked for, it must be 1 to"),
        ("count = 7", "band = [2.0, 1.0]", "modes.band: the band is 2 to 1 Hz, it must rise"),
        (
            "count = 7",
            "residual = 1.0",
            "modes.residual: the residual is 1, it must be above 0 and at most 0.01",
        ),
        (
            "[modes]",
            "[output]\nshapes_at = [0.31]\n\n[modes]",
            "output.shapes_at[0]: 0.31 is not among the values of friction.mu",
        ),
        (
            "[modes]",
            "[[loads]]\nset = \"pin.z1\"\n\n[modes]",
            "loads[0]: it needs either a pressure or a force: give one of both",
        ),
    ] {
        assert!(PIN.contains(old), "{old}");
        let error = read(&PIN.replacen(old, new, 1)).map(drop).expect_err(new).to_string();
        assert!(error.starts_with(wanted), "{new}\n  {error}\n  {wanted}");
        assert!(!error.contains('\n'), "{error}");
    }
}

/// What is seen when the matrices are made: a part on its own, a body that can move.
#[test]
fn bodies_that_nothing_holds_are_refused() {
    let fails = |text: &str| {
        compute(&read(text).expect("a description"), &mut |_| ()).map(drop).expect_err("not held").to_string()
    };
    let sideways = PIN.replace("set = \"block.z0\"", "set = \"block.z0\"\naxes = \"xz\"");
    let sideways = sideways.replace("set = \"pin.z1\"", "set = \"pin.z1\"\naxes = \"xz\"");
    let error = fails(&sideways);
    assert!(
        error.starts_with("the stiffness matrix is singular: a body can move without a force"),
        "{error}"
    );
    let alone = PIN.replace(
        "[materials.steel]",
        "[parts.lost]\nkind = \"block\"\nelement = \"hex8\"\norigin = [0.5, 0.5, 0.5]\nsize = [0.1, 0.1, 0.1]\ncells = [2, 1, 1]\n\
         material = \"steel\"\n\n[materials.steel]",
    );
    let error = fails(&alone);
    assert!(
        error.starts_with("parts of the mesh hang on nothing, 1 in all, the smallest of 2 elements"),
        "{error}"
    );
    let many = PIN.replace("count = 7", "count = 500");
    let many = many
        .replace("cells = [6, 2, 2]", "cells = [1, 1, 1]")
        .replace("cells = [2, 2, 5]", "cells = [1, 1, 1]");
    let error = fails(&many.replace("masters = \"block.z1\"", "masters = \"rigid\""));
    assert!(error.starts_with("modes.count: 500 modes are asked for, but the model has"), "{error}");
}

/// Meshes from files: sets by the part's name, materials, supports and ties of an `.inp` file.
#[test]
fn parts_come_from_files() {
    let bar = include_str!("files/bar_hex20.msh");
    let text = PIN.replacen(
        "kind = \"block\"\nelement = \"hex20\"\norigin = [0.0, 0.0, 0.0]\nsize = [0.03, 0.01, 0.01]\ncells = [6, 2, 2]\nmaterial = \"steel\"",
        "kind = \"mesh\"\nfile = \"bar.msh\"\nscale = 0.01\nmaterials = [\"steel\"]",
        1,
    );
    let give = |path: &str| if path == "bar.msh" { Ok(bar.to_owned()) } else { no_file(path) };
    let error = Study::new(Document::read(&text).expect("TOML"), &give)
        .map(drop)
        .expect_err("other sets")
        .to_string();
    assert!(error.starts_with("supports[0].set: the mesh has no set \"block.z0\"; it has block."), "{error}");
    let error = read(&text).map(drop).expect_err("no file").to_string();
    assert_eq!(error, "parts.block.file: `bar.msh`: bar.msh is not there");
    let broken = |_: &str| Ok(bar.replacen("$Nodes", "$Nodes\nmany", 1));
    let error =
        Study::new(Document::read(&text).expect("TOML"), &broken).map(drop).expect_err("broken").to_string();
    assert!(error.starts_with("parts.block.file: `bar.msh`: line "), "{error}");
    let error = Study::new(Document::read(&text.replace("scale = 0.01", "scale = 0")).expect("TOML"), &give);
    assert!(
        error.map(drop).expect_err("no scale").to_string().starts_with("parts.block.scale: 0 is no scale")
    );
}

/// A bar that stands on a rigid plane.
const BAR: &str = r#"
[parts.bar]
kind = "mesh"
file = "FILE"
scale = 1.0
MATERIALS

[materials.steel]
young = 210e9
poisson = 0.3
density = 7800

SUPPORT

[[sliding]]
slaves = "bar.SLAVES"
masters = "rigid"
direction = [0, 1, 0]

[friction]
mu = { values = [0.0] }

[modes]
count = 4
"#;

/// The bar of a file is the bar of its reader; twice as large, it has half the frequencies.
#[test]
fn bars_come_from_files() {
    let msh = include_str!("files/bar_hex20.msh");
    // The top of the bar as a surface: that of its two upper elements.
    let inp = include_str!("files/bar_hex20.inp").replacen(
        "*MATERIAL",
        "*SURFACE, NAME=TOP\n8, S2\n10, S2\n*MATERIAL",
        1,
    );
    let give = |path: &str| Ok(if path == "bar.msh" { msh.to_owned() } else { inp.clone() });
    let frequencies = |text: &str| {
        let study = Study::new(Document::read(text).expect("TOML"), &give).expect("a study");
        compute(&study, &mut |_| ()).expect("results").real[..4].to_vec()
    };
    let of_gmsh = BAR
        .replace("FILE", "bar.msh")
        .replace("MATERIALS", "materials = [\"steel\"]")
        .replace("SUPPORT", "[[supports]]\nset = \"bar.bottom\"")
        .replace("SLAVES", "top");
    let found = frequencies(&of_gmsh);
    let mesh = squealmap_fem::read::gmsh(msh).expect("a mesh");
    let mut model = Model { mesh, materials: vec![crate::cases::steel()], ..Model::default() };
    model.supports.clamp(model.mesh.node_set("bottom").expect("a set"));
    let top = model.mesh.node_set("top").expect("a set").to_vec();
    model.supports.prescribe(&top, 2, 0.0);
    let (_, pencil) = assemble(&model).expect("matrices");
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    let exact = lowest(&pencil, &factor, 4).expect("modes").frequencies();
    // Materials and supports of the deck, and a surface of it.
    let of_deck = BAR
        .replace("FILE", "bar.inp")
        .replace("MATERIALS", "")
        .replace("SUPPORT", "")
        .replace("SLAVES", "TOP");
    let larger = frequencies(&of_gmsh.replace("scale = 1.0", "scale = 2.0\nshift = [1.0, -2.0, 3.0]"));
    for (((exact, found), deck), larger) in exact.iter().zip(&found).zip(frequencies(&of_deck)).zip(&larger) {
        assert!((found / exact - 1.0).abs() < 1e-9, "{found} {exact}");
        assert!((deck / exact - 1.0).abs() < 1e-9, "{deck} {exact}");
        assert!((2.0 * larger / exact - 1.0).abs() < 1e-9, "{larger} {exact}");
    }
    let two = of_gmsh.replace("[\"steel\"]", "[]");
    let error = Study::new(Document::read(&two).expect("TOML"), &give)
        .map(drop)
        .expect_err("no material")
        .to_string();
    assert!(
        error.starts_with("parts.bar.materials: there are 0 materials for 1 physical volume(s)"),
        "{error}"
    );
}
