//! STUB: stands in until the real file is merged.

use crate::error::Result;

/// Stub.
///
/// # Errors
/// Never.
pub fn render(_svg: &str) -> Result<Vec<u8>> {
    Ok(Vec::new())
}
