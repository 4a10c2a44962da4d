//! The passes. Each keeps its outputs until what they were made from changes: the bytes of the uniforms it binds, and
//! the outputs it reads.

pub(crate) mod aerial;
pub(crate) mod cloud_air;
pub(crate) mod cloud_curl;
pub(crate) mod cloud_detail;
pub(crate) mod cloud_dome;
pub(crate) mod cloud_dome_light;
pub(crate) mod cloud_probe;
pub(crate) mod cloud_shadow;
pub(crate) mod cloud_shape;
pub(crate) mod cloud_sheet;
pub(crate) mod cloud_view;
pub(crate) mod cloud_view_light;
pub(crate) mod cloud_volume;
pub(crate) mod cloud_weather;
pub(crate) mod exposure;
pub(crate) mod ground_light;
pub(crate) mod ground_shadow;
pub(crate) mod ground_sky;
pub(crate) mod ground_view;
pub(crate) mod lamp_heights;
pub(crate) mod multi_scattering;
pub(crate) mod pillar_polar;
pub(crate) mod pillar_shares;
pub(crate) mod pillars;
pub(crate) mod probe;
pub(crate) mod shafts;
pub(crate) mod sky;
pub(crate) mod sky_view;
pub(crate) mod stars;
pub(crate) mod tone;
pub(crate) mod transmittance;

use crate::memo::Fingerprint;

/// A texture that a pass wrote, with the fingerprint of what it was made from.
pub(crate) struct Table {
    pub(crate) view: wgpu::TextureView,
    pub(crate) made_from: Fingerprint,
}
