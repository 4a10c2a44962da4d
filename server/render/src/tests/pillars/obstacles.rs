//! What stands in the way: before a pillar, in it, and before its lamp.

use super::{
    gaussian, lamp,
    oracle::{black, standing},
    radiance, with,
};
use glam::{DMat3, DVec3};
use std::sync::Arc;
use welkin_scene::{CrystalLayer, Scene, assets::SceneAssets};

const LAMP: DVec3 = DVec3::new(600.0, 0.0, 10.0);
const EYE: DVec3 = DVec3::new(0.0, 0.0, 30.0);
/// Where a wall stands across, and its upper edge.
const WALL_X: f64 = 520.0;
const WALL_TOP: f64 = 22.0;

fn scene() -> Scene {
    let layer = CrystalLayer {
        base_m: 0.0,
        top_m: 300.0,
        tilt: gaussian(2.0, 6.0),
        ..CrystalLayer::default()
    };
    let mut scene = with(layer, vec![lamp(LAMP.to_array(), 1e3)]);
    scene.camera.position_m = EYE.to_array();
    scene
}

fn wall() -> [DVec3; 4] {
    [
        [-150.0, -1.0],
        [150.0, -1.0],
        [150.0, WALL_TOP],
        [-150.0, WALL_TOP],
    ]
    .map(|[y, z]| DVec3::new(WALL_X, y, z))
}

/// A screen across a view, so small that it stands in little of the lamp's light.
fn screen(v: DVec3, at_m: f64) -> [DVec3; 4] {
    let (right, up) = (DVec3::Y, v.cross(DVec3::Y).normalize());
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
        .map(|[a, b]| EYE + at_m * v + 0.02 * (a * right + b * up))
}

fn among(lights: Scene, things: &[[DVec3; 4]], directions: &[DVec3]) -> Vec<f64> {
    let mut assets = SceneAssets::default();
    assets.meshes.insert("wall".into(), Arc::new(black(things)));
    let terrain = Some(standing());
    radiance(&Scene { terrain, ..lights }, &assets, directions)
}

fn views() -> Vec<DVec3> {
    [(0.0, 3.0), (0.3, 6.0), (-0.8, 9.0), (0.5, 12.0), (0.0, 16.0)]
        .map(|(across_deg, elevation_deg): (f64, f64)| {
            let (sin, cos) = elevation_deg.to_radians().sin_cos();
            let (across, along) = across_deg.to_radians().sin_cos();
            DVec3::new(cos * along, cos * across, sin)
        })
        .to_vec()
}

/// How far along a view the plane lies in which lamp and wall's edge are.
fn to_edge_m(v: DVec3) -> f64 {
    let slope = (WALL_TOP - LAMP.z) / (LAMP.x - WALL_X);
    (LAMP.z + slope * (LAMP.x - EYE.x) - EYE.z) / (v.z + slope * v.x)
}

#[test]
fn a_wall_takes_what_lies_under_the_line_from_the_lamp_over_its_edge() {
    let views = views();
    let open = radiance(&scene(), &SceneAssets::default(), &views);
    let walled = among(scene(), &[wall()], &views);
    let below: Vec<f64> = views
        .iter()
        .map(|v| among(scene(), &[screen(*v, to_edge_m(*v))], &[*v])[0])
        .collect();
    assert!(
        walled
            .iter()
            .zip(&open)
            .any(|(walled, open)| *walled < 0.6 * open)
    );
    assert!(below.iter().all(|l| *l > 0.0));
    for (i, v) in views.iter().enumerate() {
        println!("{v:.3}: {:.4e} = {:.4e} + {:.4e}", open[i], walled[i], below[i]);
        // A twelve-bit place in a row of the table, and a screen of 4 cm.
        assert!(
            ((walled[i] + below[i]) / open[i] - 1.0).abs() < 0.01,
            "{v}: {} {} {}",
            open[i],
            walled[i],
            below[i]
        );
    }
}

#[test]
fn what_stands_before_a_pillar_hides_it_and_what_stands_in_it_dims_it() {
    for v in views() {
        let open = radiance(&scene(), &SceneAssets::default(), &[v])[0];
        let at = |at_m: f64| among(scene(), &[screen(v, at_m)], &[v])[0];
        let dimmed = [0.5, 50.0, 200.0, 350.0, 900.0].map(at);
        // A ray of half a metre has a thousandth of the plates, and those lie aslant.
        assert!(dimmed[0] < 2e-3 * open, "{v}: {dimmed:?} of {open}");
        assert!(dimmed.is_sorted(), "{v}: {dimmed:?}");
        assert!(dimmed[2] < 0.9 * open, "{v}: {dimmed:?} of {open}");
        // At 16° a ray leaves the layer beyond 900 m, at 3° the plates there lie too far aslant.
        assert!((dimmed[4] / open - 1.0).abs() < 0.05, "{v}: {dimmed:?} of {open}");
    }
}

#[test]
fn a_lamp_in_a_box_raises_nothing() {
    let corner = |a: f64, b: f64, c: f64| LAMP + DVec3::new(a, b, c);
    let sides = [
        [
            corner(-1., -1., -1.),
            corner(-1., 1., -1.),
            corner(-1., 1., 1.),
            corner(-1., -1., 1.),
        ],
        [
            corner(1., -1., -1.),
            corner(1., 1., -1.),
            corner(1., 1., 1.),
            corner(1., -1., 1.),
        ],
        [
            corner(-1., -1., -1.),
            corner(1., -1., -1.),
            corner(1., -1., 1.),
            corner(-1., -1., 1.),
        ],
        [
            corner(-1., 1., -1.),
            corner(1., 1., -1.),
            corner(1., 1., 1.),
            corner(-1., 1., 1.),
        ],
        [
            corner(-1., -1., 1.),
            corner(1., -1., 1.),
            corner(1., 1., 1.),
            corner(-1., 1., 1.),
        ],
        [
            corner(-1., -1., -1.),
            corner(1., -1., -1.),
            corner(1., 1., -1.),
            corner(-1., 1., -1.),
        ],
    ];
    assert_eq!(among(scene(), &sides, &views()), [0.0; 5]);
}

/// The first formulas looked for obstacles through two of the six faces of a cube about the lamp.
#[test]
fn shadows_fall_whichever_way_they_are_seen_from() {
    let east = among(scene(), &[wall()], &views());
    for azimuth_deg in [50_f64, 90.0, 140.0, 180.0, 270.0, 315.0] {
        let turn = DMat3::from_rotation_z(azimuth_deg.to_radians());
        let mut turned = scene();
        turned.lights[0].position_m = (turn * LAMP).to_array();
        let directions: Vec<_> = views().iter().map(|v| turn * *v).collect();
        let found = among(turned, &[wall().map(|corner| turn * corner)], &directions);
        for (east, found) in east.iter().zip(found) {
            // Edges are found to a twelfth bit of a row.
            assert!(
                (found / east - 1.0).abs() < 5e-3,
                "{azimuth_deg}°: {east} {found}"
            );
        }
    }
    // Lamp and eye high up, a tray under the lamp takes what plates mirror from below, and a roof what is mirrored from above.
    let mut high = scene();
    high.lights[0].position_m[2] = 200.0;
    high.camera.position_m[2] = 200.0;
    let lamp = DVec3::new(LAMP.x, 0.0, 200.0);
    let plate = |z: f64| {
        [[-40.0, -40.0], [40.0, -40.0], [40.0, 40.0], [-40.0, 40.0]].map(|[x, y]| lamp + DVec3::new(x, y, z))
    };
    let at = |elevation_deg: f64| {
        let (sin, cos) = elevation_deg.to_radians().sin_cos();
        DVec3::new(cos, 0.0, sin)
    };
    // What leaves the lamp within 1.4° of level passes tray and roof.
    let views = [at(-6.0), at(6.0)];
    let open = radiance(&high, &SceneAssets::default(), &views);
    let tray = among(high.clone(), &[plate(-1.0)], &views);
    let roof = among(high, &[plate(1.0)], &views);
    assert!(open.iter().all(|l| *l > 0.0), "{open:?}");
    assert!(
        tray[0] < 0.15 * open[0] && (tray[1] / open[1] - 1.0).abs() < 1e-3,
        "{tray:?} of {open:?}"
    );
    assert!(
        roof[1] < 0.15 * open[1] && (roof[0] / open[0] - 1.0).abs() < 1e-3,
        "{roof:?} of {open:?}"
    );
}

/// With many lamps the tables are coarser, 5 planes of 48 rows and 3 of 24: the lamps beside are too weak to be seen.
#[test]
fn many_lamps_have_shadows_as_one_has() {
    let views = views();
    let one = among(scene(), &[wall()], &views);
    // Rows are wider than what a wall's edge differs from a straight line in them.
    for (count, allowed) in [(800, 0.02), (2_500, 0.05)] {
        let mut many = scene();
        for i in 0..count {
            let away = 100.0 + f64::from(i);
            many.lights.push(lamp([-away, 500.0, 5.0], 1e-9));
        }
        for (one, found) in one.iter().zip(among(many, &[wall()], &views)) {
            println!(
                "{count}: {one:.4e} {found:.4e}, {:+.2} %",
                100.0 * (found / one - 1.0)
            );
            assert!((found / one - 1.0).abs() < allowed, "{count}: {one} {found}");
        }
    }
}
