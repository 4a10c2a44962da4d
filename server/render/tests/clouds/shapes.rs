//! Every control of the clouds' shapes acts, in its sense.

use crate::scenes::{cloudiness, clouds, seen};
use serde_json::{Value, json};

fn shape(changes: Value) -> welkin_scene::Scene {
    clouds(json!({ "shape": changes }))
}

/// Those that make other clouds, neither more nor less of them.
#[test]
fn other_noise_makes_other_clouds() {
    let base = seen(&clouds(json!({})));
    for (changes, least) in [
        (json!({"base_scale_m": 5000}), 0.03),
        (json!({"detail_scale_m": 400}), 0.003),
        (json!({"curl_distortion_m": 0}), 0.002),
        (json!({"curl_distortion_m": 600}), 0.002),
        (json!({"seed": 7}), 0.03),
        (json!({"perlin_frequency": 8}), 0.03),
        (json!({"worley_frequency": 8}), 0.03),
        (json!({"detail_frequency": 5}), 0.003),
    ] {
        let found = seen(&shape(changes.clone())).apart(&base);
        println!("{changes}: {found}");
        assert!(found > least, "{changes}: {found}");
    }
    let found = seen(&clouds(json!({"seed": 2}))).apart(&base);
    assert!(found > 0.1, "seed: {found}");
    // The shapes' own seed is the clouds' where nothing is said.
    let said = seen(&shape(json!({"seed": 1})));
    assert!(said == base, "a seed that says the same");
}

/// Those that leave more or less of the clouds.
#[test]
fn noise_eats_as_much_as_it_is_told() {
    let base = cloudiness(&clouds(json!({})));
    for (changes, more) in [
        (json!({"low_freq_min": 0.4}), false),
        (json!({"low_freq_max": 0.6}), true),
        (json!({"high_freq_modifier": 0}), true),
        (json!({"high_freq_modifier": 0.9}), false),
        (
            json!({"gradients": {"stratocumulus": [0, 0.1, 0.2, 0.3], "cumulus": [0, 0.1, 0.2, 0.3]}}),
            false,
        ),
    ] {
        let found = cloudiness(&shape(changes.clone()));
        println!("{changes}: {base} to {found}");
        assert!(
            if more {
                found > base + 0.004
            } else {
                found < base - 0.004
            },
            "{changes}: {found}, {base}"
        );
    }
}

/// Each of the three gradients is that of its type.
#[test]
fn gradients_belong_to_types() {
    let all = json!({"stratus": [0, 0.1, 0.85, 1], "stratocumulus": [0, 0.15, 0.6, 1], "cumulus": [0, 0.0625, 0.78, 1]});
    for (cloud_type, own) in [(0.0, "stratus"), (0.5, "stratocumulus"), (1.0, "cumulus")] {
        let with = |name: &str| {
            let mut gradients = all.clone();
            gradients[name] = json!([0.0, 0.1, 0.15, 0.2]);
            seen(&clouds(json!({
                "layers": [{"kind": "volume", "base_m": 1500, "top_m": 3500, "type": cloud_type}],
                "shape": {"gradients": gradients},
            })))
        };
        let base = seen(&clouds(json!({
            "layers": [{"kind": "volume", "base_m": 1500, "top_m": 3500, "type": cloud_type}],
        })));
        for name in ["stratus", "stratocumulus", "cumulus"] {
            let found = with(name).apart(&base);
            assert!(
                (found > 0.02) == (name == own),
                "type {cloud_type}, {name}: {found}"
            );
        }
    }
}
