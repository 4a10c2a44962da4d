//! Why a device could not be opened or used.

/// What can go wrong between Welkin and a device; each says the cure.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// No adapter at all.
    #[error(
        "no graphics adapter was found; install a Vulkan driver (on Debian: mesa-vulkan-drivers libvulkan1)"
    )]
    NoAdapter,
    /// None that the settings allow.
    #[error("no adapter matches {asked}; there are: {there}")]
    NoSuchAdapter {
        /// What was asked for.
        asked: String,
        /// What there is.
        there: String,
    },
    /// The adapter lacks something that every frame needs.
    #[error("adapter {adapter} lacks {what}")]
    Lacking {
        /// The adapter's name.
        adapter: String,
        /// What it lacks.
        what: String,
    },
    /// The adapter gave no device.
    #[error("the device could not be opened: {0}")]
    Open(String),
    /// The device was lost.
    #[error("the device was lost: {0}")]
    Lost(String),
    /// The device refused a command or ran out of memory.
    #[error("the device refused a command: {0}")]
    Command(String),
    /// An order came without an asset that its scene names.
    #[error("the order holds no asset named {0}")]
    Asset(String),
    /// A mesh cannot be ray-cast.
    #[error("the mesh cannot be shown: {0}; cut its triangles more evenly")]
    Mesh(String),
    /// The renderer's thread could not be started.
    #[error("the renderer's thread could not be started: {0}")]
    Thread(#[from] std::io::Error),
}
