//! What is measured under one set of conditions.

use crate::commands::Failure;
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use serde_json::{Map, Value};
use std::str::FromStr;
use welkin_scene::frame::MAX_SIDE_PX;

/// The conditions of one measuring process, as the rows tell them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Setup {
    /// Size of the frames.
    #[serde(flatten)]
    pub(crate) size: Size,
    /// Whatever else the case varies.
    #[serde(flatten)]
    pub(crate) parameters: Map<String, Value>,
}

impl Setup {
    /// One of the parameters.
    ///
    /// # Errors
    /// Where it is missing or of another kind.
    pub(crate) fn parameter<T: DeserializeOwned>(&self, name: &str) -> Result<T, Failure> {
        let value = self.parameters.get(name).cloned().unwrap_or_default();
        serde_json::from_value(value).map_err(|e| Failure::Usage(format!("setup: {name}: {e}")))
    }
}

impl FromStr for Setup {
    type Err = serde_json::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        serde_json::from_str(text)
    }
}

/// Size of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Size {
    /// Pixels, 1 to [`MAX_SIDE_PX`].
    pub(crate) width_px: u32,
    /// Pixels, 1 to [`MAX_SIDE_PX`].
    pub(crate) height_px: u32,
}

impl Size {
    pub(crate) const fn new(width_px: u32, height_px: u32) -> Self {
        Self { width_px, height_px }
    }
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let side = |text: &str| text.parse().ok().filter(|px| (1..=MAX_SIDE_PX).contains(px));
        text.split_once('x')
            .and_then(|(width, height)| Some(Self::new(side(width)?, side(height)?)))
            .ok_or_else(|| {
                format!("a size is WIDTHxHEIGHT, each 1 to {MAX_SIDE_PX} pixels, for example 640x360")
            })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use serde_json::json;

    #[test]
    fn sizes_are_read_and_bounded() {
        assert_eq!("640x360".parse(), Ok(Size::new(640, 360)));
        assert_eq!("16384x1".parse(), Ok(Size::new(16_384, 1)));
        for wrong in [
            "", "640", "x", "0x9", "9x16385", "9x9x9", "-9x9", "9 x 9", "9.5x9",
        ] {
            assert!(wrong.parse::<Size>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_setup_reaches_its_process_whole() {
        let parameters = json!({"quality": "preview", "steps": 30})
            .as_object()
            .unwrap()
            .clone();
        let setup = Setup {
            size: Size::new(64, 36),
            parameters,
        };
        let told = serde_json::to_string(&setup).unwrap();
        let read: Setup = told.parse().unwrap();
        assert_eq!(read, setup);
        assert_eq!(read.parameter::<u32>("steps").unwrap(), 30);
        assert!(read.parameter::<u32>("quality").is_err());
        assert!(read.parameter::<u32>("missing").is_err());
    }
}
