//! The format that an `Accept` header asks for (RFC 9110, section 12.5.1).
//!
//! Written out, as no kept crate reads the header by its grammar: blanks before a `;`, quoted commas and `q=0` are
//! where they fail.

use crate::{error::EncodeError, names::OFFERED_MEDIA_TYPES};
use welkin_scene::frame::Format;

/// One element of the header. The type is lower case.
struct Range {
    media_type: String,
    weight: f32,
}

/// What the header says of one media type. Ordered by how much the client wants it; at equal weight, a type named
/// in full goes before one that a wildcard admits.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
struct Wish {
    weight: f32,
    specificity: u8,
}

/// The offered format with the greatest weight. Of equal ones, a type named in full goes before one that a
/// wildcard admits, and then the order is PNG, JPEG, EXR, HDR, NPY, raw. A header that is blank accepts anything,
/// as a missing one does; elements that are not media ranges are passed over.
///
/// # Errors
/// [`EncodeError::NotAcceptable`], with what is offered, where no offered type has a weight above zero.
pub fn format_from_accept(header: &str) -> Result<Format, EncodeError> {
    let header = if header.trim().is_empty() { "*/*" } else { header };
    let ranges: Vec<Range> = split_unquoted(header, ',').filter_map(range).collect();
    let mut best: Option<(Wish, Format)> = None;
    for (name, format) in OFFERED_MEDIA_TYPES {
        let wish = wish(&ranges, name).filter(|wish| wish.weight > 0.0);
        if let Some(wish) = wish.filter(|wish| best.is_none_or(|(other, _)| *wish > other)) {
            best = Some((wish, format));
        }
    }
    best.map(|(_, format)| format)
        .ok_or_else(|| EncodeError::NotAcceptable {
            asked: header.to_owned(),
            offered: OFFERED_MEDIA_TYPES.map(|(name, _)| name).join(", "),
        })
}

/// The parts between separators that stand outside quotes.
fn split_unquoted(text: &str, separator: char) -> impl Iterator<Item = &str> {
    let (mut quoted, mut escaped) = (false, false);
    text.split(move |character| {
        let ends = character == separator && !quoted;
        match character {
            _ if escaped => escaped = false,
            '\\' if quoted => escaped = true,
            '"' => quoted = !quoted,
            _ => {}
        }
        ends
    })
}

/// One element; nothing where its `q` is not a number from 0 to 1. Other parameters do not matter, as no offered
/// type has any.
fn range(element: &str) -> Option<Range> {
    let mut parts = split_unquoted(element, ';');
    let media_type = parts.next()?.trim().to_ascii_lowercase();
    let q = parts
        .filter_map(|part| part.split_once('='))
        .find(|(name, _)| name.trim().eq_ignore_ascii_case("q"));
    let weight = q.map_or(Ok(1.0), |(_, value)| value.trim().parse()).ok()?;
    (0.0..=1.0)
        .contains(&weight)
        .then_some(Range { media_type, weight })
}

/// The weight of a type is that of the most specific range that covers it, so `image/png;q=0, image/*` leaves PNG out.
fn wish(ranges: &[Range], name: &str) -> Option<Wish> {
    let covering = ranges.iter().filter_map(|range| {
        Some(Wish {
            weight: range.weight,
            specificity: specificity(&range.media_type, name)?,
        })
    });
    covering.reduce(|one, other| {
        if other.specificity > one.specificity {
            other
        } else {
            one
        }
    })
}

/// 2 for the type itself, 1 for `image/*`, 0 for `*/*`; nothing where the range does not cover the type.
fn specificity(range: &str, name: &str) -> Option<u8> {
    let (family, _) = name.split_once('/')?;
    match range.split_once('/')? {
        ("*", "*") => Some(0),
        (kind, "*") if kind == family => Some(1),
        _ if range == name => Some(2),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use proptest::prelude::*;

    #[test]
    fn headers_that_clients_send() {
        for (header, format) in [
            ("*/*", Format::Png),
            ("", Format::Png),
            (" ", Format::Png),
            (
                "image/avif,image/webp,image/apng,image/svg+xml,image/*,*/*;q=0.8",
                Format::Png,
            ),
            (
                "image/png,image/svg+xml,image/*;q=0.8,video/*;q=0.8,*/*;q=0.5",
                Format::Png,
            ),
            (
                "text/html,application/xhtml+xml,application/xml;q=0.9,*/*;q=0.8",
                Format::Png,
            ),
            ("image/jpeg", Format::Jpeg),
            ("IMAGE/JPEG", Format::Jpeg),
            ("image/x-exr", Format::Exr),
            ("image/vnd.radiance", Format::Hdr),
            ("application/x-npy", Format::Npy),
            ("application/octet-stream", Format::Raw),
            ("application/*", Format::Npy),
            ("image/jpeg, */*", Format::Jpeg),
            ("image/png;q=0.5, image/jpeg;q=0.9", Format::Jpeg),
            ("image/jpeg;q=0.9, image/png", Format::Png),
            ("image/jpeg ; q=0.2 ,  image/x-exr ; q=0.3", Format::Exr),
            ("image/png;q=0, image/*", Format::Jpeg),
            ("image/*, image/png;q=0", Format::Jpeg),
            ("image/*;q=0, */*", Format::Npy),
            ("image/png;q=0.001, image/gif", Format::Png),
            ("rubbish, image/jpeg", Format::Jpeg),
            ("image/png;q=high, image/jpeg;q=0.1", Format::Jpeg),
            ("image/png;q=NaN, image/jpeg;q=0.1", Format::Jpeg),
            ("image/png;q=-1, image/jpeg;q=0.1", Format::Jpeg),
            (
                "image/png;level=\"1,2;q=0\\\"\";Q=0.3, image/jpeg;q=0.2",
                Format::Png,
            ),
            ("image/png;level=\", image/jpeg", Format::Png),
        ] {
            assert_eq!(format_from_accept(header).unwrap(), format, "{header}");
        }
    }

    #[test]
    fn what_is_not_offered_is_answered_with_what_is() {
        for header in [
            "image/gif",
            "text/html;q=0.9, image/webp",
            "image/png;q=0",
            "*/*;q=0",
            "rubbish",
        ] {
            let message = format_from_accept(header).unwrap_err().to_string();
            assert!(
                message.contains(header) && message.contains("image/png, image/jpeg, image/x-exr"),
                "{message}"
            );
        }
    }

    proptest! {
        #[test]
        fn any_text_is_answered(header in ".{0,80}") {
            let _ = format_from_accept(&header);
        }

        /// With distinct weights the heaviest wins, in whatever order they stand.
        #[test]
        fn the_heaviest_wins(weights in prop::sample::subsequence((1..1000u16).collect::<Vec<_>>(), 6).prop_shuffle()) {
            let range = |((name, _), weight): (&(&str, Format), &u16)| format!("{name};q=0.{weight:03}");
            let header = OFFERED_MEDIA_TYPES.iter().zip(&weights).map(range).collect::<Vec<_>>().join(", ");
            let (_, heaviest) = OFFERED_MEDIA_TYPES.iter().zip(&weights).max_by_key(|(_, weight)| **weight)
                .map(|((_, format), weight)| (weight, *format)).unwrap();
            prop_assert_eq!(format_from_accept(&header).unwrap(), heaviest);
        }
    }
}
