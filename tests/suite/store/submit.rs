//! `submit`: the scripts of a cluster, run here by a shell, with programs in the place of Slurm's that write down how
//! they are called. A real Slurm is that of `.ci/slurm.sh`.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fs::{self, read_to_string};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use tempfile::TempDir;

use crate::cli::program::{Ended, squealmap, unwrapped};
use crate::store::resume::{SWEEP, names, tiles, with};

/// What a quoting that is not one would fall over.
const NAME: &str = "it's a \"$x\" %d `y` \\dir";

/// Writes its arguments, one a line, and its input to files beside it; prints a number.
const SBATCH: &str = "#!/bin/sh\nn=$(ls \"$FAKE\"/sbatch-*.script 2>/dev/null | wc -l)\n\
    printf '%s\\n' \"$@\" >\"$FAKE/sbatch-$n.arguments\"\ncat >\"$FAKE/sbatch-$n.script\"\npwd >\"$FAKE/sbatch-$n.pwd\"\n\
    echo $((41 + n))\n";
const SCONTROL: &str = "#!/bin/sh\ncase $1 in show) echo 'MaxArraySize            = 4';; \
    *) echo \"$@\" >>\"$FAKE/scontrol.calls\";; esac\n";
const SCANCEL: &str = "#!/bin/sh\necho \"$@\" >\"$FAKE/scancel.calls\"\n";

/// Copies a file for being run, by a process of its own: one that this process has open for writing, while another
/// thread starts a program, cannot be run.
pub(crate) fn copy_program(from: &Path, to: &Path) {
    let copied = Command::new("cp").args([from, to]).status().unwrap();
    assert!(copied.success());
    fs::set_permissions(to, fs::Permissions::from_mode(0o755)).unwrap();
}

/// A directory of programs.
fn fakes(programs: &[(&str, &str)]) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    for (name, text) in programs {
        let path = directory.path().join(name);
        let written = path.with_extension("text");
        fs::write(&written, text).unwrap();
        copy_program(&written, &path);
    }
    directory
}

fn slurm() -> TempDir {
    fakes(&[("sbatch", SBATCH), ("scontrol", SCONTROL), ("scancel", SCANCEL)])
}

/// A command that finds the programs of `fakes` first; without the others of the machine, no real Slurm is found.
fn beside(fakes: &Path, program: &str, directory: &Path) -> Command {
    let mut command = Command::new(program);
    let path = format!("{}:{}", fakes.display(), std::env::var("PATH").unwrap());
    command.current_dir(directory).env("PATH", path).env("FAKE", fakes).env("NO_COLOR", "1");
    command.env("XDG_CACHE_HOME", directory.join("no-cache"));
    command
}

fn ended(mut command: Command) -> Ended {
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    Ended { code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
}

fn submit(fakes: &Path, directory: &Path, arguments: &[&str]) -> Ended {
    let mut command = beside(fakes, env!("CARGO_BIN_EXE_squealmap"), directory);
    command.args(["submit", "s.toml", "--slurm"]).args(arguments);
    ended(command)
}

/// What a call of the fake `sbatch` was given: arguments, script and where.
fn calls(fakes: &Path) -> Vec<[String; 3]> {
    let read = |number: usize, what: &str| read_to_string(fakes.join(format!("sbatch-{number}.{what}")));
    // There are two at most.
    let call = |number| {
        let script = read(number, "script").ok()?;
        Some([read(number, "arguments").unwrap(), script, read(number, "pwd").unwrap()])
    };
    (0..9).map_while(call).collect()
}

/// A sweep in a directory of a bad name.
fn nasty() -> (TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let inside = directory.path().join(NAME);
    fs::create_dir(&inside).unwrap();
    fs::write(inside.join("s.toml"), SWEEP).unwrap();
    (directory, inside)
}

const TILED: [&str; 3] = ["--", "--tile", "32"];

#[test]
fn the_scripts_compute_the_sweep() {
    let whole = with(SWEEP);
    let run = ["run", "s.toml", "--backend", "cpu", "--tile", "32"];
    assert_eq!(squealmap(whole.path(), &run).code, Some(0));

    let (_guard, inside) = nasty();
    let fakes = slurm();
    let options =
        ["--tasks", "3", "--at-once", "2", "--partition", "p q", "--time", "30", "--gpus", "a100:1"];
    let more = ["--sbatch=--account=brakes", "--", "--tile", "32", "--backend", "cpu"];
    let submitted = submit(fakes.path(), &inside, &[&options[..], &more[..]].concat());
    assert_eq!(submitted.code, Some(0), "{}", submitted.err);
    assert!(
        submitted
            .out
            .starts_with("job 41: 3 task(s) for 10 tiles of 300 instances; job 42 then merges them\n"),
        "{}",
        submitted.out
    );
    let [array, merge] = calls(fakes.path()).try_into().unwrap();
    let common = "--parsable\n--requeue\n--nodes=1\n--ntasks=1\n--open-mode=append\n";
    assert_eq!(
        array[0],
        format!(
            "{common}--job-name=squealmap-s\n--output=%A_%a.log\n--partition=p q\n--array=0-2%2\n--cpus-per-task=1\n\
             --signal=B:USR1@60\n--gpus=a100:1\n--time=30\n--account=brakes\n"
        )
    );
    assert_eq!(
        merge[0],
        format!(
            "{common}--job-name=squealmap-s-merge\n--output=%j_merge.log\n--partition=p q\n\
             --kill-on-invalid-dep=yes\n--account=brakes\n--dependency=afterok:41\n"
        )
    );
    assert_eq!(Path::new(array[2].trim_end()), inside.canonicalize().unwrap().join("out/s/slurm"));

    for task in ["2", "0", "1"] {
        let mut command = beside(fakes.path(), "bash", Path::new("/"));
        command.args(["-c", &array[1]]).env("SLURM_ARRAY_TASK_ID", task);
        let ended = ended(command);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        assert!(ended.out.contains(&format!(" of shard {task}/3 ")), "{}", ended.out);
    }
    let mut command = beside(fakes.path(), "bash", Path::new("/"));
    command.args(["-c", &merge[1]]);
    let merged = ended(command);
    assert_eq!(merged.code, Some(0), "{}", merged.err);
    assert!(tiles(&inside) == tiles(whole.path()), "a tile differs");
    let map = |directory: &Path| fs::read(directory.join("out/s/map.csv")).unwrap();
    assert!(map(&inside) == map(whole.path()));
    assert!(!fakes.path().join("scontrol.calls").exists(), "nothing was to be requeued");
}

#[test]
fn a_dry_run_prints_a_program_that_does_the_same() {
    let (_guard, inside) = nasty();
    let options = ["--tasks", "2", "--partition", "it's $x"];
    let (real, dry) = (slurm(), slurm());
    assert_eq!(submit(real.path(), &inside, &[&options[..], &TILED].concat()).code, Some(0));
    fs::remove_dir_all(inside.join("out")).unwrap();
    let printed = submit(dry.path(), &inside, &[&options[..], &["--dry-run"], &TILED].concat());
    assert_eq!(printed.code, Some(0), "{}", printed.err);
    assert!(!inside.join("out").exists() && calls(dry.path()).is_empty(), "nothing was done");
    let mut command = beside(dry.path(), "bash", Path::new("/"));
    command.args(["-c", &printed.out]);
    let by_hand = ended(command);
    assert_eq!(by_hand.code, Some(0), "{}", by_hand.err);
    assert_eq!(calls(dry.path()), calls(real.path()));
    assert_eq!(calls(dry.path()).len(), 2);
}

#[test]
fn a_dry_run_needs_no_slurm() {
    let directory = with(SWEEP);
    let nothing = fakes(&[]);
    let mut command = beside(nothing.path(), env!("CARGO_BIN_EXE_squealmap"), directory.path());
    command.env("PATH", nothing.path()).args(["submit", "s.toml", "--slurm", "--dry-run"]);
    let printed = ended(command);
    assert_eq!(printed.code, Some(0), "{}", printed.err);
    assert!(printed.out.contains("--array=0-0"), "{}", printed.out);
    assert!(printed.err.contains("arrays are taken to have at most 1001 tasks"), "{}", printed.err);
    // It is one engine on every node.
    assert!(printed.out.contains("--backend=cpu") && printed.out.contains("--threads=1"), "{}", printed.out);
}

#[test]
fn an_array_has_as_many_tasks_as_there_are_tiles_and_the_cluster_takes() {
    let directory = with(SWEEP);
    for (asked, tile, array, note) in [
        (
            "9",
            "32",
            "--array=0-3",
            "--tasks is 9, of which this cluster takes 4 in an array; each computes more tiles\n",
        ),
        (
            "9",
            "200",
            "--array=0-1",
            "--tasks is 9, but the sweep has only 2 tile(s); that many tasks are taken\n",
        ),
        ("4", "32", "--array=0-3", ""),
    ] {
        let fakes = slurm();
        let ended = submit(fakes.path(), directory.path(), &["--tasks", asked, "--", "--tile", tile]);
        assert_eq!((ended.code, ended.err.as_str()), (Some(0), note));
        assert!(
            calls(fakes.path())[0][0].lines().any(|line| line == array),
            "{asked} tasks, {tile} instances"
        );
    }
}

#[test]
fn what_is_wrong_is_a_sentence_and_leaves_nothing() {
    const REFUSES: &str = "#!/bin/sh\necho 'sbatch: error: invalid partition specified: x' >&2\n\
        echo 'sbatch: error: Batch job submission failed' >&2\nexit 1\n";
    const REFUSES_THE_SECOND: &str = "#!/bin/sh\nif [ -e \"$FAKE/first\" ]; then echo no >&2; exit 1; fi\n\
        touch \"$FAKE/first\"; echo 7\n";
    const CHATS: &str = "#!/bin/sh\necho Submitted batch job 12\n";
    const FAILS: &str = "#!/bin/sh\nexit 3\n";
    let with_sbatch =
        |sbatch: &'static str| fakes(&[("sbatch", sbatch), ("scontrol", SCONTROL), ("scancel", SCANCEL)]);
    let refused = "`sbatch` failed: sbatch: error: invalid partition specified: x; sbatch: error: Batch job submission failed";
    for (fakes, arguments, code, sentence) in [
        (with_sbatch(REFUSES), &[][..], 1, refused),
        (with_sbatch(REFUSES_THE_SECOND), &[], 1, "`sbatch` failed: no"),
        (with_sbatch(CHATS), &[], 1, "it printed `Submitted batch job 12` instead of the number of a job"),
        (with_sbatch(FAILS), &[], 1, "`sbatch` failed: exit status: 3"),
        (slurm(), &["--gpus", "2"], 2, "--gpus is `2` but must be 1 or TYPE:1, as a run uses one GPU"),
        (slurm(), &["--", "--shard", "0/2"], 2, "'--shard <K/N>' cannot be used multiple times"),
        (slurm(), &["--", "--backend", "fpga"], 2, "invalid value 'fpga' for '--backend <BACKEND>'"),
        (slurm(), &["--", "--reuse", "old"], 2, "--reuse stands among the options of a job's tasks"),
        (slurm(), &["--time", "soon"], 2, "must be a time of Slurm"),
        (slurm(), &["--time", "0:00"], 2, "must be a time of Slurm"),
        (slurm(), &["--time", "1-2-3"], 2, "must be a time of Slurm"),
        (slurm(), &["-o", "a\nb"], 2, "the path `a\\nb` cannot stand in a job"),
    ] {
        let directory = with(SWEEP);
        let ended = submit(fakes.path(), directory.path(), arguments);
        assert!(unwrapped(&ended.err).contains(sentence), "{sentence}: {}", ended.err);
        assert_eq!(ended.code, Some(code), "{}", ended.err);
        let left: Vec<_> =
            fs::read_dir(directory.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!(left, ["s.toml"], "{sentence}");
        if fakes.path().join("first").exists() {
            assert_eq!(read_to_string(fakes.path().join("scancel.calls")).unwrap(), "7\n");
        }
    }
    let directory = with(SWEEP);
    let nothing = fakes(&[]);
    let mut command = beside(nothing.path(), env!("CARGO_BIN_EXE_squealmap"), directory.path());
    command.env("PATH", nothing.path()).args(["submit", "s.toml", "--slurm"]);
    let ended = ended(command);
    assert_eq!(ended.code, Some(2));
    assert!(ended.err.contains("`scontrol` of Slurm is not on the path"), "{}", ended.err);
}

/// Starts task 0 of an array of one whose tiles of `tile` instances take about a tenth of a second per ten.
fn task(fakes: &Path, directory: &Path, tile: &str) -> Child {
    let options = ["--tasks", "1", "--", "--backend", "cpu", "--tile", tile];
    assert_eq!(submit(fakes, directory, &options).code, Some(0));
    let script = &calls(fakes)[0][1];
    let mut command = beside(fakes, "bash", Path::new("/"));
    command.args(["-c", script]).env("SLURM_ARRAY_TASK_ID", "0").env("SLURM_JOB_ID", "97");
    command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

/// The sweep with work for seconds.
fn slow() -> String {
    SWEEP.replace("points = 15", "points = 150").replace("settle = \"2 periods\"", "settle = \"400 periods\"")
}

/// Runs a task with tiles of `tile` instances until so many files with this end are there, tells it that its time limit is
/// near, and gives what it said as it was interrupted.
fn ends_near_its_limit(fakes: &Path, directory: &Path, tile: &str, (count, end): (usize, &str)) -> String {
    let mut child = task(fakes, directory, tile);
    while there(directory, end) < count {
        assert!(child.try_wait().unwrap().is_none(), "it ended before its time");
        sleep(Duration::from_millis(1));
    }
    let sent = Command::new("sh").args(["-c", &format!("kill -USR1 {}", child.id())]).status().unwrap();
    assert!(sent.success());
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{err}");
    err
}

fn there(directory: &Path, end: &str) -> usize {
    let Ok(entries) = fs::read_dir(directory.join("out/s/tiles")) else { return 0 };
    entries.flatten().filter(|entry| entry.file_name().to_string_lossy().ends_with(end)).count()
}

#[test]
fn near_its_time_limit_a_task_ends_with_its_tiles_and_is_queued_again() {
    let (directory, fakes) = (with(&slow()), slurm());
    let err = ends_near_its_limit(fakes.path(), directory.path(), "10", (5, ".tile"));
    assert!(err.contains("the time limit is near; the task goes on in a new one"), "{err}");
    assert_eq!(read_to_string(fakes.path().join("scontrol.calls")).unwrap(), "requeue 97\n");
    assert!((5..300).contains(&there(directory.path(), ".tile")));
    assert_eq!(
        names(directory.path()),
        ["slurm", "source.txt", "sweep.json", "tiles"],
        "nothing half-written is left"
    );
}

#[test]
fn a_task_that_has_done_nothing_is_not_queued_again() {
    let (directory, fakes) = (with(&slow()), slurm());
    let err = ends_near_its_limit(fakes.path(), directory.path(), "3000", (1, ".part"));
    assert!(err.contains("error: no tile was done within the time limit"), "{err}");
    assert!(!fakes.path().join("scontrol.calls").exists());
}
