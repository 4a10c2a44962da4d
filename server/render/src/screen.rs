//! The buffers of one tile.

use crate::{gpu::Gpu, memo::Fingerprint, passes::exposure::EXPOSURE_BYTES};
use wgpu::BufferUsages as Usage;

/// Bytes of one pixel of radiance: four floats.
pub(crate) const RADIANCE_BYTES: u64 = 16;
/// Bytes of one pixel of the picture: R, G, B, A.
pub(crate) const PICTURE_BYTES: u64 = 4;

pub(crate) struct Buffers {
    pub(crate) radiance: wgpu::Buffer,
    pub(crate) picture: wgpu::Buffer,
    /// The light of the ground that the radiance was made with.
    pub(crate) ground: Option<wgpu::Buffer>,
    /// Such light, readable.
    pub(crate) ground_staging: Option<wgpu::Buffer>,
    /// Either of them, readable.
    pub(crate) staging: wgpu::Buffer,
    /// The exposure, readable.
    pub(crate) exposure: wgpu::Buffer,
    pub(crate) pixels: u64,
    /// What the radiance was made from.
    pub(crate) holds: Option<Fingerprint>,
    /// What a picture was made from whose radiance was not kept.
    pub(crate) shown: Option<Fingerprint>,
}

/// Buffers for tiles, made when the first is asked for and again when a larger one is.
#[derive(Default)]
pub(crate) struct Screen(Option<Buffers>);

impl Screen {
    pub(crate) fn fit(&mut self, gpu: &Gpu, pixels: u64) -> &mut Buffers {
        let kept = self.0.take().filter(|b| b.pixels >= pixels);
        self.0.insert(kept.unwrap_or_else(|| {
            let readable = Usage::COPY_DST | Usage::MAP_READ;
            Buffers {
                radiance: gpu.buffer(
                    "radiance",
                    RADIANCE_BYTES * pixels,
                    Usage::STORAGE | Usage::COPY_SRC,
                ),
                picture: gpu.buffer(
                    "picture",
                    PICTURE_BYTES * pixels,
                    Usage::STORAGE | Usage::COPY_SRC,
                ),
                staging: gpu.buffer("staging", RADIANCE_BYTES * pixels, readable),
                exposure: gpu.buffer("exposure", EXPOSURE_BYTES, readable),
                ground: None,
                ground_staging: None,
                pixels,
                holds: None,
                shown: None,
            }
        }))
    }
}
