//! What stands on the planet's sphere: its shape on the device, its frame, and what covers it.

mod field;
mod frame;
mod mesh;
mod mountains;
mod rivers;
mod skin;

pub(crate) use field::{Field, Lift};
pub(crate) use frame::Frame;

use crate::{
    error::Error,
    gpu::Gpu,
    memo::{Fingerprint, Memo},
    uniforms::{Part, Standpoint, ground::GroundUniform, narrow},
};
use glam::{DVec2, DVec3, USizeVec2, UVec2};
pub(crate) use mesh::Solid;
pub(crate) use mountains::Range;
pub(crate) use skin::{skin, wind_m_s};
use std::sync::Arc;
use welkin_scene::{Scene, Terrain, assets::SceneAssets, terrain::Heightfield};

/// A shape on the device.
pub(crate) struct Shape {
    pub(crate) words: wgpu::Buffer,
    pub(crate) finder: wgpu::Buffer,
    /// Attributes, materials and pictures of a mesh.
    pub(crate) cover: [wgpu::Buffer; 3],
    pub(crate) made_from: Fingerprint,
    /// As `lib/ground_cast.wgsl` numbers it.
    pub(crate) code: f64,
    /// But for the frame and who looks.
    bare: GroundUniform,
    /// Corners of the box about it, in its frame.
    pub(crate) least_m: DVec3,
    pub(crate) most_m: DVec3,
}

/// Shapes of the latest scenes.
pub(crate) struct Shapes {
    grids: Memo<(USizeVec2, Vec<f32>)>,
    shapes: Memo<Shape>,
}

/// A scene's terrain, ready for rays.
pub(crate) struct Terrains {
    pub(crate) shape: Arc<Shape>,
    pub(crate) frame: Frame,
}

impl Shapes {
    pub(crate) const fn new() -> Self {
        Self {
            grids: Memo::new(2),
            shapes: Memo::new(3),
        }
    }

    /// Of a scene without terrain, nothing but the sphere.
    pub(crate) fn of(&mut self, gpu: &Gpu, scene: &Scene, assets: &SceneAssets) -> Result<Terrains, Error> {
        let radius_m = scene.planet.radius_m;
        match &scene.terrain {
            None => {
                let made_from = Fingerprint::of(("sphere", radius_m.to_bits()));
                Ok(Terrains {
                    shape: self
                        .shapes
                        .get_or(made_from, || Shape::none(gpu, radius_m, made_from)),
                    frame: Frame::new(radius_m, [0.0; 2], 0.0),
                })
            }
            Some(Terrain::Heightfield(field)) => {
                let frame = Frame::new(radius_m, field.centre_m, field.azimuth_deg);
                let shape = self.heightfield(gpu, field, assets, &frame, radius_m)?;
                Ok(Terrains { shape, frame })
            }
            Some(Terrain::Mesh(mesh)) => {
                let found = assets.meshes.get(&mesh.name);
                let model = found.ok_or_else(|| Error::Asset(mesh.name.clone()))?;
                let placed = format!(
                    "{:?} {:?} {radius_m}",
                    mesh.axes(),
                    (mesh.position_m[2], mesh.phong)
                );
                let made_from = Fingerprint::of(("mesh", model.digest, placed));
                let make = || {
                    Ok::<_, Error>(Shape::of_mesh(
                        gpu,
                        &Solid::new(model, mesh, radius_m)?,
                        radius_m,
                        made_from,
                    ))
                };
                Ok(Terrains {
                    shape: self.shapes.try_get_or(made_from, make)?,
                    frame: Solid::frame(mesh, radius_m),
                })
            }
        }
    }

    fn heightfield(
        &mut self,
        gpu: &Gpu,
        field: &Heightfield,
        assets: &SceneAssets,
        frame: &Frame,
        radius_m: f64,
    ) -> Result<Arc<Shape>, Error> {
        let asset = field
            .name
            .as_ref()
            .map(|name| {
                let found = assets.heightfields.get(name);
                found.ok_or_else(|| Error::Asset(name.clone()))
            })
            .transpose()?;
        let relief = field.relief(asset.map(AsRef::as_ref));
        let lift = Lift {
            extent_m: DVec2::from_array(relief.extent_m),
            height_m: relief.height_m,
            base_m: field.base_m,
            edge_fade: field.edge_fade,
        };
        let lifted = (format!("{lift:?}"), radius_m.to_bits());
        if let Some(grid) = asset {
            let made_from = Fingerprint::of(("heightfield", grid.digest, &lifted));
            return Ok(self.shapes.get_or(made_from, || {
                let size = UVec2::new(grid.width, grid.height).as_usizevec2();
                Shape::of_field(gpu, &Field::new(size, &grid.heights, lift), radius_m, made_from)
            }));
        }
        let range = Range {
            mountains: field.made().unwrap_or_default(),
            extent_m: relief.extent_m[0],
            height_m: relief.height_m,
            origin_m: frame.place(DVec3::ZERO).truncate(),
        };
        let grid_from = Fingerprint::of(("mountains", format!("{range:?}")));
        let made_from = Fingerprint::of(("heightfield", grid_from, &lifted));
        let grids = &mut self.grids;
        Ok(self.shapes.get_or(made_from, || {
            let grid = grids.get_or(grid_from, || range.make());
            let (size, heights) = &*grid;
            Shape::of_field(gpu, &Field::new(*size, heights, lift), radius_m, made_from)
        }))
    }
}

impl Shape {
    fn none(gpu: &Gpu, radius_m: f64, made_from: Fingerprint) -> Self {
        let nothing = || gpu.buffer("nothing", 16, wgpu::BufferUsages::STORAGE);
        Self {
            words: nothing(),
            finder: nothing(),
            cover: uncovered(gpu),
            made_from,
            code: 0.0,
            bare: GroundUniform {
                radius_m: narrow(radius_m),
                ..GroundUniform::default()
            },
            least_m: DVec3::ZERO,
            most_m: DVec3::ZERO,
        }
    }

    fn of_field(gpu: &Gpu, field: &Field, radius_m: f64, made_from: Fingerprint) -> Self {
        let storage = |label, words: &[f32]| {
            gpu.filled(label, bytemuck::cast_slice(words), wgpu::BufferUsages::STORAGE)
        };
        let half = field.extent_m / 2.0;
        let fall_m = radius_m - (radius_m * radius_m - half.length_squared()).max(0.0).sqrt();
        Self {
            words: storage("heights", &field.heights_m),
            finder: storage("peaks", &field.peaks_m),
            cover: uncovered(gpu),
            made_from,
            code: 1.0,
            bare: GroundUniform {
                radius_m: narrow(radius_m),
                highest_m: field.highest_m,
                lowest_m: field.lowest_m,
                bend_per_m: narrow(1.0 / (8.0 * radius_m)),
                corner_m: (-half).as_vec2(),
                cell_m: field.cell_m().as_vec2(),
                cells: field.cells.as_uvec2(),
                levels: field.levels,
                ..GroundUniform::default()
            },
            least_m: (-half).extend(f64::from(field.lowest_m) - fall_m),
            most_m: half.extend(f64::from(field.highest_m)),
        }
    }
}

/// What stands where a mesh's cover is bound, if there is none.
fn uncovered(gpu: &Gpu) -> [wgpu::Buffer; 3] {
    ["attributes", "materials", "pictures"].map(|label| gpu.buffer(label, 48, wgpu::BufferUsages::STORAGE))
}

impl Shape {
    fn of_mesh(gpu: &Gpu, solid: &Solid, radius_m: f64, made_from: Fingerprint) -> Self {
        let storage = |label, words: &[u32]| {
            gpu.filled(label, bytemuck::cast_slice(words), wgpu::BufferUsages::STORAGE)
        };
        let size = solid.most_m - solid.least_m;
        Self {
            words: storage("triangles", bytemuck::cast_slice(&solid.triangles)),
            finder: storage("nodes", &solid.nodes),
            cover: [
                storage("attributes", &solid.attributes),
                storage("materials", &solid.materials),
                storage("pictures", &solid.pictures),
            ],
            made_from,
            code: 2.0,
            bare: GroundUniform {
                radius_m: narrow(radius_m),
                highest_m: narrow(solid.most_m.z),
                lowest_m: narrow(solid.least_m.z),
                corner_m: solid.least_m.truncate().as_vec2(),
                cell_m: size.truncate().as_vec2(),
                cells: UVec2::ONE,
                ..GroundUniform::default()
            },
            least_m: solid.least_m,
            most_m: solid.most_m,
        }
    }
}

impl Terrains {
    /// As an observer at a place in the scene looks at it.
    pub(crate) fn uniform(&self, place_m: DVec3) -> GroundUniform {
        GroundUniform {
            east: self.frame.east.as_vec3(),
            north: self.frame.north.as_vec3(),
            up: self.frame.up.as_vec3(),
            place_m: self.frame.place(place_m).as_vec3(),
            ..self.shape.bare.clone()
        }
    }

    /// As rays see it that begin in its own frame.
    pub(crate) fn own(&self) -> Part {
        Part::new(&self.uniform(self.frame.origin_m))
    }

    /// The place over its middle, half as high as it is, for the light of the sky there.
    pub(crate) fn stand(&self, sun: DVec3) -> Standpoint {
        Standpoint {
            altitude_m: (self.shape.most_m.z / 2.0).max(0.0),
            up: self.frame.up,
            sun,
        }
    }
}
