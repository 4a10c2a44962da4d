//! Which clouds are seen in the directions of some blocks of the dome.

use crate::{
    cloud_dome::Blocks,
    cloudscape::Cloudscape,
    kernel::{Bind, Recorder, Variants},
    shader,
};

pub(crate) struct CloudDome {
    kernels: Variants,
}

/// Floats of a corner: `Nodes` of `lib/cloud_nodes.wgsl`.
pub(crate) const NODE_FLOATS: u64 = 24;

/// Of all that is seen, what a place stands for in a preview: `NODE_SHARE` of `lib/cloud_nodes.wgsl`.
const NODE_SHARE: (&str, f64) = ("NODE_SHARE", 0.45);

impl CloudDome {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::CLOUD_DOME),
        }
    }

    pub(crate) fn run(&mut self, recorder: &mut Recorder<'_>, scape: &Cloudscape, blocks: &Blocks<'_>) {
        let gpu = recorder.gpu;
        let parts = scape.upload(gpu);
        let mut binds = scape.march_binds(&parts);
        binds.extend([
            Bind::Buffer(blocks.dome),
            Bind::Buffer(&parts.observer),
            Bind::Buffer(&blocks.list),
            Bind::Buffer(blocks.nodes),
        ]);
        let kernel = self.kernels.get(gpu, &[scape.one_layer(), NODE_SHARE]);
        recorder.dispatch(kernel, &binds, blocks.threads());
    }
}
