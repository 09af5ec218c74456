//! Connections: each has a thread, one request, and one answer.

use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use serde_json::{Value as Json, json};

use crate::cli::serve::guard::{Guard, Wanted};
use crate::cli::serve::reply::{Refusal, Reply};
use crate::cli::serve::request::Request;
use crate::cli::serve::served::Served;
use crate::cli::serve::work::Work;

/// The most connections at once.
pub const MOST_CONNECTIONS: usize = 64;

/// How long is waited where the system gives no connection.
const PAUSE: Duration = Duration::from_millis(50);

/// Random bytes of a token.
const TOKEN_BYTES: usize = 16;

/// A server that is going on.
#[derive(Debug)]
pub struct Server {
    /// Where it listens.
    pub address: SocketAddr,
}

/// What connections share.
#[derive(Debug)]
struct Shared {
    guard: Guard,
    served: Served,
    work: Arc<Work>,
    connections: AtomicUsize,
}

impl Server {
    /// Serves the page of a sweep to whoever connects, for as long as the process lives. `told` is what the page is told of the program.
    ///
    /// # Errors
    /// A sentence, when the page is none, or the system gives no random numbers or no thread.
    pub fn start(listener: TcpListener, page: &str, work: Arc<Work>, told: &Json) -> Result<Server, String> {
        let address = listener.local_addr().map_err(|why| why.to_string())?;
        let token = random()?;
        let mut told = told.clone();
        told["token"] = json!(token);
        let served = Served::new(page, &told).ok_or("the page has no place for what it is told")?;
        let guard = Guard::new(address.port(), token);
        let shared = Arc::new(Shared { guard, served, work, connections: AtomicUsize::new(0) });
        let accept = move || {
            for stream in listener.incoming() {
                match stream {
                    Ok(stream) => shared.take(stream),
                    Err(_) => thread::sleep(PAUSE),
                }
            }
        };
        thread::Builder::new().name("server".to_owned()).spawn(accept).map_err(|why| why.to_string())?;
        Ok(Server { address })
    }
}

impl Shared {
    /// Gives a connection a thread, where there are not too many.
    fn take(self: &Arc<Shared>, stream: TcpStream) {
        let place = Place(Arc::clone(self));
        if self.connections.fetch_add(1, Ordering::Relaxed) >= MOST_CONNECTIONS {
            // Not read, and not waited for.
            let _ = stream.set_nonblocking(true);
            Reply::from(Refusal::BUSY).send(stream);
            return;
        }
        // Without a thread the connection is closed.
        let _ = thread::Builder::new().name("connection".to_owned()).spawn(move || place.0.serve(stream));
    }

    fn serve(&self, mut stream: TcpStream) {
        let _ = stream.set_nodelay(true);
        let reply = match Request::read(&mut stream) {
            Ok(None) => return,
            Ok(Some(request)) => self.reply(request, &stream),
            Err(refusal) => Some(refusal.into()),
        };
        if let Some(reply) = reply {
            reply.send(stream);
        }
    }

    /// The answer to a request; none when nobody waits for it.
    fn reply(&self, request: Request, stream: &TcpStream) -> Option<Reply> {
        match self.guard.admit(&request) {
            Err(refusal) => Some(refusal.into()),
            Ok(Wanted::Answer) => self.work.answer(request.body, stream),
            Ok(Wanted::Page) => {
                let word = random();
                Some(word.map_or_else(|_| Refusal::FAILED.into(), |word| self.served.reply(&word)))
            }
        }
    }
}

/// The place of a connection, free again when it is dropped.
struct Place(Arc<Shared>);

impl Drop for Place {
    fn drop(&mut self) {
        self.0.connections.fetch_sub(1, Ordering::Relaxed);
    }
}

/// A word that nobody guesses.
fn random() -> Result<String, String> {
    let mut bytes = [0; TOKEN_BYTES];
    getrandom::fill(&mut bytes).map_err(|why| format!("the system gives no random numbers: {why}"))?;
    Ok(blake3::hash(&bytes).to_hex()[..2 * TOKEN_BYTES].to_owned())
}
