//! A sweep as a NetCDF classic file, which MATLAB, Julia, R and xarray read.
//!
//! 64-bit offsets (CDF-2) where every variable is below 4 GiB, else CDF-5. Every variable is one piece of the file in
//! the order of the grid, so that the file is written tile by tile.

use crate::engine::record::Record;
use crate::results::arrays::{Arrays, Coordinate, Kind, Values, Variable, flag_meanings};
use crate::sweep::sheet::Sheet;
use crate::version::VERSION;

pub(crate) const DIMENSIONS: u32 = 10;
pub(crate) const VARIABLES: u32 = 11;
pub(crate) const ATTRIBUTES: u32 = 12;
const BYTE: u32 = 1;
const CHAR: u32 = 2;
const INT: u32 = 4;
pub(crate) const FLOAT: u32 = 5;
pub(crate) const DOUBLE: u32 = 6;

/// CDF-2 holds variables of fewer bytes than this.
const LARGE: u64 = 0xFFFF_FFFC;

/// A piece of the file: where it starts, and its bytes.
pub type Piece = (u64, Vec<u8>);

/// A file.
#[derive(Clone, Debug)]
pub struct NetCdf {
    arrays: Arrays,
    title: String,
    large: bool,
    /// Where each coordinate, then each variable, starts.
    begins: Vec<u64>,
    size: u64,
}

impl NetCdf {
    /// The file of a sweep.
    #[must_use]
    pub fn new(sheet: Sheet) -> NetCdf {
        let arrays = Arrays::new(sheet);
        let instances = sheet.grid.len() as u64;
        let sizes: Vec<u64> = arrays
            .coordinates
            .iter()
            .map(|one| one.values.len() as u64 * if one.names.is_empty() { 8 } else { 4 })
            .chain(arrays.variables.iter().map(|one| match one.kind {
                Kind::Numbers => 8 * instances,
                Kind::Codes(_) => instances.next_multiple_of(4),
            }))
            .collect();
        let large = sizes.iter().any(|size| *size > LARGE);
        let title = sheet.title.to_owned();
        let mut file = NetCdf { arrays, title, large, begins: vec![0; sizes.len()], size: 0 };
        // The length of the header does not depend on what it says of the beginnings.
        let mut at = file.header(&sizes).len() as u64;
        for (begin, size) in file.begins.iter_mut().zip(&sizes) {
            *begin = at;
            at += size;
        }
        file.size = at;
        file
    }

    /// Bytes of the whole file.
    #[must_use]
    pub fn size(&self) -> u64 {
        self.size
    }

    /// Header and coordinates.
    #[must_use]
    pub fn start(&self) -> Vec<u8> {
        let next = self.begins.iter().skip(1).chain([&self.size]);
        let sizes: Vec<u64> = self.begins.iter().zip(next).map(|(begin, end)| end - begin).collect();
        let mut bytes = self.header(&sizes);
        for coordinate in &self.arrays.coordinates {
            for value in &coordinate.values {
                #[expect(
                    clippy::cast_possible_truncation,
                    reason = "numbers of names are small whole numbers"
                )]
                if coordinate.names.is_empty() {
                    bytes.extend(value.to_be_bytes());
                } else {
                    bytes.extend((*value as i32).to_be_bytes());
                }
            }
        }
        bytes
    }

    /// The pieces of the instances from `first` on.
    #[must_use]
    pub fn pieces(&self, first: usize, records: &[Record]) -> Vec<Piece> {
        let begins = &self.begins[self.arrays.coordinates.len()..];
        let piece = |(variable, begin): (&Variable, &u64)| match variable.values(records) {
            Values::Numbers(numbers) => {
                let bytes = numbers.iter().flat_map(|number| number.to_be_bytes()).collect();
                (begin + 8 * first as u64, bytes)
            }
            Values::Codes(codes) => {
                (begin + first as u64, codes.iter().flat_map(|code| code.to_be_bytes()).collect())
            }
        };
        self.arrays.variables.iter().zip(begins).map(piece).collect()
    }

    fn header(&self, sizes: &[u64]) -> Vec<u8> {
        let mut out = Writer::new(self.large);
        out.list(DIMENSIONS, self.arrays.dimensions.len());
        for (name, length) in &self.arrays.dimensions {
            out.name(name);
            out.count(*length as u64);
        }
        out.list(ATTRIBUTES, 3);
        out.text("title", &self.title);
        out.text("source", &format!("squealmap {VERSION}"));
        out.text("Conventions", "CF-1.11");
        out.list(VARIABLES, self.begins.len());
        let mut places = sizes.iter().zip(&self.begins);
        for coordinate in &self.arrays.coordinates {
            out.name(coordinate.name);
            out.count(1);
            out.count(coordinate.dimension as u64);
            let kind = out.coordinate(coordinate);
            out.place(kind, places.next());
        }
        for variable in &self.arrays.variables {
            out.name(variable.name);
            out.count(self.arrays.dimensions.len() as u64);
            (0..self.arrays.dimensions.len()).for_each(|id| out.count(id as u64));
            let kind = out.variable(variable, &self.beside());
            out.place(kind, places.next());
        }
        out.bytes
    }

    /// The coordinates that are no dimensions, which variables name.
    fn beside(&self) -> String {
        let is_dimension = |name: &str| self.arrays.dimensions.iter().any(|(one, _)| *one == name);
        let names: Vec<&str> =
            self.arrays.coordinates.iter().map(|one| one.name).filter(|name| !is_dimension(name)).collect();
        names.join(" ")
    }
}

/// Writes the parts of a header, big-endian.
pub(crate) struct Writer {
    pub(crate) bytes: Vec<u8>,
    large: bool,
}

impl Writer {
    /// The beginning of a file without records: CDF-5 for large ones, else CDF-2.
    pub(crate) fn new(large: bool) -> Writer {
        let mut out = Writer { bytes: Vec::new(), large };
        out.bytes.extend(b"CDF");
        out.bytes.push(if large { 5 } else { 2 });
        out.count(0);
        out
    }

    fn word(&mut self, word: u32) {
        self.bytes.extend(word.to_be_bytes());
    }

    /// A count, an index or a length: 64 bits in CDF-5.
    #[expect(clippy::cast_possible_truncation, reason = "below 4 GiB in CDF-2")]
    pub(crate) fn count(&mut self, count: u64) {
        if self.large {
            self.bytes.extend(count.to_be_bytes());
        } else {
            self.word(count as u32);
        }
    }

    pub(crate) fn list(&mut self, tag: u32, length: usize) {
        self.word(if length == 0 { 0 } else { tag });
        self.count(length as u64);
    }

    /// Bytes, padded to whole words.
    fn padded(&mut self, bytes: &[u8]) {
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
    }

    pub(crate) fn name(&mut self, name: &str) {
        self.count(name.len() as u64);
        self.padded(name.as_bytes());
    }

    pub(crate) fn text(&mut self, name: &str, text: &str) {
        // A text without a byte is no attribute to every reader.
        let text = if text.is_empty() { " " } else { text };
        self.name(name);
        self.word(CHAR);
        self.count(text.len() as u64);
        self.padded(text.as_bytes());
    }

    /// The attributes of a coordinate; returns its type.
    fn coordinate(&mut self, coordinate: &Coordinate) -> u32 {
        if coordinate.names.is_empty() {
            self.list(ATTRIBUTES, 2);
            self.text("long_name", coordinate.meaning);
            self.text("units", coordinate.unit);
            return DOUBLE;
        }
        self.list(ATTRIBUTES, 3);
        self.text("long_name", coordinate.meaning);
        self.name("flag_values");
        self.word(INT);
        self.count(coordinate.names.len() as u64);
        for (number, _) in (0_u32..).zip(&coordinate.names) {
            self.word(number);
        }
        self.text("flag_meanings", &flag_meanings(coordinate.names.iter().map(String::as_str)));
        INT
    }

    /// The attributes of a variable; returns its type.
    fn variable(&mut self, variable: &Variable, beside: &str) -> u32 {
        let extra = usize::from(!beside.is_empty());
        let kind = match &variable.kind {
            Kind::Numbers => {
                self.list(ATTRIBUTES, 2 + extra);
                self.text("units", variable.unit);
                DOUBLE
            }
            Kind::Codes(codes) => {
                self.list(ATTRIBUTES, 3 + extra);
                self.name("flag_values");
                self.word(BYTE);
                self.count(codes.len() as u64);
                let values: Vec<u8> = codes.iter().flat_map(|(code, _)| code.to_be_bytes()).collect();
                self.padded(&values);
                self.text("flag_meanings", &flag_meanings(codes.iter().map(|(_, name)| name.as_str())));
                BYTE
            }
        };
        self.text("long_name", variable.meaning);
        if extra > 0 {
            self.text("coordinates", beside);
        }
        kind
    }

    /// Type, size and beginning of a variable.
    pub(crate) fn place(&mut self, kind: u32, place: Option<(&u64, &u64)>) {
        let (size, begin) = place.unwrap_or((&0, &0));
        self.word(kind);
        self.count(*size);
        self.bytes.extend(begin.to_be_bytes());
    }
}
