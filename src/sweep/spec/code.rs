//! From the calls that build a sweep in code to a [`Spec`]: what they say becomes what the reader of sweep files makes of
//! its text, and is checked by the same checks.

use std::fmt::Write as _;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use crate::engine::plan::Duration;
use crate::model::friction::{FrictionLaw, LawKind, MuTable};
use crate::model::motion::{Motion, MotionTable};
use crate::model::{Param, Section};
use crate::sweep::error::{Error, Result};
use crate::sweep::grid::{Axis, AxisKey, Value};
use crate::sweep::spec::axis::{Ends, spaced_axis};
use crate::sweep::spec::call::{Call, Settle, Stands, Start, text};
use crate::sweep::spec::duration::{LONGEST, is_legal};
use crate::sweep::spec::keys::STEPS_RANGE;
use crate::sweep::spec::motion::motion_of;
use crate::sweep::spec::refine::COARSE;
use crate::sweep::spec::rows::{Role, Rows};
use crate::sweep::spec::sections::{Given, MOST_SAMPLED, MOST_SEED, Sections, legal_title};
use crate::sweep::spec::start::{Kind, SAMPLES_RANGE};
use crate::sweep::spec::tables::table_of;
use crate::sweep::spec::varied::Varied;
use crate::sweep::spec::{MAX_VALUES, Spec, model};
use squealmap_input::place::Source;

impl Spec {
    /// The sweep that these calls build; files that they name are relative to `base_dir`.
    ///
    /// # Errors
    /// As [`Spec::parse`]; a place is the call.
    pub(crate) fn of_calls(calls: &[Call], base_dir: &Path) -> Result<Spec> {
        let (source, stands) = text(calls);
        let mut code = Code {
            base_dir,
            varied: Varied::nothing(&source),
            sections: Sections::default(),
            table: None,
            motion: None,
            source: &source,
        };
        // What varies first: a law brings numbers for all of its parameters, and an axis overrides them.
        for (call, stands) in calls.iter().zip(&stands) {
            code.varies(call, stands)?;
        }
        for (call, stands) in calls.iter().zip(&stands) {
            code.says(call, stands)?;
        }
        let Code { sections, varied, table, motion, .. } = code;
        Spec::of_parts(&source, base_dir, sections, varied, (table, motion))
    }
}

/// What the calls have said so far.
struct Code<'a> {
    source: &'a Source,
    base_dir: &'a Path,
    sections: Sections,
    varied: Varied,
    /// The friction table that was given with its numbers.
    table: Option<Arc<MuTable>>,
    /// The motion that was given with its corners.
    motion: Option<Arc<MotionTable>>,
}

impl Code<'_> {
    /// A call of what varies.
    fn varies(&mut self, call: &Call, stands: &Stands) -> Result<()> {
        let is_tuples = |call: &Call| matches!(call, Call::Points(..) | Call::PointsFile(_));
        let is_axis = |call: &Call| matches!(call, Call::Axis(..) | Call::Values(..));
        if (is_tuples(call) || is_axis(call)) && self.varied.is_tuples()
            || is_tuples(call) && !self.varied.keys.is_empty()
        {
            let at = self.source.place(stands.whole.clone());
            return Err(Error::Conflict { at, key: "`points`".to_owned(), other: "[axes]".to_owned() });
        }
        match call {
            Call::Axis(param, ends, points, log) => self.axis(*param, *ends, *points, *log, stands),
            Call::Values(key, values) => self.values(*key, values, stands),
            Call::Points(params, rows) => {
                let mut text = joined(params.iter().map(|param| param.info().name.to_owned()));
                for row in rows {
                    text.push_str(&joined(row.iter().map(f64::to_string)));
                }
                self.varied = Varied::of_rows(Rows::given(".points(…)", &text, Role::Points)?)?;
                Ok(())
            }
            Call::PointsFile(file) => {
                let (file, span) = (file.to_string_lossy(), stands.whole.clone());
                self.varied = Varied::tuples(self.source, span, &file, self.base_dir)?;
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn axis(
        &mut self,
        param: Param,
        [from, to]: [f64; 2],
        points: usize,
        log: bool,
        stands: &Stands,
    ) -> Result<()> {
        let name = param.info().name;
        let [_, from_at, to_at, points_at] = stands.arguments.as_slice() else { return Ok(()) };
        self.number(param, from, from_at, format!("`from` of axis `{name}`"))?;
        self.number(param, to, to_at, format!("`to` of axis `{name}`"))?;
        self.whole(points_at, format!("`points` of axis `{name}`"), points, (1, MAX_VALUES))?;
        let ends =
            Ends { from, to, points, log, whole: stands.whole.clone(), at: [from_at.clone(), to_at.clone()] };
        let source = self.source;
        self.varied.add(source, AxisKey::Param(param), &stands.whole, &stands.whole, |admit| {
            spaced_axis(source, param, &ends, admit)
        })
    }

    fn values(&mut self, key: AxisKey, values: &[Value], stands: &Stands) -> Result<()> {
        let name = key.name();
        if values.is_empty() {
            let at = self.source.place(stands.whole.clone());
            return Err(Error::Empty { at, what: format!("axis `{name}`"), least: "one value" });
        }
        if let AxisKey::Param(param) = key {
            for (index, value) in values.iter().enumerate() {
                let Value::Number(value) = value else { continue };
                self.number(param, *value, &stands.whole, format!("value {} of axis `{name}`", index + 1))?;
            }
        }
        self.varied.add(self.source, key, &stands.whole, &stands.whole, |admit| {
            admit(values.len())?;
            let axis = Axis { key, values: values.to_vec(), log: false };
            Ok((axis, vec![stands.whole.clone()]))
        })
    }

    /// A call of what does not vary.
    fn says(&mut self, call: &Call, stands: &Stands) -> Result<()> {
        let whole = &stands.whole;
        if matches!(call, Call::Response(_) | Call::Measure(_) | Call::StepsPerPeriod(_) | Call::Check(_)) {
            self.sections.response_asked = Some(whole.clone());
        }
        let file = |file: &Path| (file.to_string_lossy().into_owned(), whole.clone());
        match call {
            Call::Title(title) => {
                legal_title(self.source, stands.arguments.first().unwrap_or(whole), title)?;
                title.clone_into(&mut self.sections.title);
            }
            Call::WithoutEigenvalues | Call::WithoutResponse => self.without(call, whole)?,
            Call::ImpactFriction(acts) => {
                self.sections.impact_friction = *acts;
                self.give("impact_friction", Section::Model, whole);
            }
            Call::Modes(path) => {
                self.sections.model = model::Kind::Modal;
                self.sections.modes = Some(file(path));
                self.give("modes", Section::Model, whole);
            }
            Call::Set(param, value) => {
                let section = param.info().section;
                let label = format!("`{}` in [{}]", param.info().name, section.name());
                self.number(*param, *value, stands.arguments.last().unwrap_or(whole), label)?;
                self.sections.base.set(*param, *value);
                self.give(param.info().name, section, whole);
            }
            Call::Friction(law) => self.friction(law, whole)?,
            Call::Law(kind) => {
                self.sections.law = *kind;
                self.give("law", Section::Friction, whole);
            }
            Call::FrictionTable(path) => {
                self.sections.law = LawKind::Table;
                (self.sections.table, self.table) = (Some(file(path)), None);
                self.give("law", Section::Friction, whole);
                self.give("table", Section::Friction, whole);
            }
            Call::Material(path) => {
                self.sections.material = Some(file(path));
                self.give("material", Section::Friction, whole);
            }
            Call::Motion(motion) => self.motion(motion, whole)?,
            Call::Outside(outside) => {
                self.sections.outside = *outside;
                self.give("outside", Section::Friction, whole);
            }
            Call::Start(start) => self.start(*start, whole)?,
            Call::Response(settle) => self.settle(*settle, whole)?,
            Call::Measure(duration) => {
                self.duration("measure", *duration, false, whole)?;
                self.sections.measure = Some(*duration);
            }
            Call::StepsPerPeriod(steps) => {
                self.whole(
                    whole,
                    "`steps_per_period` in [response]".to_owned(),
                    *steps as usize,
                    STEPS_RANGE,
                )?;
                self.sections.steps_per_period = *steps;
                self.sections.steps_given = Some(whole.clone());
            }
            Call::Check(check) => self.sections.check = *check,
            Call::Refine(settings) => {
                let label = |key: &str| format!("`{key}` in [refine]");
                self.whole(whole, label("coarse"), settings.coarse, COARSE)?;
                self.whole(whole, label("sample"), settings.sample, (0, MOST_SAMPLED))?;
                let seed = usize::try_from(settings.seed).unwrap_or(usize::MAX);
                self.whole(whole, label("seed"), seed, (0, MOST_SEED))?;
                self.sections.refine = Some(*settings);
            }
            Call::Axis(..) | Call::Values(..) | Call::Points(..) | Call::PointsFile(_) => {}
        }
        Ok(())
    }

    fn without(&mut self, call: &Call, whole: &Range<usize>) -> Result<()> {
        let analysis = &mut self.sections.analysis;
        match call {
            Call::WithoutResponse => analysis.response = false,
            _ => analysis.linear = false,
        }
        if analysis.linear || analysis.response {
            return Ok(());
        }
        let at = self.source.place(whole.clone());
        Err(Error::Empty { at, what: "`analysis`".to_owned(), least: "\"linear\" or \"response\"" })
    }

    /// A law with its parameters, but for those that vary.
    fn friction(&mut self, friction: &FrictionLaw, whole: &Range<usize>) -> Result<()> {
        self.sections.law = friction.kind();
        self.give("law", Section::Friction, whole);
        for (param, value) in friction.parts() {
            let name = param.info().name;
            self.number(param, value, whole, format!("`{name}` in [friction]"))?;
            if self.varied.find(AxisKey::Param(param)).is_none() {
                self.sections.base.set(param, value);
                self.give(name, Section::Friction, whole);
            }
        }
        if let FrictionLaw::Table(table) = friction {
            let mut text = "velocity,mu\n".to_owned();
            for row in 0..table.velocity.len().max(table.mu.len()) {
                let cell = |values: &[f64]| values.get(row).map(f64::to_string).unwrap_or_default();
                // A string takes whatever is written to it.
                let _ = writeln!(text, "{},{}", cell(&table.velocity), cell(&table.mu));
            }
            self.table = Some(table_of(&Rows::given(".friction(Table(…))", &text, Role::Table)?)?);
            self.sections.table = None;
            self.give("table", Section::Friction, whole);
        }
        Ok(())
    }

    /// How the belt moves; the corners of a table are checked as those of a file.
    fn motion(&mut self, motion: &Motion, whole: &Range<usize>) -> Result<()> {
        self.sections.motion = motion.name();
        self.give("motion", Section::Belt, whole);
        if let Motion::Table(table) = motion {
            let mut text =
                if table.temperature.is_some() { "time,velocity,temperature\n" } else { "time,velocity\n" }
                    .to_owned();
            for (row, [time, velocity]) in table.corners.iter().enumerate() {
                // A string takes whatever is written to it.
                let _ = write!(text, "{time},{velocity}");
                if let Some(corners) = &table.temperature {
                    let _ = write!(
                        text,
                        ",{}",
                        corners.get(row).map(|corner| corner[1].to_string()).unwrap_or_default()
                    );
                }
                text.push('\n');
            }
            let rows = Rows::given(".motion(Motion::Table(…))", &text, Role::Motion)?;
            self.motion = Some(motion_of(&table.name, &rows)?);
        }
        Ok(())
    }

    fn start(&mut self, start: Start, whole: &Range<usize>) -> Result<()> {
        self.sections.start = match start {
            Start::Kick => Kind::Kick,
            Start::Mode => Kind::Mode,
            Start::Both => Kind::Both,
            Start::Box { samples } => {
                self.whole(whole, "`box_samples` in [start]".to_owned(), samples as usize, SAMPLES_RANGE)?;
                self.sections.box_samples = samples;
                Kind::Box
            }
        };
        self.give("kind", Section::Start, whole);
        Ok(())
    }

    fn settle(&mut self, settle: Settle, whole: &Range<usize>) -> Result<()> {
        let sections = &mut self.sections;
        (sections.auto, sections.settle, sections.settle_limit) = (None, None, None);
        sections.cycle = matches!(settle, Settle::Cycle);
        match settle {
            Settle::Auto | Settle::Cycle => sections.auto = Some(whole.clone()),
            Settle::AutoWithin(limit) => {
                sections.auto = Some(whole.clone());
                sections.settle_limit = Some((limit, whole.clone()));
                self.duration("settle_limit", limit, false, whole)?;
            }
            Settle::After(duration) => {
                sections.settle = Some(duration);
                self.duration("settle", duration, true, whole)?;
            }
        }
        Ok(())
    }

    /// Says that a key is given; the last call counts.
    fn give(&mut self, name: &'static str, section: Section, span: &Range<usize>) {
        self.sections.given.retain(|given| given.name != name);
        self.sections.given.push(Given { name, section, span: span.clone() });
    }

    /// Refuses a number outside the range of its parameter.
    fn number(&self, param: Param, value: f64, at: &Range<usize>, key: String) -> Result<()> {
        let range = param.info().range;
        if range.contains(value) {
            Ok(())
        } else {
            Err(self.outside(at, key, value.to_string(), range.to_string()))
        }
    }

    /// Refuses a number that is not between two others.
    fn whole(&self, at: &Range<usize>, key: String, value: usize, (low, high): (usize, usize)) -> Result<()> {
        if (low..=high).contains(&value) {
            return Ok(());
        }
        Err(self.outside(at, key, value.to_string(), format!("an integer between {low} and {high}")))
    }

    /// Refuses a time that is too long, or none; only that of `settle` may be 0.
    fn duration(&self, key: &str, duration: Duration, settle: bool, at: &Range<usize>) -> Result<()> {
        let is_legal = match duration {
            Duration::Seconds(count) | Duration::Periods(count) => is_legal(count, settle),
            Duration::Ramp => false,
        };
        if is_legal {
            return Ok(());
        }
        let bound = if settle { "not below 0" } else { "greater than 0" };
        let limit = format!("seconds or periods, {bound} and at most {LONGEST:e}");
        Err(self.outside(at, format!("`{key}` in [response]"), duration.to_string(), limit))
    }

    fn outside(&self, at: &Range<usize>, key: String, value: String, limit: String) -> Error {
        Error::OutOfRange { at: self.source.place(at.clone()), key, value, limit }
    }
}

/// One line of a table.
fn joined(fields: impl Iterator<Item = String>) -> String {
    let mut line = fields.collect::<Vec<_>>().join(",");
    line.push('\n');
    line
}
