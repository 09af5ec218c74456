//! `squealmap fem`: a small study from its description to its files.

use std::path::Path;
use std::process::Command;

/// A pin on a block; two of its modes coalesce.
const PIN: &str = include_str!("../../../crates/fem/tests/suite/study/pin.toml");
const FILES: [&str; 12] = [
    "fem.csv",
    "manifest.json",
    "shapes.vtu",
    "fem.svg",
    "fem.png",
    "shapes.svg",
    "shapes.png",
    "mesh.svg",
    "mesh.png",
    "vary.csv",
    "vary.svg",
    "vary.png",
];

/// The same, pressed by its clamped end.
fn pushed() -> String {
    PIN.replace(
        "set = \"pin.z1\"\n",
        "set = \"pin.z1\"\naxes = \"xy\"\n\n[[supports]]\nset = \"pin.z1\"\naxes = \"z\"\ndisplacement = -1e-6\n",
    )
}

fn squealmap(directory: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_squealmap"));
    let output = command.current_dir(directory).args(arguments).output().expect("as the test has set it up");
    let [said, noted] = [output.stdout, output.stderr]
        .map(|bytes| String::from_utf8(bytes).expect("as the test has set it up"));
    (output.status.code().expect("as the test has set it up"), said, noted)
}

#[test]
fn a_study_gives_its_table_figures_and_shapes() {
    let directory = tempfile::tempdir().expect("as the test has set it up");
    let text = pushed().replace("points = 26", "points = 11")
        + "\n[output]\nmodal = true\n\n[vary]\nparameter = \"stiffness\"\nmaterial = \"steel\"\nmu = 0.4\nvalues = { from = 1.0, to = 4.0, points = 3 }\n";
    std::fs::write(directory.path().join("pin.toml"), text).expect("as the test has set it up");
    let (code, said, noted) = squealmap(directory.path(), &["fem", "pin.toml", "--out", "here"]);
    assert_eq!(code, 0, "{said}{noted}");
    assert!(said.contains("coalescence of mode 6 and 7 at mu = 0.388379, 64169.16 Hz"), "{said}");
    let here = directory.path().join("here");
    let read = |name: &str| std::fs::read_to_string(here.join(name)).expect("as the test has set it up");
    for name in FILES.iter().chain(&["modes.toml"]) {
        assert!(here.join(name).is_file(), "{name}");
    }
    assert_eq!(read("fem.csv").lines().count(), 1 + 11 * 7);
    let manifest: serde_json::Value =
        serde_json::from_str(&read("manifest.json")).expect("as the test has set it up");
    assert!(
        (manifest["transitions"][0]["mu_c"].as_f64().expect("as the test has set it up") - 0.38838).abs()
            < 6e-6
    );
    let curves = read("fem.svg");
    assert!(curves.contains("= 0.3884, 64.17 kHz"), "{}", &curves[..3000]);
    // Drawn again from its table and manifest it is the same, line by line.
    let (code, said, noted) = squealmap(directory.path(), &["plot", "here"]);
    assert_eq!(code, 0, "{said}{noted}");
    let drawn = |name: &str| -> Vec<String> {
        let lines = read(name).lines().map(str::to_owned).collect::<Vec<_>>();
        lines.into_iter().filter(|line| line.starts_with("<path") || line.starts_with("<text")).collect()
    };
    assert!(drawn("fem.svg").len() > 20);
    assert_eq!(drawn("plot.svg"), drawn("fem.svg"));
    assert!(noted.contains("there is also vary, shapes, mesh"), "{noted}");
    for figure in ["vary", "shapes", "mesh"] {
        let (code, said, noted) = squealmap(directory.path(), &["plot", "here", "--figure", figure]);
        assert_eq!(code, 0, "{said}{noted}");
        assert!(drawn("plot.svg").len() > 20);
        assert_eq!(drawn("plot.svg"), drawn(&format!("{figure}.svg")), "{figure}");
    }
    // At which friction, and that a pair grows there at all.
    let varied = read("vary.svg");
    assert!(varied.contains("Factor of the moduli of steel, at ") && varied.contains("unstable pair"));
    assert!(!curves.contains("growth begins or ends"), "nothing ends");
    // Two modes before they coalesce, and the one of both that grows.
    // Both parts in their colours, and what stands beside them.
    let mesh = read("mesh.svg");
    for words in [
        "block: 24 elements, 201 nodes",
        "pin: 20 elements, 171 nodes",
        "21 points of contact, sliding along x",
    ] {
        assert!(mesh.contains(words), "{words}");
    }
    for colour in ["#9FC5E8", "#F6C48B"] {
        assert!(mesh.matches(colour).count() > 20, "{colour}");
    }
    let shapes = read("shapes.svg");
    for letter in ["(a)", "(b)", "(c)"] {
        assert!(shapes.contains(letter), "{letter}");
    }
    assert!(!shapes.contains("(d)"));
    // Without friction a mode is real; the one that grows has a phase.
    assert_eq!(shapes.matches(", phase ").count(), 1);
    assert!(shapes.contains("phase: by how much the normal displacement leads that along the sliding"));
    assert!(shapes.contains(">sliding<"));
}

/// Figures 15 to 17 of a study, and verdicts by its numbers: a pin has no modes at 14.5 kHz.
#[test]
fn the_papers_figures_come_with_verdicts() {
    let directory = tempfile::tempdir().expect("as the test has set it up");
    let text = PIN.replace("points = 26", "points = 11");
    std::fs::write(directory.path().join("pin.toml"), &text).expect("as the test has set it up");
    let (code, said, noted) = squealmap(directory.path(), &["paper", "--fem=pin.toml", "--output", "here"]);
    assert_eq!(code, 0, "{said}{noted}");
    assert!(said.contains("two modes coalesce at 14.5 kHz while friction rises: not reproduced\n"), "{said}");
    assert!(said.contains("from there on a mode is unstable: reproduced\n"), "{said}");
    let read = |name: &str| {
        std::fs::read_to_string(directory.path().join("here").join(name)).expect("as the test has set it up")
    };
    let report = read("paper_fem.md");
    for words in [
        "| 16 | two modes coalesce at 14.5 kHz while friction rises | modes 6 and 7 at μ = 0.3884, at 64.17 kHz | **not reproduced** |",
        "a mode grows at 3 of the 3 values of friction above and at 0 of the 8 below; at μ = 0.5 with ",
        "44 elements, 873 unknowns, 21 points of contact.",
        "```sh\nsquealmap paper --fem=pin.toml -o here\n```",
    ] {
        assert!(report.contains(words), "{report}\ndoes not say\n{words}");
    }
    for name in ["figure15", "figure16", "figure17"] {
        assert!(report.contains(&format!("(paper/{name}.png)")), "{name}");
        assert!(read(&format!("paper/{name}.svg")).contains("Pin on a block"), "{name}");
    }
    // Up to 0.3 nothing coalesces, and nothing is claimed to.
    let text = text.replace("to = 0.5", "to = 0.3");
    std::fs::write(directory.path().join("pin.toml"), text).expect("as the test has set it up");
    let (code, said, noted) = squealmap(directory.path(), &["paper", "--fem=pin.toml", "--output", "there"]);
    assert_eq!(code, 0, "{said}{noted}");
    assert!(said.contains("from there on a mode is unstable: not reproduced\n"), "{said}");
    let (code, _, noted) = squealmap(directory.path(), &["paper", "--fem", "--kick", "0.001"]);
    assert_eq!(code, 2, "{noted}");
}

/// What stands in a directory stays, unless it is of the same file or `--force` says so; nothing of an earlier study stays beside
/// a later one.
#[test]
fn results_of_others_are_replaced_with_force_alone() {
    let directory = tempfile::tempdir().expect("as the test has set it up");
    let small =
        PIN.replace("hex20", "hex8").replace("points = 26", "points = 2").replace("count = 7", "count = 1");
    let varied = small.clone()
        + "\n[vary]\nparameter = \"stiffness\"\nmaterial = \"steel\"\nmu = 0.1\nvalues = { values = [1.0, 1.1] }\n";
    let put = |name: &str, text: &str| {
        std::fs::write(directory.path().join(name), text).expect("as the test has set it up");
    };
    put("a.toml", &small);
    put("b.toml", &varied);
    std::fs::create_dir(directory.path().join("here")).expect("as the test has set it up");
    put("here/manifest.json", "{}");
    let fem = |arguments: &[&str]| {
        let (code, said, noted) = squealmap(directory.path(), &[&["fem"], arguments].concat());
        (code, said + &noted.split_whitespace().collect::<Vec<_>>().join(" "))
    };
    let there = |name: &str| directory.path().join(name).exists();
    let (code, said) = fem(&["a.toml", "-o", "here"]);
    assert_eq!(code, 2, "{said}");
    assert!(
        said.contains("`here` holds `manifest.json` made from `an unknown file`; choose another directory"),
        "{said}"
    );
    assert_eq!(std::fs::read(directory.path().join("here/manifest.json")).expect("a file"), b"{}");
    assert_eq!(std::fs::read_dir(directory.path().join("here")).expect("a directory").count(), 1);
    let (code, said) = fem(&["a.toml", "-o", "here", "--force"]);
    assert_eq!(code, 0, "{said}");
    // No mode grows, and no line of the key is of one that does.
    let drawn = std::fs::read_to_string(directory.path().join("here/fem.svg")).expect("a figure");
    assert!(drawn.contains(">stable<") && !drawn.contains("unstable"));
    let (code, said) = fem(&["b.toml", "-o", "here"]);
    assert!(code == 2 && said.contains("made from `a.toml`") && said.contains("--force"), "{said}");
    assert!(!there("here/vary.csv"));
    assert_eq!(fem(&["b.toml", "-o", "here", "--force"]).0, 0);
    put("here/modes.toml", "of an earlier study");
    put("here/notes.txt", "mine");
    assert!(there("here/vary.csv") && there("here/vary.png"));
    // The same file, changed, needs no force; what it no longer makes goes.
    put("b.toml", &small);
    let (code, said) = fem(&["b.toml", "-o", "here"]);
    assert_eq!(code, 0, "{said}");
    for name in ["here/vary.csv", "here/vary.svg", "here/vary.png", "here/modes.toml"] {
        assert!(!there(name), "{name}");
    }
    assert!(there("here/fem.csv") && there("here/notes.txt"));
    // So in the directory of its name.
    for (text, has) in [(&varied, true), (&small, false)] {
        put("b.toml", text);
        assert_eq!(fem(&["b.toml"]).0, 0);
        assert_eq!(there("out/b/vary.csv"), has);
    }
}

/// A study that is killed while it computes leaves nothing: no directory, no note of its source.
#[test]
fn a_study_that_is_stopped_leaves_nothing() {
    use std::io::BufRead;
    let directory = tempfile::tempdir().expect("as the test has set it up");
    let text = PIN.replace("points = 26", "points = 90000");
    std::fs::write(directory.path().join("pin.toml"), text).expect("as the test has set it up");
    let mut command = Command::new(env!("CARGO_BIN_EXE_squealmap"));
    command.current_dir(directory.path()).args(["fem", "pin.toml"]).stderr(std::process::Stdio::piped());
    let mut child = command.spawn().expect("as the test has set it up");
    let mut noted = std::io::BufReader::new(child.stderr.take().expect("as the test has set it up")).lines();
    let begun = noted.any(|line| line.expect("text").contains("sweep over friction"));
    child.kill().expect("as the test has set it up");
    let ended = child.wait().expect("as the test has set it up");
    assert!(begun && !ended.success());
    assert_eq!(std::fs::read_dir(directory.path()).expect("as the test has set it up").count(), 1);
}

#[test]
fn a_check_computes_nothing() {
    let directory = tempfile::tempdir().expect("as the test has set it up");
    std::fs::write(directory.path().join("pin.toml"), PIN).expect("as the test has set it up");
    let (code, said, noted) = squealmap(directory.path(), &["fem", "pin.toml", "--check"]);
    assert_eq!(code, 0, "{noted}");
    assert!(said.contains("unknowns  873 (") && said.contains("contact   21 points"), "{said}");
    assert_eq!(std::fs::read_dir(directory.path()).expect("as the test has set it up").count(), 1);
}

#[test]
fn a_bad_description_is_one_sentence_and_writes_nothing() {
    let directory = tempfile::tempdir().expect("as the test has set it up");
    for (old, new, wanted) in [
        (
            "cells = [6, 2, 2]",
            "cells = [0, 2, 2]",
            "pin.toml:9:9: parts.block.cells: [0, 2, 2] elements, there must be at least 1 each way",
        ),
        (
            "cells = [6, 2, 2]",
            "cells = [6, -2, 2]",
            "pin.toml:9:9: parts.block.cells: [6, -2, 2] elements, there must be at least 1 each way",
        ),
        ("cells = [6, 2, 2]", "cells = [6000000000, 2000000000, 2000000000]", "it may have 2000000"),
        ("set = \"pin.z1\"", "set = \"pin.top\"", "supports[1].set: the mesh has no set \"pin.top\""),
        ("[modes]", "[modes", "error: pin.toml:"),
    ] {
        std::fs::write(directory.path().join("pin.toml"), PIN.replace(old, new))
            .expect("as the test has set it up");
        let (code, said, noted) = squealmap(directory.path(), &["fem", "pin.toml"]);
        assert_eq!(code, 2, "{noted}");
        assert!(said.is_empty(), "{said}");
        let flat = noted.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(flat.contains(wanted) && flat.starts_with("error: pin.toml:"), "{flat}\n{wanted}");
        assert_eq!(std::fs::read_dir(directory.path()).expect("as the test has set it up").count(), 1);
    }
    // What comes out while it is computed.
    let free = PIN.replace("set = \"pin.z1\"", "set = \"pin.z1\"\naxes = \"z\"");
    std::fs::write(directory.path().join("pin.toml"), free).expect("as the test has set it up");
    let (code, _, noted) = squealmap(directory.path(), &["fem", "pin.toml"]);
    let flat = noted.split_whitespace().collect::<Vec<_>>().join(" ");
    let wanted = "error: pin.toml:25:1: the stiffness matrix is singular: a body can move without a force; hold it by supports";
    assert!(code == 2 && flat.contains(wanted), "{flat}");
    assert_eq!(std::fs::read_dir(directory.path()).expect("as the test has set it up").count(), 1);
    let (code, _, noted) = squealmap(directory.path(), &["fem", "none.toml"]);
    assert_eq!(code, 2, "{noted}");
    assert!(noted.contains("cannot read"), "{noted}");
}

/// The shipped study is one that can be read; what it gives stands in `docs/fem_paper.md`.
#[test]
fn the_papers_model_is_as_large_as_it_says() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (code, said, noted) = squealmap(here, &["fem", "sweeps/fem/paper.toml", "--check"]);
    assert_eq!(code, 0, "{noted}");
    // Elements: 9 x 9 x 9 and 34 x 17 x 7, and six tetrahedra of each cell of the holders.
    let elements = 729 + 4046 + 6 * (3 * 2 * 12 + 10 * 5 * 3);
    assert!(said.contains(&format!("elements  {elements}\n")), "{said}");
    // 19 x 19 − 9 x 9 nodes of the sliding face.
    assert!(said.contains("contact   280 points"), "{said}");
}
