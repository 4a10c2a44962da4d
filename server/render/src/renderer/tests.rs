//! The thread's work step by step: the device's loss between orders and within one.
#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use super::*;
use welkin_scene::renderer::Pixels;

fn order(height_px: u32, output: Output) -> FrameOrder {
    FrameOrder {
        scene: Arc::new(Scene::clear()),
        assets: Arc::default(),
        width_px: 32,
        height_px,
        quality: Quality::Preview,
        output,
        priority: Priority::Interactive,
    }
}

/// A worker with a device of its own.
fn worker() -> Worker {
    let engine = Engine::open(&RendererSettings::default(), 0).unwrap();
    let shared = Shared {
        places: 4,
        taken: AtomicUsize::new(0),
        device: Mutex::new(engine.gpu.info.clone()),
        mean_ms: Mutex::new(100.0),
    };
    Worker::new(RendererSettings::default(), engine, Arc::new(shared))
}

type Waiting<T> = oneshot::Receiver<Result<T, RenderError>>;

fn task<T>(worker: &Worker, work: impl FnOnce(Answer<T>) -> Work) -> (Task, Waiting<T>) {
    let (sender, receiver) = oneshot::channel();
    worker.shared.taken.fetch_add(1, Ordering::AcqRel);
    let answer = Answer {
        sender,
        shared: Arc::clone(&worker.shared),
    };
    let task = Task {
        work: work(answer),
        failures: 0,
        begun: None,
    };
    (task, receiver)
}

fn frame_task(worker: &Worker, order: FrameOrder) -> (Task, Waiting<Arc<Frame>>) {
    task(worker, |answer| {
        Work::Frame(Box::new(FrameJob::new(order, None)), answer)
    })
}

/// Steps until the order is done.
fn finish(worker: &mut Worker, task: Task) {
    let mut left = Some(task);
    while let Some(task) = left {
        left = worker.step(task);
    }
}

fn lose_device(worker: &Worker) {
    worker.engine.as_ref().unwrap().gpu.device.destroy();
}

fn answer<T>(mut waiting: Waiting<T>) -> Result<T, RenderError> {
    waiting.try_recv().unwrap().expect("the order was answered")
}

fn recoveries(worker: &Worker) -> u64 {
    worker.shared.device.lock().unwrap().recoveries
}

#[test]
fn a_device_lost_between_two_orders_is_opened_anew() {
    let mut worker = worker();
    let (first, waiting) = frame_task(&worker, order(16, Output::Linear));
    finish(&mut worker, first);
    let before = answer(waiting).unwrap();
    assert_eq!(recoveries(&worker), 0);
    lose_device(&worker);
    // Another height: the frame of an equal order is kept and needs no device.
    let (second, waiting) = frame_task(&worker, order(24, Output::Linear));
    finish(&mut worker, second);
    let after = answer(waiting).unwrap();
    assert_eq!(recoveries(&worker), 1);
    let (Pixels::Linear(before), Pixels::Linear(after)) = (&before.pixels, &after.pixels) else {
        panic!("not linear")
    };
    assert_eq!((before.len(), after.len()), (3 * 32 * 16, 3 * 32 * 24));
    assert!(after.iter().all(|v| v.is_finite()) && after.iter().any(|v| *v > 0.0));
    // The next order finds the new device as it is.
    let (third, waiting) = frame_task(&worker, order(16, Output::Display));
    finish(&mut worker, third);
    assert!(answer(waiting).is_ok());
    assert_eq!(recoveries(&worker), 1);
}

#[test]
fn a_device_lost_within_a_frame_or_a_probe_costs_no_answer() {
    let mut worker = worker();
    let (whole, waiting) = frame_task(&worker, order(40, Output::Display));
    finish(&mut worker, whole);
    let expected = answer(waiting).unwrap();
    worker.kept = KeptFrames::default();
    worker.budget = TileBudget::default();
    // After the tables, before the first tile.
    let (half_done, waiting) = frame_task(&worker, order(40, Output::Display));
    let half_done = worker.step(half_done).expect("there is more to do");
    lose_device(&worker);
    finish(&mut worker, half_done);
    assert_eq!(answer(waiting).unwrap().pixels, expected.pixels);
    assert_eq!(recoveries(&worker), 1);
    let (probe, waiting) = task(&worker, |answer| {
        Work::Probe(Box::new(ProbeJob::new(ProbeOrder::default())), answer)
    });
    lose_device(&worker);
    finish(&mut worker, probe);
    assert!(
        answer(waiting)
            .unwrap()
            .irradiance
            .diffuse_w_m2
            .iter()
            .all(|e| *e > 0.0)
    );
    assert_eq!(recoveries(&worker), 2);
}

#[test]
fn a_device_that_fails_twice_under_an_order_is_an_error_to_that_order_alone() {
    let mut worker = worker();
    let (frame, waiting) = frame_task(&worker, order(16, Output::Linear));
    let frame = worker.step(frame).expect("there is more to do");
    lose_device(&worker);
    let frame = worker.step(frame).expect("it is tried again");
    // The new device prepares the tables, and is lost as well.
    let frame = worker.step(frame).expect("there is more to do");
    lose_device(&worker);
    finish(&mut worker, frame);
    assert!(matches!(answer(waiting), Err(RenderError::Device(_))));
    let (next, waiting) = frame_task(&worker, order(16, Output::Linear));
    finish(&mut worker, next);
    assert!(answer(waiting).is_ok());
    assert_eq!(recoveries(&worker), 2);
    assert_eq!(
        worker.shared.taken.load(Ordering::Acquire),
        0,
        "every place is given back"
    );
}

#[test]
fn an_abandoned_order_is_dropped_unworked() {
    let (queue, orders) = mpsc::channel();
    let worker = worker();
    let (task, waiting) = frame_task(&worker, order(16, Output::Linear));
    let shared = Arc::clone(&worker.shared);
    drop(waiting);
    let Task { work, .. } = task;
    queue.send(work).unwrap();
    drop(queue);
    // Without a device nothing could be worked.
    let worker = Worker {
        engine: None,
        ..worker
    };
    worker.run(&orders);
    assert_eq!(shared.taken.load(Ordering::Acquire), 0);
    assert_eq!(
        shared.device.lock().unwrap().recoveries,
        0,
        "no device was opened for it"
    );
}
