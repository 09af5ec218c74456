//! A record in one sentence: its segments in order of time.

use crate::segment::Segment;
use crate::verdict::Kind;

/// `0.000 to 0.082 s no instability, to 0.250 s mode coupling, to 0.400 s both`: neighbours with one verdict are one.
/// Undecided ones name the mechanism that acts in any case, or what they lean to.
#[must_use]
pub fn told(segments: &[Segment]) -> String {
    /// Digits of a time: a thousandth of a record is finer than any boundary is known.
    const PART: f64 = 1000.0;
    let Some((first, last)) = segments.first().zip(segments.last()) else {
        return "no oscillation stands out of the noise".to_owned();
    };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 9")]
    let digits = (PART / (last.time[1] - first.time[0])).log10().ceil().clamp(0.0, 9.0) as usize;
    let words = |segment: &Segment| match (segment.verdict.kind, segment.verdict.leaning) {
        (Kind::Undecided, _) if segment.shared.is_some() => {
            segment.shared.map_or(String::new(), |(mechanism, _)| mechanism.words().to_owned())
        }
        (Kind::Undecided, Some(kind)) => format!("undecided, leaning to {}", kind.words()),
        (kind, _) => kind.words().to_owned(),
    };
    let mut parts: Vec<(f64, String)> = Vec::new();
    for segment in segments {
        let words = words(segment);
        match parts.last_mut() {
            Some((end, said)) if *said == words => *end = segment.time[1],
            _ => parts.push((segment.time[1], words)),
        }
    }
    let parts: Vec<String> =
        parts.into_iter().map(|(end, words)| format!("to {end:.digits$} s {words}")).collect();
    format!("{:.digits$} {}", first.time[0], parts.join(", "))
}
