//! What stands on the sphere, as others see it.

use crate::scenes::{Rgb, luma, renderer, scene, whole};
use serde_json::{Value, json};
use std::sync::Arc;
use welkin_render::Renderer;
use welkin_scene::{
    Direction, ProbeAnswer, ProbeRequest, Quality, Scene,
    assets::{HeightGrid, SceneAssets},
    renderer::{FrameOrder, Output, Pixels, Priority, ProbeOrder, Render},
};

/// A heightfield of that name, whose heights are as given, rows from the north.
fn assets(side: u32, heights: impl Fn(u32, u32) -> f32) -> Arc<SceneAssets> {
    let all = (0..side * side).map(|i| heights(i % side, i / side)).collect();
    let grid = HeightGrid {
        width: side,
        height: side,
        heights: all,
        range_m: None,
        extent_m: None,
        digest: [u8::try_from(side).unwrap(); 32],
    };
    Arc::new(SceneAssets {
        heightfields: [("field".to_owned(), Arc::new(grid))].into(),
        ..SceneAssets::default()
    })
}

fn probed(scene: Scene, assets: &Arc<SceneAssets>, directions: &[(f64, f64)]) -> ProbeAnswer {
    let directions = directions
        .iter()
        .map(|(azimuth, elevation)| Direction::angles(*azimuth, *elevation));
    let order = ProbeOrder {
        request: ProbeRequest {
            scene,
            directions: directions.collect(),
        },
        assets: Arc::clone(assets),
    };
    pollster::block_on(Renderer::probe(renderer(), order)).unwrap()
}

fn framed(scene: Scene, assets: &Arc<SceneAssets>, size_px: [u32; 2]) -> Vec<Rgb> {
    framed_as(Quality::Final, scene, assets, size_px)
}

fn framed_as(
    quality: Quality,
    scene: Scene,
    assets: &Arc<SceneAssets>,
    [width_px, height_px]: [u32; 2],
) -> Vec<Rgb> {
    let order = FrameOrder {
        scene: Arc::new(scene),
        assets: Arc::clone(assets),
        width_px,
        height_px,
        quality,
        output: Output::Linear,
        priority: Priority::Interactive,
    };
    let frame = pollster::block_on(Renderer::frame(renderer(), order)).unwrap();
    let Pixels::Linear(values) = &frame.pixels else {
        panic!("not radiance")
    };
    values
        .chunks_exact(3)
        .map(|p| [p[0], p[1], p[2]].map(f64::from))
        .collect()
}

fn field(changes: &Value) -> Value {
    let mut field = json!({"kind": "heightfield", "name": "field", "extent_m": 20000, "height_m": 1000, "edge_fade": 0,
        "surface": {"albedo": {"kind": "plain", "rgb": [1, 1, 1]}}});
    json_patch(&mut field, changes);
    field
}

fn json_patch(to: &mut Value, changes: &Value) {
    for (key, value) in changes.as_object().unwrap() {
        to[key] = value.clone();
    }
}

/// A white plane sends back as much as a white sphere below it: π L of what falls on it, sun and sky.
#[test]
fn a_white_plane_is_as_bright_as_a_white_sphere() {
    let flat = assets(8, |_, _| 0.0);
    let white = |terrain: Value| {
        scene(
            json!({"camera": {"position_m": [0, 0, 300]}, "sun": {"position": {"azimuth_deg": 140, "elevation_deg": 35}},
            "planet": {"ground_albedo": [1, 1, 1]}, "terrain": terrain}),
        )
    };
    let looks = [(0.0, -90.0), (140.0, -30.0), (20.0, -10.0)];
    let plane = probed(
        white(field(&json!({"base_m": 1.0, "shadow": null}))),
        &flat,
        &looks,
    );
    let sphere = probed(white(Value::Null), &flat, &looks);
    for i in 0..looks.len() {
        // The plane lies a metre higher.
        let (near, far) = (plane.distance_m[i].unwrap(), sphere.distance_m[i].unwrap());
        assert!(near < far && far - near < 7.0, "{near} {far}");
        for c in 0..3 {
            let share = plane.radiance_w_m2_sr[i][c] / sphere.radiance_w_m2_sr[i][c];
            // Eight bits of albedo and of the share of light, and the air of a metre.
            assert!((share - 1.0).abs() < 0.01, "{:?}: {share}", looks[i]);
        }
    }
}

/// By rays and by a map of 2048 texels, less than 2 % of pixels differ: those at the edges of shadows.
#[test]
fn a_map_shows_the_shadows_that_rays_do() {
    let none = Arc::default();
    let view = |shadow: Value| {
        let scene = scene(json!({
            "camera": {"position_m": [-3000, -9000, 3500], "direction": {"azimuth_deg": 330, "elevation_deg": -15}},
            "sun": {"position": {"azimuth_deg": 250, "elevation_deg": 18}}, "shafts": null,
            "terrain": {"kind": "heightfield", "shadow": shadow}}));
        framed(scene, &none, [240, 160])
    };
    let rays = view(json!({"kind": "rays"}));
    let unshaded = view(Value::Null);
    for filter in ["nearest", "bilinear", "gaussian"] {
        let map = view(json!({"kind": "map", "size_px": 2048, "filter": filter}));
        // The sun gives the ground that faces it some two thirds of its light; half of that tells dark from lit.
        let apart = |a: Rgb, b: Rgb, whole: Rgb| (luma(a) - luma(b)).abs() > 0.33 * luma(whole);
        let differ = (0..rays.len())
            .filter(|i| apart(rays[*i], map[*i], unshaded[*i]))
            .count();
        let dark = (0..rays.len())
            .filter(|i| luma(rays[*i]) < 0.9 * luma(unshaded[*i]))
            .count();
        assert!(
            50 * differ < rays.len(),
            "{filter}: {differ} of {} differ",
            rays.len()
        );
        // The test would be empty without shadows.
        assert!(20 * dark > rays.len(), "{dark} of {} are in shadow", rays.len());
    }
}

/// Light that passes by all that stands reaches the plain beyond the terrain too, behind the map's depth.
#[test]
fn the_plain_beyond_the_terrain_is_lit() {
    let post = assets(40, |column, row| {
        if (18..22).contains(&column) && row > 30 {
            1.0
        } else {
            0.0
        }
    });
    let view = |shadow: Value| {
        scene(
            json!({"camera": {"position_m": [11500, 2000, 500]}, "shafts": null,
            "sun": {"position": {"azimuth_deg": 270, "elevation_deg": 20}}, "terrain": field(&json!({"shadow": shadow}))}),
        )
    };
    let looks = [(0.0, -60.0), (90.0, -60.0), (180.0, -75.0)];
    let map = json!({"kind": "map", "size_px": 512, "filter": "gaussian"});
    let with = probed(view(map), &post, &looks);
    let without = probed(view(Value::Null), &post, &looks);
    for i in 0..looks.len() {
        let (a, b) = (luma(with.radiance_w_m2_sr[i]), luma(without.radiance_w_m2_sr[i]));
        assert!((a / b - 1.0).abs() < 1e-3, "{:?}: {a} {b}", looks[i]);
    }
}

/// A wall between the observer and the sun keeps its light from them, and the air behind it from scattering it.
#[test]
fn a_wall_hides_the_sun_and_draws_a_shaft() {
    // Two kilometres south of the observer, five high.
    let wall = assets(200, |_, row| if (118..122).contains(&row) { 1.0 } else { 0.0 });
    let view = |changes: Value| {
        let mut all = json!({"camera": {"position_m": [0, 0, 20]}, "sun": {"position": {"azimuth_deg": 180, "elevation_deg": 20}},
            "haze": {"extinction_per_m": 5e-5, "top_m": 3000}, "terrain": field(&json!({"height_m": 5000}))});
        json_patch(&mut all, &changes);
        scene(all)
    };
    let looks = [(90.0, 10.0), (180.0, 5.0), (0.0, 70.0)];
    let with = probed(view(json!({})), &wall, &looks);
    let without = probed(view(json!({"shafts": null})), &wall, &looks);
    assert_eq!(with.irradiance.direct_normal_w_m2, [0.0; 3]);
    for i in 0..2 {
        let (dark, lit) = (luma(with.radiance_w_m2_sr[i]), luma(without.radiance_w_m2_sr[i]));
        assert!(dark < 0.9 * lit && dark > 0.0, "{:?}: {dark} {lit}", looks[i]);
    }
    // Straight towards the wall it ends the ray.
    assert!(
        (with.distance_m[1].unwrap() - 1850.0).abs() < 200.0,
        "{:?}",
        with.distance_m[1]
    );
    // Without the wall nothing is lost.
    let flat = assets(8, |_, _| 0.0);
    let with = probed(view(json!({})), &flat, &looks);
    let without = probed(view(json!({"shafts": null})), &flat, &looks);
    for i in 0..looks.len() {
        let (a, b) = (with.radiance_w_m2_sr[i], without.radiance_w_m2_sr[i]);
        assert!(
            (luma(a) / luma(b) - 1.0).abs() < 1e-3,
            "{:?}: {a:?} {b:?}",
            looks[i]
        );
    }
}

/// Before a mountain there is as much air as the way to it is long, under clouds too: a frame shows what the probe tells, which
/// integrates along each ray.
#[test]
fn air_before_a_mountain_under_clouds_is_that_of_the_way() {
    let wall = assets(200, |_, row| if (116..124).contains(&row) { 1.0 } else { 0.0 });
    let clouds = json!({"coverage": 0.8, "steps": 256,
        "layers": [{"kind": "volume", "base_m": 1500, "top_m": 2400, "type": 0.6}]});
    let all = json!({"camera": {"position_m": [0, 0, 300], "direction": {"azimuth_deg": 180, "elevation_deg": 1}},
        "sun": {"position": {"azimuth_deg": 150, "elevation_deg": 30}, "disc": false}, "shafts": null, "clouds": clouds,
        "haze": {"extinction_per_m": 5e-5, "top_m": 3000}, "terrain": field(&json!({"height_m": 1000}))});
    let scene: Scene = whole(all);
    let seen = framed(scene.clone(), &wall, [9, 9]);
    let there = probed(scene, &wall, &[(180.0, 1.0)]);
    assert!(there.distance_m[0].unwrap() < 3000.0);
    let (seen, there) = (luma(seen[40]), luma(there.radiance_w_m2_sr[0]));
    // Tables of the air are good to 1 %; clouds' shadows on the wall change within a pixel.
    assert!((seen / there - 1.0).abs() < 0.05, "{seen} {there}");
}

/// A mountain's shadow falls on clouds that lie below its summit: there they have the light of sky and ground alone, as if
/// there were no sun on clouds at all; elsewhere they lose nothing. A frame of either quality shows it.
#[test]
fn a_mountain_shades_the_clouds_below_its_summit() {
    // Two kilometres south of the observer, five high: under a sun of 20° its shadow leaves the deck's top 8.2 km behind it.
    let wall = assets(200, |_, row| if (118..122).contains(&row) { 1.0 } else { 0.0 });
    let view = |shadow: Value, sun_factor: f64| {
        whole(
            json!({"camera": {"position_m": [0, 0, 6000], "direction": {"azimuth_deg": 0, "elevation_deg": -70}},
            "sun": {"position": {"azimuth_deg": 180, "elevation_deg": 20}}, "shafts": null,
            "clouds": {"coverage": 1, "extinction_per_m": 0.05, "sun_factor": sun_factor,
                "weather_map": {"kind": "uniform", "coverage": 1, "type": 0.0},
                "layers": [{"kind": "volume", "base_m": 1000, "top_m": 2000, "type": 0.0}]},
            "terrain": field(&json!({"height_m": 5000, "shadow": shadow, "surface": {"albedo": {"kind": "plain", "rgb": [0, 0, 0]}}}))}),
        )
    };
    let rays = json!({"kind": "rays"});
    let dark = [(0.0, -70.0), (30.0, -75.0), (90.0, -80.0)];
    let lit = [(0.0, -18.0), (180.0, -20.0), (170.0, -20.0)];
    let seen = |shadow: &Value, sun_factor: f64, looks: &[(f64, f64)]| -> Vec<f64> {
        let answer = probed(view(shadow.clone(), sun_factor), &wall, looks);
        answer.radiance_w_m2_sr.into_iter().map(luma).collect()
    };
    let (shaded, unlit) = (seen(&rays, 1.0, &dark), seen(&Value::Null, 0.0, &dark));
    let open = seen(&Value::Null, 1.0, &dark);
    for i in 0..dark.len() {
        // The ground behind is black; f32 keeps six digits, the tables of light three.
        assert!(
            (shaded[i] / unlit[i] - 1.0).abs() < 1e-3,
            "{:?}: {} {}",
            dark[i],
            shaded[i],
            unlit[i]
        );
        assert!(
            shaded[i] < 0.6 * open[i],
            "{:?}: {} {}",
            dark[i],
            shaded[i],
            open[i]
        );
    }
    let (with, without) = (seen(&rays, 1.0, &lit), seen(&Value::Null, 1.0, &lit));
    for i in 0..lit.len() {
        assert!(
            (with[i] / without[i] - 1.0).abs() < 1e-4,
            "{:?}: {} {}",
            lit[i],
            with[i],
            without[i]
        );
    }
    for quality in [Quality::Preview, Quality::Final] {
        let middle = |shadow: &Value| luma(framed_as(quality, view(shadow.clone(), 1.0), &wall, [9, 9])[40]);
        let (shaded, open) = (middle(&rays), middle(&Value::Null));
        assert!(shaded < 0.6 * open, "{quality:?}: {shaded} {open}");
    }
}

/// Radial shafts darken what lies behind a wall in line with the sun's image, the more the stronger, and nothing on its other
/// side.
#[test]
fn radial_shafts_lead_away_from_the_sun() {
    let post = assets(200, |column, row| {
        if (118..122).contains(&row) && column < 100 {
            1.0
        } else {
            0.0
        }
    });
    let view = |shafts: Value| {
        let all = json!({"camera": {"position_m": [0, 0, 20], "direction": {"azimuth_deg": 180, "elevation_deg": 15}},
            "sun": {"position": {"azimuth_deg": 180, "elevation_deg": 20}, "disc": false}, "shafts": shafts,
            "haze": {"extinction_per_m": 5e-5, "top_m": 3000}, "terrain": field(&json!({"height_m": 5000}))});
        framed(scene(all), &post, [60, 40])
    };
    let none = view(Value::Null);
    let [weak, strong] = [0.3, 0.9].map(|strength| view(json!({"kind": "radial", "strength": strength})));
    // The wall stands in the west, to the right.
    let lost = |seen: &[Rgb], x: usize| 1.0 - luma(seen[17 * 60 + x]) / luma(none[17 * 60 + x]);
    for x in 0..28 {
        assert!(lost(&strong, x).abs() < 1e-4, "{x}: {}", lost(&strong, x));
    }
    for x in 32..42 {
        let (weak, strong) = (lost(&weak, x), lost(&strong, x));
        assert!(
            weak > 0.1 && (strong / weak - 3.0).abs() < 0.01,
            "{x}: {weak} {strong}"
        );
    }
}

/// Water mirrors: towards a low sun it is far brighter than away from it, and more wind spreads the glitter.
#[test]
fn water_glitters_under_the_sun() {
    let none = Arc::default();
    let view = |wind: f64| {
        scene(
            json!({"camera": {"position_m": [0, 0, 50]}, "sun": {"position": {"azimuth_deg": 180, "elevation_deg": 25}},
            "planet": {"ground_albedo": [0.003, 0.012, 0.03], "surface": {"kind": "water", "wind_m_s": wind}}}),
        )
    };
    let looks = [(180.0, -25.0), (0.0, -25.0), (160.0, -25.0)];
    let seen = |wind: f64| {
        probed(view(wind), &none, &looks)
            .radiance_w_m2_sr
            .into_iter()
            .map(luma)
            .collect::<Vec<_>>()
    };
    let (calm, windy) = (seen(1.0), seen(12.0));
    assert!(calm[0] > 20.0 * calm[1], "{calm:?}");
    assert!(
        calm[0] > 3.0 * windy[0] && windy[2] > calm[2],
        "{calm:?} {windy:?}"
    );
}
