//! Links every shader with its imports, validates it, and writes what the renderer needs to know of it: the text, the
//! size of its workgroup and its bindings. So the Rust side restates nothing, and a broken shader breaks the build.

use naga::{
    AddressSpace, ImageClass, ImageDimension, StorageAccess, StorageFormat, TypeInner,
    valid::{Capabilities, ValidationFlags, Validator},
};
use std::{error::Error, fmt::Write as _, fs, path::Path};
use wesl::{ManglerKind, Wesl};

fn main() -> Result<(), Box<dyn Error>> {
    // From the package, where Cargo runs this: a path kept from another checkout would be that one's.
    let folder = Path::new("../../shaders");
    println!("cargo:rerun-if-changed={}", folder.display());
    let mut names: Vec<String> = fs::read_dir(folder)?
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter_map(|file| file.strip_suffix(".wgsl").map(str::to_owned))
        .collect();
    names.sort();
    let mut linker = Wesl::new(folder);
    linker.set_mangler(ManglerKind::None).use_sourcemap(false);
    let mut code = String::new();
    for name in &names {
        let path = format!("package::{name}").parse()?;
        let text = linker
            .compile(&path)
            .map_err(|e| format!("{name}.wgsl: {e}"))?
            .to_string();
        writeln!(code, "{}", describe(name, &text)?)?;
    }
    fs::write(Path::new(&std::env::var("OUT_DIR")?).join("shaders.rs"), code)?;
    Ok(())
}

/// One `pub(crate) static NAME: Shader`.
fn describe(name: &str, text: &str) -> Result<String, Box<dyn Error>> {
    let module =
        naga::front::wgsl::parse_str(text).map_err(|e| format!("{name}: {}", e.emit_to_string(text)))?;
    Validator::new(ValidationFlags::all(), Capabilities::default())
        .validate(&module)
        .map_err(|e| format!("{name}: {}", e.emit_to_string(text)))?;
    let [entry] = module.entry_points.as_slice() else {
        return Err(format!("{name}.wgsl must have one entry point").into());
    };
    if entry.name != name {
        return Err(format!("{name}.wgsl: the entry point is named {}", entry.name).into());
    }
    let mut bindings = Vec::new();
    for (_, variable) in module.global_variables.iter() {
        if let Some(place) = &variable.binding {
            let inner = &module.types[variable.ty].inner;
            bindings.push((
                place.binding,
                binding(&variable.space, inner).ok_or("a binding of an unknown kind")?,
            ));
        }
    }
    bindings.sort_unstable();
    if bindings
        .iter()
        .enumerate()
        .any(|(i, (at, _))| u32::try_from(i) != Ok(*at))
    {
        return Err(format!("{name}.wgsl: bindings must run from 0 without gaps").into());
    }
    let kinds: Vec<&str> = bindings.iter().map(|(_, kind)| kind.as_str()).collect();
    Ok(format!(
        "pub(crate) static {}: Shader = Shader {{ name: {name:?}, wgsl: {text:?}, workgroup: {:?}, bindings: &[{}] }};",
        name.to_uppercase(),
        entry.workgroup_size,
        kinds.join(", "),
    ))
}

fn binding(space: &AddressSpace, inner: &TypeInner) -> Option<String> {
    let TypeInner::Image { dim, arrayed, class } = inner else {
        return Some(
            match (space, inner) {
                (AddressSpace::Uniform, _) => "Kind::Uniform",
                (AddressSpace::Storage { access }, _) if access.contains(StorageAccess::STORE) => {
                    "Kind::Write"
                }
                (AddressSpace::Storage { .. }, _) => "Kind::Read",
                (_, TypeInner::Sampler { .. }) => "Kind::Sampler",
                _ => return None,
            }
            .to_owned(),
        );
    };
    let shape = match (dim, arrayed) {
        (ImageDimension::D2, false) => "Table",
        (ImageDimension::D2, true) => "TableLayers",
        (ImageDimension::D3, false) => "Volume",
        _ => return None,
    };
    Some(match class {
        ImageClass::Sampled { .. } => format!("Kind::{shape}"),
        ImageClass::Storage { format, .. } => match format {
            StorageFormat::Rgba32Float => format!("Kind::Write{shape}(Texel::Float)"),
            StorageFormat::R32Float => format!("Kind::Write{shape}(Texel::Single)"),
            StorageFormat::Rgba8Unorm => format!("Kind::Write{shape}(Texel::Byte)"),
            _ => return None,
        },
        _ => return None,
    })
}
