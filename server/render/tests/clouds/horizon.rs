//! What is seen of clouds where they meet the horizon, in previews' domes and before each pixel.

use crate::scenes::{Seen, luma, merged, order, seen_as, usual};
use serde_json::json;
use welkin_scene::{Quality, Scene, renderer::Output};

const SIZE: (u32, u32) = (320, 180);

/// A closed deck over a level camera.
fn deck() -> Scene {
    let changes = json!({
        "camera": {"direction": {"azimuth_deg": 180, "elevation_deg": 3},
                   "projection": {"kind": "perspective", "vertical_fov_deg": 30}},
        // A final frame finds the deck's shadow in the air place by place, a preview takes it on average.
        "shafts": null,
        "clouds": {"coverage": 1, "shadows": true,
                   "layers": [{"kind": "volume", "base_m": 600, "top_m": 1900, "type": 0.3}]},
    });
    Scene::from_value(&merged(usual(), &changes)).unwrap()
}

fn seen(quality: Quality) -> Seen {
    seen_as(order(&deck(), SIZE, quality, Output::Linear))
}

/// Mean luminance of each row.
fn rows(seen: &Seen) -> Vec<f64> {
    let rows = seen.values.chunks_exact(seen.width);
    rows.map(|row| row.iter().map(|c| luma(*c)).sum::<f64>() / row.len() as f64)
        .collect()
}

/// The first row from below that is sky: 3° under the middle, at pixels of 30°/180 about.
fn first_of_sky(rows: &[f64]) -> usize {
    let half_deg = 15.0_f64;
    let at = 0.5 + 0.5 * 3.0_f64.to_radians().tan() / half_deg.to_radians().tan();
    (at * rows.len() as f64) as usize - 1
}

/// Previews look at few directions, yet close to the horizon they see what final frames see.
#[test]
fn a_previews_clouds_run_down_to_the_horizon_as_those_of_a_final_frame() {
    let [preview, last] = [Quality::Preview, Quality::Final].map(|quality| rows(&seen(quality)));
    let sky = first_of_sky(&last);
    // A preview's maps of light are coarse, so that such a deck is up to a sixth brighter: what counts is that this does not
    // change towards the horizon. Its cells are 2.6 pixels high here, which in the steepest rows makes a tenth.
    let higher = preview[sky - 30] / last[sky - 30];
    for row in sky - 30..sky {
        let ratio = preview[row] / last[row] / higher;
        assert!((0.88..1.12).contains(&ratio), "row {row} of {sky}: {ratio}");
    }
}

/// The clear air's light over the horizon is brighter than a deck: what is seen of it between deck and ground is none.
#[test]
fn no_bright_line_stands_between_a_deck_and_the_ground() {
    for quality in [Quality::Preview, Quality::Final] {
        let rows = rows(&seen(quality));
        let sky = first_of_sky(&rows);
        let over = rows[sky - 3];
        for row in sky - 2..sky + 4 {
            // The deck itself brightens downwards by a few hundredths a row.
            assert!(
                rows[row] < 1.08 * over,
                "{quality:?}: row {row} of {sky}: {:?}",
                &rows[sky - 4..sky + 5]
            );
        }
    }
}
