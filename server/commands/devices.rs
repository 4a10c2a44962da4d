//! `welkin devices`

use super::{Failure, document};
use serde_json::json;

/// Lists the adapters.
///
/// # Errors
/// Where there is none.
pub(crate) fn run(json: bool) -> Result<(), Failure> {
    let adapters = crate::adapters();
    if json {
        document::print(&json!(adapters), true)?;
    } else {
        let line = |a: &welkin_scene::renderer::DeviceInfo| {
            format!("{} ({}, {}, {})\n", a.adapter, a.kind, a.backend, a.driver)
        };
        document::print_text(&adapters.iter().map(line).collect::<String>())?;
    }
    if adapters.is_empty() {
        Err(Failure::Device("no graphics adapter was found; install a Vulkan driver (on Debian: mesa-vulkan-drivers libvulkan1)".into()))
    } else {
        Ok(())
    }
}
