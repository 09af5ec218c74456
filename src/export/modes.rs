//! STUB: stands in until the real file is merged.

use crate::error::Result;
use crate::spec::Spec;

/// Stub.
///
/// # Errors
/// Never.
pub fn modes_csv(_spec: &Spec) -> Result<Vec<u8>> {
    Ok(Vec::new())
}

/// Stub.
///
/// # Errors
/// Never.
pub fn modes_svg(_spec: &Spec) -> Result<String> {
    Ok(String::new())
}
