//! The first reading of a file: is it fit for analysis, and where is its oscillation?

use crate::again::Kept;
use crate::block::Block;
use crate::channel::{Channel, PerChannel};
use crate::fault::{Fault, RATES};
use crate::lanes::dot;
use crate::outlier::Watch;
use crate::pace::Pace;
use crate::range::Range;
use crate::read::Table;
use crate::settings::Settings;
use crate::sliding::Sliding;
use crate::spectrum::{Spectra, detrend, hann, noise_floor, refine};
use crate::still::{Stand, Stillness};
use crate::unit::TimeUnit;
use crate::unread::Unread;
use crate::window::{Geometry, UNLIKE};
use squealmap_input::quote::rounded;

/// Fewest samples of a record: below this there is no spectrum to speak of.
pub const LEAST_SAMPLES: u64 = 64;
/// The part of the way in either direction from which on a record holds strokes in both: noise of a belt at rest beside a stroke has less.
const TURNS: f64 = 0.1;
/// Samples per period below which phases of noisy signals mean nothing (2 is the limit of sampling).
pub const LEAST_PER_PERIOD: f64 = 2.5;
/// Samples of a segment of the mean spectrum: 0.3 s at 200 kHz.
const SEGMENT: usize = 1 << 16;
/// Bins that slow drift of the whole record reaches.
const DRIFT_BINS: usize = 4;
/// A peak of a spectrum stands out when it exceeds its noise by the logarithm of the number of bins, which the highest
/// bin of noise alone reaches, and this much more (chance 1 in 1000).
const STANDS_OUT: f64 = 7.0;
/// Periods of the oscillation for which nothing that sticks or flies stands still.
const STILL: f64 = 3.0;
/// A given rate and the column of time may differ by this part: times printed with few digits.
const SAME_RATE: f64 = 0.01;
/// A normal force whose mean is a smaller part of its standard deviation does not press. Impacts of a contact that opens in
/// every period have a standard deviation of about their mean.
const PRESSES: f64 = 0.25;
/// An acceleration whose mean exceeds its standard deviation this many times is none.
const OFFSET: f64 = 3.0;

/// The result of the first reading.
#[derive(Clone, Debug)]
pub(super) struct Survey {
    pub(super) samples: u64,
    /// The time of the first sample, s.
    pub(super) start: f64,
    /// Samples per second, Hz.
    pub(super) rate: f64,
    pub(super) names: PerChannel<String>,
    pub(super) has: PerChannel<bool>,
    /// Whether the mean velocity is negative: the signs along the contact are turned.
    pub(super) turned: bool,
    /// The strongest oscillation of the tangential acceleration, Hz; `None` where none stands out of the noise.
    pub(super) frequency: Option<f64>,
    /// The strongest oscillation of all frequencies, Hz, where a band is given that does not hold it.
    pub(super) outside: Option<f64>,
    /// Whether the normal acceleration is much larger than the tangential one.
    pub(super) unlike: bool,
    /// Sentences about what was read and how, where that is not plain.
    pub(super) remarks: Vec<String>,
    /// Velocity and temperature that stand still.
    pub(super) constant: Vec<Channel>,
    /// Vibrating channels that stand still for a while.
    pub(super) still: Vec<(Channel, Stand)>,
}

impl Survey {
    /// Windows of the record; `None` where no oscillation stands out or there is less than one window of it.
    pub(super) fn windows(&self) -> Option<Geometry> {
        self.geometry().filter(|geometry| geometry.window as u64 <= self.samples)
    }

    fn geometry(&self) -> Option<Geometry> {
        self.frequency.map(|frequency| Geometry::new(self.rate / frequency))
    }

    /// Whether there is an oscillation, but not one window of it.
    pub(super) fn too_short(&self) -> bool {
        self.geometry().is_some_and(|geometry| geometry.window as u64 > self.samples)
    }
}

/// Reads a whole file once; its samples as well, where they are few enough to be kept.
pub(super) fn survey(mut table: Table, settings: &Settings) -> Result<(Survey, Kept), Fault> {
    let has = Channel::ALL.map(|channel| table.has(channel));
    let mut kept = Kept::new(has);
    let mut pace = table.reads_time().then(|| Pace::new(table.time_name()));
    let mut seen = Seen::default();
    let mut block = Block::default();
    let mut samples = 0;
    let mut times = None::<[f64; 2]>;
    loop {
        let row = table.next()?;
        if block.is_full() || row.is_none() {
            seen.take(&block, has);
            kept.take(&block);
            block.clear();
        }
        let Some(row) = row else { break };
        if let (Some(pace), Some(time)) = (&mut pace, row.time) {
            pace.row(row.place, time)?;
        }
        if let Some(time) = row.time {
            times = Some([times.map_or(time, |[first, _]| first), time]);
        }
        block.push(&row.values);
        samples += 1;
    }
    let Seen { ranges, stills, watches, mut spectrum, unlike, blocks } = seen;
    if samples < LEAST_SAMPLES {
        return Err(Fault::TooShort { samples, least: LEAST_SAMPLES, because: String::new() });
    }
    let own = table.clock();
    let timed = pace.is_some();
    let (start, rate) = match pace {
        Some(pace) => pace.finish()?,
        // Without either the header was refused.
        None => {
            settings.rate.map(|rate| (0.0, rate)).or(own.map(|own| (own.start, own.rate))).unwrap_or_default()
        }
    };
    if !(rate.is_finite() && rate > 0.0) {
        return Err(Fault::NoRate { rate });
    }
    if timed && table.time_unit().is_none() && !is_usual(rate) {
        return Err(doubtful(table.time_name(), rate));
    }
    if let Some(own) = own {
        of_file(timed.then(|| table.time_name()), settings, [rate, own.rate])?;
    }
    if let Some((given, [first, last])) = settings.rate.zip(times) {
        let found = (samples - 1) as f64 / (last - first);
        if found.is_finite() && found > 0.0 && !is_same(found, given) {
            let unit = TimeUnit::ALL.into_iter().find(|unit| is_same(found / unit.seconds(), given));
            return Err(Fault::Contradicted {
                given,
                column: table.time_name(),
                found,
                because: in_unit(unit),
            });
        }
    }
    let names = Channel::ALL.map(|channel| table.name(channel));
    // Outliers first: they make a channel look offset or swapped.
    for (channel, watch) in Channel::ALL.into_iter().zip(watches) {
        if let Some(found) = watch.finish() {
            let (column, words) = (names[channel as usize].clone(), channel.words());
            let time = start + found.first as f64 / rate;
            return Err(Fault::Outliers { column, words, value: found.value, count: found.count, time });
        }
    }
    let constant = constant(has, &ranges, &names, rate)?;
    let velocity = table.has(Channel::Velocity).then_some(Channel::Velocity as usize);
    let turned =
        velocity.map_or(Ok(settings.back), |velocity| goes_back(&ranges[velocity], &names[velocity]))?;
    forces(&table, &ranges, settings, turned)?;
    let frequency = spectrum.peak(rate, settings.band);
    let outside = settings
        .band
        .and_then(|[low, high]| spectrum.peak(rate, None).filter(|found| !(low..=high).contains(found)));
    if let Some(frequency) = frequency.filter(|f| rate / f < LEAST_PER_PERIOD) {
        return Err(Fault::TooFast { frequency, samples: rate / frequency, least: LEAST_PER_PERIOD });
    }
    if let Some(frequency) = frequency {
        late(settings, frequency)?;
    }
    let least = frequency.map_or(f64::INFINITY, |frequency| STILL * rate / frequency);
    let still = Channel::ALL.into_iter().zip(stills).filter(|(channel, _)| channel.vibrates());
    let still = still.filter_map(|(channel, still)| Some((channel, still.finish(least)?))).collect();
    let mut remarks = table.remarks();
    remarks.extend(frequency.and_then(|hum| above_hum(&mut spectrum, rate, settings, hum)));
    let found = Survey {
        samples,
        start,
        rate,
        names,
        has,
        turned,
        frequency,
        outside,
        unlike: 2 * unlike > blocks,
        remarks,
        constant,
        still,
    };
    Ok((found, kept))
}

/// The channels that stand still, of those that are recorded; what cannot be is refused.
fn constant(
    has: PerChannel<bool>,
    ranges: &PerChannel<Range>,
    names: &PerChannel<String>,
    rate: f64,
) -> Result<Vec<Channel>, Fault> {
    let mut constant = Vec::new();
    for channel in Channel::ALL.into_iter().filter(|channel| has[*channel as usize]) {
        if judge(channel, &ranges[channel as usize], &names[channel as usize], rate)? {
            constant.push(channel);
        }
    }
    Ok(constant)
}

/// A sentence on an oscillation far above the strongest one, where that has the frequency of the mains (Hz).
fn above_hum(spectrum: &mut MeanSpectrum, rate: f64, settings: &Settings, hum: f64) -> Option<String> {
    /// Frequencies of mains, Hz, and how far from them hum is found.
    const MAINS: [f64; 4] = [50.0, 60.0, 100.0, 120.0];
    const NEAR: f64 = 0.03;
    /// An oscillation so many times as fast is another one.
    const ABOVE: f64 = 5.0;
    let is_hum = settings.band.is_none() && MAINS.iter().any(|mains| (hum / mains - 1.0).abs() < NEAR);
    let above = spectrum.peak(rate, Some([ABOVE * hum, 0.5 * rate])).filter(|_| is_hum)?;
    Some(format!(
        "the strongest oscillation, {hum:.1} Hz, is looked at: it may be hum of the mains, and windows of 12 of its periods leave out the ends of \
         the record; for the one at {above:.0} Hz give --band {:.0},{:.0}",
        0.7 * above,
        (1.5 * above).min(0.5 * rate)
    ))
}

/// What is told of the channels while the record goes by.
#[derive(Default)]
struct Seen {
    ranges: PerChannel<Range>,
    stills: PerChannel<Stillness>,
    watches: PerChannel<Watch>,
    spectrum: MeanSpectrum,
    /// Blocks of the record, and those in which the normal acceleration, trends removed, is much larger than the tangential one.
    blocks: usize,
    unlike: usize,
}

impl Seen {
    fn take(&mut self, block: &Block, has: PerChannel<bool>) {
        for channel in Channel::ALL.into_iter().filter(|channel| has[*channel as usize] && block.len() > 0) {
            let values = block.of(channel);
            self.ranges[channel as usize].take(values);
            self.watches[channel as usize].take(values);
            self.stills[channel as usize].take(values);
        }
        self.spectrum.take(block.of(Channel::TangentialAcceleration));
        self.blocks += 1;
        if has[Channel::NormalAcceleration as usize] {
            let [along, across] =
                [Channel::TangentialAcceleration, Channel::NormalAcceleration].map(|channel| {
                    let mut values = block.of(channel).to_vec();
                    detrend(&mut values);
                    dot(&values, &values)
                });
            self.unlike += usize::from(across > UNLIKE * UNLIKE * along);
        }
    }
}

/// Whether a stroke goes the other way; one that goes both ways is refused.
fn goes_back(velocity: &Range, column: &str) -> Result<bool, Fault> {
    let parts = velocity.parts();
    if parts.iter().all(|part| *part > TURNS) {
        let [forward, back] = parts.map(|part| 100.0 * part);
        return Err(Fault::BothDirections { column: column.to_owned(), forward, back });
    }
    Ok(velocity.mean() < 0.0)
}

/// Whether sensors of vibrations are sampled at this rate (Hz), or nearly.
fn is_usual(rate: f64) -> bool {
    (RATES[0] * (1.0 - SAME_RATE)..=RATES[1] * (1.0 + SAME_RATE)).contains(&rate)
}

fn is_same(found: f64, given: f64) -> bool {
    (found / given - 1.0).abs() <= SAME_RATE
}

/// Refuses a rate of the file itself (Hz) that no sensor has, and one given, or of a column of time, that is another.
fn of_file(column: Option<String>, settings: &Settings, [given, own]: [f64; 2]) -> Result<(), Fault> {
    if settings.rate.is_none() && column.is_none() && !is_usual(own) {
        return Err(Unread::NoRate { own: rounded(own), usual: RATES }.into());
    }
    if is_same(given, own) {
        return Ok(());
    }
    let flag = if column.is_some() { "--time" } else { "--rate" };
    let what = column.map_or("--rate is".to_owned(), |column| format!("column `{column}` has a rate of"));
    Err(Unread::OtherRate { what, given: rounded(given), own: rounded(own), flag }.into())
}

/// Asks about a column of time that would have this rate (Hz) in seconds.
fn doubtful(column: String, rate: f64) -> Fault {
    let usual = TimeUnit::ALL.into_iter().filter(|unit| is_usual(rate / unit.seconds()));
    let units: Vec<String> = usual
        .map(|unit| format!("--time-unit {} ({} Hz)", unit.name(), rounded(rate / unit.seconds())))
        .collect();
    let units = if units.is_empty() { "--time-unit".to_owned() } else { units.join(" or ") };
    Fault::DoubtfulTime { column, rate: rounded(rate), units }
}

/// The end of a sentence that says in which unit of time two rates would agree.
fn in_unit(unit: Option<TimeUnit>) -> String {
    unit.map_or(String::new(), |unit| format!("; in {0} both are one: --time-unit {0}", unit.name()))
}

/// Refuses delays longer than a period of the oscillation (Hz): over these its amplitude changes, too.
fn late(settings: &Settings, frequency: f64) -> Result<(), Fault> {
    let period = 1.0 / frequency;
    for (flag, delay) in [("--skew", settings.skew), ("--force-skew", settings.force_skew)] {
        if delay.abs() > period {
            return Err(Fault::TooLate { flag, delay, frequency, period });
        }
    }
    Ok(())
}

/// Refuses a channel that is constant, cut off or no vibration; `true` for one that may stand still, and does.
fn judge(channel: Channel, range: &Range, name: &str, rate: f64) -> Result<bool, Fault> {
    let (column, words, flag) = (name.to_owned(), channel.words(), channel.flag());
    if range.is_constant() {
        // A drag test at one velocity and one temperature is a good test.
        return if channel.vibrates() {
            Err(Fault::Constant { column, words, value: range.mean(), flag })
        } else {
            Ok(true)
        };
    }
    if let Some(clipping) = range.clipping().filter(|_| channel.vibrates()) {
        let time = clipping.first as f64 / rate;
        return Err(Fault::Clipped { column, words, value: clipping.value, runs: clipping.runs, time });
    }
    let acceleration = matches!(channel, Channel::TangentialAcceleration | Channel::NormalAcceleration);
    let (mean, deviation) = (range.mean(), range.deviation());
    if acceleration && mean.abs() > OFFSET * deviation {
        return Err(Fault::Offset { column, words, mean, deviation, flag });
    }
    Ok(false)
}

/// Refuses forces that are swapped or of the wrong sign.
fn forces(table: &Table, ranges: &PerChannel<Range>, settings: &Settings, turned: bool) -> Result<(), Fault> {
    let of = |channel: Channel| ranges[channel as usize];
    let (tangential, normal) = (of(Channel::TangentialForce), of(Channel::NormalForce));
    if !table.has(Channel::NormalForce) {
        return Ok(());
    }
    if normal.mean() < PRESSES * normal.deviation() {
        return Err(Fault::NotPressing {
            column: table.name(Channel::NormalForce),
            mean: normal.mean(),
            deviation: normal.deviation(),
        });
    }
    if !table.has(Channel::TangentialForce) {
        return Ok(());
    }
    let friction = tangential.mean() / normal.mean() * if turned { -1.0 } else { 1.0 };
    let (tangential, normal) = (table.name(Channel::TangentialForce), table.name(Channel::NormalForce));
    if friction > settings.largest_friction {
        return Err(Fault::SwappedForces {
            tangential,
            normal,
            friction,
            largest: settings.largest_friction,
        });
    }
    if friction < 0.0 {
        return Err(Fault::NegativeFriction { tangential, normal, friction });
    }
    Ok(())
}

/// The mean power spectrum of a signal of any length: segments that overlap by half, and what remains.
struct MeanSpectrum {
    segments: Sliding,
    sum: Vec<f64>,
    spectra: Option<Spectra>,
    power: Vec<f64>,
}

impl Default for MeanSpectrum {
    fn default() -> MeanSpectrum {
        let segments = Sliding::new(SEGMENT, SEGMENT / 2);
        MeanSpectrum { segments, sum: Vec::new(), spectra: None, power: Vec::new() }
    }
}

impl MeanSpectrum {
    fn take(&mut self, values: &[f64]) {
        self.segments.take(values);
        while let Some(segment) = self.segments.window() {
            let spectra = self.spectra.get_or_insert_with(|| Spectra::new(hann(SEGMENT)));
            spectra.power(segment, &mut self.power);
            self.sum.resize(self.power.len(), 0.0);
            self.sum.iter_mut().zip(&self.power).for_each(|(sum, power)| *sum += power);
            self.segments.leave();
        }
    }

    /// The frequency of the highest bin inside the band, Hz; `None` when it does not stand out.
    fn peak(&mut self, rate: f64, band: Option<[f64; 2]>) -> Option<f64> {
        let mut length = SEGMENT;
        if self.spectra.is_none() {
            // A record shorter than a segment: no taper, as a growing oscillation is strongest at its end.
            length = self.segments.rest().len();
            Spectra::new(vec![1.0; length]).power(self.segments.rest(), &mut self.sum);
        }
        let width = rate / length as f64;
        let inside = |k: usize| {
            let frequency = k as f64 * width;
            band.is_none_or(|[low, high]| (low..=high).contains(&frequency))
        };
        let bins = (DRIFT_BINS..self.sum.len()).filter(|k| inside(*k));
        let highest = bins.max_by(|a, b| self.sum[*a].total_cmp(&self.sum[*b]))?;
        let position = refine(&self.sum, highest);
        let chance = (self.sum.len() as f64).ln() + STANDS_OUT;
        let stands_out = self.sum[highest] > chance * noise_floor(&self.sum, position);
        stands_out.then_some(position * width)
    }
}
