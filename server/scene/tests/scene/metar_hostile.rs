//! Any text at all: a report is read or refused, never worse.

use crate::metar::{now, reports, request};
use proptest::{collection::vec, prelude::*, sample::select};
use welkin_scene::{Scene, SceneError};

/// A valid scene, or a fault that points at what it names.
fn is_sound(text: &str) -> Result<(), TestCaseError> {
    match request(text).scene(now()) {
        Ok(answer) => {
            let written = serde_json::to_value(&answer.scene).unwrap();
            prop_assert_eq!(Scene::from_value(&written).unwrap(), answer.scene);
        }
        Err(SceneError::Report(fault)) => {
            let capitals = text.to_ascii_uppercase();
            let at: String = capitals
                .chars()
                .skip(fault.start)
                .take(fault.end - fault.start)
                .collect();
            let shown = fault.group.trim_end_matches('…');
            prop_assert!(at.starts_with(shown), "{:?} is not {}", fault, at);
            prop_assert!(fault.number > 0 && fault.to_string().len() < 1000);
        }
        Err(other) => prop_assert!(false, "{}", other),
    }
    Ok(())
}

fn report() -> impl Strategy<Value = String> {
    select(reports().map(|(_, report)| report.to_owned()).collect::<Vec<_>>())
}

/// Words that occur in reports, and near misses of them.
fn word() -> impl Strategy<Value = String> {
    let known: Vec<_> = reports()
        .flat_map(|(_, report)| report.split(' ').map(str::to_owned).collect::<Vec<_>>())
        .collect();
    prop_oneof![
        4 => select(known),
        1 => "[A-Z0-9/+]{1,10}",
        1 => "R[0-9]{2}[LCR]?/[0-9PVMUDNFT/]{0,12}",
        1 => "[PM]?[0-9]{0,2} ?[0-9]{0,2}/[0-9]{0,2}SM",
        1 => "(VRB|[0-9/]{3})[0-9/P]{2,3}(G[0-9]{2,3})?(KT|MPS|KMH)",
        1 => "M?[0-9]{1,3}/M?[0-9]{0,3}",
        1 => any::<String>(),
    ]
}

proptest! {
    // Reading takes microseconds.
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn any_text(text in any::<String>()) {
        is_sound(&text)?;
    }

    #[test]
    fn words_in_any_order(words in vec(word(), 0..30)) {
        is_sound(&format!("METAR EGLL 092050Z {}", words.join(" ")))?;
        is_sound(&words.join(" "))?;
    }

    #[test]
    fn reports_with_characters_changed(
        report in report(),
        changes in vec((any::<prop::sample::Index>(), any::<Option<char>>(), any::<bool>()), 1..4),
    ) {
        let mut text: Vec<char> = report.chars().collect();
        for (at, character, is_ascii) in changes {
            let at = at.index(text.len());
            match character {
                Some(c) => text[at] = if is_ascii { char::from(b' ' + (u32::from(c) % 95) as u8) } else { c },
                None => drop(text.remove(at)),
            }
            if text.is_empty() {
                break;
            }
        }
        is_sound(&text.into_iter().collect::<String>())?;
    }
}
