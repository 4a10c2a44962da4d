//! Means and standard errors of many walks.

use crate::{
    cells::{Cells, Next, Shells},
    line::Span,
    medium::Medium,
    random::Random,
    single::{single_scattering, sunlit_ground},
    walk::{Light, Tally, Vertex, Walker},
};
use glam::DVec3;
use std::f64::consts::PI;

/// Batches before the error is trusted: the error of a standard error from n batches is 1/√(2n) of it, here 9 %.
const FEWEST_BATCHES: usize = 60;
/// Shells per factor e of density: coarse for the legs of a walk, fine for its first leg, which is cut only once.
const SHELLS: f64 = 1.5;
const FIRST_SHELLS: f64 = 16.0;

/// Who looks where, under which sun. Azimuths are the view's less the sun's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Observer's height above the ground, metres.
    pub altitude_m: f64,
    /// Sun from the observer's zenith, degrees.
    pub sun_zenith_deg: f64,
    /// View from the zenith, degrees.
    pub view_zenith_deg: f64,
    /// View's azimuth from the sun's, degrees.
    pub view_azimuth_deg: f64,
}

/// How much work goes into an estimate.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Walks in a batch that each of the three bands draws.
    pub batch: u32,
    /// Stop when the standard error of every total is below this share of the total.
    pub relative_error: f64,
    /// Stop here at the latest.
    pub most_batches: usize,
    /// The same seed gives the same numbers.
    pub seed: u64,
}

/// A mean and its standard error, per band.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Figure {
    /// Mean.
    pub mean: DVec3,
    /// One standard error.
    pub stderr: DVec3,
}

/// Radiance along one view, per unit of the sun's irradiance, 1/sr.
#[derive(Clone, Debug)]
pub struct Radiance {
    /// Distance to the ground, metres, where the view hits it.
    pub distance_m: Option<f64>,
    /// Transmittance to the ground or to space.
    pub transmittance: DVec3,
    /// Scattered once in the air.
    pub single: DVec3,
    /// A sunlit ground of albedo 1 behind the air.
    pub ground: DVec3,
    /// Two events: scattered twice; once by air and once by a ground of albedo 1, in either order.
    pub second: [Figure; 2],
    /// Coefficient of the albedo's k-th power; the last holds all higher ones at albedo 1.
    pub bounces: Vec<DVec3>,
    /// All light, for each albedo asked for.
    pub totals: Vec<Figure>,
    /// Walks.
    pub walks: u64,
}

impl View {
    fn direction(zenith_deg: f64, azimuth_deg: f64) -> DVec3 {
        let (sin_zenith, cos_zenith) = zenith_deg.to_radians().sin_cos();
        let (sin_azimuth, cos_azimuth) = azimuth_deg.to_radians().sin_cos();
        DVec3::new(sin_zenith * cos_azimuth, sin_zenith * sin_azimuth, cos_zenith)
    }

    /// Unit vector to the sun; the observer is on the z axis.
    pub fn sun(&self) -> DVec3 {
        Self::direction(self.sun_zenith_deg, 0.0)
    }

    /// What the view sees of the air.
    pub(crate) fn span(&self, medium: &Medium) -> Option<Span> {
        let eye = DVec3::Z * (medium.ground_radius_m + self.altitude_m);
        let direction = Self::direction(self.view_zenith_deg, self.view_azimuth_deg);
        medium.span(eye, direction)
    }

    /// Metres from the eye to a place on the view's line.
    fn distance_m(&self, medium: &Medium, span: &Span) -> f64 {
        let eye = span.line.direction.z * (medium.ground_radius_m + self.altitude_m);
        span.end - eye
    }
}

/// The radiance of a view, for grey grounds of several albedos; none if it misses the air.
pub fn radiance(medium: &Medium, view: &View, albedos: &[f64], effort: &Effort) -> Option<Radiance> {
    let span = view.span(medium)?;
    let sun = view.sun();
    let transmittance = medium.transmittance(&span.line, span.start, span.end);
    let single = single_scattering(medium, &span, sun);
    let ground = if span.ground {
        sunlit_ground(medium, span.line.point(span.end), sun) * transmittance
    } else {
        DVec3::ZERO
    };
    let exact: Vec<DVec3> = albedos.iter().map(|albedo| single + ground * *albedo).collect();
    let rest = rest(medium, &span, Light::Sun(sun), albedos, effort, &exact);
    let mut bounces = rest.figures(|tally| tally.by_bounces.to_vec());
    bounces[1].mean += ground;
    let second = rest.figures(|tally| tally.second.to_vec());
    let totals = rest.figures(|tally| tally.by_albedo.clone());
    Some(Radiance {
        distance_m: span.ground.then(|| view.distance_m(medium, &span)),
        transmittance,
        single,
        ground,
        second: [second[0], second[1]],
        bounces: bounces.iter().map(|figure| figure.mean).collect(),
        totals: totals
            .iter()
            .zip(exact)
            .map(|(figure, exact)| Figure {
                mean: figure.mean + exact,
                stderr: figure.stderr,
            })
            .collect(),
        walks: rest.walks,
    })
}

/// The radiance of a view into a furnace, where radiance 1 comes from everywhere; all orders of it.
pub fn furnace(medium: &Medium, view: &View, albedo: f64, effort: &Effort) -> Option<Figure> {
    let span = view.span(medium)?;
    let exact = if span.ground {
        DVec3::ZERO
    } else {
        medium.transmittance(&span.line, span.start, span.end)
    };
    let rest = rest(medium, &span, Light::Uniform, &[albedo], effort, &[exact]);
    let figure = rest.figures(|tally| tally.by_albedo.clone())[0];
    Some(Figure {
        mean: figure.mean + exact,
        stderr: figure.stderr,
    })
}

/// Irradiance of the sky on a horizontal plane that looks up, for each albedo, per unit of the sun's irradiance.
/// The sun itself is not in it.
pub fn diffuse_irradiance(medium: &Medium, view: &View, albedos: &[f64], effort: &Effort) -> Vec<Figure> {
    // A ground of albedo π at the observer, whose radiance is the irradiance.
    let plane = Vertex {
        point: DVec3::Z * (medium.ground_radius_m + view.altitude_m),
        direction: -DVec3::Z,
        weight: DVec3::splat(PI),
        ground: true,
    };
    let shells = Shells::new(medium, SHELLS);
    let mut walker = Walker::new(medium, &shells, Light::Sun(view.sun()), albedos, 0);
    let zero = vec![DVec3::ZERO; albedos.len()];
    let batches = Batches::gather(effort, &zero, |random, tally| {
        for (_, band) in draws(effort) {
            walker.walk_from_plane(plane, band, random, tally);
        }
    });
    batches.figures(|tally| tally.by_albedo.clone())
}

/// Everything that is left to chance: walks from places in the air along the view and, where it sees the ground, as
/// many from there.
fn rest(
    medium: &Medium,
    span: &Span,
    light: Light,
    albedos: &[f64],
    effort: &Effort,
    exact: &[DVec3],
) -> Batches {
    let shells = Shells::new(medium, SHELLS);
    let mut first_leg = Cells::default();
    first_leg.cut(&Shells::new(medium, FIRST_SHELLS), span, 0.0);
    let skipped = match light {
        Light::Sun(_) => 1,
        Light::Uniform => 0,
    };
    let mut walker = Walker::new(medium, &shells, light, albedos, skipped);
    let ground = Vertex {
        point: span.line.point(span.end),
        direction: span.line.direction,
        weight: medium.transmittance(&span.line, span.start, span.end),
        ground: true,
    };
    Batches::gather(effort, exact, |random, tally| {
        for (draw, band) in draws(effort) {
            // One in each of as many equal shares of the view.
            let u = (f64::from(draw) + random.unit()) / f64::from(effort.batch);
            if let Some(Next::Air(s, density)) = first_leg.sample(band, u, random) {
                let point = span.line.point(s);
                let (molecules, aerosols) = medium.scattering_per_m(point.length() - medium.ground_radius_m);
                let first = Vertex {
                    point,
                    direction: span.line.direction,
                    weight: (molecules + aerosols) * medium.transmittance(&span.line, span.start, s),
                    ground: false,
                };
                walker.walk(first, density, band, random, tally);
            }
            if span.ground {
                walker.walk(ground, DVec3::ONE, band, random, tally);
            }
        }
    })
}

/// A batch's walks: as many for each band.
fn draws(effort: &Effort) -> impl Iterator<Item = (u32, usize)> {
    (0..effort.batch).flat_map(|draw| (0..3).map(move |band| (draw, band)))
}

/// The means of equally large batches.
struct Batches {
    means: Vec<Tally>,
    walks: u64,
}

impl Batches {
    /// Runs batches until the errors are small beside the totals, to which `exact` belongs.
    fn gather(effort: &Effort, exact: &[DVec3], mut run: impl FnMut(&mut Random, &mut Tally)) -> Self {
        let mut batches = Self {
            means: Vec::new(),
            walks: 0,
        };
        let mut stream = 0;
        while batches.means.len() < effort.most_batches {
            let mut tally = Tally {
                by_albedo: vec![DVec3::ZERO; exact.len()],
                ..Tally::default()
            };
            run(&mut Random::new(effort.seed, stream), &mut tally);
            tally.divide(3.0 * f64::from(effort.batch));
            batches.means.push(tally);
            batches.walks += 3 * u64::from(effort.batch);
            stream += 1;
            // Looked at seldom: stopping at a lucky moment would make the errors look smaller than they are.
            if batches.means.len().is_multiple_of(FEWEST_BATCHES) && batches.good(effort, exact) {
                break;
            }
        }
        batches
    }

    fn good(&self, effort: &Effort, exact: &[DVec3]) -> bool {
        let rest = self.figures(|tally| tally.by_albedo.clone());
        rest.iter().zip(exact).all(|(figure, exact)| {
            let allowed = (figure.mean + *exact) * effort.relative_error;
            figure.stderr.cmple(allowed).all()
        })
    }

    /// Mean and standard error of some of a tally's sums.
    fn figures(&self, pick: impl Fn(&Tally) -> Vec<DVec3>) -> Vec<Figure> {
        let picked: Vec<Vec<DVec3>> = self.means.iter().map(pick).collect();
        let n = picked.len() as f64;
        let sums = 0..picked.first().map_or(0, Vec::len);
        sums.map(|i| {
            let mean = picked.iter().map(|sums| sums[i]).sum::<DVec3>() / n;
            let squares: DVec3 = picked.iter().map(|sums| (sums[i] - mean).powf(2.0)).sum();
            Figure {
                mean,
                stderr: (squares / (n * (n - 1.0))).powf(0.5),
            }
        })
        .collect()
    }
}
