//! A question at work on the cores of the program. So many are at work at once; others wait. One for which nobody waits any longer is
//! dropped.

use std::net::TcpStream;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

use rayon::ThreadPool;
use squealmap::engine::Engine;
use squealmap::engine::options::Options;
use squealmap::study::explore::Explorer;
use squealmap::study::explore::answer::Answer;
use squealmap::study::explore::by::By;

use crate::cli::serve::reply::{Refusal, Reply};

/// How often is looked whether whoever asked is still there.
const LOOK: Duration = Duration::from_millis(20);

/// What answers.
pub struct Work {
    /// The sweep.
    pub explorer: Explorer,
    /// Which engine; its flag to stop is that of a question.
    pub options: Options<'static>,
    /// An engine that stays open, as a GPU does.
    pub open: Option<Mutex<Box<dyn Engine>>>,
    /// Its cores.
    pub pool: ThreadPool,
    /// Questions at work.
    pub turns: Turns,
}

impl std::fmt::Debug for Work {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Work").field("explorer", &self.explorer).finish_non_exhaustive()
    }
}

/// So many at once.
#[derive(Debug)]
pub struct Turns {
    left: Mutex<usize>,
    changed: Condvar,
}

impl Turns {
    /// So many.
    #[must_use]
    pub fn new(most: usize) -> Turns {
        Turns { left: Mutex::new(most), changed: Condvar::new() }
    }

    /// Takes a turn when one is free; none when meanwhile `is_gone`.
    fn take(&self, is_gone: impl Fn() -> bool) -> Option<Turn<'_>> {
        let mut left = self.left.lock().unwrap_or_else(PoisonError::into_inner);
        while *left == 0 {
            if is_gone() {
                return None;
            }
            left = self.changed.wait_timeout(left, LOOK).unwrap_or_else(PoisonError::into_inner).0;
        }
        *left -= 1;
        Some(Turn(self))
    }
}

/// A turn, given back when it is dropped.
struct Turn<'a>(&'a Turns);

impl Drop for Turn<'_> {
    fn drop(&mut self) {
        *self.0.left.lock().unwrap_or_else(PoisonError::into_inner) += 1;
        self.0.changed.notify_one();
    }
}

impl Work {
    /// Answers a question for as long as the connection is there; `None` when it is closed before.
    pub(crate) fn answer(self: &Arc<Work>, question: Vec<u8>, stream: &TcpStream) -> Option<Reply> {
        let _turn = self.turns.take(|| is_gone(stream))?;
        let stop = Arc::new(AtomicBool::new(false));
        let (done, answered) = sync_channel(1);
        let (work, flag) = (Arc::clone(self), Arc::clone(&stop));
        self.pool.spawn(move || {
            let answer = catch_unwind(AssertUnwindSafe(|| work.answered(&question, &flag)));
            // Whoever asked waits until this is sent.
            let _ = done.send(answer.ok());
        });
        loop {
            match answered.recv_timeout(LOOK) {
                Ok(_) if stop.load(Ordering::Relaxed) => return None,
                Ok(Some(bytes)) => return Some(Reply::answer(bytes)),
                Ok(None) | Err(RecvTimeoutError::Disconnected) => return Some(Refusal::FAILED.into()),
                Err(RecvTimeoutError::Timeout) => {
                    if is_gone(stream) {
                        stop.store(true, Ordering::Relaxed);
                    }
                }
            }
        }
    }

    /// The bytes of the answer; a sentence where there is none.
    fn answered(&self, question: &[u8], stop: &AtomicBool) -> Vec<u8> {
        let by = By { options: Options { cancel: Some(stop), ..self.options }, open: self.open.as_ref() };
        let question = str::from_utf8(question).map_err(|_| "this is no question: it is no UTF-8".to_owned());
        let answer = question.and_then(|question| self.explorer.answer_by(question, &by));
        answer.unwrap_or_else(|sentence| Answer::error(&sentence)).to_bytes()
    }
}

/// Whether a connection was closed by the other side.
fn is_gone(stream: &TcpStream) -> bool {
    let looked = stream.set_nonblocking(true).and_then(|()| stream.peek(&mut [0]));
    let is_gone = match looked {
        Ok(count) => count == 0,
        Err(why) => why.kind() != std::io::ErrorKind::WouldBlock,
    };
    is_gone || stream.set_nonblocking(false).is_err()
}
