//! Numbers for operators. Whoever runs the process decides where they go.

use metrics::{Unit, counter, describe_counter, describe_gauge, describe_histogram, gauge, histogram};
use std::{sync::Once, time::Duration};
use welkin_scene::renderer::Frame;

const FRAMES: &str = "welkin_job_frames_total";
const RETRIES: &str = "welkin_job_retries_total";
const WAIT: &str = "welkin_job_wait_seconds";
const STAGE: &str = "welkin_job_stage_seconds";
const RENDER_PASS: &str = "welkin_render_pass_seconds";
const WAITING: &str = "welkin_jobs_tasks_waiting";
const RUNNING: &str = "welkin_jobs_tasks_running";
const BYTES: &str = "welkin_jobs_bytes";
const WORKERS: &str = "welkin_jobs_workers";

/// Says what the numbers are; once for a recorder.
pub(crate) fn describe() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        describe_counter!(FRAMES, "Frames of jobs that this process ended, by outcome");
        describe_counter!(RETRIES, "Times that this process tried something again, by stage");
        describe_histogram!(
            WAIT,
            Unit::Seconds,
            "Time from a task's place in the queue to its begin"
        );
        describe_histogram!(
            STAGE,
            Unit::Seconds,
            "Time of one stage of a job's frame: render, encode, store"
        );
        describe_gauge!(WAITING, "Tasks of jobs that wait, on all machines");
        describe_gauge!(RUNNING, "Tasks of jobs that run, on all machines");
        describe_gauge!(
            BYTES,
            Unit::Bytes,
            "What all jobs take of the store and the queue, or may take while they run"
        );
        describe_gauge!(
            WORKERS,
            "Workers whose heartbeat was heard lately, on all machines"
        );
    });
}

pub(crate) fn ended(outcome: &'static str) {
    counter!(FRAMES, "outcome" => outcome).increment(1);
}

pub(crate) fn retried(stage: &'static str) {
    counter!(RETRIES, "stage" => stage).increment(1);
}

pub(crate) fn waited(time: Duration) {
    histogram!(WAIT).record(time.as_secs_f64());
}

pub(crate) fn stage(stage: &'static str, time: Duration) {
    histogram!(STAGE, "stage" => stage).record(time.as_secs_f64());
}

pub(crate) fn passes(frame: &Frame) {
    for pass in &frame.passes {
        histogram!(RENDER_PASS, "pass" => pass.pass).record(pass.ms / 1e3);
    }
}

/// What is in the queue, on all machines.
pub(crate) struct Load {
    pub(crate) waiting: u64,
    pub(crate) running: u64,
    pub(crate) workers: u64,
    pub(crate) bytes: u64,
}

#[allow(
    clippy::cast_precision_loss,
    reason = "2^53 tasks or bytes are more than a queue holds"
)]
pub(crate) fn load(load: &Load) {
    gauge!(WAITING).set(load.waiting as f64);
    gauge!(RUNNING).set(load.running as f64);
    gauge!(WORKERS).set(load.workers as f64);
    gauge!(BYTES).set(load.bytes as f64);
}
