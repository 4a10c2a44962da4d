//! Lamps, towns and plates of ice: what is allowed, and what is said of what is not.

use proptest::{option, prelude::*, sample::select};
use serde_json::{Value, json};
use welkin_scene::{
    Bands, CrystalLayer, IceCrystals, Light, Scene, Town,
    ice_crystals::{CrystalVariation, GaussianTilt, Reflectance, Tilt, UniformTilt},
    lights::{Above, Emission, Lamp, Power, ProceduralTown},
};

prop_compose! {
    fn light()(
        position_m in prop::array::uniform3(-1e6..=1e6),
        radius_m in 0.0..=100.0,
        power in prop_oneof![
            prop::array::uniform3(0.0..=1e9).prop_map(|rgb| (Some(Bands::Rgb(rgb)), None, None, None)),
            (1000.0..=2e4, 0.0..=1e9).prop_map(|(k, cd)| (None, Some(Lamp::WhiteLed), Some(k), Some(cd))),
            Just((None, Some(Lamp::Mercury), None, None)),
        ],
        emission in select(vec![Emission::Isotropic, Emission::CosineUp, Emission::FullCutoff]),
        above in select(vec![Above::Sphere, Above::Ground]),
    ) -> Light {
        let (radiant_intensity_w_sr, lamp, colour_temperature_k, luminous_intensity_cd) = power;
        Light { position_m, above, radiant_intensity_w_sr, lamp, colour_temperature_k, luminous_intensity_cd, radius_m, emission }
    }
}

fn tilt() -> impl Strategy<Value = Tilt> {
    let spread =
        (0.05..=15.0, 0.1..=45.0).prop_map(|(sigma_deg, max_deg)| GaussianTilt { sigma_deg, max_deg });
    prop_oneof![
        spread.clone().prop_map(Tilt::Gaussian),
        spread.prop_map(Tilt::Slope),
        (0.1..=45.0).prop_map(|max_deg| Tilt::Uniform(UniformTilt { max_deg })),
    ]
}

prop_compose! {
    fn layer()(
        base_m in 0.0..=1e4,
        thickness_m in 1.0..=1e4,
        number_density_per_m3 in 0.0..=1e9,
        plate_area_m2 in 0.0..=1e-4,
        tilt in tilt(),
        reflectance in select(vec![Reflectance::Slab, Reflectance::Outer]),
        extinction_per_m in 0.0..=0.1,
        amount in option::of(0.0..=1.0),
    ) -> CrystalLayer {
        let variation = amount.map(|amount| CrystalVariation { amount, ..CrystalVariation::default() });
        CrystalLayer { base_m, top_m: base_m + thickness_m, number_density_per_m3, plate_area_m2, tilt, reflectance, extinction_per_m, variation }
    }
}

/// What a scene may hold of each.
pub(crate) fn pillars() -> impl Strategy<Value = (Vec<Light>, Option<Town>, Option<IceCrystals>)> {
    let town = (any::<u32>(), 0_u32..=20_000).prop_map(|(seed, count)| {
        Town::Procedural(ProceduralTown {
            seed,
            count,
            ..ProceduralTown::default()
        })
    });
    let ice = prop_oneof![
        layer().prop_map(IceCrystals::One),
        prop::collection::vec(layer(), 0..=4).prop_map(IceCrystals::Several),
    ];
    (
        prop::collection::vec(light(), 0..4),
        option::of(town),
        option::of(ice),
    )
}

#[test]
fn what_is_wrong_is_said_at_its_field() {
    let light = |light: Value| json!({ "lights": [light] });
    for (scene, pointer) in [
        (light(json!({"watts": 3})), "/lights/0/watts"),
        (light(json!({"lamp": "torch"})), "/lights/0/lamp"),
        (light(json!({"position_m": [0, 0]})), "/lights/0/position_m"),
        (light(json!({"radius_m": -1})), "/lights/0/radius_m"),
        (
            light(json!({"radiant_intensity_w_sr": [1, 1, 1], "lamp": "candle"})),
            "/lights/0/lamp",
        ),
        (
            light(json!({"radiant_intensity_w_sr": 1, "luminous_intensity_cd": 5})),
            "/lights/0/luminous_intensity_cd",
        ),
        (
            light(json!({"lamp": "mercury", "colour_temperature_k": 3000})),
            "/lights/0/colour_temperature_k",
        ),
        (
            json!({"town": {"kind": "procedural", "count": 20_001}}),
            "/town/count",
        ),
        (json!({"town": {"kind": "asset", "name": "A"}}), "/town/name"),
        (
            json!({"ice_crystals": {"base_m": 400, "top_m": 300}}),
            "/ice_crystals/top_m",
        ),
        (
            json!({"ice_crystals": [{}, {"base_m": 400, "top_m": 300}]}),
            "/ice_crystals/1/top_m",
        ),
        (
            json!({"ice_crystals": {"tilt": {"kind": "gaussian", "sigma_deg": 0}}}),
            "/ice_crystals/tilt/sigma_deg",
        ),
    ] {
        let error = Scene::from_value(&scene).unwrap_err().to_string();
        assert!(error.contains(pointer), "{scene}: {error}");
    }
    assert!(Scene::from_value(&json!({"lights": vec![json!({}); 20_001]})).is_err());
}

#[test]
fn brightness_is_said_in_watts_or_candela() {
    let power = |light: Value| {
        let scene = Scene::from_value(&json!({ "lights": [light] })).unwrap();
        scene.lights[0].power()
    };
    assert_eq!(
        power(json!({"radiant_intensity_w_sr": 2})),
        Power::Radiant([2.0; 3])
    );
    assert_eq!(
        power(json!({})),
        Power::Luminous {
            lamp: Lamp::HighPressureSodium,
            colour_temperature_k: None,
            candela: 1_000.0,
        }
    );
}

#[test]
fn a_town_is_the_same_for_the_same_seed_and_a_smaller_one_its_beginning() {
    let town = ProceduralTown::default();
    let lights = town.lights();
    assert_eq!(lights.len(), 300);
    assert_eq!(lights, town.lights());
    let fewer = ProceduralTown {
        count: 20,
        ..town.clone()
    };
    assert_eq!(fewer.lights(), lights[..20]);
    let other = ProceduralTown {
        seed: 2,
        ..town.clone()
    };
    assert_ne!(other.lights(), lights);
    for light in &lights {
        let [east, north, up] = light.position_m;
        // Half a street beyond the radius, by the way to the nearest one, and the pavement.
        assert!(east.hypot(north - 3_000.0) < 1_500.0 + 50.0, "{light:?}");
        assert_eq!(up, 9.0);
    }
}
