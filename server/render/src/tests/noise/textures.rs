//! The textures.

use super::super::engine;
use crate::{
    cloud_noise::{CloudNoise, Recipe, bytes},
    gpu::{AdapterChoice, Gpu},
    noise_cache::DiskCache,
    passes::{
        Table,
        cloud_curl::cloud_curl,
        cloud_detail::cloud_detail,
        cloud_shape::{ShapeFrequencies, cloud_shape},
        cloud_sheet::cloud_sheet,
        cloud_weather::cloud_weather,
    },
};
use std::sync::{Arc, LazyLock};

const USUAL: ShapeFrequencies = ShapeFrequencies { perlin: 4, worley: 4 };

fn recipes(seed: u32) -> [Recipe; 5] {
    [
        cloud_shape(seed, USUAL),
        cloud_detail(seed, 2),
        cloud_curl(seed),
        cloud_weather(seed),
        cloud_sheet(seed),
    ]
}

/// The bytes of all five for one seed.
static MADE: LazyLock<[Vec<u8>; 5]> = LazyLock::new(|| {
    let engine = engine();
    recipes(1).map(|recipe| bytes(&engine.gpu, None, &recipe).unwrap().0)
});

const SHAPE: usize = 0;
const DETAIL: usize = 1;
const CURL: usize = 2;
const WEATHER: usize = 3;
const SHEET: usize = 4;

fn channel(texture: usize, channel: usize) -> Vec<f64> {
    let texels = MADE[texture].chunks_exact(4);
    texels.map(|texel| f64::from(texel[channel]) / 255.0).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let (of_a, of_b) = (mean(a), mean(b));
    let moment = |f: &dyn Fn(usize) -> f64| (0..a.len()).map(f).sum::<f64>();
    let both = moment(&|i| (a[i] - of_a) * (b[i] - of_b));
    both / (moment(&|i| (a[i] - of_a).powi(2)) * moment(&|i| (b[i] - of_b).powi(2))).sqrt()
}

#[test]
fn coverage_is_a_share_of_the_area() {
    let even = [WEATHER, SHEET]
        .into_iter()
        .flat_map(|t| (0..4).map(move |c| (t, c)));
    for (texture, c) in even.chain([(SHAPE, 0)]) {
        let mut count = [0_usize; 256];
        for texel in MADE[texture].chunks_exact(4) {
            count[usize::from(texel[c])] += 1;
        }
        let all: usize = count.iter().sum();
        // Each byte as often as any other, so that the distance to the even distribution is 1/256 at most.
        assert_eq!(count, [all / 256; 256], "{texture} {c}");
    }
}

#[test]
fn worley_noise_fills_its_bytes() {
    for (texture, c) in (1..4).map(|c| (SHAPE, c)).chain((0..4).map(|c| (DETAIL, c))) {
        let mut values = channel(texture, c);
        values.sort_by(f64::total_cmp);
        let at = |share: f64| values[(share * (values.len() - 1) as f64) as usize];
        let found = [mean(&values), at(0.1), at(0.5), at(0.9)];
        // What the docs say, with room for what the few cells of one seed happen to be.
        for (value, (low, high)) in found
            .iter()
            .zip([(0.42, 0.58), (0.18, 0.34), (0.42, 0.58), (0.64, 0.80)])
        {
            assert!((low..high).contains(value), "{texture} {c}: {found:?}");
        }
        // A thousandth at either end is cut off, and a byte stands for half a step more.
        assert!(at(0.0005) == 0.0 && at(0.9995) == 1.0);
        assert!(
            at(0.008) > 0.0 && at(0.992) < 1.0,
            "{texture} {c}: {}, {}",
            at(0.008),
            at(0.992)
        );
    }
}

/// Root mean squares of first and second differences along one axis, across the seam and elsewhere.
fn roughness(texture: usize, c: usize, axis: usize) -> [(f64, f64); 2] {
    let size = recipes(1)[texture].size.map(|side| side as usize);
    let values = channel(texture, c);
    let at = |mut place: [usize; 3], by: usize| {
        place[axis] = (place[axis] + by) % size[axis];
        values[(place[2] * size[1] + place[1]) * size[0] + place[0]]
    };
    let mut sums = [[(0.0, 0_usize); 2]; 2];
    for z in 0..size[2] {
        for y in 0..size[1] {
            for x in 0..size[0] {
                let place = [x, y, z];
                let [v0, v1, v2] = [0, 1, 2].map(|by| at(place, by));
                for (order, difference) in [v1 - v0, v2 - 2.0 * v1 + v0].into_iter().enumerate() {
                    let sum = &mut sums[order][usize::from(place[axis] + 1 + order >= size[axis])];
                    sum.0 += difference * difference;
                    sum.1 += 1;
                }
            }
        }
    }
    sums.map(|[inside, seam]| {
        (
            (seam.0 / seam.1 as f64).sqrt(),
            (inside.0 / inside.1 as f64).sqrt(),
        )
    })
}

#[test]
fn no_seam_shows() {
    for (texture, channels) in [(SHAPE, 4), (DETAIL, 4), (CURL, 3), (WEATHER, 4), (SHEET, 4)] {
        let axes = if recipes(1)[texture].size[2] > 1 { 3 } else { 2 };
        for c in 0..channels {
            for axis in 0..axes {
                for (seam, inside) in roughness(texture, c, axis) {
                    // One line crosses some ten independent cells only; a step in value or slope would make it many
                    // times as rough, in second differences above all.
                    assert!(
                        seam < 1.8 * inside && seam > 0.4 * inside,
                        "{texture} channel {c} axis {axis}: {seam} at the seam, {inside} elsewhere"
                    );
                }
            }
        }
    }
}

#[test]
fn rain_goes_with_much_cloud_of_tall_type() {
    let [coverage, kind, rain, fine] = [0, 1, 2, 3].map(|c| channel(WEATHER, c));
    assert!(correlation(&coverage, &rain) > 0.4);
    assert!(correlation(&kind, &rain) > 0.4);
    assert!(correlation(&coverage, &kind) < 0.7);
    assert!(correlation(&coverage, &fine) < 0.7);
}

#[test]
fn the_flow_in_the_texture_has_no_sources() {
    let [east, north, up] = [0, 1, 2].map(|c| channel(CURL, c).iter().map(|v| 2.0 * v - 1.0).collect());
    let parts: [Vec<f64>; 3] = [east, north, up];
    let side = recipes(1)[CURL].size[0] as usize;
    let (mut sources, mut slopes) = (0.0, 0.0);
    for y in 0..side {
        for x in 0..side {
            let at =
                |part: usize, dx: usize, dy: usize| parts[part][(y + dy) % side * side + (x + dx) % side];
            let along_x = at(0, 2, 1) - at(0, 0, 1);
            let along_y = at(1, 1, 2) - at(1, 1, 0);
            sources += (along_x + along_y).powi(2);
            slopes += along_x.powi(2) + along_y.powi(2);
        }
    }
    // Eddies of five texels, seen through steps of two, and bytes.
    assert!(sources < 0.05 * slopes, "{sources} of {slopes}");
    let all: Vec<f64> = parts.concat();
    let fastest = all.iter().fold(0.0_f64, |a, v| a.max(v.abs()));
    let rms = mean(&all.iter().map(|v| v * v).collect::<Vec<_>>()).sqrt();
    assert!(
        fastest > 0.99 && (0.18..0.35).contains(&rms),
        "fastest {fastest}, RMS {rms}"
    );
    // Bytes have no middle; half a step is the mean's error.
    assert!(mean(&all).abs() < 0.5 / 127.0 + 1e-3);
}

#[test]
fn seeds_and_frequencies_make_a_difference() {
    // Made before the device is taken, since that takes it too.
    let made_first: &[_] = &*MADE;
    let engine = engine();
    let other = |recipe: &Recipe| bytes(&engine.gpu, None, recipe).unwrap().0;
    let apart = |a: &[u8], b: &[u8]| {
        let sum: u64 = a.iter().zip(b).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
        sum as f64 / a.len() as f64
    };
    for (made, recipe) in made_first.iter().zip(&recipes(2)) {
        // Curl stays near its middle, and has a channel without content: two fields of it are some 20 steps apart.
        let apart = apart(made, &other(recipe));
        assert!(apart > 12.0, "{}: {apart}", recipe.shader.name);
    }
    assert!(apart(&MADE[DETAIL], &other(&cloud_detail(1, 4))) > 20.0);
    let shape = other(&cloud_shape(1, ShapeFrequencies { perlin: 8, worley: 4 }));
    let changed = |c: usize| (0..shape.len() / 4).any(|i| shape[4 * i + c] != MADE[SHAPE][4 * i + c]);
    assert_eq!([0, 1, 2, 3].map(changed), [true, false, false, false]);
    let shape = other(&cloud_shape(1, ShapeFrequencies { perlin: 4, worley: 8 }));
    let changed = |c: usize| (0..shape.len() / 4).any(|i| shape[4 * i + c] != MADE[SHAPE][4 * i + c]);
    assert_eq!([0, 1, 2, 3].map(changed), [true; 4]);
}

/// The highest frequencies that can be asked for are finer than the volumes can hold, and are made all the same.
#[test]
fn the_finest_noise_is_still_noise() {
    let engine = engine();
    let fine = bytes(&engine.gpu, None, &cloud_detail(1, 32)).unwrap().0;
    let levels: std::collections::BTreeSet<u8> = fine.iter().copied().collect();
    assert!(levels.len() > 200);
}

#[test]
fn devices_and_caches_make_no_difference() {
    let folder = tempfile::tempdir().unwrap();
    let cache = DiskCache {
        folder: folder.path().join("made when needed"),
        most_bytes: 1 << 28,
    };
    let other = Gpu::open(&AdapterChoice::default()).unwrap();
    for (made, recipe) in MADE.iter().zip(&recipes(1)) {
        // Made and kept, then found; and made on another device, by the same driver.
        for cache in [Some(&cache), Some(&cache), None] {
            assert!(
                bytes(&other, cache, recipe).unwrap().0 == *made,
                "{}",
                recipe.shader.name
            );
        }
    }
    let kept = std::fs::read_dir(&cache.folder).unwrap().count();
    assert_eq!(kept, 5);
    assert!(engine().gpu.lost().is_none());
}

#[test]
fn what_is_there_is_not_made_again() {
    let folder = tempfile::tempdir().unwrap();
    let cache = DiskCache {
        folder: folder.path().into(),
        most_bytes: 1 << 28,
    };
    let engine = engine();
    let gpu = &engine.gpu;
    let mut noise = CloudNoise::new(Some(cache));
    type Ask = fn(&mut CloudNoise, &Gpu, u32) -> Arc<Table>;
    let asks: [Ask; 5] = [
        |noise, gpu, seed| noise.shape(gpu, seed, USUAL).unwrap(),
        |noise, gpu, seed| noise.detail(gpu, seed, 2).unwrap(),
        |noise, gpu, seed| noise.curl(gpu, seed).unwrap(),
        |noise, gpu, seed| noise.weather(gpu, seed).unwrap(),
        |noise, gpu, seed| noise.sheet(gpu, seed).unwrap(),
    ];
    for (ask, recipe) in asks.into_iter().zip(&recipes(1)) {
        let first = ask(&mut noise, gpu, 1);
        let texture = first.view.texture();
        let size = [texture.width(), texture.height(), texture.depth_or_array_layers()];
        assert_eq!(size, recipe.size, "{}", recipe.shader.name);
        assert!(Arc::ptr_eq(&first, &ask(&mut noise, gpu, 1)));
    }
    let weather = [1, 2, 1].map(|seed| noise.weather(gpu, seed).unwrap());
    assert!(weather[0].made_from != weather[1].made_from && Arc::ptr_eq(&weather[0], &weather[2]));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 6);
}
