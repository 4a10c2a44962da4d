//! The queue as boards read it.

use crate::{Jobs, Queue, Task, queue::NAME};
use apalis_postgres::PostgresStorage;
use apalis_sqlite::SqliteStorage;

/// The tasks of all jobs as apalis keeps them, to be looked at: what is changed here is unknown to the jobs.
pub enum Board {
    /// In SQLite.
    Sqlite(SqliteStorage<Task>),
    /// In PostgreSQL.
    Postgres(PostgresStorage<Task>),
}

impl Jobs {
    /// The name under which apalis keeps the tasks.
    pub const QUEUE: &str = NAME;

    /// The tasks of all jobs.
    #[must_use]
    pub fn board(&self) -> Board {
        match &self.queue {
            Queue::Sqlite(pool) => {
                let config = apalis_sqlite::Config::default().queue(NAME);
                Board::Sqlite(SqliteStorage::new(pool).with_config(config))
            }
            Queue::Postgres(pool) => {
                let config = apalis_postgres::Config::default().queue(NAME);
                Board::Postgres(PostgresStorage::new(pool).with_config(config))
            }
        }
    }
}
