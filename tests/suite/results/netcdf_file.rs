//! NetCDF classic files, read byte by byte as their specification has it.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::collections::BTreeMap;
use std::path::Path;

/// Reads the header of a NetCDF classic file.
struct Header<'a> {
    bytes: &'a [u8],
    at: usize,
    wide: bool,
}

impl Header<'_> {
    fn word(&mut self) -> u32 {
        self.at += 4;
        u32::from_be_bytes(self.bytes[self.at - 4..self.at].try_into().unwrap())
    }

    fn count(&mut self) -> usize {
        if !self.wide {
            return self.word() as usize;
        }
        usize::try_from(self.long()).unwrap()
    }

    fn long(&mut self) -> u64 {
        (u64::from(self.word()) << 32) | u64::from(self.word())
    }

    fn padded(&mut self, length: usize) -> Vec<u8> {
        let bytes = self.bytes[self.at..self.at + length].to_vec();
        self.at += length.next_multiple_of(4);
        bytes
    }

    fn name(&mut self) -> String {
        let length = self.count();
        String::from_utf8(self.padded(length)).unwrap()
    }

    /// Texts as they are, numbers as text.
    fn attributes(&mut self) -> BTreeMap<String, String> {
        assert_eq!(self.word(), 12);
        let count = self.count();
        let mut all = BTreeMap::new();
        for _ in 0..count {
            let (name, kind, length) = (self.name(), self.word(), self.count());
            let text = match kind {
                2 => String::from_utf8(self.padded(length)).unwrap(),
                1 => self
                    .padded(length)
                    .iter()
                    .map(|byte| byte.cast_signed().to_string())
                    .collect::<Vec<_>>()
                    .join(" "),
                other => panic!("{other}"),
            };
            all.insert(name, text);
        }
        all
    }
}

/// A variable: its dimensions, attributes and values.
pub(crate) type Variable = (Vec<String>, BTreeMap<String, String>, Vec<f64>);

/// The variables of a file with this title.
pub(crate) fn netcdf(path: &Path, title: &str) -> BTreeMap<String, Variable> {
    let bytes = std::fs::read(path).unwrap();
    assert_eq!(&bytes[..3], b"CDF");
    let mut header = Header { bytes: &bytes, at: 4, wide: bytes[3] == 5 };
    assert_eq!((bytes[3], header.count(), header.word()), (2, 0, 10));
    let count = header.count();
    let dimensions: Vec<(String, usize)> = (0..count).map(|_| (header.name(), header.count())).collect();
    assert_eq!(header.attributes()["title"], title);
    assert_eq!(header.word(), 11);
    let mut variables = BTreeMap::new();
    for _ in 0..header.count() {
        let name = header.name();
        let rank = header.count();
        let ids: Vec<usize> = (0..rank).map(|_| header.count()).collect();
        let attributes = header.attributes();
        let (kind, size, begin) = (header.word(), header.count(), usize::try_from(header.long()).unwrap());
        let length: usize = ids.iter().map(|id| dimensions[*id].1).product();
        let width = match kind {
            6 => 8,
            5 => 4,
            _ => 1,
        };
        assert_eq!(size, (width * length).next_multiple_of(4), "{name}");
        let values = bytes[begin..begin + width * length].chunks_exact(width).map(|bytes| match kind {
            6 => f64::from_be_bytes(bytes.try_into().unwrap()),
            5 => f64::from(f32::from_be_bytes(bytes.try_into().unwrap())),
            1 => f64::from(bytes[0].cast_signed()),
            other => panic!("{other}"),
        });
        let names = ids.iter().map(|id| dimensions[*id].0.clone()).collect();
        variables.insert(name, (names, attributes, values.collect()));
    }
    variables
}
