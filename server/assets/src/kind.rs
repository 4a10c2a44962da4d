//! What may be stored, and under which names.

use crate::Error;
use serde::{Serialize, Serializer};
use std::fmt;
use welkin_scene::is_asset_name;

/// Kinds of asset. Each has a folder of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// Pictures that spread clouds over the land.
    WeatherMaps,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 1] = [Self::WeatherMaps];

    /// As paths name it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::WeatherMaps => "weather-maps",
        }
    }

    /// The kind of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// As HTTP names what the files hold.
    #[must_use]
    pub const fn media_type(self) -> &'static str {
        match self {
            Self::WeatherMaps => "image/png",
        }
    }

    /// What the files' names end with, the dot included.
    pub(crate) const fn ending(self) -> &'static str {
        match self {
            Self::WeatherMaps => ".png",
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
