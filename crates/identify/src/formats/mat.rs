//! MAT files of version 5, as MATLAB writes them with `save -v6` and `-v7`: every numeric array is a column, or one for each of
//! its channels.

use std::io::Read;

use flate2::read::ZlibDecoder;

use super::held::Column;
use super::numbers::{Number, Room, bytes, bytes_or_end, read, skip};

/// Bytes of the header; its last four are version and order of bytes.
pub(super) const HEADER: usize = 128;
/// Types of elements.
const INT8: u32 = 1;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const MATRIX: u32 = 14;
const COMPRESSED: u32 = 15;
/// The classes of numeric arrays.
const NUMERIC: std::ops::RangeInclusive<u8> = 6..=15;
/// The flag of complex numbers.
const COMPLEX: u32 = 0x0800;
/// A matrix with more channels than this is no signals.
const MOST_CHANNELS: u64 = 256;
/// Bytes of a name, and of the sizes of an array.
const LONGEST: u64 = 256;

/// Reads a whole file.
pub(super) fn columns(input: &mut dyn Read) -> Result<Vec<Column>, String> {
    let header: [u8; HEADER] = bytes(input)?;
    let big = &header[126..] == b"MI";
    let (mut columns, mut room) = (Vec::new(), Room::new());
    while let Some(head) = bytes_or_end::<8>(input)? {
        let [kind, size] = words(head, big);
        let mut element = input.take(u64::from(size));
        let found = match kind {
            MATRIX => matrix(&mut element, big, &mut room)?,
            COMPRESSED => {
                let mut inflated = ZlibDecoder::new(&mut element);
                let [kind, size] = words(bytes(&mut inflated)?, big);
                if kind != MATRIX {
                    return Err(format!("has an element of the unknown type {kind}"));
                }
                let found = matrix(&mut (&mut inflated).take(u64::from(size)), big, &mut room)?;
                // Padding: behind it a checksum is compared.
                std::io::copy(&mut inflated.take(LONGEST), &mut std::io::sink())
                    .map_err(|why| format!("cannot be inflated: {why}"))?;
                found
            }
            _ => Vec::new(),
        };
        columns.extend(found);
        let left = element.limit();
        skip(input, left)?;
    }
    if columns.is_empty() {
        return Err("has no numeric arrays of real numbers (what is in structs, cells, tables and objects is not read)".to_owned());
    }
    Ok(columns)
}

/// Two words of an order of bytes.
fn words(bytes: [u8; 8], big: bool) -> [u32; 2] {
    let [a, b, c, d, e, f, g, h] = bytes;
    [[a, b, c, d], [e, f, g, h]].map(if big { u32::from_be_bytes } else { u32::from_le_bytes })
}

/// The columns of an array; none where it has no numbers.
fn matrix(input: &mut dyn Read, big: bool, room: &mut Room) -> Result<Vec<Column>, String> {
    let flags = part(input, big)?;
    if (flags.kind, flags.bytes.len()) != (UINT32, 8) {
        return Err(UNKNOWN.to_owned());
    }
    let flags = flags.words(big)[0];
    if !NUMERIC.contains(&flags.to_le_bytes()[0]) || flags & COMPLEX != 0 {
        return Ok(Vec::new());
    }
    let sizes = part(input, big)?;
    if sizes.kind != INT32 {
        return Err(UNKNOWN.to_owned());
    }
    let sizes = sizes.words(big);
    let name = part(input, big)?;
    if name.kind != INT8 {
        return Err(UNKNOWN.to_owned());
    }
    let name = String::from_utf8_lossy(&name.bytes).trim_end_matches('\0').to_owned();
    let [rows, channels] = sizes[..] else { return Ok(Vec::new()) };
    // The longer side is time.
    let (samples, count) = (u64::from(rows.max(channels)), u64::from(rows.min(channels)));
    if name.is_empty() || !(1..=MOST_CHANNELS).contains(&count) {
        return Ok(Vec::new());
    }
    let (kind, size, held) = head(input, big)?;
    let number = stored(kind).ok_or_else(|| format!("has numbers of the unknown type {kind} in `{name}`"))?;
    if samples * count * number.width() as u64 != u64::from(size) {
        return Err(format!("says that `{name}` has {rows} × {channels} numbers, but not in {size} bytes"));
    }
    let mut values = Vec::new();
    let mut held = held.as_deref();
    let input: &mut dyn Read = match &mut held {
        Some(held) => held,
        None => input,
    };
    read(input, (number, big), samples * count, room, &mut values)?;
    if count == 1 {
        return Ok(vec![Column { name, values, ..Column::default() }]);
    }
    // What is stored together is a column of MATLAB.
    let (samples, count) = (as_size(samples)?, as_size(count)?);
    let of = |channel: usize| -> Vec<f64> {
        if rows >= channels {
            values[channel * samples..(channel + 1) * samples].to_vec()
        } else {
            values.iter().skip(channel).step_by(count).copied().collect()
        }
    };
    let column = |channel| Column {
        name: format!("{name}_{}", channel + 1),
        values: of(channel),
        ..Column::default()
    };
    Ok((0..count).map(column).collect())
}

const UNKNOWN: &str = "has an array whose beginning is none";

fn as_size(count: u64) -> Result<usize, String> {
    usize::try_from(count).map_err(|_| "is larger than the memory".to_owned())
}

/// A short part of an array.
struct Part {
    kind: u32,
    bytes: Vec<u8>,
}

impl Part {
    fn words(&self, big: bool) -> Vec<u32> {
        let from = if big { u32::from_be_bytes } else { u32::from_le_bytes };
        self.bytes.as_chunks::<4>().0.iter().map(|bytes| from(*bytes)).collect()
    }
}

/// The type of a part, the number of its bytes, and the bytes where these stand beside the number.
fn head(input: &mut dyn Read, big: bool) -> Result<(u32, u32, Option<Vec<u8>>), String> {
    let head: [u8; 8] = bytes(input)?;
    let [first, second] = words(head, big);
    let small = first >> 16;
    match small {
        0 => Ok((first, second, None)),
        1..=4 => Ok((first & 0xffff, small, Some(head[4..].iter().take(small as usize).copied().collect()))),
        _ => Err(UNKNOWN.to_owned()),
    }
}

/// Reads a short part with what fills its last eight bytes.
fn part(input: &mut dyn Read, big: bool) -> Result<Part, String> {
    let (kind, size, held) = head(input, big)?;
    if let Some(bytes) = held {
        return Ok(Part { kind, bytes });
    }
    if u64::from(size) > LONGEST {
        return Err(UNKNOWN.to_owned());
    }
    let mut all = Vec::new();
    for _ in 0..size.div_ceil(8) {
        all.extend(bytes::<8>(input)?);
    }
    all.truncate(size as usize);
    Ok(Part { kind, bytes: all })
}

/// How numbers of a type of elements are stored.
fn stored(kind: u32) -> Option<Number> {
    Some(match kind {
        INT8 => Number::I8,
        2 => Number::U8,
        3 => Number::I16,
        4 => Number::U16,
        INT32 => Number::I32,
        UINT32 => Number::U32,
        7 => Number::F32,
        9 => Number::F64,
        12 => Number::I64,
        13 => Number::U64,
        _ => return None,
    })
}
