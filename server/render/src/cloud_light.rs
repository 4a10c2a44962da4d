//! Which light counts for the clouds.

use crate::{
    lights::Lights,
    night::Night,
    uniforms::{Part, Standpoint},
};

/// The light on the clouds.
pub(crate) struct CloudLight<'a> {
    pub(crate) stand: Standpoint,
    pub(crate) view: &'a Part,
    /// True where there are clouds.
    pub(crate) clouded: bool,
    /// True where shafts tell which air they keep it from.
    pub(crate) shafted: bool,
}

impl<'a> CloudLight<'a> {
    /// The sun, or at night the moon.
    pub(crate) fn new(
        stand: &Standpoint,
        night: &Night,
        lights: &'a Lights,
        (clouded, shafted): (bool, bool),
    ) -> Self {
        let by_moon = night.moon.filter(|moon| moon.counts > 0.0 && stand.is_night());
        by_moon.zip(lights.moon_view()).map_or(
            Self {
                stand: *stand,
                view: lights.view(false),
                clouded,
                shafted,
            },
            |(moon, view)| Self {
                stand: moon.stand(stand),
                view,
                clouded,
                shafted,
            },
        )
    }
}
