//! What may be stored, in which forms, and under which names.

use crate::Error;
use serde::{Serialize, Serializer};
use std::fmt;
use welkin_scene::{AssetKind, is_asset_name};

/// Kinds of asset. Each has a folder of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// Pictures that spread clouds over the land.
    WeatherMaps,
    /// Heights over a rectangle.
    Heightfields,
    /// Triangles with their materials and textures.
    Meshes,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::WeatherMaps, Self::Heightfields, Self::Meshes];

    /// As paths name it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::WeatherMaps => "weather-maps",
            Self::Heightfields => "heightfields",
            Self::Meshes => "meshes",
        }
    }

    /// The kind of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// As a sentence calls one of them.
    #[must_use]
    pub const fn noun(self) -> &'static str {
        match self {
            Self::WeatherMaps => "a weather map",
            Self::Heightfields => "a heightfield",
            Self::Meshes => "a mesh",
        }
    }

    /// What may be sent, in words.
    #[must_use]
    pub const fn allowed(self) -> &'static str {
        match self {
            Self::WeatherMaps => "a PNG, 8 or 16 bits, grey, RGB, RGBA or palette",
            Self::Heightfields => "a grey PNG of 16 bits, a GeoTIFF or an NPY",
            Self::Meshes => "a .glb, or a .zip of an OBJ with its MTL and textures",
        }
    }

    /// What it may be sent as.
    #[must_use]
    pub const fn forms(self) -> &'static [Form] {
        match self {
            Self::WeatherMaps => &[Form::Png],
            Self::Heightfields => &[Form::Png, Form::Tiff, Form::Npy],
            Self::Meshes => &[Form::Glb, Form::Zip],
        }
    }

    /// Whether a folder of files may stand in the place of a file.
    pub(crate) const fn has_folders(self) -> bool {
        matches!(self, Self::Meshes)
    }

    /// Which of its forms a file has.
    pub(crate) fn form_of(self, file: &[u8]) -> Result<Form, Error> {
        let forms = self.forms().iter().copied();
        let mut found = forms.filter(|form| form.signatures().iter().any(|begin| file.starts_with(begin)));
        found.next().ok_or(Error::Form { kind: self })
    }
}

impl From<AssetKind> for Kind {
    fn from(kind: AssetKind) -> Self {
        match kind {
            AssetKind::WeatherMap => Self::WeatherMaps,
            AssetKind::Heightfield => Self::Heightfields,
            AssetKind::Mesh => Self::Meshes,
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Serialize for Kind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// How a file holds an asset. What the file begins with tells, not its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Form {
    /// Portable Network Graphics.
    Png,
    /// TIFF, with or without the tags of GeoTIFF.
    Tiff,
    /// An array of numpy.
    Npy,
    /// Binary glTF.
    Glb,
    /// An OBJ with what belongs to it, packed.
    Zip,
}

impl Form {
    /// As HTTP names what the file holds.
    #[must_use]
    pub const fn media_type(self) -> &'static str {
        match self {
            Self::Png => "image/png",
            Self::Tiff => "image/tiff",
            Self::Npy => "application/octet-stream",
            Self::Glb => "model/gltf-binary",
            Self::Zip => "application/zip",
        }
    }

    /// What the files' names may end with, the dot included; the first is what the store writes.
    pub(crate) const fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Png => &[".png"],
            Self::Tiff => &[".tif", ".tiff"],
            Self::Npy => &[".npy"],
            Self::Glb => &[".glb"],
            Self::Zip => &[".zip"],
        }
    }

    /// What the files may begin with.
    const fn signatures(self) -> &'static [&'static [u8]] {
        match self {
            Self::Png => &[b"\x89PNG\r\n\x1a\n"],
            // Classic and BigTIFF, in either byte order.
            Self::Tiff => &[b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"],
            Self::Npy => &[b"\x93NUMPY"],
            Self::Glb => &[b"glTF"],
            Self::Zip => &[b"PK\x03\x04"],
        }
    }
}

/// The name of an asset: `[a-z0-9][a-z0-9_-]{0,63}`. It cannot lead out of a folder, and is the same file on systems
/// that do not tell `A` from `a`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct Name(String);

impl Name {
    /// What a name may be, in words.
    pub const ALLOWED: &str =
        "up to 64 of the characters a-z, 0-9, _ and -, the first of them a letter or a digit";

    /// Checks a name.
    ///
    /// # Errors
    /// [`Error::Name`].
    pub fn new(name: &str) -> Result<Self, Error> {
        if is_asset_name(name) {
            Ok(Self(name.to_owned()))
        } else {
            Err(Error::Name)
        }
    }

    /// The name.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
