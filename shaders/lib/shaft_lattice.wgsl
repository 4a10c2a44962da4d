// Shafts are found at a lattice of pixels, and between its places by those around that look as far.

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
