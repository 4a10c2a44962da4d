//! The noise that clouds are made of: its functions by their twins, its textures by what is promised of them.

mod functions;
mod textures;
