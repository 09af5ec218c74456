//! A share of the tiles of a sweep: of runs of tiles `k/n` takes the runs k, k + n, k + 2n, …

use std::fmt;

/// The environment variables in which a launcher says which of its tasks this is: its number, the first number, the step,
/// and how many tasks there are.
struct Launcher {
    number: &'static str,
    first: &'static str,
    step: &'static str,
    of: &'static str,
}

/// Launchers in the order in which they are asked. Kubernetes, PBS and HyperQueue do not say how many there are.
const LAUNCHERS: [Launcher; 9] = [
    slurm_array(),
    alone("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"),
    alone("PMIX_RANK", "PMIX_SIZE"),
    alone("PMI_RANK", "PMI_SIZE"),
    alone("JOB_COMPLETION_INDEX", ""),
    alone("PBS_ARRAY_INDEX", ""),
    alone("PBS_ARRAYID", ""),
    alone("HQ_TASK_ID", ""),
    alone("SLURM_PROCID", "SLURM_NTASKS"),
];

const fn slurm_array() -> Launcher {
    Launcher {
        number: "SLURM_ARRAY_TASK_ID",
        first: "SLURM_ARRAY_TASK_MIN",
        step: "SLURM_ARRAY_TASK_STEP",
        of: "SLURM_ARRAY_TASK_COUNT",
    }
}

const fn alone(number: &'static str, of: &'static str) -> Launcher {
    Launcher { number, first: "", step: "", of }
}

/// Most tiles of a run: a GPU computes some together, and begins those that follow.
const LONGEST_RUN: usize = 16;

/// Runs that each share has at least, where runs are longer than a tile: parts of a sweep differ in what they cost.
const RUNS: usize = 8;

/// A share of the tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// The number of the share, below `of`.
    pub number: usize,
    /// The number of shares, at least 1.
    pub of: usize,
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl Shard {
    /// Its tiles among `count`.
    pub fn tiles(self, count: usize) -> impl Iterator<Item = usize> {
        let run = (count / (RUNS * self.of)).clamp(1, LONGEST_RUN);
        (0..count).filter(move |tile| tile / run % self.of == self.number)
    }

    /// Reads `k/n`, `auto` or `auto/n`, where the launcher of this process says the rest. With `auto/n` any
    /// consecutive numbers will do, from wherever they count.
    ///
    /// # Errors
    /// What is wrong, as the end of a sentence.
    pub fn parse(text: &str, variable: &dyn Fn(&str) -> Option<String>) -> Result<Shard, String> {
        let number = |text: &str| text.parse::<usize>().ok();
        match text.split_once('/') {
            None if text == "auto" => automatic(None, variable),
            Some(("auto", of)) => match number(of).filter(|of| *of > 0) {
                Some(of) => automatic(Some(of), variable),
                None => Err(form()),
            },
            Some((k, of)) => match (number(k), number(of)) {
                (Some(k), Some(of)) if k < of => Ok(Shard { number: k, of }),
                (Some(k), Some(of)) => {
                    Err(format!("shard {k} of {of} does not exist; they count from 0 to n - 1"))
                }
                _ => Err(form()),
            },
            None => Err(form()),
        }
    }
}

fn form() -> String {
    "write k/n with k from 0 to n - 1, or auto, or auto/n".to_owned()
}

/// The shard of the first launcher that is found.
fn automatic(of: Option<usize>, variable: &dyn Fn(&str) -> Option<String>) -> Result<Shard, String> {
    let number = |name: &str| variable(name).and_then(|text| text.trim().parse::<usize>().ok());
    let Some((launcher, id)) = LAUNCHERS.iter().find_map(|one| Some((one, number(one.number)?))) else {
        let names: Vec<&str> = LAUNCHERS.iter().map(|one| one.number).collect();
        return Err(format!("none of {} is set to a number; write k/n", names.join(", ")));
    };
    let Launcher { number: name, .. } = *launcher;
    if let Some(of) = of {
        return Ok(Shard { number: id % of, of });
    }
    let Some(of) = number(launcher.of).filter(|of| *of > 0) else {
        return Err(format!("{name} does not say of how many; write auto/n"));
    };
    let first = number(launcher.first).unwrap_or(0);
    let step = number(launcher.step).filter(|step| *step > 0).unwrap_or(1);
    match id.checked_sub(first).map(|from| from / step) {
        Some(place) if place < of => Ok(Shard { number: place, of }),
        _ => Err(format!("{name} is {id}, which is none of {of} numbers from {first}; write auto/n or k/n")),
    }
}
