//! Pipelines from the linked WGSL. The layouts come from the shaders themselves.

/// A linked and validated shader.
pub(crate) struct Shader {
    pub(crate) name: &'static str,
    pub(crate) wgsl: &'static str,
    pub(crate) workgroup: [u32; 3],
    pub(crate) bindings: &'static [Kind],
}

/// What stands at a binding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Uniform,
    Read,
    Write,
    Sampler,
    Table,
    TableLayers,
    Volume,
    WriteTable(Texel),
    WriteTableLayers(Texel),
    WriteVolume(Texel),
}

/// What a texture that shaders write holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Texel {
    /// Four 32-bit floats where the device filters them, else half floats.
    Float,
    /// One 32-bit float where the device filters them, else the first of four half floats: single ones are not written.
    Single,
    /// Four bytes from 0 to 1.
    Byte,
}

include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
