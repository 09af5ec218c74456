//! What must hold between keys: nothing twice, nothing without effect, nothing missing.

use std::sync::Arc;

use crate::model::friction::LawKind;
use crate::model::material::Material;
use crate::model::{Param, Section};
use crate::sweep::error::{Error, Result};
use crate::sweep::grid::{AxisKey, Grid, Value};
use crate::sweep::spec::duration::{AUTO, CYCLE};
use crate::sweep::spec::files::Files;
use crate::sweep::spec::sections::{Given, Sections};
use crate::sweep::spec::start::{AMPLITUDES, BOUNDS, Kind};
use crate::sweep::spec::varied::Varied;
use crate::sweep::spec::{law, model};
use squealmap_input::place::{Place, Source};
use squealmap_input::quote::{list, quoted};

/// Keys beside parameters that only a motion in time reads.
const OF_MOTION: [&str; 3] = ["impact_friction", "motion", "motion_table"];

/// Everything read, before it is known to fit together.
pub(super) struct Check<'a> {
    pub(super) sweep: &'a Source,
    pub(super) sections: &'a Sections,
    pub(super) varied: &'a Varied,
    pub(super) files: &'a Files,
}

impl Check<'_> {
    /// Runs every check; the first that fails is the error.
    pub(super) fn all(&self) -> Result<()> {
        self.nothing_twice()?;
        self.model_reads_it()?;
        let laws = self.laws();
        self.law_parameters_have_effect(&laws)?;
        self.materials_have_effect(&laws)?;
        self.materials_stand_alone()?;
        self.start_has_effect()?;
        self.belt_moves()?;
        self.motion_warms()?;
        self.settling_has_effect()?;
        self.every_case()
    }

    /// Where a parameter is given, in a section or varied, and how messages call it.
    fn stands(&self, key: AxisKey) -> Option<(Place, String)> {
        if let Some(span) = self.varied.find(key) {
            return Some((self.varied.source.place(span), self.varied.label(key)));
        }
        self.sections.find(key.name()).map(|given| (self.sweep.place(given.span.clone()), given.label()))
    }

    pub(super) fn param(&self, param: Param) -> Option<(Place, String)> {
        self.stands(AxisKey::Param(param))
    }

    /// Every law that some instance has.
    fn laws(&self) -> Vec<LawKind> {
        match self.varied.find(AxisKey::Law) {
            Some(_) => self
                .varied
                .names(AxisKey::Law)
                .iter()
                .filter_map(|(name, _)| LawKind::from_name(name))
                .collect(),
            None => vec![self.sections.law],
        }
    }

    fn nothing_twice(&self) -> Result<()> {
        for (key, span) in &self.varied.keys {
            if let Some(given) = self.sections.find(key.name()) {
                return Err(Error::Conflict {
                    at: self.varied.source.place(span.clone()),
                    key: self.varied.label(*key),
                    other: given.label(),
                });
            }
        }
        Ok(())
    }

    /// The model reads all that is given, and has its file.
    fn model_reads_it(&self) -> Result<()> {
        let model = self.sections.model;
        let varied = self.varied.keys.iter().filter_map(|(key, _)| match key {
            AxisKey::Param(param) => Some(*param),
            AxisKey::Law | AxisKey::Material => None,
        });
        let given = self.sections.given.iter().filter_map(|given| Param::from_name(given.name));
        for param in given.chain(varied) {
            if let (Some(reader), Some((at, key))) = (model.reader(param), self.param(param)) {
                return Err(unused(at, key, reader.written().to_owned()));
            }
        }
        let unread = |given: &Given, reader: model::Kind| {
            Err(unused(self.sweep.place(given.span.clone()), given.label(), reader.written().to_owned()))
        };
        match model {
            model::Kind::TwoMass => match self.sections.find("modes") {
                Some(given) => unread(given, model::Kind::Modal),
                None => Ok(()),
            },
            model::Kind::Modal => {
                if let Some(span) = &self.sections.response_asked {
                    let reader = model::Kind::TwoMass.written();
                    let used_by = format!("{reader}, since a modal model has eigenvalues alone");
                    return Err(unused(self.sweep.place(span.clone()), "a response".to_owned(), used_by));
                }
                let of_motion =
                    |given: &&Given| given.section == Section::Start || OF_MOTION.contains(&given.name);
                if let Some(given) = self.sections.given.iter().find(of_motion) {
                    return unread(given, model::Kind::TwoMass);
                }
                if let Some(modal) = &self.files.modal {
                    let above = Param::DAMPING_RATIOS.into_iter().skip(modal.modes());
                    if let Some((at, key)) = above.into_iter().find_map(|param| self.param(param)) {
                        let modes = modal.modes();
                        return Err(unused(
                            at,
                            key,
                            format!("a file of more modes than {modes}, which `{}` has", modal.name),
                        ));
                    }
                    return match self.param(Param::Kn).filter(|_| modal.contact.is_none()) {
                        Some((at, key)) => {
                            let by = "a file of modes with a range of contact stiffness, which a study writes with kn in [output]";
                            Err(unused(at, key, by.to_owned()))
                        }
                        None => Ok(()),
                    };
                }
                Err(Error::Missing {
                    at: self.sweep.place(self.sections.header(Section::Model)),
                    key: "modes",
                    needed_by: format!("{} is a file of modes", model.written()),
                    remedy: "write modes = \"modes.toml\" in [model]".to_owned(),
                })
            }
        }
    }

    fn law_parameters_have_effect(&self, laws: &[LawKind]) -> Result<()> {
        for param in LawKind::params() {
            if !laws.iter().any(|&kind| kind.reads(param))
                && let Some((at, key)) = self.param(param)
            {
                return Err(unused(at, key, used_by_laws(&law::users(param))));
            }
        }
        if !laws.iter().any(|kind| kind.reads_table())
            && let Some(given) = self.sections.find("table")
        {
            let at = self.sweep.place(given.span.clone());
            return Err(unused(at, given.label(), used_by_laws(&law::of_table())));
        }
        Ok(())
    }

    fn materials_have_effect(&self, laws: &[LawKind]) -> Result<()> {
        if self.files.all_materials().next().is_none() {
            let outside = || {
                let given = self.sections.find("outside")?;
                Some((self.sweep.place(given.span.clone()), given.label()))
            };
            let temperature = Param::TEMPERATURES.into_iter().find_map(|param| self.param(param));
            if let Some((at, key)) = temperature.or_else(outside) {
                return Err(unused(at, key, "a `material`".to_owned()));
            }
        } else if let Some(given) = self.sections.find("table") {
            if let Some(material) = self.files.all_materials().find(|one| one.has_tables()) {
                let at = self.sweep.place(given.span.clone());
                let other = format!("material `{}`, which has tables of its own", quoted(&material.name));
                return Err(Error::Conflict { at, key: given.label(), other });
            }
            if laws.iter().all(|kind| kind.reads_table())
                && let Some((at, key)) = self.stands(AxisKey::Material)
            {
                return Err(unused(at, key, used_by_laws(&law::of_material())));
            }
        }
        Ok(())
    }

    /// A law parameter comes from a material or from the sweep, never from both.
    fn materials_stand_alone(&self) -> Result<()> {
        for param in LawKind::params() {
            let friction = matches!(param, Param::MuS | Param::MuD);
            if let Some(material) = self.files.all_materials().find(|one| friction || one.gives(param))
                && let Some((at, key)) = self.param(param)
            {
                let other = format!("material `{}`, which is to give it", material.name);
                return Err(Error::Conflict { at, key, other });
            }
        }
        Ok(())
    }

    fn start_has_effect(&self) -> Result<()> {
        let by_event = self.param(Param::StartEventFraction).is_some();
        let kind = self.sections.start;
        for param in AMPLITUDES {
            if let (Some((at, key)), Some(user)) = (self.param(param), kind.reader(param, by_event)) {
                return Err(unused(at, key, user.to_owned()));
            }
        }
        if let (Kind::Both | Kind::Box, false) = (kind, self.sections.analysis.response)
            && let Some(given) = self.sections.find_in(Section::Start, "kind")
        {
            let key = format!("`kind = \"{}\"` in [start]", kind.name());
            return Err(unused(
                self.sweep.place(given.span.clone()),
                key,
                "\"response\" in `analysis`".to_owned(),
            ));
        }
        if kind != Kind::Box
            && let Some(given) = self.sections.find("box_samples")
        {
            let at = self.sweep.place(given.span.clone());
            return Err(unused(at, given.label(), "kind = \"box\" in [start]".to_owned()));
        }
        let unbound = BOUNDS.into_iter().find(|bound| kind == Kind::Box && self.param(*bound).is_none());
        unbound.map_or(Ok(()), |bound| {
            Err(self.missing(bound, "kind = \"box\" in [start] draws starts between its bounds".to_owned()))
        })
    }

    /// A run until settled needs a belt that goes on as it is; its limit needs such a run.
    fn settling_has_effect(&self) -> Result<()> {
        let word = if self.sections.cycle { CYCLE } else { AUTO };
        let auto = format!("settle = \"{word}\" in [response]");
        match (&self.sections.auto, &self.sections.settle_limit) {
            (None, Some((_, span))) => {
                let key = "`settle_limit` in [response]".to_owned();
                let needed = format!("settle = \"{AUTO}\" or \"{CYCLE}\" in [response]");
                Err(unused(self.sweep.place(span.clone()), key, needed))
            }
            (Some(span), _) => match self.moving_belt() {
                Some((_, motion)) => Err(Error::Conflict {
                    at: self.sweep.place(span.clone()),
                    key: auto,
                    other: format!("{motion}, during which nothing settles"),
                }),
                None => Ok(()),
            },
            (None, None) => Ok(()),
        }
    }

    pub(super) fn missing(&self, param: Param, needed_by: String) -> Error {
        let section: Section = param.info().section;
        Error::Missing {
            at: self.sweep.place(self.sections.header(section)),
            key: param.info().name,
            needed_by,
            remedy: format!("give it in [{}] or vary it", section.name()),
        }
    }

    fn missing_in_friction(&self, key: &'static str, needed_by: String, remedy: String) -> Error {
        let at = self.sweep.place(self.sections.header(Section::Friction));
        Error::Missing { at, key, needed_by, remedy }
    }

    /// Law, material and temperature of every instance fit together.
    fn every_case(&self) -> Result<()> {
        let position = |key| self.varied.position(key);
        let temperatures = Param::TEMPERATURES.map(|param| (param, position(AxisKey::Param(param))));
        match &self.varied.grid {
            // All combinations occur, so laws, materials and temperatures can be checked by themselves.
            Grid::Axes(axes) => {
                let materials: Vec<Option<&Arc<Material>>> = match position(AxisKey::Material) {
                    Some(_) => self.files.materials.iter().map(Some).collect(),
                    None => vec![self.files.material.as_ref()],
                };
                for material in materials {
                    for kind in self.laws() {
                        self.law_is_complete(kind, material)?;
                    }
                    for (param, axis) in temperatures {
                        let Some(axis) = axis else {
                            self.base_temperature(param, material)?;
                            continue;
                        };
                        for (index, value) in axes[axis].values.iter().enumerate() {
                            let given = (param.info().name, value);
                            covered(material, given, || self.varied.value_place(axis, index))?;
                        }
                    }
                }
            }
            Grid::Tuples { rows, .. } => {
                let (law, material) = (position(AxisKey::Law), position(AxisKey::Material));
                for (index, row) in rows.iter().enumerate() {
                    let material = match material.map(|column| &row[column]) {
                        Some(Value::Text(name)) => self.files.materials.iter().find(|one| one.name == **name),
                        _ => self.files.material.as_ref(),
                    };
                    let kind = match law.map(|column| &row[column]) {
                        Some(Value::Text(name)) => LawKind::from_name(name).unwrap_or(self.sections.law),
                        _ => self.sections.law,
                    };
                    self.law_is_complete(kind, material)?;
                    for (param, column) in temperatures {
                        match column {
                            Some(column) => {
                                let given = (param.info().name, &row[column]);
                                covered(material, given, || self.varied.value_place(column, index))?;
                            }
                            None => self.base_temperature(param, material)?,
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn law_is_complete(&self, kind: LawKind, material: Option<&Arc<Material>>) -> Result<()> {
        let has = |param: Param| {
            self.sections.base.get(param).is_some()
                || self.varied.find(AxisKey::Param(param)).is_some()
                || material.is_some_and(|material| material.gives(param))
        };
        if let Some(param) = law::missing(kind, has) {
            let needed_by = format!("law `{}` needs it", kind.name());
            let Some(material) = material else { return Err(self.missing(param, needed_by)) };
            let name = quoted(&material.name);
            let remedy = if material.has_tables() {
                format!("choose law = \"table\", whose tables material `{name}` has, or another material")
            } else {
                format!("give material `{name}` such a column")
            };
            return Err(self.missing_in_friction(param.info().name, needed_by, remedy));
        }
        let has_table = self.files.table.is_some() || material.is_some_and(|material| material.has_tables());
        if kind.reads_table() && !has_table {
            let needed_by = format!("law `{}` needs it", kind.name());
            return Err(match material {
                None => self.missing_in_friction(
                    "table",
                    needed_by,
                    "write table = \"mu.csv\" in [friction]".to_owned(),
                ),
                Some(material) => {
                    let remedy = format!(
                        "give material `{}` columns `temperature`, `velocity` and `mu` alone, or choose the law of its columns",
                        quoted(&material.name)
                    );
                    self.missing_in_friction("mu", needed_by, remedy)
                }
            });
        }
        Ok(())
    }

    /// A material covers the one temperature of all instances. That of the start has to be there.
    fn base_temperature(&self, param: Param, material: Option<&Arc<Material>>) -> Result<()> {
        let Some(one) = material else { return Ok(()) };
        let Some(temperature) = self.sections.base.get(param) else {
            let needed_by = format!("material `{}` is read at a temperature", one.name);
            let is_start = param == Param::Temperature && self.files.motion.temperature().is_none();
            return if is_start { Err(self.missing(param, needed_by)) } else { Ok(()) };
        };
        let span = self.sections.find(param.info().name).map_or(0..0, |given| given.span.clone());
        covered(material, (param.info().name, &Value::Number(temperature)), || self.sweep.place(span.clone()))
    }
}

/// Refuses a temperature outside a material that is not clamped.
pub(super) fn covered(
    material: Option<&Arc<Material>>,
    (key, temperature): (&'static str, &Value),
    at: impl Fn() -> Place,
) -> Result<()> {
    let (Some(material), &Value::Number(value)) = (material, temperature) else { return Ok(()) };
    if material.covers(value) {
        return Ok(());
    }
    let (low, high) = material.temperatures();
    Err(Error::OutsideMaterial { at: at(), key, value, material: material.name.clone(), low, high })
}

pub(super) fn unused(at: Place, key: String, used_by: String) -> Error {
    Error::Unused { at, key, used_by }
}

pub(super) fn used_by_laws(laws: &[&str]) -> String {
    let noun = if laws.len() == 1 { "law" } else { "laws" };
    format!("the {noun} {}", list(laws))
}
