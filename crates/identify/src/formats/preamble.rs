//! Lines before the header of a table, as recorders write them: what was tested, when, by whom.

/// The separators that are told apart by the header.
pub(super) const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

/// Turns the lines before a header into comments, and gives how many that were. The header is the line above the first row of numbers, with a
/// row of units between them perhaps, that has as many fields; where the first line has as many, or nothing is sure, there is no preamble.
pub(super) fn commented(start: &mut [u8]) -> usize {
    let lines = lines(start);
    let Some(header) = SEPARATORS.iter().find_map(|separator| header(start, &lines, *separator)) else {
        return 0;
    };
    let mut turned = 0;
    for [from, to] in &lines[..header] {
        if from < to && start[*from] != b'#' {
            start[*from] = b'#';
            turned += 1;
        }
    }
    turned
}

/// The ends of the lines, but for the last one, which may be cut off.
fn lines(start: &[u8]) -> Vec<[usize; 2]> {
    let mut from = 0;
    let ends = start.iter().enumerate().filter(|(_, byte)| **byte == b'\n').map(|(at, _)| at);
    ends.map(|end| [std::mem::replace(&mut from, end + 1), end]).collect()
}

/// The number of the line that is the header below a preamble.
fn header(start: &[u8], lines: &[[usize; 2]], separator: u8) -> Option<usize> {
    /// Lines among which the first row of numbers is looked for.
    const MOST: usize = 200;
    let line = |number: usize| &start[lines[number][0]..lines[number][1]];
    let fields = |number: usize| line(number).split(|byte| *byte == separator).map(<[u8]>::trim_ascii);
    let is_text =
        |number: usize| !line(number).is_empty() && line(number)[0] != b'#' && !fields(number).all(is_number);
    let first = (0..lines.len().min(MOST)).find(|number| {
        let mut fields = fields(*number);
        fields.clone().count() > 1 && fields.all(is_number)
    })?;
    let count = fields(first).count();
    let above = (0..first).rev().take_while(|number| is_text(*number) && fields(*number).count() == count);
    let top = above.take(2).last()?;
    (top > 0 && fields(0).count() != count).then_some(top)
}

/// Whether a field is a number, with a decimal comma perhaps.
pub(super) fn is_number(field: &[u8]) -> bool {
    let text = String::from_utf8_lossy(field).replacen(',', ".", 1);
    text.parse::<f64>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::commented;

    #[test]
    fn a_preamble_ends_at_the_header() {
        for (text, expected) in [
            ("t,a\n0,1\n1,2\n", 0),
            ("Test: brake 7\nt,a\n0,1\n", 1),
            ("Test: brake 7\n\nDate;2026-01-02;x\nt;a\ns;m/s²\n0,5;1,25\n", 2),
            ("# said\nt\ta\n0\t1\n", 0),
            // Nothing above has as many fields; nothing below is of numbers.
            ("Test\nt,a,b\n0,1\n", 0),
            ("Test\nt,a\nx,y\n", 0),
            ("t,\"a, b\"\n0,1\n", 0),
        ] {
            let mut bytes = text.as_bytes().to_vec();
            assert_eq!(commented(&mut bytes), expected, "{text}");
            let kept = String::from_utf8(bytes).expect("text");
            let turned = text.lines().zip(kept.lines()).filter(|(before, after)| before != after);
            assert!(turned.clone().all(|(_, after)| after.starts_with('#')), "{kept}");
            assert_eq!((turned.count(), kept.len()), (expected, text.len()), "{kept}");
        }
    }
}
