//! `welkin scene`: scenes completed, and made of weather reports. No device is needed.
#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use serde_json::Value;
use std::{
    io::Write,
    process::{Command, Output, Stdio},
};
use welkin_scene::Scene;

const FOG: &str = "METAR EGUW 030650Z 05003KT 0600 FG FEW060 12/12 Q1021 RED";

fn welkin(args: &[&str], input: &str) -> Output {
    let mut process = Command::new(env!("CARGO_BIN_EXE_welkin"))
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A process that refuses its arguments may end before it reads.
    drop(process.stdin.take().unwrap().write_all(input.as_bytes()));
    process.wait_with_output().unwrap()
}

fn printed(output: &Output) -> Value {
    assert!(output.status.success(), "{}", said(output));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[test]
fn a_scene_is_completed() {
    let scene = printed(&welkin(&["scene", "-"], r#"{"planet": {"radius_m": 1e6}}"#));
    assert_eq!(scene["planet"]["radius_m"], 1e6);
    assert_eq!(
        scene["planet"]["ground_albedo"],
        serde_json::json!([0.1, 0.1, 0.1])
    );
    assert_eq!(scene["sun"], serde_json::to_value(Scene::default().sun).unwrap());
    let preset = printed(&welkin(&["scene", "preset:twilight", "--json"], ""));
    assert!(Scene::from_value(&preset).is_ok());
    let refused = welkin(&["scene", "-"], r#"{"planet": {"radius_m": 1}}"#);
    assert_eq!(refused.status.code(), Some(2));
    assert!(said(&refused).contains("/planet/radius_m"), "{}", said(&refused));
}

#[test]
fn a_timeline_is_a_scene_at_each_time() {
    const DAY: &str = r#"{"keyframes": [
        {"at_s": 0, "patch": {"sun": {"position": {"azimuth_deg": 90, "elevation_deg": 0}}}},
        {"at_s": 10, "patch": {"sun": {"position": {"azimuth_deg": 90, "elevation_deg": 80}}}}]}"#;
    let scene = printed(&welkin(&["scene", "-", "--at-s", "5"], DAY));
    let scene = Scene::from_value(&scene).unwrap();
    assert_eq!(scene.time_s, 5.0);
    // Through vectors and back: a few roundings at 90°.
    assert!((scene.sun_place().elevation_deg - 40.0).abs() < 1e-12);
    let wrong = DAY.replace("80", "800");
    for command in [
        &["scene", "-", "--at-s", "-5"][..],
        &["render", "-", "--at-s", "5", "-o", "-", "--format", "png"],
    ] {
        let refused = welkin(command, &wrong);
        assert_eq!(refused.status.code(), Some(2), "{command:?}");
        let pointer = "/keyframes/1/patch/sun/position/elevation_deg";
        assert!(said(&refused).contains(pointer), "{}", said(&refused));
    }
    for command in ["scene", "render"] {
        let output = if command == "render" {
            &["-o", "-"][..]
        } else {
            &[]
        };
        let never = welkin(&[&[command, "-", "--at-s", "nan"], output].concat(), "{}");
        assert_eq!(never.status.code(), Some(2), "{}", said(&never));
        assert!(said(&never).contains("not a finite number"), "{}", said(&never));
    }
}

#[test]
fn a_weather_report_becomes_a_scene() {
    let output = welkin(&["scene", "--metar", FOG, "--date", "2018-09-03"], "");
    let scene = Scene::from_value(&printed(&output)).unwrap();
    assert_eq!(scene.haze.unwrap().top_m, 150.0);
    assert!(said(&output).contains("not rendered: RED"), "{}", said(&output));
    let place = ["--latitude-deg", "-60", "--longitude-deg", "-30.5"];
    let args = [
        &["scene", "--json", "--metar", "-", "--date", "2018-09-03"][..],
        &place,
    ]
    .concat();
    let answer = printed(&welkin(&args, FOG));
    let position = &answer["scene"]["sun"]["position"];
    assert_eq!(position["time"], "2018-09-03T06:50:00Z");
    assert_eq!(
        (&position["latitude_deg"], &position["longitude_deg"]),
        (&(-60.0).into(), &(-30.5).into())
    );
    assert_eq!(answer["report"]["station"], "EGUW");
}

#[test]
fn a_bad_report_ends_with_2_and_names_its_group() {
    let refused = welkin(&["scene", "--metar", "METAR EGUW 030650Z 05003KT 0600 FOG"], "");
    assert_eq!(refused.status.code(), Some(2));
    assert!(refused.stdout.is_empty());
    assert!(
        said(&refused).starts_with("error: group 6 of the report, `FOG` at character 33,"),
        "{}",
        said(&refused)
    );
    let problem = welkin(
        &[
            "scene",
            "--json",
            "--metar",
            "METAR EGUW 030650Z 05003KT 0600 FOG",
        ],
        "",
    );
    let problem: Value = serde_json::from_slice(&problem.stderr).unwrap();
    assert_eq!(
        (&problem["group"]["group"], &problem["group"]["number"]),
        (&"FOG".into(), &6.into())
    );
    for wrong in [
        &["scene"][..],
        &["scene", "preset:twilight", "--metar", FOG],
        &["scene", "preset:twilight", "--date", "2018-09-03"],
        &[
            "scene",
            "--metar",
            FOG,
            "--latitude-deg",
            "91",
            "--longitude-deg",
            "0",
        ],
        &["scene", "--metar", FOG, "--latitude-deg", "1"],
        &["scene", "--metar", FOG, "--date", "03.09.2018"],
    ] {
        assert_eq!(welkin(wrong, "").status.code(), Some(2), "{wrong:?}");
    }
}
