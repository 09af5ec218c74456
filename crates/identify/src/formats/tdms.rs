//! TDMS files of LabVIEW: segments, each with what has changed in the list of channels, and the numbers of one after the other.

use std::collections::HashMap;
use std::io::Read;

use super::held::Column;
use super::numbers::{Number, Room, bytes, bytes_or_end, cut_off, read, skip};
use super::source::Clock;

/// What a segment says of itself.
const META: u32 = 1 << 1;
const NEW_LIST: u32 = 1 << 2;
const RAW: u32 = 1 << 3;
const INTERLEAVED: u32 = 1 << 5;
const BIG: u32 = 1 << 6;
const DAQMX: u32 = 1 << 7;
/// Lengths of an index: none, that of the segment before, and those of DAQmx.
const NO_INDEX: u32 = u32::MAX;
const SAME_INDEX: u32 = 0;
const DAQMX_INDEX: [u32; 3] = [0x1269, 0x126a, 0x1369];
/// Types of values that are no numbers of a signal.
const STRING: u32 = 0x20;
const TIMESTAMP: u32 = 0x44;
/// The most channels and groups of a file.
const MOST_OBJECTS: usize = 4096;
/// Bytes of a name or a text.
const LONGEST: u64 = 1 << 20;

/// How the values of a channel are stored in a segment.
#[derive(Clone, Copy, Debug)]
enum Index {
    Numbers(Number, u64),
    /// Bytes that are no numbers.
    Other(u64),
}

impl Index {
    fn bytes(self) -> Option<u64> {
        match self {
            Index::Numbers(number, count) => count.checked_mul(number.width() as u64),
            Index::Other(bytes) => Some(bytes),
        }
    }
}

/// A group or a channel.
#[derive(Debug, Default)]
struct Object {
    path: String,
    index: Option<Index>,
    values: Vec<f64>,
    unit: Option<String>,
    numeric: bool,
    increment: Option<f64>,
    offset: f64,
    began: f64,
    /// Whether a scale is still to be applied.
    scales: f64,
    scaled: bool,
}

/// A file as far as it was read.
#[derive(Debug, Default)]
struct File {
    objects: Vec<Object>,
    places: HashMap<String, usize>,
    /// The objects of a segment, and whether it has values of theirs.
    list: Vec<(usize, bool)>,
}

/// Reads a whole file.
pub(super) fn columns(input: &mut dyn Read) -> Result<Vec<Column>, String> {
    let (mut file, mut room) = (File::default(), Room::new());
    while let Some(head) = bytes_or_end::<28>(input)? {
        let word = |at: usize| head[at..].first_chunk().map_or(0, |bytes| u32::from_le_bytes(*bytes));
        let toc = word(4);
        let big = toc & BIG != 0;
        if &head[..4] != b"TDSm" {
            return Err("has a segment that does not begin as one: its counts are wrong".to_owned());
        }
        let long = |at: usize| {
            let bytes = head[at..].first_chunk().copied().unwrap_or_default();
            if big { u64::from_be_bytes(bytes) } else { u64::from_le_bytes(bytes) }
        };
        let (end, raw) = (long(12), long(20));
        if end == u64::MAX {
            return Err("was not written to its end (LabVIEW or the machine stopped)".to_owned());
        }
        let Some(size) = end.checked_sub(raw) else {
            return Err("has a segment that ends before its values: its counts are wrong".to_owned());
        };
        let mut meta = Meta { input: &mut input.take(raw), big };
        if toc & META != 0 {
            file.described(&mut meta, toc & NEW_LIST != 0)?;
        }
        std::io::copy(meta.input, &mut std::io::sink()).map_err(|why| cut_off(&why))?;
        if toc & RAW == 0 {
            skip(input, size)?;
        } else if toc & DAQMX != 0 {
            return Err(RAW_DAQMX.to_owned());
        } else if toc & INTERLEAVED != 0 {
            return Err("holds its channels interleaved, which is not read".to_owned());
        } else {
            file.filled(input, size, big, &mut room)?;
        }
    }
    file.finish()
}

const RAW_DAQMX: &str = "holds raw data of DAQmx, which is not read";

/// The description of a segment.
struct Meta<'a> {
    input: &'a mut dyn Read,
    big: bool,
}

impl Meta<'_> {
    fn word(&mut self) -> Result<u32, String> {
        let bytes = bytes(self.input)?;
        Ok(if self.big { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) })
    }

    fn long(&mut self) -> Result<u64, String> {
        let bytes = bytes(self.input)?;
        Ok(if self.big { u64::from_be_bytes(bytes) } else { u64::from_le_bytes(bytes) })
    }

    fn text(&mut self) -> Result<String, String> {
        let length = u64::from(self.word()?);
        if length > LONGEST {
            return Err(format!("has a text of {length} bytes: its counts are wrong"));
        }
        let mut text = Vec::new();
        self.input.take(length).read_to_end(&mut text).map_err(|why| cut_off(&why))?;
        if text.len() as u64 == length {
            Ok(String::from_utf8_lossy(&text).into_owned())
        } else {
            Err("has a text that is cut off: its counts are wrong".to_owned())
        }
    }

    /// A property as a number or a text, of those that are any: a time is in seconds.
    fn value(&mut self) -> Result<(f64, String), String> {
        let kind = self.word()?;
        let number = match kind {
            STRING => return Ok((f64::NAN, self.text()?)),
            TIMESTAMP => {
                let (first, second) = (self.long()?, self.long()?);
                // Fractions of 2^-64 and whole seconds; the other way round where the file is big-endian.
                let (fraction, seconds) = if self.big { (second, first) } else { (first, second) };
                seconds.cast_signed() as f64 + fraction as f64 * (-64.0_f64).exp2()
            }
            kind => {
                let stored =
                    stored(kind).ok_or_else(|| format!("has a property of the unknown type {kind}"))?;
                let mut values = Vec::new();
                read(self.input, (stored, self.big), 1, &mut Room::new(), &mut values)?;
                values.first().copied().unwrap_or_default()
            }
        };
        Ok((number, String::new()))
    }
}

impl File {
    /// Takes what a segment says of the objects.
    fn described(&mut self, meta: &mut Meta, new: bool) -> Result<(), String> {
        if new {
            self.list.clear();
        }
        for _ in 0..meta.word()? {
            let path = meta.text()?;
            let known = self.places.get(&path).copied();
            let place = known.unwrap_or(self.objects.len());
            if known.is_none() {
                if place == MOST_OBJECTS {
                    return Err(format!("has more than {MOST_OBJECTS} channels"));
                }
                self.places.insert(path.clone(), place);
                self.objects.push(Object { path, ..Object::default() });
            }
            let object = &mut self.objects[place];
            let has = index(meta, object)?;
            match self.list.iter_mut().find(|(listed, _)| *listed == place) {
                Some((_, listed)) => *listed = has,
                None => self.list.push((place, has)),
            }
            for _ in 0..meta.word()? {
                let (name, (number, text)) = (meta.text()?, meta.value()?);
                match name.as_str() {
                    "wf_increment" => object.increment = Some(number),
                    "wf_start_offset" => object.offset = number,
                    "wf_start_time" => object.began = number,
                    "NI_Number_Of_Scales" => object.scales = number,
                    "unit_string" => object.unit = Some(text),
                    "NI_Scaling_Status" => object.scaled = text == "scaled",
                    _ => {}
                }
            }
        }
        Ok(())
    }

    /// Reads `size` bytes of values.
    fn filled(&mut self, input: &mut dyn Read, size: u64, big: bool, room: &mut Room) -> Result<(), String> {
        let parts: Vec<(usize, Index)> = self
            .list
            .iter()
            .filter(|(_, has)| *has)
            .filter_map(|(place, _)| Some((*place, self.objects[*place].index?)))
            .filter(|(_, index)| index.bytes() != Some(0))
            .collect();
        let chunk = parts.iter().try_fold(0_u64, |sum, (_, index)| sum.checked_add(index.bytes()?));
        let chunks = match chunk {
            Some(0) if size == 0 => 0,
            Some(chunk) if chunk > 0 && size.is_multiple_of(chunk) => size / chunk,
            _ => {
                let said = chunk.map_or("more than there can be".to_owned(), |chunk| chunk.to_string());
                return Err(format!(
                    "has {size} bytes of values in a segment whose channels make {said}: its counts are wrong"
                ));
            }
        };
        for _ in 0..chunks {
            for (place, index) in &parts {
                match *index {
                    Index::Numbers(number, count) => {
                        read(input, (number, big), count, room, &mut self.objects[*place].values)?;
                    }
                    Index::Other(bytes) => skip(input, bytes)?,
                }
            }
        }
        Ok(())
    }

    /// The columns: by the name of the channel, with that of its group where two have one name.
    fn finish(self) -> Result<Vec<Column>, String> {
        let mut count = HashMap::<String, usize>::new();
        let channels: Vec<(Object, [String; 2])> = self
            .objects
            .into_iter()
            .filter(|object| object.numeric)
            .filter_map(|object| names(&object.path).map(|names| (object, names)))
            .collect();
        for (_, [_, channel]) in &channels {
            *count.entry(channel.clone()).or_default() += 1;
        }
        let column = |(object, [group, channel]): (Object, [String; 2])| {
            Column {
            clock: object.increment.and_then(|step| Clock::of_step(step, object.offset, object.began)),
            refused: (object.scales > 0.0 && !object.scaled).then_some(
                "holds counts of a converter that are still to be scaled, which is not done here; export the file as CSV",
            ),
            name: if count[&channel] > 1 { format!("{group}/{channel}") } else { channel },
            values: object.values,
            unit: object.unit,
        }
        };
        let columns: Vec<Column> = channels.into_iter().map(column).collect();
        if columns.is_empty() { Err("has no channel of numbers".to_owned()) } else { Ok(columns) }
    }
}

/// Reads the index of an object; whether the segment has values of it.
fn index(meta: &mut Meta, object: &mut Object) -> Result<bool, String> {
    let length = meta.word()?;
    match length {
        NO_INDEX => return Ok(false),
        SAME_INDEX if object.index.is_some() => return Ok(true),
        SAME_INDEX => return Err("refers to a segment before the first: its counts are wrong".to_owned()),
        length if DAQMX_INDEX.contains(&length) => return Err(RAW_DAQMX.to_owned()),
        _ => {}
    }
    let (kind, dimensions, count) = (meta.word()?, meta.word()?, meta.long()?);
    if dimensions != 1 {
        return Err(format!("has a channel of {dimensions} dimensions where there is one"));
    }
    let found = match kind {
        STRING => Index::Other(meta.long()?),
        kind => match (stored(kind), other(kind)) {
            (Some(number), _) => Index::Numbers(number, count),
            (None, Some(width)) => Index::Other(count.saturating_mul(width)),
            (None, None) => return Err(format!("has a channel of the unknown type {kind}")),
        },
    };
    object.numeric = matches!(found, Index::Numbers(..));
    object.index = Some(found);
    Ok(true)
}

/// Group and channel of `/'group'/'channel'`, in which `''` is a quotation mark; `None` for what is no channel.
fn names(path: &str) -> Option<[String; 2]> {
    let inside = path.strip_prefix("/'")?.strip_suffix('\'')?;
    let (group, channel) = inside.split_once("'/'")?;
    Some([group, channel].map(|name| name.replace("''", "'")))
}

/// How numbers of a type are stored.
fn stored(kind: u32) -> Option<Number> {
    Some(match kind {
        1 => Number::I8,
        2 => Number::I16,
        3 => Number::I32,
        4 => Number::I64,
        // Truth is a byte.
        5 | 0x21 => Number::U8,
        6 => Number::U16,
        7 => Number::U32,
        8 => Number::U64,
        9 | 0x19 => Number::F32,
        10 | 0x1a => Number::F64,
        _ => return None,
    })
}

/// Bytes of a value that is no number of a signal: a time, a complex number.
fn other(kind: u32) -> Option<u64> {
    match kind {
        0x0008_000c => Some(8),
        TIMESTAMP | 0x0010_000d => Some(16),
        _ => None,
    }
}
