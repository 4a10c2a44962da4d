//! `welkin bench` end to end, at a size that costs little. What it says of time is not judged; the facts are.
#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use serde_json::{Value, json};
use std::{ffi::OsStr, process::Command};

/// The report of one round at one size, without a baseline, and what was said beside it.
fn measured(case: &str, baseline: &str) -> (Value, String) {
    measured_with(case, baseline, &[])
}

fn measured_with(case: &str, baseline: &str, more: &[&OsStr]) -> (Value, String) {
    measured_at("64x36", case, baseline, more)
}

fn measured_at(sizes: &str, case: &str, baseline: &str, more: &[&OsStr]) -> (Value, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_welkin"))
        .args(["bench", case, "--sizes", sizes, "--rounds", "1", "--json"])
        .args(["--baseline", baseline])
        .args(more)
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
        ("sun-moved", Some(vec!["sky_view", "sky", "exposure"])),
        ("camera-turned", Some(vec!["sky", "exposure"])),
        ("nothing-changed", Some(vec![])),
        (
            "air-changed",
            Some(vec![
                "transmittance",
                "multi_scattering",
                "sky_view",
                "sky",
                "exposure",
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
            assert_eq!((&row["baselines"], &row["rounds"]), (&json!([]), &json!(1)));
            assert!(row["speedup"].is_null() && row["varied"].is_null());
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
        assert_eq!(row["baselines"], json!([]));
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
fn clouds_are_measured_by_what_changes_and_table_by_table() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("report.html");
    let (report, _) = measured_with(
        "clouds",
        "no/such/folder",
        &[
            "--report".as_ref(),
            page.as_os_str(),
            "--tables".as_ref(),
            "changes,shell-density,shell-coverage,shell-size,noise,steps,coverage,light-steps,combinations"
                .as_ref(),
        ],
    );
    assert_eq!(report["faults"], json!([]));
    assert!(report["baseline_off"].is_null());
    let rows = report["rows"].as_array().unwrap();
    let of = |table: &str, quality: &str| {
        let quality = (quality != "any").then_some(quality);
        let all = rows
            .iter()
            .filter(|row| row["table"] == table && quality.is_none_or(|quality| row["quality"] == quality));
        all.collect::<Vec<_>>()
    };
    let ran = |row: &Value, pass: &str| {
        let passes = row["passes"].as_array().unwrap();
        passes.iter().any(|ran| ran["pass"] == pass)
    };

    for quality in ["preview", "final"] {
        let changes = of("changes", quality);
        let works: Vec<_> = changes.iter().map(|row| row["work"].as_str().unwrap()).collect();
        assert_eq!(
            works,
            ["first-frame", "sun-moved", "camera-turned", "nothing-changed"]
        );
        for (row, work) in changes.iter().zip(works) {
            let rendered = work != "nothing-changed";
            assert_eq!(!row["passes"].as_array().unwrap().is_empty(), rendered, "{row}");
        }
    }

    // How many frames each table has, and a field of `clouds` that it varies.
    for (table, qualities, field, values) in [
        ("shell-density", 2, "density", 8),
        ("shell-coverage", 2, "coverage", 6),
        ("steps", 1, "steps", 5),
        ("coverage", 1, "coverage", 5),
        ("light-steps", 1, "light_steps", 5),
        ("combinations", 1, "light_steps", 2),
    ] {
        let rows = of(table, "any");
        let frames = if table == "combinations" { 8 } else { values };
        assert_eq!(rows.len(), qualities * frames, "{table}");
        let mut found: Vec<_> = rows
            .iter()
            .map(|row| row["varied"][field].as_f64().unwrap())
            .collect();
        found.sort_by(f64::total_cmp);
        found.dedup();
        assert_eq!(found.len(), values, "{table}: {found:?}");
        for row in rows {
            // Without density there are no clouds to follow rays through.
            let seen = row["varied"]["density"] != json!(0.0);
            // The preset's own values have been seen before, under another sun.
            let followed = ran(row, "cloud_view_light") || ran(row, "cloud_dome_light");
            assert_eq!(followed, seen, "{row}");
        }
    }
    let made = of("noise", "any");
    assert_eq!(made.len(), 1);
    assert!(
        ran(made[0], "cloud_shape") && ran(made[0], "cloud_weather"),
        "{made:?}"
    );

    assert!(of("truth", "any").is_empty());
    let page = std::fs::read_to_string(page).unwrap();
    // By one size nothing can be plotted against sizes.
    assert_eq!(page.matches("<svg").count(), 5, "{page}");
    assert_eq!(page.matches("<tr").count(), 1 + rows.len());
    for foreign in ["src=", "href=", "url("] {
        assert!(!page.contains(foreign), "{foreign}");
    }
}

#[test]
fn six_skies_are_compared_with_brute_force() {
    let (report, _) = measured_at(
        "16x9",
        "clouds",
        "no/such/folder",
        &["--tables".as_ref(), "truth".as_ref()],
    );
    assert_eq!(report["faults"], json!([]));
    let rows = report["rows"].as_array().unwrap();
    let scenes: Vec<_> = rows
        .chunks(3)
        .map(|rows| rows[0]["scene"].as_str().unwrap())
        .collect();
    assert_eq!(
        scenes,
        [
            "noon",
            "low-sun-in-view",
            "sun-behind",
            "overcast",
            "cirrus",
            "storm"
        ]
    );
    for rows in rows.chunks(3) {
        let [preview, last, exact] = rows else {
            panic!("{rows:?}")
        };
        for (row, (work, error, flip)) in [preview, last, exact].into_iter().zip([
            ("preview", Value::Null, json!(0.05)),
            ("final", json!(0.01), Value::Null),
            ("brute-force", Value::Null, Value::Null),
        ]) {
            assert_eq!((&row["table"], &row["work"]), (&json!("truth"), &json!(work)));
            assert_eq!(
                (&row["target_error"], &row["target_flip"]),
                (&error, &flip),
                "{row}"
            );
        }
        assert!(exact["error"].is_null() && exact["flip"].is_null(), "{exact}");
        for row in [preview, last] {
            // How near they must be, the renderer's tests say; 1.0 is the error of a black frame.
            let (error, flip) = (row["error"].as_f64().unwrap(), row["flip"].as_f64().unwrap());
            assert!((0.0..1.0).contains(&error) && (0.0..1.0).contains(&flip), "{row}");
        }
        // One ray for many pixels cannot hit them all.
        assert!(preview["error"].as_f64() > Some(0.0), "{preview}");
    }
}

#[test]
fn ground_is_measured_with_shadows_and_shafts_and_without() {
    let (report, _) = measured_with(
        "ground",
        "no/such/folder",
        &["--tables".as_ref(), "final-approach".as_ref()],
    );
    assert_eq!(report["faults"], json!([]));
    let rows = report["rows"].as_array().unwrap();
    let works = [
        "first-frame",
        "sun-moved",
        "camera-turned",
        "camera-moved",
        "nothing-changed",
        "air-changed",
    ];
    // Two places, two meshes and three lights; the mountains by seed of the other table take seconds a process to make.
    assert_eq!(rows.len(), 2 * 2 * 3 * works.len());
    let ran = |row: &Value, pass: &str| {
        let passes = row["passes"].as_array().unwrap();
        passes.iter().any(|ran| ran["pass"] == pass)
    };
    for rows in rows.chunks(works.len()) {
        for (row, work) in rows.iter().zip(works) {
            assert_eq!(row["work"], work);
            let rendered = work != "nothing-changed";
            assert_eq!(!row["passes"].as_array().unwrap().is_empty(), rendered, "{row}");
            let light = row["light"].as_str().unwrap();
            assert_eq!(ran(row, "ground_view"), rendered, "{row}");
            let shadowed = light != "plain" && ["first-frame", "sun-moved"].contains(&work);
            assert_eq!(ran(row, "ground_shadow"), shadowed, "{row}");
            let shafted = light == "shadows-and-shafts" && rendered;
            assert_eq!(ran(row, "shafts"), shafted, "{row}");
            // Times are not judged, but the ratio must be of the times that stand in the report.
            assert_eq!(row["cost"].is_null(), light == "plain", "{row}");
            let plain = rows_beside(&report, row);
            let time = if report["kind"] == "cpu" {
                "cpu_ms"
            } else {
                "wall_ms"
            };
            if let (Some(ratio), Some(ms)) = (row["cost"]["ratio"].as_f64(), plain[time].as_f64()) {
                assert!(
                    (ratio * ms / row[time].as_f64().unwrap() - 1.0).abs() < 1e-9,
                    "{row}"
                );
            }
            let counts = light == "shadows-and-shafts" && work.starts_with("camera-");
            assert_eq!(row["target_cost_ratio"], json!(counts.then_some(2.0)), "{row}");
        }
    }
}

/// The same work without shadows and shafts.
fn rows_beside<'a>(report: &'a Value, row: &Value) -> &'a Value {
    let all = report["rows"].as_array().unwrap().iter();
    let mut plain = all.filter(|other| {
        let same = |field| other[field] == row[field];
        other["light"] == "plain" && ["table", "work", "relief", "place"].into_iter().all(same)
    });
    plain.next().unwrap()
}

#[test]
fn ground_is_measured_by_the_size_of_its_shadow_map_and_of_its_mesh() {
    let (report, _) = measured_with(
        "ground",
        "no/such/folder",
        &["--tables".as_ref(), "shadow-maps,triangles".as_ref()],
    );
    assert_eq!(report["faults"], json!([]));
    let rows = report["rows"].as_array().unwrap();
    let of = |table: &'static str| rows.iter().filter(move |row| row["table"] == table);
    let sizes: Vec<_> = of("shadow-maps")
        .map(|row| {
            (
                row["work"].as_str().unwrap(),
                row["varied"]["shadow_size_px"].as_u64().unwrap(),
            )
        })
        .collect();
    let both = |size| [("sun-moved", size), ("camera-turned", size)];
    assert_eq!(sizes, [512, 1024, 2048, 4096, 8192].map(both).concat());
    let turned: Vec<_> = of("triangles")
        .filter(|row| row["work"] == "camera-turned")
        .collect();
    let [few, many] = turned[..] else {
        panic!("{turned:?}")
    };
    assert_eq!(
        (&few["triangles"], &many["triangles"]),
        (&json!(99_856), &json!(1_000_000))
    );
    assert!(few["cost"].is_null() && few["target_cost_ratio"].is_null());
    assert_eq!(many["target_cost_ratio"], json!(1.5));
    assert!(many["cost"]["ratio"].as_f64().unwrap() > 0.0);
}

#[test]
fn a_report_that_cannot_be_written_is_told_before_anything_is_measured() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_welkin"));
    let output = command
        .args(["bench", "clouds", "--report"])
        .arg(folder.path().join("no/such/folder.html"))
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success(), "{told}");
    assert!(told.contains("folder.html"), "{told}");
}

#[test]
fn what_cannot_be_measured_is_told() {
    for (arguments, words) in [
        (
            ["no-such-case", "--rounds", "1"],
            "there are sky, air, clouds, ground",
        ),
        (["sky", "--sizes", "640"], "WIDTHxHEIGHT"),
        (["sky", "--rounds", "0"], "--rounds"),
        (["sky", "--tables", "truth"], "there are none"),
        (
            ["clouds", "--tables", "truth,no-such-table"],
            "\"no-such-table\"; there are changes, ",
        ),
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_welkin"));
        let output = command.arg("bench").args(arguments).output().unwrap();
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(words), "{told}");
    }
}
