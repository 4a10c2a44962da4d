// What covers a mesh: its own normals, textures and materials. Whoever imports from here binds what `lib/mesh.wgsl` names,
// and this.
import package::lib::ground::shape;
import package::lib::mesh::{MeshHit, TRIANGLE_WORDS};
import package::lib::seen_ground::unpack_direction;

struct Material {
    albedo: vec3f,
    diffuse: f32,
    ambient: vec3f,
    specular: f32,
    shininess: f32,
    // Where among the pictures it begins, plus one; 0 for none.
    texture: u32,
    normal_map: u32,
}

// Of each triangle: three normals, three places on the texture, and the material.
@group(0) @binding(11) var<storage, read> attributes: array<u32>;
@group(0) @binding(12) var<storage, read> materials: array<Material>;
// Each picture: width, height, and the texels of it and of ever smaller ones.
@group(0) @binding(13) var<storage, read> pictures: array<u32>;

const ATTRIBUTE_WORDS = 10u;

// A surface as its mesh has it, in the mesh's frame.
struct MeshSurface {
    // As triangles have it, and as light sees it.
    flat_normal: vec3f,
    normal: vec3f,
    albedo: vec3f,
    material: u32,
}

fn texel(first: u32, size: vec2i, at: vec2i) -> vec4f {
    let inside = ((at % size) + size) % size;
    return unpack4x8unorm(pictures[first + u32(inside.y * size.x + inside.x)]);
}

// Bilinear, repeating, in the picture whose texels are about as fine as asked, in texels of the largest.
fn picture_at(picture: u32, uv: vec2f, fineness: f32) -> vec4f {
    var size = vec2i(i32(pictures[picture]), i32(pictures[picture + 1u]));
    var first = picture + 2u;
    for (var wide = fineness; wide > 1.5 && any(size > vec2i(1)); wide *= 0.5) {
        first += u32(size.x * size.y);
        size = max(size / 2, vec2i(1));
    }
    let at = fract(uv) * vec2f(size) - 0.5;
    let corner = vec2i(floor(at));
    let share = at - vec2f(corner);
    let top = mix(texel(first, size, corner), texel(first, size, corner + vec2i(1, 0)), share.x);
    let bottom = mix(texel(first, size, corner + vec2i(0, 1)), texel(first, size, corner + vec2i(1, 1)), share.x);
    return mix(top, bottom, share.y);
}

fn attribute_uv(at: u32) -> vec2f {
    return vec2f(bitcast<f32>(attributes[at]), bitcast<f32>(attributes[at + 1u]));
}

// Where a ray of direction d met the mesh, `pixel_m` wide.
fn mesh_surface(hit: MeshHit, d: vec3f, pixel_m: f32) -> MeshSurface {
    let i = hit.triangle * TRIANGLE_WORDS;
    let e1 = vec3f(shape[i + 3u], shape[i + 4u], shape[i + 5u]);
    let e2 = vec3f(shape[i + 6u], shape[i + 7u], shape[i + 8u]);
    let across = cross(e1, e2);
    let area = length(across);
    // Of either side, that which is seen.
    let side = select(-1.0, 1.0, dot(across, d) < 0.0);
    let flat_normal = side * across / max(area, 1e-30);
    let a = hit.triangle * ATTRIBUTE_WORDS;
    let weights = vec3f(1.0 - hit.share.x - hit.share.y, hit.share);
    let smooth_normal = weights.x * unpack_direction(attributes[a]) + weights.y * unpack_direction(attributes[a + 1u]) + weights.z * unpack_direction(attributes[a + 2u]);
    var normal = normalize(select(flat_normal, smooth_normal, dot(smooth_normal, smooth_normal) > 1e-6));
    normal *= select(-1.0, 1.0, dot(normal, flat_normal) >= 0.0);
    let uv0 = attribute_uv(a + 3u);
    let uv1 = attribute_uv(a + 5u) - uv0;
    let uv2 = attribute_uv(a + 7u) - uv0;
    let uv = uv0 + hit.share.x * uv1 + hit.share.y * uv2;
    let index = attributes[a + 9u];
    let material = materials[index];
    let uv_area = uv1.x * uv2.y - uv1.y * uv2.x;
    let wide = pixel_m / sqrt(max(abs(dot(flat_normal, d)), 0.05));
    let uv_per_m = sqrt(abs(uv_area) / max(area, 1e-30));
    var albedo = material.albedo;
    if material.texture > 0u {
        let picture = material.texture - 1u;
        let size = vec2f(f32(pictures[picture]), f32(pictures[picture + 1u]));
        // Stored as square roots of what is linear.
        let colour = picture_at(picture, uv, wide * uv_per_m * sqrt(size.x * size.y)).rgb;
        albedo *= colour * colour;
    }
    if material.normal_map > 0u && uv_area != 0.0 {
        let picture = material.normal_map - 1u;
        let size = vec2f(f32(pictures[picture]), f32(pictures[picture + 1u]));
        let bump = picture_at(picture, uv, wide * uv_per_m * sqrt(size.x * size.y)).xyz * 2.0 - 1.0;
        // Along which the texture runs to the right, and up: v counts downwards.
        let right = (e1 * uv2.y - e2 * uv1.y) / uv_area;
        let up = -(e2 * uv1.x - e1 * uv2.x) / uv_area;
        let tangent = normalize(right - dot(right, normal) * normal);
        let raised = up - dot(up, normal) * normal;
        let handed = select(-1.0, 1.0, dot(cross(normal, tangent), raised) > 0.0);
        normal = normalize(bump.x * tangent + bump.y * handed * cross(normal, tangent) + max(bump.z, 0.05) * normal);
    }
    return MeshSurface(flat_normal, normal, albedo, index);
}
