//! The heading of a figure of one instance: the title of its sweep, and the settings that were asked for, in the paper's
//! symbols.

use serde_json::{Value as Json, json};

use crate::results::figure::panels::setting;
use crate::sweep::grid::{AxisKey, Value};
use squealmap_figure::frame::LABEL_SIZE;
use squealmap_figure::page::{MARGIN, title};
use squealmap_figure::svg::{Anchor, Style, Svg};

/// Between two settings, points.
const GAP: f64 = 9.0;
/// Height of a line of settings, points.
const LINE: f64 = 11.0;

/// Title and settings.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heading {
    /// The title of the sweep; may be empty.
    pub title: String,
    /// The settings that were asked for.
    pub settings: Vec<(AxisKey, Value)>,
}

impl From<&str> for Heading {
    fn from(title: &str) -> Heading {
        Heading { title: title.to_owned(), settings: Vec::new() }
    }
}

impl Heading {
    /// The heading of an instance `at` of a sweep, such as `mu_s=0.4,mu_d=0.3`; names that are no parameters are left out.
    #[must_use]
    pub fn new(title: &str, at: &str) -> Heading {
        let settings = at.split(',').filter_map(|one| {
            let (name, value) = one.split_once('=')?;
            let value = value.trim();
            let value = value.parse().map_or_else(|_| Value::Text(value.to_owned().into()), Value::Number);
            Some((AxisKey::from_name(name.trim())?, value))
        });
        Heading { title: title.to_owned(), settings: settings.collect() }
    }

    /// The entries of a document: `title`, and `at` with names and values in order.
    #[must_use]
    pub fn to_json(&self) -> Json {
        let setting = |(key, value): &(AxisKey, Value)| match value {
            Value::Number(number) => json!([key.name(), number]),
            Value::Text(text) => json!([key.name(), text.as_str()]),
        };
        json!({ "title": self.title, "at": self.settings.iter().map(setting).collect::<Vec<_>>() })
    }

    /// The heading of [`Heading::to_json`]; `None` when it is none.
    #[must_use]
    pub fn from_json(document: &Json) -> Option<Heading> {
        let setting = |pair: &Json| {
            let value = match &pair[1] {
                Json::String(text) => Value::Text(text.clone().into()),
                number => Value::Number(number.as_f64()?),
            };
            Some((AxisKey::from_name(pair[0].as_str()?)?, value))
        };
        let settings = document["at"].as_array().map_or(&[][..], Vec::as_slice).iter().map(setting);
        Some(Heading {
            title: document["title"].as_str()?.to_owned(),
            settings: settings.collect::<Option<_>>()?,
        })
    }

    /// The name of a document with this heading.
    pub(crate) fn name<'a>(&'a self, otherwise: &'a str) -> &'a str {
        if self.title.is_empty() { otherwise } else { &self.title }
    }

    /// Draws it over a width and returns the height it takes.
    pub(crate) fn draw(&self, svg: &mut Svg, width: f64) -> f64 {
        let mut height = title(svg, &self.title, width);
        let mut x = 0.0;
        for (number, (key, value)) in self.settings.iter().enumerate() {
            let text = setting(*key, value);
            let room = text.width(LABEL_SIZE, false);
            if number == 0 || x + room > width {
                height += LINE;
                x = 0.0;
            }
            let base = MARGIN + height - LINE + LABEL_SIZE;
            svg.text(MARGIN + x, base, &text, Style::new(LABEL_SIZE, Anchor::Start));
            x += room + GAP;
        }
        if self.settings.is_empty() { height } else { height + 2.0 }
    }
}
