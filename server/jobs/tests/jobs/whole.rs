//! What is made of all frames of a job.

use crate::{
    fake::Fake,
    place::{Place, assert_done},
};
use serde_json::{Value, json};
use std::process::Command;
use welkin_encode::decode_exr;
use welkin_scene::renderer::Pixels;

#[tokio::test(flavor = "multi_thread")]
async fn a_panorama_is_one_picture_the_same_as_without_tiles() {
    let place = Place::new().await;
    let worker = place.worker(Fake::quick());
    let document = json!({"frames": {"kind": "panorama", "scene": {"time_s": 2}, "tile_px": 32},
        "width_px": 100, "height_px": 50, "format": "exr-float"});
    let id = place.send(&document).await;
    assert_done(&place.ended(id).await, 4 * 2);
    let (width, height, samples) = decode_exr(&place.file(id, "panorama.exr").await).unwrap();
    assert_eq!((width, height), (100, 50));
    let order = welkin_scene::renderer::FrameOrder {
        scene: welkin_scene::JobPlan::new(serde_json::from_value(document).unwrap())
            .unwrap()
            .frame(0)
            .unwrap()
            .scene,
        assets: Default::default(),
        width_px: 100,
        height_px: 50,
        quality: welkin_scene::Quality::Final,
        output: welkin_scene::renderer::Output::Linear,
        priority: welkin_scene::renderer::Priority::Batch,
    };
    let whole = welkin_scene::renderer::Render::frame(&*Fake::quick(), order)
        .await
        .unwrap();
    assert_eq!(whole.pixels, Pixels::Linear(samples));
    worker.stop().await;
}

fn lapse(films: &Value, format: &str) -> Value {
    json!({
        "frames": {"kind": "timeline", "to_s": 100, "count": 12, "fps": 6, "films": films,
            "timeline": {"scene": {"clouds": null}, "keyframes": [
                {"at_s": 0, "patch": {"sun": {"position": {"azimuth_deg": 90, "elevation_deg": 0}}}},
                {"at_s": 100, "patch": {"sun": {"position": {"azimuth_deg": 180, "elevation_deg": 50}}}}]}},
        "width_px": 33, "height_px": 17, "format": format,
    })
}

#[tokio::test(flavor = "multi_thread")]
async fn a_time_lapse_becomes_films_of_all_its_frames() {
    let place = Place::new().await;
    let worker = place.worker(Fake::quick());
    let has_ffmpeg = Command::new("ffmpeg").arg("-version").output().is_ok();
    for format in ["png", "jpeg"] {
        let id = place
            .send(&lapse(&json!(["apng", "gif", "mp4", "webm"]), format))
            .await;
        let status = place.ended(id).await;
        assert_done(&status, 12);

        let apng = place.file(id, "film.apng").await;
        let mut reader = png::Decoder::new(std::io::Cursor::new(&apng))
            .read_info()
            .unwrap();
        assert_eq!(reader.info().animation_control().unwrap().num_frames, 12);
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        for number in 0..12 {
            reader.next_frame(&mut pixels).unwrap();
            if format == "png" {
                let still = place.file(id, &number.to_string()).await;
                let mut still = png::Decoder::new(std::io::Cursor::new(&still))
                    .read_info()
                    .unwrap();
                let mut expected = vec![0; still.output_buffer_size().unwrap()];
                still.next_frame(&mut expected).unwrap();
                assert_eq!(pixels, expected, "frame {number}");
            }
        }

        let gif = place.file(id, "film.gif").await;
        let mut reader = gif::DecodeOptions::new().read_info(&gif[..]).unwrap();
        let (mut frames, mut delay_cs) = (0, 0);
        while let Some(frame) = reader.read_next_frame().unwrap() {
            (frames, delay_cs) = (frames + 1, delay_cs + u32::from(frame.delay));
        }
        assert_eq!((frames, delay_cs), (12, 200));

        if has_ffmpeg {
            assert_eq!(status.notes, Vec::<String>::new());
            assert_eq!(&place.file(id, "film.mp4").await[4..8], b"ftyp");
            assert_eq!(&place.file(id, "film.webm").await[..4], b"\x1a\x45\xdf\xa3");
        } else {
            assert_eq!(status.notes.len(), 2, "{:?}", status.notes);
        }
    }
    worker.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn labels_tell_what_was_drawn_and_probed() {
    let place = Place::new().await;
    let worker = place.worker(Fake::quick());
    let document = json!({"frames": {"kind": "random", "count": 20, "seed": 3, "ranges": [
            {"field": "/sun/position/elevation_deg", "from": -5, "to": 60},
            {"field": "/clouds/seed", "from": 0, "to": 9, "whole": true},
            {"field": "/display/tone_curve", "values": ["agx", "aces"]}]},
        "probe": [{"azimuth_deg": 0, "elevation_deg": 90}], "width_px": 8, "height_px": 4});
    let id = place.send(&document).await;
    assert_done(&place.ended(id).await, 20);
    let labels = String::from_utf8(place.file(id, "labels.jsonl").await).unwrap();
    let labels: Vec<Value> = labels
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(labels.len(), 20);
    for label in &labels {
        let drawn = &label["parameters"];
        assert_eq!(
            drawn["/sun/position/elevation_deg"],
            label["scene"]["sun"]["position"]["elevation_deg"]
        );
        assert_eq!(
            drawn["/display/tone_curve"],
            label["scene"]["display"]["tone_curve"]
        );
        let seed = label["scene"]["clouds"]["seed"].as_f64().unwrap();
        assert_eq!(drawn["/clouds/seed"].as_f64(), Some(seed));
        assert!(label["sun"]["elevation_deg"].is_number());
        assert_eq!(label["probe"]["transmittance"], json!([[1.0, 1.0, 1.0]]));
        assert_eq!(label["probe"]["irradiance"]["sh9"].as_array().unwrap().len(), 9);
    }
    worker.stop().await;
}
