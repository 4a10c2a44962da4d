//! What a report says.

use schemars::JsonSchema;
use serde::Serialize;

/// A weather report as it was read. What was not reported is null or empty.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Report {
    /// Location indicator of the station.
    pub station: String,
    /// When it was observed, RFC 3339. Reports tell day and time; month and year are the last that fit.
    pub time: String,
    /// A special report (SPECI).
    pub is_special: bool,
    /// Made without an observer (AUTO).
    pub is_automatic: bool,
    /// It corrects one before (COR, CCA).
    pub is_corrected: bool,
    /// Where the station is.
    pub place: Option<Place>,
    /// Wind.
    pub wind: Option<Wind>,
    /// Prevailing visibility.
    pub visibility: Option<Visibility>,
    /// How far one sees upwards where the sky is hidden, metres; zero where it is hidden and this was not measured.
    pub vertical_visibility_m: Option<f64>,
    /// Weather at the station or near it.
    pub weather: Vec<Weather>,
    /// Layers of cloud.
    pub clouds: Vec<Cloud>,
    /// It says that there are no clouds of note (CAVOK, SKC, CLR, NSC, NCD).
    pub is_clear: bool,
    /// Air temperature, °C.
    pub temperature_c: Option<f64>,
    /// Dew point, °C.
    pub dew_point_c: Option<f64>,
    /// Relative humidity over water, 0 to 1, from both.
    pub relative_humidity: Option<f64>,
    /// Pressure reduced to sea level, hPa.
    pub pressure_hpa: Option<f64>,
    /// The runways are closed by snow.
    pub is_closed_by_snow: bool,
    /// The forecast for the next two hours, as it was written.
    pub trend: Option<String>,
    /// What follows RMK, as it was written.
    pub remarks: Option<String>,
}

/// Where a station is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "ReportedPlace")]
pub struct Place {
    /// North is positive, degrees.
    pub latitude_deg: f64,
    /// East is positive, degrees.
    pub longitude_deg: f64,
    /// Height of the ground above the sea, metres; zero where it is not known.
    pub elevation_m: f64,
}

/// Wind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "ReportedWind")]
pub struct Wind {
    /// Where it blows from, clockwise from north, degrees; null where variable or not observed.
    pub from_azimuth_deg: Option<f64>,
    /// It has no direction.
    pub is_variable: bool,
    /// Mean speed, m/s.
    pub speed_m_s: Option<f64>,
    /// Greatest speed, m/s.
    pub gust_m_s: Option<f64>,
}

/// How far one sees.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "ReportedVisibility")]
pub struct Visibility {
    /// Metres.
    pub distance_m: f64,
    /// Whether it is so far, farther or less far.
    pub bound: Bound,
}

/// What a distance says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "ReportedBound")]
pub enum Bound {
    /// The distance itself.
    Exactly,
    /// That far or farther.
    AtLeast,
    /// Less far.
    LessThan,
}

/// One weather.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "ReportedWeather")]
pub struct Weather {
    /// As it was written.
    pub text: String,
    /// How strong it is.
    pub intensity: Intensity,
    /// It is near the station, not at it.
    pub is_nearby: bool,
    /// MI, BC, PR, DR, BL, SH, TS, FZ.
    pub descriptors: Vec<&'static str>,
    /// Two letters each, as in the report.
    pub phenomena: Vec<&'static str>,
}

/// How strong a weather is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "ReportedIntensity")]
pub enum Intensity {
    /// `-`
    Light,
    /// Without a sign.
    Moderate,
    /// `+`
    Heavy,
}

/// One layer of cloud.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "ReportedCloud")]
pub struct Cloud {
    /// How much of the sky it covers; null where not observed.
    pub amount: Option<Amount>,
    /// Height of its base above the station, metres; null where not observed.
    pub base_m: Option<f64>,
    /// CB, TCU and the like, where it is told.
    pub kind: Option<&'static str>,
}

/// How much of the sky is covered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "ReportedAmount")]
pub enum Amount {
    /// One or two eighths.
    Few,
    /// Three or four.
    Scattered,
    /// Five to seven.
    Broken,
    /// All.
    Overcast,
}
