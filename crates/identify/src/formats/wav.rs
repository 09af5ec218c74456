//! WAV: samples of all channels together, read as they come.

use std::io::{BufReader, Read};

use hound::{SampleFormat, WavIntoSamples, WavReader};

use super::source::{Clock, Source};
use crate::fault::Fault;
use crate::place::Place;
use crate::unread::Unread;

type Input = BufReader<Box<dyn Read>>;

/// What is said of every WAV file.
const REMARK: &str = "WAV has no units: full scale is 1, and accelerations, forces and velocity are read as such numbers; frequency, \
    growth rate and phase do not depend on it, what compares two quantities does";

/// A WAV file that is being read.
pub(super) struct Wav {
    header: Vec<String>,
    samples: Samples,
    rate: f64,
    row: Vec<f64>,
    /// Rows read, and rows that there are.
    at: u64,
    count: u64,
}

/// The samples that are left.
enum Samples {
    /// Integers, and what full scale is.
    Integers(WavIntoSamples<Input, i32>, f64),
    Floats(WavIntoSamples<Input, f32>),
}

impl Samples {
    fn next(&mut self) -> Option<hound::Result<f64>> {
        match self {
            Samples::Integers(samples, full) => {
                samples.next().map(|value| value.map(|value| f64::from(value) / *full))
            }
            Samples::Floats(samples) => samples.next().map(|value| value.map(f64::from)),
        }
    }
}

impl Wav {
    pub(super) fn open(input: Input) -> Result<Wav, Unread> {
        let reader = WavReader::new(input).map_err(|why| broken(said(&why)))?;
        let spec = reader.spec();
        let count = u64::from(reader.duration());
        if spec.sample_rate == 0 {
            return Err(broken("says that it has 0 samples per second".to_owned()));
        }
        let samples = match spec.sample_format {
            SampleFormat::Int => {
                let full = f64::from(spec.bits_per_sample - 1).exp2();
                Samples::Integers(reader.into_samples(), full)
            }
            SampleFormat::Float => Samples::Floats(reader.into_samples()),
        };
        Ok(Wav {
            header: (1..=spec.channels).map(|channel| format!("channel_{channel}")).collect(),
            samples,
            rate: f64::from(spec.sample_rate),
            row: vec![0.0; usize::from(spec.channels)],
            at: 0,
            count,
        })
    }
}

impl Source for Wav {
    fn header(&self) -> &[String] {
        &self.header
    }

    fn clock(&self, _: usize) -> Option<Clock> {
        Some(Clock { start: 0.0, rate: self.rate, origin: 0.0 })
    }

    fn advance(&mut self) -> Result<bool, Fault> {
        if self.at == self.count {
            return Ok(false);
        }
        for value in &mut self.row {
            let early = |why: &str| {
                let (at, count) = (self.at, self.count);
                broken(format!("ends after {at} of the {count} samples that it says it has{why}"))
            };
            *value = match self.samples.next() {
                Some(Ok(value)) => value,
                Some(Err(hound::Error::IoError(why))) => return Err(early(&format!(" ({why})")).into()),
                Some(Err(why)) => return Err(broken(said(&why)).into()),
                None => return Err(early("").into()),
            };
        }
        self.at += 1;
        Ok(true)
    }

    fn number(&mut self, column: usize) -> Result<f64, Fault> {
        let value = self.row[column];
        if value.is_finite() {
            return Ok(value);
        }
        Err(Unread::NotFinite { sample: self.at, column: self.header[column].clone(), value }.into())
    }

    fn place(&self) -> Place {
        Place::Sample(self.at)
    }

    fn remark(&self) -> Option<String> {
        Some(REMARK.to_owned())
    }
}

/// What a fault of the reader says of the file.
fn said(why: &hound::Error) -> String {
    match why {
        hound::Error::IoError(why) => format!("is cut off or cannot be read ({why})"),
        hound::Error::FormatError(why) => format!("is no whole one, or of an unusual kind ({why})"),
        why => format!("has samples that are neither integers nor 32-bit floats ({why})"),
    }
}

fn broken(why: String) -> Unread {
    let remedy = "save it anew with integers of 16, 24 or 32 bits or with 32-bit floats, or export it as CSV";
    Unread::Broken { format: "WAV", why, remedy }
}
