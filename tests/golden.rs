//! Small pictures of known good skies, compared as the eye would (FLIP, Andersson et al. 2020).
//!
//! `WELKIN_UPDATE_GOLDENS=1` writes them anew; look at each before it is committed. On failure the picture that was
//! rendered and the difference are left in `target/tmp/golden`.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::cast_possible_truncation,
    reason = "tests fail by panicking"
)]

use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8, FlipPool, flip, magma_lut};
use std::{
    fs::{self, File},
    io::{BufReader, BufWriter, Write as _},
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

/// Name, scene, width and height.
const SCENES: &[(&str, &str, u32, u32)] = &[
    ("default", "{}", 160, 90),
    ("clear", r#"{"clouds": null}"#, 160, 90),
    ("clear-noon", "preset:clear-noon", 160, 90),
    ("golden-hour", "preset:golden-hour", 160, 90),
    ("twilight", "preset:twilight", 160, 90),
    ("moonlit-night", "preset:moonlit-night", 160, 90),
    ("starry-night", "preset:starry-night", 160, 90),
    ("from-orbit", "preset:from-orbit", 160, 90),
    ("complutense", "preset:complutense", 160, 90),
    (
        "fisheye",
        r#"{"sun": {"position": {"azimuth_deg": 240, "elevation_deg": 12}}, "clouds": null,
            "camera": {"direction": {"azimuth_deg": 0, "elevation_deg": 90}, "projection": {"kind": "fisheye"}}}"#,
        120,
        120,
    ),
    (
        "equirectangular",
        r#"{"sun": {"position": {"azimuth_deg": 150, "elevation_deg": 20}}, "clouds": null,
            "camera": {"projection": {"kind": "equirectangular"}}}"#,
        160,
        80,
    ),
    (
        "cubemap",
        r#"{"sun": {"position": {"azimuth_deg": 150, "elevation_deg": 20}}, "clouds": null,
            "camera": {"projection": {"kind": "cubemap"}}}"#,
        192,
        32,
    ),
];

/// Mean FLIP error. Mesa 22.3 and 25.0 give the same bytes; a driver that rounds otherwise moves single pixels by one
/// step of 8-bit colour. One dark pixel at the zenith of the cubemap, a fault we had, was 0.007.
const ALLOWED: f32 = 0.005;

fn render(scene: &str, width_px: u32, height_px: u32, to: &Path) {
    let named = scene.starts_with("preset:");
    let mut process = Command::new(env!("CARGO_BIN_EXE_welkin"))
        .args([
            "render",
            if named { scene } else { "-" },
            "-o",
            to.to_str().unwrap(),
        ])
        .args([
            "--width-px",
            &width_px.to_string(),
            "--height-px",
            &height_px.to_string(),
        ])
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    if !named {
        process
            .stdin
            .as_mut()
            .unwrap()
            .write_all(scene.as_bytes())
            .unwrap();
    }
    drop(process.stdin.take());
    assert!(process.wait().unwrap().success(), "{scene}");
}

fn read(path: &Path) -> FlipImageRgb8 {
    let mut reader = png::Decoder::new(BufReader::new(File::open(path).unwrap()))
        .read_info()
        .unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    FlipImageRgb8::with_data(info.width, info.height, &pixels)
}

fn write(path: &Path, image: &FlipImageRgb8) {
    let mut encoder = png::Encoder::new(
        BufWriter::new(File::create(path).unwrap()),
        image.width(),
        image.height(),
    );
    encoder.set_color(png::ColorType::Rgb);
    encoder
        .write_header()
        .unwrap()
        .write_image_data(&image.to_vec())
        .unwrap();
}

#[test]
fn pictures_look_as_they_should() {
    let goldens = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("golden");
    fs::create_dir_all(&folder).unwrap();
    let update = std::env::var_os("WELKIN_UPDATE_GOLDENS").is_some();
    let mut wrong = Vec::new();
    for (name, scene, width_px, height_px) in SCENES {
        let golden = goldens.join(format!("{name}.png"));
        let rendered = folder.join(format!("{name}.png"));
        render(scene, *width_px, *height_px, &rendered);
        if update {
            fs::copy(&rendered, &golden).unwrap();
        }
        assert!(
            fs::metadata(&golden).unwrap().len() <= 64 << 10,
            "{name}.png is over 64 KiB"
        );
        let error = flip(read(&golden), read(&rendered), DEFAULT_PIXELS_PER_DEGREE);
        let mean = FlipPool::from_image(&error).mean();
        println!("{name}: {mean:.4}");
        if mean > ALLOWED {
            write(
                &folder.join(format!("{name}-difference.png")),
                &error.apply_color_lut(&magma_lut()),
            );
            wrong.push(format!("{name}: {mean:.4}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}; see {}", folder.display());
}
