//! `signals.csv`: the recording of an instance, as `squealmap identify` reads it.

use crate::model::instance::Instance;
use crate::results::csv::Table;
use crate::study::error::Result;
use crate::study::signals::sensors::Sample;
use crate::sweep::columns::Cell;
use squealmap_identify::Channel;

/// The table of a recording: time and the channels under the names `identify` expects, and the temperature (°C) of the
/// instance, where one is given that has it.
///
/// # Errors
/// When the table cannot be written.
pub fn signals_csv(samples: &[Sample], instance: Option<&Instance>) -> Result<Vec<u8>> {
    let channels = [
        Channel::TangentialAcceleration,
        Channel::NormalAcceleration,
        Channel::TangentialForce,
        Channel::NormalForce,
        Channel::Velocity,
    ];
    let temperature = |time: f64| instance.and_then(|instance| instance.temperature(time));
    let names = std::iter::once("t").chain(channels.map(Channel::default_column));
    let mut table = Table::new(names.chain(temperature(0.0).map(|_| Channel::Temperature.default_column())))?;
    for sample in samples {
        let numbers = [
            sample.t,
            sample.tangential_acceleration,
            sample.normal_acceleration,
            sample.tangential_force,
            sample.normal_force,
            sample.belt_velocity,
        ];
        table.row(numbers.into_iter().chain(temperature(sample.t)).map(|x| Cell::from(x).to_string()))?;
    }
    Ok(table.finish()?)
}
