//! `squealmap paper --fem`: the source paper's finite-element model computed again.

use std::path::{Path, PathBuf};

use crate::cli::error::Result;
use crate::cli::output::{Output, list};
use crate::cli::pictures::png_of;
use crate::cli::talk::{note, print};
use squealmap::results::figure::look::Look;
use squealmap::study::fem::{Bodies, Curves, claims, of_study, open, report, study};
use squealmap_fem::study::{compute, table};

/// The study.
const STUDY: &str = include_str!("../../sweeps/fem/paper.toml");

/// What stands on the command line for it.
pub(super) const BUILT_IN: &str = "built-in";

/// What is written.
const FILES: [&str; 8] = [
    "paper_fem.md",
    "paper/figure16.csv",
    "paper/figure15.png",
    "paper/figure15.svg",
    "paper/figure16.png",
    "paper/figure16.svg",
    "paper/figure17.png",
    "paper/figure17.svg",
];

/// Where its figures stand, seen from the report.
const FIGURES: &str = "paper";

/// Computes a study, and writes figures and report into a directory.
pub(crate) fn execute(output: PathBuf, path: &Path) -> Result<()> {
    let other = Some(path).filter(|path| *path != Path::new(BUILT_IN));
    let (study, text) = match other {
        Some(path) => open(path)?,
        None => (study(path, STUDY)?, STUDY.to_owned()),
    };
    let mut command = format!("squealmap paper --fem -o {}", output.display());
    if let Some(path) = other {
        command = format!("squealmap paper --fem={} -o {}", path.display(), output.display());
    }
    let output = Output::prepare(output, &FILES)?;
    let outcome = compute(&study, &mut |step| note(&format!("{step} ...")))
        .map_err(|why| of_study(path, &text, &why))?;
    for claim in claims(&study, &outcome) {
        print(&format!("{}: {}\n", claim.says, claim.verdict.words()));
    }
    let look = Look::default();
    let bodies = Bodies::of(&study, &outcome);
    let drawn =
        [Some(bodies.mesh_svg(&look)), Curves::of(&study, &outcome).svg(&look), bodies.shapes_svg(&look)];
    let mut files = vec![
        (FILES[0], report(&study, &outcome, FIGURES, &command).into_bytes()),
        (FILES[1], table(&study, &outcome)),
    ];
    for (svg, names) in drawn.into_iter().zip(FILES[2..].chunks_exact(2)) {
        if let Some(svg) = svg {
            files.push((names[0], png_of(&svg)?));
            files.push((names[1], svg.into_bytes()));
        }
    }
    print(&list(&output.write(&files)?));
    Ok(())
}
