//! A server in this process, and requests to it, byte by byte.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::Arc;
use std::time::Duration;

use serde_json::{Value as Json, json};
use squealmap::cli::serve::server::Server;
use squealmap::cli::serve::work::{Turns, Work};
use squealmap::study::explore::Explorer;
use squealmap::study::explore::page::page;
use squealmap::sweep::spec::Spec;
use squealmap::{Backend, Options};

/// A page without a sweep and without a program.
const EMPTY: &str = "<html><meta content=\"connect-src 'none'\"><!--sweep--><script>1</script></html>";

pub(crate) const MAP: &str = "[model]\ntheta = 0.01\n[friction]\nlaw = \"bilinear\"\nknee_velocity = 5\n[response]\n\
    settle = \"20 periods\"\nmeasure = \"10 periods\"\ncheck = false\n[axes]\nmu_s = { from = 0.0, to = 0.6, points = 7 }\n\
    mu_d = { from = 0.0, to = 0.5, points = 6 }\nbelt_velocity = { values = [1.0, 3.0] }\n";

pub(crate) fn parse(text: &str) -> Spec {
    Spec::parse(text, "s.toml", ".".as_ref()).unwrap()
}

/// What is answered.
pub(crate) struct Answered {
    pub(crate) status: u16,
    pub(crate) head: String,
    pub(crate) body: Vec<u8>,
}

impl Answered {
    pub(crate) fn text(&self) -> String {
        String::from_utf8(self.body.clone()).unwrap()
    }

    /// The head and the numbers of an answer to a question.
    pub(crate) fn parts(&self) -> (Json, Vec<f64>) {
        assert_eq!(self.status, 200, "{}", self.text());
        let length = usize::try_from(u64::from_le_bytes(self.body[..8].try_into().unwrap())).unwrap();
        let numbers = self.body[8 + length..].chunks_exact(8);
        let numbers = numbers.map(|eight| f64::from_le_bytes(eight.try_into().unwrap())).collect();
        (serde_json::from_slice(&self.body[8..8 + length]).unwrap(), numbers)
    }
}

/// A server of a sweep.
pub(crate) struct Served {
    pub(crate) port: u16,
    pub(crate) token: String,
}

impl Served {
    /// With so many questions at work at once.
    pub(crate) fn new(explorer: &Explorer, turns: usize) -> Served {
        let work = Work {
            options: Options { backend: Backend::Cpu, ..Options::default() },
            open: None,
            pool: rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap(),
            turns: Turns::new(turns),
            explorer: explorer.clone(),
        };
        let page = String::from_utf8(page(&explorer.opened().spec, "s.toml", EMPTY).unwrap()).unwrap();
        let listener = TcpListener::bind(("127.0.0.1", 0)).unwrap();
        let told = json!({ "cores": 2, "gpu": false, "by": "2 cores", "run": null });
        let port = Server::start(listener, &page, Arc::new(work), &told).unwrap().address.port();
        let mut served = Served { port, token: String::new() };
        let page = served.get("/").text();
        let (_, block) = page.split_once("<script id=\"program\" type=\"application/json\">").unwrap();
        let told: Json = serde_json::from_str(block.split_once("</script>").unwrap().0).unwrap();
        told["token"].as_str().unwrap().clone_into(&mut served.token);
        served
    }

    pub(crate) fn of(text: &str) -> Served {
        Served::new(&Explorer::new(parse(text)).unwrap(), 2)
    }

    pub(crate) fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_mins(1))).unwrap();
        stream
    }

    /// Sends bytes: what comes back until the connection is closed; `None` where nothing does.
    pub(crate) fn send(&self, bytes: &[u8]) -> Option<Answered> {
        let mut stream = self.connect();
        // It may be refused before it is sent.
        let _ = stream.write_all(bytes);
        received(stream)
    }

    /// The head of a request with its own address, and what is given beside it.
    pub(crate) fn head(&self, line: &str, headers: &str) -> String {
        format!("{line} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{headers}\r\n", self.port)
    }

    pub(crate) fn get(&self, path: &str) -> Answered {
        self.send(self.head(&format!("GET {path}"), "").as_bytes()).unwrap()
    }

    /// A question as the page asks it.
    pub(crate) fn question(&self, body: &str) -> Vec<u8> {
        let headers = format!(
            "Origin: http://127.0.0.1:{}\r\nContent-Type: application/json\r\nX-Squealmap-Token: {}\r\nContent-Length: {}\r\n",
            self.port,
            self.token,
            body.len()
        );
        [self.head("POST /ask", &headers).as_bytes(), body.as_bytes()].concat()
    }

    pub(crate) fn ask(&self, question: &Json) -> Answered {
        self.send(&self.question(&question.to_string())).unwrap()
    }
}

/// What comes back until the connection is closed.
pub(crate) fn received(mut stream: TcpStream) -> Option<Answered> {
    let mut bytes = Vec::new();
    let _ = stream.read_to_end(&mut bytes);
    let end = bytes.windows(4).position(|four| four == b"\r\n\r\n")?;
    let head = String::from_utf8(bytes[..end].to_vec()).unwrap();
    let status = head.split(' ').nth(1)?.parse().ok()?;
    Some(Answered { status, head, body: bytes[end + 4..].to_vec() })
}

/// A question for the cells of the sweep above.
pub(crate) fn region(response: bool, columns: &[&str]) -> Json {
    json!({
        "ask": "region",
        "x": { "key": "mu_d", "from": 0.0, "to": 0.5, "points": 6 },
        "y": { "key": "mu_s", "from": 0.0, "to": 0.6, "points": 7 },
        "at": { "belt_velocity": 3.0 },
        "response": response,
        "columns": columns,
    })
}

/// Whether two columns are the same to the bit; undefined values are.
pub(crate) fn same(a: &[f64], b: &[f64]) -> bool {
    let one = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
    a.len() == b.len() && a.iter().zip(b).all(one)
}
