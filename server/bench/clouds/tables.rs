//! The tables of two theses and papers, and what their values are in a scene. A variation names fields of `clouds`; its
//! `published_…` are what the publication calls the same.

use super::super::Size;
use crate::commands::Failure;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use welkin_scene::{Quality, Scene, preset};

/// What one setup measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Table {
    /// What each kind of change costs.
    Changes,
    /// Buldakov 2023, table 4.1.
    ShellDensity,
    /// Table 4.2.
    ShellCoverage,
    /// Table 4.3, its sizes beside those of [`Self::Changes`].
    ShellSize,
    /// Voronezh State University's «Вестник», systems analysis, 2022 no. 2: table 2.
    Noise,
    /// Table 3.
    Steps,
    /// Table 4.
    Coverage,
    /// Table 5.
    LightSteps,
    /// Table 6.
    Combinations,
    /// How far each quality is from brute force.
    Truth,
}

/// All sizes, in the order of measuring.
pub(super) const SIZES: [Size; 9] = [
    Size::new(640, 360),
    Size::new(800, 480),
    Size::new(900, 600),
    Size::new(1280, 720),
    Size::new(1920, 1080),
    Size::new(3840, 2160),
    SMALL_SHELL,
    PAPER_SIZE,
    PATCH,
];
/// The paper does not tell its own.
const PAPER_SIZE: Size = Size::new(160, 90);
/// A quarter to the side of the thesis' 900×600, at which final frames would take minutes.
const SMALL_SHELL: Size = Size::new(225, 150);

/// What is compared with brute force, which takes milliseconds of processor time for a pixel.
pub(super) const PATCH: Size = Size::new(16, 300);

/// What the thesis calls the density of its preset.
const SHELL_DENSITY: u32 = 150;
/// The paper's most steps to the light, and ours.
const MOST_LIGHT_STEPS: [u32; 2] = [250, 64];
/// The paper's values of what it does not vary.
const STEPS: u32 = 250;
const COVERAGE: f64 = 0.5;
const LIGHT_STEPS: u32 = 64;

impl Table {
    pub(super) const ALL: [Self; 10] = [
        Self::Changes,
        Self::ShellDensity,
        Self::ShellCoverage,
        Self::ShellSize,
        Self::Noise,
        Self::Steps,
        Self::Coverage,
        Self::LightSteps,
        Self::Combinations,
        Self::Truth,
    ];

    /// Its own sizes, and the qualities there.
    pub(super) const fn places(self) -> &'static [(Size, &'static [Quality])] {
        const PREVIEW: &[Quality] = &[Quality::Preview];
        const FINAL: &[Quality] = &[Quality::Final];
        const BOTH: &[Quality] = &[Quality::Preview, Quality::Final];
        match self {
            Self::Changes => &[(SIZES[0], BOTH), (SIZES[2], BOTH), (SIZES[3], PREVIEW)],
            Self::ShellDensity | Self::ShellCoverage => &[(SIZES[2], PREVIEW), (SMALL_SHELL, FINAL)],
            Self::ShellSize => &[(SIZES[1], BOTH), (SIZES[4], PREVIEW), (SIZES[5], PREVIEW)],
            // The same at either.
            Self::Noise => &[(PAPER_SIZE, PREVIEW)],
            Self::Truth => &[(PATCH, BOTH)],
            _ => &[(PAPER_SIZE, FINAL)],
        }
    }

    pub(super) const fn work(self) -> &'static str {
        match self {
            Self::Noise => "noise-made",
            Self::Changes | Self::ShellSize => "sun-moved",
            _ => "scene-changed",
        }
    }

    /// One after the other.
    pub(super) fn variations(self) -> Vec<Map<String, Value>> {
        match self {
            Self::Changes | Self::Noise | Self::ShellSize | Self::Truth => vec![Map::new()],
            Self::ShellDensity => (0..=7)
                .map(|at| 20 * at)
                .map(|density| {
                    let ours = f64::from(density) / f64::from(SHELL_DENSITY);
                    fields(json!({"density": ours, "published_density": density}))
                })
                .collect(),
            // The preset's 0.6 stands for the thesis' 1.2.
            Self::ShellCoverage => [1.0, 1.2, 1.4, 1.6, 1.8, 2.0]
                .map(|coverage: f64| {
                    fields(json!({"coverage": 0.5 * coverage, "published_coverage": coverage}))
                })
                .into(),
            Self::Steps => [50, 100, 150, 200, 250]
                .map(|steps| paper(steps, COVERAGE, LIGHT_STEPS))
                .into(),
            Self::Coverage => [0.1, 0.2, 0.5, 0.7, 1.0]
                .map(|coverage| paper(STEPS, coverage, LIGHT_STEPS))
                .into(),
            Self::LightSteps => [50, 100, 150, 200, 250]
                .map(|light_steps| paper(STEPS, COVERAGE, light_steps))
                .into(),
            Self::Combinations => (0..8)
                .map(|at| {
                    let pick = |bit: u32| at >> bit & 1 == 1;
                    let steps = if pick(2) { 200 } else { 100 };
                    let coverage = if pick(1) { 0.8 } else { 0.3 };
                    paper(steps, coverage, if pick(0) { 200 } else { 100 })
                })
                .collect(),
        }
    }

    /// The scene with these fields of its clouds.
    ///
    /// # Errors
    /// Where clouds have no such fields.
    pub(super) fn scene(self, varied: &Map<String, Value>) -> Result<Scene, Failure> {
        let mut scene = match self {
            Self::Changes | Self::ShellDensity | Self::ShellCoverage | Self::ShellSize => shell(),
            _ => fair_weather(),
        };
        let failed = |e: serde_json::Error| Failure::Bench(format!("{varied:?}: {e}"));
        let mut clouds = serde_json::to_value(scene.clouds).map_err(failed)?;
        for (field, value) in varied
            .iter()
            .filter(|(field, _)| !field.starts_with("published_"))
        {
            clouds[field] = value.clone();
        }
        scene.clouds = serde_json::from_value(clouds).map_err(failed)?;
        Ok(scene)
    }
}

fn paper(steps: u32, coverage: f64, light_steps: u32) -> Map<String, Value> {
    let [most, ours] = MOST_LIGHT_STEPS;
    fields(json!({
        "steps": steps,
        "coverage": coverage,
        "light_steps": (light_steps * ours + most / 2) / most,
        "published_light_steps": light_steps,
    }))
}

fn fields(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(fields) => fields,
        _ => Map::new(),
    }
}

/// The thesis' clouds, without shafts, which it does not draw.
pub(super) fn shell() -> Scene {
    Scene {
        shafts: None,
        ..preset_scene("bauman")
    }
}

/// Ours, beside the paper's.
pub(super) fn fair_weather() -> Scene {
    preset_scene("fair-weather")
}

pub(super) fn preset_scene(name: &str) -> Scene {
    preset(name)
        .map(|preset| preset.scene.clone())
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;

    #[test]
    fn every_variation_is_a_valid_scene_of_its_own() {
        for table in Table::ALL {
            let mut seen: Vec<Scene> = Vec::new();
            for varied in table.variations() {
                let scene = table.scene(&varied).unwrap();
                assert!(scene.clouds.is_some());
                let text = serde_json::to_string(&scene).unwrap();
                assert_eq!(Scene::from_json(&text).unwrap(), scene, "{varied:?}");
                assert!(!seen.contains(&scene), "{table:?} {varied:?}");
                seen.push(scene);
            }
        }
    }

    #[test]
    fn the_publications_values_fit_into_ours() {
        let clouds = |table: Table, at: usize| table.scene(&table.variations()[at]).unwrap().clouds.unwrap();
        assert_eq!(clouds(Table::ShellDensity, 0).density, 0.0);
        assert!((clouds(Table::ShellDensity, 7).density - 14.0 / 15.0).abs() < 1e-12);
        assert_eq!(clouds(Table::ShellCoverage, 5).coverage, 1.0);
        assert_eq!(
            clouds(Table::ShellCoverage, 1).coverage,
            shell().clouds.unwrap().coverage
        );
        assert_eq!(clouds(Table::LightSteps, 4).light_steps, 64);
        assert_eq!(clouds(Table::LightSteps, 0).light_steps, 13);
        let last = clouds(Table::Combinations, 7);
        assert_eq!((last.steps, last.coverage, last.light_steps), (200, 0.8, 51));
        let first = clouds(Table::Combinations, 0);
        assert_eq!((first.steps, first.coverage, first.light_steps), (100, 0.3, 26));
    }
}
