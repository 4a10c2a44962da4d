//! From a request to the bytes of a file, rendered once for all who ask for it.

use crate::{
    error::{Error, Fault},
    metrics::Source,
    state::{Held, Service, bytes_per_pixel},
};
use bytes::Bytes;
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::{collections::BTreeMap, sync::Arc, time::Duration};
use tokio::sync::OwnedSemaphorePermit;
use welkin_encode::{Options, encode, output_for};
use welkin_scene::{
    HeightGrid, MeshModel, SceneAssets, WeatherPicture,
    frame::{Format, FrameRequest},
    renderer::{FrameFacts, FrameOrder, PassTime, Priority},
};

/// A file larger than this share of the cache would push out all the others, and is not kept.
const LARGEST_SHARE: u64 = 8;

/// A request whose format is settled, with the assets that it names, and its fingerprint.
pub(crate) struct Asked {
    pub(crate) request: FrameRequest,
    assets: Arc<SceneAssets>,
    pub(crate) format: Format,
    pub(crate) key: [u8; 32],
}

/// A file with what its headers tell.
pub(crate) struct Picture {
    pub(crate) bytes: Bytes,
    pub(crate) passes: Vec<PassTime>,
    /// From the order to the frame, the queue included.
    pub(crate) rendering: Duration,
    pub(crate) encoding: Duration,
    pub(crate) facts: FrameFacts,
}

/// A large file keeps its share of the memory budget until the last byte is sent.
struct Budgeted {
    bytes: Vec<u8>,
    _memory: OwnedSemaphorePermit,
}

impl AsRef<[u8]> for Budgeted {
    fn as_ref(&self) -> &[u8] {
        &self.bytes
    }
}

impl Asked {
    /// Settles the format and checks the size against what `service` renders.
    pub(crate) fn new(
        service: &Service,
        request: FrameRequest,
        assets: Arc<SceneAssets>,
        format: Format,
    ) -> Result<Self, Error> {
        let request = FrameRequest {
            format: Some(format),
            ..request
        };
        check_size(service, &request, format)?;
        #[derive(Serialize)]
        struct Canonical<'a> {
            request: &'a FrameRequest,
            assets: [BTreeMap<&'a str, String>; 3],
            build: &'a str,
            device: [&'a str; 3],
        }
        let device = service.renderer.device();
        let canonical = Canonical {
            request: &request,
            assets: [
                digests(&assets.weather_maps, WeatherPicture::digest_hex),
                digests(&assets.heightfields, HeightGrid::digest_hex),
                digests(&assets.meshes, MeshModel::digest_hex),
            ],
            build: &service.settings.build,
            device: [&device.adapter, &device.backend, &device.driver],
        };
        let json = serde_json::to_vec(&canonical).map_err(|e| Error::Internal { cause: e.to_string() })?;
        Ok(Self {
            key: Sha256::digest(json).into(),
            request,
            assets,
            format,
        })
    }

    /// The entity tag, quotes included: same request, assets, build and device, same bytes.
    pub(crate) fn etag(&self) -> String {
        let hex: String = self.key[..16].iter().map(|byte| format!("{byte:02x}")).collect();
        format!("\"{hex}\"")
    }
}

/// The content of each asset by its name.
fn digests<T>(assets: &BTreeMap<String, Arc<T>>, hex: impl Fn(&T) -> String) -> BTreeMap<&str, String> {
    assets
        .iter()
        .map(|(name, asset)| (name.as_str(), hex(asset)))
        .collect()
}

impl Service {
    /// The file asked for, kept or new. Who asks for the same meanwhile waits for the same; when all are gone,
    /// the order is cancelled.
    pub(crate) async fn picture(&self, asked: &Asked) -> Result<(Arc<Picture>, Source), Error> {
        let making = async { self.make(asked).await.map(Arc::new) };
        let entry = self
            .pictures
            .entry_by_ref(&asked.key)
            .or_try_insert_with(making)
            .await;
        let entry = entry.map_err(|error: Arc<Error>| (*error).clone())?;
        let source = if entry.is_fresh() {
            Source::Rendered
        } else {
            Source::Cache
        };
        let picture = entry.into_value();
        if self.is_large(picture.bytes.len()) {
            self.pictures.invalidate(&asked.key).await;
            self.pictures.run_pending_tasks().await;
        }
        Ok((picture, source))
    }

    async fn make(&self, asked: &Asked) -> Result<Picture, Error> {
        let Asked {
            request,
            assets,
            format,
            ..
        } = asked;
        let order = FrameOrder {
            scene: Arc::new(request.scene.clone()),
            assets: Arc::clone(assets),
            width_px: request.width_px,
            height_px: request.height_px,
            quality: request.quality,
            output: output_for(*format),
            priority: Priority::Interactive,
        };
        let Held {
            frame,
            memory,
            took: rendering,
        } = self.render(order).await?;
        let (passes, facts) = (frame.passes.clone(), frame.facts);
        let options = Options {
            software: format!("Welkin {}", self.settings.build),
            scene_json: serde_json::to_string(&request.scene).ok(),
            ..Options::default()
        };
        let format = *format;
        let file = move || encode(&frame, format, &options);
        let (bytes, encoding) = self.encode(format, file).await?;
        let bytes = if self.is_large(bytes.len()) {
            Bytes::from_owner(Budgeted {
                bytes,
                _memory: memory,
            })
        } else {
            bytes.into()
        };
        Ok(Picture {
            bytes,
            passes,
            rendering,
            encoding,
            facts,
        })
    }

    fn is_large(&self, bytes: usize) -> bool {
        bytes as u64 > self.settings.cache_bytes / LARGEST_SHARE
    }
}

fn check_size(service: &Service, request: &FrameRequest, format: Format) -> Result<(), Error> {
    let settings = &service.settings;
    let pixels = u64::from(request.width_px) * u64::from(request.height_px);
    let most = settings
        .max_frame_pixels
        .min(settings.frame_memory_bytes / bytes_per_pixel(output_for(format)));
    if pixels <= most {
        return Ok(());
    }
    let (width_px, height_px) = largest_of_shape(request.width_px, request.height_px, most);
    let fault = |field: &str, side: u32, largest: u32| {
        let message = format!(
            "`{field}` is too large: a frame may have {most} pixels here, {width_px} x {height_px} in this shape"
        );
        Fault::field(
            format!("/{field}"),
            side.into(),
            format!("at most {largest} in this shape"),
            message,
        )
    };
    Err(Error::FrameTooLarge(vec![
        fault("width_px", request.width_px, width_px),
        fault("height_px", request.height_px, height_px),
    ]))
}

/// The largest size of about the same shape with no more than `most` pixels.
fn largest_of_shape(width_px: u32, height_px: u32, most: u64) -> (u32, u32) {
    let shrunk = |side: u32| {
        let square = u128::from(side).pow(2) * u128::from(most)
            / (u128::from(width_px) * u128::from(height_px)).max(1);
        u32::try_from(square.isqrt()).unwrap_or(u32::MAX).max(1)
    };
    (shrunk(width_px), shrunk(height_px))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_size_fits_and_a_little_more_does_not() {
        for (width_px, height_px, most) in [(16_384, 16_384, 1 << 20), (4000, 1000, 999_999), (1280, 720, 7)]
        {
            let (w, h) = largest_of_shape(width_px, height_px, most);
            assert!(u64::from(w) * u64::from(h) <= most);
            assert!(u64::from(w + 1) * u64::from(h + 1) > most);
        }
    }
}
