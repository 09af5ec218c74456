//! Where rows of numbers come from: CSV, or a file as recorders and their programs write it. The first bytes tell which.

mod held;
mod mat;
mod numbers;
mod preamble;
mod source;
mod tdms;
mod text;
mod uff;
mod wav;

use std::io::{BufReader, Cursor, Read};

use crate::fault::Fault;
use crate::unread::Unread;
use held::Held;
use text::{BUFFER, Text};
use wav::Wav;

pub(crate) use source::{Clock, Source};

/// Bytes by which a format is told.
const HEAD: usize = 512;
/// The end of every remedy.
const AS_CSV: &str = "export it as CSV";

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Csv,
    Wav,
    Mat,
    Uff,
    Tdms,
    /// One that is not read: what it is and what to do.
    Other(&'static str, &'static str),
}

/// Opens a file by its first bytes.
pub(crate) fn open(input: Box<dyn Read>) -> Result<Box<dyn Source>, Fault> {
    let unreadable = |why: std::io::Error| Fault::Unreadable { why: why.to_string() };
    let mut input = input;
    let mut start = Vec::new();
    input.by_ref().take(BUFFER as u64).read_to_end(&mut start).map_err(unreadable)?;
    let format = told(&start);
    if format == Format::Csv {
        return Ok(Box::new(Text::open(start, input)?));
    }
    let all: Box<dyn Read> = Box::new(Cursor::new(start).chain(input));
    let mut all = BufReader::with_capacity(BUFFER, all);
    let broken = |format, remedy| move |why| Unread::Broken { format, why, remedy };
    let columns = match format {
        Format::Csv | Format::Wav => return Ok(Box::new(Wav::open(all)?)),
        Format::Mat => mat::columns(&mut all)
            .map_err(broken("MAT", "save columns of numbers with -v7, or export them as CSV"))?,
        Format::Uff => uff::columns(&mut all)
            .map_err(broken("universal (UFF)", "export time responses as dataset 58 anew, or as CSV"))?,
        Format::Tdms => tdms::columns(&mut all).map_err(broken("TDMS", AS_CSV))?,
        Format::Other(what, remedy) => return Err(Unread::Kind { what, remedy }.into()),
    };
    Ok(Box::new(Held::new(columns)))
}

/// What a file is that begins so.
fn told(start: &[u8]) -> Format {
    const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";
    const AS_WAV: &str = "save it as a WAV file of less than 4 GiB, or export it as CSV";
    let begins = |bytes: &[u8]| start.starts_with(bytes);
    let at = |from: usize, bytes: &[u8]| start.get(from..).is_some_and(|rest| rest.starts_with(bytes));
    let line = start.split(|byte| *byte == b'\n').find(|line| !line.trim_ascii().is_empty());
    if begins(b"RIFF") && at(8, b"WAVE") {
        return Format::Wav;
    }
    if begins(b"RF64") || begins(b"riff") || begins(b"RIFX") {
        return Format::Other("a WAV file of an unusual kind (RF64, Wave64 or RIFX)", AS_WAV);
    }
    if begins(b"TDSm") {
        return Format::Tdms;
    }
    if begins(b"TDSh") {
        return Format::Other("the index of a TDMS file", "give the file that ends in .tdms");
    }
    if begins(b"MATLAB 7.3") || (begins(b"MATLAB") && at(HEAD, HDF5)) {
        return Format::Other("a MAT file of version 7.3 (HDF5)", "save it with -v7, or export it as CSV");
    }
    if begins(HDF5) {
        return Format::Other("an HDF5 file", "save it as MAT with -v7, or export it as CSV");
    }
    if at(mat::HEADER - 4, b"\x00\x01IM") || at(mat::HEADER - 4, b"\x01\x00MI") {
        return Format::Mat;
    }
    if is_mat_4(start) {
        return Format::Other("a MAT file of version 4", "save it with -v7, or export it as CSV");
    }
    if line.is_some_and(|line| line.trim_ascii() == uff::DELIMITER) {
        return Format::Uff;
    }
    if begins(b"PK\x03\x04") {
        return Format::Other("a zip archive or a workbook", "unpack it, or save its sheet as CSV");
    }
    if begins(b"\x1f\x8b") {
        return Format::Other("a gzip archive", "unpack it");
    }
    if start[..start.len().min(HEAD)].contains(&0) {
        let what = "no text, and none of WAV, MAT, UFF 58 and TDMS";
        return Format::Other(what, "save it as CSV in UTF-8");
    }
    Format::Csv
}

/// Whether a file begins as version 4 of MAT does: type, rows, columns, whether complex, and the length of a name.
fn is_mat_4(start: &[u8]) -> bool {
    let word = |at: usize| start.get(at..)?.first_chunk().map(|bytes| u32::from_le_bytes(*bytes));
    let [Some(kind), Some(rows), Some(columns), Some(complex), Some(name)] = [0, 4, 8, 12, 16].map(word)
    else {
        return false;
    };
    kind < 100 && kind % 10 == 0 && rows > 0 && columns > 0 && complex < 2 && (2..64).contains(&name)
}
