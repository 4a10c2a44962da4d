//! The numbers behind the picture, piece by piece.

use crate::{
    cloud_sky::CloudSky,
    engine::Engine,
    error::Error,
    night::Night,
    passes::probe::{CHUNK, CLOUDED_CHUNK, Seen, Sight},
    quadrature::{CLEAR, CLOUDED, Node, harmonics, sphere},
    sunlight::{Direct, DiscsLeft},
    uniforms::Standpoint,
};
use glam::DVec3;
use welkin_scene::{Irradiance, ProbeAnswer, renderer::ProbeOrder};

/// A probe on its way: the directions asked for, and those over which irradiance and harmonics are summed.
pub(crate) struct ProbeJob {
    order: ProbeOrder,
    stand: Standpoint,
    nodes: Vec<Node>,
    sights: Vec<Sight>,
    seen: Vec<Seen>,
    /// Directions in one piece of work.
    chunk: usize,
}

impl ProbeJob {
    pub(crate) fn new(order: ProbeOrder) -> Self {
        let request = &order.request;
        let stand = Standpoint::new(&request.scene);
        let (fineness, chunk) = if CloudSky::new(&request.scene).is_some() {
            (CLOUDED, CLOUDED_CHUNK)
        } else {
            (CLEAR, CHUNK)
        };
        let nodes = sphere(&stand, request.scene.planet.radius_m, fineness);
        let asked = request.directions.iter().map(|d| Sight {
            direction: DVec3::from_array(d.unit()),
            disc: true,
        });
        let summed = nodes.iter().map(|n| Sight {
            direction: n.direction,
            disc: false,
        });
        let sights = asked.chain(summed).collect();
        Self {
            order,
            stand,
            nodes,
            sights,
            seen: Vec::new(),
            chunk,
        }
    }

    /// Does the next piece of work, as long as a tile of a frame. The answer, once it is whole.
    pub(crate) fn step(&mut self, engine: &mut Engine) -> Result<Option<ProbeAnswer>, Error> {
        let from = self.seen.len();
        let to = (from + self.chunk).min(self.sights.len());
        let (scene, assets) = (&self.order.request.scene, &self.order.assets);
        let (seen, discs_left) = engine.probe(scene, assets, &self.sights[from..to])?;
        self.seen.extend(seen);
        Ok((to == self.sights.len()).then(|| self.answer(discs_left)))
    }

    fn answer(&self, left: DiscsLeft) -> ProbeAnswer {
        let (asked, summed) = self.seen.split_at(self.order.request.directions.len());
        let mut diffuse_w_m2 = [0.0; 3];
        let mut sh9 = [[0.0; 3]; 9];
        for (node, seen) in self.nodes.iter().zip(summed) {
            let basis = harmonics(node.direction);
            let falling = node.direction.dot(self.stand.up).max(0.0);
            for (i, radiance) in seen.radiance.iter().enumerate() {
                diffuse_w_m2[i] += radiance * falling * node.weight_sr;
                for (sum, y) in sh9.iter_mut().zip(basis) {
                    sum[i] += radiance * y * node.weight_sr;
                }
            }
        }
        let scene = &self.order.request.scene;
        let night = Night::new(scene, &self.stand);
        let direct = Direct::new(scene, &self.stand, &night).behind(left);
        let falling = self.stand.up.dot(self.stand.sun).max(0.0);
        ProbeAnswer {
            radiance_w_m2_sr: asked.iter().map(|s| s.radiance).collect(),
            transmittance: asked.iter().map(|s| s.transmittance).collect(),
            distance_m: asked.iter().map(|s| s.distance_m).collect(),
            irradiance: Irradiance {
                direct_w_m2: direct.sun.map(|e| e * falling),
                direct_normal_w_m2: direct.sun,
                moon_direct_normal_w_m2: direct.moon,
                diffuse_w_m2,
                sh9,
            },
            sun: scene.sun_place(),
            moon: scene.moon_place(),
        }
    }
}
