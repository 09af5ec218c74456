//! What is answered: a JSON object, and numbers beside it.

use serde_json::Value as Json;

/// A JSON object, and numbers beside it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answer {
    /// Says what the numbers are.
    pub head: Json,
    /// Arrays one after the other; NaN is an undefined value.
    pub numbers: Vec<f64>,
    /// Bytes for a device, behind the numbers.
    pub bytes: Vec<u8>,
}

impl Answer {
    /// An answer in words alone.
    #[must_use]
    pub fn of(head: Json) -> Answer {
        Answer { head, ..Answer::default() }
    }

    /// As bytes, little-endian: the length of the head as u32, four bytes of zero, the head, spaces up to the next multiple of eight, the
    /// numbers, the bytes.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut head = self.head.to_string().into_bytes();
        head.resize(head.len().next_multiple_of(8), b' ');
        let mut bytes = Vec::with_capacity(8 + head.len() + 8 * self.numbers.len() + self.bytes.len());
        bytes.extend((head.len() as u64).to_le_bytes());
        bytes.extend(head);
        bytes.extend(self.numbers.iter().flat_map(|number| number.to_le_bytes()));
        bytes.extend_from_slice(&self.bytes);
        bytes
    }

    /// A sentence instead of an answer: `{ "error": … }`.
    #[must_use]
    pub fn error(sentence: &str) -> Answer {
        Answer::of(serde_json::json!({ "error": sentence }))
    }
}
