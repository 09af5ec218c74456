//! What README and the pages of `docs/` say can be tried, and their links lead somewhere.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use squealmap::engine::backend::Backend;
use squealmap::engine::options::Options;
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType;
use squealmap::sweep::spec::Spec;

/// A newcomer reads the README to its end.
const MOST_WORDS: usize = 1200;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The text between the first fence of this kind and its end.
fn block<'a>(page: &'a str, kind: &str) -> &'a str {
    page.split_once(&format!("```{kind}\n")).unwrap().1.split_once("```").unwrap().0
}

/// The README says what the figure of its first sweep shows: stable where the law is flat, from the knee at 5 m/s on,
/// and where `mu_s = mu_d` lies below the critical friction 0.2264 of constant laws (docs/physics.md, section 6).
#[test]
fn the_first_map_shows_what_the_readme_says() {
    let readme = read(&root().join("README.md"));
    let sweep = block(&readme, "toml");
    assert_eq!(sweep.lines().count(), 6, "{sweep}");
    let spec = Spec::parse(sweep, "first.toml", root()).unwrap_or_else(|error| panic!("{error}"));
    let options = Options { backend: Backend::Cpu, ..Options::default() };
    let map = squealmap::sweep::run::run(spec, &options, &|_| {}).unwrap();
    let mut types = BTreeSet::new();
    for (index, record) in map.records.iter().enumerate() {
        let params = map.spec.instance(index).params;
        let [mu_s, velocity] = [Param::MuS, Param::BeltVelocity].map(|param| params.require(param));
        let kind = record.kind.unwrap();
        assert_eq!(kind == InstabilityType::Stable, velocity > 5.0 || mu_s < 0.201, "{mu_s}, {velocity}");
        assert_eq!(
            kind == InstabilityType::Stable,
            record.regime == Some(Regime::Equilibrium),
            "{mu_s}, {velocity}"
        );
        assert_eq!(record.settled, Some(true), "{mu_s}, {velocity}");
        types.insert(kind.name());
    }
    assert_eq!(types.into_iter().collect::<Vec<_>>(), ["coexistence", "negative_slope", "stable"]);
    let regimes: BTreeSet<_> = map.records.iter().map(|record| record.regime.unwrap().name()).collect();
    assert_eq!(
        regimes.into_iter().collect::<Vec<_>>(),
        ["detaching_stick_slip", "equilibrium", "stick_slip"]
    );
}

#[test]
fn the_readme_is_short() {
    let words = read(&root().join("README.md")).split_whitespace().count();
    assert!(words <= MOST_WORDS, "{words} words in the README, at most {MOST_WORDS}");
}

/// The example of the page on sweep files is one.
#[test]
fn the_sweep_of_the_page_on_sweep_files_is_valid() {
    let page = read(&root().join("docs/sweep_files.md"));
    let spec =
        Spec::parse(block(&page, "toml"), "page.toml", root()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(spec.grid.len(), 41 * 41 * 3);
}

/// The name by which a heading is linked, as GitHub makes it.
fn anchor(heading: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
    heading.trim().to_lowercase().chars().filter(kept).map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// The lines of a page outside of its fenced blocks.
fn prose(page: &str) -> impl Iterator<Item = &str> {
    let mut fenced = false;
    page.lines().filter(move |line| {
        let fence = line.starts_with("```");
        fenced ^= fence;
        !fenced && !fence
    })
}

/// Where the links of a page go that lead into this repository: file and heading.
fn links(page: &str) -> Vec<(String, Option<String>)> {
    let mut found = Vec::new();
    for line in prose(page) {
        for rest in line.split("](").skip(1) {
            let target = rest.split(')').next().unwrap();
            if !target.contains("://") {
                let (file, heading) =
                    target.split_once('#').map_or((target, None), |(f, h)| (f, Some(h.to_owned())));
                found.push((file.to_owned(), heading));
            }
        }
    }
    found
}

/// README, CHANGELOG and the pages of `docs/`.
fn pages() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let mut pages: Vec<_> =
        entries.filter(|path| path.extension().is_some_and(|extension| extension == "md")).collect();
    pages.extend(["README.md", "CHANGELOG.md"].map(|name| root().join(name)));
    pages
}

#[test]
fn every_link_leads_to_a_file_and_a_heading() {
    let mut checked = 0;
    for path in pages() {
        let page = read(&path);
        for (file, heading) in links(&page) {
            let target = if file.is_empty() { path.clone() } else { path.parent().unwrap().join(&file) };
            assert!(target.exists(), "{}: {file} is not there", path.display());
            if let Some(heading) = heading {
                let target = read(&target);
                let mut headings = prose(&target).filter(|line| line.starts_with('#'));
                let there = headings.any(|line| anchor(line.trim_start_matches('#')) == heading);
                assert!(there, "{}: {file} has no heading #{heading}", path.display());
            }
            checked += 1;
        }
    }
    assert!(checked > 50, "{checked} links");
}

/// No page of `docs/` is left out of the index.
#[test]
fn the_index_names_every_page() {
    let index = read(&root().join("docs/README.md"));
    let linked: BTreeSet<_> = links(&index).into_iter().map(|(file, _)| file).collect();
    for page in pages().iter().filter(|page| page.parent() == Some(&root().join("docs"))) {
        let name = page.file_name().unwrap().to_str().unwrap();
        assert!(name == "README.md" || linked.contains(name), "docs/README.md does not name {name}");
    }
}
