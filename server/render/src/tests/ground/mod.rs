//! What stands on the sphere: rays against the shape, its shadow, its light.

mod heightfield;
