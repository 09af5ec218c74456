//! The sections of a sweep file, key by key; what concerns several keys is in `check`.

use crate::engine::plan::Duration;
use crate::model::friction::LawKind;
use crate::model::material::Outside;
use crate::model::motion::Motion;
use crate::model::{Param, Params, Section};
use crate::sweep::error::{Error, Result};
use crate::sweep::spec::document::{
    Entry, Node, array, boolean, choice, entries, integer, number, out_of_range_at, string, table,
};
use crate::sweep::spec::duration::{AUTO, CYCLE, duration};
use crate::sweep::spec::keys::{STEPS_RANGE, home, names_of};
use crate::sweep::spec::names::unknown;
use crate::sweep::spec::refine::{COARSE, Settings};
use crate::sweep::spec::start::{BOX_SAMPLES, Kind, SAMPLES_RANGE};
use crate::sweep::spec::{Analysis, STEPS_PER_PERIOD, Starts, law, model};
use squealmap_input::place::Source;
use squealmap_input::quote::is_obeyed;
use std::ops::Range;

/// Most instances that a refined map draws, as many as any sweep in memory has.
pub(super) const MOST_SAMPLED: usize = u32::MAX as usize;

/// The largest seed that TOML holds.
#[expect(clippy::cast_possible_truncation, reason = "the smaller of both limits where pointers have 32 bits")]
pub(super) const MOST_SEED: usize = i64::MAX as usize;

/// A key that stands in a section.
#[derive(Clone, Debug)]
pub(super) struct Given {
    pub(super) name: &'static str,
    pub(super) section: Section,
    pub(super) span: Range<usize>,
}

impl Given {
    pub(super) fn label(&self) -> String {
        format!("`{}` in [{}]", self.name, self.section.name())
    }
}

/// A file name and where it stands.
pub(super) type FileName = (String, Range<usize>);

/// Everything outside `[axes]` and `points`, defaults filled in where they do not depend on other keys.
#[derive(Debug)]
pub(super) struct Sections {
    pub(super) title: String,
    pub(super) analysis: Analysis,
    pub(super) base: Params,
    pub(super) model: model::Kind,
    pub(super) modes: Option<FileName>,
    pub(super) impact_friction: bool,
    pub(super) law: LawKind,
    pub(super) table: Option<FileName>,
    pub(super) material: Option<FileName>,
    /// How the belt moves, by its name.
    pub(super) motion: &'static str,
    /// The file of that motion.
    pub(super) motion_table: Option<FileName>,
    pub(super) outside: Outside,
    pub(super) start: Kind,
    /// Starts drawn from a box.
    pub(super) box_samples: u32,
    pub(super) settle: Option<Duration>,
    /// Where `settle = "auto"` or `settle = "cycle"` stands.
    pub(super) auto: Option<Range<usize>>,
    /// Whether it is the latter.
    pub(super) cycle: bool,
    /// `settle_limit`, and where it stands.
    pub(super) settle_limit: Option<(Duration, Range<usize>)>,
    pub(super) measure: Option<Duration>,
    pub(super) check: bool,
    pub(super) steps_per_period: u32,
    /// Where a response is asked for in words, in `analysis` or by `[response]`.
    pub(super) response_asked: Option<Range<usize>>,
    /// Where `steps_per_period` stands.
    pub(super) steps_given: Option<Range<usize>>,
    /// `[refine]`.
    pub(super) refine: Option<Settings>,
    pub(super) given: Vec<Given>,
    headers: Vec<(&'static str, Range<usize>)>,
}

impl Default for Sections {
    fn default() -> Self {
        Sections {
            title: String::new(),
            analysis: Analysis {
                linear: true,
                response: true,
                until_settled: false,
                finds_cycles: false,
                checked: false,
                starts: Starts::One,
            },
            base: Params::default(),
            model: model::Kind::default(),
            modes: None,
            impact_friction: true,
            law: LawKind::Bilinear,
            table: None,
            material: None,
            motion: Motion::RAMP,
            motion_table: None,
            outside: Outside::Error,
            start: Kind::Kick,
            box_samples: BOX_SAMPLES,
            settle: None,
            auto: None,
            cycle: false,
            settle_limit: None,
            measure: None,
            check: true,
            steps_per_period: STEPS_PER_PERIOD,
            response_asked: None,
            steps_given: None,
            refine: None,
            given: Vec::new(),
            headers: Vec::new(),
        }
    }
}

impl Sections {
    /// The starts of every instance.
    pub(super) fn starts(&self) -> Starts {
        self.start.starts(self.box_samples)
    }

    /// Where a key stands in a section, if it does.
    pub(super) fn find_in(&self, section: Section, name: &str) -> Option<&Given> {
        self.given.iter().find(|given| given.section == section && given.name == name)
    }

    /// Where a key that only one section has stands, if it does.
    pub(super) fn find(&self, name: &str) -> Option<&Given> {
        self.given.iter().find(|given| given.name == name)
    }

    /// Where a section begins, or the start of the file.
    pub(super) fn header(&self, section: Section) -> Range<usize> {
        self.headers.iter().find(|(name, _)| *name == section.name()).map_or(0..0, |(_, span)| span.clone())
    }

    /// `title` and `analysis`.
    pub(super) fn top_level(&mut self, source: &Source, entry: Entry) -> Result<()> {
        if entry.key == "title" {
            let title = string(source, entry.node, "`title`", "a string")?;
            legal_title(source, &entry.node.span(), title)?;
            title.clone_into(&mut self.title);
            return Ok(());
        }
        let names = array(source, entry.node, "`analysis`", "an array of \"linear\" and \"response\"")?;
        (self.analysis.linear, self.analysis.response) = (false, false);
        for name in names {
            let choices = [("linear", false), ("response", true)];
            let response = choice(source, name, "an element of `analysis`", "analysis", &choices)?;
            self.analysis.linear |= !response;
            self.analysis.response |= response;
            if response {
                self.response_asked = Some(name.span());
            }
        }
        if names.is_empty() {
            let at = source.place(entry.node.span());
            return Err(Error::Empty {
                at,
                what: "`analysis`".to_owned(),
                least: "\"linear\" or \"response\"",
            });
        }
        Ok(())
    }

    /// One of `[model]`, `[friction]`, `[belt]`, `[start]`.
    pub(super) fn section(&mut self, source: &Source, section: Section, entry: Entry) -> Result<()> {
        let expected = format!("a table, written as a line [{}] above its keys", section.name());
        self.headers.push((section.name(), entry.key_span()));
        for entry in entries(table(source, entry.node, &format!("`{}`", entry.key), &expected)?) {
            self.key(source, section, entry)?;
        }
        Ok(())
    }

    fn key(&mut self, source: &Source, section: Section, entry: Entry) -> Result<()> {
        let label = format!("`{}` in [{}]", entry.key, section.name());
        let node = entry.node;
        let span = node.span();
        let file = || {
            let name = string(source, node, &label, "the path of a file, as a string")?;
            Ok::<_, Error>((name.to_owned(), node.span()))
        };
        let mut special = None;
        match (section, entry.key) {
            (Section::Model, "impact_friction") => {
                self.impact_friction = boolean(source, node, &label)?;
                special = Some("impact_friction");
            }
            (Section::Model, "kind") => {
                self.model = choice(source, node, &label, "model", &model::Kind::ALL)?;
                special = Some("kind");
            }
            (Section::Model, "modes") => {
                self.modes = Some(file()?);
                special = Some("modes");
            }
            (Section::Friction, "law") => {
                let laws = LawKind::ALL.map(|kind| (kind.name(), kind));
                self.law = choice(source, node, &label, "law", &laws)?;
                special = Some("law");
            }
            (Section::Friction, "table") => {
                self.table = Some(file()?);
                special = Some("table");
            }
            (Section::Friction, "material") => {
                self.material = Some(file()?);
                special = Some("material");
            }
            (Section::Friction, "outside") => {
                let choices = [("error", Outside::Error), ("clamp", Outside::Clamp)];
                self.outside = choice(source, node, &label, "choice", &choices)?;
                special = Some("outside");
            }
            (Section::Belt, "motion") => {
                self.motion =
                    choice(source, node, &label, "motion", &Motion::NAMES.map(|name| (name, name)))?;
                special = Some("motion");
            }
            (Section::Belt, "motion_table") => {
                self.motion_table = Some(file()?);
                special = Some("motion_table");
            }
            (Section::Start, "kind") => {
                self.start = choice(source, node, &label, "start", &Kind::ALL)?;
                special = Some("kind");
            }
            (Section::Start, "box_samples") => {
                let samples = integer(source, node, &label, SAMPLES_RANGE.0, SAMPLES_RANGE.1)?;
                self.box_samples = u32::try_from(samples).expect("the range of samples fits u32");
                special = Some("box_samples");
            }
            _ => {}
        }
        let name = match (special, Param::from_name(entry.key)) {
            (Some(name), _) => name,
            (None, Some(param)) if param.info().section == section => {
                self.base.set(param, number(source, node, &label, param.info().range)?);
                param.info().name
            }
            _ => return Err(unknown_key(source, entry, section.name(), &names_of(section.name()))),
        };
        self.given.push(Given { name, section, span });
        Ok(())
    }

    /// `[response]`.
    pub(super) fn response(&mut self, source: &Source, entry: Entry) -> Result<()> {
        let expected = "a table, written as a line [response] above its keys";
        self.response_asked.get_or_insert(entry.key_span());
        for entry in entries(table(source, entry.node, "`response`", expected)?) {
            let label = format!("`{}` in [response]", entry.key);
            match entry.key {
                "settle" if is_left_to_the_run(entry.node) => {
                    self.auto = Some(entry.node.span());
                    self.cycle = entry.node.get_ref().as_str() == Some(CYCLE);
                }
                "settle" => self.settle = Some(duration(source, entry.node, &label, true)?),
                "settle_limit" => {
                    let limit = duration(source, entry.node, &label, false)?;
                    self.settle_limit = Some((limit, entry.key_span()));
                }
                "measure" => self.measure = Some(duration(source, entry.node, &label, false)?),
                "check" => self.check = boolean(source, entry.node, &label)?,
                "steps_per_period" => {
                    let steps = integer(source, entry.node, &label, STEPS_RANGE.0, STEPS_RANGE.1)?;
                    self.steps_given = Some(entry.node.span());
                    self.steps_per_period = u32::try_from(steps).expect("the range of steps fits u32");
                }
                _ => return Err(unknown_key(source, entry, "response", &names_of("response"))),
            }
        }
        Ok(())
    }

    /// `[refine]`.
    pub(super) fn refine(&mut self, source: &Source, entry: Entry) -> Result<()> {
        let mut settings = Settings::default();
        let expected = "a table, written as a line [refine] above its keys";
        for entry in entries(table(source, entry.node, "`refine`", expected)?) {
            let label = format!("`{}` in [refine]", entry.key);
            match entry.key {
                "coarse" => settings.coarse = integer(source, entry.node, &label, COARSE.0, COARSE.1)?,
                "sample" => settings.sample = integer(source, entry.node, &label, 0, MOST_SAMPLED)?,
                "seed" => settings.seed = integer(source, entry.node, &label, 0, MOST_SEED)? as u64,
                _ => return Err(unknown_key(source, entry, "refine", &names_of("refine"))),
            }
        }
        self.refine = Some(settings);
        Ok(())
    }
}

/// Refuses a title that a terminal or a page would obey.
pub(super) fn legal_title(source: &Source, span: &Range<usize>, title: &str) -> Result<()> {
    if title.chars().any(is_obeyed) {
        let limit = "one line of text without control characters";
        return Err(out_of_range_at(source, span.clone(), "`title`", limit));
    }
    Ok(())
}

/// Whether the time to settle is left to the run.
fn is_left_to_the_run(node: &Node) -> bool {
    node.get_ref().as_str().is_some_and(|word| [AUTO, CYCLE].contains(&word))
}

/// The error of an unknown key of a section or of the top level (an empty section name).
pub(super) fn unknown_key(source: &Source, entry: Entry, section: &str, known: &[&str]) -> Error {
    let within = if section.is_empty() { "at the top level".to_owned() } else { format!("in [{section}]") };
    let found = home(entry.key).map(|home| format!("it belongs to [{home}]"));
    let of_study = || model::of_study(entry.key).filter(|_| section.is_empty());
    match found.or_else(|| model::no_key(entry.key).or_else(of_study).map(str::to_owned)) {
        Some(advice) => Error::Unknown {
            at: source.place(entry.key_span()),
            what: "key",
            name: entry.key.to_owned(),
            within,
            advice,
        },
        None => unknown(source, entry.key_span(), "key", entry.key, &within, known),
    }
}

/// A law's name as a value of an axis or a column.
pub(super) fn law_value(source: &Source, span: Range<usize>, name: &str, within: &str) -> Result<LawKind> {
    LawKind::from_name(name).ok_or_else(|| unknown(source, span, "law", name, within, &law::names()))
}

/// The section of a top-level key.
pub(super) fn section_of(key: &str) -> Option<Section> {
    [Section::Model, Section::Friction, Section::Belt, Section::Start]
        .into_iter()
        .find(|section| section.name() == key)
}
