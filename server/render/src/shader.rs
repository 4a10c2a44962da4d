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

/// What a texture that shaders write holds: four of these a texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Texel {
    /// 32-bit floats where the device filters them, else half floats.
    Float,
    /// Bytes from 0 to 1.
    Byte,
}

include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
