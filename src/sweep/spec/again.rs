//! A sweep from its resolved form, so that a directory can be completed without its sweep file.

use std::sync::Arc;

use serde_json::Value as Json;

use crate::engine::plan::Duration;
use crate::model::friction::{LawKind, MuTable};
use crate::model::material::{Material, Outside};
use crate::model::modal::Modal;
use crate::model::motion::{Motion, MotionTable};
use crate::model::{Param, Params};
use crate::sweep::grid::Grid;
use crate::sweep::spec::duration::{AUTO, CYCLE};
use crate::sweep::spec::model::of_text;
use crate::sweep::spec::start::Kind;
use crate::sweep::spec::{Analysis, FIRST_HUNT, FIRST_SETTLE, Pass, Spec};

impl Spec {
    /// The sweep whose [`Spec::resolved`] form this is; `None` where an entry is none that [`Spec::resolved`] writes.
    /// Whether the two sweeps give the same results is told by their identities.
    pub(crate) fn from_resolved(
        resolved: &Json,
        title: &str,
        analysis: Analysis,
        grid: Grid,
    ) -> Option<Spec> {
        let mut base = Params::default();
        for section in ["model", "friction", "belt", "start"] {
            for (name, value) in resolved.get(section)?.as_object()? {
                if let (Some(param), Some(value)) = (Param::from_name(name), value.as_f64()) {
                    base.set(param, value);
                }
            }
        }
        let friction = &resolved["friction"];
        let law =
            friction.get("law").map_or(Some(LawKind::Bilinear), |name| LawKind::from_name(name.as_str()?))?;
        let materials = match friction.get("materials") {
            None => Vec::new(),
            Some(all) => all.as_array()?.iter().map(material).collect::<Option<_>>()?,
        };
        let response = resolved.get("response")?;
        let duration = |key: &str| Duration::from_words(response.get(key)?.as_str()?);
        let (settle, settle_limit) = match response.get("settle")?.as_str()? {
            CYCLE => (FIRST_HUNT, Some(duration("settle_limit")?)),
            AUTO => (FIRST_SETTLE, Some(duration("settle_limit")?)),
            _ => (duration("settle")?, None),
        };
        let kind = resolved["start"]["kind"].as_str()?;
        let (_, kind) = Kind::ALL.into_iter().find(|(name, _)| *name == kind)?;
        Some(Spec {
            title: title.to_owned(),
            analysis,
            base,
            modal: match resolved["model"].get("content") {
                None => None,
                Some(text) => Some(modal(&resolved["model"], text)?),
            },
            impact_friction: resolved["model"].get("impact_friction").is_none_or(|acts| acts == true),
            law,
            material: match friction.get("material") {
                None => None,
                Some(rows) => Some(material(rows)?),
            },
            materials,
            table: match friction.get("table") {
                None => None,
                Some(rows) => Some(table(rows)?),
            },
            motion: motion(resolved.get("belt")?)?,
            grid,
            start: kind.transient(),
            pass: Pass::Own,
            settle,
            settle_limit,
            measure: duration("measure")?,
            steps_per_period: u32::try_from(response.get("steps_per_period")?.as_u64()?).ok()?,
            steps_given: None,
            refine: None,
        })
    }
}

fn numbers(values: &Json) -> Option<Vec<f64>> {
    values.as_array()?.iter().map(Json::as_f64).collect()
}

fn table(table: &Json) -> Option<Arc<MuTable>> {
    Some(Arc::new(MuTable { velocity: numbers(table.get("velocity")?)?, mu: numbers(table.get("mu")?)? }))
}

fn motion(belt: &Json) -> Option<Motion> {
    let Some(name) = belt.get("motion") else { return Some(Motion::Ramp) };
    let table = match belt.get("motion_table") {
        None => None,
        Some(table) => {
            let time = numbers(table.get("time")?)?;
            let corners =
                |values: Vec<f64>| time.iter().zip(values).map(|(time, value)| [*time, value]).collect();
            let temperature = match table.get("temperature") {
                None => None,
                Some(values) => Some(corners(numbers(values)?)),
            };
            let name = table.get("name")?.as_str()?.to_owned();
            let corners = corners(numbers(table.get("velocity")?)?);
            Some(Arc::new(MotionTable { name, corners, temperature }))
        }
    };
    let name = Motion::NAMES.into_iter().find(|one| Some(*one) == name.as_str())?;
    Some(Motion::named(name, table))
}

/// The structure whose file holds this text.
fn modal(model: &Json, text: &Json) -> Option<Arc<Modal>> {
    Some(Arc::new(of_text(model.get("modes")?.as_str()?, text.as_str()?).ok()?))
}

fn material(rows: &Json) -> Option<Arc<Material>> {
    let rows = rows.as_object()?;
    let mut columns = Vec::new();
    for (name, values) in rows {
        if let Some(param) = Param::from_name(name).filter(|_| name != "temperature") {
            columns.push((param, numbers(values)?));
        }
    }
    Some(Arc::new(Material {
        name: rows.get("name")?.as_str()?.to_owned(),
        temperature: numbers(rows.get("temperature")?)?,
        columns,
        tables: match rows.get("tables") {
            None => Vec::new(),
            Some(all) => all.as_array()?.iter().map(table).collect::<Option<_>>()?,
        },
        outside: match rows.get("outside")?.as_str()? {
            "error" => Outside::Error,
            "clamp" => Outside::Clamp,
            _ => return None,
        },
    }))
}
