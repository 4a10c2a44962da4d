//! What no schema can say of lamps.

use super::{Lamp, Light};
use crate::problem::{Problem, Problems};
use serde_json::json;

/// Adds what is wrong with lamps that stand at the pointer `at`.
pub(crate) fn check(lights: &[Light], at: &str, problems: &mut Problems) {
    for (i, light) in lights.iter().enumerate() {
        if problems.is_full() {
            return;
        }
        let mut leave_out = |field: &str, value: serde_json::Value, reason: &str| {
            let allowed = format!("left out where {reason}");
            problems.push(Problem::new(format!("{at}/{i}/{field}"), &value, allowed));
        };
        if light.radiant_intensity_w_sr.is_some() {
            let given = "`radiant_intensity_w_sr` is given: both say how bright the lamp is";
            if let Some(lamp) = light.lamp {
                leave_out("lamp", json!(lamp), given);
            }
            if let Some(candela) = light.luminous_intensity_cd {
                leave_out("luminous_intensity_cd", json!(candela), given);
            }
        }
        if let Some(kelvin) = light.colour_temperature_k
            && !matches!(light.lamp, Some(Lamp::Incandescent | Lamp::WhiteLed))
        {
            leave_out(
                "colour_temperature_k",
                json!(kelvin),
                "`lamp` is neither `incandescent` nor `white-led`",
            );
        }
    }
}
