//! The numbers that a block shows: their values at the places of its panels, their scale, their colours, and their words.

use crate::engine::record::Basin;
use crate::results::figure::look::Content;
use crate::results::figure::panels::Panels;
use crate::results::figure::tones::Tones;
use crate::results::figure::words;
use crate::results::number::NumberColumn;
use crate::results::trust::Doubt;
use crate::sweep::columns::{self, Column, Reading};
use squealmap_figure::cyclic;
use squealmap_figure::frame::LABEL_SIZE;
use squealmap_figure::scale::Scale;
use squealmap_figure::text::Text;

/// The words of the bar for a fraction of starts.
const STARTS: &str = "fraction of starts";
/// A side of zero that reaches less far than this part of the other is rounding.
const ROUNDING: f64 = 1e-9;
/// The scale of a fraction.
const FRACTION: Scale = Scale::Linear { low: 0.0, high: 1.0 };

/// The numbers that a block shows: a value for every place of its panels, with scale, colours and words.
pub(crate) struct Field<'a> {
    /// The column that the values come from; `None` where they come from none.
    column: Option<&'a NumberColumn>,
    /// The words beside the bar; empty where the heading says enough.
    pub(super) label: &'a str,
    pub(super) scale: Scale,
    pub(super) tones: Tones<'a>,
    /// Where lines of equal value are drawn.
    pub(super) levels: &'a [f64],
    /// Where the starts of every place have ended; empty where the values are not of starts.
    basins: &'a [Option<Basin>],
    /// How many values are undefined.
    pub(super) undefined: usize,
    /// The value of a place in [`Panels::instances`].
    value: Box<dyn Fn(usize) -> Option<f64> + 'a>,
    /// Whether that value is one of a response that has not settled.
    unsettled: Box<dyn Fn(usize) -> bool + 'a>,
}

impl<'a> Field<'a> {
    /// The field of a content that has values; `None` for classes.
    pub(crate) fn of(content: Content<'a>, panels: &'a Panels) -> Option<Field<'a>> {
        match content {
            Content::Classes { .. } | Content::LargeRegime | Content::Lines => None,
            Content::Quantity { column, levels } => {
                let value = |place: usize| column.values.get(panels.instances[place]).copied().flatten();
                let (scale, tones) = shade(column);
                Some(Field {
                    column: Some(column),
                    label: if is_fraction(column) { STARTS } else { "" },
                    scale,
                    tones,
                    levels,
                    basins: &[],
                    undefined: column.values.iter().filter(|value| value.is_none()).count(),
                    value: Box::new(value),
                    unsettled: {
                        let doubt = Doubt::of(column);
                        Box::new(move |place: usize| doubt.is_unsettled(panels.labels[place], value(place)))
                    },
                })
            }
            Content::Named { column, heading, names } => {
                let value = |place: usize| column.values.get(panels.instances[place]).copied().flatten();
                Some(Field {
                    column: None,
                    label: heading,
                    scale: FRACTION,
                    tones: Tones::Named(names),
                    levels: &[],
                    basins: &[],
                    undefined: column.values.iter().filter(|value| value.is_none()).count(),
                    value: Box::new(value),
                    unsettled: Box::new(|_| false),
                })
            }
            Content::Basin => {
                let basin = |place: usize| panels.basins.get(place).copied().flatten();
                let value = move |place: usize| basin(place).and_then(|one| one.fraction(one.oscillation));
                Some(Field {
                    column: None,
                    label: STARTS,
                    scale: FRACTION,
                    tones: Tones::Lightness,
                    levels: &[],
                    basins: &panels.basins,
                    undefined: (0..panels.instances.len()).filter(|place| value(*place).is_none()).count(),
                    value: Box::new(value),
                    unsettled: Box::new(move |place| {
                        basin(place).is_some_and(|one| one.other + one.failed > 0)
                    }),
                })
            }
        }
    }

    /// Whether a place has a value that is not to be trusted.
    pub(crate) fn is_doubtful(&self, place: usize) -> bool {
        (self.unsettled)(place) && (self.value)(place).is_some()
    }

    /// Where the starts of every place have ended; empty where the values are not of starts.
    pub(crate) fn basins(&self) -> &'a [Option<Basin>] {
        self.basins
    }

    /// The scale on which its values stand by themselves; `None` for one around them.
    pub(crate) fn own_scale(&self) -> Option<Scale> {
        (!self.basins.is_empty() || self.column.is_some_and(is_fraction)).then_some(FRACTION)
    }

    /// Whether its values grow or decay, by their sign.
    pub(crate) fn has_sign(&self) -> bool {
        self.column.is_some_and(has_sign)
    }

    /// Whether the values are angles.
    pub(crate) fn is_angle(&self) -> bool {
        self.tones == Tones::Circle
    }

    /// The value of a place; `None` where it is undefined.
    pub(crate) fn value(&self, place: usize) -> Option<f64> {
        (self.value)(place)
    }

    /// The label of an axis of this length, points, with a power of ten.
    pub(crate) fn axis_label(&self, exponent: i32, room: f64) -> Text {
        let of = |column| words::label(column, exponent, room, LABEL_SIZE);
        self.column.map_or_else(|| Text::from(words::capital(self.label)), of)
    }

    /// The heading above the block, as lines of this width, points.
    pub(crate) fn heading(&self, room: f64) -> Vec<Text> {
        if let Some(column) = self.column {
            return words::label(column, self.scale.exponent(), room, LABEL_SIZE).wrapped(room, LABEL_SIZE);
        }
        if self.basins.is_empty() {
            return Text::from(self.label).wrapped(room, LABEL_SIZE);
        }
        let starts = starts(self.basins);
        let words = format!("Starts that end in a settled oscillation, of {starts} drawn from a box");
        Text::from(words).wrapped(room, LABEL_SIZE)
    }
}

/// How many starts an instance has.
fn starts(basins: &[Option<Basin>]) -> u32 {
    basins.iter().flatten().map(|basin| basin.total()).max().unwrap_or(0)
}

/// Whether a column is a fraction of the starts from a box.
fn is_fraction(column: &NumberColumn) -> bool {
    column.row().is_some_and(Column::is_share)
}

/// Whether the sign of a column says what happens: growth or decay.
pub(crate) fn has_sign(column: &NumberColumn) -> bool {
    column.reading() == Reading::Sign
}

/// The scale of the colours of a quantity, and the colours.
fn shade(column: &NumberColumn) -> (Scale, Tones<'static>) {
    if column.is_angle() {
        return (cyclic::scale(), Tones::Circle);
    }
    if is_fraction(column) {
        return (FRACTION, Tones::Lightness);
    }
    match scale(column) {
        Scale::Linear { low, high }
            if has_sign(column) && -low > ROUNDING * high && high > ROUNDING * -low && low < 0.0 =>
        {
            (Scale::Signed { low, high }, Tones::Sign)
        }
        scale => (scale, Tones::Lightness),
    }
}

/// The scale of a quantity over all panels: from its lowest to its highest value; small counts have a step each.
pub(crate) fn scale(quantity: &NumberColumn) -> Scale {
    /// Counts up to here are written out.
    const SMALL: u32 = 8;
    let spanning = Scale::spanning(quantity.values.iter().flatten().copied());
    let counts = quantity.row().is_some_and(|row| row.content() == columns::Content::Count);
    match (quantity.reading(), spanning) {
        (Reading::HalfTurn, _) => Scale::Linear { low: 0.0, high: 180.0 },
        (Reading::Ratios, Scale::Linear { low, high }) if low > 0.0 => Scale::Log { low, high },
        (Reading::Linear, Scale::Linear { high, .. }) if counts && high <= f64::from(SMALL) => Scale::Names(
            (0..=SMALL).filter(|count| f64::from(*count) <= high).map(|count| count.to_string()).collect(),
        ),
        (_, scale) => scale,
    }
}

/// The power of ten that the bar of a quantity has beside it.
pub(crate) fn exponent(quantity: &NumberColumn) -> i32 {
    if quantity.is_angle() { 0 } else { scale(quantity).exponent() }
}
