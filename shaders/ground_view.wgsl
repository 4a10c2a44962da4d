// What stands on the ground before every pixel of one tile: how far away, which way it faces, what covers it, and whether
// the sun reaches it.
import package::lib::camera::{Camera, sight_at};
import package::lib::geometry::distance_to_sphere;
import package::lib::ground::{from_ground_frame, ground, height_at, to_ground_frame};
import package::lib::ground_cast::{SHAPE, cast_ground};
import package::lib::ground_light::sun_on_surface;
import package::lib::ground_skin::{Skin, skin_albedo, skin_waves};
import package::lib::heightfield::rise_at;
import package::lib::mesh::mesh_hit;
import package::lib::mesh_skin::{materials, mesh_surface};
import package::lib::seen_ground::{PackedGround, SeenGround, pack_ground};

// As `sight_at` numbers it.
override PROJECTION: u32 = 0u;
// True to look along a list of directions, not through the pixels of a tile.
override LIST: bool = false;

struct Tile {
    origin_px: vec2u,
    size_px: vec2u,
    // From one pixel of the tile to the next in the frame.
    stride_px: u32,
}

// Where the sphere lies.
struct Stand {
    // The observer's zenith.
    up: vec3f,
    altitude_m: f32,
}

@group(0) @binding(5) var<uniform> camera: Camera;
@group(0) @binding(6) var<uniform> tile: Tile;
@group(0) @binding(7) var<uniform> stand: Stand;
@group(0) @binding(8) var<uniform> skin: Skin;
@group(0) @binding(9) var<storage, read> directions: array<vec4f>;
@group(0) @binding(10) var<storage, read_write> seen: array<PackedGround>;

const ENDLESS_M = 1e12;
// Of a field, what lies lower than this is under water: its even edge lies in the water's surface.
const SHORE_M = 0.1;

fn field_at(p: vec3f, pixel_m: f32, distance_m: f32) -> SeenGround {
    let rise = rise_at(p, pixel_m);
    // The sphere falls by p/R on the way.
    let plain = normalize(vec3f(p.xy / ground.radius_m - rise, 1.0));
    let height = height_at(p);
    var albedo = skin_albedo(skin, p.xy, height, plain.z, pixel_m);
    // Stones and tufts, too small for the field.
    let bumps = 0.16 * skin.mottled * vec2f(skin_waves(p.xy, 9.0, 3u, pixel_m), skin_waves(p.yx + 57.0, 9.0, 3u, pixel_m));
    let normal = normalize(plain + vec3f(bumps, 0.0));
    let half = 0.5 * vec2f(ground.cells) * ground.cell_m;
    let inwards = 1.0 - abs(p.xy) / half;
    albedo = mix(skin.sphere, albedo, smoothstep(0.0, max(skin.fade, 1e-3), min(inwards.x, inwards.y)));
    let lit = sun_on_surface(p, plain, pixel_m);
    return SeenGround(distance_m, from_ground_frame(normal), skin.diffuse * albedo, skin.ambient * albedo, skin.specular, skin.shininess, lit, 1.0, false);
}

fn mesh_at(p: vec3f, d: vec3f, pixel_m: f32, distance_m: f32) -> SeenGround {
    let surface = mesh_surface(mesh_hit, d, pixel_m);
    let material = materials[surface.material];
    let lit = sun_on_surface(p, surface.flat_normal, pixel_m);
    return SeenGround(distance_m, from_ground_frame(surface.normal), material.diffuse * surface.albedo, material.ambient * surface.albedo, material.specular, material.shininess, lit, 1.0, false);
}

fn look(direction: vec3f) -> SeenGround {
    let d = to_ground_frame(direction);
    let sphere_m = distance_to_sphere(ground.radius_m, stand.altitude_m, dot(direction, stand.up));
    let end_m = select(ENDLESS_M, sphere_m * 1.00001 + 0.1, sphere_m >= 0.0);
    let t = cast_ground(ground.place_m, d, 0.0, end_m);
    var found: SeenGround;
    found.distance_m = -1.0;
    let pixel_m = camera.pixel_angle * max(t, sphere_m);
    if t >= 0.0 && SHAPE == 2u {
        found = mesh_at(ground.place_m + t * d, d, pixel_m, t);
    } else if t >= 0.0 && (skin.water == 0.0 || height_at(ground.place_m + t * d) > SHORE_M) {
        found = field_at(ground.place_m + t * d, pixel_m, t);
    } else if sphere_m >= 0.0 {
        // Of matt ground only what lies in the shadow; the rest is the sky's.
        let p = ground.place_m + sphere_m * d;
        let normal = normalize(p + vec3f(0.0, 0.0, ground.radius_m));
        let lit = sun_on_surface(p, normal, pixel_m);
        if lit < 1.0 || skin.water == 1.0 {
            found = SeenGround(sphere_m, from_ground_frame(normal), skin.sphere, skin.sphere, 0.0, 1.0, lit, 1.0, skin.water == 1.0);
        }
    }
    return found;
}

@compute @workgroup_size(8, 8)
fn ground_view(@builtin(global_invocation_id) id: vec3u) {
    if LIST {
        if id.x < arrayLength(&directions) && id.y == 0u {
            seen[id.x] = pack_ground(look(directions[id.x].xyz));
        }
        return;
    }
    if any(id.xy >= tile.size_px) {
        return;
    }
    // What lies left of the frame wraps round.
    let pixel = vec2i(tile.origin_px + tile.stride_px * id.xy);
    let sight = sight_at(camera, PROJECTION, vec2f(pixel) + 0.5);
    var found: SeenGround;
    found.distance_m = -1.0;
    if sight.seen {
        found = look(sight.direction);
    }
    seen[id.y * tile.size_px.x + id.x] = pack_ground(found);
}
