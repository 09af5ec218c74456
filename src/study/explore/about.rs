//! What varies, what may be varied, which columns there are.

use crate::model::{PARAMS, ParamInfo, Range};
use crate::sweep::columns::{Column, Group, Reading, Window, columns};
use crate::sweep::grid::{Axis, AxisKey, Grid, Value};
use crate::sweep::spec::{Analysis, Starts};
use serde_json::{Value as Json, json};

use crate::study::explore::answer::Answer;
use crate::study::explore::opened::Opened;
use crate::study::explore::region::names;

/// The answer.
#[must_use]
pub fn about(opened: &Opened) -> Answer {
    let spec = &opened.spec;
    let varied = spec.grid.keys();
    let axes: Vec<Json> = opened.axes.iter().map(axis).collect();
    // What has one value, and may have another.
    let has_effect = |row: &&ParamInfo| spec.unread(row.param).is_none();
    let fixed = PARAMS.iter().filter(|row| !varied.contains(&AxisKey::Param(row.param))).filter(has_effect);
    let fixed = fixed.filter_map(|row| {
        let mut about = param(row);
        about["value"] = json!(spec.base.get(row.param)?);
        about["section"] = json!(row.section.name());
        Some(about)
    });
    let fixed: Vec<Json> = fixed.collect();
    let response = spec.modal.is_none();
    let analysis = Analysis {
        linear: true,
        response,
        until_settled: response && spec.settle_limit.is_some(),
        checked: false,
        starts: Starts::One,
        ..spec.analysis
    };
    let all = columns(&Grid::Axes(Vec::new()), analysis);
    let head = json!({
        "title": spec.title,
        "version": env!("CARGO_PKG_VERSION"),
        "axes": axes,
        "fixed": fixed,
        "law": spec.law.name(),
        "responds": response,
        "asks_for_response": spec.analysis.response,
        "until_settled": spec.settle_limit.is_some(),
        "columns": all.iter().filter(|column| column.name != "instance").map(column).collect::<Vec<_>>(),
    });
    Answer::of(head)
}

fn axis(axis: &Axis) -> Json {
    let mut about = match axis.key {
        AxisKey::Param(param) => self::param(param.info()),
        AxisKey::Law | AxisKey::Material => {
            json!({ "key": axis.key.name(), "symbol": axis.key.name(), "unit": "", "meaning": axis.key.name() })
        }
    };
    let value = |value: &Value| match value {
        Value::Number(number) => json!(number),
        Value::Text(text) => json!(text.as_str()),
    };
    about["values"] = axis.values.iter().map(value).collect();
    about["log"] = json!(axis.log);
    about["numbers"] = json!(axis.is_of_numbers());
    about
}

fn param(row: &ParamInfo) -> Json {
    let [least, most] = limits(row.range);
    let open = matches!(row.range, Range::Positive | Range::Open(..));
    json!({
        "key": row.name,
        "symbol": row.symbol,
        "unit": row.unit,
        "meaning": row.meaning,
        "range": row.range.to_string(),
        "least": least,
        "most": most,
        "open": open,
    })
}

/// The ends of a range, which may themselves lie outside; `None` where there is no end.
fn limits(range: Range) -> [Option<f64>; 2] {
    match range {
        Range::Positive | Range::NonNegative => [Some(0.0), None],
        Range::Finite => [None, None],
        Range::Open(low, high) | Range::Closed(low, high) => [Some(low), Some(high)],
    }
}

fn column(column: &Column) -> Json {
    json!({
        "name": column.name,
        "unit": column.unit,
        "meaning": column.meaning,
        "print": column.print[0],
        "signed": column.reading == Reading::Sign,
        "circle": column.unit == "deg" && column.reading == Reading::Linear,
        "response": column.window != Window::Not || !matches!(column.group, Group::Linear | Group::Always),
        "names": names(column),
    })
}
