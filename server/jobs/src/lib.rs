//! Batches of frames: a queue that outlives the process, workers that take frames from it, and a store that the
//! frames' files land in. Knows the renderer by its trait, and nothing of HTTP.
//!
//! A job is a document (`welkin_scene::JobRequest`). Its frames are tasks of apalis, in SQLite or PostgreSQL; what a
//! task holds is the job's name and the frame's number, no more. A frame's file has one name and is put there whole or
//! not at all, and never in place of another. A worker that dies is noticed by its missing heartbeat; its frames are
//! begun again by others, and come out the same.

mod assets;
mod board;
mod error;
mod film;
mod frame;
mod gather;
mod id;
mod jobs;
mod limits;
mod metrics;
mod queue;
mod remove;
mod status;
mod store;
mod tend;
mod worker;

pub use board::Board;
pub use error::JobError;
pub use id::{JobId, Part, Task};
pub use jobs::{Jobs, Rendered, Sent};
pub use limits::Limits;
pub use queue::{Counts, Dead, Queue, State};
pub use status::{FileInfo, JobStatus};
pub use store::{ByteStream, Store};
pub use worker::{Calm, Worker, WorkerSettings};
