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
        error
            .to_string()
            .starts_with(&format!("line {}: the section is of SKIN, which has no solid element", next + 2)),
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
