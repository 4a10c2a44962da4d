// Shafts are found at a lattice of pixels, and between its places by those around that look as far.
import package::lib::shaft_ray::lost_until;

// What a ray loses to them.
struct Lost {
    // All along it, radiance in R, G, B.
    light: vec3f,
    // Where the ray ends.
    end_m: f32,
    // The stretch that was looked at.
    from_m: f32,
    to_m: f32,
    // Of the light that clear air sends from the stretch's begin up to each eighth of its root, the share that is lost; a byte
    // each.
    first: u32,
    second: u32,
}

// Of what clear air sends from the stretch's begin up to a place, what is lost.
fn lost_of(lost: Lost, sent: vec3f, distance_m: f32) -> vec3f {
    let part = (distance_m - lost.from_m) / max(lost.to_m - lost.from_m, 1.0);
    return lost_until(part, unpack4x8unorm(lost.first), unpack4x8unorm(lost.second), sent, lost.light);
}

// How much a place of the lattice counts for a pixel that lies that many places beside it: a tent over three.
fn lattice_weight(away: vec2f) -> f32 {
    let side = max(1.5 - abs(away), vec2f(0.0));
    return side.x * side.y;
}

// How much it counts for a ray that ends elsewhere: less than a tenth where one ends half as far away again.
fn depth_weight(end_m: f32, other_m: f32) -> f32 {
    let apart = log2(max(end_m, 1.0) / max(other_m, 1.0));
    return 1.0 / (1.0 + 30.0 * apart * apart);
}
