//! One instance by the values of its parameters: `mu_s=0.4,mu_d=0.3,belt_velocity=3`.

use crate::model::friction::LawKind;
use crate::model::instance::Instance;
use crate::model::{Param, Params};
use crate::sweep::error::{Error, Result};
use crate::sweep::grid::{AxisKey, Grid, Value};
use crate::sweep::spec::belt;
use crate::sweep::spec::check::{covered, unused, used_by_laws};
use crate::sweep::spec::keys::is_fixed;
use crate::sweep::spec::names::advice;
use crate::sweep::spec::start::Kind;
use crate::sweep::spec::{Spec, law, model};
use squealmap_input::place::Place;
use squealmap_input::quote::list;

/// The name of the argument in messages.
const ARGUMENT: &str = "--at";

impl Spec {
    /// The instance at `name=value` pairs separated by commas. Every parameter of a sweep may be named,
    /// also `law` and `material`; what the sweep varies has to be. Values need not be on the grid.
    ///
    /// # Errors
    /// For an unknown or repeated name, a value outside its range, or a swept parameter left open.
    pub fn instance_at(&self, pairs: &str) -> Result<Instance> {
        let mut at = At {
            text: pairs,
            params: self.base,
            law: self.law,
            material: self.material.clone(),
            named: Vec::new(),
        };
        let mut start = 0;
        for part in pairs.split(',') {
            if !part.trim().is_empty() {
                at.pair(self, part.trim(), start)?;
            }
            start += part.len() + 1;
        }
        at.finish(self)
    }

    /// Instance `number` of the sweep, and its values as [`Spec::instance_at`] takes them.
    ///
    /// # Errors
    /// When the sweep has no such instance.
    pub fn numbered(&self, number: usize) -> Result<(Instance, String)> {
        let instances = self.grid.len();
        if number >= instances {
            return Err(Error::NoInstance { number, instances });
        }
        let pair = |(key, value): (AxisKey, &Value)| format!("{}={value}", key.name());
        let pairs: Vec<String> =
            self.grid.keys().into_iter().zip(self.grid.coordinates(number)).map(pair).collect();
        Ok((self.instance(number), pairs.join(",")))
    }
}

/// What the pairs have said so far.
struct At<'a> {
    text: &'a str,
    params: Params,
    law: LawKind,
    material: Option<std::sync::Arc<crate::model::material::Material>>,
    /// What was named, and where.
    named: Vec<(AxisKey, Place)>,
}

impl At<'_> {
    fn place(&self, start: usize, length: usize) -> Place {
        Place::argument(ARGUMENT, self.text, start..start + length)
    }

    fn everything(&self) -> Place {
        self.place(0, self.text.len())
    }

    fn pair(&mut self, spec: &Spec, part: &str, start: usize) -> Result<()> {
        let place = |at: &Self| at.place(start, part.len());
        let syntax =
            |at: &Self, problem| Err(Error::AtSyntax { at: place(at), part: part.to_owned(), problem });
        let Some((name, value)) = part.split_once('=') else {
            return syntax(self, "has no value");
        };
        let (name, value) = (name.trim(), value.trim());
        let unknown = |at: &Self, what, name: &str, candidates: &[&str]| Error::Unknown {
            at: place(at),
            what,
            name: name.to_owned(),
            within: "in the pairs".to_owned(),
            advice: if is_fixed(name) && what == "parameter" {
                "this key holds for the whole sweep and is set in the sweep file".to_owned()
            } else {
                advice(name, candidates)
            },
        };
        let Some(key) = AxisKey::from_name(name) else {
            let names: Vec<&str> = AxisKey::names().collect();
            return Err(unknown(self, "parameter", name, &names));
        };
        if self.names(key) {
            return syntax(self, "names a parameter for the second time");
        }
        let place_of_pair = place(self);
        self.named.push((key, place_of_pair));
        match key {
            AxisKey::Param(param) => {
                let range = param.info().range;
                let number: f64 = value.parse().map_err(|_| Error::WrongType {
                    at: place(self),
                    key: format!("`{name}`"),
                    expected: "a number".to_owned(),
                    found: format!("`{value}`"),
                })?;
                if !range.contains(number) {
                    return Err(Error::OutOfRange {
                        at: place(self),
                        key: format!("`{name}`"),
                        value: value.to_owned(),
                        limit: range.to_string(),
                    });
                }
                self.params.set(param, number);
            }
            AxisKey::Law => {
                self.law =
                    LawKind::from_name(value).ok_or_else(|| unknown(self, "law", value, &law::names()))?;
            }
            AxisKey::Material => {
                let found = spec.material_named(value).cloned();
                let names: Vec<&str> =
                    spec.materials.iter().chain(&spec.material).map(|one| one.name.as_str()).collect();
                self.material = Some(found.ok_or_else(|| unknown(self, "material", value, &names))?);
            }
        }
        Ok(())
    }

    /// Everything that varies is named, and law, material and temperature fit together.
    fn finish(self, spec: &Spec) -> Result<Instance> {
        let open: Vec<AxisKey> = spec.grid.keys().into_iter().filter(|key| !self.names(*key)).collect();
        if !open.is_empty() {
            let names: Vec<String> = open.iter().map(|key| format!("`{}`", key.name())).collect();
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            let example: Vec<String> =
                open.iter().map(|&key| format!("{}={}", key.name(), first_value(&spec.grid, key))).collect();
            let (names, example) = (list(&names), example.join(","));
            return Err(Error::AtMissing { at: self.everything(), names, example });
        }
        self.everything_has_effect(spec)?;
        if let Some((param, needed_by)) =
            belt::lacking(spec.motion.name(), |param| self.params.get(param).is_some())
        {
            return Err(self.missing(param.info().name, needed_by));
        }
        if let Some(material) = &self.material {
            let given =
                LawKind::params().find(|&param| material.gives(param) && self.names(AxisKey::Param(param)));
            if let Some(param) = given {
                let key = format!("`{}`", param.info().name);
                let other = format!("material `{}`, which is to give it", material.name);
                return Err(Error::Conflict { at: self.everything(), key, other });
            }
            let Some(temperature) = self.params.get(Param::Temperature) else {
                let needed_by = format!("material `{}` is read at a temperature", material.name);
                return Err(self.missing("temperature", needed_by));
            };
            for param in Param::TEMPERATURES {
                let value = self.params.get(param).unwrap_or(temperature);
                covered(Some(material), (param.info().name, &Value::Number(value)), || self.everything())?;
            }
        }
        let has = |param| {
            self.params.get(param).is_some()
                || self.material.as_ref().is_some_and(|material| material.gives(param))
        };
        if let Some(param) = law::missing(self.law, has) {
            return Err(self.missing(param.info().name, format!("law `{}` needs it", self.law.name())));
        }
        let of_material = self.material.as_ref().is_some_and(|material| material.has_tables());
        if self.law.reads_table() && spec.table.is_none() && !of_material {
            return Err(Error::Missing {
                at: self.everything(),
                key: "table",
                needed_by: format!("law `{}` needs it", self.law.name()),
                remedy: "name the file in [friction] of the sweep file".to_owned(),
            });
        }
        Ok(spec.assemble(self.params, self.law, self.material.as_ref()))
    }

    /// Refuses what the instance does not read; a parameter that the sweep varies has to be named anyway.
    fn everything_has_effect(&self, spec: &Spec) -> Result<()> {
        let varied = spec.grid.keys();
        let by_event = self.params.get(Param::StartEventFraction).is_some();
        let model = if spec.modal.is_some() { model::Kind::Modal } else { model::Kind::TwoMass };
        for (key, at) in self.named.iter().filter(|(key, _)| !varied.contains(key)) {
            let used_by = match key {
                AxisKey::Param(param) if LawKind::params().any(|one| one == *param) => {
                    (!self.law.reads(*param)).then(|| used_by_laws(&law::users(*param)))
                }
                AxisKey::Param(Param::Temperature) if spec.motion.temperature().is_some() => {
                    Some("a motion without temperatures of its own".to_owned())
                }
                AxisKey::Param(param) if Param::TEMPERATURES.contains(param) && self.material.is_none() => {
                    Some("a `material`".to_owned())
                }
                AxisKey::Param(param) if model.reader(*param).is_some() => {
                    model.reader(*param).map(|reader| reader.written().to_owned())
                }
                AxisKey::Param(param) => {
                    let moves = belt::reader(spec.motion.name(), *param);
                    moves.or_else(|| Kind::of(spec).reader(*param, by_event).map(str::to_owned))
                }
                AxisKey::Material => {
                    let reads = self.material.as_ref().is_some_and(|one| one.has_tables());
                    (self.law.reads_table() && !reads).then(|| used_by_laws(&law::of_material()))
                }
                AxisKey::Law => None,
            };
            if let Some(used_by) = used_by {
                return Err(unused(at.clone(), format!("`{}`", key.name()), used_by));
            }
        }
        Ok(())
    }

    fn names(&self, key: AxisKey) -> bool {
        self.named.iter().any(|(named, _)| *named == key)
    }

    fn missing(&self, key: &'static str, needed_by: String) -> Error {
        Error::Missing { at: self.everything(), key, needed_by, remedy: format!("add {key}=…") }
    }
}

/// The first value that a grid has for one of its keys.
fn first_value(grid: &Grid, key: AxisKey) -> String {
    let at = grid.keys().iter().position(|one| *one == key);
    at.map_or_else(String::new, |at| grid.coordinates(0)[at].to_string())
}
