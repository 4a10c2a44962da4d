//! What a tile asks of the passes.

use super::Engine;
use crate::{
    error::Error,
    kernel::Recorder,
    memo::Fingerprint,
    passes::{
        exposure::EXPOSURE_BYTES,
        ground_light::LIT_BYTES,
        ground_view::Looks,
        pillars::PillarsInputs,
        sky::SkyTo,
        stars::{StarsInputs, StarsOut},
        tone::ToneInputs,
    },
    pillars::Pillars,
    prepared::Prepared,
    screen::{PICTURE_BYTES, RADIANCE_BYTES},
    uniforms::{Part, TileUniform, ToneUniform},
};
use welkin_scene::renderer::{FrameOrder, Output, PassTime};

/// What a tile is made of, four values a pixel each.
pub(crate) struct TileBytes<'a> {
    pub(crate) pixels: &'a [u8],
    /// Light and distance of what stands on the ground, where that has silhouettes.
    pub(crate) ground: Option<&'a [u8]>,
}

impl Engine {
    /// One tile. `take` gets its bytes: four floats a pixel of radiance, or four bytes a pixel of the picture. Gives
    /// what it gives, the picture's EV, and the times.
    pub(crate) fn tile<T>(
        &mut self,
        order: &FrameOrder,
        frame: &Prepared,
        tile: TileUniform,
        take: impl FnOnce(TileBytes<'_>) -> T,
    ) -> Result<(T, Option<f64>, Vec<PassTime>), Error> {
        let gpu = &self.gpu;
        let pixels = u64::from(tile.size_px.x) * u64::from(tile.size_px.y);
        let buffers = self.screen.fit(gpu, pixels);
        gpu.guarded(|| {
            let mut recorder = Recorder::new(gpu);
            let inputs = frame.sky_inputs();
            let stars = frame.stars.as_ref().map(StarsOut::fingerprint);
            let pillars = frame.pillars.as_ref().map(Pillars::fingerprint);
            let made_from = Fingerprint::of((inputs.fingerprint(&Part::new(&tile)), stars, pillars));
            let (settings, known_ev) = ToneUniform::new(
                &order.scene,
                &frame.camera,
                &frame.tables.stand,
                tile,
                &frame.glare,
            );
            let tone = ToneInputs {
                curve: order.scene.display.tone_curve,
                settings: &settings,
                exposure: &frame.exposure,
            };
            let display = order.output == Output::Display;
            // A preview by lattices is made anew sooner than its radiance could be toned.
            let in_one = display && frame.stars.is_none() && frame.pillars.is_none();
            let by_lattices = in_one && frame.by_lattices;
            // Whoever comes twice turns at the display: for them the radiance is kept.
            let comes_first = in_one && buffers.shown != Some(made_from);
            let at_once = by_lattices || comes_first;
            // Both emptied until the commands have run.
            let (held, _) = (buffers.holds.take(), buffers.shown.take());
            let mut ground = buffers.ground.clone();
            if by_lattices || held != Some(made_from) {
                let to = if by_lattices {
                    SkyTo::Preview(tone, &buffers.picture)
                } else if at_once {
                    SkyTo::Picture(tone, &buffers.picture)
                } else {
                    SkyTo::Radiance(&buffers.radiance)
                };
                let (clouds, lit_ground) = self.sky.run(&mut recorder, inputs, tile, to);
                let seen = frame.clouds_seen(clouds.as_ref());
                if let Some(stars) = &frame.stars {
                    let reads = StarsInputs {
                        air: inputs.air,
                        view: inputs.view,
                        transmittance: inputs.transmittance,
                        clouds: seen,
                        lit_ground: lit_ground.as_ref(),
                    };
                    self.stars
                        .run(&mut recorder, reads, stars, tile, &buffers.radiance);
                }
                if let Some(pillars) = &frame.pillars {
                    let reads = PillarsInputs {
                        air: inputs.air,
                        transmittance: inputs.transmittance,
                        clouds: seen,
                        lit_ground: lit_ground.as_ref(),
                    };
                    let looks = Looks::Tile(inputs.camera, inputs.plan.projection, tile, inputs.frame_px);
                    self.pillars
                        .1
                        .run(&mut recorder, reads, pillars, looks, &buffers.radiance);
                }
                ground = lit_ground;
            }
            let is_held = !by_lattices && (held == Some(made_from) || !at_once);
            if display && is_held {
                self.tone
                    .run(&mut recorder, tone, &buffers.radiance, &buffers.picture);
            }
            let (source, size) = if display {
                (&buffers.picture, PICTURE_BYTES * pixels)
            } else {
                (&buffers.radiance, RADIANCE_BYTES * pixels)
            };
            recorder
                .encoder
                .copy_buffer_to_buffer(source, 0, &buffers.staging, 0, size);
            recorder
                .encoder
                .copy_buffer_to_buffer(&frame.exposure, 0, &buffers.exposure, 0, EXPOSURE_BYTES);
            let mut readable = vec![(&buffers.staging, size), (&buffers.exposure, EXPOSURE_BYTES)];
            if let Some(lit) = ground.as_ref().filter(|_| frame.has_silhouettes()) {
                let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
                let staging = buffers
                    .ground_staging
                    .get_or_insert_with(|| gpu.buffer("ground staging", LIT_BYTES * buffers.pixels, usage));
                let size = LIT_BYTES * pixels;
                recorder.encoder.copy_buffer_to_buffer(lit, 0, staging, 0, size);
                readable.push((staging, size));
            }
            let ((taken, metered_ev), times) = recorder.finish(&readable, |bytes| {
                let exposure: &[f32] = bytemuck::cast_slice(bytes[1]);
                let tile = TileBytes {
                    pixels: bytes[0],
                    ground: bytes.get(2).copied(),
                };
                (take(tile), f64::from(exposure[1]))
            })?;
            if is_held {
                (buffers.holds, buffers.ground) = (Some(made_from), ground);
            } else {
                (buffers.holds, buffers.shown) = (held, Some(made_from));
            }
            let ev = match order.output {
                Output::Display if settings.metered == 1 => Some(metered_ev),
                Output::Display => known_ev,
                Output::Linear => None,
            };
            Ok((taken, ev, times))
        })
    }
}
