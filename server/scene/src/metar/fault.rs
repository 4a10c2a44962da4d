//! What is wrong with a report, in words for the person who sent it.

use serde::Serialize;
use std::{fmt, ops::Range};

/// Longest echo of a group, characters.
const MAX_GROUP_CHARS: usize = 40;

/// The group of a weather report that is not understood.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ReportFault {
    /// The group in capital letters, cut where it is very long; empty where the report ends too early.
    pub group: String,
    /// The group's number in the report, from 1; `METAR` or `SPECI` counts where it is there.
    pub number: usize,
    /// Characters before the group.
    pub start: usize,
    /// Characters before its end.
    pub end: usize,
    /// What may stand there.
    pub expected: String,
}

impl ReportFault {
    pub(super) fn new(group: String, number: usize, at: Range<usize>, expected: String) -> Self {
        let group = if group.chars().count() > MAX_GROUP_CHARS {
            group.chars().take(MAX_GROUP_CHARS - 1).chain(['…']).collect()
        } else {
            group
        };
        Self {
            group,
            number,
            start: at.start,
            end: at.end,
            expected,
        }
    }
}

impl fmt::Display for ReportFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            group,
            number,
            start,
            expected,
            ..
        } = self;
        if group.is_empty() {
            return write!(
                f,
                "the report ends where its group {number} should be: {expected}"
            );
        }
        let character = start + 1;
        write!(
            f,
            "group {number} of the report, `{group}` at character {character}, is not understood: {expected}"
        )
    }
}
