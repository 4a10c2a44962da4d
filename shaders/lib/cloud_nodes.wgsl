// What a ray sees of clouds, without their light: up to four places, so that under another sun no ray is followed again.

struct Nodes {
    // Metres along the ray.
    distance_m: vec4f,
    // Of all that is seen.
    share: vec4f,
    // Number of the band, or 8 and more of the sheet, plus e/(1+e) of the band's extinction e in 1/m.
    kind: vec4f,
}

// One cloud's first and last light differ: a place stands for no more than this share.
const NODE_SHARE = 0.3;

fn at_index(k: u32) -> vec4<bool> {
    return vec4u(0u, 1u, 2u, 3u) == vec4u(k);
}

// With a further place; where there is no room, what is farther counts to the last one.
fn with_node(nodes: Nodes, count: u32, distance_m: f32, share: f32, index: u32, extinction_per_m: f32) -> Nodes {
    let here = at_index(min(count, 3u));
    let kind = f32(index) + extinction_per_m / (1.0 + extinction_per_m);
    let fresh = here & vec4<bool>(count < 4u);
    return Nodes(
        select(nodes.distance_m, vec4f(distance_m), fresh),
        nodes.share + select(vec4f(0.0), vec4f(share), here),
        select(nodes.kind, vec4f(kind), fresh),
    );
}
