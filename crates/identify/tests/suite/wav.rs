//! WAV, byte by byte.

use crate::common::{at_rate, columns, csv, found, named, refused, run};
use squealmap_identify::Settings;

const CHANNELS: [&str; 5] = ["channel_1", "channel_2", "channel_3", "channel_4", "channel_5"];
const RATE: u32 = 50_000;

/// Whether the samples are floats, and their bits.
type Kind = (bool, u16);

/// A file with these samples, row by row.
fn wav((floats, bits): Kind, channels: u16, data: &[u8]) -> Vec<u8> {
    let width = channels * bits / 8;
    let mut chunk = Vec::new();
    chunk.extend(if floats { 3_u16 } else { 1 }.to_le_bytes());
    chunk.extend(channels.to_le_bytes());
    chunk.extend(RATE.to_le_bytes());
    chunk.extend((RATE * u32::from(width)).to_le_bytes());
    chunk.extend(width.to_le_bytes());
    chunk.extend(bits.to_le_bytes());
    let size = |bytes: &[u8]| u32::try_from(bytes.len()).expect("a short file").to_le_bytes();
    let mut all = b"WAVEfmt ".to_vec();
    all.extend(size(&chunk));
    all.extend(chunk);
    all.extend(b"data");
    all.extend(size(data));
    all.extend(data);
    [b"RIFF", &size(&all)[..], &all].concat()
}

/// The stroke in whole 32768ths of a full scale that holds it.
fn counts() -> Vec<[i16; 5]> {
    const FULL: [f64; 5] = [64.0, 64.0, 16.0, 32.0, 0.2];
    let columns = columns();
    #[expect(clippy::cast_possible_truncation, reason = "within full scale")]
    let count = |column: usize, row: usize| (columns[column][row] / FULL[column] * 32768.0).round() as i16;
    (0..columns[0].len()).map(|row| std::array::from_fn(|column| count(column, row))).collect()
}

fn of_kind(kind: Kind) -> Vec<u8> {
    let bytes = |count: &i16| match kind {
        (true, _) => (f32::from(*count) / 32768.0).to_le_bytes().to_vec(),
        (_, 16) => count.to_le_bytes().to_vec(),
        (_, 24) => (i32::from(*count) << 8).to_le_bytes()[..3].to_vec(),
        _ => (i32::from(*count) << 16).to_le_bytes().to_vec(),
    };
    wav(kind, 5, &counts().iter().flatten().flat_map(bytes).collect::<Vec<u8>>())
}

const KINDS: [Kind; 4] = [(false, 16), (false, 24), (false, 32), (true, 32)];

#[test]
fn every_kind_of_samples_says_what_csv_says() {
    let columns: Vec<Vec<f64>> =
        (0..5).map(|column| counts().iter().map(|row| f64::from(row[column]) / 32768.0).collect()).collect();
    let settings = named(&CHANNELS, at_rate(RATE.into()));
    let reference = found(&csv(&CHANNELS, &columns), &settings);
    for kind in KINDS {
        assert_eq!(found(&of_kind(kind), &named(&CHANNELS, Settings::default())), reference, "{kind:?}");
    }
    let said = run(&of_kind(KINDS[0]), &settings).expect("a whole record").notes;
    assert!(said.iter().any(|note| note.contains("WAV has no units")), "{said:?}");
}

#[test]
fn broken_files_end_in_a_sentence() {
    let settings = named(&CHANNELS, Settings::default());
    refused(&of_kind(KINDS[0]), &Settings::default(), &["no column `ax2`", "`channel_1`, `channel_2`"]);
    refused(&of_kind(KINDS[0]), &named(&CHANNELS, at_rate(51.2e3)), &["--rate is 51200 Hz", "50000"]);
    for kind in KINDS {
        let whole = of_kind(kind);
        refused(&whole[..whole.len() - 3], &settings, &["WAV", "ends after 599 of the 600 samples"]);
    }
    let mut long = of_kind(KINDS[0]);
    // The length of the data: nearly 4 GiB that are not there.
    long[40..44].copy_from_slice(&0xffff_fff0_u32.to_le_bytes());
    refused(&long, &settings, &["ends after 600 of the"]);
    let mut still = of_kind(KINDS[0]);
    still[24..28].fill(0);
    still[28..32].fill(0);
    refused(&still, &settings, &["0 samples per second"]);
    let mut slow = of_kind(KINDS[0]);
    let frame = u32::from(slow[32]);
    slow[24..28].copy_from_slice(&500_u32.to_le_bytes());
    slow[28..32].copy_from_slice(&(500 * frame).to_le_bytes());
    refused(&slow, &settings, &["500 samples per second", "1000 to 1000000 Hz", "correct the rate"]);
    let mut none = of_kind(KINDS[0]);
    none[22..24].fill(0);
    refused(&none, &settings, &["WAV", "zero channels", "CSV"]);
    let mut packed = of_kind(KINDS[0]);
    packed[20] = 85;
    refused(&packed, &settings, &["neither integers nor 32-bit floats"]);
    refused(&wav((true, 64), 5, &[0; 4000]), &settings, &["32-bit floats"]);
    let mut unknown = of_kind(KINDS[3]);
    unknown[44 + 20 * 7..44 + 20 * 7 + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    refused(&unknown, &settings, &["sample 8: column `channel_1` holds NaN"]);
    let mut rf64 = of_kind(KINDS[0]);
    rf64[..4].copy_from_slice(b"RF64");
    refused(&rf64, &settings, &["RF64", "less than 4 GiB"]);
}
