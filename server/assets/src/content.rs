//! What files become in memory, each from its own kind.

use crate::{
    Error, Kind,
    facts::{Facts, HeightFacts, MeshFacts},
    heights, mesh, png_file,
};
use std::{
    any::Any,
    panic::{AssertUnwindSafe, catch_unwind},
};
use welkin_scene::{HeightGrid, MeshModel, WeatherPicture};

/// A file of one kind as a renderer gets it.
pub(crate) trait Content: Any + Send + Sync {
    /// SHA-256 of the file.
    fn digest(&self) -> &[u8; 32];
    /// What it takes in memory.
    fn bytes(&self) -> u64;
    /// What it will take at most, by the file's header.
    fn most_bytes(file: &[u8]) -> Result<u64, Error>
    where
        Self: Sized;
    /// Reads a file to its end.
    fn read(file: &[u8], digest: [u8; 32]) -> Result<Self, Error>
    where
        Self: Sized;
}

/// Reads by readers that others wrote. Some of them panic over files made to confuse them (an index beyond all
/// integers in an OBJ, a shape of 2^80 numbers in an NPY): such a file is refused like any other that is damaged.
pub(crate) fn guarded<T>(read: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    let unreadable = |_| Err(Error::damaged("it makes no sense to its reader"));
    catch_unwind(AssertUnwindSafe(read)).unwrap_or_else(unreadable)
}

impl Content for WeatherPicture {
    fn digest(&self) -> &[u8; 32] {
        &self.digest
    }

    fn bytes(&self) -> u64 {
        self.rgba.len() as u64
    }

    fn most_bytes(file: &[u8]) -> Result<u64, Error> {
        Ok(png_file::facts(file)?.rgba_bytes())
    }

    fn read(file: &[u8], digest: [u8; 32]) -> Result<Self, Error> {
        let facts = png_file::facts(file)?;
        Ok(Self {
            width_px: facts.width_px,
            height_px: facts.height_px,
            rgba: png_file::rgba(file)?.into(),
            digest,
        })
    }
}

impl Content for HeightGrid {
    fn digest(&self) -> &[u8; 32] {
        &self.digest
    }

    fn bytes(&self) -> u64 {
        size_of_val(&*self.heights) as u64
    }

    fn most_bytes(_: &[u8]) -> Result<u64, Error> {
        Ok(heights::MOST_BYTES)
    }

    fn read(file: &[u8], digest: [u8; 32]) -> Result<Self, Error> {
        guarded(|| heights::read(Kind::Heightfields.form_of(file)?, file, digest))
    }
}

impl Content for MeshModel {
    fn digest(&self) -> &[u8; 32] {
        &self.digest
    }

    fn bytes(&self) -> u64 {
        let vertices = size_of_val(&*self.positions) + size_of_val(&*self.normals) + size_of_val(&*self.uvs);
        let triangles = size_of_val(&*self.triangles) + size_of_val(&*self.material_of);
        let textures: usize = self.textures.iter().map(|texture| texture.rgba.len()).sum();
        (vertices + triangles + textures) as u64
    }

    fn most_bytes(_: &[u8]) -> Result<u64, Error> {
        Ok(mesh::MOST_BYTES)
    }

    fn read(file: &[u8], digest: [u8; 32]) -> Result<Self, Error> {
        guarded(|| mesh::read(Kind::Meshes.form_of(file)?, file, digest))
    }
}

impl From<&HeightGrid> for Facts {
    fn from(grid: &HeightGrid) -> Self {
        Self::Heights(HeightFacts::from(grid))
    }
}

impl From<&MeshModel> for Facts {
    fn from(mesh: &MeshModel) -> Self {
        Self::Mesh(MeshFacts::from(mesh))
    }
}
