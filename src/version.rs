//! Which program this is.

/// The crate's version.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The git commit the crate was built from, with `-dirty` when the checkout had changes; `None` outside a checkout.
pub const COMMIT: Option<&str> = option_env!("SQUEALMAP_COMMIT");

/// Program, version and commit.
#[must_use]
pub fn program() -> String {
    let commit = COMMIT.map(|commit| format!(" ({commit})")).unwrap_or_default();
    format!("{} {VERSION}{commit}", env!("CARGO_PKG_NAME"))
}
