//! `squealmap merge`: tiles of several directories in one, and their results.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use crate::cli::error::Result;
use crate::cli::failed::judged;
use crate::cli::home::Replace;
use crate::cli::output::{cannot, list};
use crate::cli::results;
use crate::cli::results::{MANIFEST, Results};
use crate::cli::run::missing;
use crate::cli::signal::{INTERRUPTED, stop_at_signal};
use crate::cli::summary::summary;
use crate::cli::talk::{note, print};
use clap::Args;
use squealmap::results::manifest::Run;
use squealmap::store::directory::Store;
use squealmap::store::merge::{merge, of_one_sweep};
use squealmap::store::origin;

/// Arguments of `merge`.
#[derive(Debug, Args)]
pub(crate) struct Merge {
    /// Output directory that gets the tiles of the others and, when all are there, the results; it may be new
    target: PathBuf,
    /// Output directories of runs of the same sweep
    #[arg(value_name = "DIR")]
    sources: Vec<PathBuf>,
    #[command(flatten)]
    replace: Replace,
}

impl Merge {
    /// Begins a target for the tiles of a source, made from what that was made from.
    fn begin(&self, source: &Store) -> Result<Store> {
        let input = origin::of(&source.directory);
        self.replace.tiles(&self.target, input.as_deref(), &source.description)?;
        let store = Store::begin(&self.target, source.description.clone(), &note)?;
        self.made_from(source)?;
        Ok(store)
    }

    /// Notes in the target what a source was made from.
    fn made_from(&self, source: &Store) -> Result<()> {
        let Some(input) = origin::of(&source.directory) else { return Ok(()) };
        let path = self.target.join(origin::SOURCE);
        origin::record(&self.target, &input).map_err(|why| cannot(&path, &why))
    }

    pub(crate) fn execute(self) -> Result<ExitCode> {
        let cancel = stop_at_signal()?;
        let sources = self.sources.iter().map(|path| Ok(Store::open(path)?)).collect::<Result<Vec<_>>>()?;
        // Before anything is written.
        for two in sources.windows(2) {
            of_one_sweep(&two[0], &two[1])?;
        }
        let target = match (Store::open(&self.target), sources.first()) {
            (Err(squealmap::store::error::Error::NoTiles { .. }), Some(source)) => self.begin(source)?,
            (Ok(other), Some(source)) if self.replace.force && !other.is_same(source) => {
                self.begin(source)?
            }
            (opened, _) => opened?,
        };
        // A merge that ended before it could note that.
        if let (None, Some(source)) = (origin::written(&self.target), sources.first()) {
            self.made_from(source)?;
        }
        target.expel_strangers(&note)?;
        target.clean()?;
        let mut brought = 0;
        for source in &sources {
            brought += merge(&target, source, &cancel, &note)?;
        }
        let count = target.description.tiling.count();
        let lacking = missing(&target, (0..count).take_while(|_| !cancel.load(Ordering::Relaxed)))?.len();
        if cancel.load(Ordering::Relaxed) {
            return Ok(stopped());
        }
        let heading = format!("{brought} tiles brought, {} of {count} are there", count - lacking);
        if lacking > 0 {
            print(&format!("{heading}\n"));
            note("the results are written when all are there");
            return Ok(ExitCode::FAILURE);
        }
        let run = Run {
            threads: rayon::current_num_threads(),
            elapsed: Duration::ZERO,
            computed: 0,
            reused: None,
            stopped: None,
            tiles: None,
            accuracy: target.description.accuracy.clone(),
        };
        let ended = results::write(&target, &run, &cancel)?;
        results::tell(&target.directory);
        let code = match ended {
            Results::Lacking => {
                note("a tile went bad or was removed while it was read; run the same command again");
                ExitCode::FAILURE
            }
            Results::GivenUp => stopped(),
            Results::Stopped | Results::Fuller { .. } => {
                note("stopped; another process is writing the results");
                ExitCode::from(INTERRUPTED)
            }
            Results::Current => {
                print(&format!("{heading}; the results are those of all of them\n"));
                ExitCode::SUCCESS
            }
            Results::Written { paths, tally, .. } => {
                let counts = summary(target.description.analysis, &tally);
                print(&format!("{heading}\n\n{counts}\n{}", list(&paths)));
                ExitCode::SUCCESS
            }
        };
        Ok(judged(code, &target.directory, MANIFEST))
    }
}

/// Says what becomes of a merge that was stopped, and gives the exit code.
fn stopped() -> ExitCode {
    note(
        "stopped; the tiles that were brought stay, and no results are written; run the same command again to go on",
    );
    ExitCode::from(INTERRUPTED)
}
