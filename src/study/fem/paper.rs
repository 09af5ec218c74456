//! Section 4.2 of the paper, its finite-element model: what of it holds, as a report with its Figures 15 to 17.

use std::fmt::Write as _;

use squealmap_fem::c64;
use squealmap_fem::study::{Event, Outcome, Shape, Study, Transition};

use crate::study::paper::{Claim, Verdict};
use crate::version::program;

/// The frequency at which two modes coalesce in the paper, Hz.
const COALESCENCE: f64 = 14_500.0;
/// How far off it may be, Hz.
const WITHIN: f64 = 100.0;

/// What is known here of the paper's section on its finite-element model, and whether a study of it bears it out.
#[must_use]
pub fn claims(study: &Study, outcome: &Outcome) -> Vec<Claim> {
    let met = outcome.transitions.iter().find(|t| t.event == Event::Coalescence);
    vec![coalesce(met), grows_from_there(study, outcome, met)]
}

fn coalesce(met: Option<&Transition>) -> Claim {
    let tuned = "the paper does not describe the holders; their height here, and the modulus of the samples, are tuned to this \
                 frequency, so that it is no test";
    let found = met.map_or_else(
        || "no two modes coalesce".to_owned(),
        |t| {
            let modes: Vec<String> = t.modes.iter().map(|mode| (mode + 1).to_string()).collect();
            format!("modes {} at μ = {:.4}, at {:.2} kHz", modes.join(" and "), t.mu, t.frequency / 1e3)
        },
    );
    let near = met.is_some_and(|t| (t.frequency - COALESCENCE).abs() <= WITHIN);
    Claim {
        figure: "16",
        says: "two modes coalesce at 14.5 kHz while friction rises",
        found,
        verdict: if near { Verdict::Under(tuned.to_owned()) } else { Verdict::NotReproduced },
    }
}

fn grows_from_there(study: &Study, outcome: &Outcome, met: Option<&Transition>) -> Claim {
    let says = "from there on a mode is unstable";
    let Some(met) = met else {
        return Claim {
            figure: "16",
            says,
            found: "no two modes coalesce".to_owned(),
            verdict: Verdict::NotReproduced,
        };
    };
    let grows = |i: usize| (0..outcome.modes.len()).any(|mode| outcome.grows(mode, i));
    let (above, below): (Vec<usize>, Vec<usize>) = (0..study.mus.len()).partition(|i| study.mus[*i] > met.mu);
    let growing = |some: &[usize]| some.iter().filter(|i| grows(**i)).count();
    let last = study.mus.len() - 1;
    let largest = outcome.modes.iter().map(|mode| mode.states[last].lambda.re).fold(0.0, f64::max);
    let found = format!(
        "a mode grows at {} of the {} values of friction above and at {} of the {} below; at μ = {} with {largest:.0} 1/s",
        growing(&above),
        above.len(),
        growing(&below),
        below.len(),
        study.mus[last]
    );
    let holds = !above.is_empty() && growing(&above) == above.len() && growing(&below) == 0;
    let verdict = if holds { Verdict::Reproduced } else { Verdict::NotReproduced };
    Claim { figure: "16", says, found, verdict }
}

/// The report in Markdown; `directory` is where the pictures stand, seen from the report, and `command` what made it.
#[must_use]
pub fn report(study: &Study, outcome: &Outcome, directory: &str, command: &str) -> String {
    let mut text = format!(
        "# The paper's finite-element model computed again\n\n\
         Two friction samples in their holders, pressed together and sliding: complex modes over the coefficient of friction. Made \
         by\n\n```sh\n{command}\n```\n\nwith {}. The study is `sweeps/fem/paper.toml` of the sources and built into the program; \
         `docs/fem_paper.md` says what of it is the paper's and what is assumed.\n\n\
         ## Claims of section 4.2\n\n| where | the paper | found | verdict |\n|---|---|---|---|\n",
        program()
    );
    let claims = claims(study, outcome);
    for Claim { figure, says, found, verdict } in &claims {
        let _ = writeln!(text, "| {figure} | {says} | {found} | **{}** |", verdict.words());
    }
    for Claim { says, verdict, .. } in &claims {
        if let Verdict::Under(condition) = verdict {
            let _ = write!(text, "\nThe condition of \"{says}\": {condition}.\n");
        }
    }
    let figures = [
        ("figure15", "Figure 15: the mesh", sizes(study, outcome)),
        ("figure16", "Figure 16: frequencies and growth rates over friction", pressed(outcome)),
        ("figure17", "Figure 17: modes before and after they coalesce", faces(study, outcome)),
    ];
    text.push_str("\n## Figures\n");
    for (name, heading, caption) in figures {
        let _ = write!(text, "\n### {heading}\n\n![{heading}]({directory}/{name}.png)\n\n{caption}\n");
    }
    text
}

fn sizes(study: &Study, outcome: &Outcome) -> String {
    let elements: usize = study.parts.iter().map(|(_, _, elements)| elements).sum();
    format!("{elements} elements, {} unknowns, {} points of contact.", outcome.unknowns, outcome.points)
}

fn pressed(outcome: &Outcome) -> String {
    let residual = outcome.residual();
    let pressed = outcome.pressed.as_ref().map_or_else(String::new, |pressed| {
        format!("Pressed with {:.1} N; {} points of contact gape. ", pressed.force, pressed.open)
    });
    format!("{pressed}Largest residual of any mode at any friction: {residual:.1e}.")
}

/// What the sliding face does in each shape.
fn faces(study: &Study, outcome: &Outcome) -> String {
    let mut text = "Mean displacement of the slaves' sliding face, over the largest of the mode:\n\n\
                    | mode | μ | kHz | 1/s | along the sliding | normal | phase of normal over tangential |\n|---|---|---|---|---|---|---|\n"
        .to_owned();
    for shape in &outcome.shapes {
        let [along, normal] = means(study, shape);
        let growth = format!("{:.1}", shape.lambda.re + 0.0).replace('-', "−");
        let phase = if along.norm() > 1e-3 && normal.norm() > 1e-3 {
            format!("{:.0}°", (normal / along).arg().to_degrees() + 0.0).replace('-', "−")
        } else {
            String::new()
        };
        let _ = writeln!(
            text,
            "| {} | {} | {:.3} | {growth} | {:.3} | {:.3} | {phase} |",
            shape.mode + 1,
            shape.mu,
            shape.lambda.im / std::f64::consts::TAU / 1e3,
            along.norm(),
            normal.norm()
        );
    }
    text
}

/// The mean displacement of the slaves along the sliding and along the normal, over the largest of the mode.
fn means(study: &Study, shape: &Shape) -> [c64; 2] {
    let contact = &study.model.contact;
    let part = |u: &[c64; 3], axis: &[f64; 3]| (0..3).map(|i| u[i] * axis[i]).sum::<c64>();
    let sum = |axis: fn(&squealmap_fem::assembly::Point) -> &[f64; 3]| {
        contact.iter().map(|point| part(&shape.displacement[point.slave], axis(point))).sum::<c64>()
    };
    let length = |u: &[c64; 3]| u.iter().map(c64::norm_sqr).sum::<f64>().sqrt();
    let largest = shape.displacement.iter().map(length).fold(f64::MIN_POSITIVE, f64::max);
    [sum(|point| &point.direction), sum(|point| &point.normal)]
        .map(|sum| sum / (largest * contact.len().max(1) as f64))
}
