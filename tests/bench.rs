//! `welkin bench` end to end, at a size that costs little. What it says of time is not judged; the facts are.
#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use serde_json::{Value, json};
use std::process::Command;

/// The report of one round at one size, without a baseline, and what was said beside it.
fn measured(case: &str, baseline: &str) -> (Value, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_welkin"))
        .args(["bench", case, "--sizes", "64x36", "--rounds", "1", "--json"])
        .args(["--baseline", baseline])
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{told}");
    (serde_json::from_slice(&output.stdout).unwrap(), told)
}

#[test]
fn the_sky_is_measured_and_no_pass_runs_in_vain() {
    let missing = "no/such/folder";
    let (report, told) = measured("sky", missing);

    assert_eq!(report["faults"].as_array().map(Vec::len), Some(0));
    assert_eq!(report["rounds"], 1);
    assert!(report["cores"].as_u64().unwrap() >= 1);
    for name in ["build", "adapter", "driver", "kind", "backend"] {
        assert!(!report[name].as_str().unwrap().is_empty(), "{name}");
    }
    assert!(report["baseline"].is_null());
    assert!(report["baseline_absent"].as_str().unwrap().contains(missing));
    assert!(told.contains(missing), "{told}");

    let rows = report["rows"].as_array().unwrap();
    let works = [
        ("first-frame", None),
        ("sun-moved", Some(vec!["sky_view", "sky", "exposure", "tone"])),
        ("camera-turned", Some(vec!["sky", "exposure", "tone"])),
        ("nothing-changed", Some(vec![])),
        (
            "air-changed",
            Some(vec![
                "transmittance",
                "multi_scattering",
                "sky_view",
                "sky",
                "exposure",
                "tone",
            ]),
        ),
        ("encode-png", Some(vec![])),
        ("encode-jpeg", Some(vec![])),
    ];
    assert_eq!(rows.len(), 2 * works.len());
    for (rows, quality) in rows.chunks(works.len()).zip(["preview", "final"]) {
        for (row, (work, passes)) in rows.iter().zip(&works) {
            assert_eq!(
                (&row["work"], &row["quality"]),
                (&Value::from(*work), &Value::from(quality))
            );
            assert_eq!(row["case"], "sky");
            assert_eq!(
                (&row["width_px"], &row["height_px"]),
                (&Value::from(64), &Value::from(36))
            );
            assert!(row["wall_ms"].as_f64().unwrap() >= 0.0, "{row}");
            assert!(row["baseline"].is_null() && row["speedup"].is_null());
            let ran = row["passes"].as_array().unwrap();
            let ran: Vec<_> = ran.iter().map(|pass| pass["pass"].as_str().unwrap()).collect();
            if let Some(passes) = passes {
                assert_eq!(&ran, passes, "{quality} {work}");
            }
            // 0.02: a few times what tables of these sizes leave; a broken one is off by tens of per cent.
            let error = row["error"].as_f64();
            assert_eq!(error.is_some(), !ran.is_empty(), "{row}");
            assert!(error.is_none_or(|error| error < 0.02), "{row}");
            if cfg!(target_os = "linux") {
                assert!(row["cpu_ms"].as_f64().unwrap() >= 0.0, "{row}");
                assert!(row["peak_memory_bytes"].as_u64().unwrap() > 1 << 20, "{row}");
            }
        }
    }
}

#[test]
fn the_three_approaches_are_measured_side_by_side() {
    let (report, _) = measured("air", "no/such/folder");
    assert_eq!(report["faults"], json!([]));
    let rows = report["rows"].as_array().unwrap();
    let works = ["camera-turned", "camera-moved", "sun-moved"];
    assert_eq!(rows.len(), 2 * 3 * works.len());
    for (index, row) in rows.iter().enumerate() {
        let place = ["ground", "space"][index / 9];
        let method = ["nested", "table", "lut"][index / 3 % 3];
        let named = (&row["place"], &row["method"], &row["work"]);
        assert_eq!(
            named,
            (&json!(place), &json!(method), &json!(works[index % 3])),
            "{row}"
        );
        assert!(row["baseline"].is_null());
        // Followed anew in each work: a frame that was kept from before would name no pass.
        let ran: Vec<_> = row["passes"].as_array().unwrap().iter().collect();
        assert!(ran.iter().any(|pass| pass["pass"] == "sky"), "{row}");
        // 0.01: 30 midpoint steps leave 0.3 %; a broken method is off by tens of per cent.
        let error = row["error"].as_f64().unwrap();
        assert!(error > 0.0 && error < 0.01, "{row}");
        // Times are not judged, but the ratio must be of the times that stand in the report.
        let nested = &rows[9 * (index / 9) + index % 3];
        let ms = |row: &Value| row["wall_ms"].as_f64().unwrap();
        match row["speedup"]["wall_ratio"].as_f64() {
            Some(ratio) => assert!((ratio * ms(row) / ms(nested) - 1.0).abs() < 1e-9, "{row}"),
            None => assert_eq!(method, "nested", "{row}"),
        }
    }
}

#[test]
fn what_cannot_be_measured_is_told() {
    for (arguments, words) in [
        (["no-such-case", "--rounds", "1"], "there are sky, air"),
        (["sky", "--sizes", "640"], "WIDTHxHEIGHT"),
        (["sky", "--rounds", "0"], "--rounds"),
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_welkin"));
        let output = command.arg("bench").args(arguments).output().unwrap();
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(words), "{told}");
    }
}
