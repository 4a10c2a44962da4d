//! The asset store: files that scenes refer to by name.
//!
//! The folder is the truth. Files are kept as they were sent, replaced as a whole, and looked at again when they have
//! changed, so that several processes may share one folder. Nothing outside it is read or written, and no symbolic
//! link is followed.

mod error;
mod folder;
mod kind;
mod pictures;
mod png_file;
mod resolve;
mod stamp;
mod store;

pub use error::Error;
pub use kind::{Kind, Name};
pub use png_file::{Colour, MAX_SIDE_PX, PngFacts};
pub use resolve::resolve;
pub use store::{Asset, Limits, Put, Store, Usage};
