//! Values by the names of what they belong to.

use std::collections::BTreeMap;

use crate::model::Param;
use crate::sweep::grid::{AxisKey, Value};
use serde_json::Value as Json;

/// Values of axes and parameters by name: numbers, and names of laws and materials.
pub type At = BTreeMap<String, Json>;

/// What a name stands for, and its value.
///
/// # Errors
/// A sentence, for an unknown name or a value outside its range.
pub fn value(name: &str, value: &Json) -> Result<(AxisKey, Value), String> {
    let key = AxisKey::from_name(name).ok_or_else(|| format!("`{name}` is no parameter"))?;
    let value = match (key, value) {
        (AxisKey::Param(param), Json::Number(number)) => {
            Value::Number(allowed(param, number.as_f64().unwrap_or(f64::NAN))?)
        }
        (AxisKey::Law | AxisKey::Material, Json::String(text)) => Value::Text(text.clone().into()),
        (AxisKey::Param(_), other) => return Err(format!("`{name}` is {other}, and has to be a number")),
        (AxisKey::Law | AxisKey::Material, other) => {
            return Err(format!("`{name}` is {other}, and has to be a name"));
        }
    };
    Ok((key, value))
}

/// A value that a parameter may have.
///
/// # Errors
/// A sentence with its limits.
pub fn allowed(param: Param, value: f64) -> Result<f64, String> {
    let info = param.info();
    if info.range.contains(value) {
        Ok(value)
    } else {
        Err(format!("`{}` is {value}, and has to be {}", info.name, info.range))
    }
}
