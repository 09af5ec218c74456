//! `plot`: a map read back from its directory, at the size of a journal, as SVG, PDF and table.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::cli::program::squealmap;
use crate::colour::{DICHROMACIES, delta_e, lab, rgb};
use crate::common::near;
use crate::results::figure::{colour, draw, frames};
use crate::synthetic::{axis, map, number, paper_like, record, span};
use squealmap::engine::record::{Basin, Others, Record};
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType as Kind;
use squealmap::results::boundary_lines::boundary_lines;
use squealmap::results::error::Error;
use squealmap::results::figure::look::{Content, Journal, Look};
use squealmap::results::figure::map::{computed, look_svg, map_svg};
use squealmap::results::figure::palette::TYPES;
use squealmap::results::read::Archive;
use squealmap::results::{csv, manifest};
use squealmap::sweep::grid::{Axis, AxisKey, Grid, Value};
use squealmap::sweep::map::Map;
use squealmap::sweep::spec::Starts;
use squealmap::version::program;
use squealmap_figure::{pdf, png};
use tempfile::TempDir;

/// A map like the paper's, of five velocities.
fn sweep() -> Map {
    let axes = vec![
        span(Param::MuS, 0.0, 0.6, 13),
        span(Param::MuD, 0.0, 0.6, 13),
        axis(Param::BeltVelocity, &[0.5, 1.0, 3.0, 4.9, 6.0]),
    ];
    map(Grid::Axes(axes), |_, at| paper_like(number(at[0]), number(at[1]), number(at[2])))
}

/// The directory that a run would leave.
pub(crate) fn directory(map: &Map) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("map.csv"), csv::map_csv(map).unwrap()).unwrap();
    std::fs::write(directory.path().join("manifest.json"), manifest::manifest_json(map).unwrap()).unwrap();
    directory
}

/// Width and height that an SVG document states, mm.
pub(crate) fn size(svg: &str) -> [f64; 2] {
    let root = svg.lines().find(|line| line.starts_with("<svg")).unwrap();
    ["width", "height"].map(|name| {
        let rest = root.split_once(&format!(" {name}=\"")).unwrap().1;
        rest.split_once("mm\"").unwrap().0.parse().unwrap()
    })
}

/// The sizes of all texts, points as drawn.
pub(crate) fn text_sizes(svg: &str) -> Vec<f64> {
    let texts = svg.lines().filter(|line| line.starts_with("<text"));
    texts
        .map(|line| line.split("font-size=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap())
        .collect()
}

/// Width and height of the page of a PDF, mm, as a reader of the file finds them.
pub(crate) fn page(pdf: &[u8]) -> [f64; 2] {
    let text = String::from_utf8_lossy(pdf);
    let page = text.split_once("/MediaBox").unwrap().1.split_once(['[']).unwrap().1;
    let page: Vec<f64> =
        page.split_once(']').unwrap().0.split_whitespace().map(|x| x.parse().unwrap()).collect();
    [page[2] - page[0], page[3] - page[1]].map(|points| points / 72.0 * 25.4)
}

#[test]
fn the_figure_of_a_map_comes_back_from_its_directory() {
    let unsorted = Axis { log: true, ..axis(Param::K2, &[1e6, 1e4, 1e5]) };
    let law = ["bilinear", "rational"].map(|name| Value::Text(name.to_owned().into())).to_vec();
    let law = Axis { key: AxisKey::Law, values: law, log: false };
    let others = [
        Grid::Axes(vec![unsorted, law]),
        Grid::Tuples {
            keys: vec![AxisKey::Param(Param::MuS), AxisKey::Param(Param::BeltVelocity)],
            rows: (0..9)
                .map(|k| [0.1 * f64::from(k), 1.0 + f64::from(k % 4)].map(Value::Number).to_vec())
                .collect(),
        },
    ];
    let others =
        others.map(|grid| map(grid, |k, _| record(Kind::ALL[k % 7], Regime::ALL[k % 7], k % 2 == 0)));
    for map in others.into_iter().chain([sweep()]) {
        let back = Archive::read(directory(&map).path()).unwrap();
        assert_eq!(back.map.spec.grid, map.spec.grid);
        assert_eq!(map_svg(&back.map).unwrap(), map_svg(&map).unwrap(), "the same text, metadata included");
    }
    // A map that differs in one class gives another picture.
    let mut other = sweep();
    other.records[7].kind = Some(Kind::Divergence);
    let back = Archive::read(directory(&other).path()).unwrap();
    assert_ne!(map_svg(&back.map).unwrap(), map_svg(&sweep()).unwrap());
}

#[test]
fn what_is_no_directory_of_a_run_is_refused_with_its_file() {
    let empty = tempfile::tempdir().unwrap();
    let refused = |directory: &TempDir, words: &str| {
        let error = Archive::read(directory.path()).unwrap_err();
        assert!(error.is_bad_input() && matches!(error, Error::Archive { .. }), "{error}");
        assert!(error.to_string().contains(words), "{error}");
    };
    refused(&empty, "manifest.json");
    for (file, content, words) in [
        ("manifest.json", "{", "manifest.json"),
        ("manifest.json", "{}", "has no `spec`"),
        ("map.csv", "instance,type\n0,stable\n", "no column `status`"),
        ("map.csv", "instance,status\n0,ok\n", "1 rows for 845 instances"),
        ("map.csv", "instance,status\n0,odd\n", "`odd` is no status"),
        ("map.csv", "a,b\n1\n", "map.csv"),
    ] {
        let directory = directory(&sweep());
        std::fs::write(directory.path().join(file), content).unwrap();
        refused(&directory, words);
    }
}

#[test]
fn every_format_has_the_width_that_was_asked_for() {
    let map = sweep();
    let widths = Journal::ALL.map(|journal| (journal.width(), journal.enlarged(), journal.name()));
    for (width, enlarged, name) in widths.into_iter().chain([(60.0, 1.0, "narrow"), (140.0, 1.0, "middle")]) {
        let look = Look { width: Some(width), enlarged, ..Look::default() };
        let svg = look_svg(&map, &look).unwrap();
        let [stated, height] = size(&svg);
        near("SVG", stated, width, 0.01);
        let picture = draw(&svg, &format!("plot_{name}"));
        near("PNG", f64::from(picture.width()) / 300.0 * 25.4, width, 25.4 / 300.0);
        // The page of the PDF, in points, as a reader of the file finds it.
        let bytes = pdf::render(&svg, "A title", "squealmap plot somewhere", &program()).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        for (found, stated) in page(&bytes).into_iter().zip([width, height]) {
            near("PDF", found, stated, 0.02);
        }
        assert!(
            text.starts_with("%PDF-") && text.contains("/FontFile"),
            "text stays text, its font embedded"
        );
        // 7 to 9 points on paper, larger on a slide; every panel is inside the page.
        for drawn in text_sizes(&svg) {
            assert!((7.0..=9.0).contains(&drawn), "{name}: {drawn} pt");
        }
        let frames = frames(&svg);
        assert_eq!(frames.len(), 10, "five velocities, two blocks");
        let drawn_width = width * 72.0 / 25.4 / enlarged;
        assert!(frames.iter().all(|[x, _, w, _]| *x > 0.0 && x + w < drawn_width && *w > 40.0), "{name}");
    }
}

#[test]
fn quantities_have_a_bar_and_undefined_cells_are_hatched() {
    let mut map = sweep();
    map.spec.analysis.response = false;
    for (k, record) in map.records.iter_mut().enumerate() {
        if let Some(linear) = &mut record.linear {
            linear.growth_rate = (k / 65) as f64;
            linear.phase = (k % 2 == 0).then_some(-20.0);
        }
    }
    let back = Archive::read(directory(&map).path()).unwrap();
    let column = |name: &str| back.columns.iter().find(|column| column.name == name).unwrap();
    assert_eq!((column("growth_rate").unit.as_str(), column("growth_rate").values[65]), ("1/s", Some(1.0)));
    let contents = vec![Content::quantity(column("growth_rate")), Content::quantity(column("phase"))];
    let svg = look_svg(&back.map, &Look { contents, ..Look::default() }).unwrap();
    let picture = draw(&svg, "plot_quantity");
    assert!(svg.contains(">Growth rate <") && svg.contains("undefined (422)"), "422 of 845 are odd");
    // mu_s runs to the right, and with it the growth: the picture darkens steadily.
    let frame = frames(&svg)[0];
    let lightness = |k: usize| {
        let [r, g, b] = colour(&picture, frame, ((k as f64 + 0.5) / 13.0, 0.5));
        lab(&format!("#{r:02X}{g:02X}{b:02X}"), &DICHROMACIES[0].1)[0]
    };
    let along: Vec<f64> = (0..13).map(lightness).collect();
    assert!(along.windows(2).all(|pair| pair[1] < pair[0] - 2.0), "{along:?}");
}

#[test]
fn hatchings_lie_on_the_classes_and_leave_their_colours_apart() {
    let axes = vec![span(Param::MuS, 0.0, 0.6, 7), span(Param::MuD, 0.0, 0.6, 2)];
    let map = map(Grid::Axes(axes), |k, _| record(Kind::ALL[k / 2], Regime::ALL[k / 2], true));
    let look = Look { contents: computed(map.spec.analysis, true), width: Some(190.0), ..Look::default() };
    let svg = look_svg(&map, &look).unwrap();
    let picture = draw(&svg, "plot_hatched");
    let frame = frames(&svg)[0];
    let mut seen = Vec::new();
    for (k, class) in TYPES.iter().enumerate() {
        let at = |i: usize| {
            let (right, up) = (((i % 40) as f64 + 0.5) / 40.0, ((i / 40) as f64 + 0.5) / 40.0);
            colour(&picture, frame, ((k as f64 + 0.1 + 0.8 * right) / 7.0, 0.05 + 0.9 * up))
        };
        let dots: Vec<[u8; 3]> = (0..1600).map(at).collect();
        let plain = dots.iter().filter(|dot| **dot == rgb(class.fill)).count() as f64 / 1600.0;
        assert!(plain > 0.3 && (plain < 0.97) == (k > 0), "{}: {plain}", class.name);
        let mean: [f64; 3] =
            std::array::from_fn(|c| dots.iter().map(|dot| f64::from(dot[c])).sum::<f64>() / 1600.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a mean of bytes")]
        let [r, g, b] = mean.map(|x| x.round() as u8);
        seen.push(format!("#{r:02X}{g:02X}{b:02X}"));
    }
    for (name, dichromacy) in &DICHROMACIES {
        for (k, one) in seen.iter().enumerate() {
            for other in &seen[k + 1..] {
                let distance = delta_e(lab(one, dichromacy), lab(other, dichromacy));
                assert!(distance > 6.0, "{name}: {one} {other} {distance}");
            }
        }
    }
    let plain = look_svg(&map, &Look { width: Some(190.0), ..Look::default() }).unwrap();
    assert!(!plain.contains(r#"class="hatch""#) && svg.contains(r#"class="hatch""#));
}

#[test]
fn boundary_lines_stand_between_the_values() {
    // Stable below mu_s = 0.25, else not: one straight line between 0.2 and 0.3, in every panel.
    let axes = vec![
        axis(Param::MuS, &[0.0, 0.1, 0.2, 0.3, 0.4]),
        axis(Param::MuD, &[0.0, 0.2, 0.4]),
        axis(Param::BeltVelocity, &[1.0, 2.0]),
    ];
    let kinds = |mu: f64| if mu < 0.25 { Kind::Stable } else { Kind::ModeCoupling };
    let mut map = map(Grid::Axes(axes), |_, at| record(kinds(number(at[0])), Regime::Slip, true));
    let table = String::from_utf8(boundary_lines(&map).unwrap()).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0], ["panel", "separates", "x", "y"]);
    assert_eq!(rows.len(), 1 + 2 * 3, "two corners and a NaN for each panel: {table}");
    for (panel, line) in rows[1..].chunks(3).enumerate() {
        assert!(line.iter().all(|row| row[0] == (panel + 1).to_string() && row[1] == "type"), "{table}");
        let at = |k: usize| [2, 3].map(|column| line[k][column].parse::<f64>().unwrap());
        let mut ends = [at(0), at(1)];
        ends.sort_by(|a, b| a[1].total_cmp(&b[1]));
        for (found, expected) in ends.into_iter().zip([[0.25, -0.1], [0.25, 0.5]]) {
            near("x", found[0], expected[0], 1e-12);
            near("y", found[1], expected[1], 1e-12);
        }
        assert_eq!(line[2][2..], ["NaN", "NaN"]);
    }
    // A regime elsewhere is a line of its own.
    map.records[0].regime = Some(Regime::Stuck);
    let table = String::from_utf8(boundary_lines(&map).unwrap()).unwrap();
    assert!(table.contains("1,regime,0.05,") && !table.contains("2,regime"), "{table}");
}

#[test]
fn the_metadata_names_the_command() {
    let map = sweep();
    let command = "squealmap plot out/a --journal slide, of results of squealmap 0.2.0".to_owned();
    let svg = look_svg(&map, &Look { command: Some(command.clone()), ..Look::default() }).unwrap();
    let metadata = svg.lines().find(|line| line.starts_with("<metadata>")).unwrap();
    assert!(metadata.contains(&command) && metadata.contains("reference f64"), "{metadata}");
    let bytes = pdf::render(&svg, "Title of a map", &command, &program()).unwrap();
    let text = String::from_utf8_lossy(&bytes);
    assert!(
        text.contains("Title of a map") && text.contains("--journal slide"),
        "in the metadata of the PDF"
    );
    assert!(png::render(&svg).is_ok());
    assert!(matches!(
        pdf::render("no picture", "", "", &program()),
        Err(squealmap_figure::Error::ReadSvg(_))
    ));
}

#[test]
fn the_basins_of_a_box_have_a_block_of_their_own() {
    const STARTS: u32 = 12;
    let axes = vec![span(Param::MuS, 0.0, 0.6, 13), span(Param::MuD, 0.0, 0.6, 3)];
    let mut map = map(Grid::Axes(axes), |k, _| {
        let oscillation = u32::try_from(k / 3).unwrap();
        let basin = Basin { equilibrium: STARTS - oscillation, oscillation, other: 0, failed: 0 };
        let others = (k != 38).then_some(Others::Basin(basin));
        Record { others, ..record(Kind::Stable, Regime::Slip, true) }
    });
    map.spec.analysis.starts = Starts::Box(STARTS);
    let svg = map_svg(&map).unwrap();
    let back = Archive::read(directory(&map).path()).unwrap();
    assert_eq!(map_svg(&back.map).unwrap(), svg, "the same text from the columns of fractions");
    assert!(svg.contains(">fraction of starts<") && svg.contains("undefined (1)"));
    let picture = draw(&svg, "plot_basins");
    // Type, regime, bistability, and the fractions: each a panel, the last with a bar.
    let frames = frames(&svg);
    assert_eq!(frames.len(), 4 + 1);
    let lightness = |k: usize| {
        let [r, g, b] = colour(&picture, frames[3], ((k as f64 + 0.5) / 13.0, 0.5));
        lab(&format!("#{r:02X}{g:02X}{b:02X}"), &DICHROMACIES[0].1)[0]
    };
    let along: Vec<f64> = (0..13).map(lightness).collect();
    assert!(along.windows(2).all(|pair| pair[1] < pair[0] - 2.0), "{along:?}");
    // The column by itself has the same words beside its bar.
    let column = back.columns.iter().find(|column| column.name == "basin_oscillation").unwrap();
    let contents = vec![Content::quantity(column)];
    let svg = look_svg(&back.map, &Look { contents, ..Look::default() }).unwrap();
    assert!(svg.contains(">fraction of starts<"));
}

#[test]
fn the_regime_from_a_large_start_has_a_block_of_its_own() {
    let axes = vec![span(Param::MuS, 0.0, 0.6, 6), span(Param::MuD, 0.0, 0.6, 6)];
    let mut map = map(Grid::Axes(axes), |k, _| {
        let large = record(Kind::Stable, Regime::ALL[k % 8], k % 3 > 0);
        let others = Some(Others::Large(Box::new(Record { kind: None, linear: None, ..large })));
        Record { others, ..record(Kind::Stable, Regime::Slip, true) }
    });
    map.spec.analysis.starts = Starts::Both;
    let svg = map_svg(&map).unwrap();
    let back = Archive::read(directory(&map).path()).unwrap();
    assert_eq!(map_svg(&back.map).unwrap(), svg, "the same text from the columns of the large start");
    assert!(svg.contains("large start (time integration)"));
    assert_eq!(frames(&svg).len(), 4, "type, both regimes, bistability");
    // Every regime occurs from the large start alone: once as an area, and in the legend with its number.
    let slip = svg.matches("class=\"slip\"").count();
    assert_eq!(slip, 2, "one area from each start");
    for regime in Regime::ALL.into_iter().filter(|regime| *regime != Regime::Slip) {
        assert_eq!(svg.matches(&format!("class=\"{}\"", regime.name())).count(), 1, "{}", regime.name());
    }
    // Without large starts in the records, as in a refined map, there is no such block.
    for record in &mut map.records {
        record.others = None;
    }
    assert_eq!(frames(&map_svg(&map).unwrap()).len(), 3);
}

#[test]
fn a_spoilt_table_is_refused_not_drawn() {
    let directory = directory(&sweep());
    let path = directory.path().join("map.csv");
    let text = std::fs::read_to_string(&path).unwrap();
    let rows: Vec<&str> = text.lines().collect();
    let mut moved = rows.clone();
    moved.swap(5, 9);
    let with = |name: &str, value: &str| {
        let column = rows[0].split(',').position(|header| header == name).unwrap();
        let mut cells: Vec<&str> = rows[3].split(',').collect();
        cells[column] = value;
        text.replace(rows[3], &cells.join(","))
    };
    for (content, words) in [
        (moved.join("\n"), "row 5 is of instance `8`, not 4; keep the rows in order"),
        (with("type", "foo"), "`type` is `foo`, which is none"),
        (with("regime", "bar"), "`regime` is `bar`, which is none"),
        (with("growth_rate", "x-0.02"), "`growth_rate` is `x-0.02` in a row, no number"),
        (text.replacen("growth_rate,", "growth,", 1), "has no column `growth_rate`"),
    ] {
        std::fs::write(&path, content).unwrap();
        let error = Archive::read(directory.path()).unwrap_err();
        assert!(error.is_bad_input() && error.to_string().contains(words), "{words}: {error}");
    }
}

#[test]
fn the_command_in_the_metadata_makes_the_same_again() {
    let directory = directory(&sweep());
    let inside = directory.path().join("it's here");
    std::fs::create_dir(&inside).unwrap();
    for name in ["map.csv", "manifest.json"] {
        std::fs::rename(directory.path().join(name), inside.join(name)).unwrap();
    }
    let first = squealmap(
        directory.path(),
        &["plot", "it's here", "--quantity", "growth", "--isolines", "-1,0", "--width", "90"],
    );
    assert_eq!(first.code, Some(0), "{}", first.err);
    let svg = std::fs::read_to_string(inside.join("plot.svg")).unwrap();
    let metadata = svg.lines().find(|line| line.starts_with("<metadata>")).unwrap();
    let command = metadata.split_once("squealmap plot ").unwrap().1.split_once(", of results").unwrap().0;
    assert!(command.ends_with("--width 90mm --quantity growth --isolines -1,0"), "{command}");
    let words = shlex::split(&command.replace("&quot;", "\"").replace("&apos;", "'")).unwrap();
    let words: Vec<&str> = std::iter::once("plot").chain(words.iter().map(String::as_str)).collect();
    assert_eq!(squealmap(directory.path(), &words).code, Some(0), "{words:?}");
    assert_eq!(std::fs::read_to_string(inside.join("plot.svg")).unwrap(), svg);
}
