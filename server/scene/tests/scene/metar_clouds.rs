//! The clouds that a weather report tells of.

use crate::metar::{read, reports};
use welkin_scene::{
    Clouds,
    clouds::{Genus, Layer, VolumeLayer},
    metar::report::Amount,
};

const HUNDRED_FEET_M: f64 = 30.48;

fn clouds(groups: &str) -> Option<Clouds> {
    read(&format!("EGLL 092050Z {groups} 17/12 Q1019")).scene.clouds
}

fn layers(groups: &str) -> Vec<Layer> {
    clouds(groups).unwrap_or_else(|| panic!("{groups}")).layers
}

fn volume(groups: &str) -> VolumeLayer {
    match &layers(groups)[..] {
        [Layer::Volume(volume)] => volume.clone(),
        other => panic!("{groups}: {other:?}"),
    }
}

/// Each cloud with a base is a layer of its own, at its height and with its amount.
#[test]
fn every_real_report_has_its_layers() {
    let (mut clear, mut layered) = (0, 0);
    for (_, report) in reports() {
        let answer = read(report);
        let told = &answer.report.clouds;
        let placed: Vec<_> = told
            .iter()
            .filter(|cloud| cloud.base_m.is_some() || matches!(cloud.kind, Some("CB" | "TCU")))
            .collect();
        let Some(clouds) = &answer.scene.clouds else {
            assert!(placed.is_empty(), "{report}");
            clear += 1;
            continue;
        };
        layered += usize::from(!placed.is_empty());
        let is_hidden = clouds.layers.len() > placed.len();
        assert!(
            !is_hidden || answer.report.vertical_visibility_m.is_some(),
            "{report}"
        );
        for (cloud, layer) in placed.iter().zip(&clouds.layers) {
            let (base_m, coverage) = match layer {
                Layer::Volume(volume) => (volume.base_m, volume.coverage),
                Layer::Sheet(sheet) => (sheet.height_m, sheet.coverage),
            };
            assert!(
                cloud.base_m.is_none_or(|told| told == base_m),
                "{report}: {layer:?}"
            );
            let eighths = match cloud.amount {
                Some(Amount::Few) => 1.5,
                Some(Amount::Scattered) | None => 3.5,
                Some(Amount::Broken) => 6.0,
                Some(Amount::Overcast) => 8.0,
            };
            assert_eq!(coverage, Some(eighths / 8.0), "{report}");
            assert!(clouds.coverage >= eighths / 8.0, "{report}");
        }
        let is_cloud = |text: &String| {
            ["FEW0", "SCT0", "BKN0", "OVC0"]
                .iter()
                .any(|a| text.starts_with(a))
        };
        assert!(
            !answer.not_rendered.iter().any(is_cloud),
            "{report}: {:?}",
            answer.not_rendered
        );
    }
    assert!(clear >= 20 && layered >= 100, "{clear} {layered}");
}

#[test]
fn several_groups_are_several_layers() {
    let all = layers("24008KT 9999 FEW010 SCT025TCU BKN090 OVC250");
    let [
        Layer::Volume(few),
        Layer::Volume(tower),
        Layer::Sheet(middle),
        Layer::Sheet(high),
    ] = &all[..]
    else {
        panic!("{all:?}")
    };
    assert_eq!((few.base_m, few.coverage), (10.0 * HUNDRED_FEET_M, Some(0.1875)));
    // No thicker than there is room below the next.
    assert_eq!(few.top_m, 25.0 * HUNDRED_FEET_M);
    assert_eq!(
        (tower.base_m, tower.coverage),
        (25.0 * HUNDRED_FEET_M, Some(0.4375))
    );
    assert_eq!(
        (tower.top_m - tower.base_m, tower.cloud_type, tower.anvil),
        (4_500.0, Some(1.0), 0.0)
    );
    assert_eq!((middle.genus, middle.coverage), (Genus::Altocumulus, Some(0.75)));
    assert_eq!((high.genus, high.coverage), (Genus::Cirrostratus, Some(1.0)));
    assert_eq!(high.height_m, 250.0 * HUNDRED_FEET_M);
}

#[test]
fn what_a_layer_is_follows_from_height_amount_and_rain() {
    for (groups, base_m, cloud_type, thickness_m) in [
        ("9999 FEW030", 914.4, 1.0, 600.0),
        ("9999 SCT030", 914.4, 1.0, 1_000.0),
        ("9999 BKN030", 914.4, 0.5, 700.0),
        ("9999 OVC030", 914.4, 0.5, 900.0),
        ("9999 OVC005", 152.4, 0.0, 350.0),
        ("9999 OVC000", 0.0, 0.0, 350.0),
        ("6000 -DZ OVC020", 609.6, 0.0, 500.0),
        ("6000 -RA OVC020", 609.6, 0.3, 2_050.0),
        ("6000 +SN OVC020", 609.6, 0.3, 4_500.0),
        ("6000 SHRA BKN020", 609.6, 1.0, 3_400.0),
        ("6000 -RA OVC090", 2_743.2, 0.3, 2_050.0),
    ] {
        let volume = volume(groups);
        assert!((volume.base_m - base_m).abs() < 1e-9, "{groups}: {volume:?}");
        assert_eq!(volume.cloud_type, Some(cloud_type), "{groups}");
        // Roundings of the sum.
        assert!(
            (volume.top_m - volume.base_m - thickness_m).abs() < 1e-9,
            "{groups}: {volume:?}"
        );
    }
    for (groups, genus) in [
        ("FEW080", Genus::Altocumulus),
        ("OVC080", Genus::Altostratus),
        ("SCT200", Genus::Cirrus),
        ("OVC200", Genus::Cirrostratus),
        ("FEW200CC", Genus::Cirrocumulus),
    ] {
        let all = layers(&format!("9999 {groups}"));
        assert!(
            matches!(&all[..], [Layer::Sheet(sheet)] if sheet.genus == genus),
            "{groups}: {all:?}"
        );
    }
}

/// The tropopause over London lies at 11.6 km by our formula; it is higher in the tropics.
#[test]
fn a_thundercloud_reaches_the_tropopause() {
    let london = volume("9999 +TSRA SCT020CB");
    assert_eq!((london.anvil, london.cloud_type), (1.0, Some(1.0)));
    assert!((london.top_m - 11_600.0).abs() < 100.0, "{london:?}");
    let singapore = read("WSSS 092050Z 9999 SCT020CB 30/25 Q1009")
        .scene
        .clouds
        .unwrap();
    assert!(matches!(&singapore.layers[0], Layer::Volume(volume) if volume.top_m > 16_000.0));
    assert_eq!(volume("9999 FEW///CB").base_m, 1_000.0);
    // Some write the kind apart.
    assert_eq!(volume("9999 SCT020 CB"), volume("9999 SCT020CB"));
}

#[test]
fn rain_falls_as_hard_as_it_is_told() {
    let falls = |groups: &str| clouds(groups).unwrap().precipitation;
    assert_eq!(falls("6000 -RA OVC020"), 0.3);
    assert_eq!(falls("6000 RA OVC020"), 0.6);
    assert_eq!(falls("6000 -DZ +SHRA OVC020"), 1.0);
    for dry in [
        "9999 OVC020",
        "9999 VCSH OVC020",
        "6000 BLSN OVC020",
        "9999 TS OVC020CB",
    ] {
        assert_eq!(falls(dry), 0.0, "{dry}");
    }
    let answer = read("EGLL 092050Z 9999 -RA OVC020 17/12 Q1019");
    assert!(answer.not_rendered.is_empty(), "{:?}", answer.not_rendered);
}

#[test]
fn a_sky_without_clouds_has_none() {
    for groups in [
        "CAVOK",
        "9999 NSC",
        "9999 SKC",
        "9999 CLR",
        "9999 NCD",
        "9999",
        "9999 //////",
    ] {
        assert_eq!(clouds(groups), None, "{groups}");
    }
    let notes = |groups: &str| {
        read(&format!("EGLL 092050Z {groups} 17/12 Q1019"))
            .notes
            .join("\n")
    };
    assert!(!notes("CAVOK").contains("no clouds") && !notes("9999 NSC").contains("no clouds"));
    assert!(
        notes("9999").contains("no clouds were reported"),
        "{}",
        notes("9999")
    );
    let answer = read("EGLL 092050Z 24010KT 9999 SCT/// 17/12 Q1019");
    assert_eq!(answer.not_rendered, ["24010KT", "SCT///"]);
}

#[test]
fn a_hidden_sky_is_fog_or_stratus() {
    assert_eq!(clouds("0200 FG VV001"), None);
    let stratus = volume("1500 +SN VV004");
    assert_eq!(
        (stratus.base_m, stratus.cloud_type, stratus.coverage),
        (4.0 * HUNDRED_FEET_M, Some(0.0), Some(1.0))
    );
    assert_eq!(volume("1500 SN VV///").base_m, 30.0);
    assert_eq!(volume("9999 MIFG VV003").base_m, 3.0 * HUNDRED_FEET_M);
}

#[test]
fn the_wind_carries_the_clouds() {
    let wind = |group: &str| clouds(&format!("{group} 9999 SCT030")).unwrap().wind;
    let west = wind("27010MPS");
    assert_eq!(
        (west.azimuth_deg, west.speed_m_s, west.shear_m),
        (270.0, 10.0, 500.0)
    );
    let calm = wind("00000KT");
    assert_eq!((calm.speed_m_s, calm.shear_m), (0.0, 0.0));
    let variable = wind("VRB02MPS");
    assert_eq!(
        (variable.azimuth_deg, variable.speed_m_s, variable.shear_m),
        (270.0, 2.0, 120.0)
    );
    assert_eq!(wind("270P499MPS").speed_m_s, 100.0);
    assert_eq!(wind("/////KT"), Clouds::default().wind);
}

#[test]
fn a_station_keeps_its_sky_and_others_have_their_own() {
    let seed = |report: &str| read(report).scene.clouds.unwrap().seed;
    let heathrow = seed("EGLL 092050Z 9999 SCT030 17/12 Q1019");
    assert_eq!(heathrow, seed("EGLL 092120Z 9999 BKN020 17/12 Q1018"));
    assert_ne!(heathrow, seed("EGKK 092050Z 9999 SCT030 17/12 Q1019"));
}

/// A scene has eight layers at most; what finds no room is told.
#[test]
fn the_ninth_layer_is_told() {
    let groups: Vec<String> = (1..=9).map(|i| format!("FEW{i:02}0")).collect();
    let answer = read(&format!("EGLL 092050Z 9999 {} 17/12 Q1019", groups.join(" ")));
    assert_eq!(answer.scene.clouds.unwrap().layers.len(), 8);
    assert_eq!(answer.not_rendered, ["FEW090"]);
}
