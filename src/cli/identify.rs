//! `squealmap identify`: what measured signals say.

use crate::cli::error::Result;
use crate::cli::home::prepare_beside;
use crate::cli::numbers::finite;
use crate::cli::output::list;
use crate::cli::pictures::png_of;
use crate::cli::signals::SignalOptions;
use crate::cli::talk::{is_verbose, print};
use squealmap::results::figure::look::Look;
use squealmap::study::identify::report;
use squealmap::study::identify::report::{Shown, WindowsCsv};
use squealmap::study::identify::spectrogram::spectrogram_nc;
use squealmap_identify::{
    Forces, FrictionReading, Identification, Settings, Verdict, identify, rate_of, told,
};
use squealmap_input::files;
use squealmap_input::quote::one_line;
use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;

/// The files that are written.
const FILES: [&str; 6] =
    ["figure.json", "identify.json", "identify.png", "identify.svg", "spectrogram.nc", "windows.csv"];

/// Arguments of `identify`.
#[derive(Debug, Args)]
pub(crate) struct Identify {
    /// Measured signals: CSV with a header, separated by commas, semicolons or tabs; or WAV, MAT (-v7), UFF 58 or TDMS
    signals: PathBuf,
    /// Output directory [default: out/<name of the file>]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    signals_are: SignalOptions,
    /// Instants at which the figure looks close, s: 0.12,0.25 [default: in the middles of the longest segments that vibrate]
    #[arg(long, value_name = "S,…", value_delimiter = ',', allow_hyphen_values = true, value_parser = finite)]
    zoom: Vec<f64>,
}

impl Identify {
    pub(crate) fn execute(self) -> Result<()> {
        let name = self.signals.display().to_string();
        let heading = one_line(&self.signals.file_stem().unwrap_or_default().to_string_lossy());
        let asked = self.output.clone();
        let path = self.signals.clone();
        let settings = Settings { zooms: self.zoom, ..self.signals_are.settings()? };
        let output = prepare_beside(&path, asked.as_deref(), &FILES)?;
        // Read up to three times, which a pipe cannot be.
        let open = || files::reader(&path);
        let mut windows = output.draft(FILES[5])?;
        let mut table = WindowsCsv::new(windows.file())?;
        let found = identify(open, &name, &settings, &mut |window, reading| table.add(window, reading))?;
        table.finish()?;
        let shown = Shown::new(&found, &heading);
        let svg = report::identify_svg(&shown, &Look::default())?;
        let files = [
            (FILES[0], shown.document()?),
            (FILES[1], report::report_json(&found, &name)?),
            (FILES[2], png_of(&svg)?),
            (FILES[3], svg.into_bytes()),
            (FILES[4], spectrogram_nc(&found.spectrogram, &heading)),
        ];
        let paths = output.write_beside(&files, vec![windows])?;
        print(&(summary(&found, settings.rig.is_some()) + &list(&paths)));
        Ok(())
    }
}

/// The segments with what each witness says, where these are few or more was asked for, and the verdict of the growth.
fn summary(found: &Identification, modelled: bool) -> String {
    /// The most segments of which all is said.
    const FEW: usize = 8;
    let brief = found.segments.len() > FEW && !is_verbose();
    let mut text = format!("{}\n", told(&found.segments));
    for segment in &found.segments {
        let [start, end] = segment.time;
        let Verdict { kind, reasons, .. } = &segment.verdict;
        let confidence = segment.verdict.shown_confidence();
        let within = segment.friction.is_some_and(|friction| friction.reading == FrictionReading::Within);
        let forces = match (modelled, within) {
            (true, _) => Forces::Model,
            (false, true) => Forces::Fast,
            (false, false) => Forces::Slow,
        };
        let at = segment.frequency.map_or(String::new(), |frequency| format!(" at {frequency:.1} Hz"));
        let _ = writeln!(
            text,
            "{start:.4} to {end:.4} s, {}{at}: {} (confidence {confidence:.2})",
            segment.state.words(),
            kind.words()
        );
        if let Some((mechanism, probability)) = segment.shared {
            let _ = writeln!(text, "  in any case: {} (confidence {probability:.2})", mechanism.words());
        }
        if brief {
            continue;
        }
        for reason in reasons {
            let _ = writeln!(text, "  {reason}");
        }
        if !segment.rests_on.is_empty() {
            let rests: Vec<&str> = segment.rests_on.iter().map(|witness| witness.words()).collect();
            let joint = rate_of(None, forces).map_or(String::new(), |rate| format!("; together: {rate}"));
            let _ = writeln!(text, "  rests on {}{joint}", rests.join(", "));
        }
        for testimony in &segment.testimonies {
            let said = testimony.chances.map_or("cannot speak".to_owned(), |chances| {
                let (kind, probability) = chances.leading();
                let tried = rate_of(Some(testimony.witness), forces)
                    .map_or(String::new(), |rate| format!(" ({rate})"));
                format!("{} {:.0} %{tried}", kind.words(), 100.0 * probability)
            });
            let _ = writeln!(text, "  {}: {said}: {}", testimony.witness.words(), testimony.evidence);
        }
        for contradiction in &segment.contradictions {
            let _ = writeln!(text, "  contradiction: {contradiction}");
        }
    }
    if brief {
        let _ = writeln!(
            text,
            "what each witness says of these segments is in identify.json; --verbose prints it"
        );
    }
    if found.segments.is_empty() {
        let verdict = &found.verdict;
        let _ = writeln!(text, "{} (confidence {:.2})", verdict.kind.words(), verdict.shown_confidence());
        for reason in &verdict.reasons {
            let _ = writeln!(text, "  {reason}");
        }
    }
    if let Some(friction) = found.slope {
        let (slope, [low, high]) = (friction.slope, friction.velocity);
        let _ = writeln!(
            text,
            "mean friction changes by {} s/m between {low:.3} and {high:.3} m/s",
            slope.text(1.0, 5)
        );
    }
    let _ = writeln!(
        text,
        "{} samples at {:.1} Hz, {} window(s), {} episode(s) of growth",
        found.samples,
        found.rate,
        found.windows,
        found.episodes.len()
    );
    for note in &found.notes {
        let _ = writeln!(text, "note: {note}");
    }
    text
}
