//! The heading of a figure of one instance: the title of its sweep, and the settings that were asked for, in the paper's
//! symbols.

use serde::{Deserialize, Serialize};

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
///
/// In a document `title`, and `at` with names and values in order.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(try_from = "Entries", into = "Entries")]
pub struct Heading {
    /// The title of the sweep; may be empty.
    pub title: String,
    /// The settings that were asked for.
    pub settings: Vec<(AxisKey, Value)>,
}

/// A heading as it stands in a document.
#[derive(Deserialize, Serialize)]
struct Entries {
    title: String,
    #[serde(default)]
    at: Vec<(String, Entry)>,
}

/// A value as it stands in a document.
#[derive(Deserialize, Serialize)]
#[serde(untagged)]
enum Entry {
    Number(f64),
    Text(String),
}

impl From<Heading> for Entries {
    fn from(heading: Heading) -> Entries {
        let setting = |(key, value): (AxisKey, Value)| match value {
            Value::Number(number) => (key.name().to_owned(), Entry::Number(number)),
            Value::Text(text) => (key.name().to_owned(), Entry::Text(text.to_string())),
        };
        Entries { title: heading.title, at: heading.settings.into_iter().map(setting).collect() }
    }
}

impl TryFrom<Entries> for Heading {
    type Error = String;

    fn try_from(entries: Entries) -> Result<Heading, String> {
        let setting = |(name, value): (String, Entry)| {
            let key = AxisKey::from_name(&name).ok_or_else(|| format!("`{name}` is no parameter"))?;
            Ok(match value {
                Entry::Number(number) => (key, Value::Number(number)),
                Entry::Text(text) => (key, Value::Text(text.into())),
            })
        };
        let settings = entries.at.into_iter().map(setting).collect::<Result<_, String>>()?;
        Ok(Heading { title: entries.title, settings })
    }
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
