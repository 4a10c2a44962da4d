//! Ground: what mountains and towns cost, with shadows and shafts and without, and the last block of a thesis' table.

mod mesh;
mod mountains;
mod scenes;
mod tables;
mod town;

use super::{
    Account, Case, Limits, Setup, Size, Work,
    stopwatch::{Stopwatch, peak_memory_bytes},
    viewer::{AIR_TABLES, CAMERA_PASSES, Viewer, forbidden},
};
use crate::{commands::Failure, settings::Settings};
use scenes::{Light, Staged};
use serde_json::{Value, json};
use tables::{FEW_TRIANGLES, OWN_SIZE, THESIS_SIZES, Table};
use welkin_scene::{
    Direction, Quality, Scene, SunPosition,
    renderer::Render,
    terrain::{Shadow, ShadowMap, Terrain},
};

/// Of the shadow map, pixels a side.
const MAP_SIZES: [u32; 5] = [512, 1024, 2048, 4096, 8192];

/// What a frame with shadows and shafts may cost over the same without.
const MOST_FOR_LIGHT: f64 = 2.0;
/// What a frame of many triangles may cost over one of few.
const MOST_FOR_TRIANGLES: f64 = 1.5;

/// Where the shadow lies; it does not depend on who looks.
const SHADOW: &str = "ground_shadow";
/// What is seen of the ground in a tile.
const VIEW: [&str; 3] = ["ground_view", "ground_light", "shafts"];

pub(super) struct Ground;

impl Case for Ground {
    fn name(&self) -> &'static str {
        "ground"
    }

    fn rounds(&self) -> u32 {
        3
    }

    fn tables(&self) -> Vec<String> {
        let name = |table: &Table| json!(table).as_str().map(str::to_owned);
        Table::ALL.iter().filter_map(name).collect()
    }

    fn setups(&self, sizes: Option<&[Size]>) -> Vec<Setup> {
        let own = [THESIS_SIZES.as_slice(), &[OWN_SIZE]].concat();
        let of_size = |size: &Size| {
            let wanted = |table: &Table| sizes.is_some() || table.sizes().contains(size);
            let tables = Table::ALL.into_iter().filter(wanted);
            let setup = |parameters| Setup {
                size: *size,
                parameters,
            };
            tables.flat_map(Table::parameters).map(setup).collect::<Vec<_>>()
        };
        sizes.unwrap_or(&own).iter().flat_map(of_size).collect()
    }

    fn plainer(&self, setup: &Setup) -> Option<Setup> {
        let plainer = |name: &str, value: Value| {
            let mut plainer = setup.clone();
            let own = plainer.parameters.insert(name.to_owned(), value.clone())?;
            (own != value).then_some(plainer)
        };
        match setup.parameter("table").ok()? {
            Table::FinalApproach | Table::Ground => plainer("light", json!(Light::Plain)),
            Table::Triangles => plainer("triangles", json!(FEW_TRIANGLES)),
            Table::ShadowMaps => None,
        }
    }

    fn limits(&self, setup: &Setup, work: &str) -> Limits {
        // The thesis too made its map anew only when the light moved, and counted frames between.
        let counts = work.starts_with("camera-");
        let cost = match setup.parameter("table") {
            Ok(Table::Triangles) => Some(MOST_FOR_TRIANGLES),
            Ok(_)
                if setup
                    .parameter("light")
                    .is_ok_and(|light: Light| light == Light::ShadowsAndShafts) =>
            {
                Some(MOST_FOR_LIGHT)
            }
            _ => None,
        };
        Limits {
            cost: cost.filter(|_| counts && self.plainer(setup).is_some()),
            ..Limits::default()
        }
    }

    fn measure(&self, setup: &Setup, settings: &Settings) -> Result<Account, Failure> {
        let staged = match setup.parameter("table")? {
            Table::FinalApproach => scenes::thesis(
                setup.parameter("relief")?,
                setup.parameter("place")?,
                setup.parameter("light")?,
            ),
            Table::Ground => scenes::by_seed(setup.parameter("light")?),
            Table::ShadowMaps => scenes::by_seed(Light::ShadowsAndShafts),
            Table::Triangles => scenes::of_triangles(setup.parameter("triangles")?),
        };
        let quality = match setup.parameters.get("quality") {
            Some(_) => setup.parameter("quality")?,
            None => Quality::Final,
        };
        match setup.parameter("table")? {
            Table::ShadowMaps => shadow_maps(staged, setup.size, settings),
            _ => changes(staged, (setup.size, quality), settings),
        }
    }
}

/// What somebody does who walks about.
fn changes(
    staged: Staged,
    (size, quality): (Size, Quality),
    settings: &Settings,
) -> Result<Account, Failure> {
    let Staged { mut scene, assets } = staged;
    let watch = Stopwatch::start();
    let renderer = crate::open_renderer(settings)?;
    let viewer = Viewer {
        renderer: &*renderer,
        size,
        quality,
        assets,
    };
    let (mut first, _) = viewer.see("first-frame", &scene)?;
    first.spent = watch.stop();
    // The second frame still pays for memory and for finding the size of tiles.
    turn_sun(&mut scene, 1.0);
    viewer.see("unmeasured", &scene)?;

    turn_sun(&mut scene, 1.0);
    let (mut sun_moved, _) = viewer.see("sun-moved", &scene)?;
    sun_moved.fault = forbidden(&sun_moved.passes, |pass| !AIR_TABLES.contains(&pass));

    let before = scene.camera.direction.to_angles();
    scene.camera.direction = Direction::angles(before.azimuth_deg + 5.0, before.elevation_deg);
    let (mut turned, _) = viewer.see("camera-turned", &scene)?;
    turned.fault = forbidden(&turned.passes, |pass| {
        CAMERA_PASSES.contains(&pass) || VIEW.contains(&pass)
    });

    scene.camera.position_m[1] += 20.0;
    scene.camera.position_m[2] += 1.0;
    let (mut moved, _) = viewer.see("camera-moved", &scene)?;
    moved.fault = forbidden(&moved.passes, |pass| {
        !AIR_TABLES.contains(&pass) && pass != SHADOW
    });

    let (mut nothing_changed, _) = viewer.see("nothing-changed", &scene)?;
    nothing_changed.fault = forbidden(&nothing_changed.passes, |_| false);

    if let Some(air) = &mut scene.atmosphere {
        air.density_factor *= 1.1;
    }
    let (mut air_changed, _) = viewer.see("air-changed", &scene)?;
    air_changed.fault = forbidden(&air_changed.passes, |pass| pass != SHADOW);

    let works = vec![first, sun_moved, turned, moved, nothing_changed, air_changed];
    Ok(account(&*renderer, works))
}

/// Each size of the map when the sun has moved, and when the camera turns thereafter.
fn shadow_maps(staged: Staged, size: Size, settings: &Settings) -> Result<Account, Failure> {
    let Staged { mut scene, assets } = staged;
    let renderer = crate::open_renderer(settings)?;
    let viewer = Viewer {
        renderer: &*renderer,
        size,
        quality: Quality::Final,
        assets,
    };
    viewer.see("unmeasured", &scene)?;
    let mut works = Vec::new();
    for size_px in MAP_SIZES {
        if let Some(Terrain::Heightfield(field)) = &mut scene.terrain {
            field.shadow = Some(Shadow::Map(ShadowMap {
                size_px,
                ..ShadowMap::default()
            }));
        }
        turn_sun(&mut scene, 1.0);
        let (mut sun_moved, _) = viewer.see("sun-moved", &scene)?;
        sun_moved.fault = forbidden(&sun_moved.passes, |pass| !AIR_TABLES.contains(&pass));
        let before = scene.camera.direction.to_angles();
        scene.camera.direction = Direction::angles(before.azimuth_deg + 1.0, before.elevation_deg);
        let (mut turned, _) = viewer.see("camera-turned", &scene)?;
        turned.fault = forbidden(&turned.passes, |pass| {
            CAMERA_PASSES.contains(&pass) || VIEW.contains(&pass)
        });
        for mut work in [sun_moved, turned] {
            work.varied.insert("shadow_size_px".to_owned(), json!(size_px));
            works.push(work);
        }
    }
    Ok(account(&*renderer, works))
}

fn turn_sun(scene: &mut Scene, by_deg: f64) {
    if let SunPosition::Direction(direction) = scene.sun.position {
        let before = direction.to_angles();
        let turned = Direction::angles(before.azimuth_deg + by_deg, before.elevation_deg);
        scene.sun.position = SunPosition::Direction(turned);
    }
}

fn account(renderer: &dyn Render, works: Vec<Work>) -> Account {
    Account {
        device: renderer.device(),
        works,
        peak_memory_bytes: peak_memory_bytes(),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use scenes::{Place, Relief};
    use tables::MANY_TRIANGLES;

    #[test]
    fn each_setup_names_a_table_and_is_compared_with_a_plainer_one_that_is_measured_too() {
        let setups = Ground.setups(None);
        // Twelve of the thesis' at three sizes, eight, one and two of our own.
        assert_eq!(setups.len(), 3 * 12 + 8 + 1 + 2);
        let mut limited = 0;
        for setup in &setups {
            let table: Table = setup.parameter("table").unwrap();
            assert!(Ground.tables().contains(&setup.parameter("table").unwrap()));
            let plainer = Ground.plainer(setup);
            if let Some(plainer) = &plainer {
                assert!(setups.contains(plainer), "{plainer:?}");
                assert_eq!(plainer.size, setup.size);
                assert!(Ground.plainer(plainer).is_none(), "{plainer:?}");
            }
            let cost = Ground.limits(setup, "camera-turned").cost;
            assert!(cost.is_none() || plainer.is_some(), "{setup:?}");
            assert_eq!(
                cost == Some(MOST_FOR_TRIANGLES),
                cost.is_some() && table == Table::Triangles
            );
            assert_eq!(Ground.limits(setup, "sun-moved"), Limits::default());
            limited += u32::from(cost.is_some());
        }
        assert_eq!(limited, 3 * 4 + 2 + 1);
    }

    #[test]
    fn meshes_have_as_many_triangles_as_the_rows_say() {
        for count in [FEW_TRIANGLES, MANY_TRIANGLES] {
            let staged = scenes::of_triangles(count);
            let model = &staged.assets.meshes["relief"];
            assert_eq!(model.triangles.len(), usize::try_from(count).unwrap());
        }
        let thesis = scenes::thesis(Relief::Mountains, Place::Ground, Light::Plain);
        assert_eq!(thesis.assets.meshes["relief"].triangles.len(), 97_650);
    }

    #[test]
    fn each_scene_is_one_that_may_be_ordered() {
        let mut staged = vec![scenes::of_triangles(FEW_TRIANGLES)];
        for light in Light::ALL {
            staged.push(scenes::by_seed(light));
            for place in [Place::Ground, Place::Space] {
                staged.push(scenes::thesis(Relief::Town, place, light));
            }
        }
        for Staged { scene, assets } in staged {
            let text = serde_json::to_string(&scene).unwrap();
            assert_eq!(Scene::from_json(&text).unwrap(), scene);
            for reference in scene.asset_references() {
                assert!(assets.meshes.contains_key(reference.name));
            }
        }
    }
}
