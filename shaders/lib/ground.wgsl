// What stands on the planet's sphere. It has a frame of its own, level at its centre on the sphere: x east, y north, z up
// there. A height is measured from the sphere along that z, so that over a place (x, y) the surface lies at
// z = height - (R - √(R² - x² - y²)): curved as the planet is, however wide it is.

struct Ground {
    // The frame's axes in the scene.
    east: vec3f,
    radius_m: f32,
    north: vec3f,
    // Of all heights.
    highest_m: f32,
    up: vec3f,
    lowest_m: f32,
    // The observer in this frame.
    place_m: vec3f,
    // 1/(8R), of how far an arc bends from its chord: c²/(8R).
    bend_per_m: f32,
    // The first vertex, south-west, and from one to the next.
    corner_m: vec2f,
    cell_m: vec2f,
    // Patches between four vertices.
    cells: vec2u,
    // Of the pyramid; the last one is a single node.
    levels: u32,
}

@group(0) @binding(0) var<uniform> ground: Ground;
// Heights in metres, rows from the south and each from the west; or the mesh's triangles.
@group(0) @binding(3) var<storage, read> shape: array<f32>;
// Greatest heights of 2×2 patches, then of 4×4, and so on, level after level; or the nodes of the mesh's tree. As bits: not
// every device keeps whole numbers in floats.
@group(0) @binding(4) var<storage, read> finder: array<u32>;

fn to_ground_frame(v: vec3f) -> vec3f {
    return vec3f(dot(v, ground.east), dot(v, ground.north), dot(v, ground.up));
}

fn from_ground_frame(v: vec3f) -> vec3f {
    return v.x * ground.east + v.y * ground.north + v.z * ground.up;
}

// The sphere's fall below the level of the frame's origin over x² + y², by that: R - √(R² - s) = s / (R + √(R² - s)).
fn fall_share(squared: f32) -> f32 {
    let r = ground.radius_m;
    return 1.0 / (r + sqrt(max(r * r - squared, 0.0)));
}

// Height over the sphere.
fn height_at(p: vec3f) -> f32 {
    let squared = dot(p.xy, p.xy);
    return p.z + squared * fall_share(squared);
}
