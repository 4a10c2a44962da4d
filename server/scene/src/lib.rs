//! The vocabulary of Welkin: the scene document, what may be asked of a renderer, and what it answers.
//!
//! Types here carry user units, named in the field (`_m`, `_deg`, `_per_m`). Nothing here knows of a GPU or of HTTP.
//!
//! World frame: x east, y north, z up, metres, origin on the ground below the observer's home. Azimuths are
//! clockwise from north, elevations up from the horizon.

pub mod airglow;
pub mod assets;
pub mod atmosphere;
pub mod bands;
pub mod camera;
pub mod celestial;
mod check;
pub mod clouds;
pub mod direction;
pub mod display;
pub mod document;
mod explain;
pub mod frame;
pub mod haze;
pub mod ice_crystals;
pub mod job;
pub mod lights;
pub mod lunar;
pub mod metar;
pub mod moon;
pub mod observer;
mod parse;
pub mod planet;
pub mod preset;
pub mod probe;
pub mod problem;
pub mod refinement;
pub mod renderer;
pub mod schema;
pub mod shafts;
mod shape;
mod solar;
pub mod stars;
pub mod sun;
pub mod terrain;
pub mod timeline;

pub use airglow::Airglow;
pub use assets::{
    AssetKind, AssetReference, HeightGrid, LampList, Material, MeshModel, SceneAssets, Texture,
    WeatherPicture, is_asset_name,
};
pub use atmosphere::{Atmosphere, Method, Mie, Orders, Ozone, Rayleigh};
pub use bands::Bands;
pub use camera::{Camera, FisheyeMapping, Projection};
pub use celestial::Firmament;
pub use clouds::Clouds;
pub use direction::Direction;
pub use display::{Display, Exposure, ToneCurve};
pub use document::Scene;
pub use frame::{Format, FrameRequest, Quality};
pub use haze::Haze;
pub use ice_crystals::{CrystalLayer, IceCrystals};
pub use job::{JobPlan, JobRequest};
pub use lights::{Light, Town};
pub use lunar::MoonSeen;
pub use metar::{MetarAnswer, MetarRequest, ReportFault};
pub use moon::{Moon, MoonPlace};
pub use observer::Observer;
pub use planet::{Planet, SphereSurface, Water};
pub use preset::{Preset, preset, presets};
pub use probe::{Irradiance, ProbeAnswer, ProbeRequest, SunPlace};
pub use problem::{Problem, SceneError};
pub use schema::{
    frame_request_schema, job_request_schema, metar_answer_schema, metar_request_schema,
    probe_request_schema, scene_schema, timeline_schema,
};
pub use shafts::Shafts;
pub use stars::{Orientation, Stars};
pub use sun::{Sun, SunPosition};
pub use terrain::Terrain;
pub use timeline::Timeline;
