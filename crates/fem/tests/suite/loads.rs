//! Loads that cannot be: which key it is, what is wrong with it, what to do.

use squealmap_fem::study::document::Document;
use squealmap_fem::study::{Study, compute, place};

const PIN: &str = include_str!("study/pin.toml");

/// The pin, free along z at its upper end, with what else is said of that end.
fn with(what: &str) -> String {
    let free = "set = \"pin.z1\"\naxes = \"xy\"\n\n";
    PIN.replace("set = \"pin.z1\"\n", &format!("{free}{what}\n"))
}

/// The sentence of an error, and the text at its place.
fn refused(text: &str) -> (String, String) {
    let study = Study::new(Document::read(text).expect("TOML"), &|_| Err(String::new())).expect("a study");
    let error = compute(&study, &mut |_| ()).map(drop).expect_err(text);
    let at = place(text, &error).map_or(String::new(), |span| text[span].to_owned());
    (error.to_string(), at)
}

#[test]
fn bodies_that_are_pulled_apart_are_named_by_what_pulls_them() {
    let apart = "the surfaces are pulled apart, so that nothing of the contact stays pressed: turn the sign of the load";
    for (what, key, at) in [
        ("[[loads]]\nset = \"pin.z1\"\npressure = -1e5", "loads[0].pressure", "-1e5"),
        ("[[loads]]\nset = \"pin.z1\"\nforce = -17", "loads[0].force", "-17"),
        (
            "[[supports]]\nset = \"pin.z1\"\naxes = \"z\"\ndisplacement = 1e-6",
            "supports[2].displacement",
            "1e-6",
        ),
        (
            "[[supports]]\nset = \"pin.z1\"\naxes = \"z\"\ndisplacement = 1e-30",
            "supports[2].displacement",
            "1e-30",
        ),
    ] {
        // With displacements tied, and with a contact stiffness.
        for text in [with(what), with(what).replace("[modes]", "contact_stiffness = 1e14\n\n[modes]")] {
            let (error, place) = refused(&text);
            assert!(error.starts_with(&format!("{key}: {apart}")), "{error}");
            assert_eq!(place, at, "{error}");
        }
    }
}

#[test]
fn loads_that_are_far_too_large_are_named() {
    for (what, key, at) in [
        ("[[loads]]\nset = \"pin.z1\"\nforce = 1e30", "loads[0].force", "1e30"),
        ("[[loads]]\nset = \"pin.z1\"\nforce = -1e30", "loads[0].force", "-1e30"),
        ("[[loads]]\nset = \"pin.z1\"\npressure = 1e308", "loads[0].pressure", "1e308"),
        (
            "[[supports]]\nset = \"pin.z1\"\naxes = \"z\"\ndisplacement = -1e30",
            "supports[2].displacement",
            "-1e30",
        ),
        ("[[supports]]\nset = \"pin.z1\"\naxes = \"z\"\ndisplacement = -1", "supports[2].displacement", "-1"),
    ] {
        let (error, place) = refused(&with(what));
        assert!(error.starts_with(&format!("{key}: the bodies are moved by ")), "{error}");
        assert!(
            error.contains(" m, which must be much less than their size of 4.7e-2 m: lower the load"),
            "{error}"
        );
        assert_eq!(place, at, "{error}");
    }
    // Of several, none is the one.
    let both = "[[loads]]\nset = \"pin.z1\"\nforce = 17\n\n[[loads]]\nset = \"pin.z1\"\nforce = 1e30";
    assert!(refused(&with(both)).0.starts_with("loads: the bodies are moved by "));
    // A factor of a load that is none too large.
    let varied = "[[loads]]\nset = \"pin.z1\"\nforce = 17\n\n[vary]\nparameter = \"load\"\nmu = 0.1\nvalues = { values = [1.0, 1e30] }";
    assert!(refused(&with(varied)).0.starts_with("vary.values: the bodies are moved by "));
}
