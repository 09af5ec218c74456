//! `squealmap adapters`: the GPUs of this machine.

use std::fmt::Write;

use crate::cli::talk::print;
use squealmap::engine::gpu::adapter::{Adapter, Description, MISSING_DRIVER};

/// Lists every adapter, or says what to install.
pub(crate) fn execute() {
    let found = Adapter::all();
    if found.is_empty() {
        print(&format!("no GPU was found through Vulkan, Metal or DX12; {MISSING_DRIVER}\n"));
    }
    for adapter in found {
        print(&describe(&adapter.describe()));
    }
}

/// One adapter in a few lines.
fn describe(adapter: &Description) -> String {
    const MEBIBYTE: u64 = 1 << 20;
    let yes = |has: bool| if has { "yes" } else { "no" };
    let mut text = format!("{}\n", adapter.name);
    let _ = writeln!(text, "  kind      {}, {}", adapter.device_type, adapter.api);
    let _ = writeln!(text, "  driver    {}", adapter.driver);
    let _ = writeln!(text, "  features  f64 {}, strict {}", yes(adapter.f64), yes(adapter.strict));
    let _ = writeln!(
        text,
        "  limits    {} MiB per storage binding, {} MiB per buffer, {} workgroups per dimension",
        adapter.max_binding / MEBIBYTE,
        adapter.max_buffer / MEBIBYTE,
        adapter.max_workgroups
    );
    text
}
