//! The light of the clouds in the directions of some blocks of the dome.

use crate::{
    cloud_dome::Blocks,
    cloudscape::Cloudscape,
    kernel::{Bind, Recorder, Variants},
    shader,
};

pub(crate) struct CloudDomeLight {
    kernels: Variants,
}

impl CloudDomeLight {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::CLOUD_DOME_LIGHT),
        }
    }

    pub(crate) fn run(&mut self, recorder: &mut Recorder<'_>, scape: &Cloudscape, blocks: &Blocks<'_>) {
        let gpu = recorder.gpu;
        let parts = scape.upload(gpu);
        let mut binds = scape.binds(&parts);
        binds.extend([
            Bind::Buffer(blocks.dome),
            Bind::Buffer(&parts.observer),
            Bind::Buffer(&blocks.list),
            Bind::Buffer(blocks.nodes),
            Bind::Table(blocks.seen),
        ]);
        recorder.dispatch(
            self.kernels.get(gpu, &scape.light_constants()),
            &binds,
            blocks.threads(),
        );
    }
}
