//! The lattice of extinction that another program was given is the cloud that the shaders march through.
//!
//! `WELKIN_UPDATE_ORACLES=1` writes it anew; `tests/tools/cloud_oracle.py` then has to be run on it.

use super::{Ready, VOLUME, passes, slab::look};
use crate::{
    shader,
    tests::{engine, evaluate},
};
use glam::UVec2;
use serde_json::Value;
use std::{
    fs::File,
    io::{BufReader, BufWriter},
    path::PathBuf,
    sync::Arc,
};
use welkin_scene::{
    Scene,
    assets::{SceneAssets, WeatherPicture},
};

fn oracle(file: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../tests/oracles")
        .join(file)
}

fn document(file: &str) -> Value {
    serde_json::from_reader(BufReader::new(File::open(oracle(file)).unwrap())).unwrap()
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|i| value[i].as_f64().unwrap())
}

/// Few texels that are not clear, so that there is one cloud.
fn weather(document: &Value) -> SceneAssets {
    let side = document["weather"]["side_px"].as_u64().unwrap() as u32;
    let mut rgba = [0, 255, 0, 255].repeat((side * side) as usize);
    for texel in document["weather"]["texels"].as_array().unwrap() {
        let [x, y, coverage] = numbers(texel);
        rgba[4 * (y as usize * side as usize + x as usize)] = coverage as u8;
    }
    let picture = WeatherPicture {
        width_px: side,
        height_px: side,
        rgba: rgba.into(),
        digest: [7; 32],
    };
    let mut assets = SceneAssets::default();
    assets.weather_maps.insert("one-cloud".into(), Arc::new(picture));
    assets
}

struct Cube {
    cells: usize,
    cell_m: f64,
    least_m: [f64; 3],
    most: f64,
}

impl Cube {
    fn new(document: &Value) -> Self {
        let cube = &document["cube"];
        let cells = cube["cells"].as_u64().unwrap() as usize;
        Self {
            cells,
            cell_m: cube["side_m"].as_f64().unwrap() / cells as f64,
            least_m: numbers(&cube["least_m"]),
            most: document["most_extinction_per_m"].as_f64().unwrap(),
        }
    }

    /// Middles of the cells, x fastest, and their altitudes over the round planet.
    fn rows(&self, radius_m: f64) -> Vec<[f32; 8]> {
        let at = |i: usize, axis: usize| self.least_m[axis] + (i as f64 + 0.5) * self.cell_m;
        let all = 0..self.cells.pow(3);
        all.map(|k| {
            let (i, j, l) = (k % self.cells, k / self.cells % self.cells, k / self.cells.pow(2));
            let p = [at(i, 0), at(j, 1), at(l, 2)];
            let altitude = p[2] + (p[0] * p[0] + p[1] * p[1]) / (2.0 * radius_m);
            [p[0], p[1], p[2], altitude, 0.0, 0.0, 0.0, 0.0].map(|v| v as f32)
        })
        .collect()
    }

    /// Where a cell stands in the picture: layers from below, eight in a row, each with north down.
    fn texel(&self, k: usize) -> usize {
        let (i, j, l) = (k % self.cells, k / self.cells % self.cells, k / self.cells.pow(2));
        (l / 8 * self.cells + j) * 8 * self.cells + l % 8 * self.cells + i
    }
}

fn write(cube: &Cube, levels: &[u8]) {
    let side = 8 * cube.cells as u32;
    let file = BufWriter::new(File::create(oracle("cloud_grid.png")).unwrap());
    let mut encoder = png::Encoder::new(file, side, side);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_compression(png::Compression::High);
    let mut texels = vec![0; levels.len()];
    for (k, level) in levels.iter().enumerate() {
        texels[cube.texel(k)] = *level;
    }
    encoder.write_header().unwrap().write_image_data(&texels).unwrap();
}

fn read(cube: &Cube) -> Vec<u8> {
    let file = BufReader::new(File::open(oracle("cloud_grid.png")).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut texels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut texels).unwrap();
    (0..cube.cells.pow(3)).map(|k| texels[cube.texel(k)]).collect()
}

#[test]
fn the_lattice_is_the_cloud() {
    let document = document("cloud_scene.json");
    let scene = Scene::from_value(&document["scene"]).unwrap();
    let engine = engine();
    let ready = Ready::with(&engine.gpu, &mut passes(), &scene, &weather(&document));
    let cube = Cube::new(&document);
    let statement = "x.x = band_extinction(clouds.bands[0], a.xyz, a.w, Look(true, 0.0, 0.0)).value;";
    let found = evaluate(
        &engine.gpu,
        &shader::CLOUD_VIEW_LIGHT,
        statement,
        &cube.rows(scene.planet.radius_m),
        &ready.binds(&engine.gpu, &VOLUME),
    );
    let levels: Vec<_> = found
        .iter()
        .map(|row| 255.0 * f64::from(row[0]) / cube.most)
        .collect();
    if std::env::var_os("WELKIN_UPDATE_ORACLES").is_some() {
        let whole: Vec<_> = levels.iter().map(|level| level.round() as u8).collect();
        write(&cube, &whole);
    }
    let kept = read(&cube);
    let apart = levels
        .iter()
        .zip(&kept)
        .map(|(level, kept)| (level - f64::from(*kept)).abs());
    let worst = apart.fold(0.0, f64::max);
    println!("worst of {} cells: {worst:.3} of 255 steps", kept.len());
    // Half a step of rounding, and what a driver's own rounding of noise and sampling may add.
    assert!(worst < 1.0, "{worst}");
}

/// Before light is compared: the other program sees the same cloud in the same place.
#[test]
fn as_much_comes_through_as_through_the_lattice() {
    const BLOCKS: usize = 16;
    const FINENESS: usize = 4;
    let document = document("cloud_scene.json");
    let truth = &self::document("cloud_radiance.json")["transmittance"];
    let scene = Scene::from_value(&document["scene"]).unwrap();
    let side = BLOCKS * FINENESS;
    let size = UVec2::splat(side as u32);
    let found = look(&engine().gpu, &scene, &weather(&document), size);
    let mut apart = Vec::new();
    for y in 0..BLOCKS {
        for x in 0..BLOCKS {
            let texel = |k: usize| {
                let (dx, dy) = (k % FINENESS, k / FINENESS);
                f64::from(found[(y * FINENESS + dy) * side + x * FINENESS + dx][3])
            };
            let mean = (0..FINENESS * FINENESS).map(texel).sum::<f64>() / (FINENESS * FINENESS) as f64;
            apart.push((mean - truth[y][x].as_f64().unwrap()).abs());
        }
    }
    let mean = apart.iter().sum::<f64>() / apart.len() as f64;
    let worst = apart.iter().copied().fold(0.0, f64::max);
    println!("transmittance: {mean:.4} apart on average, {worst:.4} at worst");
    // Sixteen rays to a square: where the cloud's edge is sharper than a pixel they are off by up to half a row of four.
    assert!(mean < 0.008 && worst < 0.06, "{mean}, {worst}");
}
