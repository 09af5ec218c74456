//! Meshes of Gmsh 4.8, and what CalculiX 2.20 computes from them.

use squealmap_fem::Error;
use squealmap_fem::assembly::{Loads, Model, assemble};
use squealmap_fem::elements::{Inertia, Kind};
use squealmap_fem::material::{Material, Orthotropic};
use squealmap_fem::mesh::Mesh;
use squealmap_fem::modes::{Factor, Ordering, lowest};
use squealmap_fem::output::{Field, inp, vtu};
use squealmap_fem::read::{abaqus, gmsh};
use squealmap_fem::statics::settle;

use crate::cases::pin;
use crate::elements::KINDS;

macro_rules! bar {
    ($name:literal) => {
        include_str!(concat!("files/bar_", $name))
    };
}

/// A bar for CalculiX, of each kind of element, and what it prints: the displacements (m) of nodes 5, 6, 7, 8 under forces of 1000, −3000
/// and 2000 N along x, y, z on node 7.
const CALCULIX: [(Kind, &str, [[f64; 3]; 4]); 6] = [
    (
        Kind::Hex20,
        bar!("hex20.inp"),
        [
            [-9.262_374e-6, -6.089_530e-5, -1.697_663e-5],
            [-1.081_073e-5, -1.130_732e-4, -2.345_695e-5],
            [2.051_261e-5, -1.318_723e-4, 3.811_724e-5],
            [1.261_063e-5, -6.122_727e-5, 1.879_462e-5],
        ],
    ),
    (
        Kind::Hex20Reduced,
        bar!("hex20r.inp"),
        [
            [-8.056_116e-6, -6.067_661e-5, -1.605_339e-5],
            [-6.010_618e-6, -1.055_801e-4, -2.156_196e-5],
            [2.488_488e-5, -1.455_126e-4, 4.337_294e-5],
            [1.494_373e-5, -6.143_243e-5, 1.954_265e-5],
        ],
    ),
    (
        Kind::Hex8,
        bar!("hex8.inp"),
        [
            [-9.472_536e-6, -2.258_298e-5, -6.851_054e-6],
            [-1.140_892e-5, -7.117_787e-5, -1.334_303e-5],
            [1.463_917e-5, -7.594_836e-5, 1.966_942e-5],
            [1.132_678e-5, -2.273_681e-5, 8.126_067e-6],
        ],
    ),
    (
        Kind::Tet10,
        bar!("tet10.inp"),
        [
            [-9.825_698e-6, -6.084_736e-5, -1.723_999e-5],
            [-1.082_657e-5, -1.130_042e-4, -2.259_337e-5],
            [1.486_353e-5, -1.197_353e-4, 3.077_031e-5],
            [1.312_303e-5, -6.120_111e-5, 1.911_374e-5],
        ],
    ),
    (
        Kind::Tet4,
        bar!("tet4.inp"),
        [
            [4.830_206e-6, -1.882_238e-5, -1.228_584e-6],
            [4.734_193e-6, -2.120_768e-5, -4.785_253e-6],
            [5.860_622e-6, -2.126_662e-5, 3.182_783e-6],
            [6.073_792e-6, -1.880_055e-5, 6.574_385e-6],
        ],
    ),
    (
        Kind::Wedge15,
        bar!("wedge15.inp"),
        [
            [-7.828_318e-6, -6.118_558e-5, -1.638_530e-5],
            [-1.135_058e-5, -1.145_268e-4, -2.329_311e-5],
            [1.809_069e-5, -1.266_088e-4, 3.555_427e-5],
            [1.206_904e-5, -6.094_356e-5, 1.799_176e-5],
        ],
    ),
];

/// The first six frequencies (Hz) that CalculiX computes.
const FREQUENCIES: [(Kind, [f64; 6]); 6] = [
    (Kind::Hex20, [9_276.910, 15_103.88, 22_258.48, 43_710.21, 44_142.12, 50_178.12]),
    (Kind::Hex8, [12_245.66, 16_935.11, 24_143.24, 46_726.02, 61_927.87, 63_295.05]),
    (Kind::Wedge15, [9_319.293, 15_137.24, 22_577.55, 43_645.04, 44_132.34, 50_024.28]),
    (Kind::Hex20Reduced, [9_214.438, 14_943.57, 22_024.52, 43_042.95, 43_822.72, 50_160.58]),
    (Kind::Tet10, [9_298.092, 15_257.12, 23_057.11, 44_070.75, 46_300.46, 50_781.16]),
    (Kind::Tet4, [17_166.64, 21_873.51, 47_772.80, 76_305.93, 82_169.22, 90_905.52]),
];

/// The same meshes as Gmsh writes them itself: format 2.2 for Hex20 and Tet4, 4.1 for the others.
const GMSH: [(Kind, &str); 5] = [
    (Kind::Hex20, bar!("hex20.msh")),
    (Kind::Hex8, bar!("hex8.msh")),
    (Kind::Tet10, bar!("tet10.msh")),
    (Kind::Tet4, bar!("tet4.msh")),
    (Kind::Wedge15, bar!("wedge15.msh")),
];

fn bar(text: &str) -> Model {
    let deck = abaqus(text).expect("a file of CalculiX");
    let mut model = Model { mesh: deck.mesh, materials: deck.materials, ..Model::default() };
    for (node, axis, u) in &deck.supports {
        model.supports.prescribe(&[*node], *axis, *u);
    }
    model
}

#[test]
fn calculix_computes_the_same_displacements() {
    for (kind, text, theirs) in CALCULIX {
        let model = bar(text);
        assert_eq!(model.mesh.groups[0].kind, kind);
        let seen = model.mesh.node_set("SEEN").expect("a set").to_vec();
        let loads = Loads { forces: vec![(seen[2], [1000.0, -3000.0, 2000.0])], ..Loads::default() };
        let settled = settle(&model, &[], &loads, 0.0).expect("a bar under load");
        for (node, u) in seen.iter().zip(theirs) {
            for i in 0..3 {
                // Half a unit of the seven digits that are printed.
                let ours = settled.displacement[*node][i];
                assert!(
                    (ours - u[i]).abs() <= 6e-7 * u[i].abs(),
                    "{} node {node}: {ours:e} {:e}",
                    kind.name(),
                    u[i]
                );
            }
        }
    }
}

#[test]
fn calculix_computes_the_same_frequencies() {
    for (kind, theirs) in FREQUENCIES {
        let text = CALCULIX.iter().find(|(k, ..)| *k == kind).expect("the same kind").1;
        let ours = |inertia| {
            let (_, pencil) = assemble(&Model { inertia, ..bar(text) }).expect("a sound model");
            let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
            let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
            lowest(&pencil, &factor, 6).expect("real modes").frequencies()
        };
        let found = ours(Inertia::Calculix);
        for (a, b) in found.iter().zip(theirs) {
            assert!((a - b).abs() <= 6e-7 * b, "{}: {found:?}, not {theirs:?}", kind.name());
        }
        // Of the other kinds the exact mass gives other frequencies.
        let apart = (ours(Inertia::Exact)[0] / theirs[0] - 1.0).abs();
        assert_eq!(apart > 6e-7, !matches!(kind, Kind::Hex20 | Kind::Hex8), "{}: {apart:e}", kind.name());
    }
}

/// The bar of Hex20 once more, of a material with three different axes: first six frequencies of CalculiX, Hz.
#[test]
fn calculix_computes_the_same_frequencies_of_an_orthotropic_bar() {
    const THEIRS: [f64; 6] = [1_067.335, 1_876.552, 3_277.474, 5_186.5, 5_471.235, 6_961.706];
    let steel = "*ELASTIC\n210e9, 0.3";
    assert!(bar!("hex20.inp").contains(steel));
    let lining = "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n12e9, 9e9, 3e9, 0.25, 0.3, 0.2, 3e9, 2e9,\n1.5e9";
    let (_, pencil) = assemble(&bar(&bar!("hex20.inp").replace(steel, lining))).expect("a sound model");
    let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0).expect("a factor");
    let ours = lowest(&pencil, &factor, 6).expect("real modes").frequencies();
    for (a, b) in ours.iter().zip(THEIRS) {
        assert!((a - b).abs() <= 6e-7 * b, "{ours:?}, not {THEIRS:?}");
    }
}

fn corners_and_all(mesh: &Mesh) -> Vec<Vec<String>> {
    let place = |node: &usize| format!("{:.9?}", mesh.nodes[*node].map(|x| x + 0.0));
    mesh.elements().map(|(_, _, _, nodes)| nodes.iter().map(place).collect()).collect()
}

#[test]
fn gmsh_writes_the_same_mesh_in_both_formats() {
    for (kind, text) in GMSH {
        let mesh = gmsh(text).expect("a mesh of Gmsh");
        assert_eq!(mesh.groups[0].kind, kind);
        let inp = CALCULIX.iter().find(|(k, ..)| *k == kind).expect("the same kind").1;
        let other = abaqus(inp).expect("a file of CalculiX").mesh;
        assert_eq!(corners_and_all(&mesh), corners_and_all(&other), "{}", kind.name());
        // Physical groups by name: 20 × 10 mm of the bar's ends, one edge of it, all of it.
        assert_eq!(mesh.node_set("bar").expect("a volume").len(), mesh.nodes.len());
        for name in ["bottom", "top"] {
            let nodes = mesh.node_set(name).expect("a surface");
            let height = if name == "top" { 0.03 } else { 0.0 };
            assert_eq!(nodes, mesh.nodes_where(|x| (x[2] - height).abs() < 1e-12));
            assert_eq!(mesh.face_nodes(mesh.face_set(name).expect("a surface")), nodes);
        }
        let edge = mesh.node_set("edge").expect("a curve");
        assert_eq!(edge, mesh.nodes_where(|x| x[1].abs() < 1e-12 && x[2].abs() < 1e-12));
    }
}

#[test]
fn surfaces_sets_and_ties_are_read() {
    let text = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n\
                *ELEMENT, TYPE=C3D8, ELSET=Pad\n7, 1,2,3,4,\n5,6,7,8\n*nset, nset=line, generate\n1, 4, 3\n\
                *Nset, Nset=More\nLine, 8\n*SURFACE, NAME=Top\nPAD, S2\n*Surface, name=Side, type=element\n7, S4\n\
                *Surface, name=Points, type=node\nmore\n\
                *TIE, NAME=T\nTOP, SIDE\n*MATERIAL, NAME=Lining\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n\
                12e9, 9e9, 3e9, 0.2, 0.3, 0.25, 3e9, 2e9,\n1.5e9\n*DENSITY\n2500\n\
                *SOLID SECTION, ELSET=PAD, MATERIAL=LINING\n*BOUNDARY\nLINE, 1, 2\n5, 3, 3, 1e-6\n*STEP\n";
    let deck = abaqus(text).expect("a file");
    assert_eq!(deck.mesh.node_set("MORE").expect("a set"), [0, 3, 7]);
    assert_eq!(deck.mesh.node_set("POINTS").expect("a set"), [0, 3, 7]);
    assert_eq!(deck.mesh.node_set("TOP").expect("a set"), [4, 5, 6, 7]);
    // S4 of a brick is 2-6-7-3.
    assert_eq!(deck.mesh.node_set("SIDE").expect("a set"), [1, 2, 5, 6]);
    assert_eq!(deck.ties, [("TOP".to_owned(), "SIDE".to_owned())]);
    assert_eq!(deck.supports, [(0, 0, 0.0), (3, 0, 0.0), (0, 1, 0.0), (3, 1, 0.0), (4, 2, 1e-6)]);
    assert!(deck.remarks.is_empty(), "{:?}", deck.remarks);
    // ν12, ν13, ν23 and G12, G13, G23: the shear stiffnesses xy, yz, zx are G12, G23, G13.
    let shear = [3, 4, 5].map(|i| deck.materials[0].stiffness[i][i]);
    assert_eq!(format!("{shear:?}"), "[3000000000.0, 1500000000.0, 2000000000.0]");
}

#[test]
fn a_bad_file_is_a_sentence_with_its_line() {
    let node = "*NODE\n1,0,0,0\n";
    for (text, sentence) in [
        ("*NODE\n1, 0, zero, 0\n", "line 2: \"zero\" is no coordinate"),
        (
            "*ELEMENT, TYPE=C3D6\n",
            "line 1: elements of TYPE=C3D6 are not known here: C3D4, C3D8, C3D10, C3D15, C3D20 and C3D20R are; mesh with these, or delete \
             the elements where they are no part of the body",
        ),
        (
            &format!("{node}*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n"),
            "line 4: element 1 names node 2, which the file does not have",
        ),
        (
            &format!("{node}*ELEMENT, TYPE=C3D4\n1,1,2\n"),
            "line 4: the last element has 2 nodes, Tet4 needs 4",
        ),
        (
            "*NSET, NSET=A, GENERATE\n1, 99999999999999\n",
            "line 2: the set would have 99999999999999 members, at most 100000000 are possible: check the range",
        ),
        ("*INCLUDE, INPUT=a.inp\n", "line 1: *INCLUDE is not followed: put the file's lines here"),
        ("*NSET, NSET=A\nB\n", "line 2: there is no set B; there are: "),
        ("*MATERIAL, NAME=M\n*ELASTIC\n1e9\n", "line 1: material M has 1 elastic constants, it needs 2"),
        ("*NSET\n1\n", "line 1: *NSET has no NSET=: give it one"),
    ] {
        assert_eq!(abaqus(text).map(drop).expect_err(text).to_string(), sentence);
    }
    for (text, sentence) in [
        ("solid\n", "line 1: this is no mesh of Gmsh: it has no $MeshFormat"),
        (
            "$MeshFormat\n4.0 0 8\n",
            "line 2: the format is 4, it must be 2 or 4.1: save the mesh as one of them",
        ),
        ("$MeshFormat\n2.2 1 8\n", "line 2: the file is binary: save the mesh as text (Mesh.Binary = 0)"),
        ("$MeshFormat\n2.2 0 8\n$Nodes\n2\n1 0 0 0\n", "line 5: the file ends where a node should follow"),
        ("$MeshFormat\n2.2 0 8\n$Nodes\n1\n1 0 0\n", "line 5: the line ends where coordinate should follow"),
    ] {
        assert_eq!(gmsh(text).map(drop).expect_err(text).to_string(), sentence);
    }
    let error = gmsh("$MeshFormat\n2.2 0 8\n$Elements\n1\n1 12 0 1 2 3\n").map(drop).expect_err("27 nodes");
    assert!(
        matches!(&error, Error::File { line: 5, what } if what.starts_with("elements of type 12 are not known here")),
        "{error}"
    );
}

/// What is written for CalculiX is read as the same mesh, material and supports; each contact point is an equation.
#[test]
fn files_for_calculix_hold_the_model() {
    let constants =
        Orthotropic { young: [12e9, 9e9, 3e9], poisson: [0.25, 0.2, 0.3], shear: [3e9, 1.5e9, 2e9] };
    let lining = Material::orthotropic("lining", constants, 2500.0).expect("stable constants");
    for kind in KINDS {
        let mut model = pin::model(kind, 1).expect("the pin");
        model.materials = vec![lining.clone()];
        let text = inp(&model, 10);
        let error = abaqus(&text).map(drop).expect_err("equations").to_string();
        assert!(
            error.contains(": *EQUATION ties displacements to one another, which is not read"),
            "{error}"
        );
        let deck = abaqus(&without_equations(&text)).expect("a file of our own");
        assert_eq!(corners_and_all(&deck.mesh), corners_and_all(&model.mesh), "{}", kind.name());
        for (a, b) in deck.materials[0].stiffness.iter().flatten().zip(lining.stiffness.iter().flatten()) {
            assert!((a - b).abs() < 1e-10 * 12e9, "{a} {b}");
        }
        let supports: Vec<(usize, usize)> =
            deck.supports.iter().map(|(node, axis, _)| (*node, *axis)).collect();
        assert_eq!(supports, model.supports.prescribed.keys().copied().collect::<Vec<_>>());
        assert_eq!(text.matches("*EQUATION").count(), model.contact.len());
        assert!(
            text.lines()
                .flat_map(|line| line.split(','))
                .all(|word| word.starts_with('*') || word.trim().len() <= 20 || word.contains('='))
        );
    }
}

fn without_equations(text: &str) -> String {
    let mut inside = false;
    let kept = |line: &&str| {
        inside = *line == "*EQUATION" || (inside && !line.starts_with('*'));
        !inside
    };
    text.lines().filter(kept).collect::<Vec<_>>().join("\n")
}

/// A mesh whose counts do not fit its lines is refused: elements would be missing.
#[test]
fn a_mesh_with_fewer_elements_than_lines_is_refused() {
    for (kind, text) in GMSH {
        let count = text.lines().skip_while(|line| *line != "$Elements").nth(1).expect("counts");
        let fewer = |place: usize| {
            let mut words: Vec<String> = count.split(' ').map(str::to_owned).collect();
            words[place] = (words[place].parse::<usize>().expect("a count") - 1).to_string();
            text.replace(&format!("$Elements\n{count}"), &format!("$Elements\n{}", words.join(" ")))
        };
        let blocks = count.contains(' ');
        for damaged in (0..if blocks { 2 } else { 1 }).map(fewer) {
            let error = gmsh(&damaged).map(drop).expect_err(kind.name()).to_string();
            let says =
                if blocks { "write the mesh again" } else { "$EndElements should follow, but there is \"" };
            assert!(error.contains(says), "{}: {error}", kind.name());
        }
        for section in ["$EndElements", "$EndNodes"] {
            let error = gmsh(&text.replace(section, "")).map(drop).expect_err(section).to_string();
            assert!(error.contains(section), "{error}");
        }
    }
}

/// Every prefix of a file, and every line without one of its words, is read or is a sentence.
#[test]
fn damaged_files_do_not_panic() {
    for (_, text, _) in CALCULIX {
        let step = text.len() / 97;
        (0..text.len()).step_by(step).for_each(|end| drop(abaqus(&text[..end])));
        let lines: Vec<&str> = text.lines().collect();
        for i in (0..lines.len()).step_by(3) {
            let mut damaged = lines.clone();
            damaged[i] = "";
            drop(abaqus(&damaged.join("\n")));
            damaged[i] = ",";
            drop(abaqus(&damaged.join("\n")));
        }
    }
    for (_, text) in GMSH {
        let step = text.len() / 97;
        (0..text.len()).step_by(step).for_each(|end| drop(gmsh(&text[..end])));
        let lines: Vec<&str> = text.lines().collect();
        for i in 0..lines.len() {
            let mut damaged = lines.clone();
            damaged[i] = "3";
            drop(gmsh(&damaged.join("\n")));
        }
    }
}

/// The numbers of a file of VTK are those that were written.
#[test]
fn vtk_files_hold_the_mesh_and_the_fields() {
    use faer::c64;
    let mesh = gmsh(bar!("wedge15.msh")).expect("a mesh of Gmsh");
    let field: Vec<[c64; 3]> =
        mesh.nodes.iter().map(|x| [c64::new(x[0], x[1]), c64::new(-x[2], 0.5), c64::new(0.0, 0.0)]).collect();
    let text = vtu(
        &mesh,
        &[("mode 1 & <2>", Field::Complex(field.clone())), ("u", Field::Real(mesh.nodes.clone()))],
    );
    let numbers = |name: &str| -> Vec<f64> {
        let start = text.find(&format!("Name=\"{name}\"")).expect(name);
        let data = &text[start..];
        let data = &data[data.find('>').expect("a tag") + 1..data.find("</DataArray>").expect("an end")];
        data.split_whitespace().map(|w| w.parse().expect("a number")).collect()
    };
    let flat = |of: fn(&c64) -> f64| field.iter().flat_map(|v| v.iter().map(of)).collect::<Vec<f64>>();
    assert_eq!(numbers("mode 1 &amp; &lt;2&gt; real"), flat(|z| z.re));
    assert_eq!(numbers("mode 1 &amp; &lt;2&gt; imaginary"), flat(|z| z.im));
    assert_eq!(numbers("mode 1 &amp; &lt;2&gt; phase"), flat(|z| z.im.atan2(z.re)));
    let places: Vec<f64> = mesh.nodes.iter().flatten().copied().collect();
    assert_eq!(numbers("places"), places);
    assert_eq!(numbers("u"), places);
    let connectivity: Vec<f64> =
        mesh.elements().flat_map(|(_, _, _, n)| n.iter().map(|i| *i as f64)).collect();
    assert_eq!(numbers("connectivity"), connectivity);
    // VTK_QUADRATIC_WEDGE.
    assert!(numbers("types").iter().all(|t| (t - 26.0).abs() < 0.5));
    assert_eq!(numbers("offsets").last().copied(), Some(connectivity.len() as f64));
}
