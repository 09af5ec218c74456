//! The sweep of a region as a sweep file, and the command that computes it.

use crate::engine::plan::Duration;
use crate::model::Param;
use serde_json::{Value as Json, json};

use crate::study::explore::answer::Answer;
use crate::study::explore::opened::Opened;
use crate::study::explore::region::Region;

/// What the resolved form of a sweep has from other files.
const IN_FILES: [(&str, &str); 5] = [
    ("friction", "material"),
    ("friction", "materials"),
    ("friction", "table"),
    ("belt", "motion_table"),
    ("model", "content"),
];

/// The answer: `toml`, the text of a sweep file that `squealmap run` takes.
///
/// # Errors
/// A sentence that names what is wrong, or which part of the sweep stands in a file of its own.
pub fn file(opened: &Opened, region: &Region) -> Result<Answer, String> {
    let spec = region.spec(opened)?;
    let mut resolved = spec.resolved();
    for (section, key) in IN_FILES {
        if resolved[section].get(key).is_some() {
            return Err(format!(
                "`{key}` of [{section}] stands in a file of its own; take that sweep and change its axes"
            ));
        }
    }
    // Sides as ranges where they are; what has one value stands in its section.
    let sides = [&region.y, &region.x].map(|side| {
        let mut axis = if side.values.is_empty() {
            json!({ "from": side.from, "to": side.to, "points": side.points })
        } else {
            json!({ "values": side.values })
        };
        if side.log {
            axis["scale"] = json!("log");
        }
        (side.key.clone(), axis)
    });
    let others: Vec<(String, Json)> =
        region.at.iter().map(|(name, value)| (name.clone(), json!({ "values": [value] }))).collect();
    resolved["axes"] = Json::Object(others.into_iter().chain(sides).collect());
    // What no law reads has no place in a file.
    if let Some(friction) = resolved["friction"].as_object_mut() {
        let is_read = |name: &str| Param::from_name(name).is_none_or(|param| spec.unread(param).is_none());
        friction.retain(|name, _| is_read(name));
    }
    // What is measured as a whole is not said in a sweep file, as it is the default there.
    if spec.measure == Duration::Ramp
        && let Some(response) = resolved["response"].as_object_mut()
    {
        response.remove("measure");
    }
    if !spec.analysis.response {
        let sections = resolved.as_object_mut().ok_or("a sweep has sections")?;
        sections.remove("response");
        sections.remove("start");
    }
    if resolved["title"] == "" {
        resolved.as_object_mut().ok_or("a sweep has sections")?.remove("title");
    }
    Ok(Answer::of(json!({ "toml": toml::to_string(&resolved).map_err(|why| why.to_string())? })))
}
