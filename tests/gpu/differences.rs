//! How a map differs from that of the reference; for tests and benchmarks.

use std::fmt;

use squealmap::engine::outcome::Outcome;
use squealmap::model::Param;
use squealmap::model::status::Status;
use squealmap::sweep::grid::Value;
use squealmap::sweep::map::Map;

/// How a map differs from that of the reference.
pub(crate) struct Differences {
    /// One line for each instance whose status, type or regime differs.
    pub(crate) labels: Vec<String>,
    /// One line for each instance that was measured over another window: one settles a window earlier than the other.
    pub(crate) windows: Vec<String>,
    /// Relative differences of the amplitudes, of settled instances unless the belt has a ramp, rising.
    pub(crate) amplitudes: Vec<f64>,
    /// Instances of the map.
    pub(crate) instances: usize,
}

impl Differences {
    pub(crate) fn new(map: &Map, reference: &Map) -> Differences {
        let (mut labels, mut windows) = (Vec::new(), Vec::new());
        let mut amplitudes = Vec::new();
        assert_eq!(map.records.len(), reference.records.len());
        for (index, (a, b)) in map.records.iter().zip(&reference.records).enumerate() {
            if (a.status, a.kind, a.regime) != (b.status, b.kind, b.regime) {
                let at: Vec<String> =
                    map.spec.grid.coordinates(index).into_iter().map(Value::to_string).collect();
                labels.push(format!(
                    "{}: {:?} {:?} {:?} instead of {:?} {:?} {:?}",
                    at.join(" "),
                    a.status,
                    a.kind,
                    a.regime,
                    b.status,
                    b.kind,
                    b.regime
                ));
            }
            let (Some(a), Some(b)) = (&a.outcome, &b.outcome) else { continue };
            // Windows of whole cycles are as long as the frequencies that were measured.
            let within = if map.spec.settle_limit.is_some() { 1e-3 } else { 1e-12 };
            if (a.simulated_time - b.simulated_time).abs() > within * b.simulated_time
                && b.status == Status::Ok
            {
                windows.push(format!("{index}: {} s instead of {} s", a.simulated_time, b.simulated_time));
            }
            let ramp = map.spec.base.get(Param::RampDuration).is_some();
            if ramp || reference.records[index].settled == Some(true) {
                amplitudes.extend(relative(a, b));
            }
        }
        amplitudes.sort_by(f64::total_cmp);
        Differences { labels, windows, amplitudes, instances: map.records.len() }
    }

    /// The amplitude difference below which `share` per cent lie.
    pub(crate) fn quantile(&self, share: usize) -> f64 {
        self.amplitudes
            .get(self.amplitudes.len().saturating_sub(1) * share / 100)
            .copied()
            .unwrap_or(f64::NAN)
    }
}

impl fmt::Display for Differences {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} of {} labels differ, {} settle in another window; {} amplitudes: median {:.1e}, p99 {:.1e}, worst {:.1e}",
            self.labels.len(),
            self.instances,
            self.windows.len(),
            self.amplitudes.len(),
            self.quantile(50),
            self.quantile(99),
            self.quantile(100)
        )?;
        self.labels.iter().chain(&self.windows).try_for_each(|line| write!(f, "\n  {line}"))
    }
}

/// Relative differences of amplitudes, frequency, mean friction and peak force, and absolute ones of the time
/// fractions; a NaN or a value that only one of them has is infinitely far.
fn relative(a: &Outcome, b: &Outcome) -> impl Iterator<Item = f64> {
    let numbers = [
        (a.x2_std, b.x2_std),
        (a.y1_std, b.y1_std),
        (a.ax_rms, b.ax_rms),
        (a.ay_rms, b.ay_rms),
        (a.response_frequency, b.response_frequency),
        (a.friction_mean, b.friction_mean),
        (a.n_peak, b.n_peak),
    ];
    let fractions = [(a.stick, b.stick), (a.free, b.free), (a.reverse, b.reverse)];
    let far = |pair: (Option<f64>, Option<f64>), relative: bool| match pair {
        (Some(a), Some(b)) => {
            let difference: f64 = a - b;
            let size: f64 = if relative { b.abs().max(1e-12) } else { 1.0 };
            let error = difference.abs() / size;
            if error.is_finite() { error } else { f64::INFINITY }
        }
        (None, None) => 0.0,
        _ => f64::INFINITY,
    };
    let numbers = numbers.into_iter().map(move |pair| far(pair, true));
    numbers.chain(fractions.into_iter().map(move |pair| far(pair, false)))
}
