//! The worker threads of a command: built once, before it begins, so that no part of it starts threads that may be refused.

use crate::cli::error::Result;
use crate::cli::talk::note;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// The pool that a command runs in: as many threads as asked for or, where nothing is said, one per core. Of these as
/// many as the system gives, by halves; where it gives none the program's own thread computes.
///
/// # Errors
/// When as many as asked for cannot be started.
pub(crate) fn pool(asked: Option<u16>) -> Result<ThreadPool> {
    if let Some(threads) = asked.map(usize::from) {
        return Ok(started(threads).map_err(|why| squealmap::sweep::error::Error::Threads { threads, why })?);
    }
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let refused = match started(cores) {
        Ok(pool) => return Ok(pool),
        Err(why) => why,
    };
    let mut fewer =
        std::iter::successors(Some(cores / 2), |threads| Some(threads / 2)).take_while(|&n| n > 0);
    let pool = fewer.find_map(|threads| started(threads).ok());
    let (pool, given) = match pool {
        Some(pool) => {
            let given = format!("{} started", pool.current_num_threads());
            (pool, given)
        }
        None => (
            own().map_err(|why| squealmap::sweep::error::Error::Threads { threads: 1, why })?,
            "the program's own is used".to_owned(),
        ),
    };
    note(&format!(
        "{cores} worker thread(s) cannot be started: {refused}; {given}; raise the limits on threads and memory \
         (`ulimit -u`, `ulimit -v`) for more"
    ));
    Ok(pool)
}

fn started(threads: usize) -> std::result::Result<ThreadPool, String> {
    ThreadPoolBuilder::new().num_threads(threads).build().map_err(|why| why.to_string())
}

/// A pool of the thread that calls, which starts none.
fn own() -> std::result::Result<ThreadPool, String> {
    ThreadPoolBuilder::new().num_threads(1).use_current_thread().build().map_err(|why| why.to_string())
}
