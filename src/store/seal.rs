//! JSON documents that show when they were changed: they carry the checksum of all their other entries.

use serde_json::{Value as Json, json};

use super::identity::Id;

/// The entry with the checksum: BLAKE3 of the others in canonical form, see [`Id::of`].
const CHECKSUM: &str = "checksum";

/// The document with its checksum as the last entry.
#[must_use]
pub fn sealed(mut document: Json) -> Json {
    if let Some(entries) = document.as_object_mut() {
        entries.shift_remove(CHECKSUM);
    }
    let id = Id::of(&document);
    document[CHECKSUM] = json!(id.to_string());
    document
}

/// Whether a document has the checksum that it says; false of one that has none.
#[must_use]
pub fn is_intact(document: &Json) -> bool {
    document.get(CHECKSUM).is_some_and(|said| sealed(document.clone())[CHECKSUM] == *said)
}
