//! A sentence about the time to settle that a sweep needs.

use crate::cli::progress::seconds;
use squealmap::engine::regime::Regime;
use squealmap::model::kind::InstabilityType;
use squealmap::sweep::label::{Label, Tally};
use squealmap::sweep::onset::{Onsets, onsets};
use squealmap::sweep::spec::Spec;

/// From the start to the window in which a motion has settled, in the time to its first event: of a map of 65 x 65 instances of
/// an exponential law this left 26 unsettled, 20 of them beyond the 99 %.
const AND_SETTLES: f64 = 1.5;

/// The sentence, with a line of its own, where instances of a sweep have not yet grown.
pub(crate) fn onset_of(spec: &Spec, tally: &Tally) -> String {
    if tally.count(|label| label.regime() == Some(Regime::NotYetGrown)) == 0 {
        return String::new();
    }
    let kinks = about_kinks(tally).into_iter();
    kinks.chain(onset(spec)).map(|sentence| sentence + "\n").collect()
}

/// A sentence about instances that grow although they are called stable: only a kink of the law makes that.
fn about_kinks(tally: &Tally) -> Option<String> {
    let grow = |label: Label| {
        label.kind() == Some(InstabilityType::Stable) && label.regime() == Some(Regime::NotYetGrown)
    };
    let count = tally.count(grow);
    (count > 0).then(|| {
        format!(
            "{count} instance(s) are `stable` by the slope above a kink of the friction law, on which the belt velocity lies or nearly lies: a \
             vibration about it sees the slope below, too, and grows"
        )
    })
}

/// A sentence about the time that the unstable instances of a sweep need to show what they do; `None` where the sweep gives
/// it to them.
pub(crate) fn onset(spec: &Spec) -> Option<String> {
    if !spec.analysis.response {
        return None;
    }
    let Onsets { looked_at, growing, late, at_rest, most, longest } = onsets(spec)?;
    let drawn = if looked_at < spec.grid.len() { format!(" among {looked_at} drawn") } else { String::new() };
    if late > 0 {
        let slow = format!(
            "{late} of {growing} unstable instances{drawn} grow too slowly to show what they do: by growth rate and start"
        );
        let last = seconds(longest);
        // A limit that would do for as many as have their time already is no advice.
        if 100 * late <= growing {
            return Some(format!("{slow} the last meets its first event after {last}"));
        }
        let limit = round_up(AND_SETTLES * most);
        let auto = if spec.settle_limit.is_some() { "" } else { "`settle = \"auto\"` with " };
        return Some(format!(
            "{slow} 99 % meet their first event within {}, the last after {last}; {auto}`settle_limit = \"{limit} s\"` in \
             [response] would do for 99 %",
            seconds(most)
        ));
    }
    (at_rest > 0).then(|| {
        format!(
            "{at_rest} unstable instances{drawn} start at rest, from which nothing grows: give a `start_velocity` in [start]"
        )
    })
}

/// The next number of two digits.
fn round_up(value: f64) -> f64 {
    let unit = 10_f64.powf(value.log10().floor() - 1.0);
    let rounded = (value / unit).ceil() * unit;
    // Of a power of ten below 1 the product has an end of roundings.
    format!("{rounded:.1e}").parse().unwrap_or(rounded)
}
