//! The page of a sweep: the sweep is in it as it was, and what has no plane is refused.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use serde_json::Value as Json;
use squealmap::store::description::Description;
use squealmap::study::explore::page::page;
use squealmap::sweep::spec::Spec;

const EMPTY: &str = "<html><!--sweep--></html>";

const MAP: &str = "title = \"a </script> title\"\n[model]\ntheta = 0.01\n[friction]\nlaw = \"bilinear\"\nknee_velocity = 5\n\
    [belt]\nbelt_velocity = 1.0\n[axes]\nmu_s = { from = 0.0, to = 0.6, points = 5 }\nmu_d = { from = 0.0, to = 0.6, points = 7 }\n";

fn parse(text: &str) -> Spec {
    Spec::parse(text, "s.toml", ".".as_ref()).unwrap()
}

#[test]
fn the_page_holds_the_sweep() {
    let spec = parse(MAP);
    let page = String::from_utf8(page(&spec, "sweeps/s.toml", EMPTY).unwrap()).unwrap();
    let given = page
        .strip_prefix("<html><script id=\"sweep\" type=\"application/json\">")
        .and_then(|rest| rest.strip_suffix("</script></html>"))
        .unwrap();
    assert!(!given.contains('<'), "a title may hold anything: {given}");
    let given: Json = serde_json::from_str(given).unwrap();
    assert_eq!(given["file"], "sweeps/s.toml");
    assert_eq!(given["classes"]["type"][2]["name"], "mode_coupling");
    let described: Json = serde_json::from_str(given["description"].as_str().unwrap()).unwrap();
    let again = Description::from_json(&described).unwrap().spec().unwrap();
    assert_eq!((again.resolved(), again.grid), (spec.resolved(), spec.grid));
}

#[test]
fn what_has_no_plane_is_refused() {
    let line = MAP
        .replace("mu_d = { from = 0.0, to = 0.6, points = 7 }\n", "")
        .replace("[belt]", "mu_d = 0.1\n[belt]");
    let error = page(&parse(&line), "s.toml", EMPTY).unwrap_err().to_string();
    assert!(error.contains("two axes of numbers"), "{error}");
    let error = page(&parse(MAP), "s.toml", "<html></html>").unwrap_err().to_string();
    assert!(error.contains("crates/explorer/build"), "{error}");
}
