//! Numbers as bytes, of which a file may say more than it has: memory grows with what was read, never with what is said.

use std::io::{ErrorKind, Read};

/// Bytes read at a time; a multiple of every width.
const BLOCK: usize = 1 << 14;
/// The most numbers that are held of a file: 8 GiB.
pub(super) const MOST: u64 = 1 << 30;

/// How a number is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Number {
    /// Its bytes.
    pub(super) fn width(self) -> usize {
        match self {
            Number::I8 | Number::U8 => 1,
            Number::I16 | Number::U16 => 2,
            Number::I32 | Number::U32 | Number::F32 => 4,
            Number::I64 | Number::U64 | Number::F64 => 8,
        }
    }

    /// Adds the numbers of whole widths of bytes.
    fn add(self, bytes: &[u8], big: bool, values: &mut Vec<f64>) {
        macro_rules! each {
            ($kind:ty) => {
                each!($kind, |value: $kind| f64::from(value))
            };
            ($kind:ty, $as_f64:expr) => {{
                const WIDTH: usize = size_of::<$kind>();
                let (all, _) = bytes.as_chunks::<WIDTH>();
                let from = if big { <$kind>::from_be_bytes } else { <$kind>::from_le_bytes };
                values.extend(all.iter().map(|bytes| $as_f64(from(*bytes))));
            }};
        }
        match self {
            Number::I8 => each!(i8),
            Number::U8 => each!(u8),
            Number::I16 => each!(i16),
            Number::U16 => each!(u16),
            Number::I32 => each!(i32),
            Number::U32 => each!(u32),
            Number::I64 => each!(i64, |value| value as f64),
            Number::U64 => each!(u64, |value| value as f64),
            Number::F32 => each!(f32),
            Number::F64 => each!(f64),
        }
    }
}

/// How many numbers may still be held.
#[derive(Debug)]
pub(super) struct Room(u64);

impl Room {
    pub(super) fn new() -> Room {
        Room(MOST)
    }

    /// Takes the room of so many numbers.
    pub(super) fn take(&mut self, count: u64) -> Result<(), String> {
        let left = self.0.checked_sub(count);
        self.0 = left
            .ok_or_else(|| format!("says that it has more than {MOST} numbers, which are held in memory"))?;
        Ok(())
    }
}

/// Adds `count` numbers of `input` to `values`.
pub(super) fn read(
    input: &mut dyn Read,
    (number, big): (Number, bool),
    count: u64,
    room: &mut Room,
    values: &mut Vec<f64>,
) -> Result<(), String> {
    room.take(count)?;
    let mut block = [0; BLOCK];
    // No more than `MOST` times the widest number.
    let mut left = count * number.width() as u64;
    while left > 0 {
        let size = usize::try_from(left).map_or(BLOCK, |left| left.min(BLOCK));
        input.read_exact(&mut block[..size]).map_err(|why| cut_off(&why))?;
        number.add(&block[..size], big, values);
        left -= size as u64;
    }
    Ok(())
}

/// Passes over `count` bytes.
pub(super) fn skip(input: &mut dyn Read, count: u64) -> Result<(), String> {
    let passed = std::io::copy(&mut input.take(count), &mut std::io::sink()).map_err(|why| cut_off(&why))?;
    if passed == count { Ok(()) } else { Err(CUT_OFF.to_owned()) }
}

/// The next bytes.
pub(super) fn bytes<const COUNT: usize>(input: &mut dyn Read) -> Result<[u8; COUNT], String> {
    let mut bytes = [0; COUNT];
    input.read_exact(&mut bytes).map_err(|why| cut_off(&why))?;
    Ok(bytes)
}

/// The next bytes; `None` where the file ends before the first.
pub(super) fn bytes_or_end<const COUNT: usize>(input: &mut dyn Read) -> Result<Option<[u8; COUNT]>, String> {
    let mut found = Vec::new();
    Read::take(&mut *input, COUNT as u64).read_to_end(&mut found).map_err(|why| cut_off(&why))?;
    if found.is_empty() {
        return Ok(None);
    }
    found.try_into().map(Some).map_err(|_| CUT_OFF.to_owned())
}

const CUT_OFF: &str = "is cut off: it ends before what it says that it has";

/// What a fault of reading says of a file.
pub(super) fn cut_off(why: &std::io::Error) -> String {
    if why.kind() == ErrorKind::UnexpectedEof { CUT_OFF.to_owned() } else { format!("cannot be read: {why}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_more_is_held_than_there_is_room_for() {
        let mut values = Vec::new();
        let kind = (Number::U8, false);
        assert_eq!(read(&mut &[1, 2, 3][..], kind, 3, &mut Room(3), &mut values), Ok(()));
        assert_eq!(values, [1.0, 2.0, 3.0]);
        assert!(read(&mut &[1, 2, 3][..], kind, 3, &mut Room(2), &mut values).is_err());
        assert!(read(&mut &[1, 2, 3][..], kind, 1 << 60, &mut Room::new(), &mut values).is_err());
        assert_eq!(values.len(), 3);
    }
}
