//! Twin of `lib/mesh.wgsl`: every triangle, one after the other.

use glam::DVec3;

/// The way to the first triangle that a ray meets (Badouel 1990: first the plane, then the three edges).
pub(crate) fn cast(triangles: &[[DVec3; 3]], p: DVec3, d: DVec3) -> Option<f64> {
    let met = triangles.iter().filter_map(|[a, b, c]| {
        let normal = (b - a).cross(c - a);
        let t = (a - p).dot(normal) / d.dot(normal);
        let at = p + t * d;
        let inside = [(a, b), (b, c), (c, a)]
            .into_iter()
            .all(|(from, to)| (to - from).cross(at - from).dot(normal) >= 0.0);
        (t > 0.0 && t.is_finite() && inside).then_some(t)
    });
    met.min_by(f64::total_cmp)
}
