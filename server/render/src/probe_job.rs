//! The numbers behind the picture.

use crate::{
    engine::Engine,
    error::Error,
    passes::probe::Sight,
    quadrature::{harmonics, sphere},
    sunlight::direct_normal,
    uniforms::Standpoint,
};
use glam::DVec3;
use welkin_scene::{Irradiance, ProbeAnswer, ProbeRequest};

/// Answers a probe: the directions asked for, and those over which irradiance and harmonics are summed.
pub(crate) fn answer(engine: &mut Engine, request: &ProbeRequest) -> Result<ProbeAnswer, Error> {
    let scene = &request.scene;
    let stand = Standpoint::new(scene);
    let nodes = sphere(&stand, scene.planet.radius_m);
    let asked = request.directions.iter().map(|d| Sight {
        direction: DVec3::from_array(d.unit()),
        disc: true,
    });
    let summed = nodes.iter().map(|n| Sight {
        direction: n.direction,
        disc: false,
    });
    let sights: Vec<Sight> = asked.chain(summed).collect();
    let seen = engine.probe(scene, &sights)?;
    let (asked, summed) = seen.split_at(request.directions.len());
    let mut diffuse_w_m2 = [0.0; 3];
    let mut sh9 = [[0.0; 3]; 9];
    for (node, seen) in nodes.iter().zip(summed) {
        let basis = harmonics(node.direction);
        let falling = node.direction.dot(stand.up).max(0.0);
        for (i, radiance) in seen.radiance.iter().enumerate() {
            diffuse_w_m2[i] += radiance * falling * node.weight_sr;
            for (sum, y) in sh9.iter_mut().zip(basis) {
                sum[i] += radiance * y * node.weight_sr;
            }
        }
    }
    let direct_normal_w_m2 = direct_normal(scene, &stand);
    let falling = stand.up.dot(stand.sun).max(0.0);
    Ok(ProbeAnswer {
        radiance_w_m2_sr: asked.iter().map(|s| s.radiance).collect(),
        transmittance: asked.iter().map(|s| s.transmittance).collect(),
        distance_m: asked.iter().map(|s| s.distance_m).collect(),
        irradiance: Irradiance {
            direct_w_m2: direct_normal_w_m2.map(|e| e * falling),
            direct_normal_w_m2,
            diffuse_w_m2,
            sh9,
        },
        sun: scene.sun_place(),
    })
}
