//! Text that goes into files.

use std::fmt::Write;

/// ASCII alone, as PNG's `tEXt`, EXR's strings and Exif's text are read alike by every program only then. Other
/// characters become JSON escapes, so a JSON document stays the same document; control characters become spaces.
pub(crate) fn ascii(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            ' '..='~' => out.push(character),
            '\0'..='\u{7f}' => out.push(' '),
            _ => {
                let mut units = [0; 2];
                for unit in character.encode_utf16(&mut units) {
                    // Writing to a string does not fail.
                    let _ = write!(out, "\\u{unit:04x}");
                }
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::ascii;
    use proptest::prelude::*;

    #[test]
    fn escapes_are_those_of_json() {
        assert_eq!(
            ascii("{\"name\":\"Zürich ☀ 🌅\"}\n"),
            "{\"name\":\"Z\\u00fcrich \\u2600 \\ud83c\\udf05\"} "
        );
    }

    proptest! {
        #[test]
        fn only_printable_ascii_is_left(text in any::<String>()) {
            prop_assert!(ascii(&text).bytes().all(|byte| (b' '..=b'~').contains(&byte)));
        }
    }
}
