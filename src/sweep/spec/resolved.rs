//! A sweep as resolved: every default written out, every file's content in place, for the manifest.

use serde_json::{Map, Value as Json, json};

use crate::model::friction::MuTable;
use crate::model::material::{Material, Outside};
use crate::model::motion::Motion;
use crate::model::{PARAMS, Section};
use crate::sweep::grid::{AxisKey, Grid, Value};
use crate::sweep::spec::duration::{AUTO, CYCLE};
use crate::sweep::spec::start::{AMPLITUDES, Kind};
use crate::sweep::spec::{Spec, Starts, model};

impl Spec {
    /// The sweep with the section names of a sweep file and all defaults written out.
    ///
    /// Parameters that vary stand in `axes` (or `points`) only; materials and tables stand with their rows.
    #[must_use]
    pub fn resolved(&self) -> Json {
        let mut analysis = Vec::new();
        if self.analysis.linear {
            analysis.push("linear");
        }
        if self.analysis.response {
            analysis.push("response");
        }
        let mut spec = Map::new();
        spec.insert("title".to_owned(), json!(self.title));
        spec.insert("analysis".to_owned(), json!(analysis));
        let model = self.model();
        spec.insert("model".to_owned(), Json::Object(model));
        spec.insert("friction".to_owned(), self.friction());
        spec.insert("belt".to_owned(), Json::Object(self.belt()));
        let (key, grid) = resolved_grid(&self.grid);
        spec.insert(key.to_owned(), grid);
        let mut start = self.section(Section::Start);
        let kind = Kind::of(self);
        let by_event = start.contains_key("start_event_fraction");
        for param in AMPLITUDES.into_iter().filter(|param| kind.reader(*param, by_event).is_some()) {
            start.remove(param.info().name);
        }
        start.insert("kind".to_owned(), json!(kind.name()));
        if let Starts::Box(samples) = self.analysis.starts {
            start.insert("box_samples".to_owned(), json!(samples));
        }
        spec.insert("start".to_owned(), Json::Object(start));
        spec.insert("response".to_owned(), self.response());
        Json::Object(spec)
    }

    /// The model; of a modal one with what stands in its file, so that it can be computed without that.
    fn model(&self) -> Map<String, Json> {
        let mut model = Map::new();
        match &self.modal {
            None => {
                model = self.section(Section::Model);
                model.insert("impact_friction".to_owned(), json!(self.impact_friction));
            }
            Some(modal) => {
                model.insert("kind".to_owned(), json!("modal"));
                model.insert("modes".to_owned(), json!(modal.name));
                model.insert(
                    "blake3".to_owned(),
                    json!(blake3::hash(modal.text.as_bytes()).to_hex().as_str()),
                );
                model.extend(self.section(Section::Model));
                model.insert("content".to_owned(), json!(modal.text));
            }
        }
        model
    }

    /// The belt; that of a steady one or a ramp has no name, as before there were others.
    fn belt(&self) -> Map<String, Json> {
        let mut belt = self.section(Section::Belt);
        if self.motion != Motion::Ramp {
            belt.insert("motion".to_owned(), json!(self.motion.name()));
        }
        if let Motion::Table(table) = &self.motion {
            let column = |at: usize| table.corners.iter().map(|corner| corner[at]).collect::<Vec<_>>();
            let mut rows = json!({ "name": table.name, "time": column(0), "velocity": column(1) });
            if let Some(corners) = &table.temperature {
                rows["temperature"] = json!(corners.iter().map(|corner| corner[1]).collect::<Vec<_>>());
            }
            belt.insert("motion_table".to_owned(), rows);
        }
        belt
    }

    fn response(&self) -> Json {
        let measure = self.measure.to_string();
        match self.settle_limit {
            None => json!({
                "settle": self.settle.to_string(),
                "measure": measure,
                "steps_per_period": self.steps_per_period,
                "check": self.analysis.checked,
            }),
            Some(limit) => json!({
                "settle": if self.analysis.finds_cycles { CYCLE } else { AUTO },
                "settle_limit": limit.to_string(),
                "measure": measure,
                "steps_per_period": self.steps_per_period,
                "check": self.analysis.checked,
            }),
        }
    }

    /// The values of a section that do not vary.
    fn section(&self, section: Section) -> Map<String, Json> {
        let keys = self.grid.keys();
        let kind = if self.modal.is_some() { model::Kind::Modal } else { model::Kind::TwoMass };
        PARAMS
            .iter()
            .filter(|row| row.section == section && !keys.contains(&AxisKey::Param(row.param)))
            .filter(|row| section == Section::Start || kind.reader(row.param).is_none())
            .filter_map(|row| Some((row.name.to_owned(), json!(self.base.get(row.param)?))))
            .collect()
    }

    fn friction(&self) -> Json {
        let keys = self.grid.keys();
        let mut friction = Map::new();
        if !keys.contains(&AxisKey::Law) {
            friction.insert("law".to_owned(), json!(self.law.name()));
        }
        for (name, value) in self.section(Section::Friction) {
            friction.insert(name, value);
        }
        if let Some(material) = &self.material {
            friction.insert("material".to_owned(), rows(material));
        }
        if !self.materials.is_empty() {
            let materials: Vec<Json> = self.materials.iter().map(|material| rows(material)).collect();
            friction.insert("materials".to_owned(), json!(materials));
        }
        if let Some(table) = &self.table {
            friction.insert("table".to_owned(), self::table(table));
        }
        Json::Object(friction)
    }
}

/// What varies, and the key it stands under: the values of `axes`, or the columns of `points`.
#[must_use]
pub(crate) fn resolved_grid(grid: &Grid) -> (&'static str, Json) {
    match grid {
        Grid::Axes(axes) => {
            let axes: Map<String, Json> = axes
                .iter()
                .map(|axis| {
                    let values: Vec<Json> = axis.values.iter().map(value).collect();
                    let scale = if axis.log { "log" } else { "linear" };
                    (axis.key.name().to_owned(), json!({ "values": values, "scale": scale }))
                })
                .collect();
            ("axes", Json::Object(axes))
        }
        Grid::Tuples { keys, rows } => {
            let columns: Vec<&str> = keys.iter().map(|key| key.name()).collect();
            ("points", json!({ "columns": columns, "rows": rows.len() }))
        }
    }
}

fn value(value: &Value) -> Json {
    match value {
        Value::Number(number) => json!(number),
        Value::Text(text) => json!(text.as_str()),
    }
}

fn table(table: &MuTable) -> Json {
    json!({ "velocity": table.velocity, "mu": table.mu })
}

fn rows(material: &Material) -> Json {
    let mut rows = Map::new();
    rows.insert("name".to_owned(), json!(material.name));
    let outside = match material.outside {
        Outside::Error => "error",
        Outside::Clamp => "clamp",
    };
    rows.insert("outside".to_owned(), json!(outside));
    rows.insert("temperature".to_owned(), json!(material.temperature));
    for (param, values) in &material.columns {
        rows.insert(param.info().name.to_owned(), json!(values));
    }
    if material.has_tables() {
        rows.insert("tables".to_owned(), material.tables.iter().map(|one| table(one)).collect());
    }
    Json::Object(rows)
}
