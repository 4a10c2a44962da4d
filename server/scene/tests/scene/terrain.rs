//! Terrain, shafts and water: what they are by default, every kind of fault, and random valid ones.

use crate::faults::problems;
use proptest::{array, option, prelude::*, sample::select};
use serde_json::{Value, json};
use welkin_scene::{
    HeightGrid, Scene, Shafts, SphereSurface, Terrain, Water,
    shafts::{ExactShafts, RadialShafts},
    terrain::{
        GroundAlbedo, Heightfield, Mesh, Mountains, Phong, PlainAlbedo, Shadow, ShadowFilter, ShadowMap,
        Surface, SurfaceBands, UpAxis,
    },
};

fn shadow() -> impl Strategy<Value = Shadow> {
    let filters = vec![
        ShadowFilter::Nearest,
        ShadowFilter::Bilinear,
        ShadowFilter::Gaussian,
    ];
    prop_oneof![
        (9_u32..=13, select(filters)).prop_map(|(power, filter)| {
            Shadow::Map(ShadowMap {
                size_px: 1 << power,
                filter,
            })
        }),
        Just(Shadow::Rays {}),
    ]
}

fn phong() -> impl Strategy<Value = Phong> {
    (0.0..=1.0, 0.0..=1.0, 0.0..=1.0, 1.0..=1000.0).prop_map(|(ambient, diffuse, specular, shininess)| {
        Phong {
            ambient,
            diffuse,
            specular,
            shininess,
        }
    })
}

fn albedo() -> impl Strategy<Value = GroundAlbedo> {
    let rgb = || array::uniform3(0.0..=1.0);
    let line = || -2e4..=5e4;
    let bands = (
        (rgb(), rgb(), rgb()),
        (line(), line(), 0.0..=5e3),
        (0.0..=90.0, 0.0..=90.0),
    )
        .prop_map(
            |(
                (grass, rock, snow),
                (grass_line_m, snow_line_m, line_width_m),
                (rock_slope_deg, snow_slope_deg),
            )| {
                GroundAlbedo::Bands(SurfaceBands {
                    grass,
                    rock,
                    snow,
                    grass_line_m,
                    snow_line_m,
                    line_width_m,
                    rock_slope_deg,
                    snow_slope_deg,
                })
            },
        );
    prop_oneof![
        bands,
        rgb().prop_map(|rgb| GroundAlbedo::Plain(PlainAlbedo { rgb }))
    ]
}

fn mountains() -> impl Strategy<Value = Mountains> {
    (
        any::<u32>(),
        500.0..=1e5,
        0.0..=1.0,
        0.0..=1.0,
        0.0..=1.0,
        0.0..=1e6,
    )
        .prop_map(
            |(seed, ridge_scale_m, roughness, erosion, warp, valley_radius_m)| Mountains {
                seed,
                ridge_scale_m,
                roughness,
                erosion,
                warp,
                valley_radius_m,
            },
        )
}

fn heightfield() -> impl Strategy<Value = Heightfield> {
    let source = prop_oneof![
        "[a-z0-9][a-z0-9_-]{0,63}".prop_map(|name| (Some(name), None)),
        option::of(mountains()).prop_map(|mountains| (None, mountains)),
    ];
    (
        source,
        (option::of(100.0..=1e6), option::of(0.0..=2e4), -2e4..=2e4),
        (array::uniform2(-1e6..=1e6), -360.0..=360.0, 0.0..=1.0),
        (albedo(), phong(), option::of(shadow())),
    )
        .prop_map(
            |((name, mountains), (extent_m, height_m, base_m), (centre_m, azimuth_deg, edge_fade), lit)| {
                let (albedo, phong, shadow) = lit;
                Heightfield {
                    name,
                    mountains,
                    extent_m,
                    height_m,
                    base_m,
                    centre_m,
                    azimuth_deg,
                    edge_fade,
                    surface: Surface { albedo, phong },
                    shadow,
                }
            },
        )
}

fn mesh() -> impl Strategy<Value = Mesh> {
    (
        "[a-z0-9][a-z0-9_-]{0,63}",
        1e-6..=1e6,
        array::uniform3(-1e6..=1e6),
        -360.0..=360.0,
        select(vec![UpAxis::Y, UpAxis::Z]),
        option::of(phong()),
        option::of(shadow()),
    )
        .prop_map(
            |(name, scale, position_m, azimuth_deg, up_axis, phong, shadow)| Mesh {
                name,
                scale,
                position_m,
                azimuth_deg,
                up_axis,
                phong,
                shadow,
            },
        )
}

pub(crate) fn terrain() -> impl Strategy<Value = Terrain> {
    prop_oneof![
        heightfield().prop_map(Terrain::Heightfield),
        mesh().prop_map(Terrain::Mesh)
    ]
}

pub(crate) fn shafts() -> impl Strategy<Value = Shafts> {
    prop_oneof![
        (8_u32..=256).prop_map(|steps| Shafts::Exact(ExactShafts { steps })),
        (8_u32..=256, 0.0..=1.0, 0.0..=1.0, 0.0..=10.0).prop_map(|(steps, length, decay, strength)| {
            Shafts::Radial(RadialShafts {
                steps,
                length,
                decay,
                strength,
            })
        }),
    ]
}

pub(crate) fn sphere_surface() -> impl Strategy<Value = SphereSurface> {
    prop_oneof![
        Just(SphereSurface::Ground {}),
        (0.0..=30.0).prop_map(|wind_m_s| SphereSurface::Water(Water { wind_m_s })),
    ]
}

fn read(terrain: Value) -> Terrain {
    let scene = Scene::from_value(&json!({ "terrain": terrain })).unwrap();
    scene.terrain.unwrap()
}

#[test]
fn the_published_examples_are_what_they_say() {
    let Terrain::Heightfield(alps) = read(json!({"kind": "heightfield", "name": "alps", "extent_m": 40000,
        "height_m": 2500, "shadow": {"kind": "map", "size_px": 2048, "filter": "gaussian"}}))
    else {
        panic!("a heightfield");
    };
    assert_eq!(alps.name.as_deref(), Some("alps"));
    assert_eq!((alps.extent_m, alps.height_m), (Some(4e4), Some(2.5e3)));
    assert_eq!(alps.shadow, Some(Shadow::default()));
    assert_eq!(alps.made(), None);
    let Terrain::Mesh(town) = read(json!({"kind": "mesh", "name": "town", "scale": 1})) else {
        panic!("a mesh");
    };
    assert_eq!(
        (town.name.as_str(), town.scale, town.position_m),
        ("town", 1.0, [0.0; 3])
    );
    assert_eq!((town.up_axis, town.shadow), (UpAxis::Y, Some(Shadow::default())));
}

#[test]
fn nothing_is_no_terrain_and_a_heightfield_without_a_name_is_made() {
    assert_eq!(Scene::default().terrain, None);
    let Terrain::Heightfield(field) = read(json!({"kind": "heightfield"})) else {
        panic!("a heightfield");
    };
    assert_eq!(field, Heightfield::default());
    assert_eq!(field.made(), Some(Mountains::default()));
    let Terrain::Heightfield(seven) = read(json!({"kind": "heightfield", "mountains": {"seed": 7.0}})) else {
        panic!("a heightfield");
    };
    assert_eq!(seven.made().unwrap().seed, 7);
}

/// What the scene says counts, then what the file says, then what is usual.
#[test]
fn a_heightfield_is_as_large_as_scene_or_file_say() {
    let field = |extent_m, height_m| Heightfield {
        extent_m,
        height_m,
        ..Heightfield::default()
    };
    let grid = |range_m, extent_m| HeightGrid {
        width: 201,
        height: 101,
        heights: vec![0.0; 201 * 101].into(),
        range_m,
        extent_m,
        digest: [0; 32],
    };
    let bare = grid(None, None);
    let told = grid(Some([400.0, 1400.0]), Some([3e3, 6e3]));
    let size = |field: Heightfield, grid: Option<&HeightGrid>| {
        let relief = field.relief(grid);
        (relief.extent_m, relief.height_m)
    };
    assert_eq!(size(field(None, None), None), ([4e4, 4e4], 2500.0));
    assert_eq!(size(field(Some(8e3), Some(10.0)), None), ([8e3, 8e3], 10.0));
    assert_eq!(size(field(None, None), Some(&bare)), ([4e4, 2e4], 2500.0));
    assert_eq!(size(field(None, None), Some(&told)), ([3e3, 6e3], 1000.0));
    assert_eq!(
        size(field(Some(1.2e4), Some(5.0)), Some(&told)),
        ([6e3, 1.2e4], 5.0)
    );
}

/// A file's axes as east, north and up.
#[test]
fn a_mesh_is_turned_and_scaled() {
    let mesh = |up_axis: &str, azimuth_deg: f64| {
        let Terrain::Mesh(mesh) = read(
            json!({"kind": "mesh", "name": "town", "scale": 2, "up_axis": up_axis,
            "azimuth_deg": azimuth_deg}),
        ) else {
            panic!("a mesh");
        };
        mesh.axes()
    };
    let placed =
        |axes: [[f64; 3]; 3], v: [f64; 3]| axes.map(|row| (0..3).map(|i| row[i] * v[i]).sum::<f64>());
    let near = |a: [f64; 3], b: [f64; 3]| {
        // The sine of a right angle is rounded to 1e-16.
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15), "{a:?} {b:?}");
    };
    near(placed(mesh("z", 0.0), [1.0, 2.0, 3.0]), [2.0, 4.0, 6.0]);
    near(placed(mesh("y", 0.0), [1.0, 2.0, 3.0]), [2.0, -6.0, 4.0]);
    // What looked north looks east.
    near(placed(mesh("z", 90.0), [0.0, 1.0, 0.0]), [2.0, 0.0, 0.0]);
    near(placed(mesh("y", 90.0), [0.0, 0.0, -1.0]), [2.0, 0.0, 0.0]);
    near(placed(mesh("y", 180.0), [1.0, 1.0, 0.0]), [-2.0, 0.0, 2.0]);
}

#[test]
fn faults_name_their_field() {
    for (scene, pointer, message) in [
        (
            json!({"terrain": {"name": "alps"}}),
            "/terrain/kind",
            "`terrain` lacks the field `kind`, which must be one of `heightfield`, `mesh`",
        ),
        (
            json!({"terrain": {"kind": "mesh"}}),
            "/terrain/name",
            "`terrain` lacks the field `name`, which must be a text that matches `^[a-z0-9][a-z0-9_-]{0,63}$`",
        ),
        (
            json!({"terrain": {"kind": "mesh", "name": "../town"}}),
            "/terrain/name",
            "`name` must be a text that matches `^[a-z0-9][a-z0-9_-]{0,63}$`, but is the text \"../town\"",
        ),
        (
            json!({"terrain": {"kind": "heightfield", "shadow": {"kind": "map", "size_px": 3000}}}),
            "/terrain/shadow/size_px",
            "`size_px` must be 512, 1024, 2048, 4096 or 8192 pixels, but is 3000",
        ),
        (
            json!({"terrain": {"kind": "heightfield", "shadow": {"kind": "map", "size_px": 16384}}}),
            "/terrain/shadow/size_px",
            "`size_px` must be a whole number from 512 to 8192 pixels, but is 16384",
        ),
        (
            json!({"terrain": {"kind": "mesh", "name": "town", "shadow": {"kind": "ray"}}}),
            "/terrain/shadow/kind",
            "`kind` must be one of `map`, `rays`, but is the text \"ray\"; did you mean `rays`?",
        ),
        (
            json!({"terrain": {"kind": "heightfield", "surface": {"phong": {"specular": 2}}}}),
            "/terrain/surface/phong/specular",
            "`specular` must be a number from 0 to 1, but is 2",
        ),
        (
            json!({"shafts": {"kind": "exact", "steps": 4}}),
            "/shafts/steps",
            "`steps` must be a whole number from 8 to 256, but is 4",
        ),
        (
            json!({"planet": {"surface": {"kind": "water", "wind_m_s": -1}}}),
            "/planet/surface/wind_m_s",
            "`wind_m_s` must be a number from 0 to 30 metres per second, but is -1",
        ),
        (
            json!({"planet": {"surface": {"kind": "ground", "wind_m_s": 1}}}),
            "/planet/surface/wind_m_s",
            "unknown field `wind_m_s`; `surface` has the field `kind`",
        ),
    ] {
        let found = problems(Scene::from_value(&scene));
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(
            (found[0].pointer.as_str(), found[0].message.as_str()),
            (pointer, message)
        );
    }
    let both = json!({"terrain": {"kind": "heightfield", "name": "alps", "mountains": {}}});
    let found = problems(Scene::from_value(&both));
    assert_eq!(
        (found.len(), found[0].pointer.as_str()),
        (1, "/terrain/mountains")
    );
    assert!(
        found[0].message.contains("left out where `name` is given"),
        "{}",
        found[0].message
    );
}
