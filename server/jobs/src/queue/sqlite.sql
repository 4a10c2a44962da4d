CREATE TABLE IF NOT EXISTS welkin_jobs (
    id TEXT PRIMARY KEY,
    idempotency_key TEXT UNIQUE,
    document TEXT NOT NULL,
    summary TEXT NOT NULL,
    frames INTEGER NOT NULL,
    state TEXT NOT NULL,
    created_ms INTEGER NOT NULL,
    ended_ms INTEGER,
    notes TEXT NOT NULL DEFAULT '[]',
    bytes INTEGER NOT NULL
);
CREATE TABLE IF NOT EXISTS welkin_begins (task TEXT PRIMARY KEY, count INTEGER NOT NULL);
CREATE INDEX IF NOT EXISTS welkin_jobs_open ON welkin_jobs (id) WHERE ended_ms IS NULL;
CREATE INDEX IF NOT EXISTS welkin_unsettled ON Jobs (job_type, idempotency_key) WHERE status NOT IN ('Done', 'Killed');
