//! Projected problems as files.

use faer::Mat;
use squealmap_fem::modes::pairs;
use squealmap_fem::study::document::Document;
use squealmap_fem::study::{Modal, Study, compute};

const PIN: &str = include_str!("study/pin.toml");

/// The pin pressed by its clamped end: maps need a load.
fn pushed() -> String {
    PIN.replace(
        "set = \"pin.z1\"\n",
        "set = \"pin.z1\"\naxes = \"xy\"\n\n[[supports]]\nset = \"pin.z1\"\naxes = \"z\"\ndisplacement = -1e-6\n",
    )
}

fn modal(text: &str) -> (squealmap_fem::study::Outcome, Modal) {
    let study = Study::new(Document::read(text).expect("TOML"), &|_| Err(String::new())).expect("a study");
    let outcome = compute(&study, &mut |_| ()).expect("results");
    let modal = outcome.modal.clone().expect("a projected problem");
    (outcome, modal)
}

/// What is written is read again to the bit, and has the eigenvalues of the study.
#[test]
fn a_projected_problem_survives_its_file() {
    // Damped, with a slope of friction under a load.
    let pressed = PIN
        .replace("points = 26 }", "points = 26 }\nslope = -0.02")
        .replace("density = 7800", "density = 7800\nrayleigh = [10.0, 1e-9]")
        .replace(
            "set = \"pin.z1\"\n",
            "set = \"pin.z1\"\naxes = \"xy\"\n\n[[loads]]\nset = \"pin.z1\"\nforce = 1700.0\n",
        );
    for text in [pushed(), pressed] {
        let (outcome, modal) = modal(&format!("{text}\n[output]\nmodal = true\n"));
        assert!(modal.size() > 7 && modal.size() <= 64, "{}", modal.size());
        let file = String::from_utf8(modal.write()).expect("UTF-8");
        let again = Modal::read(&file).expect("the same problem");
        assert_eq!((again.title.as_str(), again.mu, again.modes), ("Pin on a block", [0.0, 0.5], 7));
        for (a, b) in
            modal.symmetric.iter().chain(&modal.friction).zip(again.symmetric.iter().chain(&again.friction))
        {
            assert_eq!(a, b);
        }
        assert_eq!((&modal.slope, modal.wedge), (&again.slope, again.wedge));
        assert_eq!(modal.load.to_bits(), again.load.to_bits());
        // A load presses, and its normal forces are its own.
        let slope = if outcome.damped { -0.02 } else { 0.0 };
        assert!(modal.slope.norm_max() > 0.0);
        // The end sinks by 1 μm, the pin alone would be pressed with E A/L times that, 840 N.
        let load = if outcome.damped { 1_700.0..1_700.000_001 } else { 600.0..840.0 };
        assert!(load.contains(&(modal.load + 1e-7)), "{}", modal.load);
        for i in [0, 5, 13, 25] {
            let mu = 0.02 * f64::from(i);
            let found = pairs(&again.at(mu, slope)).expect("pairs");
            for mode in &outcome.modes {
                let lambda = mode.states[usize::try_from(i).expect("an index")].lambda;
                let apart = found.iter().map(|p| (p.lambda - lambda).norm()).fold(f64::INFINITY, f64::min);
                // Near the coalescence an eigenvalue moves by the root of what its matrix does.
                assert!(apart < 1e-6 * lambda.norm(), "mu {mu}: {lambda} {apart:e}");
            }
        }
    }
}

/// Two masses on a belt (Table 1 of the paper, without damping) as a file: the critical friction of the closed form.
#[test]
fn two_masses_can_be_written_as_a_file() {
    let text = two_masses_file();
    let modal = Modal::read(&text).expect("two masses");
    let grows = |mu: f64| pairs(&modal.at(mu, 0.0)).expect("pairs").iter().any(|p| p.growth() > 1e-3);
    let (mut low, mut high) = (0.1, 0.4);
    assert!(!grows(low) && grows(high));
    for _ in 0..40 {
        let middle = f64::midpoint(low, high);
        if grows(middle) { high = middle } else { low = middle }
    }
    assert!((low - 0.226_361_594).abs() < 1e-7, "{low}");
    let merged = pairs(&modal.at(low, 0.0)).expect("pairs");
    assert!((merged[0].frequency() - 33.954_934).abs() < 2e-2, "{}", merged[0].frequency());
}

#[test]
fn bad_files_of_modes_are_named() {
    let good = two_masses_file();
    for (old, new, wanted) in [
        ("kind = \"modal\"", "kind = \"map\"", "kind: \"map\" is another kind of file, it must be \"modal\""),
        ("version = 2", "version = 1", "version: 1 is not known, it must be 2: write the file again"),
        ("mass = [[", "mass = [[1.0], [", "mass: it has a row or column of 3 entries, where stiffness has 2"),
        (
            "stiffness = [[",
            "stiffness = [[nan, 0.0], [",
            "stiffness: it has a row or column of 2 entries, where stiffness has 3",
        ),
        ("damping = [[0.0, 0.0]", "damping = [[0.0, 1.0]", "damping: it differs from its transpose by 1e0"),
        ("damping_slope = [[0.0", "damping_slope = [[inf", "damping_slope: inf is no finite number"),
        ("modes = 2", "modes = 0", "modes: there are 0 modes, it must be 1 to 2, the rows of stiffness"),
        ("modes = 2", "modes = 3", "modes: there are 3 modes, it must be 1 to 2, the rows of stiffness"),
        ("mu = [0.0, 1.0]", "mu = [1.0, 0.0]", "mu: the range is [1.0, 0.0], it must rise from 0 or more"),
        ("mu = [0.0, 1.0]", "mu = [0.0, nan]", "mu: the range is [0.0, NaN], it must rise from 0 or more"),
        ("stiffness = [[", "stiffness = [[-", "stiffness: it has the eigenvalue -"),
        (
            "modes = 2",
            "modes = 2\nload = -1.0",
            "load: the load is -1 N and the wedge 0, they must be finite numbers",
        ),
        ("modes = 2", "modes = 2\nmasses = 2", "line 6: unknown field `masses`"),
    ] {
        assert!(good.contains(old), "{old}");
        let error = Modal::read(&good.replacen(old, new, 1)).map(drop).expect_err(new).to_string();
        assert!(error.starts_with(wanted), "{error}");
    }
    let large = Mat::<f64>::identity(65, 65);
    let zero = || Mat::<f64>::zeros(65, 65);
    let modal = Modal {
        title: String::new(),
        mu: [0.0, 1.0],
        modes: 1,
        symmetric: [large.clone(), large, zero()],
        friction: [zero(), zero(), zero()],
        slope: zero(),
        load: 0.0,
        wedge: 0.0,
        contact: None,
    };
    let file = String::from_utf8(modal.write()).expect("UTF-8");
    let error = Modal::read(&file).map(drop).expect_err("too large").to_string();
    assert_eq!(error, "stiffness: there are 65 rows, it must be 1 to 64");
}

/// Masses, springs and angle of Table 1; N = c h − s (m1 c ẍ2 + c k1 x2) with h = k2 (s x2 − y1).
fn two_masses_file() -> String {
    let (m1, m2, k1, k2) = (2.12, 0.18, 100_000.0, 101_000.0);
    let (s, c) = 0.01_f64.sin_cos();
    let zero = "[[0.0, 0.0], [0.0, 0.0]]";
    format!(
        "kind = \"modal\"\nversion = 2\ntitle = \"Two masses\"\nmu = [0.0, 1.0]\nmodes = 2\n\
         stiffness = [[{:e}, {:e}], [{:e}, {:e}]]\nmass = [[{:e}, 0.0], [0.0, {m1}]]\ndamping = {zero}\n\
         stiffness_friction = [[{:e}, {:e}], [0.0, 0.0]]\nmass_friction = [[{:e}, 0.0], [0.0, 0.0]]\n\
         damping_slope = {zero}\n",
        c * c * k1 + s * s * k2,
        -s * k2,
        -s * k2,
        k2,
        m2 + m1 * c * c,
        s * c * (k1 - k2),
        c * k2,
        m1 * c * s
    )
}

/// A file of a study without a slope of friction has the eigenvalues of one with it: shapes hardly know of it.
#[test]
fn a_slope_needs_no_vectors_of_its_own() {
    let pressed = PIN.replace("points = 26", "points = 6").replace(
        "set = \"pin.z1\"\n",
        "set = \"pin.z1\"\naxes = \"xy\"\n\n[[loads]]\nset = \"pin.z1\"\nforce = 1700.0\n",
    );
    let (_, flat) = modal(&format!("{pressed}\n[output]\nmodal = true\n"));
    let (outcome, _) = modal(&format!(
        "{}\n[output]\nmodal = true\n",
        pressed.replace("points = 6 }", "points = 6 }\nslope = -0.05")
    ));
    let (mut grown, mut worst) = (0.0_f64, 0.0_f64);
    for i in 0..6 {
        let found = pairs(&flat.at(0.1 * f64::from(i), -0.05)).expect("pairs");
        for mode in &outcome.modes {
            let lambda = mode.states[usize::try_from(i).expect("an index")].lambda;
            let apart = found.iter().map(|p| (p.lambda - lambda).norm()).fold(f64::INFINITY, f64::min);
            worst = worst.max(apart / lambda.norm());
            grown = grown.max(if i == 0 { lambda.re } else { 0.0 });
        }
    }
    // Of the eigenvalue; a ten-thousandth of what this large slope makes it grow.
    assert!(worst < 2e-5, "{worst:e}");
    assert!(grown > 4000.0, "{grown}");
}

/// A file with a range of contact stiffness has the eigenvalues of studies with other stiffnesses, in it and at its ends.
#[test]
fn a_range_of_contact_stiffness_is_held() {
    let with = |kn: &str, rest: &str| {
        format!(
            "{}{rest}",
            pushed().replace("points = 26 }", &format!("points = 6 }}\ncontact_stiffness = {kn}"))
        )
    };
    let (_, file) = modal(&with("1e14", "\n[output]\nmodal = true\nkn = [3e12, 3e15]\n"));
    let text = String::from_utf8(file.write()).expect("UTF-8");
    let file = Modal::read(&text).expect("the same problem");
    for (written, kn) in [("3e12", 3e12), ("2e13", 2e13), ("1e14", 1e14), ("3e15", 3e15)] {
        let (outcome, _) = modal(&with(written, "\n[output]\nmodal = true\n"));
        let other = file.with_contact(kn).expect("a range");
        for (i, mu) in [(0, 0.0), (3, 0.3), (5, 0.5)] {
            let found = pairs(&other.at(mu, 0.0)).expect("pairs");
            for mode in &outcome.modes {
                let lambda = mode.states[i].lambda;
                let apart = found.iter().map(|p| (p.lambda - lambda).norm()).fold(f64::INFINITY, f64::min);
                assert!(apart < 1e-6 * lambda.norm(), "{written} Pa/m, mu {mu}: {lambda} {apart:e}");
            }
        }
    }
    for (old, new) in
        [("contact_range", "# contact_range"), ("contact_stiffness = 1e14", "contact_stiffness = -1e14")]
    {
        assert!(text.contains(old), "{old}");
        let error = Modal::read(&text.replacen(old, new, 1)).map(drop).expect_err(new).to_string();
        assert!(
            error.starts_with("contact_stiffness: contact_stiffness, contact_range and stiffness_contact"),
            "{error}"
        );
    }
}

/// A study says how many vectors its file has at most.
#[test]
fn fewer_vectors_are_those_that_hold_most() {
    let (outcome, few) = modal(&format!("{}\n[output]\nmodal = true\nvectors = 16\n", pushed()));
    assert_eq!(few.size(), 16);
    for (i, mu) in [(0, 0.0), (10, 0.2), (25, 0.5)] {
        let found = pairs(&few.at(mu, 0.0)).expect("pairs");
        for mode in &outcome.modes {
            let lambda = mode.states[i].lambda;
            let apart = found.iter().map(|p| (p.lambda - lambda).norm()).fold(f64::INFINITY, f64::min);
            assert!(apart < 1e-4 * lambda.norm(), "mu {mu}: {lambda} {apart:e}");
        }
    }
    for (output, wanted) in [
        ("modal = true\nvectors = 65", "output.vectors: there are 65 vectors, it must be 1 to 64"),
        ("vectors = 8", "output.vectors: vectors are counted, but no projected problem is written"),
    ] {
        let document = Document::read(&format!("{PIN}\n[output]\n{output}\n")).expect("TOML");
        let error = Study::new(document, &|_| Err(String::new())).map(drop).expect_err(output).to_string();
        assert!(error.starts_with(wanted), "{error}");
    }
}
