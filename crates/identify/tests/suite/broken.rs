//! What is no record, and records with any byte changed: a sentence, never a panic.

use crate::common::{RATE, at_rate, record, refused, run};
use squealmap_identify::{Fault, Settings, Unread};

#[test]
fn kinds_that_are_not_read_are_named_with_what_to_do() {
    let settings = Settings::default();
    let mut hdf = b"MATLAB 7.3 MAT-file, Platform: GLNXA64".to_vec();
    hdf.resize(512, b' ');
    hdf.extend(b"\x89HDF\r\n\x1a\n");
    let words = |words: [u32; 5]| words.map(u32::to_le_bytes).concat();
    let wide: Vec<u8> = "t,ax2\n0,1\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    for (bytes, parts) in [
        (hdf, ["MAT file of version 7.3", "save it with -v7"]),
        (b"\x89HDF\r\n\x1a\n".to_vec(), ["HDF5", "CSV"]),
        (words([0, 600, 1, 0, 4]), ["version 4", "save it with -v7"]),
        (b"PK\x03\x04\x14".to_vec(), ["workbook", "CSV"]),
        (b"\x1f\x8b\x08".to_vec(), ["gzip", "unpack it"]),
        (b"\x00\x01\x02\x03".to_vec(), ["none of WAV, MAT, UFF 58 and TDMS", "CSV"]),
        (wide, ["no text", "UTF-8"]),
    ] {
        refused(&bytes, &settings, &parts);
        let fault = *run(&bytes, &settings).expect_err("a fault").fault;
        assert!(matches!(fault, Fault::Unread(Unread::Kind { .. })), "{fault}");
    }
}

#[test]
fn any_changed_byte_or_end_is_no_panic() {
    for name in ["ascii_58.uff", "binary_58b.uff", "columns_v7.mat", "matrix_v6.mat", "stroke.tdms"] {
        let whole = record(name);
        let mut refused = 0;
        for at in (0..600).step_by(3).chain((600..whole.len()).step_by(4001)) {
            for changed in [0xff, whole[at] ^ 0x80, whole[at].wrapping_add(1)] {
                let mut bytes = whole.clone();
                bytes[at] = changed;
                refused += usize::from(run(&bytes, &at_rate(RATE)).is_err());
            }
            refused += usize::from(run(&whole[..at], &at_rate(RATE)).is_err());
        }
        assert!(refused > 200, "{name}: {refused}");
    }
}

#[test]
fn a_file_without_a_header_is_told_as_such() {
    for nothing in ["", "\n\n", "# a remark\n", ",,\n1,2,3\n"] {
        refused(
            nothing.as_bytes(),
            &Settings::default(),
            &["holds no header", "give a CSV file with a header"],
        );
    }
}
