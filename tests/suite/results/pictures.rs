//! Every figure of the program comes back from its directory, at the size of a journal.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;
use std::sync::Arc;

use crate::cli::program::squealmap;
use crate::common::near;
use crate::results::figure::draw;
use crate::results::gallery::{Piece, all};
use crate::results::plot::{page, size, text_sizes};
use resvg::usvg::{Node, Options, Tree, fontdb};
use squealmap::results::figure::look::{Journal, Look};
use squealmap::study::error::Error;
use squealmap::study::{Kind, Picture};
use squealmap::version::program;
use squealmap_figure::{pdf, png};

fn read(piece: &Piece) -> Picture {
    Picture::read(piece.directory.path(), piece.kind).unwrap()
}

/// A document as it is drawn, its texts with their fonts.
fn tree(svg: &str) -> Tree {
    let mut fonts = fontdb::Database::new();
    for font in ["Regular", "Italic", "Bold"] {
        let path = format!("{}/crates/figure/fonts/LiberationSans-{font}.ttf", env!("CARGO_MANIFEST_DIR"));
        fonts.load_font_source(fontdb::Source::Binary(Arc::new(std::fs::read(path).unwrap())));
    }
    fonts.set_sans_serif_family("Liberation Sans");
    let family = "Liberation Sans".to_owned();
    let options = Options { fontdb: Arc::new(fonts), font_family: family, ..Options::default() };
    Tree::from_str(svg, &options).unwrap()
}

/// The texts of a document and their boxes: left, upper, right and lower end, points of the document.
pub(crate) fn boxes(svg: &str) -> Vec<(String, [f32; 4])> {
    let mut found = Vec::new();
    texts(tree(svg).root(), &mut |node| {
        if let Node::Text(text) = node {
            let area = node.abs_stroke_bounding_box();
            let words: String = text.chunks().iter().map(|chunk| chunk.text().to_owned()).collect();
            found.push((words, [area.left(), area.top(), area.right(), area.bottom()]));
        }
    });
    found
}

/// The texts of a document that do not lie on its page, with their boxes.
pub(crate) fn outside(svg: &str) -> Vec<String> {
    let page = tree(svg).size();
    let is_inside = |[left, top, right, bottom]: &[f32; 4]| {
        *left >= 0.0 && *top >= 0.0 && *right <= page.width() && *bottom <= page.height()
    };
    let all = boxes(svg).into_iter().filter(|(_, area)| !is_inside(area));
    all.map(|(words, area)| format!("`{words}` at {area:?} of {page:?}")).collect()
}

/// The sizes of sub- and superscripts, points as drawn.
fn script_sizes(svg: &str) -> Vec<f64> {
    let scripts = svg.split("<tspan").skip(1).filter_map(|script| {
        let attributes = script.split_once('>').unwrap().0;
        Some(attributes.split_once("font-size=\"")?.1.split_once('"').unwrap().0.parse().unwrap())
    });
    scripts.collect()
}

fn texts(group: &resvg::usvg::Group, each: &mut impl FnMut(&Node)) {
    for node in group.children() {
        match node {
            Node::Group(group) => texts(group, each),
            Node::Text(_) => each(node),
            _ => {}
        }
    }
}

#[test]
fn every_figure_comes_back_from_its_directory() {
    let pieces = all();
    assert_eq!(pieces.iter().map(|piece| piece.kind).collect::<Vec<_>>(), Kind::ALL, "one of each");
    for piece in &pieces {
        let name = piece.kind.name();
        // Mesh and modes are in one file.
        let first = if piece.kind == Kind::Mesh { Kind::Shapes } else { piece.kind };
        assert_eq!(Kind::choose(piece.directory.path(), None).unwrap(), first);
        assert_eq!(Kind::choose(piece.directory.path(), Some(piece.kind)).unwrap(), piece.kind);
        let picture = read(piece);
        let again = picture.svg(&Look::default()).unwrap();
        assert!(again == piece.svg, "{name}: not the same text");
        assert!(picture.program.starts_with("squealmap 0."), "{name}: {}", picture.program);
        let command = "squealmap plot somewhere --width 120mm".to_owned();
        let other = picture.svg(&Look { command: Some(command.clone()), ..Look::default() }).unwrap();
        let [a, b] = [&again, &other].map(|svg| svg.lines().collect::<Vec<_>>());
        let differ: Vec<&str> = a.iter().zip(&b).filter(|(a, b)| a != b).map(|(_, b)| *b).collect();
        assert!(a.len() == b.len() && differ.len() == 1, "{name}: {differ:?}");
        assert!(differ[0].starts_with("<metadata>") && differ[0].contains(&command), "{name}: {differ:?}");
    }
}

/// A row of a table with every number a tenth off, whichever of them the figure shows; of a map, which shows labels, with
/// another type.
fn changed(row: &str, header: &str, labels: bool) -> String {
    let cell = |(name, cell): (&str, &str)| match (labels, name, cell.parse::<f64>()) {
        (true, "type", _) => "divergence".to_owned(),
        (true, ..) | (_, "steps_per_period", _) | (.., Err(_)) => cell.to_owned(),
        (.., Ok(number)) => (1.1 * number + 0.01).to_string(),
    };
    header.split(',').zip(row.split(',')).map(cell).collect::<Vec<_>>().join(",")
}

/// Takes the checksums out of a document.
fn without_sums(path: &Path) {
    let mut document: serde_json::Value = serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap();
    for key in ["files", "checksum"] {
        document.as_object_mut().unwrap().remove(key).unwrap();
    }
    std::fs::write(path, document.to_string()).unwrap();
}

/// The picture is drawn from the numbers in the table: another number is another picture.
#[test]
fn another_number_is_another_picture() {
    let no_table = [Kind::Identify, Kind::Shapes, Kind::Mesh];
    for piece in all().iter().filter(|piece| !no_table.contains(&piece.kind)) {
        let name = piece.kind.name();
        let labels = matches!(piece.kind, Kind::Map | Kind::Refined);
        let file =
            piece.kind.files().into_iter().find(|file| file.split_once('.').unwrap().1 == "csv").unwrap();
        let path = piece.directory.path().join(file);
        let text = std::fs::read_to_string(&path).unwrap();
        let rows: Vec<&str> = text.lines().collect();
        let row = rows[rows.len() / 2];
        let other = changed(row, rows[0], labels);
        assert_ne!(row, other, "{name}");
        std::fs::write(&path, text.replace(row, &other)).unwrap();
        if piece.kind == Kind::Refined {
            // Refused as long as its checksum stands beside it.
            let refused = Picture::read(piece.directory.path(), piece.kind).unwrap_err();
            assert!(refused.to_string().contains("its checksum is another one"), "{refused}");
            without_sums(&piece.directory.path().join("refine.json"));
        }
        match Picture::read(piece.directory.path(), piece.kind) {
            Ok(picture) => assert!(picture.svg(&Look::default()).unwrap() != piece.svg, "{name}"),
            // Both branches of a hysteresis have to have the same values, all modes of a variation too, and a curve lies in a plane of its
            // sweep.
            Err(Error::OfResults(squealmap::results::error::Error::Archive { .. }))
                if matches!(piece.kind, Kind::Hysteresis | Kind::Vary | Kind::Curves) => {}
            Err(why) => panic!("{name}: {why}"),
        }
        // What is no number, or no label, is named with its file.
        let broken = row.replace(|c: char| c.is_ascii_alphanumeric(), "x");
        std::fs::write(&path, text.replace(row, &broken)).unwrap();
        let error = Picture::read(piece.directory.path(), piece.kind).unwrap_err();
        assert!(error.is_bad_input() && error.to_string().contains(file), "{name}: {error}");
    }
}

/// The same of bodies: another place of a node, or another displacement, is another picture, and what is no grid is an error.
#[test]
fn the_grid_belongs_to_its_figures() {
    for piece in all().into_iter().filter(|piece| matches!(piece.kind, Kind::Shapes | Kind::Mesh)) {
        let path = piece.directory.path().join("shapes.vtu");
        let text = std::fs::read_to_string(&path).unwrap();
        let array = if piece.kind == Kind::Mesh { "\"places\"" } else { "Hz, " };
        let from = text.find(array).unwrap();
        let line = from + text[from..].find('\n').unwrap() + 1;
        let moved =
            format!("{}1e-3 2e-3 5e-3{}", &text[..line], &text[line + text[line..].find('\n').unwrap()..]);
        std::fs::write(&path, moved).unwrap();
        assert!(read(&piece).svg(&Look::default()).unwrap() != piece.svg, "{}", piece.kind.name());
        for (old, new, wanted) in [
            ("<Cells>", "<Cell>", "it is no XML"),
            ("\"places\"", "\"place\"", "it has no array \"places\" in <Points>"),
            ("0 1 ", "0 99999 ", "has no 8 nodes"),
            (
                "Name=\"types\" format=\"ascii\">\n12",
                "Name=\"types\" format=\"ascii\">\n7",
                "its cell 0 is of type 7",
            ),
            ("mode 1 at", "mode 11 at", "has no shape \"mode 1 at mu 0, "),
        ] {
            assert!(text.contains(old), "{old}");
            std::fs::write(&path, text.replace(old, new)).unwrap();
            let error = Picture::read(piece.directory.path(), piece.kind).unwrap_err();
            assert!(error.is_bad_input() && error.to_string().contains(wanted), "{error}");
        }
    }
}

/// The same of measured signals, whose spectrogram is no table: another number is another picture, another byte an error.
#[test]
fn the_spectrogram_belongs_to_its_figure() {
    let piece = all().into_iter().find(|piece| piece.kind == Kind::Identify).unwrap();
    let [nc, json] = piece.kind.files().map(|file| piece.directory.path().join(file));
    let text = std::fs::read_to_string(&json).unwrap();
    std::fs::write(&json, text.replacen("[0.3,1.1]", "[0.35,1.1]", 1)).unwrap();
    assert!(read(&piece).svg(&Look::default()).unwrap() != piece.svg);
    let bytes = std::fs::read(&nc).unwrap();
    let mut level = bytes.clone();
    // The levels in dB come last; the normalised ones before them are drawn.
    let document: serde_json::Value = serde_json::from_str(&text).unwrap();
    let of = |name: &str| document["figure"]["spectrogram"][name].as_u64().unwrap();
    let last = bytes.len() - 4 - 4 * usize::try_from(of("columns") * of("rows")).unwrap();
    level[last..last + 4].copy_from_slice(&0.5_f32.to_be_bytes());
    std::fs::write(&json, &text).unwrap();
    std::fs::write(&nc, &level).unwrap();
    assert!(read(&piece).svg(&Look::default()).unwrap() != piece.svg);
    let mut header = bytes.clone();
    header[9] ^= 1;
    let other_size = text.replacen("\"rows\":12", "\"rows\":13", 1);
    assert_ne!(other_size, text);
    for (text, bytes) in [(&text, header), (&text, bytes[..100].to_vec()), (&other_size, bytes)] {
        std::fs::write(&json, text).unwrap();
        std::fs::write(&nc, bytes).unwrap();
        let error = Picture::read(piece.directory.path(), piece.kind).unwrap_err();
        assert!(error.to_string().contains("does not belong to `figure.json`"), "{error}");
    }
}

#[test]
fn a_directory_without_figures_says_what_was_looked_for() {
    let empty = tempfile::tempdir().unwrap();
    let error = Kind::choose(empty.path(), None).unwrap_err();
    assert!(error.is_bad_input() && matches!(error, Error::NothingToPlot { .. }), "{error}");
    for kind in Kind::ALL {
        assert!(kind.files().iter().all(|file| error.to_string().contains(file)), "{error}");
        let error = Kind::choose(empty.path(), Some(kind)).unwrap_err().to_string();
        assert!(error.contains(kind.files()[0]) && error.contains(kind.name()), "{error}");
    }
    for piece in all() {
        for file in piece.kind.files() {
            let path = piece.directory.path().join(file);
            let kept = std::fs::read(&path).unwrap();
            std::fs::write(&path, "{").unwrap();
            let error = Picture::read(piece.directory.path(), piece.kind).unwrap_err();
            assert!(error.to_string().contains(file), "{error}");
            std::fs::write(&path, kept).unwrap();
        }
    }
}

/// Sizes as a reader of the files finds them, of every figure at every width that is asked for.
#[test]
fn every_figure_has_the_size_of_its_journal() {
    let mut beyond = Vec::new();
    for piece in all() {
        let picture = read(&piece);
        for journal in Journal::ALL {
            let (kind, name) = (piece.kind.name(), journal.name());
            let look = Look::of_journal(journal);
            let svg = picture.svg(&look).unwrap();
            let [width, height] = size(&svg);
            // Its maps are three rows of squares and more: too many for a slide, and refused there.
            let fits = (kind, journal) != ("phase", Journal::Slide);
            assert_eq!(height <= journal.height() + 0.01, fits, "{kind}, {name}: {height} mm tall");
            assert_eq!(look.check_height(&svg, "").is_ok(), fits, "{kind}, {name}");
            near(&format!("{kind}, {name}: SVG"), width, journal.width(), 0.01);
            let pixels = draw(&svg, &format!("print_{kind}_{name}"));
            near(
                &format!("{kind}, {name}: PNG"),
                f64::from(pixels.width()) / 300.0 * 25.4,
                width,
                25.4 / 300.0,
            );
            let found = page(&pdf::render(&svg, picture.title(), "a command", &program()).unwrap());
            for (found, stated) in found.into_iter().zip([width, height]) {
                near(&format!("{kind}, {name}: PDF"), found, stated, 0.02);
            }
            for points in text_sizes(&svg) {
                assert!((7.0..=9.0).contains(&points), "{kind}, {name}: {points} pt");
            }
            for points in script_sizes(&svg) {
                assert!((6.0..=9.0).contains(&points), "{kind}, {name}: script of {points} pt");
            }
            beyond.extend(outside(&svg).into_iter().map(|text| format!("{kind}, {name}: {text}")));
        }
    }
    for piece in all() {
        let look = Look { width: Some(piece.kind.narrowest()), ..Look::default() };
        let svg = read(&piece).svg(&look).unwrap();
        beyond.extend(
            outside(&svg).into_iter().map(|text| format!("{}, narrowest: {text}", piece.kind.name())),
        );
    }
    assert!(beyond.is_empty(), "{}", beyond.join("\n"));
    // A text beyond the page is seen.
    let svg = all()[2].svg.replacen("<text x=\"", "<text x=\"99", 1);
    assert_eq!(outside(&svg).len(), 1);
}

#[test]
fn a_png_says_what_made_it() {
    let piece = &all()[4];
    let bytes = png::render_described(&piece.svg, "Modes µ", "squealmap plot out").unwrap();
    let decoder =
        |bytes: &[u8]| resvg::tiny_skia::Pixmap::decode_png(bytes).map(|picture| picture.data().to_vec());
    assert_eq!(decoder(&bytes).unwrap(), decoder(&png::render(&piece.svg).unwrap()).unwrap());
    let chunks = chunks(&bytes);
    let texts: Vec<&[u8]> =
        chunks.iter().filter(|(name, _)| name == b"iTXt").map(|(_, body)| *body).collect();
    let expected = ["Title\0\0\0\0\0Modes µ", "Description\0\0\0\0\0squealmap plot out"];
    assert_eq!(texts, expected.map(str::as_bytes));
}

/// Type and content of every chunk of a PNG, as its specification lays them out.
fn chunks(png: &[u8]) -> Vec<([u8; 4], &[u8])> {
    let mut rest = &png[8..];
    let mut found = Vec::new();
    while rest.len() >= 12 {
        let length = u32::from_be_bytes(rest[..4].try_into().unwrap()) as usize;
        found.push((rest[4..8].try_into().unwrap(), &rest[8..8 + length]));
        rest = &rest[12 + length..];
    }
    found
}

#[test]
fn what_paper_was_told_to_write_to_can_be_named() {
    let figure = all().into_iter().find(|piece| piece.kind.name() == "figure3").unwrap();
    let directory = tempfile::tempdir().unwrap();
    let inside = directory.path().join("paper");
    std::fs::create_dir(&inside).unwrap();
    for file in figure.kind.files() {
        std::fs::copy(figure.directory.path().join(file), inside.join(file)).unwrap();
    }
    let ended = squealmap(directory.path(), &["plot", "."]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(inside.join("plot.svg").is_file());
    let narrow = squealmap(directory.path(), &["plot", ".", "--width", "69"]);
    assert_eq!(narrow.code, Some(2));
    assert!(narrow.err.contains("the figure `figure3` needs at least 70 mm"), "{}", narrow.err);
}
