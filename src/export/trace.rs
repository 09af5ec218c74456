//! STUB: stands in until the real file is merged.

use crate::error::Result;
use crate::trace::Trace;

/// Stub.
///
/// # Errors
/// Never.
pub fn trace_csv(_trace: &Trace) -> Result<Vec<u8>> {
    Ok(Vec::new())
}

/// Stub.
///
/// # Errors
/// Never.
pub fn trace_svg(_trace: &Trace, _title: &str) -> Result<String> {
    Ok(String::new())
}
