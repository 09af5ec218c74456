//! A sweep as a Zarr v3 group: one array per column with named dimensions, coordinates, units and codes.
//!
//! Chunks are blocks of whole rows of the grid, of at most a tile, so that each is read from its tiles alone. Chunks
//! that were not computed are left out: their fill value says so.

use std::ops::Range;

use serde_json::{Map as Object, Value as Json, json};

use crate::engine::record::Record;
use crate::results::arrays::{Arrays, Coordinate, Kind, Values, Variable, flag_meanings};
use crate::sweep::sheet::Sheet;
use crate::version::{COMMIT, VERSION};

/// The file of a group's or an array's metadata.
pub const METADATA: &str = "zarr.json";

/// A file of the group: its path below the group, with `/`, and its bytes.
pub type File = (String, Vec<u8>);

/// A group.
#[derive(Clone, Debug)]
pub struct Zarr {
    arrays: Arrays,
    title: String,
    /// The shape of a chunk.
    chunk: Vec<usize>,
}

impl Zarr {
    /// The group of a sweep with chunks of at most `most` instances.
    #[must_use]
    pub fn new(sheet: Sheet, most: usize) -> Zarr {
        let arrays = Arrays::new(sheet);
        let mut room = most.max(1);
        let mut chunk: Vec<usize> = arrays
            .dimensions
            .iter()
            .rev()
            .map(|(_, length)| {
                let taken = room.min(*length).max(1);
                // Once a dimension is cut, those before it have one value in a chunk.
                room = if taken == *length { room / taken } else { 1 };
                taken
            })
            .collect();
        chunk.reverse();
        Zarr { arrays, title: sheet.title.to_owned(), chunk }
    }

    /// Everything but the chunks of variables.
    #[must_use]
    pub fn files(&self) -> Vec<File> {
        let mut files = Vec::new();
        let mut members = Object::new();
        for coordinate in &self.arrays.coordinates {
            let numbers = coordinate.names.is_empty();
            let metadata = self.coordinate(coordinate);
            let bytes = coordinate.values.iter().flat_map(|value| number(*value, numbers)).collect();
            files.push((format!("{}/c/0", coordinate.name), bytes));
            members.insert(coordinate.name.to_owned(), metadata);
        }
        for variable in &self.arrays.variables {
            members.insert(variable.name.to_owned(), self.variable(variable));
        }
        for (name, metadata) in &members {
            files.push((format!("{name}/{METADATA}"), metadata.to_string().into_bytes()));
        }
        let group = json!({
            "zarr_format": 3,
            "node_type": "group",
            "attributes": {
                "title": self.title,
                "source": format!("squealmap {VERSION}{}", COMMIT.map(|id| format!(" ({id})")).unwrap_or_default()),
                "Conventions": "CF-1.11",
            },
            "consolidated_metadata": { "kind": "inline", "must_understand": false, "metadata": members },
        });
        files.push((METADATA.to_owned(), group.to_string().into_bytes()));
        files
    }

    /// The number of chunks of each variable.
    #[must_use]
    pub fn chunks(&self) -> usize {
        self.grid().into_iter().product()
    }

    /// The instances of chunk `number`, which are consecutive.
    #[must_use]
    pub fn bounds(&self, number: usize) -> Range<usize> {
        let (mut first, mut count) = (0, 1);
        for ((place, chunk), (_, length)) in
            self.place(number).into_iter().zip(&self.chunk).zip(&self.arrays.dimensions)
        {
            first = first * length + place * chunk;
            count *= (*chunk).min(length - place * chunk);
        }
        first..first + count
    }

    /// Chunk `number` of all variables from the records of its [`Zarr::bounds`].
    #[must_use]
    pub fn chunk(&self, number: usize, records: &[Record]) -> Vec<File> {
        let whole: usize = self.chunk.iter().product();
        let key: Vec<String> = self.place(number).iter().map(ToString::to_string).collect();
        let file = |variable: &Variable| {
            let missing = variable.values(&[Record::NOT_COMPUTED]);
            let padding = whole - records.len();
            let mut bytes = little(&variable.values(records));
            // A chunk at the end of a dimension has its full length all the same.
            bytes.extend(little(&missing).repeat(padding));
            (format!("{}/c/{}", variable.name, key.join("/")), bytes)
        };
        self.arrays.variables.iter().map(file).collect()
    }

    /// Chunks along each dimension.
    fn grid(&self) -> Vec<usize> {
        self.arrays
            .dimensions
            .iter()
            .zip(&self.chunk)
            .map(|((_, length), chunk)| length.div_ceil(*chunk))
            .collect()
    }

    /// Where chunk `number` stands among the chunks.
    fn place(&self, number: usize) -> Vec<usize> {
        let mut rest = number;
        let mut place: Vec<usize> = self
            .grid()
            .into_iter()
            .rev()
            .map(|count| {
                let at = rest % count;
                rest /= count;
                at
            })
            .collect();
        place.reverse();
        place
    }

    fn variable(&self, variable: &Variable) -> Json {
        let shape: Vec<usize> = self.arrays.dimensions.iter().map(|(_, length)| *length).collect();
        let names: Vec<&str> = self.arrays.dimensions.iter().map(|(name, _)| *name).collect();
        let (data_type, fill) = match variable.values(&[Record::NOT_COMPUTED]) {
            Values::Numbers(_) => ("float64", json!("NaN")),
            Values::Codes(codes) => ("int8", json!(codes[0])),
        };
        let mut attributes = attributes(variable.meaning, variable.unit);
        if let Kind::Codes(codes) = &variable.kind {
            attributes.remove("units");
            let values: Vec<i8> = codes.iter().map(|(code, _)| *code).collect();
            attributes.insert("flag_values".to_owned(), json!(values));
            let meanings = flag_meanings(codes.iter().map(|(_, name)| name.as_str()));
            attributes.insert("flag_meanings".to_owned(), json!(meanings));
        }
        // Coordinates that are no dimensions belong to the variables.
        let beside: Vec<&str> =
            self.arrays.coordinates.iter().map(|one| one.name).filter(|name| !names.contains(name)).collect();
        if !beside.is_empty() {
            attributes.insert("coordinates".to_owned(), json!(beside.join(" ")));
        }
        array(&shape, &self.chunk, &names, [data_type.into(), fill], &attributes)
    }

    fn coordinate(&self, coordinate: &Coordinate) -> Json {
        let (name, length) = self.arrays.dimensions[coordinate.dimension];
        let mut attributes = attributes(coordinate.meaning, coordinate.unit);
        let data_type = if coordinate.names.is_empty() {
            ["float64".into(), json!("NaN")]
        } else {
            attributes.remove("units");
            let values: Vec<usize> = (0..coordinate.names.len()).collect();
            attributes.insert("flag_values".to_owned(), json!(values));
            let meanings = flag_meanings(coordinate.names.iter().map(String::as_str));
            attributes.insert("flag_meanings".to_owned(), json!(meanings));
            ["int32".into(), json!(-1)]
        };
        array(&[length], &[length], &[name], data_type, &attributes)
    }
}

fn attributes(meaning: &str, unit: &str) -> Object<String, Json> {
    Object::from_iter([("long_name".to_owned(), json!(meaning)), ("units".to_owned(), json!(unit))])
}

/// The metadata of an array: type and fill value, little-endian, not compressed.
fn array(
    shape: &[usize],
    chunk: &[usize],
    names: &[&str],
    [data_type, fill]: [Json; 2],
    attributes: &Object<String, Json>,
) -> Json {
    let codec = if data_type == "int8" {
        json!({ "name": "bytes" })
    } else {
        json!({ "name": "bytes", "configuration": { "endian": "little" } })
    };
    json!({
        "zarr_format": 3,
        "node_type": "array",
        "shape": shape,
        "data_type": data_type,
        "chunk_grid": { "name": "regular", "configuration": { "chunk_shape": chunk } },
        "chunk_key_encoding": { "name": "default", "configuration": { "separator": "/" } },
        "fill_value": fill,
        "codecs": [codec],
        "attributes": attributes,
        "dimension_names": names,
    })
}

fn little(values: &Values) -> Vec<u8> {
    match values {
        Values::Numbers(numbers) => numbers.iter().flat_map(|number| number.to_le_bytes()).collect(),
        Values::Codes(codes) => codes.iter().flat_map(|code| code.to_le_bytes()).collect(),
    }
}

/// A value of a coordinate: f64, or the i32 number of a name.
#[expect(clippy::cast_possible_truncation, reason = "numbers of names are small whole numbers")]
fn number(value: f64, is_number: bool) -> Vec<u8> {
    if is_number { value.to_le_bytes().to_vec() } else { (value as i32).to_le_bytes().to_vec() }
}
