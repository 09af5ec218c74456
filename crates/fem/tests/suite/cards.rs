//! Cards of `.inp` files that are not read: refused, remarked or passed over.

use squealmap_fem::read::abaqus;
use squealmap_fem::study::{Study, compute, document::Document, manifest};

/// A brick with material and section.
const BRICK: &str = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n\
                     *ELEMENT, TYPE=C3D8, ELSET=PAD\n7, 1,2,3,4,5,6,7,8\n*SURFACE, NAME=FOOT\nPAD, S1\n*SURFACE, NAME=TOP\nPAD, S2\n\
                     *MATERIAL, NAME=STEEL\n*ELASTIC\n210e9, 0.3\n*DENSITY\n7800\n*SOLID SECTION, ELSET=PAD, MATERIAL=STEEL\n";

/// A card that is not read and changes what would be computed is an error with its line; it never is left out in silence.
#[test]
fn cards_that_change_the_model_are_refused() {
    let next = BRICK.lines().count() + 1;
    for (card, says) in [
        (
            "*EQUATION\n2\n1, 1, 1.0, 2, 1, -1.0",
            "*EQUATION ties displacements to one another, which is not read from this file",
        ),
        ("*MPC\nBEAM, 1, 2", "*MPC ties displacements"),
        ("*RIGID BODY, NSET=ALL, REF NODE=1", "*RIGID BODY ties displacements"),
        ("*CONTACT PAIR, INTERACTION=I\nFOOT, TOP", "*CONTACT PAIR lets surfaces touch"),
        ("*TRANSFORM, NSET=ALL\n0, 1, 0, 1, 0, 0", "*TRANSFORM turns axes"),
        ("*SPRING, ELSET=S\n\n1e5", "*SPRING adds stiffness or damping between nodes"),
        ("*DASHPOT, ELSET=S\n\n1e5", "*DASHPOT adds stiffness or damping"),
        ("*MASS, ELSET=M\n0.1", "*MASS adds mass at nodes"),
        ("*DAMPING, ALPHA=3.0", "*DAMPING damps"),
        (
            "*INITIAL CONDITIONS, TYPE=STRESS\nPAD, 1e6",
            "*INITIAL CONDITIONS gives the bodies a state before the load",
        ),
        ("*CLOAD\n1, 3, 5.0", "*CLOAD loads the bodies"),
        ("*DLOAD\n7, P1, 5.0", "*DLOAD loads the bodies"),
        (
            "*SHELL SECTION, ELSET=PAD, MATERIAL=STEEL\n0.1",
            "*SHELL SECTION makes bodies of lines or surfaces",
        ),
        ("*NGEN\n1, 2, 1", "*NGEN makes nodes or elements from others"),
        (
            "*SOLID SECTION, ELSET=PAD, MATERIAL=STEEL, ORIENTATION=O",
            "ORIENTATION of *SOLID SECTION is not read",
        ),
        ("*BOUNDARY, TYPE=VELOCITY\n1, 1, 1, 2.0", "TYPE=VELOCITY of *BOUNDARY is not read"),
        ("*INSTANCE, NAME=A, PART=B\n1.0, 0.0, 0.0", "*INSTANCE makes a model of several parts or moves one"),
        ("*ELEMENT, TYPE=S4, ELSET=SKIN\n9, 1,2,3,4", "elements of TYPE=S4 are not known here"),
        ("*ELEMENT, TYPE=MASS, ELSET=M\n9, 1", "elements of TYPE=MASS are not known here"),
    ] {
        let error = abaqus(&format!("{BRICK}{card}\n")).map(drop).expect_err(card).to_string();
        assert!(error.starts_with(&format!("line {next}: {says}")), "{error}");
        // In a step, too, but for its loads, which are remarks.
        let in_step = abaqus(&format!("{BRICK}*STEP\n*STATIC\n{card}\n*END STEP\n"));
        match card.get(..3) {
            Some("*CL" | "*DL") => {
                let name = &card[1..6];
                let remark = format!(
                    "line {}: *{name} belongs to a step and is left out: the loads of a study are its [[loads]]",
                    next + 2
                );
                assert_eq!(in_step.expect("a mesh").remarks, [remark]);
            }
            _ => assert!(in_step.map(drop).expect_err(card).to_string().contains(says)),
        }
    }
    // Surfaces that Gmsh writes are no bodies, as long as no section makes them such.
    let skin = "*ELEMENT, TYPE=CPS4, ELSET=SKIN\n9, 1,2,3,4\n";
    assert!(abaqus(&format!("{BRICK}{skin}")).expect("a mesh").remarks.is_empty());
    let error = abaqus(&format!("{BRICK}{skin}*SOLID SECTION, ELSET=SKIN, MATERIAL=STEEL\n"))
        .map(drop)
        .expect_err("a disc");
    assert!(
        error.to_string().starts_with(&format!(
            "line {}: the section is of SKIN, in which element 9 is a line or a surface",
            next + 2
        )),
        "{error}"
    );
    let error =
        abaqus(&format!("{BRICK}*TIE, NAME=T\nFOOT\n")).map(drop).expect_err("half a tie").to_string();
    assert_eq!(error, format!("line {}: a tie needs two surfaces: the slave and its master", next + 1));
}

/// A card of which nothing is known is said, and stands in the manifest; what changes nothing is not.
#[test]
fn unknown_cards_are_remarks() {
    let text = format!(
        "*HEADING\nA brick\n{BRICK}*FOO, BAR=1\n2.0\n*STEP\n*FREQUENCY\n3\n*NODE FILE\nU\n*END STEP\n"
    );
    let description = "[parts.pad]\nkind = \"mesh\"\nfile = \"pad.inp\"\n[[supports]]\nset = \"pad.TOP\"\n[[sliding]]\n\
                       slaves = \"pad.FOOT\"\nmasters = \"rigid\"\ndirection = [1, 0, 0]\n[friction]\nmu = { values = [0.0, 0.1] }\n\
                       [modes]\ncount = 2\n";
    let study =
        Study::new(Document::read(description).expect("TOML"), &|_| Ok(text.clone())).expect("a study");
    let line = 2 + BRICK.lines().count() + 1;
    let remark = format!("parts.pad.file: `pad.inp`: line {line}: *FOO is not known here and is left out");
    assert_eq!(study.remarks, std::slice::from_ref(&remark));
    let outcome = compute(&study, &mut |_| ()).expect("results");
    let manifest: serde_json::Value =
        serde_json::from_slice(&manifest(&study, &outcome, description, "")).expect("JSON");
    assert_eq!(manifest["remarks"], serde_json::json!([remark]));
}

/// What another program would read in another way than this one is an error with its line, never a wrong result.
#[test]
fn scopes_and_doubles_are_refused() {
    let next = BRICK.lines().count() + 1;
    let brick = BRICK.replace("*SOLID SECTION, ELSET=PAD", "*SOLID SECTION, ELSET=HALF");
    let brick = brick.replace("*MATERIAL", "*ELSET, ELSET=HALF\n8\n*MATERIAL");
    let other = "*NODE\n11,0,0,1\n12,1,0,1\n13,1,1,1\n14,0,1,1\n15,0,0,2\n16,1,0,2\n17,1,1,2\n18,0,1,2\n\
                 *ELEMENT, TYPE=C3D8\n8, 11,12,13,14,15,16,17,18\n";
    let part = format!("*PART, NAME=P\n{BRICK}*NSET, NSET=SET-1\n1\n*END PART\n*ASSEMBLY, NAME=A\n");
    for (deck, says) in [
        (
            format!("{BRICK}*ELEMENT, TYPE=C3D8\n7, 1,2,3,4,5,6,7,8\n"),
            format!("line {}: element 7 stands here a second time", next + 1),
        ),
        (
            format!("{BRICK}*ELEMENT, TYPE=C3D8\n9, 2,3,4,1,6,7,8,5\n"),
            format!(
                "line {}: element 9 stands here a second time, by its number or its nodes, after line 11",
                next + 1
            ),
        ),
        (
            format!("{part}*NODE\n1, 5, 5, 5\n*END ASSEMBLY\n"),
            "*NODE of the assembly is numbered apart".to_owned(),
        ),
        (
            format!("{BRICK}*STEP\n*BOUNDARY\n1, 1\n*END STEP\n*STEP\n*BOUNDARY, OP=NEW\n2, 1\n*END STEP\n"),
            format!("line {}: OP=NEW of *BOUNDARY takes away", next + 5),
        ),
        (
            format!("{BRICK}*ELEMENT, TYPE=T3D2, ELSET=PAD\n9, 1,2\n"),
            "the section is of PAD, in which element 9 is a line or a surface".to_owned(),
        ),
        (format!("{BRICK}*STEP\n*FOUNDATION\n7, F1, 1e9\n"), "*FOUNDATION adds stiffness".to_owned()),
    ] {
        let error = abaqus(&deck).map(drop).expect_err(&deck).to_string();
        assert!(error.contains(&says), "{error}");
    }
    // What is of this step alone may be new.
    assert!(abaqus(&format!("{BRICK}*STEP\n*BOUNDARY, OP=NEW\n1, 1\n*END STEP\n")).is_ok());
    // Where materials are named in the description sections do not matter.
    let bare = abaqus(&format!("{other}{brick}")).expect("a mesh").without_section.expect("a sentence");
    assert!(bare.ends_with("element 7 has no *SOLID SECTION"), "{bare}");
    assert!(abaqus(BRICK).expect("a mesh").without_section.is_none());
}

/// Sets of a part and of its assembly may have one name: each is meant where it stands, `INSTANCE.NAME` is that of the part, and a part may stand in its
/// instance.
#[test]
fn sets_of_part_and_assembly_are_two() {
    let own = "*NSET, NSET=SET-1\n1, 2\n*ELSET, ELSET=SIDE\n7\n";
    let theirs = "*NSET, NSET=SET-1, INSTANCE=P-1\n3\n*ELSET, ELSET=PAD, INSTANCE=P-1\n7\n";
    let ends = "*STEP\n*BOUNDARY\nSET-1, 1\nP-1.SET-1, 2\nP-1.8, 3\n*END STEP\n";
    let dependent = format!(
        "*PART, NAME=P\n{BRICK}{own}*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n*END INSTANCE\n{theirs}*END ASSEMBLY\n{ends}"
    );
    let independent = format!(
        "*PART, NAME=P\n*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n{BRICK}{own}*END INSTANCE\n{theirs}*END ASSEMBLY\n{ends}"
    );
    for deck in [dependent, independent] {
        let deck = abaqus(&deck).expect("a mesh");
        let held: Vec<(usize, usize)> = deck.supports.iter().map(|(node, axis, _)| (*node, *axis)).collect();
        assert_eq!(held, [(2, 0), (0, 1), (1, 1), (7, 2)]);
        assert_eq!(
            (deck.without_section, deck.mesh.node_set("SET-1").expect("a set")),
            (None, [2].as_slice())
        );
        assert_eq!(deck.remarks, Vec::<String>::new());
    }
}

/// Sets by the elements of another one, short words, keyword lines of two lines, supports by name, unknown cards of a step.
#[test]
fn sets_and_supports_are_those_of_the_file() {
    let more = "*NSET, NSET=ALL, ELSET=PAD\n*NSET, NSET=EVEN, GEN\n2, 8, 2\n*NSET, NSET=NONE\n*NSET,\nNSET=TWO\n1, 2\n\
                *ELEMENT, TYPE=CPS4, ELSET=SKIN\n9, 5,6,7,8\n*NSET, NSET=UP, ELSET=SKIN\n*BOUNDARY\nTWO, XSYMM\nEVEN, ENCASTRE\n*STEP\n*FREQUENCY\n5\n*INERTIA RELIEF\n*END STEP\n";
    let deck = abaqus(&format!("{BRICK}{more}")).expect("a mesh");
    let set = |name: &str| deck.mesh.node_set(name).expect("a set").to_vec();
    assert_eq!(set("ALL"), (0..8).collect::<Vec<_>>());
    assert_eq!(set("EVEN"), [1, 3, 5, 7]);
    assert_eq!(set("TWO"), [0, 1]);
    assert_eq!(set("UP"), [4, 5, 6, 7]);
    let mut held: Vec<(usize, usize)> = deck.supports.iter().map(|(node, axis, _)| (*node, *axis)).collect();
    held.sort_unstable();
    held.dedup();
    let all = [1, 3, 5, 7].into_iter().flat_map(|node| (0..3).map(move |axis| (node, axis)));
    assert_eq!(held, std::iter::once((0, 0)).chain(all).collect::<Vec<_>>());
    let next = BRICK.lines().count() + 1;
    let says = [(3, "the set NONE is empty"), (16, "*INERTIA RELIEF is not known here and is left out")];
    assert_eq!(deck.remarks, says.map(|(at, says)| format!("line {}: {says}", next + at)));
}

/// A study takes the constants of its temperature.
#[test]
fn tables_of_a_file_are_read_at_the_temperature() {
    let deck = BRICK.replace("210e9, 0.3\n", "210e9, 0.3, 20\n190e9, 0.3, 420\n");
    let deck = deck.replace("7800\n", "7800, 20\n7400, 420\n");
    for (temperature, young, density) in [
        ("", 210e9, 7800.0),
        ("temperature = 220.0\n", 200e9, 7600.0),
        ("temperature = 500.0\n", 190e9, 7400.0),
    ] {
        let text = format!(
            "{temperature}[parts.p]\nkind = \"mesh\"\nfile = \"b.inp\"\n[[sliding]]\nslaves = \"p.FOOT\"\nmasters = \"rigid\"\n\
             direction = [1.0, 0.0, 0.0]\n[friction]\nmu = {{ values = [0.0] }}\n[modes]\ncount = 1\n"
        );
        let study = Study::new(Document::read(&text).expect("a description"), &|_| Ok(deck.clone()))
            .expect("a study");
        let expected =
            squealmap_fem::material::Material::isotropic("STEEL", young, 0.3, density).expect("a material");
        let [found] = study.model.materials.as_slice() else { panic!("one material") };
        assert_eq!(found.stiffness, expected.stiffness, "{temperature}");
        assert_eq!(found.density.to_bits(), expected.density.to_bits(), "{temperature}");
    }
}
