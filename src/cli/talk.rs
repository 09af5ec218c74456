//! What a command says: results on standard output, remarks on standard error, or one JSON object for scripts.

use std::io::{ErrorKind, Write};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{LazyLock, Mutex, MutexGuard, OnceLock, PoisonError};

use clap::Args;
use serde_json::{Map, Value as Json, json};
use squealmap_input::quote::message;

/// How much is said, and how.
#[derive(Clone, Copy, Debug, Default, Args)]
pub(crate) struct Manner {
    /// Say nothing but errors: no results, no remarks, no progress
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Say more: what is cut into which tiles, where the time goes
    #[arg(short, long, global = true)]
    verbose: bool,
    /// One JSON object on standard output instead of words, for scripts
    #[arg(long, global = true)]
    json: bool,
}

static MANNER: OnceLock<Manner> = OnceLock::new();

/// The object that `--json` prints.
static OBJECT: LazyLock<Mutex<Map<String, Json>>> = LazyLock::new(Mutex::default);

/// Why standard output could not be written.
static FAILED: OnceLock<String> = OnceLock::new();

/// Whether standard output has a reader no longer, or no room.
static IS_GONE: AtomicBool = AtomicBool::new(false);

/// The key of the files that were written.
const FILES: &str = "files";
/// The key of the words of a command that has nothing else to tell.
const TEXT: &str = "text";

fn object() -> MutexGuard<'static, Map<String, Json>> {
    OBJECT.lock().unwrap_or_else(PoisonError::into_inner)
}

fn manner() -> Manner {
    MANNER.get().copied().unwrap_or_default()
}

/// Says how the command is to talk, before it says anything.
pub(crate) fn begin(manner: Manner) {
    let _ = MANNER.set(manner);
}

/// Whether nothing but errors is wanted.
pub(crate) fn is_quiet() -> bool {
    manner().quiet
}

/// Prints a result.
pub(crate) fn print(text: &str) {
    let Manner { quiet, json, .. } = manner();
    if json {
        let mut object = self::object();
        let before = object.get(TEXT).and_then(Json::as_str).unwrap_or_default();
        let whole = before.to_owned() + text;
        object.insert(TEXT.to_owned(), whole.into());
    } else if !quiet {
        out(text);
    }
}

/// Prints what a command is there for and writes nowhere else: also where nothing is to be said.
pub(crate) fn product(text: &str) {
    if manner().json { print(text) } else { out(text) }
}

/// Prints a result at once, in the middle of a command: on standard error where one object is to stand on standard output.
pub(crate) fn say(text: &str) {
    let Manner { quiet, json, .. } = manner();
    if json {
        note(text);
    } else if !quiet {
        out(&format!("{text}\n"));
    }
}

/// Writes to standard output; a reader that has gone away is no error, a full disk is one at the end.
fn out(text: &str) {
    let mut out = std::io::stdout().lock();
    if let Err(why) = out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        failed(&why);
    }
}

/// Keeps why standard output could not be written.
fn failed(why: &std::io::Error) {
    IS_GONE.store(true, Ordering::Relaxed);
    if why.kind() != ErrorKind::BrokenPipe {
        let _ = FAILED.set(why.to_string());
    }
}

/// Whether standard output is gone or full.
pub(crate) fn has_failed() -> bool {
    IS_GONE.load(Ordering::Relaxed)
}

/// A remark beside the result, on standard error.
pub(crate) fn note(text: &str) {
    if !is_quiet() {
        let _ = writeln!(std::io::stderr().lock(), "{text}");
    }
}

/// Why a command that has done its work fails, on standard error: also where nothing else is to be said.
pub(crate) fn error(why: &str) {
    let _ = writeln!(std::io::stderr().lock(), "error: {}", message(why));
}

/// Whether more was asked for.
pub(crate) fn is_verbose() -> bool {
    manner().verbose
}

/// A remark for those who asked for more.
pub(crate) fn detail(text: &str) {
    if is_verbose() {
        note(text);
    }
}

/// An entry of the object that `--json` prints.
pub(crate) fn tell(key: &str, value: impl Into<Json>) {
    object().insert(key.to_owned(), value.into());
}

/// Files that were written, for the same object.
pub(crate) fn tell_files(files: impl Iterator<Item = String>) {
    let mut object = self::object();
    if let Json::Array(all) = object.entry(FILES).or_insert_with(|| json!([])) {
        all.extend(files.map(Json::from));
    }
}

/// Prints the object, if one is wanted, and gives the exit code: another one where standard output could not be written.
pub(crate) fn end(command: &str, code: ExitCode) -> ExitCode {
    if manner().json {
        let told = std::mem::take(&mut *object());
        let number = (0..=u8::MAX).find(|number| ExitCode::from(*number) == code);
        let mut object =
            Map::from_iter([("command".to_owned(), json!(command)), ("exit_code".to_owned(), json!(number))]);
        // The words are for people; they stand in for what a command does not tell otherwise.
        let has_more = told.keys().any(|key| ![FILES, TEXT].contains(&key.as_str()));
        object.extend(told.into_iter().filter(|(key, _)| !has_more || key != TEXT));
        out(&format!("{:#}\n", Json::Object(object)));
    }
    full(code)
}

/// The exit code after help or a mistake in the arguments was printed.
pub(crate) fn after_help(printed: std::io::Result<()>, code: ExitCode) -> ExitCode {
    if let Err(why) = printed {
        failed(&why);
    }
    full(code)
}

fn full(code: ExitCode) -> ExitCode {
    match FAILED.get() {
        Some(why) => {
            let _ = writeln!(std::io::stderr().lock(), "error: cannot write to standard output: {why}");
            if code == ExitCode::SUCCESS { ExitCode::FAILURE } else { code }
        }
        None => code,
    }
}
