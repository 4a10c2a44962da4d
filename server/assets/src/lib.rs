//! The asset store: files that scenes refer to by name.
//!
//! The folder is the truth. Files are kept as they were sent, replaced as a whole, and looked at again when they have
//! changed, so that several processes may share one folder. Nothing outside it is read or written, and no symbolic
//! link is followed.

mod bundle;
mod content;
mod contents;
mod error;
mod facts;
mod folder;
mod heights;
mod kind;
mod mesh;
mod png_file;
mod resolve;
mod stamp;
mod store;
mod tree;

pub use error::Error;
pub use facts::{Facts, HeightFacts, MeshFacts};
pub use kind::{Form, Kind, Name};
pub use mesh::MAX_TRIANGLES;
pub use png_file::{Colour, MAX_SIDE_PX, PngFacts};
pub use resolve::resolve;
pub use store::{Asset, Limits, Put, Store, Usage};
