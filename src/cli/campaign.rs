//! `squealmap campaign`: what the strokes of many records say, and those of one condition together.

use crate::cli::error::Result;
use crate::cli::output::{Output, list};
use crate::cli::pictures::png_of;
use crate::cli::records::listed;
use crate::cli::signals::SignalOptions;
use crate::cli::talk::{self, note, print};
use clap::Args;
use rayon::prelude::*;
use squealmap::results::figure::look::Look;
use squealmap::study::campaign::condition::{conditions, conditions_csv};
use squealmap::study::campaign::figure::campaign_svg;
use squealmap::study::campaign::read::document;
use squealmap::study::campaign::row::{Said, StrokeRow, strokes_csv};
use squealmap_identify::{Settings, Stroke, identify, strokes, told as told_of};
use squealmap_input::files;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The files that are written.
const FILES: [&str; 5] = ["campaign.json", "campaign.png", "campaign.svg", "conditions.csv", "strokes.csv"];

/// What one coalescence for strokes of both directions means.
const ONE_WAY: &str = "strokes go both ways, and --critical-friction is that of one of them: a structure that leans to its contact has another \
                       coalescence the other way, or none; --model knows both";

/// Arguments of `campaign`.
#[derive(Debug, Args)]
pub(crate) struct CampaignCommand {
    /// Records, or folders whose records (*.csv, *.tsv, *.txt, *.wav, *.mat, *.uff, *.unv, *.tdms) are meant
    #[arg(required = true, value_name = "RECORD")]
    records: Vec<PathBuf>,
    /// Output directory
    #[arg(short, long, value_name = "DIR", default_value = "out/campaign")]
    output: PathBuf,
    #[command(flatten)]
    signals_are: SignalOptions,
}

impl CampaignCommand {
    pub(crate) fn execute(self) -> Result<ExitCode> {
        let records = listed(&self.records)?;
        let settings = self.signals_are.settings()?;
        let output = Output::prepare(self.output, &FILES)?;
        let rows: Vec<Vec<StrokeRow>> =
            records.par_iter().map(|record| of_record(record, &settings)).collect();
        let rows = rows.concat();
        let said: Vec<Said> = rows.iter().filter_map(|row| row.said.clone().ok()).collect();
        let found = conditions(&said);
        if settings.critical_friction.is_some()
            && [true, false].iter().all(|way| said.iter().any(|s| s.forward == *way))
        {
            note(ONE_WAY);
        }
        let svg = campaign_svg("", &said, &Look::default());
        let paths = output.write(&[
            (FILES[0], document("", rows.len())?),
            (FILES[1], png_of(&svg)?),
            (FILES[2], svg.into_bytes()),
            (FILES[3], conditions_csv(&found)?),
            (FILES[4], strokes_csv(&rows)?),
        ])?;
        let mut text = String::new();
        for row in &rows {
            match &row.said {
                Ok(_) => {
                    let _ = writeln!(text, "{}, stroke {}: {}", row.record, row.number, row.told);
                }
                Err(why) => note(&format!("warning: {why}")),
            }
        }
        for one in &found {
            let _ = writeln!(text, "{one}");
        }
        print(&(text + &list(&paths)));
        if rows.iter().all(|row| row.said.is_err()) {
            talk::error("no record says anything; the column `status` of strokes.csv has the reason of each");
            return Ok(ExitCode::FAILURE);
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// The strokes of a record; one that cannot be read is a row that says why.
fn of_record(path: &Path, settings: &Settings) -> Vec<StrokeRow> {
    let name = path.display().to_string();
    let open = || files::reader(path);
    let row = |number: usize, stroke: Option<Stroke>, said: std::result::Result<Said, String>| StrokeRow {
        record: name.clone(),
        number,
        stroke,
        said,
        told: String::new(),
    };
    let all = match strokes(open, &name, settings) {
        Ok(all) => all,
        Err(why) => return vec![row(1, None, Err(why.to_string()))],
    };
    let of_stroke = |(place, stroke): (usize, Stroke)| {
        let settings = Settings { rows: Some(stroke.rows), back: !stroke.forward, ..settings.clone() };
        match identify(open, &name, &settings, &mut |_, _| {}) {
            Ok(found) => StrokeRow {
                told: told_of(&found.segments),
                ..row(place + 1, Some(stroke), Ok(Said::new(&found, &stroke)))
            },
            Err(why) => row(place + 1, Some(stroke), Err(why.to_string())),
        }
    };
    all.into_iter().enumerate().map(of_stroke).collect()
}
