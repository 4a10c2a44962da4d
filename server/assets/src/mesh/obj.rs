//! OBJ with its MTL and textures, packed (Wavefront; Ramey, Rose and Tyerman 1995).

use super::{
    Part, Parts, check_size, plain_material,
    textures::{Textures, is_grey},
};
use crate::{
    Error,
    bundle::{Bundle, beside, shown},
};
use std::collections::HashMap;
use tobj::{LoadOptions, MTLLoadResult};
use welkin_scene::Material;

/// The longest name of an object or of a material, bytes: the reader repeats it for every part.
const MOST_NAME_BYTES: usize = 256;
/// What MTL calls colours.
const COLOURS: [&str; 4] = ["Ka", "Kd", "Ks", "Ke"];

pub(super) fn read(file: &[u8]) -> Result<Parts, Error> {
    let bundle = Bundle::open(file)?;
    let path = only_obj(&bundle)?;
    let text = bundle.read(&path)?;
    let text = String::from_utf8_lossy(&text);
    let mut libraries = HashMap::new();
    for name in survey(&text)? {
        let library = beside(&path, &name)?;
        let lines = bundle.read(&library)?;
        libraries.insert(name, (library, whole_colours(&String::from_utf8_lossy(&lines))));
    }
    let options = LoadOptions {
        single_index: true,
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
    };
    let load = |name: &std::path::Path| -> MTLLoadResult {
        let found = name.to_str().and_then(|name| libraries.get(name));
        let (_, lines) = found.ok_or(tobj::LoadError::OpenFileFailed)?;
        tobj::load_mtl_buf(&mut lines.as_bytes())
    };
    let named = |error: tobj::LoadError| Error::refused(format!("{}: {error}", shown(&path)));
    let (models, materials) = tobj::load_obj_buf(&mut text.as_bytes(), &options, load).map_err(named)?;
    let mut parts = Parts::default();
    let mut textures = Textures::default();
    // Textures are named from the library's folder; libraries of one mesh share theirs in all but name.
    let library = libraries.values().map(|(library, _)| library.as_str()).min();
    for material in materials.map_err(named)? {
        let material = self::material(&bundle, library.unwrap_or(&path), material, &mut textures)?;
        parts.materials.push(material);
    }
    parts.textures = textures.all;
    for tobj::Model { mesh, .. } in models {
        let material = match mesh.material_id {
            Some(place) => place,
            None => nameless(&mut parts.materials),
        };
        // The first row of a picture is its top; in OBJ, v grows upwards.
        let from_top = |&[u, v]: &[f32; 2]| [u, 1.0 - v];
        parts.add(Part {
            positions: mesh.positions.as_chunks().0.to_vec(),
            normals: mesh.normals.as_chunks().0.to_vec(),
            uvs: mesh.texcoords.as_chunks().0.iter().map(from_top).collect(),
            corners: &mesh.indices,
            material: u32::try_from(material).map_err(Error::damaged)?,
        })?;
    }
    Ok(parts)
}

fn only_obj(bundle: &Bundle<'_>) -> Result<String, Error> {
    let is_obj = |path: &&str| path.to_ascii_lowercase().ends_with(".obj");
    let found: Vec<_> = bundle.paths().filter(is_obj).collect();
    match found[..] {
        [path] => Ok(path.to_owned()),
        _ => Err(Error::refused(format!(
            "it holds {} files that end in .obj: one is a mesh",
            found.len()
        ))),
    }
}

/// What faces without a material get: one that is made for them, once.
fn nameless(materials: &mut Vec<Material>) -> usize {
    let plain = plain_material();
    if materials.last() != Some(&plain) {
        materials.push(plain);
    }
    materials.len() - 1
}

/// Counts what the reader will make, before it does, and finds the libraries that it will ask for.
fn survey(text: &str) -> Result<Vec<String>, Error> {
    let (mut triangles, mut libraries) = (0_usize, Vec::new());
    // Of positions, texture coordinates and normals; and the first face that names one.
    let (mut counts, mut named) = ([0_usize; 3], [None; 3]);
    for (line, i) in text.lines().zip(1..) {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => counts[0] += 1,
            Some("vt") => counts[1] += 1,
            Some("vn") => counts[2] += 1,
            Some("f") => {
                for (corner, word) in words.enumerate() {
                    triangles += usize::from(corner > 1);
                    for (part, first) in word.split('/').zip(&mut named) {
                        *first = first.or((!part.is_empty()).then_some(i));
                    }
                }
            }
            Some("o" | "g" | "usemtl") if line.len() > MOST_NAME_BYTES => {
                return Err(Error::refused(format!(
                    "line {i} of the OBJ has {} bytes: names have {MOST_NAME_BYTES} at most",
                    line.len()
                )));
            }
            // As the reader takes it: all that follows the first space is one name.
            Some("mtllib") => libraries.extend(line.split_once(' ').map(|(_, name)| name.trim().to_owned())),
            _ => {}
        }
    }
    // The reader makes as many vertices as corners of triangles at most.
    check_size(triangles, counts.into_iter().max().unwrap_or_default())?;
    // Where a file has none at all, the reader passes over the numbers of those that faces name.
    for (what, count, line) in [
        ("texture coordinates", counts[1], named[1]),
        ("normals", counts[2], named[2]),
    ] {
        if let (0, Some(line)) = (count, line) {
            return Err(Error::refused(format!(
                "line {line} of the OBJ names {what}, and it has none"
            )));
        }
    }
    Ok(libraries)
}

/// One number stands for all three colours, and colours may be told by other means, which count for nothing here. The
/// reader knows but three numbers.
fn whole_colours(text: &str) -> String {
    let whole = |line: &str| {
        let words: Vec<_> = line.split_whitespace().collect();
        match words[..] {
            [name, grey] if COLOURS.contains(&name) => format!("{name} {grey} {grey} {grey}"),
            [name, "spectral" | "xyz", ..] if COLOURS.contains(&name) => String::new(),
            _ => line.to_owned(),
        }
    };
    text.lines().flat_map(|line| [whole(line), "\n".into()]).collect()
}

fn material(
    bundle: &Bundle<'_>,
    library: &str,
    from: tobj::Material,
    textures: &mut Textures,
) -> Result<Material, Error> {
    let plain = plain_material();
    let mut picture = |named: Option<&String>| {
        let Some(name) = named.map(|named| file_name(named)) else {
            return Ok(None);
        };
        let path = beside(library, name)?;
        textures.place(&path, || bundle.read(&path)).map(Some)
    };
    let texture = picture(from.diffuse_texture.as_ref())?;
    let extra = |name: &str| from.unknown_param.get(name);
    let normals = extra("norm").or_else(|| extra("map_Kn"));
    let normal_map = picture(normals.or(from.normal_texture.as_ref()))?;
    if let Some(place) = normal_map.filter(|&place| is_grey(&textures.all[place])) {
        let name = textures.name_of(place);
        return Err(Error::refused(format!(
            "the normal map {} of the material {} is grey: heights are no normals",
            shown(name),
            shown(&from.name)
        )));
    }
    // Models 0 and 1 know no mirror.
    let is_matt = matches!(from.illumination_model, Some(0 | 1));
    Ok(Material {
        albedo: from
            .diffuse
            .unwrap_or(if texture.is_some() { [1.0; 3] } else { plain.albedo }),
        ambient: from.ambient.unwrap_or(plain.ambient),
        diffuse: plain.diffuse,
        specular: from.specular.filter(|_| !is_matt).unwrap_or(plain.specular),
        shininess: from.shininess.unwrap_or(plain.shininess),
        texture,
        normal_map,
    })
}

/// The file's name behind options such as `-bm 0.5` and `-clamp on`.
fn file_name(named: &str) -> &str {
    let mut rest = named.trim();
    while rest.starts_with('-') {
        let Some((_, values)) = rest.split_once(char::is_whitespace) else {
            break;
        };
        rest = values.trim_start();
        let is_value = |word: &str| {
            word.parse::<f32>().is_ok() || matches!(word, "on" | "off" | "r" | "g" | "b" | "m" | "l" | "z")
        };
        while let Some((word, more)) = rest.split_once(char::is_whitespace)
            && is_value(word)
        {
            rest = more.trim_start();
        }
    }
    rest
}
