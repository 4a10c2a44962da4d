//! From the sphere of the stars to the observer's horizon.

use crate::{
    document::Scene,
    solar::{PRESSURE_HPA, TEMPERATURE_C, later, moment},
    stars::{Orientation, Stars},
    sun::{SunPosition, TimeAndPlace},
};
use astro::{ecliptic, nutation, time};
use chrono::{DateTime, Utc};
use solar_positioning::delta_t;

/// Rows of a rotation: what each gives is the dot product with the vector.
pub(crate) type Rotation = [[f64; 3]; 3];

/// Obliquity of the ecliptic at J2000 (Laskar 1986), degrees.
const OBLIQUITY_J2000_DEG: f64 = 23.439_291;

/// A moment on the two scales that astronomy counts by, Julian days.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Epoch {
    /// Universal time, by which the Earth turns.
    pub(crate) universal: f64,
    /// Terrestrial time, by which the moon runs.
    pub(crate) terrestrial: f64,
}

impl Epoch {
    fn new(moment: &DateTime<Utc>) -> Option<Self> {
        const UNIX_EPOCH: f64 = 2_440_587.5;
        const DAY_S: f64 = 86_400.0;
        #[allow(
            clippy::cast_precision_loss,
            reason = "milliseconds of a few centuries are exact in f64"
        )]
        let universal = UNIX_EPOCH + moment.timestamp_millis() as f64 / (1e3 * DAY_S);
        let terrestrial = universal + delta_t::estimate_from_date_like(moment).ok()? / DAY_S;
        Some(Self {
            universal,
            terrestrial,
        })
    }

    /// True obliquity and nutation in longitude, radians.
    pub(crate) fn obliquity_and_nutation(self) -> (f64, f64) {
        let (in_longitude, in_obliquity) = nutation::nutation(self.terrestrial);
        (
            ecliptic::mn_oblq_IAU(self.terrestrial) + in_obliquity,
            in_longitude,
        )
    }

    /// Apparent sidereal time at a longitude (east positive), radians.
    pub(crate) fn sidereal(self, longitude_deg: f64) -> f64 {
        let (obliquity, in_longitude) = self.obliquity_and_nutation();
        time::mn_sidr(self.universal) + in_longitude * obliquity.cos() + longitude_deg.to_radians()
    }

    /// From the equator and equinox of J2000 to those of the date (Lieske 1977).
    fn precession(self) -> Rotation {
        let t = (self.terrestrial - 2_451_545.0) / 36_525.0;
        let angle = |a: f64, b: f64, c: f64| (t * (a + t * (b + t * c)) / 3600.0).to_radians();
        let zeta = angle(2306.2181, 0.30188, 0.017_998);
        let z = angle(2306.2181, 1.09468, 0.018_203);
        let theta = angle(2004.3109, -0.42665, -0.041_833);
        let about_z = |a: f64| [[a.cos(), -a.sin(), 0.0], [a.sin(), a.cos(), 0.0], [0.0, 0.0, 1.0]];
        let about_y = [
            [theta.cos(), 0.0, -theta.sin()],
            [0.0, 1.0, 0.0],
            [theta.sin(), 0.0, theta.cos()],
        ];
        multiply(&about_z(z), &multiply(&about_y, &about_z(zeta)))
    }
}

impl TimeAndPlace {
    /// The moment, `time_s` later.
    pub(crate) fn epoch(&self, time_s: f64) -> Option<Epoch> {
        Epoch::new(&later(moment(&self.time)?, time_s)?)
    }
}

/// The sphere of stars over the observer's horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Firmament {
    /// Rows: east, north, up in the equatorial frame of J2000, whose x points to the equinox and z to the north pole.
    pub rows: [[f64; 3]; 3],
    /// True where the air lifts stars near the horizon.
    pub refraction: bool,
}

impl Firmament {
    /// Unit vector in the world frame, of right ascension and declination (J2000), degrees. Proper motion, nutation
    /// and aberration are left out: at most 0.02° for a bright star in this century.
    #[must_use]
    pub fn direction(&self, right_ascension_deg: f64, declination_deg: f64) -> [f64; 3] {
        let (sin_ra, cos_ra) = right_ascension_deg.to_radians().sin_cos();
        let (sin_dec, cos_dec) = declination_deg.to_radians().sin_cos();
        let at = apply(&self.rows, [cos_dec * cos_ra, cos_dec * sin_ra, sin_dec]);
        if self.refraction { lifted(at) } else { at }
    }

    /// The ecliptic's north pole in the world frame, within 1.6° of the moon's axis (Cassini).
    pub(crate) fn ecliptic_pole(&self) -> [f64; 3] {
        let (sin, cos) = OBLIQUITY_J2000_DEG.to_radians().sin_cos();
        apply(&self.rows, [0.0, -sin, cos])
    }
}

impl Scene {
    /// How the stars stand: as the scene says, or as they do at the sun's time and place.
    #[must_use]
    pub fn firmament(&self) -> Firmament {
        let said = self
            .stars
            .as_ref()
            .and_then(|Stars { orientation, .. }| *orientation);
        if let (None, SunPosition::TimeAndPlace(place)) = (said, &self.sun.position)
            && let Some(epoch) = place.epoch(self.time_s)
        {
            let turn = horizon(
                place.latitude_deg.to_radians(),
                epoch.sidereal(place.longitude_deg),
            );
            return Firmament {
                rows: multiply(&turn, &epoch.precession()),
                refraction: place.refraction,
            };
        }
        let Orientation {
            latitude_deg,
            sidereal_time_deg,
        } = said.unwrap_or_default();
        Firmament {
            rows: horizon(latitude_deg.to_radians(), sidereal_time_deg.to_radians()),
            refraction: false,
        }
    }
}

/// East, north and up at a latitude, in the equatorial frame turned by the sidereal time.
pub(crate) fn horizon(latitude: f64, sidereal: f64) -> Rotation {
    let (sin_lat, cos_lat) = latitude.sin_cos();
    let (sin, cos) = sidereal.sin_cos();
    [
        [-sin, cos, 0.0],
        [-sin_lat * cos, -sin_lat * sin, cos_lat],
        [cos_lat * cos, cos_lat * sin, sin_lat],
    ]
}

pub(crate) fn apply(rows: &Rotation, v: [f64; 3]) -> [f64; 3] {
    rows.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

fn multiply(a: &Rotation, b: &Rotation) -> Rotation {
    a.map(|row| [0, 1, 2].map(|j| row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j]))
}

/// A unit vector lifted by refraction in the air that also lifts the sun (Saemundsson 1986): 1.02' / tan(e + 10.3 /
/// (e + 5.11)) with the true elevation e in degrees. Farther below the horizon than it can lift, nothing is.
pub(crate) fn lifted(at: [f64; 3]) -> [f64; 3] {
    const LOWEST_DEG: f64 = -0.8333;
    let [x, y, z] = at;
    let across = x.hypot(y);
    let true_deg = z.atan2(across).to_degrees();
    if true_deg < LOWEST_DEG || across == 0.0 {
        return at;
    }
    let density = PRESSURE_HPA / 1010.0 * 283.0 / (273.0 + TEMPERATURE_C);
    let bent = (true_deg + 10.3 / (true_deg + 5.11)).to_radians();
    let elevation = (true_deg + density * 1.02 / 60.0 / bent.tan()).to_radians();
    let stretch = elevation.cos() / across;
    [x * stretch, y * stretch, elevation.sin()]
}
