//! Names of the formats outside: media types, file extensions, and what pixels each holds.

use crate::error::EncodeError;
use std::path::Path;
use welkin_scene::{frame::Format, renderer::Output};

/// Extensions and what they stand for; the first of a format is the one given to new files.
const EXTENSIONS: [(&str, Format); 9] = [
    ("png", Format::Png),
    ("jpg", Format::Jpeg),
    ("jpeg", Format::Jpeg),
    ("exr", Format::Exr),
    ("exr", Format::ExrFloat),
    ("hdr", Format::Hdr),
    ("npy", Format::Npy),
    ("raw", Format::Raw),
    ("f32", Format::Raw),
];

/// The media types that an `Accept` header may ask for, in our order of preference. Half and float EXR share one;
/// the request's `format` field tells them apart.
pub const OFFERED_MEDIA_TYPES: [(&str, Format); 6] = [
    ("image/png", Format::Png),
    ("image/jpeg", Format::Jpeg),
    ("image/x-exr", Format::Exr),
    ("image/vnd.radiance", Format::Hdr),
    ("application/x-npy", Format::Npy),
    ("application/octet-stream", Format::Raw),
];

/// The media type of a format, for `Content-Type`.
#[must_use]
pub const fn media_type(format: Format) -> &'static str {
    match format {
        Format::Png => "image/png",
        Format::Jpeg => "image/jpeg",
        Format::Exr | Format::ExrFloat => "image/x-exr",
        Format::Hdr => "image/vnd.radiance",
        Format::Npy => "application/x-npy",
        Format::Raw => "application/octet-stream",
    }
}

/// The extension of a format's files, without the dot.
#[must_use]
pub const fn file_extension(format: Format) -> &'static str {
    match format {
        Format::Png => "png",
        Format::Jpeg => "jpg",
        Format::Exr | Format::ExrFloat => "exr",
        Format::Hdr => "hdr",
        Format::Npy => "npy",
        Format::Raw => "raw",
    }
}

/// What the renderer must give for a format.
#[must_use]
pub const fn output_for(format: Format) -> Output {
    if format.is_linear() {
        Output::Linear
    } else {
        Output::Display
    }
}

/// The format that a file's name asks for by its extension, in either case: `.png`, `.jpg`, `.jpeg`, `.exr` (half
/// floats), `.hdr`, `.npy`, `.raw`, `.f32`.
///
/// # Errors
/// [`EncodeError::Extension`] where the extension is missing or another.
pub fn format_from_path(path: &Path) -> Result<Format, EncodeError> {
    let extension = path.extension().unwrap_or_default();
    EXTENSIONS
        .iter()
        .find(|(name, _)| extension.eq_ignore_ascii_case(name))
        .map(|(_, format)| *format)
        .ok_or_else(|| EncodeError::Extension {
            path: path.display().to_string(),
            offered: known_extensions(),
        })
}

fn known_extensions() -> String {
    let mut names: Vec<_> = EXTENSIONS.iter().map(|(name, _)| format!(".{name}")).collect();
    names.dedup();
    names.join(", ")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use crate::sample::FORMATS;

    #[test]
    fn a_file_named_by_us_is_read_as_the_same_format() {
        for format in FORMATS.into_iter().filter(|format| *format != Format::ExrFloat) {
            let name = format!("a.b/sky.{}", file_extension(format).to_uppercase());
            assert_eq!(format_from_path(Path::new(&name)).unwrap(), format);
        }
    }

    #[test]
    fn other_names_are_refused_with_what_is_known() {
        for name in ["sky", "sky.gif", "png", ".png", "sky.png/", "sky.png.", "-", ""] {
            // `sky.png/` is the same path as `sky.png`.
            let answer = format_from_path(Path::new(name));
            if name == "sky.png/" {
                assert_eq!(answer.unwrap(), Format::Png);
            } else {
                let message = answer.unwrap_err().to_string();
                assert!(
                    message.contains(".png, .jpg, .jpeg, .exr, .hdr, .npy, .raw, .f32"),
                    "{message}"
                );
            }
        }
    }

    #[test]
    fn every_format_is_offered_under_its_own_media_type() {
        for format in FORMATS {
            assert!(
                OFFERED_MEDIA_TYPES
                    .iter()
                    .any(|(name, _)| *name == media_type(format)),
                "{format:?}"
            );
        }
        for (name, format) in OFFERED_MEDIA_TYPES {
            assert_eq!(media_type(format), name);
        }
    }
}
