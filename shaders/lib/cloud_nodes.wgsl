// What a ray sees of clouds, without their light: up to eight places, so that under another sun no ray is followed again.

struct FourNodes {
    // Metres along the ray.
    distance_m: vec4f,
    // Of all that is seen.
    share: vec4f,
    // Number of the band, or 8 and more of the sheet, plus e/(1+e) of the band's extinction e in 1/m.
    kind: vec4f,
}

struct Nodes {
    first: FourNodes,
    second: FourNodes,
}

const NODES = 8u;

// One cloud's first and last light differ: a place stands for no more than this share.
override NODE_SHARE: f32 = 0.25;

// `at` is 4 or more where the place is not among these. One that is not fresh joins what is there.
fn with_one(nodes: FourNodes, at: u32, fresh: bool, distance_m: f32, share: f32, kind: f32) -> FourNodes {
    let here = vec4u(0u, 1u, 2u, 3u) == vec4u(at);
    let part = select(share / max(nodes.share + share, vec4f(1e-9)), vec4f(1.0), vec4<bool>(fresh));
    // The larger share decides: halfway between two clouds there may be sun.
    let decides = here & (part > vec4f(0.5));
    return FourNodes(
        select(nodes.distance_m, vec4f(distance_m), decides),
        nodes.share + select(vec4f(0.0), vec4f(share), here),
        select(nodes.kind, vec4f(kind), decides),
    );
}

// With a further place, farther than the others; the last one stands for all that there is no room for.
fn with_node(nodes: Nodes, count: u32, distance_m: f32, share: f32, index: u32, extinction_per_m: f32) -> Nodes {
    let at = min(count, NODES - 1u);
    let kind = f32(index) + extinction_per_m / (1.0 + extinction_per_m);
    let fresh = count < NODES;
    return Nodes(
        with_one(nodes.first, at, fresh, distance_m, share, kind),
        with_one(nodes.second, at - 4u, fresh, distance_m, share, kind),
    );
}
