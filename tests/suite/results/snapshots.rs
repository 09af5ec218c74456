//! The figures of every kind as they were last looked at: any change of a picture is seen as a change of its file in
//! `snapshots/`. With `SQUEALMAP_SNAPSHOTS=write` the files are written anew; look at them before they are kept.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::PathBuf;

use crate::results::gallery::all;
use crate::results::gallery_plots::plots;
use squealmap::study::Kind;

/// A figure without what changes from commit to commit.
fn lasting(svg: &str) -> String {
    let lines =
        svg.lines().filter(|line| !line.starts_with("<metadata>") && !line.starts_with("% squealmap"));
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// The first line in which two texts differ.
fn difference(kept: &str, drawn: &str) -> Option<String> {
    if kept == drawn {
        return None;
    }
    let at = kept.lines().zip(drawn.lines()).position(|(a, b)| a != b);
    let at = at.unwrap_or(kept.lines().count().min(drawn.lines().count()));
    let line = |text: &str| text.lines().nth(at).unwrap_or("nothing").chars().take(200).collect::<String>();
    Some(format!("line {}: {}\n  was {}", at + 1, line(drawn), line(kept)))
}

#[test]
fn no_figure_has_changed_unseen() {
    let directory = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/suite/snapshots");
    let write = std::env::var_os("SQUEALMAP_SNAPSHOTS").is_some_and(|value| value == "write");
    let mut changed = Vec::new();
    // Bodies are thousands of pieces, which crates/fem compares with closed forms.
    let lines = all().into_iter().filter(|piece| !matches!(piece.kind, Kind::Shapes | Kind::Mesh));
    let kinds = lines.map(|piece| (format!("{}.svg", piece.kind.name()), piece.svg));
    let others = plots().into_iter().map(|(name, drawn)| (name.to_owned(), drawn));
    for (name, drawn) in kinds.chain(others) {
        let drawn = lasting(&drawn);
        let path = directory.join(&name);
        if write {
            std::fs::create_dir_all(&directory).unwrap();
            std::fs::write(&path, &drawn).unwrap();
        }
        // A checkout may have other line ends.
        let kept = std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
        changed.extend(difference(&kept, &drawn).map(|where_| format!("{name}, {where_}")));
    }
    assert!(changed.is_empty(), "SQUEALMAP_SNAPSHOTS=write keeps these:\n{}", changed.join("\n"));
}

#[test]
fn one_other_digit_is_seen() {
    let text = "<a>\n<path d=\"M1 2.51\"/>\n</a>\n";
    assert_eq!(difference(text, text), None);
    assert!(difference(text, &text.replace("2.51", "2.52")).unwrap().contains("line 2"));
    assert!(difference(text, "<a>\n").is_some() && difference("", text).is_some());
}
