// Rays against whatever stands on the ground.
import package::lib::heightfield::cast_heightfield;
import package::lib::mesh::cast_mesh;

// 0: nothing; 1: a heightfield; 2: a mesh.
override SHAPE: u32 = 1u;

// The way to the first surface between two ways, or -1. In the ground's frame.
fn cast_ground(p: vec3f, d: vec3f, from_m: f32, to_m: f32) -> f32 {
    if SHAPE == 1u {
        return cast_heightfield(p, d, from_m, to_m);
    }
    if SHAPE == 2u {
        return cast_mesh(p, d, from_m, to_m);
    }
    return -1.0;
}
