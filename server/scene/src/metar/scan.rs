//! Reads one word from its beginning.

/// What is left of a word.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scan<'a>(pub(super) &'a str);

impl<'a> Scan<'a> {
    /// Passes over `text`, if it stands here.
    pub(super) fn tag(&mut self, text: &str) -> bool {
        match self.0.strip_prefix(text) {
            Some(rest) => {
                self.0 = rest;
                true
            }
            None => false,
        }
    }

    /// The first of `texts` that stands here. A text stands before any other that it begins with.
    pub(super) fn any(&mut self, texts: &[&'static str]) -> Option<&'static str> {
        texts.iter().copied().find(|text| self.tag(text))
    }

    /// A number of exactly `count` digits, up to nine.
    pub(super) fn digits(&mut self, count: usize) -> Option<u32> {
        let (number, rest) = self.0.split_at_checked(count)?;
        if !number.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        self.0 = rest;
        number.parse().ok()
    }

    /// A number of at least one and at most `most` digits, up to nine.
    pub(super) fn number(&mut self, most: usize) -> Option<u32> {
        self.digits(self.leading_digits().min(most))
    }

    /// How many digits stand here.
    pub(super) fn leading_digits(&self) -> usize {
        self.0.bytes().take_while(u8::is_ascii_digit).count()
    }

    /// True where nothing is left.
    pub(super) fn is_done(&self) -> bool {
        self.0.is_empty()
    }

    /// What is left.
    pub(super) fn rest(&self) -> &'a str {
        self.0
    }
}
