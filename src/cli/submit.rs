//! `squealmap submit`: a sweep as jobs of a cluster.

use std::ffi::OsString;
use std::path::Path;

use crate::cli::environment;
use crate::cli::error::{Error, Result};
use crate::cli::files::Files;
use crate::cli::output::Output;
use crate::cli::run::Run;
use crate::cli::scheduler::call;
use crate::cli::talk::{note, print};
use clap::{Args, Parser};
use squealmap::cluster::slurm::{DEFAULT_MAX_ARRAY_SIZE, Jobs, LOGS, job_number, max_array_size};
use squealmap::cluster::tasks::{Means, tasks};
use squealmap::engine::backend::Backend;
use squealmap::store::tiling::Tiling;
use squealmap::sweep::accuracy::level::Level;
use squealmap::sweep::estimate::estimate;
use squealmap::sweep::spec::Spec;

/// Arguments of `submit`.
#[derive(Debug, Args)]
pub(crate) struct Submit {
    #[command(flatten)]
    files: Files,
    /// To Slurm: an array job of which every task computes a share of the tiles, and a job that merges them
    #[arg(long, required = true)]
    slurm: bool,
    /// Partition of both jobs [default: the cluster's]
    #[arg(long, value_name = "NAME")]
    partition: Option<String>,
    /// GPU of a task, `1` or `TYPE:1`: a run uses one [default: none]
    #[arg(long, value_name = "[TYPE:]N")]
    gpus: Option<String>,
    /// Cores of a task
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1024))]
    cpus: u16,
    /// Time limit of a task in a form of Slurm, such as 30 (minutes) or 4:00:00; a minute before it the run ends with the
    /// tiles that are done, and the task is queued again [default: the partition's]
    #[arg(long, value_name = "TIME", value_parser = time_limit)]
    time: Option<String>,
    /// Tasks of the array [default: by the cost that `check` measures, ten minutes each or more]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    tasks: Option<u32>,
    /// Most tasks that run at the same time [default: as many as Slurm starts]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    at_once: Option<u32>,
    /// One more option of sbatch for both jobs, such as --sbatch=--account=brakes; may be repeated
    #[arg(long, value_name = "OPTION")]
    sbatch: Vec<String>,
    /// Submit nothing: print a shell program that would
    #[arg(long)]
    dry_run: bool,
    /// Options of `run` for every task, after `--`
    #[arg(last = true, value_name = "OPTIONS OF RUN")]
    run: Vec<String>,
}

/// The form of `run` that the options after `--` must have.
#[derive(Parser)]
#[command(name = "squealmap submit … --", no_binary_name = true, disable_help_flag = true)]
struct Tail {
    #[command(flatten)]
    run: Run,
}

impl Submit {
    pub(crate) fn execute(self) -> Result<()> {
        let spec = Spec::read(&self.files.sweep)?;
        if spec.refine.is_some() {
            return Err(Error::RefineBeside { option: "`submit`" });
        }
        let tail = self.tail()?;
        let tiling = Tiling { instances: spec.grid.len(), tile: tail.run.tile(&spec) };
        let here = Path::new(".");
        let most = match call("scontrol", &["show".to_owned(), "config".to_owned()], here, "") {
            Ok(config) => max_array_size(&config).unwrap_or(DEFAULT_MAX_ARRAY_SIZE),
            Err(why) if self.dry_run => {
                note(&format!("{why}; arrays are taken to have at most {DEFAULT_MAX_ARRAY_SIZE} tasks"));
                DEFAULT_MAX_ARRAY_SIZE
            }
            Err(why) => return Err(why),
        };
        let tasks = self.tasks(&spec, tiling, most);
        let jobs = self.jobs(&tail.run, tasks)?;
        if self.dry_run {
            print(&jobs.by_hand());
            return Ok(());
        }
        // A task that is refused on its node is seen too late.
        tail.run.replace().file(&self.files.directory()?, &self.files.sweep, "tiles")?;
        let logs = Output::prepare(self.files.directory()?.join(LOGS), &[])?;
        let (array, merge) = submit(&jobs, logs.directory())?;
        let kept = logs.keep();
        print(&format!(
            "job {array}: {tasks} task(s) for {} tiles of {} instances; job {merge} then merges them\n\
             logs in {}; `squealmap status {}` says how far they are\n",
            tiling.count(),
            tiling.instances,
            kept.display(),
            self.files.directory()?.display()
        ));
        Ok(())
    }

    /// The options after `--`, read by the command they are for. One that it does not know ends the program here, not
    /// on a node.
    fn tail(&self) -> Result<Tail> {
        let own: [OsString; 5] =
            ["-o".into(), self.files.directory()?.into(), "--shard".into(), "0/1".into(), "--".into()];
        let (options, sweep) = own.split_at(4);
        let words = options.iter().cloned().chain(self.run.iter().map(OsString::from));
        Ok(Tail::parse_from(words.chain(sweep.iter().cloned()).chain([self.files.sweep.clone().into()])))
    }

    /// The number of tasks.
    fn tasks(&self, spec: &Spec, tiling: Tiling, most: usize) -> usize {
        let Some(asked) = self.tasks else {
            let means = Means { cpus: self.cpus, gpu: self.gpus.is_some() };
            return tasks(estimate(spec).cpu_time, means, tiling.count(), most);
        };
        let asked = usize::try_from(asked).unwrap_or(usize::MAX);
        let taken = asked.min(tiling.count()).min(most).max(1);
        if taken < asked {
            note(&if taken == most {
                format!(
                    "--tasks is {asked}, of which this cluster takes {most} in an array; each computes more tiles"
                )
            } else {
                format!(
                    "--tasks is {asked}, but the sweep has only {taken} tile(s); that many tasks are taken"
                )
            });
        }
        taken
    }

    /// The jobs.
    fn jobs(&self, run: &Run, tasks: usize) -> Result<Jobs> {
        if run.reuses() {
            return Err(Error::ReuseInJobs);
        }
        if let Some(gpus) = self.gpus.as_deref().filter(|gpus| gpus.rsplit(':').next() != Some("1")) {
            return Err(Error::ManyGpus { gpus: gpus.to_owned() });
        }
        let absolute = |path: &Path| {
            let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
            let text = whole.to_str().filter(|text| !text.contains(char::is_control)).map(str::to_owned);
            text.ok_or_else(|| Error::PathOfJob { path: path.to_owned() })
        };
        let program = environment::program().map_err(|why| Error::OwnProgram { why: why.to_string() })?;
        let (program, directory) = (absolute(&program)?, absolute(&self.files.directory()?)?);
        let sweep = absolute(&self.files.sweep)?;
        let stem = self.files.sweep.file_stem().unwrap_or_default().to_string_lossy();
        let mut words = vec![program.clone(), "run".to_owned(), sweep, "-o".to_owned(), directory.clone()];
        words.extend(self.engine(run).map(str::to_owned));
        if run.threads().is_none() {
            words.push(format!("--threads={}", self.cpus));
        }
        words.extend(self.run.iter().cloned());
        Ok(Jobs {
            name: format!("squealmap-{stem}"),
            run: words,
            program,
            directory,
            tasks,
            at_once: self.at_once.and_then(|most| usize::try_from(most).ok()),
            cpus: self.cpus,
            gpus: self.gpus.clone(),
            time: self.time.clone(),
            partition: self.partition.clone(),
            options: self.sbatch.clone(),
        })
    }

    /// All tasks must take the same engine, whatever their nodes have: tiles of several never mix.
    fn engine(&self, run: &Run) -> impl Iterator<Item = &'static str> {
        let words: &[&str] = match (run.backend(), run.accuracy()) {
            (Backend::Auto, Some(Level::Reference)) => &[],
            (Backend::Auto, _) if self.gpus.is_some() => &["--backend=gpu"],
            (Backend::Auto, _) => &["--backend=cpu"],
            _ => &[],
        };
        words.iter().copied()
    }
}

/// A time limit in one of the forms of Slurm: minutes, minutes:seconds, hours:minutes:seconds, days-hours,
/// days-hours:minutes, days-hours:minutes:seconds.
fn time_limit(text: &str) -> std::result::Result<String, String> {
    let (days, rest) = text.split_once('-').map_or((None, text), |(days, rest)| (Some(days), rest));
    let parts: Vec<&str> = days.into_iter().chain(rest.split(':')).collect();
    let is_number =
        |part: &&str| !part.is_empty() && part.len() <= 9 && part.bytes().all(|c| c.is_ascii_digit());
    let fits = rest.split(':').count() <= 3 && parts.iter().all(is_number);
    if fits && parts.iter().any(|part| part.bytes().any(|c| c != b'0')) {
        return Ok(text.to_owned());
    }
    Err("must be a time of Slurm: minutes (30), h:mm:ss (4:00:00), or days-hours (1-12)".to_owned())
}

/// Submits both jobs, or none; returns their numbers.
fn submit(jobs: &Jobs, logs: &Path) -> Result<(String, String)> {
    let sbatch = |arguments: &[String], script: &str| {
        let printed = call("sbatch", arguments, logs, script)?;
        job_number(&printed).map(str::to_owned).ok_or_else(|| {
            let why =
                format!("it printed `{}` instead of the number of a job", printed.trim().escape_default());
            Error::Scheduler { program: "sbatch", why }
        })
    };
    let array = sbatch(&jobs.array_arguments(), &jobs.array_script())?;
    let merge = sbatch(&jobs.merge_arguments(&array), &jobs.merge_script()).map_err(|why| {
        match call("scancel", std::slice::from_ref(&array), logs, "") {
            Ok(_) => why,
            Err(_) => Error::HalfSubmitted { array: array.clone(), why: why.to_string() },
        }
    })?;
    Ok((array, merge))
}
