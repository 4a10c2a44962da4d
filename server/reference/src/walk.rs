//! Backward random walks: from the eye along the light's path to the sun.

use crate::{
    cells::{Cells, Next, Shells},
    medium::Medium,
    phase,
    random::Random,
    single::sunlit_ground,
};
use glam::DVec3;
use std::f64::consts::PI;

/// Share of directions drawn towards the sun as the aerosols' phase function sees it: what the next vertex sends back
/// to the eye has that peak.
const SUN_SHARE: f64 = 0.3;
/// Each draw towards the sun may raise a walk's weight by 1 / (1 - share); over the many turns in haze that would
/// multiply to noise, and only the first ones can still see the sun.
const SUN_TURNS_IN_HAZE: usize = 2;
/// A walk whose weight fell below this share of its first weight plays Russian roulette.
const ROULETTE_BELOW: f64 = 0.3;
/// No walk is longer; with the roulette none comes near.
const MOST_EVENTS: usize = 10_000;
/// Ground bounces whose sums are kept apart.
pub(crate) const BOUNCES: usize = 6;

/// What lights the planet.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Light {
    /// A parallel beam of irradiance 1 from this direction.
    Sun(DVec3),
    /// Radiance 1 from everywhere (a furnace).
    Uniform,
}

/// Sums over walks, per band.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    /// By the number of ground bounces, the last for all higher numbers; for a ground of albedo 1.
    pub(crate) by_bounces: [DVec3; BOUNCES],
    /// Two events alone: scattered twice; once by air and once by a ground of albedo 1.
    pub(crate) second: [DVec3; 2],
    /// For each of the albedos, all bounces.
    pub(crate) by_albedo: Vec<DVec3>,
}

impl Tally {
    /// From sums to means.
    pub(crate) fn divide(&mut self, walks: f64) {
        for sum in self
            .by_bounces
            .iter_mut()
            .chain(&mut self.second)
            .chain(&mut self.by_albedo)
        {
            *sum /= walks;
        }
    }
}

/// The walks of one view.
pub(crate) struct Walker<'a> {
    medium: &'a Medium,
    shells: &'a Shells,
    light: Light,
    /// The ground's albedos for which sums are kept.
    albedos: &'a [f64],
    /// The largest of them, which the walks use.
    albedo: f64,
    /// Events before a walk's light counts.
    skipped: usize,
    cells: Cells,
}

/// Where a walk stands.
#[derive(Clone, Copy)]
pub(crate) struct Vertex {
    /// From the planet's centre, metres.
    pub(crate) point: DVec3,
    /// The way the walk came.
    pub(crate) direction: DVec3,
    /// Radiance that the eye gets per radiance that arrives here, over the walk's density, with the albedos 1.
    pub(crate) weight: DVec3,
    /// Whether it lies on the ground.
    pub(crate) ground: bool,
}

/// A walk's weight per band and its density had each band drawn it; the densities' mean is 1.
struct State {
    vertex: Vertex,
    density: DVec3,
    bounces: i32,
    events: usize,
}

impl<'a> Walker<'a> {
    /// Light counts from the event after `skipped` on, since the first is known without chance.
    pub(crate) fn new(
        medium: &'a Medium,
        shells: &'a Shells,
        light: Light,
        albedos: &'a [f64],
        skipped: usize,
    ) -> Self {
        Self {
            medium,
            shells,
            light,
            albedos,
            albedo: albedos.iter().copied().fold(0.0, f64::max),
            skipped,
            cells: Cells::default(),
        }
    }

    /// Follows one walk from its first vertex to its end. `density` is that vertex's, per band; `band` draws the walk.
    pub(crate) fn walk(
        &mut self,
        first: Vertex,
        density: DVec3,
        band: usize,
        random: &mut Random,
        tally: &mut Tally,
    ) {
        let state = State::new(first, density);
        let first_weight = state.vertex.weight.max_element();
        self.follow(state, first_weight, band, random, tally);
    }

    /// The same from a white plane that only receives: neither an event nor a bounce.
    pub(crate) fn walk_from_plane(
        &mut self,
        plane: Vertex,
        band: usize,
        random: &mut Random,
        tally: &mut Tally,
    ) {
        let mut state = State::new(plane, DVec3::ONE);
        if self.turn(&mut state, band, random) && self.advance(&mut state, band, random, tally) {
            let first_weight = state.vertex.weight.max_element();
            self.follow(state, first_weight, band, random, tally);
        }
    }

    fn follow(
        &mut self,
        mut state: State,
        first_weight: f64,
        band: usize,
        random: &mut Random,
        tally: &mut Tally,
    ) {
        while state.events < MOST_EVENTS && state.vertex.weight.max_element() > 0.0 {
            state.events += 1;
            if state.vertex.ground {
                state.bounces += 1;
                state.vertex.weight *= self.albedo;
            }
            if state.events > self.skipped
                && let Light::Sun(sun) = self.light
            {
                self.count(&state, self.sunlight(&state.vertex, sun), tally);
            }
            let survival = state.vertex.weight.max_element() / (ROULETTE_BELOW * first_weight);
            if survival < 1.0 {
                if random.unit() >= survival {
                    return;
                }
                state.vertex.weight /= survival;
            }
            if !self.turn(&mut state, band, random) || !self.advance(&mut state, band, random, tally) {
                return;
            }
        }
    }

    /// Adds what a walk has found; the ground's albedos are in its weight.
    fn count(&self, state: &State, light: DVec3, tally: &mut Tally) {
        let found = state.vertex.weight * light;
        if found.max_element() <= 0.0 {
            return;
        }
        let relative = |albedo: f64| {
            if state.bounces == 0 {
                1.0
            } else {
                (albedo / self.albedo).powi(state.bounces)
            }
        };
        for (sum, albedo) in tally.by_albedo.iter_mut().zip(self.albedos) {
            *sum += found * relative(*albedo);
        }
        let bounces = usize::try_from(state.bounces).unwrap_or(0);
        tally.by_bounces[bounces.min(BOUNCES - 1)] += found * relative(1.0);
        if state.events == 2 && bounces < 2 {
            tally.second[bounces] += found * relative(1.0);
        }
    }

    /// Radiance towards the walk's last leg that the sun alone causes at a vertex.
    fn sunlight(&self, vertex: &Vertex, sun: DVec3) -> DVec3 {
        if vertex.ground {
            return sunlit_ground(self.medium, vertex.point, sun);
        }
        let Some(sunlight) = self.medium.transmittance_to_space(vertex.point, sun) else {
            return DVec3::ZERO;
        };
        let (molecules, _) = self.shares(vertex.point);
        sunlight * self.phase(molecules, vertex.direction.dot(sun))
    }

    /// Shares of molecules and of aerosols in the scattering at a point.
    fn shares(&self, point: DVec3) -> (DVec3, DVec3) {
        let altitude_m = point.length() - self.medium.ground_radius_m;
        let (molecules, aerosols) = self.medium.scattering_per_m(altitude_m);
        let sum = (molecules + aerosols).max(DVec3::splat(f64::MIN_POSITIVE));
        (molecules / sum, aerosols / sum)
    }

    fn phase(&self, molecules: DVec3, cosine: f64) -> DVec3 {
        let aerosols = phase::cornette_shanks(cosine, self.medium.asymmetry);
        molecules * (phase::rayleigh(cosine) - aerosols) + aerosols
    }

    /// Draws the next direction; false if the light from there cannot count.
    fn turn(&self, state: &mut State, band: usize, random: &mut Random) -> bool {
        let vertex = &mut state.vertex;
        let up = vertex.point.normalize();
        let (molecules, _) = self.shares(vertex.point);
        let g = self.medium.asymmetry;
        let sun = match self.light {
            Light::Sun(sun) => Some(sun),
            Light::Uniform => None,
        };
        let share = if self.medium.haze.is_none() || state.events < SUN_TURNS_IN_HAZE {
            SUN_SHARE
        } else {
            0.0
        };
        let towards_sun = sun.filter(|_| random.unit() < share);
        let (axis, cosine) = if let Some(sun) = towards_sun {
            (sun, phase::sample_cornette_shanks(g, random))
        } else if vertex.ground {
            (up, random.unit().sqrt())
        } else if random.unit() < molecules[band] {
            (vertex.direction, phase::sample_rayleigh(random))
        } else {
            (vertex.direction, phase::sample_cornette_shanks(g, random))
        };
        let next = random.about(axis, cosine);
        let value = if vertex.ground {
            DVec3::splat(up.dot(next).max(0.0) / PI)
        } else {
            self.phase(molecules, vertex.direction.dot(next))
        };
        let density = sun.map_or(value, |sun| {
            let lobe = phase::cornette_shanks(sun.dot(next), g);
            value * (1.0 - share) + DVec3::splat(share * lobe)
        });
        vertex.direction = next;
        vertex.weight *= value;
        state.density *= density;
        state.normalise();
        value.max_element() > 0.0
    }

    /// Goes to the next vertex, which always exists where there is air; the share of light that the air lets through
    /// is in the weight. False if there is none.
    fn advance(&mut self, state: &mut State, band: usize, random: &mut Random, tally: &mut Tally) -> bool {
        let medium = self.medium;
        let Some(span) = medium.span(state.vertex.point, state.vertex.direction) else {
            return false;
        };
        if matches!(self.light, Light::Uniform) && !span.ground && state.events >= self.skipped {
            self.count(
                state,
                medium.transmittance(&span.line, span.start, span.end),
                tally,
            );
        }
        self.cells.cut(self.shells, &span, self.albedo);
        let Some(next) = self.cells.sample(band, random.unit(), random) else {
            return false;
        };
        let vertex = &mut state.vertex;
        match next {
            Next::Air(s, density) => {
                vertex.point = span.line.point(s);
                vertex.ground = false;
                let (molecules, aerosols) =
                    medium.scattering_per_m(vertex.point.length() - medium.ground_radius_m);
                vertex.weight *= (molecules + aerosols) * medium.transmittance(&span.line, span.start, s);
                state.density *= density;
            }
            Next::Ground(probability) => {
                vertex.point = span.line.point(span.end);
                vertex.ground = true;
                vertex.weight *= medium.transmittance(&span.line, span.start, span.end);
                state.density *= probability;
            }
        }
        state.normalise();
        true
    }
}

impl State {
    fn new(vertex: Vertex, density: DVec3) -> Self {
        let mut state = Self {
            vertex,
            density,
            bounces: 0,
            events: 0,
        };
        state.normalise();
        state
    }

    /// The balance heuristic over the bands: a walk's weight is the light over the mean of the densities with which
    /// the bands would have drawn it, whichever band drew it.
    fn normalise(&mut self) {
        let mean = self.density.element_sum() / 3.0;
        self.density /= mean;
        self.vertex.weight /= mean;
    }
}
