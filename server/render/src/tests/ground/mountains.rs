//! Mountains by seed.

use crate::ground::Range;
use glam::DVec2;
use welkin_scene::terrain::Mountains;

fn range(seed: u32, erosion: f64) -> Range {
    Range {
        mountains: Mountains {
            seed,
            erosion,
            ..Mountains::default()
        },
        extent_m: 40_000.0,
        height_m: 2500.0,
        origin_m: DVec2::ZERO,
    }
}

#[test]
fn a_seed_makes_the_same_mountains_and_another_seed_others() {
    let (size, first) = range(1, 0.5).make();
    assert_eq!(first, range(1, 0.5).make().1);
    let (_, second) = range(2, 0.5).make();
    let apart = first.iter().zip(&second).filter(|(a, b)| (*a - *b).abs() > 0.05);
    // Most of the ground is higher or lower by more than a twentieth.
    assert!(apart.count() > first.len() / 3);
    assert!(first.iter().all(|h| (0.0..=1.0).contains(h)));
    assert!(first.contains(&1.0), "the highest is as high as asked");
    // Where the scene's origin is the ground is level: the valley's radius is 2500 m, its edge wanders by half of it.
    let middle = size.x / 2;
    let reach = (800.0 / (40_000.0 / size.x as f64)) as usize;
    for row in middle - reach..middle + reach {
        let valley = &first[row * size.x + middle - reach..row * size.x + middle + reach];
        assert!(
            valley.iter().all(|h| *h * 2500.0 < 2.0),
            "{:?}",
            valley.iter().copied().fold(0.0, f32::max)
        );
    }
}

/// Water cuts valleys: the ground gets lower and its slopes steeper.
#[test]
fn water_cuts_valleys() {
    let look = |erosion: f64| {
        let (size, heights) = range(3, erosion).make();
        let spacing_m = (40_000.0 / (size.x - 1) as f64) as f32;
        let steep = (0..heights.len() - 1)
            .filter(|i| ((heights[i + 1] - heights[*i]) * 2500.0 / spacing_m).abs() > 0.6)
            .count();
        let mean = heights.iter().map(|h| f64::from(*h)).sum::<f64>() / heights.len() as f64;
        (steep, mean)
    };
    let (dry, wet) = (look(0.0), look(0.6));
    // A tenth lower, and three times as much of it steep: what this seed shows is five times.
    assert!(
        wet.1 < 0.9 * dry.1 && wet.0 > 3 * dry.0,
        "{wet:?} with water, {dry:?} without"
    );
}
