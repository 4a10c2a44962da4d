//! Which airs, observers and suns are published.

use clap::ValueEnum;
use serde_json::{Value, json};
use welkin_reference::View;
use welkin_scene::{Scene, SceneError};

/// A published file.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Set {
    /// The thesis' air from the ground.
    Thesis,
    /// The Earth's air with ozone from the ground, to twilight.
    Earth,
    /// The thesis' air seen from an aeroplane's height and from orbit.
    Above,
    /// The thesis' air with four times the aerosols.
    Turbid,
    /// Haze and fog.
    Haze,
}

/// What a set holds.
pub(crate) struct Plan {
    pub(crate) name: &'static str,
    pub(crate) what: &'static str,
    pub(crate) seed: u64,
    pub(crate) groups: Vec<Group>,
}

/// Views of one air.
pub(crate) struct Group {
    /// Parts of the scene document; the sun and the camera come from the view.
    pub(crate) scene: Value,
    pub(crate) albedos: Vec<f64>,
    /// Standard error aimed at, as a share of each total.
    pub(crate) relative_error: f64,
    pub(crate) views: Vec<View>,
}

/// View zeniths and azimuths from the sun's, degrees: overhead, and three sides of the sky down to the horizon.
const DIRECTIONS: [(f64, f64); 13] = [
    (0.0, 0.0),
    (30.0, 0.0),
    (30.0, 90.0),
    (30.0, 180.0),
    (60.0, 0.0),
    (60.0, 90.0),
    (60.0, 180.0),
    (80.0, 0.0),
    (80.0, 90.0),
    (80.0, 180.0),
    (88.0, 0.0),
    (88.0, 90.0),
    (88.0, 180.0),
];

impl Set {
    pub(crate) fn plan(self) -> Plan {
        match self {
            Self::Thesis => Plan {
                name: "thesis",
                what: "the thesis' air, seen from the ground",
                seed: 1_000,
                groups: vec![Group {
                    scene: thesis(1.0),
                    albedos: vec![0.0, 0.3],
                    relative_error: 1e-3,
                    views: sky(0.0, &[0.0, 30.0, 60.0, 75.0, 85.0], &DIRECTIONS),
                }],
            },
            Self::Earth => Plan {
                name: "earth",
                what: "the Earth's air with ozone, seen from the ground",
                seed: 2_000,
                groups: vec![earth(&[30.0, 75.0, 90.0], 1e-3), earth(&[94.0], 3e-3)],
            },
            Self::Above => Plan {
                name: "above",
                what: "the thesis' air and ground, seen from 10 km and from 400 km",
                seed: 3_000,
                groups: vec![Group {
                    scene: thesis(1.0),
                    albedos: vec![0.0, 0.3],
                    relative_error: 1e-3,
                    views: above(),
                }],
            },
            Self::Turbid => Plan {
                name: "turbid",
                what: "the thesis' air with four times the aerosols, seen from the ground",
                seed: 4_000,
                groups: vec![Group {
                    scene: thesis(4.0),
                    albedos: vec![0.0, 0.3],
                    relative_error: 1e-3,
                    views: sky(0.0, &[30.0, 75.0], &DIRECTIONS),
                }],
            },
            Self::Haze => Plan {
                name: "haze",
                what: "the thesis' air with a layer of haze on the ground, seen from 2 m",
                seed: 5_000,
                groups: vec![hazy(5_000.0, 3e-3), hazy(1_000.0, 5e-3)],
            },
        }
    }
}

impl Group {
    /// The document, checked.
    pub(crate) fn scene(&self) -> Result<Scene, SceneError> {
        Scene::from_json(&self.scene.to_string())
    }

    /// One view for each observer and sun, in their order.
    pub(crate) fn suns(&self) -> Vec<View> {
        let mut suns: Vec<View> = Vec::new();
        for view in &self.views {
            let same = |other: &View| {
                (other.altitude_m, other.sun_zenith_deg) == (view.altitude_m, view.sun_zenith_deg)
            };
            if !suns.iter().any(same) {
                suns.push(*view);
            }
        }
        suns
    }
}

/// The constants of the Complutense thesis with some times its aerosols.
fn thesis(turbidity: f64) -> Value {
    json!({
        "planet": {"radius_m": 6_371_000.0},
        "atmosphere": {
            "rayleigh": {"scattering_per_m": [5.8e-6, 13.5e-6, 33.1e-6], "scale_height_m": 7994.0},
            "mie": {"scattering_per_m": 2e-5 * turbidity, "absorption_per_m": 2e-6 * turbidity,
                    "scale_height_m": 1200.0, "asymmetry": 0.76},
            "ozone": null
        }
    })
}

/// The air at 680, 550 and 440 nm (Bruneton and Neyret 2008, Hillaire 2020).
fn earth(suns_deg: &[f64], relative_error: f64) -> Group {
    Group {
        scene: json!({"atmosphere": {
            "rayleigh": {"scattering_per_m": [5.802e-6, 13.558e-6, 33.1e-6]},
            "ozone": {"absorption_per_m": [0.650e-6, 1.881e-6, 0.085e-6]}
        }}),
        albedos: vec![0.1, 0.8],
        relative_error,
        views: sky(0.0, suns_deg, &DIRECTIONS),
    }
}

fn hazy(visibility_m: f64, relative_error: f64) -> Group {
    let mut scene = thesis(1.0);
    scene["haze"] = json!({"visibility_m": visibility_m, "top_m": 1000.0, "albedo": 0.95});
    let horizontal = [(90.0, 0.0), (90.0, 90.0), (90.0, 180.0)];
    Group {
        scene,
        albedos: vec![0.0, 0.3],
        relative_error,
        views: sky(2.0, &[30.0, 75.0], &[&DIRECTIONS[..], &horizontal].concat()),
    }
}

fn sky(altitude_m: f64, suns_deg: &[f64], directions: &[(f64, f64)]) -> Vec<View> {
    let views = suns_deg.iter().flat_map(|sun_zenith_deg| {
        directions
            .iter()
            // Under a sun overhead all azimuths are alike.
            .filter(|(_, azimuth)| *sun_zenith_deg > 0.0 || *azimuth == 0.0)
            .map(|(view_zenith_deg, view_azimuth_deg)| View {
                altitude_m,
                sun_zenith_deg: *sun_zenith_deg,
                view_zenith_deg: *view_zenith_deg,
                view_azimuth_deg: *view_azimuth_deg,
            })
    });
    views.collect()
}

/// From 10 km the horizon lies 93.2° from the zenith; from 400 km 109.8°, and the top of the air 107.1°.
fn above() -> Vec<View> {
    let aeroplane = [
        (180.0, 0.0),
        (150.0, 0.0),
        (150.0, 180.0),
        (120.0, 0.0),
        (120.0, 90.0),
        (120.0, 180.0),
        (100.0, 0.0),
        (100.0, 90.0),
        (100.0, 180.0),
        (94.0, 0.0),
        (94.0, 90.0),
        (94.0, 180.0),
        (92.0, 0.0),
        (92.0, 90.0),
        (92.0, 180.0),
    ];
    let orbit = [
        (180.0, 0.0),
        (150.0, 0.0),
        (150.0, 90.0),
        (150.0, 180.0),
        (120.0, 0.0),
        (120.0, 90.0),
        (120.0, 180.0),
        (111.0, 0.0),
        (111.0, 90.0),
        (111.0, 180.0),
        (109.0, 0.0),
        (109.0, 90.0),
        (109.0, 180.0),
    ];
    let suns = [30.0, 75.0];
    [sky(1e4, &suns, &aeroplane), sky(4e5, &suns, &orbit)].concat()
}
