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
    // A preview takes few steps to the light, so that such a deck is a few hundredths off: what counts is that this does not change towards the horizon. Its cells are 2.6 pixels high here, which in the steepest rows makes a tenth.
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

/// Of a pixel that the horizon crosses a share is sky and a share is ground, so that its colour lies between theirs.
#[test]
fn the_horizon_has_a_colour_between_the_decks_and_the_grounds() {
    // Rows are 0.11° high, and the horizon lies 0.045° under the level.
    for (elevation_deg, crossed) in [(0.0, 12), (0.0275, 12), (0.055, 12), (0.0825, 13)] {
        let changes = json!({
            "camera": {"direction": {"azimuth_deg": 180, "elevation_deg": elevation_deg},
                       "projection": {"kind": "perspective", "vertical_fov_deg": 2.64}},
        });
        let deck = serde_json::to_value(deck()).unwrap();
        let scene = Scene::from_value(&merged(deck, &changes)).unwrap();
        let seen = seen_as(order(&scene, (16, 24), Quality::Final, Output::Linear));
        let blue = |row: usize| {
            let [r, g, b] = [0, 1, 2].map(|c| (0..16).map(|x| seen.values[16 * row + x][c]).sum::<f64>());
            b / (r + g + b)
        };
        let (sky, here, ground) = (blue(crossed - 4), blue(crossed), blue(crossed + 1));
        // From row to row the deck's own colour changes by less than this. With what clear air scatters more than once it was 0.39.
        assert!(
            here < sky.max(ground) + 0.01,
            "{elevation_deg}°: {sky} {here} {ground}"
        );
        // Shafts are looked up every second pixel, and just under the horizon those rays end at some times a pixel's distance.
        // Looked up in every pixel they leave 0.361 to 0.381 here; what such a ray loses, taken as it is, leaves up to 0.43.
        for row in crossed + 1..24 {
            let under = blue(row);
            assert!(
                (0.36..0.385).contains(&under),
                "{elevation_deg}°, row {row}: {under}"
            );
        }
    }
}

/// Shafts find what the air loses ray by ray, else it stands in a table: under a deck that lets no sunlight through, both must
/// find the same, and that before clouds as before the sky.
#[test]
fn the_air_before_a_deck_loses_its_sunlight_with_shafts_and_without() {
    let mut without = deck();
    without.shafts = None;
    let [with, without] =
        [deck(), without].map(|scene| rows(&seen_as(order(&scene, SIZE, Quality::Final, Output::Linear))));
    let sky = first_of_sky(&with);
    for (row, (with, without)) in with.iter().zip(&without).enumerate().take(sky) {
        // A table of 37 by 12 directions.
        let ratio = with / without;
        assert!((0.98..1.02).contains(&ratio), "row {row} of {sky}: {ratio}");
    }
}

/// Against a low sun the air in the shadow of heaps is dark, over a way on which light passes several of them. A preview has no
/// shafts, but as dark an air.
#[test]
fn a_preview_has_a_final_frames_air_under_a_low_sun() {
    let changes = json!({
        "camera": {"direction": {"azimuth_deg": 200, "elevation_deg": 10},
                   "projection": {"kind": "perspective", "vertical_fov_deg": 40}},
        "sun": {"position": {"azimuth_deg": 200, "elevation_deg": 8}},
        "clouds": {"shadows": true},
    });
    let scene = Scene::from_value(&merged(usual(), &changes)).unwrap();
    let mean = |quality| {
        let rows = rows(&seen_as(order(&scene, SIZE, quality, Output::Linear)));
        rows.iter().take(130).sum::<f64>() / 130.0
    };
    // Where clouds dim air alike in all directions, by their coverage, this is 2.
    let ratio = mean(Quality::Preview) / mean(Quality::Final);
    assert!((0.85..1.18).contains(&ratio), "{ratio}");
}
