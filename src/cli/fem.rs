//! `squealmap fem`: bodies in sliding contact by finite elements.

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::cli::error::Result;
use clap::Args;
use serde_json::json;
use squealmap::results::figure::look::Look;
use squealmap::store::space::bytes;
use squealmap::study::fem::{Bodies, Curves, of_study, open};
use squealmap_fem::study::{Outcome, Study, compute, estimate, manifest, shapes, table, vary_table};

use crate::cli::home::{Replace, prepare};
use crate::cli::output::{Output, list};
use crate::cli::pictures::png_of;
use crate::cli::progress::seconds;
use crate::cli::talk::{self, note, print};

/// What is written; the figures where there is something to draw, the last two where they are asked for.
const FILES: [&str; 13] = [
    "fem.csv",
    "manifest.json",
    "shapes.vtu",
    "fem.svg",
    "fem.png",
    "shapes.svg",
    "shapes.png",
    "mesh.svg",
    "mesh.png",
    "vary.svg",
    "vary.png",
    "modes.toml",
    "vary.csv",
];

/// Arguments of `fem`.
#[derive(Debug, Args)]
pub(crate) struct FemCommand {
    /// Description of the bodies, their contact and the range of friction (TOML)
    study: PathBuf,
    /// Output directory [default: out/<name of the file>, with a number where another file of this name has that]
    #[arg(short, long, visible_alias = "out", value_name = "DIR")]
    output: Option<PathBuf>,
    /// Say how many unknowns there are and what they would cost; compute and write nothing
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    replace: Replace,
}

impl FemCommand {
    pub(crate) fn execute(self) -> Result<()> {
        let (study, text) = open(&self.study)?;
        let wrong = |why: squealmap_fem::Error| of_study(&self.study, &text, &why);
        for remark in &study.remarks {
            note(remark);
        }
        talk::tell("remarks", study.remarks.clone());
        if self.check {
            return Ok(check(&study).map_err(wrong)?);
        }
        // Proven now, made once there is something to write: a study that is stopped leaves nothing.
        let output = prepare(&self.study, self.output.as_deref(), &FILES)?;
        let directory = output.directory().to_owned();
        self.replace.files(&directory, &self.study, &FILES)?;
        drop(output);
        let outcome = compute(&study, &mut |step| note(&format!("{step} ..."))).map_err(wrong)?;
        for remark in &outcome.remarks {
            note(remark);
        }
        talk::tell("remarks", [study.remarks.as_slice(), &outcome.remarks].concat());
        print(&said(&study, &outcome));
        let program = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));
        let mut files = vec![
            (FILES[0], table(&study, &outcome)),
            (FILES[1], manifest(&study, &outcome, &text, program)),
            (FILES[2], shapes(&study, &outcome)),
        ];
        let (look, bodies) = (Look::default(), Bodies::of(&study, &outcome));
        let drawn = [
            Curves::of(&study, &outcome).svg(&look),
            bodies.shapes_svg(&look),
            Some(bodies.mesh_svg(&look)),
            Curves::varied(&study, &outcome).and_then(|curves| curves.svg(&look)),
        ];
        if let Some(modal) = &outcome.modal {
            files.push((FILES[11], modal.write()));
        }
        if let Some(varied) = vary_table(&study, &outcome) {
            files.push((FILES[12], varied));
        }
        for (svg, names) in drawn.into_iter().zip(FILES[3..11].chunks_exact(2)) {
            if let Some(svg) = svg {
                files.push((names[1], png_of(&svg)?));
                files.push((names[0], svg.into_bytes()));
            }
        }
        let mut output = Output::prepare(directory, &FILES)?;
        self.replace.files(output.directory(), &self.study, &FILES)?;
        output.made_from(&self.study)?;
        print(&list(&output.write_alone(&files, &FILES)?));
        Ok(())
    }
}

/// Size and cost.
fn check(study: &Study) -> std::result::Result<(), squealmap_fem::Error> {
    let cost = estimate(study)?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bytes of a memory")]
    let memory = cost.memory as u64;
    print(&format!(
        "nodes     {}\nelements  {}\nunknowns  {} (degrees of freedom that no support, bond or contact takes)\ncontact   {} points\nmemory    about {}\n\
         time      about {} on two cores\n",
        cost.nodes,
        cost.elements,
        cost.unknowns,
        cost.points,
        bytes(memory),
        seconds(cost.seconds)
    ));
    talk::tell("valid", true);
    talk::tell("unknowns", cost.unknowns);
    talk::tell("contact_points", cost.points);
    talk::tell("memory_bytes", memory);
    talk::tell("seconds", cost.seconds);
    Ok(())
}

/// What was found, in words.
fn said(study: &Study, outcome: &Outcome) -> String {
    let mut text = format!(
        "{} unknowns, {} contact points, {} modes; largest residual {:.1e}\n",
        outcome.unknowns,
        outcome.points,
        outcome.modes.len(),
        outcome.residual()
    );
    if let Some(pressed) = outcome.pressed.as_ref() {
        let _ = writeln!(text, "pressed with {:.4} N; {} points gape", pressed.force, pressed.open);
    }
    if let Some(plain) = &outcome.unstressed {
        let moved = outcome.real.iter().zip(plain).map(|(with, without)| with / without - 1.0);
        let farthest = moved.max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0);
        let _ = writeln!(text, "the stress moves real frequencies by up to {farthest:.2e} of themselves");
    }
    if let Some(k) = study.document.friction.contact_stiffness {
        let _ = writeln!(text, "contact stiffness {k:e} Pa/m: mu_c depends on it");
    }
    for t in &outcome.transitions {
        let modes: Vec<String> = t.modes.iter().map(|mode| (mode + 1).to_string()).collect();
        let (event, modes) = (t.event.name(), modes.join(" and "));
        let _ = writeln!(text, "{event} of mode {modes} at mu = {:.6}, {:.2} Hz", t.mu, t.frequency);
    }
    if outcome.transitions.is_empty() {
        text += "no mode becomes unstable or stable in the range\n";
    }
    let transitions = outcome.transitions.iter().map(|t| {
        json!({ "event": t.event.name(), "mu_c": t.mu, "frequency": t.frequency,
                "modes": t.modes.iter().map(|mode| mode + 1).collect::<Vec<_>>() })
    });
    talk::tell("transitions", transitions.collect::<serde_json::Value>());
    talk::tell("unknowns", outcome.unknowns);
    text
}
