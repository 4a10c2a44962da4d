//! Timelines over the live socket.

use crate::{
    client::{Viewer, server},
    fake::Fake,
};
use serde_json::{Value, json};
use std::time::Duration;
use welkin_scene::Timeline;
use welkin_service::Settings;

fn evening() -> Value {
    let sun = |elevation_deg: f64| json!({"sun": {"position": {"azimuth_deg": 250, "elevation_deg": elevation_deg}}});
    json!({
        "scene": {"time_s": 100},
        "keyframes": [{"at_s": 0, "patch": sun(40.0)}, {"at_s": 8, "patch": sun(20.0)}, {"at_s": 10, "patch": sun(0.0)}],
    })
}

#[tokio::test]
async fn a_timeline_is_sent_once_and_played_by_its_moments() {
    let fake = Fake::new();
    let server = server(&fake, Settings::default()).await;
    let mut viewer = Viewer::connect(&server).await;
    let output = json!({"width_px": 64, "height_px": 32});
    viewer
        .say(&json!({"seq": 1, "timeline": evening(), "output": output}))
        .await;
    let (_, stats) = viewer.picture().await;
    assert_eq!(
        (&stats["at_s"], &stats["scene"]["time_s"]),
        (&json!(0.0), &json!(100.0))
    );
    viewer.pictures_until_done(1).await;
    viewer.say(&json!({"seq": 2, "at_s": 3.25})).await;
    let (picture, stats) = viewer.picture().await;
    let expected = Timeline::from_value(&evening()).unwrap().at(3.25).unwrap();
    assert_eq!((picture.seq, &stats["at_s"]), (2, &json!(3.25)));
    assert_eq!(stats["scene"], serde_json::to_value(&expected).unwrap());
    viewer.pictures_until_done(2).await;
    assert_eq!(*fake.orders.lock().unwrap().last().unwrap().scene, expected);
    // A patch changes what is shown, and the timeline stays at hand.
    viewer
        .say(&json!({"seq": 3, "patch": {"sun": {"disc": false}}}))
        .await;
    let (_, stats) = viewer.picture().await;
    assert!(stats["at_s"].is_null() && stats["scene"].is_null(), "{stats}");
    viewer.pictures_until_done(3).await;
    {
        let orders = fake.orders.lock().unwrap();
        let scene = &orders.last().unwrap().scene;
        assert_eq!(
            (scene.time_s, scene.sun.disc, scene.sun_place()),
            (103.25, false, expected.sun_place())
        );
    }
    viewer.say(&json!({"seq": 4, "at_s": 10})).await;
    let (_, stats) = viewer.picture().await;
    assert_eq!(
        stats["scene"]["sun"],
        json!({
            "position": {"azimuth_deg": 250.0, "elevation_deg": 0.0}, "irradiance_w_m2": stats["scene"]["sun"]["irradiance_w_m2"],
            "angular_diameter_deg": stats["scene"]["sun"]["angular_diameter_deg"], "limb_darkening": true, "disc": true,
        })
    );
}

#[tokio::test]
async fn of_moments_that_came_meanwhile_the_latest_is_shown() {
    let fake = Fake::slow(|_| Duration::from_millis(50));
    let server = server(&fake, Settings::default()).await;
    let mut viewer = Viewer::connect(&server).await;
    viewer
        .say(&json!({"seq": 0, "timeline": evening(), "output": {"width_px": 64, "height_px": 32}}))
        .await;
    for i in 1..=100_u32 {
        viewer.say(&json!({"seq": i, "at_s": f64::from(i) / 10.0})).await;
    }
    let shown = viewer.pictures_until_done(100).await;
    assert!(shown.windows(2).all(|pair| pair[0].seq <= pair[1].seq));
    // One in work when they came, perhaps one more, and the latest with its refinement.
    assert!(shown.len() < 20, "{} pictures of 101 moments", shown.len());
}

#[tokio::test]
async fn moments_that_cannot_be_are_refused_and_what_is_shown_stays() {
    let fake = Fake::new();
    let server = server(&fake, Settings::default()).await;
    let mut viewer = Viewer::connect(&server).await;
    let late = json!({"keyframes": [{"at_s": 1}, {"at_s": 1}]});
    let wrong = json!({"keyframes": [{"at_s": 1, "patch": {"sun": {"dics": true}}}]});
    for (message, pointer) in [
        (json!({"seq": 1, "at_s": 3}), "/at_s"),
        (json!({"seq": 1, "timeline": 3}), "/timeline"),
        (json!({"seq": 1, "timeline": late}), "/timeline/keyframes/1/at_s"),
        (
            json!({"seq": 1, "timeline": wrong}),
            "/timeline/keyframes/0/patch/sun/dics",
        ),
        (json!({"seq": 1, "timeline": {}, "at_s": 1e10}), "/at_s"),
        (json!({"seq": 1, "timeline": {}, "scene": {}}), "/timeline"),
        (json!({"seq": 1, "at_s": 0, "patch": {}}), "/at_s"),
    ] {
        viewer.say(&message).await;
        let answer = viewer.text().await;
        assert_eq!(
            (&answer["seq"], &answer["error"]["status"]),
            (&json!(1), &json!(422)),
            "{message}: {answer}"
        );
        assert_eq!(answer["error"]["pointer"], pointer, "{message}: {answer}");
    }
    assert!(viewer.is_silent().await);
    assert!(fake.orders.lock().unwrap().is_empty());
}
