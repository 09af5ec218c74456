//! How exact a found cycle is, beside a run of 5000 periods.

use squealmap::engine::lanes::Lanes;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::Duration;

use crate::Row;
use crate::maps::{Map, run};

/// Periods before the run is measured.
const WAITED: f64 = 5000.0;

/// Periods of the cycle over which it is: whole ones.
const MEASURED: f64 = 60.0;

/// Relative errors of three observables, at the 50th, 99th and last percentile, of a sample that the long run has settled.
pub(crate) fn rows(map: &Map, sample: usize) -> Vec<Row> {
    let step = (map.instances.len() / sample.max(1)).max(1);
    let some: Vec<_> = map.instances.iter().step_by(step).cloned().collect();
    let [_, cycle] = map.plans();
    let both = [("f64", run::<f64>(&some, &cycle)), ("f32", run::<f32>(&some, &cycle))];
    let waited: Vec<Option<Outcome>> = some
        .iter()
        .zip(&both[0].1)
        .map(|(one, found)| {
            let (period, floquet) = found.period.zip(found.floquet)?;
            // A cycle that 5000 periods do not settle is not judged by them.
            let settles = floquet.powf(WAITED) < 1e-9;
            let plan = map.fixed(Duration::Periods(WAITED), Duration::Seconds(MEASURED * period));
            settles.then(|| alone::<f64>(one, &plan))
        })
        .collect();
    let mut rows = vec![Row {
        of: map.name.to_owned(),
        quantity: "cycles beside a run of 5000 periods".to_owned(),
        value: waited.iter().flatten().count() as f64,
    }];
    for (precision, found) in &both {
        for (name, of) in OBSERVABLES {
            let pairs = found.iter().zip(&waited).filter(|(found, _)| found.floquet.is_some());
            let mut errors: Vec<f64> = pairs
                .filter_map(|(found, waited)| Some((of(found)?, of(waited.as_ref()?)?)))
                .map(|(found, waited)| ((found - waited) / waited).abs())
                .collect();
            errors.sort_by(f64::total_cmp);
            for (share, quantile) in [("50 %", 50), ("99 %", 99), ("100 %", 100)] {
                let at = errors.len().saturating_sub(1) * quantile / 100;
                rows.push(Row {
                    of: format!("{}, {precision}", map.name),
                    quantity: format!("relative error of {name}, {share}"),
                    value: errors.get(at).copied().unwrap_or(f64::NAN),
                });
            }
        }
    }
    rows
}

/// A name, and how the value is had.
type Observable = (&'static str, fn(&Outcome) -> Option<f64>);

/// Three observables.
const OBSERVABLES: [Observable; 3] = [
    ("x2_std", |outcome| outcome.x2_std),
    ("ax_rms", |outcome| outcome.ax_rms),
    ("ay_rms", |outcome| outcome.ay_rms),
];

fn alone<T: Lanes>(
    one: &squealmap::model::instance::Instance,
    plan: &squealmap::engine::plan::Plan,
) -> Outcome {
    run::<T>(std::slice::from_ref(one), plan).pop().unwrap_or_default()
}
