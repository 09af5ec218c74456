//! `squealmap explore`: a map to look into, served to the browser of this machine, or as one page for any browser.

use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use crate::cli::engine::EngineArgs;
use crate::cli::error::{Error, Result};
use crate::cli::home::prepare_beside;
use crate::cli::output::list;
use crate::cli::serve::browser;
use crate::cli::serve::server::Server;
use crate::cli::serve::work::{Turns, Work};
use crate::cli::signal::stop_at_signal;
use crate::cli::talk::{note, print, say, tell};
use crate::cli::threads::pool;
use clap::Args;
use serde_json::json;
use squealmap::engine::backend::Backend;
use squealmap::engine::choice::choose;
use squealmap::engine::options::Options;
use squealmap::engine::precision::Precision;
use squealmap::store::origin;
use squealmap::study::error::Error as Why;
use squealmap::study::explore::finished::Finished;
use squealmap::study::explore::page::page;
use squealmap::study::explore::{Explorer, archive};
use squealmap::sweep::spec::{Analysis, Spec, Starts};

include!(concat!(env!("OUT_DIR"), "/page.rs"));

/// The file that is written.
const FILE: &str = "explore.html";

/// How often is looked whether Ctrl-C was pressed.
const LOOK: Duration = Duration::from_millis(50);

/// Arguments of `explore`.
#[derive(Debug, Args)]
pub(crate) struct ExploreCommand {
    /// Sweep file (TOML), or the output directory of a run, whose values are shown
    #[arg(value_name = "SWEEP|DIR")]
    source: PathBuf,
    /// Write the page of the sweep file into this directory instead, as one file that computes in any browser: explore.html
    #[arg(
        short,
        long,
        value_name = "DIR",
        conflicts_with_all = ["port", "no_open", "threads", "backend", "precision", "strict", "adapter", "require_gpu"]
    )]
    output: Option<PathBuf>,
    /// Port of 127.0.0.1 to listen on [default: one that is free]
    #[arg(long)]
    port: Option<u16>,
    /// Do not open the browser
    #[arg(long)]
    no_open: bool,
    #[command(flatten)]
    engine: EngineArgs,
}

/// What is looked into.
struct Source {
    spec: Spec,
    /// The sweep file, as commands are given it.
    file: String,
    finished: Option<Finished>,
}

impl ExploreCommand {
    pub(crate) fn execute(self) -> Result<()> {
        match &self.output {
            Some(directory) => self.write(directory),
            None => self.serve(),
        }
    }

    fn write(&self, directory: &Path) -> Result<()> {
        if self.source.is_dir() {
            return Err(Error::RunAsPage { path: self.source.clone() });
        }
        let spec = Spec::read(&self.source)?;
        let page = page(&spec, &self.source.display().to_string(), PAGE.ok_or(Why::NoPage)?)?;
        let paths = prepare_beside(&self.source, Some(directory), &[FILE])?.write(&[(FILE, page)])?;
        print(&format!("open it in a browser; it asks nothing of anywhere\n{}", list(&paths)));
        Ok(())
    }

    fn serve(&self) -> Result<()> {
        let cancel = stop_at_signal()?;
        let Source { spec, file, finished } = self.source()?;
        let page = page(&spec, &file, PAGE.ok_or(Why::NoPage)?)?;
        let mut told = json!({ "run": finished.as_ref().map(|run| {
            json!({ "instances": run.computed, "response": run.response, "program": run.program })
        }) });
        let pool = pool(self.engine.threads)?;
        if pool.current_thread_index().is_some() {
            return Err(Error::Serve { why: "the system gives no threads".to_owned() });
        }
        let cores = pool.current_num_threads();
        // What the page may ask for, whether the sweep does or not.
        let response = spec.modal.is_none();
        let analysis =
            Analysis { linear: true, response, checked: false, starts: Starts::One, ..spec.analysis };
        let options = self.engine.options(&cancel, &note);
        // The page asks for transients in f32, which a run beside it has in f64.
        let is_enough = finished.is_none() && [Backend::Auto, Backend::Cpu].contains(&self.engine.backend);
        let precision = options.precision.or(is_enough.then_some(Precision::F32));
        let engine = choose(&Options { precision, ..options }, &Spec { analysis, ..spec.clone() })?;
        let backend = engine.backend();
        let [_, computation] = engine.computations(&spec);
        told["cores"] = json!(cores);
        told["gpu"] = json!(backend == Backend::Gpu);
        told["by"] = json!(computation.adapter.unwrap_or_else(|| match backend {
            Backend::Cpu => format!("{cores} cores"),
            other => format!("{cores} cores, {}", other.name()),
        }));
        let explorer = Explorer::new(spec).map_err(|why| Error::Serve { why })?;
        let work = Work {
            explorer: finished.map_or(explorer.clone(), |finished| explorer.with(finished)),
            options: Options { backend, precision: self.engine.precision, ..Options::default() },
            open: (backend == Backend::Gpu).then(|| Mutex::new(engine)),
            pool,
            turns: Turns::new(cores.max(2)),
        };
        let port = self.port.unwrap_or(0);
        let listener = TcpListener::bind(("127.0.0.1", port))
            .map_err(|why| Error::Listen { port, why: why.to_string() })?;
        let server = Server::start(listener, &String::from_utf8_lossy(&page), Arc::new(work), &told)
            .map_err(|why| Error::Serve { why })?;
        let address = format!("http://{}/", server.address);
        tell("address", address.as_str());
        say(&format!("{address} shows the map, to this machine alone; Ctrl-C ends it"));
        if !self.no_open
            && let Err(why) = browser::open(&address)
        {
            note(&format!("no browser was opened: {why}; open the address by hand"));
        }
        while !cancel.load(Ordering::Relaxed) {
            std::thread::sleep(LOOK);
        }
        say("ended; a page that is still open goes on by itself");
        Ok(())
    }

    fn source(&self) -> Result<Source> {
        if !self.source.is_dir() {
            let file = self.source.display().to_string();
            return Ok(Source { spec: Spec::read(&self.source)?, file, finished: None });
        }
        let (spec, finished) = archive::read(&self.source)?;
        let file = origin::written(&self.source).filter(|file| file.is_file());
        let file = file.map_or_else(|| "SWEEP.toml".to_owned(), |file| file.display().to_string());
        Ok(Source { spec, file, finished: Some(finished) })
    }
}
