//! One figure read back, ready to be drawn at any width.

use std::path::Path;

use crate::results::figure::heading::Heading;
use crate::results::figure::look::Look;
use crate::results::figure::map::look_svg;
use crate::results::manifest::Program;
use crate::results::read::folder::Folder;
use crate::results::read::refined::Lines;
use crate::results::read::{Archive, refined};
use crate::study::campaign::figure::campaign_svg;
use crate::study::campaign::row::Said;
use crate::study::curves::figure::curves_svg;
use crate::study::curves::read::Curves;
use crate::study::error::{Error, Result};
use crate::study::fem;
use crate::study::fem::Bodies;
use crate::study::fit::figure::fit_svg;
use crate::study::hysteresis::follow::Hysteresis;
use crate::study::hysteresis::table::hysteresis_svg;
use crate::study::modes::follow::{Modes, draw};
use crate::study::paper::figures::Shown;
use crate::study::trace::run::Trace;
use crate::study::trace::table::trace_svg;
use crate::study::tradeoff::report::figure;
use crate::study::{Kind, campaign, curves, fit, hysteresis, identify, modes, paper, trace, tradeoff};
use crate::sweep::accuracy::row::Row;
use crate::sweep::grid::Grid;
use crate::sweep::spec::Spec;

/// The content of a figure.
#[derive(Clone, Debug)]
enum Content {
    Map(Box<Archive>),
    Refined(Box<Lines>),
    Trace(Box<Trace>, Heading),
    Hysteresis(Hysteresis, Heading),
    Curves(Box<Curves>),
    Modes(Box<Spec>, Modes),
    Tradeoff(String, Vec<Row>),
    Identify(Box<identify::report::Shown>),
    Campaign(String, Vec<Said>),
    Fit(fit::course::Shown),
    Fem(fem::Curves),
    Shapes(Box<Bodies>),
    Mesh(Box<Bodies>),
    Paper(Shown),
}

/// A figure read back from the directory of its command.
#[derive(Clone, Debug)]
pub struct Picture {
    content: Content,
    /// The program that computed it: version, and commit where known.
    pub program: String,
}

impl Picture {
    /// Reads what a figure is drawn from.
    ///
    /// # Errors
    /// When a file is missing or is not what the command writes.
    pub fn read(directory: &Path, kind: Kind) -> Result<Picture> {
        let folder = Folder(directory);
        let content = match kind {
            Kind::Map => Content::Map(Box::new(Archive::read(directory)?)),
            Kind::Refined => Content::Refined(Box::new(refined::read(folder)?)),
            Kind::Trace => {
                let (trace, heading) = trace::read::read(folder)?;
                Content::Trace(Box::new(trace), heading)
            }
            Kind::Hysteresis => {
                let (hysteresis, heading) = hysteresis::read::read(folder)?;
                Content::Hysteresis(hysteresis, heading)
            }
            Kind::Curves => Content::Curves(Box::new(curves::read::read(folder)?)),
            Kind::Modes => {
                let (spec, modes) = modes::read::read(folder, kind.files())?;
                Content::Modes(Box::new(spec), modes)
            }
            Kind::Tradeoff => {
                let (title, rows) = tradeoff::read::read(folder)?;
                Content::Tradeoff(title, rows)
            }
            Kind::Identify => Content::Identify(Box::new(identify::read::read(folder)?)),
            Kind::Campaign => {
                let (title, strokes) = campaign::read::read(folder)?;
                Content::Campaign(title, strokes)
            }
            Kind::Fit => Content::Fit(fit::read::read(folder)?),
            Kind::Fem => Content::Fem(fem::read::read(folder)?),
            Kind::Vary => Content::Fem(fem::read::read_varied(folder)?),
            Kind::Shapes => Content::Shapes(Box::new(Bodies::read(folder, kind.files())?)),
            Kind::Mesh => Content::Mesh(Box::new(Bodies::read(folder, kind.files())?)),
            Kind::Paper(figure) => Content::Paper(paper::read::read(folder, figure, kind.files())?),
        };
        let document = kind.files().into_iter().find(|file| file.rsplit('.').next() == Some("json"));
        let document = document.map_or(Ok(serde_json::Value::Null), |file| folder.json(file))?;
        let named = document["program"].as_str().map(str::to_owned);
        let program = named.unwrap_or_else(|| Program::of(&document).to_string());
        Ok(Picture { content, program })
    }

    /// The map, if it is one: quantities and lines can be asked for then.
    #[must_use]
    pub fn map(&self) -> Option<&Archive> {
        match &self.content {
            Content::Map(archive) => Some(archive),
            _ => None,
        }
    }

    /// The grid of a map, computed or refined, over which lines can be drawn.
    #[must_use]
    pub fn grid(&self) -> Option<&Grid> {
        match &self.content {
            Content::Map(archive) => Some(&archive.map.spec.grid),
            Content::Refined(lines) => Some(&lines.spec.grid),
            _ => None,
        }
    }

    /// The title of the sweep; may be empty.
    #[must_use]
    pub fn title(&self) -> &str {
        match &self.content {
            Content::Map(archive) => &archive.map.spec.title,
            Content::Refined(lines) => &lines.spec.title,
            Content::Trace(_, heading) | Content::Hysteresis(_, heading) => &heading.title,
            Content::Curves(curves) => &curves.spec.title,
            Content::Modes(spec, _) => &spec.title,
            Content::Tradeoff(title, _) | Content::Campaign(title, _) => title,
            Content::Identify(shown) => &shown.title,
            Content::Fit(shown) => &shown.title,
            Content::Fem(curves) => &curves.title,
            Content::Shapes(bodies) | Content::Mesh(bodies) => bodies.title(),
            Content::Paper(shown) => shown.title(),
        }
    }

    /// The figure as an SVG document: at the default look it is that of the command itself.
    ///
    /// # Errors
    /// When an instance of a map was never computed, and not because the run was stopped.
    pub fn svg(&self, look: &Look<'_>) -> Result<String> {
        match &self.content {
            Content::Map(archive) => Ok(look_svg(&archive.map, look)?),
            Content::Refined(lines) => Ok(lines.svg(look)),
            Content::Trace(trace, heading) => trace_svg(trace, heading, look),
            Content::Hysteresis(hysteresis, heading) => Ok(hysteresis_svg(hysteresis, heading, look)),
            Content::Curves(curves) => Ok(curves_svg(&curves.spec, &curves.lines, look)),
            Content::Modes(spec, modes) => Ok(draw(spec, modes, look)),
            Content::Tradeoff(title, rows) => Ok(figure(title, rows, look)),
            Content::Identify(shown) => identify::report::identify_svg(shown, look),
            Content::Campaign(title, strokes) => Ok(campaign_svg(title, strokes, look)),
            Content::Fit(shown) => Ok(fit_svg(shown, look)),
            Content::Fem(curves) => Ok(curves.svg(look).unwrap_or_default()),
            Content::Shapes(bodies) => bodies.shapes_svg(look).ok_or(Error::NoShapes),
            Content::Mesh(bodies) => Ok(bodies.mesh_svg(look)),
            Content::Paper(shown) => Ok(shown.svg(look)),
        }
    }
}
