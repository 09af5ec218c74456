//! A request, read from a connection within bounds of size and time. `httparse` takes it apart.

use std::io::{ErrorKind, Read};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use crate::cli::serve::reply::Refusal;

/// The most bytes of the request line and the headers together, of headers, and of the body.
const MOST_HEAD: usize = 16 << 10;
const MOST_HEADERS: usize = 64;
pub(crate) const MOST_BODY: usize = 1 << 20;

/// How long the head and the body may take to come.
const HEAD_TIME: Duration = Duration::from_secs(5);
const BODY_TIME: Duration = Duration::from_secs(10);

/// A request.
#[derive(Debug)]
pub(crate) struct Request {
    pub(crate) method: String,
    pub(crate) path: String,
    headers: Vec<(String, Vec<u8>)>,
    pub(crate) body: Vec<u8>,
}

impl Request {
    /// The values of a header.
    pub(crate) fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a [u8]> {
        let named = self.headers.iter().filter(move |(one, _)| one.eq_ignore_ascii_case(name));
        named.map(|(_, value)| value.trim_ascii())
    }

    /// The value of a header that is there once.
    pub(crate) fn one<'a>(&'a self, name: &'a str) -> Option<&'a str> {
        let mut all = self.all(name);
        let value = all.next().filter(|_| all.next().is_none())?;
        str::from_utf8(value).ok()
    }

    /// Reads one; `None` where none came before the connection was closed or fell silent.
    pub(crate) fn read(stream: &mut TcpStream) -> Result<Option<Request>, Refusal> {
        let mut bytes = Vec::new();
        let end = Instant::now() + HEAD_TIME;
        let (mut request, head) = loop {
            let room = MOST_HEAD - bytes.len();
            match more(stream, &mut bytes, room, end) {
                Ok(true) => {}
                Ok(false) | Err(ErrorKind::TimedOut) if bytes.is_empty() => return Ok(None),
                Ok(false) => return Err(Refusal::bad("the request ends in its head")),
                Err(ErrorKind::TimedOut) => return Err(Refusal::SLOW),
                Err(_) => return Ok(None),
            }
            if let Some(parsed) = parse(&bytes)? {
                break parsed;
            }
            if bytes.len() >= MOST_HEAD {
                return Err(Refusal::HEAD);
            }
        };
        let length = request.length()?;
        request.body = bytes.split_off(head);
        if request.body.len() > length {
            return Err(Refusal::bad("there is more behind the request than it says"));
        }
        let end = Instant::now() + BODY_TIME;
        while request.body.len() < length {
            let room = length - request.body.len();
            match more(stream, &mut request.body, room, end) {
                Ok(true) => {}
                Ok(false) => return Err(Refusal::bad("the request ends in its body")),
                Err(ErrorKind::TimedOut) => return Err(Refusal::SLOW),
                Err(_) => return Ok(None),
            }
        }
        Ok(Some(request))
    }

    /// How long the body is.
    fn length(&self) -> Result<usize, Refusal> {
        if self.all("Transfer-Encoding").next().is_some() {
            return Err(Refusal::LENGTH);
        }
        if self.all("Content-Length").next().is_none() {
            return if self.method == "POST" { Err(Refusal::LENGTH) } else { Ok(0) };
        }
        let digits = |text: &&str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        let Some(text) = self.one("Content-Length").filter(digits) else {
            return Err(Refusal::bad("its `Content-Length` is no number"));
        };
        // A number that is none of the machine is too large in any case.
        text.parse().ok().filter(|length| *length <= MOST_BODY).ok_or(Refusal::BODY)
    }
}

/// Reads some more bytes, `room` at most; `false` at the end.
fn more(stream: &mut TcpStream, bytes: &mut Vec<u8>, room: usize, end: Instant) -> Result<bool, ErrorKind> {
    let mut part = [0; 4096];
    loop {
        let left = end.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Err(ErrorKind::TimedOut);
        }
        stream.set_read_timeout(Some(left)).map_err(|why| why.kind())?;
        let most = room.min(part.len());
        match stream.read(&mut part[..most]) {
            Ok(0) => return Ok(false),
            Ok(count) => {
                bytes.extend_from_slice(&part[..count]);
                return Ok(true);
            }
            Err(why) if why.kind() == ErrorKind::Interrupted => {}
            // A silence has two names, by the system.
            Err(why) if why.kind() == ErrorKind::WouldBlock => return Err(ErrorKind::TimedOut),
            Err(why) => return Err(why.kind()),
        }
    }
}

/// The head of a request and its length, once it is whole.
fn parse(bytes: &[u8]) -> Result<Option<(Request, usize)>, Refusal> {
    let mut headers = [httparse::EMPTY_HEADER; MOST_HEADERS];
    let mut parsed = httparse::Request::new(&mut headers);
    let head = match parsed.parse(bytes) {
        Ok(httparse::Status::Partial) => return Ok(None),
        Ok(httparse::Status::Complete(head)) => head,
        Err(httparse::Error::TooManyHeaders) => return Err(Refusal::HEAD),
        Err(why) => return Err(Refusal::bad(&why.to_string())),
    };
    let headers = parsed.headers.iter().map(|header| (header.name.to_owned(), header.value.to_vec()));
    let request = Request {
        method: parsed.method.unwrap_or_default().to_owned(),
        path: parsed.path.unwrap_or_default().to_owned(),
        headers: headers.collect(),
        body: Vec::new(),
    };
    Ok(Some((request, head)))
}
