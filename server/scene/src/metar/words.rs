//! A report as words with their places.

use super::fault::ReportFault;

/// One word of a report.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word<'a> {
    pub(super) text: &'a str,
    /// Byte offset in the report.
    start: usize,
}

/// The words of one report, and the fault of any run of them.
#[derive(Clone, Debug)]
pub(super) struct Words<'a> {
    report: &'a str,
    words: Vec<Word<'a>>,
}

impl<'a> Words<'a> {
    /// Splits at white space, up to `=`, the end of a report.
    ///
    /// # Errors
    /// Where something follows the end.
    pub(super) fn split(report: &'a str) -> Result<Self, ReportFault> {
        let (body, rest) = report.split_once('=').unwrap_or((report, ""));
        let words = split(report, body);
        let after = split(report, rest.trim_start_matches('='));
        let whole = Self { report, words };
        match after.first() {
            Some(&word) => Err(whole.fault(word, word, whole.words.len() + 1, AFTER_END)),
            None => Ok(whole),
        }
    }

    pub(super) fn get(&self, index: usize) -> Option<Word<'a>> {
        self.words.get(index).copied()
    }

    pub(super) fn len(&self) -> usize {
        self.words.len()
    }

    /// The text from one word to another, as it was written.
    pub(super) fn text(&self, first: usize, last: usize) -> &'a str {
        let ends = self.get(first).zip(self.get(last));
        ends.and_then(|(first, last)| self.report.get(first.start..last.end()))
            .unwrap_or_default()
    }

    /// The words from `first` to `last` are not what they should be.
    pub(super) fn refuse(&self, first: usize, last: usize, expected: &str) -> ReportFault {
        match self.get(first).zip(self.get(last)) {
            Some((a, b)) => self.fault(a, b, first + 1, expected),
            None => self.refuse_end(expected),
        }
    }

    /// The report ends too early.
    pub(super) fn refuse_end(&self, expected: &str) -> ReportFault {
        let end = self.words.last().map_or(0, Word::end);
        let end = self.characters(end);
        ReportFault::new(String::new(), self.words.len() + 1, end..end, expected.into())
    }

    fn fault(&self, first: Word, last: Word, number: usize, expected: &str) -> ReportFault {
        let text = self.report.get(first.start..last.end()).unwrap_or_default();
        let span = self.characters(first.start)..self.characters(last.end());
        ReportFault::new(text.into(), number, span, expected.into())
    }

    fn characters(&self, bytes: usize) -> usize {
        self.report
            .get(..bytes)
            .map_or(0, |before| before.chars().count())
    }
}

const AFTER_END: &str = "nothing: `=` ends a report, and only one is read at a time";

impl Word<'_> {
    fn end(&self) -> usize {
        self.start + self.text.len()
    }
}

/// The words of a part of the report.
fn split<'a>(report: &'a str, part: &'a str) -> Vec<Word<'a>> {
    let start = |text: &str| text.as_ptr().addr() - report.as_ptr().addr();
    let word = |text| Word {
        text,
        start: start(text),
    };
    part.split_whitespace().map(word).collect()
}
