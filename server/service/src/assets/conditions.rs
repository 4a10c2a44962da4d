//! `If-Match` and `If-None-Match` (RFC 9110 §13): what must stand there for a request to mean what it says.

use axum::http::{HeaderMap, HeaderName, header};

/// The conditions of one request.
pub(crate) struct Conditions {
    must_be: Option<Tags>,
    must_not_be: Option<Tags>,
}

/// The tags of a header, or `*` for whatever there is.
enum Tags {
    Any,
    Of(Vec<String>),
}

/// The tag of a file, quotes included: its SHA-256.
pub(crate) fn etag(digest: &[u8; 32]) -> String {
    let hex: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
    format!("\"{hex}\"")
}

impl Conditions {
    pub(crate) fn read(headers: &HeaderMap) -> Self {
        Self {
            must_be: Tags::read(headers, header::IF_MATCH),
            must_not_be: Tags::read(headers, header::IF_NONE_MATCH),
        }
    }

    /// True where what stands there is what `If-Match` asks for. Comparison is strong: a weak tag never matches.
    pub(crate) fn match_holds(&self, there: Option<&[u8; 32]>) -> bool {
        self.must_be.as_ref().is_none_or(|tags| tags.name(there, false))
    }

    /// True where what stands there is none of those that `If-None-Match` names. Comparison is weak.
    pub(crate) fn none_match_holds(&self, there: Option<&[u8; 32]>) -> bool {
        !self
            .must_not_be
            .as_ref()
            .is_some_and(|tags| tags.name(there, true))
    }

    /// True where a change may be made.
    pub(crate) fn hold(&self, there: Option<&[u8; 32]>) -> bool {
        self.match_holds(there) && self.none_match_holds(there)
    }
}

impl Tags {
    fn read(headers: &HeaderMap, name: HeaderName) -> Option<Self> {
        headers.contains_key(&name).then(|| {
            let lists = headers
                .get_all(name)
                .iter()
                .filter_map(|value| value.to_str().ok());
            let tags: Vec<_> = lists
                .flat_map(|list| list.split(','))
                .map(|tag| tag.trim().to_owned())
                .collect();
            if tags.iter().any(|tag| tag == "*") {
                Self::Any
            } else {
                Self::Of(tags)
            }
        })
    }

    fn name(&self, there: Option<&[u8; 32]>, weakly: bool) -> bool {
        let Some(tag) = there.map(etag) else {
            return false;
        };
        let plain = |named: &String| match named.strip_prefix("W/") {
            Some(weak) => weakly && weak == tag,
            None => *named == tag,
        };
        match self {
            Self::Any => true,
            Self::Of(named) => named.iter().any(plain),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;

    #[test]
    fn conditions_hold_as_the_standard_says() {
        let (mine, other) = (etag(&[1; 32]), etag(&[2; 32]));
        let holds = |name: HeaderName, value: &str, there: Option<&[u8; 32]>| {
            let mut headers = HeaderMap::new();
            headers.insert(name, value.parse().unwrap());
            Conditions::read(&headers).hold(there)
        };
        let there = Some(&[1; 32]);
        for (value, match_holds, none_match_holds) in [
            ("*".to_owned(), true, false),
            (mine.clone(), true, false),
            (format!("W/{mine}"), false, false),
            (other.clone(), false, true),
            (format!("{other} , {mine}"), true, false),
            (String::new(), false, true),
            (mine.trim_matches('"').to_owned(), false, true),
        ] {
            assert_eq!(holds(header::IF_MATCH, &value, there), match_holds, "{value}");
            assert_eq!(
                holds(header::IF_NONE_MATCH, &value, there),
                none_match_holds,
                "{value}"
            );
            assert!(!holds(header::IF_MATCH, &value, None), "{value}");
            assert!(holds(header::IF_NONE_MATCH, &value, None), "{value}");
        }
        assert!(Conditions::read(&HeaderMap::new()).hold(there));
    }
}
