//! Straight lines past a sphere, by the distance of their nearest point and the way `s` from there.

use glam::DVec3;

/// A line. Points on it lie at `nearest + s * direction`, their radius is √(p² + s²); s in metres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    /// The point nearest to the planet's centre.
    pub(crate) nearest: DVec3,
    /// Unit vector.
    pub(crate) direction: DVec3,
    /// Its distance from the centre, squared.
    pub(crate) p2: f64,
}

/// The part of a ray that lies in the air.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    /// The line.
    pub(crate) line: Line,
    /// s where the ray starts or enters the air.
    pub(crate) start: f64,
    /// s where it hits the ground or leaves the air.
    pub(crate) end: f64,
    /// Whether it ends on the ground.
    pub(crate) ground: bool,
}

impl Line {
    /// The line through a point, and the point's s.
    pub(crate) fn through(point: DVec3, direction: DVec3) -> (Self, f64) {
        let s = point.dot(direction);
        let nearest = point - direction * s;
        let line = Self {
            nearest,
            direction,
            p2: nearest.length_squared(),
        };
        (line, s)
    }

    /// Distance from the planet's centre.
    pub(crate) fn radius(&self, s: f64) -> f64 {
        (self.p2 + s * s).sqrt()
    }

    /// The point itself.
    pub(crate) fn point(&self, s: f64) -> DVec3 {
        self.nearest + self.direction * s
    }

    /// The s ≥ 0 at which the line leaves a sphere; 0 if it never enters it.
    pub(crate) fn reach(&self, radius: f64) -> f64 {
        (radius * radius - self.p2).max(0.0).sqrt()
    }
}

impl Span {
    /// What a ray from `point` sees of a shell of air; none if it misses the air.
    pub(crate) fn of_ray(
        point: DVec3,
        direction: DVec3,
        ground_radius_m: f64,
        top_radius_m: f64,
    ) -> Option<Self> {
        let (line, s) = Line::through(point, direction);
        let top = line.reach(top_radius_m);
        let start = s.max(-top);
        let ground = s < 0.0 && line.p2 < ground_radius_m * ground_radius_m;
        // A point on the ground may lie a rounding error below it.
        let end = if ground {
            start.max(-line.reach(ground_radius_m))
        } else {
            top
        };
        (start <= end && top > 0.0).then_some(Self {
            line,
            start,
            end,
            ground,
        })
    }
}
