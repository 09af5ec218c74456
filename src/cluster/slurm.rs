//! The two jobs of a sweep on Slurm: an array whose tasks compute shares of the tiles, and one that merges them.
//!
//! What a user gives goes to `sbatch` as arguments and into the scripts as quoted words, never through `#SBATCH` lines:
//! these know no way to write every path.

use std::fmt::Write;

/// Slurm's limit on the size of an array, `MaxArraySize`, unless its administrator sets another. The largest index is one
/// less.
pub const DEFAULT_MAX_ARRAY_SIZE: usize = 1001;

/// Where the logs go, in the output directory.
pub const LOGS: &str = "slurm";

/// Before the time limit, Slurm sends the signal that ends a run orderly so many seconds ahead. The engines look for it
/// between batches of at most a few seconds.
const AHEAD: u32 = 60;

/// The script of a task, below the lines that are its own.
const ARRAY: &str = include_str!("array.sh");

/// A sweep as two jobs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Jobs {
    /// The name of both in the queue.
    pub name: String,
    /// The program and its arguments for a task, without the share.
    pub run: Vec<String>,
    /// The program.
    pub program: String,
    /// The output directory, absolute, on a file system of all nodes.
    pub directory: String,
    /// Tasks of the array, at least 1.
    pub tasks: usize,
    /// Tasks that run at the same time; `None` leaves it to Slurm.
    pub at_once: Option<usize>,
    /// Cores of a task.
    pub cpus: u16,
    /// GPUs of a task as Slurm writes them: `1`, `a100:1`.
    pub gpus: Option<String>,
    /// The time limit of a task as Slurm writes it.
    pub time: Option<String>,
    /// The partition of both jobs.
    pub partition: Option<String>,
    /// More options of `sbatch` for both jobs, such as `--account=brakes`.
    pub options: Vec<String>,
}

impl Jobs {
    /// The arguments of `sbatch` for the array; the script is its standard input, the logs land where it is called.
    #[must_use]
    pub fn array_arguments(&self) -> Vec<String> {
        let throttle = self.at_once.map_or_else(String::new, |most| format!("%{most}"));
        let mut arguments = self.arguments(&self.name, "%A_%a.log");
        arguments.extend([
            format!("--array=0-{}{throttle}", self.tasks - 1),
            format!("--cpus-per-task={}", self.cpus),
            format!("--signal=B:USR1@{AHEAD}"),
        ]);
        arguments.extend(self.gpus.iter().map(|gpus| format!("--gpus={gpus}")));
        arguments.extend(self.time.iter().map(|time| format!("--time={time}")));
        arguments.extend(self.options.iter().cloned());
        arguments
    }

    /// The arguments of `sbatch` for the merge job, which waits until all tasks of the array `array` are done.
    #[must_use]
    pub fn merge_arguments(&self, array: &str) -> Vec<String> {
        let mut arguments = self.merge_alone();
        arguments.push(format!("--dependency=afterok:{array}"));
        arguments
    }

    /// The arguments of the merge job that are known before the array is submitted.
    fn merge_alone(&self) -> Vec<String> {
        let mut arguments = self.arguments(&format!("{}-merge", self.name), "%j_merge.log");
        arguments.push("--kill-on-invalid-dep=yes".to_owned());
        arguments.extend(self.options.iter().cloned());
        arguments
    }

    /// The arguments that both jobs have. A task whose node fails is started again, and its log goes on.
    fn arguments(&self, name: &str, log: &str) -> Vec<String> {
        let mut arguments: Vec<String> =
            ["--parsable", "--requeue", "--nodes=1", "--ntasks=1", "--open-mode=append"]
                .map(str::to_owned)
                .into();
        arguments.extend([format!("--job-name={name}"), format!("--output={log}")]);
        arguments.extend(self.partition.iter().map(|partition| format!("--partition={partition}")));
        arguments
    }

    /// The script of a task.
    #[must_use]
    pub fn array_script(&self) -> String {
        format!(
            "#!/bin/bash\ndirectory={}\ntasks={}\nrun=({})\n{ARRAY}",
            quote(&self.directory),
            self.tasks,
            words(&self.run)
        )
    }

    /// The script that joins the shares.
    #[must_use]
    pub fn merge_script(&self) -> String {
        let words = words(&[self.program.clone(), "merge".to_owned(), self.directory.clone()]);
        format!("#!/bin/bash\nexec {words}\n")
    }

    /// A shell program that submits both jobs: what is done, for reading and for doing it by hand.
    #[must_use]
    pub fn by_hand(&self) -> String {
        let logs = quote(&format!("{}/{LOGS}", self.directory));
        let mut text = format!("#!/bin/bash\nset -e\nmkdir -p {logs}\ncd {logs}\n");
        let array = words(&self.array_arguments());
        let _ =
            write!(text, "array=$(sbatch {array} <<'END_OF_ARRAY'\n{}END_OF_ARRAY\n)\n", self.array_script());
        let merge = words(&self.merge_alone()) + " --dependency=\"afterok:${array%%;*}\"";
        let _ = write!(text, "sbatch {merge} <<'END_OF_MERGE'\n{}END_OF_MERGE\n", self.merge_script());
        text
    }
}

/// The number of a job from what `sbatch --parsable` prints: `12` or `12;cluster`. `None` when it is no number.
#[must_use]
pub fn job_number(printed: &str) -> Option<&str> {
    let number = printed.trim().split(';').next()?;
    (!number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit())).then_some(number)
}

/// The most tasks of an array from what `scontrol show config` prints; `None` when it does not say.
#[must_use]
pub fn max_array_size(config: &str) -> Option<usize> {
    let value = config.lines().find_map(|line| {
        let (key, value) = line.split_once('=')?;
        (key.trim() == "MaxArraySize").then(|| value.trim())
    });
    value?.parse().ok()
}

/// Words of a shell.
fn words(words: &[String]) -> String {
    words.iter().map(|word| quote(word)).collect::<Vec<_>>().join(" ")
}

/// One word of a shell, whatever is in it.
#[must_use]
pub fn quote(word: &str) -> String {
    // Only a zero byte cannot be quoted, and neither arguments nor paths have one.
    shlex::try_quote(word).map_or_else(|_| "''".to_owned(), std::borrow::Cow::into_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_slurm_prints_is_read() {
        assert_eq!(job_number("12\n"), Some("12"));
        assert_eq!(job_number("12;lisa\n"), Some("12"));
        for none in ["", "\n", "Submitted batch job 12", "-1"] {
            assert_eq!(job_number(none), None, "{none}");
        }
        let config =
            "Configuration data as of 2026\nMaxArrayTasks = 5\nMaxArraySize            = 4001\nX=1\n";
        assert_eq!(max_array_size(config), Some(4001));
        assert_eq!(max_array_size("MaxArraySize = many"), None);
        assert_eq!(max_array_size("MaxJobCount = 10"), None);
    }
}
