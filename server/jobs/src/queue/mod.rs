//! The queue: tasks as apalis keeps them, and beside them one row for each job. SQLite on one machine, PostgreSQL
//! for many.
//!
//! What is asked of both databases is the same text but for the name of the table of tasks.

mod records;
mod remove;
mod settled;
mod tasks;

pub use records::State;
pub(crate) use records::{Added, New, Record, Summary};
pub(crate) use settled::Settled;
pub use tasks::{Counts, Dead};

use crate::JobError;
use apalis_postgres::PostgresStorage;
use apalis_sqlite::SqliteStorage;
use sqlx::{
    PgPool, SqlitePool,
    postgres::PgPoolOptions,
    sqlite::{SqliteConnectOptions, SqliteJournalMode, SqlitePoolOptions, SqliteSynchronous},
};
use std::{
    str::FromStr,
    time::{Duration, SystemTime},
};
use tokio::time::sleep;

/// As the tables of apalis call the queue.
pub(crate) const NAME: &str = "welkin";
/// Connections of one process: fetching, heartbeat, progress and one to spare.
const CONNECTIONS: u32 = 4;
/// How long a connection may take. Databases are restarted.
const CONNECT_TIMEOUT: Duration = Duration::from_secs(10);
/// How long SQLite waits for another process to finish writing.
const BUSY_TIMEOUT: Duration = Duration::from_secs(30);
/// How often, and after what pause, an SQLite file is opened that other processes open and make at that time.
const OPENINGS: usize = 20;
const OPENING_PAUSE: Duration = Duration::from_millis(100);

/// The queue. Clones are the same queue.
#[derive(Clone, Debug)]
pub enum Queue {
    /// One file, for processes of one machine.
    Sqlite(SqlitePool),
    /// A server, for any number of machines.
    Postgres(PgPool),
}

/// The same statement on either database; `$tasks` is what each calls the table of tasks.
macro_rules! on {
    ($queue:expr, |$pool:ident, $tasks:ident| $body:expr) => {
        match $queue {
            $crate::queue::Queue::Sqlite($pool) => {
                #[allow(unused_variables, reason = "not every statement is about tasks")]
                let $tasks = "Jobs";
                $body
            }
            $crate::queue::Queue::Postgres($pool) => {
                #[allow(unused_variables, reason = "not every statement is about tasks")]
                let $tasks = "apalis.jobs";
                $body
            }
        }
    };
}
pub(crate) use on;

impl Queue {
    /// Opens `sqlite:FILE`, which is made where it is missing, or `postgres://…`, and makes or brings up to date the
    /// tables there.
    ///
    /// # Errors
    /// [`JobError::Address`], [`JobError::Queue`].
    pub async fn open(address: &str) -> Result<Self, JobError> {
        for _ in 1..OPENINGS {
            match Self::open_once(address).await {
                // Another process may be making the same file: SQLite waits for no one who turns to its journal or to
                // another's tables.
                Err(JobError::Queue(_)) if address.starts_with("sqlite:") => sleep(OPENING_PAUSE).await,
                done => return done,
            }
        }
        Self::open_once(address).await
    }

    async fn open_once(address: &str) -> Result<Self, JobError> {
        let queue = if address.starts_with("sqlite:") {
            let options = SqliteConnectOptions::from_str(address)
                .map_err(|e| JobError::Address(format!("{address}: {e}")))?
                .create_if_missing(true)
                .journal_mode(SqliteJournalMode::Wal)
                .synchronous(SqliteSynchronous::Normal)
                .busy_timeout(BUSY_TIMEOUT);
            let pool = SqlitePoolOptions::new().max_connections(CONNECTIONS);
            Self::Sqlite(pool.connect_with(options).await?)
        } else if address.starts_with("postgres://") || address.starts_with("postgresql://") {
            let pool = PgPoolOptions::new()
                .max_connections(CONNECTIONS)
                .acquire_timeout(CONNECT_TIMEOUT)
                .idle_timeout(Duration::from_secs(30));
            Self::Postgres(pool.connect(address).await?)
        } else {
            return Err(JobError::Address(
                "a queue is sqlite:FILE or postgres://USER:PASSWORD@HOST/DATABASE".into(),
            ));
        };
        queue.migrate().await?;
        Ok(queue)
    }

    async fn migrate(&self) -> Result<(), JobError> {
        let failed = |e: sqlx::migrate::MigrateError| JobError::Queue(e.to_string());
        match self {
            // Not `setup`, which turns off what keeps the file whole when the machine goes down.
            Self::Sqlite(pool) => SqliteStorage::migrations().run(pool).await.map_err(failed)?,
            Self::Postgres(pool) => PostgresStorage::migrations().run(pool).await.map_err(failed)?,
        }
        match self {
            Self::Sqlite(pool) => {
                sqlx::raw_sql(include_str!("sqlite.sql")).execute(pool).await?;
            }
            Self::Postgres(pool) => {
                sqlx::raw_sql(include_str!("postgres.sql")).execute(pool).await?;
            }
        }
        Ok(())
    }
}

/// Milliseconds since 1970.
pub(crate) fn now_ms() -> i64 {
    let since = SystemTime::now()
        .duration_since(SystemTime::UNIX_EPOCH)
        .unwrap_or_default();
    i64::try_from(since.as_millis()).unwrap_or(i64::MAX)
}
