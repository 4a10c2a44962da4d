//! What no schema can say of clouds.

use super::{Clouds, Gradients, Layer, Shape};
use crate::problem::{Problem, Problems, number};
use serde_json::json;

/// Adds what is wrong with clouds that stand at the pointer `at`.
pub(crate) fn check(clouds: &Clouds, at: &str, problems: &mut Problems) {
    for (i, layer) in clouds.layers.iter().enumerate() {
        if let Layer::Volume(volume) = layer
            && volume.top_m <= volume.base_m
        {
            problems.push(Problem::new(
                format!("{at}/layers/{i}/top_m"),
                &json!(volume.top_m),
                format!("a number of metres above `base_m`, {}", number(volume.base_m)),
            ));
        }
    }
    let Shape {
        low_freq_min,
        low_freq_max,
        ref gradients,
        ..
    } = clouds.shape;
    if low_freq_min >= low_freq_max {
        problems.push(Problem::new(
            format!("{at}/shape/low_freq_min"),
            &json!(low_freq_min),
            format!("a number below `low_freq_max`, {}", number(low_freq_max)),
        ));
    }
    let Gradients {
        stratus,
        stratocumulus,
        cumulus,
    } = gradients;
    for (name, heights) in [
        ("stratus", stratus),
        ("stratocumulus", stratocumulus),
        ("cumulus", cumulus),
    ] {
        if heights.windows(2).any(|pair| pair[0] >= pair[1]) {
            problems.push(Problem::new(
                format!("{at}/shape/gradients/{name}"),
                &json!(heights),
                "four numbers, each greater than the one before".into(),
            ));
        }
    }
}
