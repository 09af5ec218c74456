//! A file of signals → samples, one row at a time.

use std::io::Read;

use crate::channel::{Channel, PerChannel};
use crate::fault::Fault;
use crate::formats::{self, Clock, Source};
use crate::place::Place;
use crate::scale::{Said, Scale, own, said, without_unit};
use crate::settings::Settings;
use crate::unit::{TimeUnit, bracketed, is_time, named};
use squealmap_input::quote::{clipped, quoted};

/// The column of time when none is named.
const TIME: &str = "t";

/// One row: time (s) where the file has it, and the channels (0 where the file has none).
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub(super) place: Place,
    pub(super) time: Option<f64>,
    pub(super) values: PerChannel<f64>,
}

/// A file of signals that is being read.
pub(super) struct Table {
    source: Box<dyn Source>,
    time: Option<usize>,
    /// The time of the samples where the format says it.
    clock: Option<Clock>,
    /// The unit of time that was said outright, and that of the header.
    units: [Option<TimeUnit>; 2],
    /// Whether the column of time gives the rate; else it may contradict the one given.
    believed: bool,
    /// Whether a row was read.
    begun: bool,
    columns: PerChannel<Option<usize>>,
    /// What a number of each is in the unit of the channel.
    scales: PerChannel<Scale>,
    /// The values of the row before, and how many are blank in this file since, of channels that do not vibrate.
    held: PerChannel<Option<f64>>,
    blanks: PerChannel<u64>,
    /// Whether the file has a column of time, or says it: its rows follow each other.
    over_time: bool,
    /// Rows to pass over, and rows to read after them.
    skipped: u64,
    left: u64,
    /// Sentences about columns that are passed over.
    remarks: Vec<String>,
}

impl Table {
    /// Reads the header and finds the columns of signals: time, or a rate, and at least the tangential acceleration.
    pub(super) fn open(input: Box<dyn Read>, settings: &Settings) -> Result<Table, Fault> {
        Table::open_with(input, settings, &[Channel::TangentialAcceleration], true)
    }

    /// Reads the header and finds the columns; those of `needed` have to be there, and time if it is `timed`.
    pub(super) fn open_with(
        input: Box<dyn Read>,
        settings: &Settings,
        needed: &[Channel],
        timed: bool,
    ) -> Result<Table, Fault> {
        let mut source = formats::open(input)?;
        let header = source.header();
        let mut columns = PerChannel::default();
        for (channel, column) in Channel::ALL.into_iter().zip(&mut columns) {
            let named = settings.columns[channel as usize].as_deref();
            let found = by_name(header, channel, named.unwrap_or(channel.default_column()));
            // What is named has to be there, too.
            if found.is_none() && (named.is_some() || needed.contains(&channel)) {
                return Err(Fault::NoColumn {
                    words: channel.words(),
                    name: quoted(named.unwrap_or(channel.default_column())),
                    header: listed(header),
                    flag: channel.flag(),
                });
            }
            if let Some(found) = found {
                once(header, &header[found], channel.words(), channel.flag())?;
            }
            *column = found;
        }
        shared(header, &columns)?;
        let time = match &settings.time {
            Some(name) => find(header, name),
            None => find(header, TIME).or_else(|| header.iter().position(|name| is_time(name))),
        };
        let mut remarks = of_one_record(&*source, &mut columns, settings, needed)?;
        let scales = scales(&*source, &columns, &mut remarks);
        // A format that says the time of its samples needs no column of it, unless one is named.
        let clock = columns.iter().flatten().find_map(|column| source.clock(*column));
        let over_time = time.is_some() || clock.is_some();
        let time = time.filter(|_| timed && (clock.is_none() || settings.time.is_some()));
        let untold = settings.rate.is_none() && clock.is_none();
        if timed && time.is_none() && (untold || settings.time.is_some()) {
            return Err(Fault::NoColumn {
                words: "time",
                name: settings.time.clone().unwrap_or(TIME.to_owned()),
                header: listed(header),
                flag: "--time, or give the sampling rate with --rate",
            });
        }
        let first = columns.iter().flatten().next().copied();
        let apart = first.zip(time).and_then(|(first, time)| source.together(first, time).err());
        let believed = settings.rate.is_none();
        if let Some(why) = apart.clone().filter(|_| believed || settings.time.is_some()) {
            return Err(why.into());
        }
        let time = time.filter(|_| apart.is_none());
        if let Some(found) = time.filter(|_| believed) {
            once(header, &header[found], "time", "--time")?;
        }
        let unit_of = |found: usize| named(&header[found]).1.or_else(|| TimeUnit::bare(source.unit(found)?));
        let units = [settings.time_unit, time.and_then(unit_of)];
        let chosen: Vec<usize> = columns.iter().chain([&time]).flatten().copied().collect();
        source.choose(&chosen);
        let [skipped, left] = settings.rows.unwrap_or([0, u64::MAX]);
        Ok(Table {
            source,
            time,
            clock: clock.map(|clock| Clock { start: clock.start + skipped as f64 / clock.rate, ..clock }),
            units,
            believed,
            begun: false,
            columns,
            scales,
            held: PerChannel::default(),
            blanks: PerChannel::default(),
            over_time,
            skipped,
            left,
            remarks,
        })
    }

    /// The next row; `None` at the end of the file.
    pub(super) fn next(&mut self) -> Result<Option<Row>, Fault> {
        if !self.source.advance()? {
            return Ok(None);
        }
        while self.skipped > 0 {
            self.skipped -= 1;
            if !self.source.advance()? {
                return Ok(None);
            }
        }
        if self.left == 0 {
            return Ok(None);
        }
        self.left -= 1;
        self.source.whole()?;
        let mut values = PerChannel::default();
        for (channel, value) in Channel::ALL.into_iter().zip(&mut values) {
            let at = channel as usize;
            let Some(column) = self.columns[at] else { continue };
            let number = match (self.source.number(column), self.held[at]) {
                // A slow channel of a file with several rates.
                (Err(_), Some(held)) if self.source.is_blank(column) => {
                    self.blanks[at] += 1;
                    held
                }
                (number, _) => number?,
            };
            if !channel.vibrates() {
                self.held[at] = Some(number);
            }
            let [factor, offset] = self.scales[at];
            *value = factor * number + offset;
        }
        let unit = self.time_unit().unwrap_or(TimeUnit::Second).seconds();
        let time = self.time.map(|column| self.source.number(column).map(|time| time * unit));
        // Beside a given rate any text may stand for the time.
        let time = if self.believed {
            time.transpose().map_err(|fault| if self.begun { fault } else { no_time(fault) })?
        } else {
            time.and_then(Result::ok)
        };
        self.begun = true;
        Ok(Some(Row { place: self.source.place(), time, values }))
    }

    /// Whether the file has the channel.
    pub(super) fn has(&self, channel: Channel) -> bool {
        self.columns[channel as usize].is_some()
    }

    /// The column of a channel, empty when the file has none.
    pub(super) fn name(&self, channel: Channel) -> String {
        self.columns[channel as usize].map(|column| quoted(&self.source.header()[column])).unwrap_or_default()
    }

    /// The unit of the column of time, where it is known.
    pub(super) fn time_unit(&self) -> Option<TimeUnit> {
        self.units[0].or(self.units[1])
    }

    /// The time of the samples, where the format says it and no column of time is read.
    pub(super) fn clock(&self) -> Option<Clock> {
        self.clock
    }

    /// Whether the time of the samples is that of a column.
    pub(super) fn reads_time(&self) -> bool {
        self.believed && self.time.is_some()
    }

    /// Whether its rows follow each other in time.
    pub(super) fn is_over_time(&self) -> bool {
        self.over_time
    }

    /// Reads nothing of a channel from here on.
    pub(super) fn pass_over(&mut self, channel: Channel) {
        self.columns[channel as usize] = None;
    }

    /// Sentences about what was read and how, where that is not plain.
    pub(super) fn remarks(&self) -> Vec<String> {
        let blank = |(channel, count): (Channel, u64)| {
            let name = self.name(channel);
            (count > 0).then(|| {
                format!("column `{name}` is blank in {count} row(s), which have the value of the row before")
            })
        };
        let blanks = Channel::ALL.into_iter().zip(self.blanks).filter_map(blank);
        let remarks = self.source.remark().into_iter().chain(self.remark_on_unit());
        remarks.chain(self.remarks.iter().cloned()).chain(blanks).collect()
    }

    /// A sentence about the unit of time, where it is not the second or not the one of the header.
    fn remark_on_unit(&self) -> Option<String> {
        let (name, unit) = (self.time.map(|_| self.time_name())?, self.time_unit()?);
        match self.units {
            [Some(said), Some(header)] if said != header => Some(format!(
                "column `{name}` is read as --time-unit {} says, not as its header does",
                said.name()
            )),
            _ => (unit != TimeUnit::Second).then(|| format!("column `{name}` is read in {}", unit.name())),
        }
    }

    /// The column of time.
    pub(super) fn time_name(&self) -> String {
        self.time.map(|column| quoted(&self.source.header()[column])).unwrap_or_default()
    }
}

/// The fault of a column of time that holds no numbers from its first row on, such as times of day.
fn no_time(fault: Fault) -> Fault {
    match fault {
        Fault::NotANumber { line, column, text } => Fault::NotATime { line, column, text },
        fault => fault,
    }
}

/// Refuses columns that are not read, or were not recorded together with the first that is needed. One that nobody asked for is passed over, with a
/// sentence: `N` may be a number of samples.
fn of_one_record(
    source: &dyn Source,
    columns: &mut PerChannel<Option<usize>>,
    settings: &Settings,
    needed: &[Channel],
) -> Result<Vec<String>, Fault> {
    let mut remarks = Vec::new();
    let first = needed.first().and_then(|channel| columns[*channel as usize]);
    for (channel, column) in Channel::ALL.into_iter().zip(columns) {
        let Some((first, found)) = first.zip(*column) else { continue };
        if let Err(why) = source.together(first, found) {
            if settings.columns[channel as usize].is_some() || needed.contains(&channel) {
                return Err(why.into());
            }
            remarks.push(format!("{} is not read: {why}", channel.words()));
            *column = None;
        }
    }
    Ok(remarks)
}

/// What a number of each column is in the unit of its channel, with a sentence where that is another one than its own, or not known.
fn scales(
    source: &dyn Source,
    columns: &PerChannel<Option<usize>>,
    remarks: &mut Vec<String>,
) -> PerChannel<Scale> {
    let header = source.header();
    Channel::ALL.map(|channel| {
        const OWN: Scale = [1.0, 0.0];
        let Some(column) = columns[channel as usize] else {
            remarks.extend(passed_over(header, channel));
            return OWN;
        };
        let name = quoted(&header[column]);
        match said(channel, &header[column], source.unit(column)) {
            Said::Own => OWN,
            Said::Other(scale, unit) => {
                let whose = if source.unit(column).is_some() { "the file" } else { "its header" };
                remarks.push(format!("column `{name}` is read in {unit}, as {whose} says"));
                scale
            }
            Said::Unknown(unit) => {
                remarks.push(format!(
                    "column `{name}` is read in {}, as `{}` is no unit of {} that is known",
                    own(channel),
                    quoted(&unit),
                    channel.words()
                ));
                OWN
            }
        }
    })
}

/// A sentence about a column that would be that of a channel if its unit were known.
fn passed_over(header: &[String], channel: Channel) -> Option<String> {
    let name = channel.default_column();
    let column =
        header.iter().find(|column| bracketed(column).is_some_and(|(text, _)| text.trim_end() == name))?;
    Some(format!(
        "column `{}` is not read, as its unit is none of {} that is known; name it with {} to read it in {}",
        quoted(column),
        channel.words(),
        channel.flag(),
        own(channel)
    ))
}

fn find(header: &[String], name: &str) -> Option<usize> {
    header.iter().position(|column| column == name)
}

/// The column of a channel by its name, alone or with a unit in brackets.
fn by_name(header: &[String], channel: Channel, name: &str) -> Option<usize> {
    find(header, name)
        .or_else(|| header.iter().position(|column| without_unit(channel, column) == Some(name)))
}

/// Refuses a column whose name stands more than once in the header.
fn once(header: &[String], name: &str, words: &'static str, flag: &'static str) -> Result<(), Fault> {
    let count = header.iter().filter(|column| *column == name).count();
    if count > 1 { Err(Fault::Ambiguous { words, name: quoted(name), count, flag }) } else { Ok(()) }
}

/// The most characters that are said of a header.
const LISTED: usize = 400;

fn listed(header: &[String]) -> String {
    let names: Vec<String> = header.iter().take(LISTED).map(|name| format!("`{}`", quoted(name))).collect();
    clipped(&names.join(", "), LISTED)
}

/// Refuses a column that is named for two quantities.
fn shared(header: &[String], columns: &PerChannel<Option<usize>>) -> Result<(), Fault> {
    for (second, column) in Channel::ALL.into_iter().zip(columns) {
        let Some(column) = column else { continue };
        let first = Channel::ALL.into_iter().zip(columns).find(|(_, other)| **other == Some(*column));
        if let Some((first, _)) = first.filter(|(first, _)| *first != second) {
            return Err(Fault::SharedColumn {
                name: quoted(&header[*column]),
                first: first.words(),
                second: second.words(),
                flag: second.flag(),
            });
        }
    }
    Ok(())
}
