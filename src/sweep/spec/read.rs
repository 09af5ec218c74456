//! From the text of a sweep file to a [`Spec`].

use std::path::Path;
use std::sync::Arc;

use toml::de::DeTable;

use crate::engine::plan::Duration;
use crate::model::Param;
use crate::model::friction::MuTable;
use crate::model::motion::{Motion, MotionTable};
use crate::sweep::error::{Error, Result};
use crate::sweep::grid::AxisKey;
use crate::sweep::spec::check::Check;
use crate::sweep::spec::document::{entries, string};
use crate::sweep::spec::files::Files;
use crate::sweep::spec::keys::top_level;
use crate::sweep::spec::rows::{Role, Rows};
use crate::sweep::spec::sections::{Sections, section_of, unknown_key};
use crate::sweep::spec::varied::Varied;
use crate::sweep::spec::{
    AUTO_MEASURE, Analysis, FIRST_HUNT, FIRST_SETTLE, MAX_SWEEP_BYTES, MEASURE, Pass, SETTLE, SETTLE_LIMIT,
    Spec, Starts,
};
use squealmap_input::files;
use squealmap_input::place::Source;

impl Spec {
    /// Reads and validates a sweep file; files that it names are relative to its directory.
    ///
    /// # Errors
    /// When the file or one that it names cannot be read, or anything in them is not valid.
    pub fn read(path: &Path) -> Result<Spec> {
        let text = files::text(path, MAX_SWEEP_BYTES)
            .map_err(|why| Error::ReadSweep { path: path.to_owned(), why })?;
        Spec::parse(&text, &path.display().to_string(), path.parent().unwrap_or(Path::new("")))
    }

    /// Validates the text of a sweep file; `source_name` begins its error messages and files that it
    /// names are relative to `base_dir`.
    ///
    /// # Errors
    /// As [`Spec::read`].
    pub fn parse(text: &str, source_name: &str, base_dir: &Path) -> Result<Spec> {
        Spec::of_source(&Source::new(source_name, text), base_dir, None)
    }

    /// Validates a sweep whose keys a program has written one a line, such as `axes.mu_s.points = 8`: an error names the line
    /// itself. Files that it names are relative to `base_dir`. `points` are its instances, where it lists them, as the text of
    /// the file that `points` would name.
    ///
    /// # Errors
    /// As [`Spec::read`].
    pub fn of_lines(lines: &str, points: Option<&str>, base_dir: &Path) -> Result<Spec> {
        let points = points.map(|text| Rows::given("points", text, Role::Points)).transpose()?;
        Spec::of_source(&Source::calls(lines), base_dir, points)
    }

    fn of_source(source: &Source, base_dir: &Path, given: Option<Rows>) -> Result<Spec> {
        let document = DeTable::parse(&source.text).map_err(|error| Error::Syntax {
            at: source.place(error.span().unwrap_or(0..0)),
            why: format!("not valid TOML: {}", error.message().trim().replace('\n', ", ")),
        })?;
        let mut sections = Sections::default();
        let mut axes = None;
        let mut points = None;
        for entry in entries(document.get_ref()) {
            match (entry.key, section_of(entry.key)) {
                (_, Some(section)) => sections.section(source, section, entry)?,
                ("title" | "analysis", _) => sections.top_level(source, entry)?,
                ("response", _) => sections.response(source, entry)?,
                ("refine", _) => sections.refine(source, entry)?,
                ("axes", _) => axes = Some(entry),
                ("points", _) => points = Some(entry),
                _ => return Err(unknown_key(source, entry, "", &top_level())),
            }
        }
        let varied = match (axes, points) {
            (Some(axes), None) if given.is_some() => {
                let at = source.place(axes.key_span());
                return Err(Error::Conflict { at, key: "[axes]".to_owned(), other: "`points`".to_owned() });
            }
            (Some(_), Some(points)) => {
                let at = source.place(points.key_span());
                return Err(Error::Conflict { at, key: "`points`".to_owned(), other: "[axes]".to_owned() });
            }
            (Some(axes), None) => Varied::axes(source, axes)?,
            (None, Some(points)) => {
                let name = string(source, points.node, "`points`", "the path of a file, as a string")?;
                Varied::tuples(source, points.node.span(), name, base_dir)?
            }
            (None, None) => given.map_or_else(|| Ok(Varied::nothing(source)), Varied::of_rows)?,
        };
        Spec::of_parts(source, base_dir, sections, varied, (None, None))
    }

    /// What was read, or said in code, as a whole; `numbers` are the friction table and the motion of the belt that were given
    /// with their numbers.
    pub(super) fn of_parts(
        source: &Source,
        base_dir: &Path,
        sections: Sections,
        varied: Varied,
        numbers: (Option<Arc<MuTable>>, Option<Arc<MotionTable>>),
    ) -> Result<Spec> {
        let files = Files::read(source, base_dir, &sections, &varied)?;
        let motion = numbers.1.map_or(files.motion, Motion::Table);
        let files = Files { table: files.table.or(numbers.0), motion, ..files };
        Check { sweep: source, sections: &sections, varied: &varied, files: &files }.all()?;
        let steps_given = sections.steps_given.clone().map(|span| source.place(span));
        Ok(Spec { steps_given, ..assemble(sections, varied, files) })
    }
}

fn assemble(sections: Sections, varied: Varied, files: Files) -> Spec {
    let mut base = sections.base;
    if let Some(modal) = files.modal.as_ref().filter(|_| sections.find("f_ext").is_none()) {
        base.set(Param::FExt, modal.load);
    }
    let response = sections.analysis.response && files.modal.is_none();
    if let Motion::Table(table) = &files.motion {
        base.set(Param::BeltVelocity, table.largest());
        if let Some([_, first]) = table.temperature.as_ref().and_then(|corners| corners.first()) {
            base.set(Param::Temperature, *first);
        }
    }
    let ramp = files.motion != Motion::Ramp
        || sections.base.get(Param::RampDuration).is_some()
        || varied.find(AxisKey::Param(Param::RampDuration)).is_some();
    let auto = sections.auto.is_some();
    let (settle, measure) = match (ramp, auto) {
        (true, _) => (Duration::Seconds(0.0), Duration::Ramp),
        (false, true) if sections.cycle => (FIRST_HUNT, AUTO_MEASURE),
        (false, true) => (FIRST_SETTLE, AUTO_MEASURE),
        (false, false) => (SETTLE, MEASURE),
    };
    let starts = sections.starts();
    let limit = sections.settle_limit.map_or(SETTLE_LIMIT, |(limit, _)| limit);
    Spec {
        title: sections.title,
        analysis: Analysis {
            response,
            until_settled: auto && response,
            finds_cycles: sections.cycle && response,
            checked: sections.check && response,
            starts: if response { starts } else { Starts::One },
            ..sections.analysis
        },
        base,
        modal: files.modal,
        impact_friction: sections.impact_friction,
        law: sections.law,
        material: files.material,
        materials: files.materials,
        table: files.table,
        motion: files.motion,
        grid: varied.grid,
        start: sections.start.transient(),
        pass: Pass::Own,
        settle: sections.settle.unwrap_or(settle),
        settle_limit: auto.then_some(limit),
        measure: sections.measure.unwrap_or(measure),
        steps_per_period: sections.steps_per_period,
        steps_given: None,
        refine: sections.refine,
    }
}
