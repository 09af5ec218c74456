//! The examples do what they say.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

#[path = "../../../examples/eigenvalues.rs"]
mod eigenvalues;
#[path = "../../../examples/map.rs"]
mod map;
#[path = "../../../examples/trace.rs"]
mod trace;

#[test]
fn examples_come_to_their_end() {
    eigenvalues::main().unwrap();
    trace::main().unwrap();
    let file = std::env::temp_dir().join("squealmap-map.svg");
    let _ = std::fs::remove_file(&file);
    map::main().unwrap();
    let figure = std::fs::read_to_string(&file).unwrap();
    assert!(figure.contains("Static against dynamic friction"), "the figure has its title");
}
