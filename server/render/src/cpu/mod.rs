//! f64 twins of the functions in `shaders/lib`: the tests compare the two, and the facts of a frame come from here.

pub(crate) mod air;
pub(crate) mod airglow;
#[cfg(test)]
pub(crate) mod cloud;
#[cfg(test)]
pub(crate) mod geometry;
#[cfg(test)]
pub(crate) mod heightfield;
#[cfg(test)]
pub(crate) mod mesh;
#[cfg(test)]
pub(crate) mod moon;
#[cfg(test)]
pub(crate) mod noise;
#[cfg(test)]
pub(crate) mod phase;
#[cfg(test)]
pub(crate) mod scattering;
