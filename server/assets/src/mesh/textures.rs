//! Pictures on meshes: PNG or JPEG.

use crate::{
    Error,
    bundle::shown,
    png_file::{self, MAX_SIDE_PX},
};
use jpeg_decoder::{Decoder, PixelFormat};
use std::collections::HashMap;
use welkin_scene::Texture;

/// All textures of a mesh in memory, bytes.
pub(super) const MOST_TEXTURE_BYTES: u64 = 256 << 20;

/// The textures of a mesh, each once however many materials name it.
#[derive(Default)]
pub(super) struct Textures {
    pub(super) all: Vec<Texture>,
    known: HashMap<String, usize>,
    bytes: u64,
}

impl Textures {
    /// The place of a texture, which is read where it is named for the first time.
    pub(super) fn place(
        &mut self,
        name: &str,
        file: impl FnOnce() -> Result<Vec<u8>, Error>,
    ) -> Result<usize, Error> {
        if let Some(&place) = self.known.get(name) {
            return Ok(place);
        }
        let within = |error: Error| match error {
            Error::Damaged { reason } => Error::damaged(format!("the texture {}: {reason}", shown(name))),
            Error::Side { width_px, height_px } => Error::refused(format!(
                "the texture {} has {width_px} x {height_px} pixels: {MAX_SIDE_PX} a side may be",
                shown(name)
            )),
            other => other,
        };
        let texture = self.read(name, &file()?).map_err(within)?;
        self.all.push(texture);
        self.known.insert(name.to_owned(), self.all.len() - 1);
        Ok(self.all.len() - 1)
    }

    /// What a texture was named when it was read.
    pub(super) fn name_of(&self, place: usize) -> &str {
        let mut known = self.known.iter();
        known.find(|(_, of)| **of == place).map_or("", |(name, _)| name)
    }

    fn read(&mut self, name: &str, file: &[u8]) -> Result<Texture, Error> {
        if file.starts_with(b"\x89PNG") {
            let facts = png_file::facts(file)?;
            self.make_room(facts.width_px, facts.height_px)?;
            return Ok(Texture {
                width_px: facts.width_px,
                height_px: facts.height_px,
                rgba: png_file::rgba(file)?.into(),
            });
        }
        if !file.starts_with(&[0xff, 0xd8]) {
            return Err(Error::refused(format!(
                "the texture {} is neither PNG nor JPEG",
                shown(name)
            )));
        }
        let mut decoder = Decoder::new(file);
        decoder.read_info().map_err(Error::damaged)?;
        let info = decoder.info().ok_or_else(|| Error::damaged("it has no header"))?;
        let (width_px, height_px) = (u32::from(info.width), u32::from(info.height));
        self.make_room(width_px, height_px)?;
        let samples = decoder.decode().map_err(Error::damaged)?;
        let opaque = |rgb: [u8; 3]| [rgb[0], rgb[1], rgb[2], u8::MAX];
        let rgba: Vec<u8> = match info.pixel_format {
            PixelFormat::L8 => samples.iter().flat_map(|&grey| opaque([grey; 3])).collect(),
            PixelFormat::RGB24 => samples
                .as_chunks::<3>()
                .0
                .iter()
                .flat_map(|&rgb| opaque(rgb))
                .collect(),
            other => {
                return Err(Error::refused(format!(
                    "the texture {} holds {other:?}: grey and RGB of 8 bits are read",
                    shown(name)
                )));
            }
        };
        Ok(Texture {
            width_px,
            height_px,
            rgba: rgba.into(),
        })
    }

    fn make_room(&mut self, width_px: u32, height_px: u32) -> Result<(), Error> {
        if width_px.max(height_px) > MAX_SIDE_PX {
            return Err(Error::Side { width_px, height_px });
        }
        self.bytes += u64::from(width_px) * u64::from(height_px) * png_file::BYTES_PER_PIXEL;
        if self.bytes > MOST_TEXTURE_BYTES {
            return Err(Error::refused(format!(
                "its textures take more than {MOST_TEXTURE_BYTES} bytes"
            )));
        }
        Ok(())
    }
}

/// Where red, green and blue are the same everywhere, there are heights and no normals.
pub(super) fn is_grey(texture: &Texture) -> bool {
    let (pixels, _) = texture.rgba.as_chunks::<4>();
    pixels.iter().all(|[r, g, b, _]| r == g && g == b)
}
