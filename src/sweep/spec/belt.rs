//! `[belt]`: what each motion reads.

use crate::model::Param;
use crate::model::friction::LawKind;
use crate::model::motion::Motion;
use crate::sweep::error::{Error, Result};
use crate::sweep::grid::{AxisKey, Grid, Value};
use crate::sweep::spec::check::{Check, covered, unused, used_by_laws};
use crate::sweep::spec::{Spec, law};
use squealmap_input::place::Place;
use squealmap_input::quote::{list, rounded};

/// The parameters of the belt, and the motions that read them.
const READERS: [(Param, &[&str]); 5] = [
    (Param::TemperatureEnd, &["ramp", "sine", "trapeze"]),
    (Param::BeltVelocity, &["ramp", "sine", "trapeze"]),
    (Param::BeltVelocityEnd, &["ramp"]),
    (Param::RampDuration, &["ramp", "sine", "trapeze"]),
    (Param::RiseDuration, &["trapeze"]),
];

/// What reads a parameter that stands where the motion is another; `None` where this one does.
pub(super) fn reader(motion: &str, param: Param) -> Option<String> {
    let (_, motions) = READERS.into_iter().find(|(one, _)| *one == param)?;
    if motions.contains(&motion) {
        return None;
    }
    let motions: Vec<String> = motions.iter().map(|motion| format!("\"{motion}\"")).collect();
    let motions: Vec<&str> = motions.iter().map(String::as_str).collect();
    Some(format!("motion = {} in [belt]", list(&motions)))
}

/// A parameter that a motion needs and does not have, and what needs it.
pub(super) fn lacking(motion: &str, has: impl Fn(Param) -> bool) -> Option<(Param, String)> {
    if has(Param::TemperatureEnd) && !has(Param::RampDuration) {
        let needed_by = format!("`{}` is reached after it", Param::TemperatureEnd.info().name);
        return Some((Param::RampDuration, needed_by));
    }
    let needed = match motion {
        "sine" => &[Param::RampDuration][..],
        "trapeze" => &[Param::RampDuration, Param::RiseDuration],
        _ => &[],
    };
    let needed_by = || format!("motion = \"{motion}\" in [belt] needs it");
    if let Some(param) = needed.iter().find(|param| !has(**param)) {
        return Some((*param, needed_by()));
    }
    let half = half_of_ramp(motion, has);
    half.map(|[given, other]| (other, format!("`{}` describes a ramp", given.info().name)))
}

/// Of the end and the duration of a ramp the one that is given, and the one that is not. A ramp of temperature alone has a
/// duration, too.
fn half_of_ramp(motion: &str, has: impl Fn(Param) -> bool) -> Option<[Param; 2]> {
    if has(Param::TemperatureEnd) && has(Param::RampDuration) {
        return None;
    }
    let pair = [Param::BeltVelocityEnd, Param::RampDuration];
    let half = [pair, [pair[1], pair[0]]].into_iter().find(|[given, other]| has(*given) && !has(*other));
    half.filter(|_| motion == Motion::RAMP)
}

impl Spec {
    /// What reads a parameter that neither the laws of this sweep nor the motion of its belt do, as the end of a sentence.
    #[must_use]
    pub fn unread(&self, param: Param) -> Option<String> {
        if LawKind::params().any(|one| one == param) && !self.laws().iter().any(|law| law.reads(param)) {
            return Some(used_by_laws(&law::users(param)));
        }
        reader(self.motion.name(), param)
    }

    /// The laws that instances have.
    fn laws(&self) -> Vec<LawKind> {
        let Grid::Axes(axes) = &self.grid else { return LawKind::ALL.to_vec() };
        let varied = axes.iter().find(|axis| axis.key == AxisKey::Law);
        let Some(varied) = varied else { return vec![self.law] };
        let named = varied.values.iter().filter_map(|value| match value {
            Value::Text(name) => LawKind::from_name(name),
            Value::Number(_) => None,
        });
        named.collect()
    }
}

impl Check<'_> {
    /// The motion of the belt has all that it reads, and reads all that is given.
    pub(super) fn belt_moves(&self) -> Result<()> {
        let motion = self.sections.motion;
        for (param, _) in READERS {
            if let (Some(by), Some((at, key))) = (reader(motion, param), self.param(param)) {
                return Err(unused(at, key, by));
            }
        }
        if let Some(given) = self.sections.find("motion_table").filter(|_| motion != "table") {
            let at = self.sweep.place(given.span.clone());
            return Err(unused(at, given.label(), "motion = \"table\" in [belt]".to_owned()));
        }
        if motion == "table" && self.files.motion == Motion::Ramp {
            let span = self.sections.find("motion").map_or(0..0, |given| given.span.clone());
            return Err(Error::Missing {
                at: self.sweep.place(span),
                key: "motion_table",
                needed_by: "motion = \"table\" in [belt] is read from a file".to_owned(),
                remedy: "write motion_table = \"stroke.csv\" in [belt]".to_owned(),
            });
        }
        let has = |param| self.param(param).is_some();
        if let Some([given, other]) = half_of_ramp(motion, has)
            && let Some((at, key)) = self.param(given)
        {
            return Err(Error::Missing {
                at,
                key: other.info().name,
                needed_by: format!("{key} describes a ramp"),
                remedy: "give both or none, or with a material `temperature_end` and a duration".to_owned(),
            });
        }
        if let Some((param, needed_by)) = lacking(motion, has) {
            return Err(self.missing(param, needed_by));
        }
        if motion != "table" && self.param(Param::BeltVelocity).is_none() {
            return Err(self.missing(Param::BeltVelocity, "every instance has a belt velocity".to_owned()));
        }
        if motion == "trapeze" { self.trapeze_closes() } else { Ok(()) }
    }

    /// A trapeze comes to rest within its duration, in every instance.
    fn trapeze_closes(&self) -> Result<()> {
        let params = [Param::RiseDuration, Param::RampDuration];
        let Some((at, key)) = self.param(params[0]) else { return Ok(()) };
        let values = |row: &dyn Fn(Param) -> Option<f64>| {
            params.map(|param| row(param).or(self.sections.base.get(param)).unwrap_or_default())
        };
        let pairs: Vec<[f64; 2]> = match &self.varied.grid {
            Grid::Axes(axes) => {
                let extreme = |param: Param, pick: fn(f64, f64) -> f64| {
                    let axis = axes.iter().find(|axis| axis.key == AxisKey::Param(param))?;
                    axis.values.iter().filter_map(Value::number).reduce(pick)
                };
                let longest = extreme(params[0], f64::max);
                let shortest = extreme(params[1], f64::min);
                vec![values(&|param| if param == params[0] { longest } else { shortest })]
            }
            Grid::Tuples { keys, rows } => {
                let column = |param| keys.iter().position(|key| *key == AxisKey::Param(param));
                rows.iter().map(|row| values(&|param| row[column(param)?].number())).collect()
            }
        };
        let Some([rise, duration]) = pairs.into_iter().find(|[rise, duration]| *rise > 0.5 * duration) else {
            return Ok(());
        };
        let limit = format!(
            "at most half of `{}`, {} s: the belt comes to rest as long as it rises",
            params[1].info().name,
            rounded(0.5 * duration)
        );
        Err(Error::OutOfRange { at, key, value: format!("{} s", rounded(rise)), limit })
    }

    /// Temperatures of a motion are those of a material, which has them all, and the only ones.
    pub(super) fn motion_warms(&self) -> Result<()> {
        let Some(corners) = self.files.motion.temperature() else { return Ok(()) };
        let given = ["motion_table", "motion"].into_iter().find_map(|name| self.sections.find(name));
        let at = || self.sweep.place(given.map_or(0..0, |given| given.span.clone()));
        let column = "column `temperature` of `motion_table`";
        if let Some((at, key)) = self.param(Param::Temperature) {
            return Err(Error::Conflict { at, key, other: column.to_owned() });
        }
        if self.files.all_materials().next().is_none() {
            return Err(unused(at(), column.to_owned(), "a `material`".to_owned()));
        }
        for material in self.files.all_materials() {
            for [_, temperature] in corners.iter() {
                covered(Some(material), ("temperature` of `motion_table", &Value::Number(*temperature)), at)?;
            }
        }
        Ok(())
    }

    /// What moves the belt otherwise than steadily, and how messages call it.
    pub(super) fn moving_belt(&self) -> Option<(Place, String)> {
        let motion = self.sections.find("motion").filter(|_| self.sections.motion != Motion::RAMP);
        let motion = motion.map(|given| (self.sweep.place(given.span.clone()), given.label()));
        motion.or_else(|| self.param(Param::RampDuration))
    }
}
