BEGIN;
-- Of processes that start together, one makes the tables: "if not exists" alone does not hold against another.
SELECT pg_advisory_xact_lock(8386106348137);
CREATE TABLE IF NOT EXISTS welkin_jobs (
    id TEXT PRIMARY KEY,
    idempotency_key TEXT UNIQUE,
    document TEXT NOT NULL,
    summary TEXT NOT NULL,
    frames BIGINT NOT NULL,
    state TEXT NOT NULL,
    created_ms BIGINT NOT NULL,
    ended_ms BIGINT,
    notes TEXT NOT NULL DEFAULT '[]',
    bytes BIGINT NOT NULL
);
CREATE TABLE IF NOT EXISTS welkin_begins (task TEXT PRIMARY KEY, count BIGINT NOT NULL);
CREATE INDEX IF NOT EXISTS welkin_jobs_open ON welkin_jobs (id) WHERE ended_ms IS NULL;
-- Prefixes are looked up byte by byte, whatever the database's collation.
CREATE INDEX IF NOT EXISTS welkin_tasks ON apalis.jobs (job_type, idempotency_key text_pattern_ops);
CREATE INDEX IF NOT EXISTS welkin_unsettled ON apalis.jobs (job_type, idempotency_key text_pattern_ops)
    WHERE status NOT IN ('Done', 'Killed');
COMMIT;
