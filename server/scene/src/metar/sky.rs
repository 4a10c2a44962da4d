//! The clouds that a report tells of: each group becomes a layer, the wind at the ground carries them.

use super::{
    layer::{self, Rain},
    report::{Cloud, Intensity, Report, Weather},
};
use crate::clouds::{Clouds, Gradients, Layer, MAX_LAYERS, Shape, VolumeLayer, Wind};

/// Most that a scene's wind blows, m/s.
const MOST_WIND_M_S: f64 = 100.0;
/// Clouds reach where the wind has carried them, about this long after they began to rise, seconds; at most
/// [`MOST_SHEAR_M`].
const RISE_S: f64 = 60.0;
const MOST_SHEAR_M: f64 = 500.0;

/// What hides a sky without a measured base hangs this high, metres.
const LEAST_BASE_M: f64 = 30.0;
/// Thickness of a layer that hides the sky, metres.
const HIDING_M: f64 = 400.0;

/// Clouds, and what of the report they show.
#[derive(Default)]
pub(super) struct Sky<'a> {
    pub(super) clouds: Option<Clouds>,
    /// Which of the report's clouds are among the layers.
    pub(super) shown: Vec<usize>,
    /// The weather that falls from them.
    pub(super) rain: Option<&'a Weather>,
    pub(super) notes: Vec<String>,
}

/// `is_fogged`: fog is in the scene, which hides the sky by itself.
pub(super) fn sky(report: &Report, is_fogged: bool) -> Sky<'_> {
    let mut notes = Vec::new();
    let hiding = report.vertical_visibility_m.filter(|_| !is_fogged).map(hiding);
    let room = MAX_LAYERS - usize::from(hiding.is_some());
    let placed = report.clouds.iter().enumerate();
    let placed: Vec<_> = placed
        .filter(|(_, cloud)| layer::base_m(cloud).is_some())
        .take(room)
        .collect();
    if placed.is_empty() && hiding.is_none() {
        if !report.is_clear && !is_fogged {
            notes.push("no clouds were reported that have a place: the sky is shown without".into());
        }
        return Sky {
            notes,
            ..Sky::default()
        };
    }
    let falling = rain(report);
    let source = source(report, &placed);
    let mut layers: Vec<Layer> = placed
        .iter()
        .filter_map(|&(i, cloud)| {
            let rain = falling.as_ref().filter(|_| source == Some(i));
            layer::layer(cloud, rain.map(|(rain, _)| rain), report)
        })
        .collect();
    layers.extend(hiding);
    if placed.iter().any(|(_, cloud)| cloud.amount.is_none()) {
        notes
            .push("where the report does not tell how much cloud there is, it is taken for scattered".into());
    }
    notes.push("thickness and shape of clouds are typical of their height and amount".into());
    let coverage = layers.iter().filter_map(Layer::coverage).fold(0.0, f64::max);
    let clouds = Clouds {
        coverage,
        precipitation: falling.as_ref().map_or(0.0, |(rain, _)| rain.amount),
        seed: seed(&report.station),
        layers,
        shape: Shape {
            gradients: Gradients::filling(),
            ..Shape::default()
        },
        wind: wind(report),
        ..Clouds::default()
    };
    Sky {
        clouds: Some(clouds),
        shown: placed.iter().map(|(i, _)| *i).collect(),
        rain: falling.map(|(_, weather)| weather),
        notes,
    }
}

/// The sky is hidden from the height that one sees up to.
fn hiding(visibility_m: f64) -> Layer {
    let base_m = visibility_m.max(LEAST_BASE_M);
    Layer::Volume(VolumeLayer {
        base_m,
        top_m: base_m + HIDING_M,
        cloud_type: Some(0.0),
        coverage: Some(1.0),
        ..VolumeLayer::default()
    })
}

/// The strongest of what falls at the station.
fn rain(report: &Report) -> Option<(Rain, &Weather)> {
    const FALLING: [&str; 9] = ["DZ", "RA", "SN", "SG", "PL", "PE", "GR", "GS", "UP"];
    let is_blown = |weather: &Weather| weather.descriptors.iter().any(|d| matches!(*d, "BL" | "DR"));
    let falls = |weather: &&Weather| {
        !weather.is_nearby && !is_blown(weather) && weather.phenomena.iter().any(|p| FALLING.contains(p))
    };
    let amount = |weather: &Weather| match weather.intensity {
        Intensity::Light => 0.3,
        Intensity::Moderate => 0.6,
        Intensity::Heavy => 1.0,
    };
    let here = report.weather.iter().filter(falls);
    let weather = here.reduce(|a, b| if amount(b) > amount(a) { b } else { a })?;
    let rain = Rain {
        amount: amount(weather),
        is_shower: weather.descriptors.iter().any(|d| matches!(*d, "SH" | "TS")),
        is_drizzle: weather
            .phenomena
            .iter()
            .all(|p| matches!(*p, "DZ" | "SG" | "BR" | "FG")),
    };
    Some((rain, weather))
}

/// The cloud that rain falls from: a thundercloud, else the lowest that covers more than half of the sky, else the
/// lowest.
fn source(report: &Report, placed: &[(usize, &Cloud)]) -> Option<usize> {
    let lowest = |is_it: &dyn Fn(&Cloud) -> bool| {
        let those = placed.iter().filter(|(_, cloud)| is_it(cloud));
        let height = |cloud: &Cloud| layer::base_m(cloud).unwrap_or(f64::INFINITY);
        those
            .min_by(|a, b| height(a.1).total_cmp(&height(b.1)))
            .map(|(i, _)| *i)
    };
    if report.vertical_visibility_m.is_some() {
        return None;
    }
    lowest(&|cloud| cloud.kind == Some("CB"))
        .or_else(|| lowest(&layer::is_closed))
        .or_else(|| lowest(&|_| true))
}

fn wind(report: &Report) -> Wind {
    let usual = Wind::default();
    let told = report.wind;
    let Some(speed_m_s) = told.and_then(|wind| wind.speed_m_s) else {
        return usual;
    };
    let speed_m_s = speed_m_s.min(MOST_WIND_M_S);
    Wind {
        speed_m_s,
        azimuth_deg: told
            .and_then(|wind| wind.from_azimuth_deg)
            .unwrap_or(usual.azimuth_deg),
        shear_m: (speed_m_s * RISE_S).min(MOST_SHEAR_M),
        ..usual
    }
}

/// Each station has a sky of its own, which stays from report to report (FNV-1a of its indicator).
fn seed(station: &str) -> u32 {
    station.bytes().fold(0x811c_9dc5, |hash: u32, byte| {
        (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)
    })
}
