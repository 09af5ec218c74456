//! What is answered, and how it is written.

use std::borrow::Cow;
use std::io::{Read, Write};
use std::net::{Shutdown, TcpStream};
use std::time::{Duration, Instant};

/// What every answer says to a browser: keep nothing, guess nothing, give it to no other page.
const HEADERS: &str = "Connection: close\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n\
    Referrer-Policy: no-referrer\r\nCross-Origin-Resource-Policy: same-origin\r\nCross-Origin-Opener-Policy: same-origin\r\n";

/// What an answer that is no page may do in a browser.
const NOTHING: &str = "default-src 'none'; frame-ancestors 'none'";

/// How long a part of an answer may take to go.
const WRITE_TIME: Duration = Duration::from_secs(10);

/// How long, and for how many bytes, is listened to what a request that was refused still sends: a connection that is closed on
/// bytes that nobody has read loses its answer.
const REST_TIME: Duration = Duration::from_millis(500);
const MOST_REST: usize = 4 << 20;

/// An answer.
#[derive(Debug)]
pub(crate) struct Reply {
    status: (u16, &'static str),
    kind: &'static str,
    policy: String,
    more: &'static str,
    body: Cow<'static, [u8]>,
}

/// Why a request is refused, as a sentence.
#[derive(Debug)]
pub(crate) struct Refusal {
    status: (u16, &'static str),
    more: &'static str,
    why: Cow<'static, str>,
}

impl Refusal {
    pub(crate) const SLOW: Refusal =
        Refusal::new((408, "Request Timeout"), "the request did not come in time");
    pub(crate) const LENGTH: Refusal =
        Refusal::new((411, "Length Required"), "the request does not say its `Content-Length`");
    pub(crate) const BODY: Refusal =
        Refusal::new((413, "Content Too Large"), "a question has at most 1048576 bytes");
    pub(crate) const KIND: Refusal =
        Refusal::new((415, "Unsupported Media Type"), "a question is of the type application/json");
    pub(crate) const HEAD: Refusal = Refusal::new(
        (431, "Request Header Fields Too Large"),
        "the head of a request has at most 16384 bytes and 64 headers",
    );
    pub(crate) const NOWHERE: Refusal = Refusal::new((404, "Not Found"), "there is nothing of this name");
    pub(crate) const FAILED: Refusal = Refusal::new((500, "Internal Server Error"), "the engine stopped");
    pub(crate) const BUSY: Refusal = Refusal {
        status: (503, "Service Unavailable"),
        more: "Retry-After: 1\r\n",
        why: Cow::Borrowed("too many ask at once; ask again in a second"),
    };
    pub(crate) const GET: Refusal = Refusal {
        status: (405, "Method Not Allowed"),
        more: "Allow: GET\r\n",
        why: Cow::Borrowed("the page is got by GET"),
    };
    pub(crate) const POST: Refusal = Refusal {
        status: (405, "Method Not Allowed"),
        more: "Allow: POST\r\n",
        why: Cow::Borrowed("questions are asked by POST"),
    };

    const fn new(status: (u16, &'static str), why: &'static str) -> Refusal {
        Refusal { status, more: "", why: Cow::Borrowed(why) }
    }

    /// A request that is none.
    pub(crate) fn bad(why: &str) -> Refusal {
        Refusal { status: (400, "Bad Request"), more: "", why: Cow::Owned(why.to_owned()) }
    }

    /// A request that has no business here.
    pub(crate) const fn forbidden(why: &'static str) -> Refusal {
        Refusal::new((403, "Forbidden"), why)
    }
}

impl From<Refusal> for Reply {
    fn from(Refusal { status, more, why }: Refusal) -> Reply {
        let body = Cow::Owned(format!("{why}\n").into_bytes());
        Reply { status, kind: "text/plain; charset=utf-8", policy: NOTHING.to_owned(), more, body }
    }
}

impl Reply {
    /// A page, and what it may do.
    pub(crate) fn page(text: String, policy: String) -> Reply {
        let body = Cow::Owned(text.into_bytes());
        Reply { status: (200, "OK"), kind: "text/html; charset=utf-8", policy, more: "", body }
    }

    /// The bytes of an answer to a question.
    pub(crate) fn answer(bytes: Vec<u8>) -> Reply {
        let (kind, policy) = ("application/octet-stream", NOTHING.to_owned());
        Reply { status: (200, "OK"), kind, policy, more: "", body: Cow::Owned(bytes) }
    }

    /// Whether the request was refused.
    fn is_refusal(&self) -> bool {
        self.status.0 != 200
    }

    /// Writes it and closes the connection. Whoever is gone is not waited for.
    pub(crate) fn send(&self, mut stream: TcpStream) {
        let (code, reason) = self.status;
        let Reply { kind, policy, more, body, .. } = self;
        let head = format!(
            "HTTP/1.1 {code} {reason}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nContent-Security-Policy: {policy}\r\n{more}{HEADERS}\r\n",
            body.len()
        );
        let sent = stream
            .set_write_timeout(Some(WRITE_TIME))
            .and_then(|()| stream.write_all(head.as_bytes()))
            .and_then(|()| stream.write_all(body))
            .and_then(|()| stream.shutdown(Shutdown::Write));
        if sent.is_ok() && self.is_refusal() {
            listen_to_the_rest(&mut stream);
        }
    }
}

fn listen_to_the_rest(stream: &mut TcpStream) {
    let end = Instant::now() + REST_TIME;
    let (mut part, mut seen) = ([0; 4096], 0);
    while seen < MOST_REST {
        let left = end.saturating_duration_since(Instant::now());
        if left.is_zero() || stream.set_read_timeout(Some(left)).is_err() {
            return;
        }
        match stream.read(&mut part) {
            Ok(count) if count > 0 => seen += count,
            _ => return,
        }
    }
}
