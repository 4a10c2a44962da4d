//! The published form.

use crate::sets::{Group, Plan};
use serde_json::{Value, json};
use welkin_reference::{DVec3, Figure, Radiance, View};

/// One view.
pub(crate) fn row(view: &View, albedos: &[f64], found: &Radiance) -> Value {
    json!({
        "observer_alt_m": view.altitude_m,
        "sun_zenith_deg": view.sun_zenith_deg,
        "view_zenith_deg": view.view_zenith_deg,
        "view_azimuth_deg": view.view_azimuth_deg,
        "hits_ground": found.distance_m.is_some(),
        "distance_m": found.distance_m.map(short),
        "transmittance": rgb(found.transmittance),
        "single": rgb(found.single),
        "sunlit_ground": rgb(found.ground),
        "second_air": figure(&found.second[0]),
        "second_ground": figure(&found.second[1]),
        "bounces": found.bounces.iter().copied().map(rgb).collect::<Vec<_>>(),
        "totals": totals(albedos, &found.totals),
        "walks": found.walks,
    })
}

/// The sky of one observer and sun.
pub(crate) fn sky(view: &View, albedos: &[f64], found: &[Figure]) -> Value {
    json!({
        "observer_alt_m": view.altitude_m,
        "sun_zenith_deg": view.sun_zenith_deg,
        "diffuse_irradiance": totals(albedos, found),
    })
}

/// The file: a row is a line.
pub(crate) fn document(plan: &Plan, groups: Vec<(&Group, Vec<Value>, Vec<Value>)>) -> String {
    let head = json!({
        "what": format!("radiance of the sky for a sun of unit irradiance, 1/sr, R, G and B: {}", plan.what),
        "method": "single scattering and sunlit ground by adaptive Gauss-Legendre quadrature to 1e-8; the rest by backward random walks with next-event estimation, one walk for the three bands (server/reference)",
        "sun": "a parallel beam, no disc",
        "ground": "grey Lambert",
        "not_in_it": "refraction, polarisation",
        "angles": "zeniths at the observer; the view's azimuth less the sun's",
        "columns": {
            "transmittance": "from the observer to the ground or to space",
            "single": "scattered once in the air, no ground",
            "sunlit_ground": "a ground of albedo 1 in the sun alone, seen through the air",
            "second_air": "scattered twice in the air, no ground",
            "second_ground": "once by the air and once by a ground of albedo 1, in either order",
            "bounces": "coefficients of the albedo's powers 0 to 4 in the total, without single in the first and with sunlit_ground in the second; the last is the sum of all higher ones at albedo 1",
            "totals": "all light by the ground's albedo; stderr is one standard error",
            "diffuse_irradiance": "of the sky without the sun on a horizontal plane that looks up"
        },
        "seed": plan.seed,
        "seed_of_a_row": "the set's plus the row's number over all groups, from 0; of a sky the set's plus 500, ten times the group's number and its own",
    });
    let lines = |values: &[Value]| {
        let lines: Vec<_> = values.iter().map(|value| format!("    {value}")).collect();
        lines.join(",\n")
    };
    let groups: Vec<_> = groups
        .iter()
        .map(|(group, rows, skies)| {
            format!(
                "  {{\"scene\": {},\n   \"relative_error_aimed_at\": {},\n   \"rows\": [\n{}\n   ],\n   \"skies\": [\n{}\n   ]}}",
                group.scene,
                group.relative_error,
                lines(rows),
                lines(skies)
            )
        })
        .collect();
    let head = head.to_string();
    format!(
        "{},\n\"groups\": [\n{}\n]}}\n",
        &head[..head.len() - 1],
        groups.join(",\n")
    )
}

fn totals(albedos: &[f64], figures: &[Figure]) -> Vec<Value> {
    let total = |(albedo, found): (&f64, &Figure)| json!({"ground_albedo": albedo, "mean": rgb(found.mean), "stderr": rgb(found.stderr)});
    albedos.iter().zip(figures).map(total).collect()
}

fn figure(figure: &Figure) -> Value {
    json!({"mean": rgb(figure.mean), "stderr": rgb(figure.stderr)})
}

fn rgb(value: DVec3) -> [f64; 3] {
    value.to_array().map(short)
}

/// Seven digits.
fn short(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}
