//! Light scattered once, by quadrature.

use crate::{lit, oracle, probe, thesis, triple};
use serde_json::Value;
use welkin_scene::Direction;

/// Rows of one observer and sun, in the order of the file.
fn groups(rows: &[Value]) -> Vec<((f64, f64), Vec<&Value>)> {
    let mut groups: Vec<((f64, f64), Vec<&Value>)> = Vec::new();
    for row in rows {
        let key = (row[0].as_f64().unwrap(), row[1].as_f64().unwrap());
        match groups.iter_mut().find(|(k, _)| *k == key) {
            Some((_, list)) => list.push(row),
            None => groups.push((key, vec![row])),
        }
    }
    groups
}

#[test]
fn single_scattering_matches_the_oracle_in_every_direction() {
    let (air, oracle) = (thesis("single"), oracle("single_scattering"));
    for ((altitude_m, zenith_deg), rows) in groups(oracle["rows"].as_array().unwrap()) {
        let directions = rows
            .iter()
            .map(|row| Direction::angles(row[3].as_f64().unwrap(), 90.0 - row[2].as_f64().unwrap()))
            .collect();
        let answer = probe(lit(&air, altitude_m, zenith_deg, 0.0), directions);
        let allowed = if zenith_deg < 90.0 { 1e-3 } else { 1e-2 };
        for (i, row) in rows.iter().enumerate() {
            assert_eq!(
                answer.distance_m[i].is_some(),
                row[8].as_bool().unwrap(),
                "ground in {row}"
            );
            let (radiance, transmittance) = (triple(&row[6]), triple(&row[7]));
            for c in 0..3 {
                // What the product promises is 1 %, and 3 % with the sun below the horizon. The integrator is within
                // 0.1 % of the one; of the other within 1 %, where the light has come through 600 km of the lowest air
                // and one more table step would show. A loss of that is a fault even where the promise still holds.
                let off = (answer.radiance_w_m2_sr[i][c] - radiance[c]).abs();
                assert!(
                    off <= allowed * radiance[c] + 1e-8,
                    "{} in band {c} for {row}",
                    answer.radiance_w_m2_sr[i][c]
                );
                // f32 optical depths up to 40 are good to 1e-5 of themselves.
                let off = (answer.transmittance[i][c] - transmittance[c]).abs();
                assert!(
                    off <= 1e-3 * transmittance[c] + 1e-9,
                    "{} in band {c} for {row}",
                    answer.transmittance[i][c]
                );
            }
        }
    }
}
