//! Which requests are let in: those of the page of this server, which knows its token, and the one that gets the page.
//!
//! A page of another place can make a browser send requests here, and a name of another place can be made to point here. Both show
//! in `Host` and `Origin`. A request without `Origin` comes from no page, and has to know the token like any other.

use crate::cli::serve::reply::Refusal;
use crate::cli::serve::request::Request;

/// The header that holds the token.
const TOKEN: &str = "X-Squealmap-Token";

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// The page.
    Page,
    /// The answer to a question.
    Answer,
}

/// Who is let in.
#[derive(Clone, Debug)]
pub(crate) struct Guard {
    hosts: [String; 2],
    token: String,
}

impl Guard {
    /// For the server at a port.
    pub(crate) fn new(port: u16, token: String) -> Guard {
        Guard { hosts: ["127.0.0.1", "localhost"].map(|name| format!("{name}:{port}")), token }
    }

    /// Lets a request in, or says why not.
    pub(crate) fn admit(&self, request: &Request) -> Result<Wanted, Refusal> {
        let host = request.one("Host").map(str::to_ascii_lowercase);
        let Some(host) = host.filter(|host| self.hosts.contains(host)) else {
            return Err(Refusal::forbidden("this server is asked by its own address alone"));
        };
        let own = format!("http://{host}");
        let is_own = |origin: &[u8]| origin.eq_ignore_ascii_case(own.as_bytes());
        if !request.all("Origin").all(is_own) {
            return Err(Refusal::forbidden("this server is asked by its own page alone"));
        }
        match (request.path.as_str(), request.method.as_str()) {
            ("/", "GET") => Ok(Wanted::Page),
            ("/", _) => Err(Refusal::GET),
            ("/ask", "POST") => self.admit_question(request),
            ("/ask", _) => Err(Refusal::POST),
            _ => Err(Refusal::NOWHERE),
        }
    }

    fn admit_question(&self, request: &Request) -> Result<Wanted, Refusal> {
        let kind = request.one("Content-Type").and_then(|kind| kind.split(';').next()).map(str::trim);
        if !kind.is_some_and(|kind| kind.eq_ignore_ascii_case("application/json")) {
            return Err(Refusal::KIND);
        }
        // Of hashes, which are compared in a time that tells nothing.
        let hash = |token: &str| blake3::hash(token.as_bytes());
        if !request.one(TOKEN).is_some_and(|token| hash(token) == hash(&self.token)) {
            return Err(Refusal::forbidden(
                "the question has not the token of the page; load the page again",
            ));
        }
        Ok(Wanted::Answer)
    }
}
