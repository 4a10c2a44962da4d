//! `/v1/scenes/from-metar`

use crate::{
    client::{call, get, json_request, post, router},
    fake::Fake,
};
use axum::{
    body::Body,
    http::{Request, header},
};
use serde_json::{Value, json};
use welkin_scene::{Scene, SunPosition};

const PATH: &str = "/v1/scenes/from-metar";

async fn answer(body: Value) -> Value {
    let answer = post(&router(&Fake::new()), PATH, body.to_string()).await;
    assert_eq!(answer.status, 200, "{}", answer.json());
    answer.json()
}

#[tokio::test]
async fn a_report_makes_a_scene_that_renders() {
    let report = "METAR EGUW 030650Z 05003KT 0600 FG FEW060 12/12 Q1021 RED BECMG 9999 NSW BLU=";
    let answer = answer(json!({"metar": report, "date": "2018-09-03"})).await;
    let scene = Scene::from_value(&answer["scene"]).unwrap();
    assert!(
        matches!(&scene.sun.position, SunPosition::TimeAndPlace(at) if at.time == "2018-09-03T06:50:00Z")
    );
    assert_eq!(scene.haze.as_ref().unwrap().top_m, 150.0);
    assert_eq!(
        answer["report"]["visibility"],
        json!({"distance_m": 600.0, "bound": "exactly"})
    );
    assert_eq!(answer["report"]["trend"], "BECMG 9999 NSW BLU");
    assert_eq!(answer["not_rendered"], json!(["RED"]));
    assert!(answer["notes"][0].as_str().unwrap().contains("fog"), "{answer}");
    let frame = json!({"scene": answer["scene"], "width_px": 8, "height_px": 8});
    assert_eq!(
        post(&router(&Fake::new()), "/v1/frames", frame.to_string())
            .await
            .status,
        200
    );
}

#[tokio::test]
async fn place_and_date_may_be_given() {
    let report = "METAR XXXX 311150Z 24008KT CAVOK 17/12 Q1019";
    let answer =
        answer(json!({"metar": report, "date": "2024-02-29", "latitude_deg": 60, "longitude_deg": 30})).await;
    assert_eq!(
        answer["scene"]["sun"]["position"],
        json!({"time": "2024-01-31T11:50:00Z", "latitude_deg": 60.0, "longitude_deg": 30.0, "refraction": true})
    );
    assert_eq!(answer["report"]["place"]["elevation_m"], 0.0);
}

#[tokio::test]
async fn a_bad_report_names_the_group_and_its_place() {
    let app = router(&Fake::new());
    let body = json!({"metar": "METAR EGLL 092050Z 24008KT 9999 FEW18 17/12 Q1019"});
    let problem = post(&app, PATH, body.to_string()).await.problem(422);
    let expected = &problem["allowed"];
    assert!(
        expected.as_str().unwrap().contains("FEW, SCT, BKN, OVC"),
        "{problem}"
    );
    assert_eq!(
        problem["group"],
        json!({"group": "FEW18", "number": 6, "start": 32, "end": 37, "expected": expected})
    );
    assert_eq!(
        (&problem["pointer"], &problem["value"]),
        (&json!("/metar"), &json!("FEW18"))
    );
    assert!(
        problem["detail"].as_str().unwrap().contains("`FEW18`"),
        "{problem}"
    );
    assert_eq!(problem["errors"][0]["message"], problem["detail"]);
    let document = get(&app, "/openapi.json").await.json();
    let described = &document["components"]["schemas"]["Problem"]["properties"]["group"]["properties"];
    for name in problem["group"].as_object().unwrap().keys() {
        assert!(described[name].is_object(), "{name}");
    }
}

#[tokio::test]
async fn bad_requests_are_refused_like_others() {
    let app = router(&Fake::new());
    for (body, status, pointer) in [
        ("", 400, ""),
        ("{", 400, ""),
        ("{}", 422, "/metar"),
        (r#"{"metar": 5}"#, 422, "/metar"),
        (r#"{"metar": "", "station": "EGLL"}"#, 422, "/station"),
        (r#"{"metar": "", "date": "9 September"}"#, 422, "/date"),
        (r#"{"metar": "", "longitude_deg": 0}"#, 422, "/latitude_deg"),
        (r#"{"metar": ""}"#, 422, "/metar"),
    ] {
        let problem = post(&app, PATH, body).await.problem(status);
        assert_eq!(
            problem["pointer"].as_str().unwrap_or_default(),
            pointer,
            "{body}: {problem}"
        );
    }
    let plain = Request::post(PATH).header(header::CONTENT_TYPE, "text/plain");
    call(&app, plain.body(Body::from("METAR EGLL")).unwrap())
        .await
        .problem(415);
    let long = format!("{{\"metar\": \"{}\"}}", "X ".repeat(1 << 20));
    call(&app, json_request(PATH, long)).await.problem(413);
    let long = format!("{{\"metar\": \"{}\"}}", "X ".repeat(10_000));
    assert_eq!(post(&app, PATH, long).await.problem(422)["pointer"], "/metar");
    get(&app, PATH).await.problem(405);
}
