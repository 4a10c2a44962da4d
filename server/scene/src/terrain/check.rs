//! What no schema can say of terrain.

use super::{Shadow, Terrain};
use crate::problem::{Problem, Problems};
use serde_json::json;

/// Adds what is wrong with terrain that stands at the pointer `at`.
pub(crate) fn check(terrain: &Terrain, at: &str, problems: &mut Problems) {
    if let Some(Shadow::Map(map)) = terrain.shadow()
        && !map.size_px.is_power_of_two()
    {
        problems.push(Problem::new(
            format!("{at}/shadow/size_px"),
            &json!(map.size_px),
            "512, 1024, 2048, 4096 or 8192 pixels".into(),
        ));
    }
    if let Terrain::Heightfield(field) = terrain
        && let (Some(_), Some(mountains)) = (&field.name, &field.mountains)
    {
        problems.push(Problem::new(
            format!("{at}/mountains"),
            &json!(mountains),
            "left out where `name` is given: both say what the heights are".into(),
        ));
    }
}
