//! A tile as bytes: header, columns, footer with a checksum.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | `SQMTILE1` |
//! | 32 | the id of the sweep |
//! | 8, 8 | first instance, one past the last, u64 |
//! | 16 | the engine in words, padded with zeros |
//! | 4 | 1 eigenvalue analysis, 2 response, u32 |
//! | 4 | zero |
//! | … | the columns, see [`crate::store::columns`] and [`crate::store::starts`] |
//! | 32 | BLAKE3 of everything before |
//! | 8 | `SQMTEND1` |
//!
//! All numbers are little-endian.

use std::borrow::Cow;
use std::ops::Range;

use crate::engine::record::Record;
use crate::model::status::Status;
use crate::store::identity::Id;
use crate::store::starts::{decode, encode, width};
use crate::sweep::spec::Analysis;

const MAGIC: &[u8; 8] = b"SQMTILE1";
const END: &[u8; 8] = b"SQMTEND1";
const HEADER: usize = 80;
const CHECKSUM: usize = 32;
/// Bytes at the end of a tile that hold its checksum.
pub const FOOTER: usize = CHECKSUM + END.len();

/// BLAKE3 of the bytes of a tile before it.
pub type Checksum = [u8; CHECKSUM];

/// What a tile says of itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The sweep.
    pub sweep: Id,
    /// The engine, see [`crate::store::identity::kind`]; its first 16 bytes count.
    pub kind: String,
    /// What was computed.
    pub analysis: Analysis,
    /// Its instances.
    pub bounds: Range<usize>,
}

/// How many instances a tile of any sweep says that it has; `None` when the bytes are no tile or do not have its checksum.
#[must_use]
pub fn instances_in(bytes: &[u8]) -> Option<usize> {
    let (content, footer) = bytes.split_at_checked(bytes.len().checked_sub(FOOTER)?)?;
    let is_whole = content.len() >= HEADER
        && content.starts_with(MAGIC)
        && blake3::hash(content).as_bytes()[..] == footer[..CHECKSUM]
        && footer[CHECKSUM..] == END[..];
    let number = |at: usize| content.get(at..at + 8)?.try_into().ok().map(u64::from_le_bytes);
    let [first, end] = [40, 48].map(number);
    usize::try_from(end?.checked_sub(first?)?).ok().filter(|_| is_whole)
}

/// What is wrong with a tile of any sweep; `None` for a good one.
#[must_use]
pub fn fault_in(bytes: &[u8]) -> Option<Fault> {
    match instances_in(bytes) {
        Some(_) => None,
        None if bytes.is_empty() => Some(Fault::Empty),
        None if !bytes.starts_with(MAGIC) => Some(Fault::Format),
        None => Some(Fault::Checksum),
    }
}

/// The sweep that a tile says it belongs to; `None` when the bytes are no tile.
#[must_use]
pub fn sweep_in(bytes: &[u8]) -> Option<Id> {
    bytes.strip_prefix(MAGIC)?.first_chunk().copied().map(Id)
}

/// The checksum at the end of a tile of any sweep; `None` when the bytes are too few for one.
#[must_use]
pub fn checksum_in(end: &[u8]) -> Option<Checksum> {
    let footer = &end[end.len().checked_sub(FOOTER)?..];
    footer[CHECKSUM..].starts_with(END).then(|| footer.first_chunk().copied()).flatten()
}

/// What is wrong with a tile.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// A file without a byte.
    #[error("it is empty")]
    Empty,
    /// No tile of this format.
    #[error("it is no tile of this format")]
    Format,
    /// Another length than its columns have.
    #[error("it has {found} of {wanted} bytes")]
    Length {
        /// Its bytes.
        found: usize,
        /// What it should have.
        wanted: usize,
    },
    /// A tile of another sweep, version or engine.
    #[error("it belongs to another sweep, version or engine")]
    Sweep,
    /// A tile of other instances.
    #[error("it holds other instances")]
    Bounds,
    /// Its bytes are not those that were written.
    #[error("its checksum does not match its content")]
    Checksum,
    /// The checksum matches, but a code in it is none.
    #[error("it holds a code that does not exist")]
    Code,
    /// A tile says that it is whole, and is not.
    #[error("it holds instances that were not computed")]
    Uncomputed,
    /// This process cannot read it; it may be good.
    #[error("this process cannot read it: {why}")]
    Denied {
        /// What the system says.
        why: String,
    },
    /// It cannot be read.
    #[error("it cannot be read: {why}")]
    Unreadable {
        /// What the system says.
        why: String,
    },
}

impl Label {
    /// The key of the tile: BLAKE3 of the id of the sweep, the bounds and the kind, the first 16 hexadecimal digits.
    #[must_use]
    pub fn key(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&self.sweep.0);
        for bound in [self.bounds.start, self.bounds.end] {
            hasher.update(&(bound as u64).to_le_bytes());
        }
        hasher.update(self.kind.as_bytes());
        hasher.finalize().to_hex()[..16].to_owned()
    }

    /// Bytes of the tile.
    #[must_use]
    pub fn size(&self) -> usize {
        HEADER + self.bounds.len() * width(self.analysis) + FOOTER
    }

    fn header(&self) -> [u8; HEADER] {
        let mut kind = [0; 16];
        for (place, byte) in kind.iter_mut().zip(self.kind.bytes()) {
            *place = byte;
        }
        let analysis = u32::from(self.analysis.linear) + 2 * u32::from(self.analysis.response);
        let mut header = [0; HEADER];
        let parts: [&[u8]; 6] = [
            MAGIC,
            &self.sweep.0,
            &(self.bounds.start as u64).to_le_bytes(),
            &(self.bounds.end as u64).to_le_bytes(),
            &kind,
            &analysis.to_le_bytes(),
        ];
        let mut at = 0;
        for part in parts {
            header[at..at + part.len()].copy_from_slice(part);
            at += part.len();
        }
        header
    }

    /// The bytes of the tile with these records.
    ///
    /// # Panics
    /// When there are not as many records as instances.
    #[must_use]
    pub fn write(&self, records: &[Record]) -> Vec<u8> {
        let mut bytes = vec![0; self.size()];
        self.write_into(records.into(), &mut bytes);
        bytes
    }

    /// Writes the tile with these records into `bytes`.
    ///
    /// # Panics
    /// When there are not as many records as instances, or not as many `bytes` as its [`Label::size`].
    pub fn write_into(&self, records: Cow<[Record]>, bytes: &mut [u8]) {
        let (content, footer) = bytes.split_at_mut(self.size() - FOOTER);
        content[..HEADER].copy_from_slice(&self.header());
        encode(records, self.analysis, &mut content[HEADER..]);
        footer[..CHECKSUM].copy_from_slice(blake3::hash(content).as_bytes());
        footer[CHECKSUM..].copy_from_slice(END);
    }

    /// The records of a tile that says this of itself.
    ///
    /// # Errors
    /// What is wrong with it: nothing of such a tile is used.
    pub fn read(&self, bytes: &[u8]) -> Result<Vec<Record>, Fault> {
        let records = self.read_some(bytes)?;
        let whole = records.iter().all(|record| record.status != Status::NotComputed);
        whole.then_some(records).ok_or(Fault::Uncomputed)
    }

    /// The records of a tile that may have been stopped before it was complete: some of them are [`Record::NOT_COMPUTED`]
    /// then.
    ///
    /// # Errors
    /// What is wrong with it: nothing of such a tile is used.
    pub fn read_some(&self, bytes: &[u8]) -> Result<Vec<Record>, Fault> {
        if bytes.is_empty() {
            return Err(Fault::Empty);
        }
        if !bytes.starts_with(MAGIC) {
            return Err(Fault::Format);
        }
        let wanted = self.header();
        let sweep = MAGIC.len()..MAGIC.len() + self.sweep.0.len();
        if bytes.len() >= HEADER && bytes[sweep.clone()] != wanted[sweep] {
            return Err(Fault::Sweep);
        }
        if bytes.len() != self.size() {
            return Err(Fault::Length { found: bytes.len(), wanted: self.size() });
        }
        let (content, footer) = bytes.split_at(bytes.len() - FOOTER);
        if blake3::hash(content).as_bytes()[..] != footer[..CHECKSUM] || footer[CHECKSUM..] != END[..] {
            return Err(Fault::Checksum);
        }
        if content[..HEADER] != wanted {
            return Err(Fault::Bounds);
        }
        decode(&content[HEADER..], self.bounds.len(), self.analysis).ok_or(Fault::Code)
    }
}
