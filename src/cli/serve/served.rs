//! The page with what it needs to ask here: where it asks, its token, and that its browser lets it.

use serde_json::Value as Json;

use crate::cli::serve::reply::Reply;

/// What is changed in the page: what its own policy forbids, where its program begins, where the sweep stands.
const FORBIDDEN: &str = "connect-src 'none'";
const ALLOWED: &str = "connect-src 'self'";
const PROGRAM: &str = "<script>";
const SWEEP: &str = "<script id=\"sweep\"";

/// The page, cut where a word of its own goes into each copy.
#[derive(Clone, Debug)]
pub(crate) struct Served {
    before: String,
    after: String,
}

impl Served {
    /// From the page of a sweep, and what it is told of this server. `None` of a page that is none.
    pub(crate) fn new(page: &str, told: &Json) -> Option<Served> {
        // A program inside of HTML ends at `</script`.
        let told = told.to_string().replace('<', "\\u003c");
        let block = format!("<script id=\"program\" type=\"application/json\">{told}</script>");
        let page = replaced(page, FORBIDDEN, ALLOWED)?;
        let page = replaced(&page, SWEEP, &format!("{block}{SWEEP}"))?;
        let (before, after) = page.split_once(PROGRAM)?;
        Some(Served { before: before.to_owned(), after: after.to_owned() })
    }

    /// A copy. Its program runs by a word that is in this copy alone, so that nothing that is put into the page could.
    pub(crate) fn reply(&self, word: &str) -> Reply {
        let Served { before, after } = self;
        let policy = format!(
            "default-src 'none'; script-src 'nonce-{word}' 'wasm-unsafe-eval' blob:; worker-src blob:; style-src 'unsafe-inline'; \
             img-src data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
        );
        Reply::page(format!("{before}<script nonce=\"{word}\">{after}"), policy)
    }
}

fn replaced(text: &str, from: &str, to: &str) -> Option<String> {
    text.split_once(from).map(|(before, after)| [before, to, after].concat())
}
