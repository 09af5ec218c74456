//! Requests to the server of `explore` that are none of its page.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::io::Write;
use std::time::{Duration, Instant};

use serde_json::json;
use squealmap::cli::serve::server::MOST_CONNECTIONS;
use squealmap::study::explore::Explorer;

use crate::cli::http::{MAP, Served, parse, received, region};

/// A question of the page with one line of its head another one.
fn changed(served: &Served, from: &str, to: &str) -> Vec<u8> {
    let question = String::from_utf8(served.question(&region(false, &["type"]).to_string())).unwrap();
    let line = question.lines().find(|line| line.starts_with(from)).unwrap();
    question.replacen(&format!("{line}\r\n"), to, 1).into_bytes()
}

#[test]
fn what_is_not_of_the_page_is_refused() {
    let served = Served::of(MAP);
    assert_eq!(served.ask(&region(false, &["type"])).status, 200);
    let port = served.port;
    let other = port ^ 1;
    let token = "0".repeat(served.token.len());
    let cases = [
        // A name of another place that points here.
        ("Host", "Host: evil.example\r\n".to_owned(), 403, "own address"),
        ("Host", format!("Host: evil.example:{port}\r\n"), 403, "own address"),
        ("Host", format!("Host: 127.0.0.1:{other}\r\n"), 403, "own address"),
        ("Host", "Host: 127.0.0.1\r\n".to_owned(), 403, "own address"),
        ("Host", format!("Host: 127.0.0.1:{port}\r\nHost: evil.example\r\n"), 403, "own address"),
        ("Host", String::new(), 403, "own address"),
        // A page of another place.
        ("Origin", "Origin: http://evil.example\r\n".to_owned(), 403, "own page"),
        ("Origin", "Origin: null\r\n".to_owned(), 403, "own page"),
        ("Origin", format!("Origin: https://127.0.0.1:{port}\r\n"), 403, "own page"),
        ("Origin", format!("Origin: http://127.0.0.1:{other}\r\n"), 403, "own page"),
        ("Origin", format!("Origin: http://localhost:{port}\r\n"), 403, "own page"),
        ("Origin", format!("Origin: http://127.0.0.1:{port}.evil.example\r\n"), 403, "own page"),
        // No page at all.
        ("X-Squealmap-Token", String::new(), 403, "token"),
        ("X-Squealmap-Token", format!("X-Squealmap-Token: {token}\r\n"), 403, "token"),
        ("X-Squealmap-Token", format!("X-Squealmap-Token: {}0\r\n", served.token), 403, "token"),
        (
            "X-Squealmap-Token",
            format!("X-Squealmap-Token: {token}\r\nX-Squealmap-Token: {}\r\n", served.token),
            403,
            "token",
        ),
        // What a form of another page could send.
        ("Content-Type", "Content-Type: text/plain\r\n".to_owned(), 415, "application/json"),
        ("Content-Type", String::new(), 415, "application/json"),
        ("Content-Length", "Content-Length: 1048577\r\n".to_owned(), 413, "1048576 bytes"),
        ("Content-Length", "Content-Length: 99999999999999999999999\r\n".to_owned(), 413, "1048576 bytes"),
        ("Content-Length", "Content-Length: -1\r\n".to_owned(), 400, "no number"),
        ("Content-Length", "Content-Length: 5\r\nContent-Length: 6\r\n".to_owned(), 400, "no number"),
        ("Content-Length", "Content-Length: 5\r\n".to_owned(), 400, "more behind"),
        ("Content-Length", String::new(), 411, "Content-Length"),
        ("Content-Length", "Transfer-Encoding: chunked\r\n".to_owned(), 411, "Content-Length"),
        ("POST", "PUT /ask HTTP/1.1\r\n".to_owned(), 405, "POST"),
        ("POST", "OPTIONS /ask HTTP/1.1\r\n".to_owned(), 405, "POST"),
        ("POST", "POST / HTTP/1.1\r\n".to_owned(), 405, "GET"),
        ("POST", "POST /../ask HTTP/1.1\r\n".to_owned(), 404, "nothing"),
        ("POST", "POST /ask?x HTTP/1.1\r\n".to_owned(), 404, "nothing"),
        ("POST", format!("POST http://127.0.0.1:{port}/ask HTTP/1.1\r\n"), 404, "nothing"),
        ("POST", "POST /ask HTTP/3.7\r\n".to_owned(), 400, ""),
    ];
    for (line, to, status, part) in cases {
        let answered = served.send(&changed(&served, line, &to)).unwrap();
        let text = answered.text();
        assert_eq!(answered.status, status, "{to:?}: {text}");
        assert!(text.contains(part) && text.trim_end().lines().count() == 1, "{to:?}: {text}");
        assert!(!answered.head.to_lowercase().contains("access-control"), "{}", answered.head);
        assert!(answered.head.contains("nosniff"), "{}", answered.head);
    }
    for path in ["/favicon.ico", "/../../etc/passwd", "/%2e%2e/", "//", "/ask/", "/s.toml", "*"] {
        assert_eq!(served.get(path).status, 404, "{path}");
    }
    // Its other name, by which a user may call it.
    let localhost = changed(&served, "Host", &format!("Host: LocalHost:{port}\r\n"));
    assert_eq!(served.send(&localhost).unwrap().status, 403, "its origin is the other name");
}

#[test]
fn a_large_head_is_refused_and_a_large_body_not_read() {
    let served = Served::of(MAP);
    let long = format!("X: {}\r\n", "x".repeat(20_000));
    assert_eq!(served.send(served.head("GET /", &long).as_bytes()).unwrap().status, 431);
    assert_eq!(served.send(served.head("GET /", &"X: 1\r\n".repeat(65)).as_bytes()).unwrap().status, 431);
    // Without an end.
    assert_eq!(served.send("x".repeat(100_000).as_bytes()).unwrap().status, 431);
    let body = format!("{{\"ask\":\"about\"{}}}", " ".repeat(2 << 20));
    assert_eq!(served.send(&served.question(&body)).unwrap().status, 413);
    let fits = format!("{{\"ask\":\"about\"{}}}", " ".repeat((1 << 20) - 15));
    assert_eq!(served.send(&served.question(&fits)).unwrap().status, 200);
}

/// A law needs parameters, and a table its file: a sweep knows those of its own laws alone.
#[test]
fn a_law_that_is_none_of_the_sweep_is_refused() {
    let served = Served::of(MAP);
    for (key, name) in [("law", "table"), ("law", "exponential"), ("material", "pad.csv")] {
        let mut question = region(true, &["x2_std"]);
        question["at"][key] = json!(name);
        let text = served.ask(&question).text();
        assert!(text.contains(&format!("`{key}` is `{name}`, which is no value of an axis")), "{text}");
    }
    assert_eq!(served.ask(&region(false, &["type"])).status, 200);
}

/// Numbers that look random and are the same every time.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, below: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % below
    }
}

/// Whatever comes, the server goes on.
#[test]
fn two_hundred_wrong_requests_end_nothing() {
    let served = Served::of(MAP);
    let good = served.question(&region(false, &["type"]).to_string());
    let mut dice = Dice(35);
    let mut refused = 0;
    for number in 0..200 {
        let mut bytes = good.clone();
        match number % 5 {
            // A byte is another.
            0 => {
                for _ in 0..=dice.roll(4) {
                    let at = dice.roll(bytes.len());
                    bytes[at] = u8::try_from(dice.roll(256)).unwrap();
                }
            }
            // A part is missing.
            1 => drop(bytes.drain(..=dice.roll(good.len() / 2))),
            // A part is there twice.
            2 => {
                let at = dice.roll(good.len());
                bytes.splice(at..at, good[..dice.roll(good.len())].iter().copied());
            }
            // No request.
            3 => bytes = (0..dice.roll(3000)).map(|_| u8::try_from(dice.roll(256)).unwrap()).collect(),
            // No question.
            _ => {
                let mut body = region(false, &["type"]).to_string();
                body.truncate(dice.roll(body.len()));
                bytes = served.question(&body);
            }
        }
        let mut stream = served.connect();
        let _ = stream.write_all(&bytes);
        // A body that does not come is not waited for here.
        let _ = stream.shutdown(std::net::Shutdown::Write);
        if let Some(answered) = received(stream) {
            let is_sentence = answered.status != 200 || answered.parts().0.get("error").is_some();
            refused += usize::from(is_sentence);
            assert!(answered.status < 500, "{number}: {}", answered.text());
        }
    }
    assert!(refused > 120, "{refused} were refused in words");
    assert_eq!(served.ask(&region(false, &["type"])).parts().0["of_run"], 0);
}

/// Who says nothing is left after some seconds, and holds up nobody; too many at once are told to come again.
#[test]
fn silent_clients_hold_up_nobody() {
    let served = Served::of(MAP);
    let began = Instant::now();
    let mut silent: Vec<_> = (0..MOST_CONNECTIONS - 2).map(|_| served.connect()).collect();
    // One says a part, and then nothing.
    let mut slow = silent.pop().unwrap();
    slow.write_all(b"GET / HT").unwrap();
    assert_eq!(served.get("/").status, 200);
    std::thread::sleep(Duration::from_millis(200));
    silent.push(served.connect());
    silent.push(served.connect());
    let one_more = received(served.connect());
    assert_eq!(one_more.map(|answered| answered.status), Some(503));
    assert_eq!(received(slow).unwrap().status, 408);
    assert!(silent.into_iter().all(|stream| received(stream).is_none()));
    assert!(began.elapsed() < Duration::from_secs(20), "{:?}", began.elapsed());
    assert_eq!(served.get("/").status, 200);
}

/// A question for which nobody waits is dropped, and the next one begins.
#[test]
fn a_question_without_a_client_is_dropped() {
    let text = MAP.replace("20 periods", "300000 periods");
    let served = Served::new(&Explorer::new(parse(&text)).unwrap(), 1);
    let mut long = region(true, &["x2_std"]);
    long["x"]["points"] = json!(60);
    long["y"]["points"] = json!(60);
    let mut stream = served.connect();
    stream.write_all(&served.question(&long.to_string())).unwrap();
    // The one turn is taken: another question waits.
    std::thread::sleep(Duration::from_millis(500));
    let short = served.question(&region(false, &["type"]).to_string());
    let mut waiting = served.connect();
    waiting.write_all(&short).unwrap();
    waiting.set_read_timeout(Some(Duration::from_secs(2))).unwrap();
    assert!(received(waiting).is_none(), "the long question was over too soon to tell");
    drop(stream);
    let began = Instant::now();
    assert_eq!(served.send(&short).unwrap().status, 200);
    assert!(began.elapsed() < Duration::from_secs(5), "{:?}", began.elapsed());
}
