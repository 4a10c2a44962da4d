//! The queue: places, order, cancellation, and work that need not be done again.

use crate::scenes::{frame, order, renderer, scene};
use serde_json::json;
use std::{
    sync::Arc,
    task::{Context, Poll, Waker},
    thread::sleep,
    time::Duration,
};
use welkin_render::{Renderer, RendererSettings};
use welkin_scene::{
    Quality, Scene,
    renderer::{FrameOrder, Output, Pixels, Priority, ProbeOrder, Render, RenderError, Reply},
};

/// A renderer of a test's own.
fn with_places(queue_places: usize) -> Renderer {
    Renderer::start(RendererSettings {
        queue_places,
        ..RendererSettings::default()
    })
    .unwrap()
}

fn small() -> FrameOrder {
    order(Scene::clear(), 16, 9, Quality::Preview, Output::Display)
}

/// Work for a while: sixteen million pixels a thousand rows.
fn long(height_px: u32) -> FrameOrder {
    let order = order(
        Scene::clear(),
        16_384,
        height_px,
        Quality::Preview,
        Output::Display,
    );
    FrameOrder {
        priority: Priority::Batch,
        ..order
    }
}

/// Some milliseconds of batch work, in several tiles.
fn large(elevation_deg: f64) -> FrameOrder {
    let scene = scene(json!({"sun": {"position": {"azimuth_deg": 10, "elevation_deg": elevation_deg}}}));
    let order = order(scene, 1500, 1500, Quality::Preview, Output::Display);
    FrameOrder {
        priority: Priority::Batch,
        ..order
    }
}

/// The answer, if it is there.
fn ready<T>(reply: &mut Reply<T>) -> Option<Result<T, RenderError>> {
    match reply.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(answer) => Some(answer),
        Poll::Pending => None,
    }
}

#[test]
fn a_size_out_of_range_is_refused_by_name() {
    for (width_px, height_px) in [(0, 9), (16, 0), (16_385, 1), (1, 16_385), (u32::MAX, u32::MAX)] {
        let answer = pollster::block_on(renderer().frame(FrameOrder {
            width_px,
            height_px,
            ..small()
        }));
        let Err(RenderError::Size {
            width_px: w,
            height_px: h,
            reason,
        }) = answer
        else {
            panic!("{answer:?}")
        };
        assert_eq!((w, h), (width_px, height_px));
        assert!(reason.contains("16384"), "{reason}");
    }
    assert_eq!(renderer().device().max_side_px, 16_384);
}

#[test]
fn a_full_queue_says_busy_and_a_dropped_order_frees_its_place() {
    let renderer = with_places(2);
    let dropped = renderer.frame(long(4096));
    let mut kept = renderer.frame(long(1024));
    let refused = pollster::block_on(renderer.frame(small()));
    let Err(RenderError::Busy { retry_after_s }) = refused else {
        panic!("{refused:?}")
    };
    assert!((1..=60).contains(&retry_after_s), "{retry_after_s}");
    assert!(matches!(
        pollster::block_on(renderer.probe(ProbeOrder::default())),
        Err(RenderError::Busy { .. })
    ));
    drop(dropped);
    loop {
        match pollster::block_on(renderer.frame(small())) {
            Ok(_) => break,
            Err(RenderError::Busy { .. }) => sleep(Duration::from_millis(1)),
            Err(other) => panic!("{other}"),
        }
    }
    // The two take turns tile by tile. Were the dropped one, four times as long, still worked on, the place could only
    // have come from the other.
    assert!(ready(&mut kept).is_none(), "the dropped order kept its place");
    assert!(pollster::block_on(kept).is_ok());
}

#[test]
fn people_go_before_batches_and_batches_go_on() {
    let renderer = with_places(8);
    let mut batch = renderer.frame(large(30.0));
    let mut other = renderer.frame(large(31.0));
    let frame = pollster::block_on(renderer.frame(small())).unwrap();
    assert_eq!(frame.width_px, 16);
    assert!(
        ready(&mut batch).is_none() && ready(&mut other).is_none(),
        "the small frame waited for the batch"
    );
    // Probes too are somebody's.
    pollster::block_on(renderer.probe(ProbeOrder::default())).unwrap();
    assert_eq!(pollster::block_on(batch).unwrap().width_px, 1500);
    assert_eq!(pollster::block_on(other).unwrap().width_px, 1500);
}

#[test]
fn ten_orders_at_once_are_all_answered() {
    let renderer = with_places(10);
    let suns = (0..10).map(|i| 5.0 + 7.0 * f64::from(i));
    let orders: Vec<_> = suns
        .map(|elevation_deg| {
            let scene =
                scene(json!({"sun": {"position": {"azimuth_deg": 180, "elevation_deg": elevation_deg}}}));
            order(scene, 40, 30, Quality::Preview, Output::Linear)
        })
        .collect();
    let replies: Vec<_> = orders.iter().map(|order| renderer.frame(order.clone())).collect();
    for (order, reply) in orders.iter().zip(replies) {
        let among_others = pollster::block_on(reply).unwrap();
        // Each its own frame, not its neighbour's.
        assert_eq!(among_others.facts.sun, order.scene.sun_place());
        assert_eq!(among_others.pixels, frame(order.clone()).pixels);
    }
}

#[test]
fn work_begins_with_the_call_not_with_the_first_poll() {
    let renderer = with_places(4);
    let mut first = renderer.frame(small());
    let later = FrameOrder {
        width_px: 17,
        ..small()
    };
    pollster::block_on(renderer.frame(later)).unwrap();
    assert!(
        ready(&mut first)
            .expect("orders of one priority go in turn")
            .is_ok()
    );
}

#[test]
fn what_was_ordered_is_answered_after_the_last_renderer_is_gone() {
    let renderer = with_places(4);
    let clone = renderer.clone();
    drop(renderer);
    let reply = clone.frame(small());
    drop(clone);
    assert!(pollster::block_on(reply).is_ok());
}

#[test]
fn an_equal_order_costs_no_pass_and_gives_the_same_bytes() {
    // From two heights: the radiance behind a picture is kept, and would be all that the second order asks for.
    for (output, z) in [(Output::Display, 77), (Output::Linear, 78)] {
        let scene = scene(json!({"camera": {"position_m": [0, 0, z]}}));
        let asked = FrameOrder {
            width_px: 120,
            height_px: 80,
            ..order(scene, 1, 1, Quality::Final, output)
        };
        let first = frame(asked.clone());
        assert!(!first.passes.is_empty());
        let batch = FrameOrder {
            priority: Priority::Batch,
            ..asked.clone()
        };
        let second = frame(batch);
        assert!(second.passes.is_empty(), "{:?}", second.passes);
        assert!(second.pixels == first.pixels && second.facts == first.facts);
        // Another renderer, with no memory of it.
        let elsewhere = pollster::block_on(with_places(1).frame(asked)).unwrap();
        assert!(elsewhere.pixels == first.pixels, "{output:?}");
    }
}

#[test]
fn preview_and_final_quality_agree() {
    let of = |quality: Quality| {
        let Pixels::Linear(values) = &frame(order(Scene::clear(), 60, 40, quality, Output::Linear)).pixels
        else {
            panic!("not radiance")
        };
        values.clone()
    };
    let (preview, last) = (of(Quality::Preview), of(Quality::Final));
    assert_ne!(preview, last);
    for (a, b) in preview.iter().zip(&last) {
        // What the eye does not see while it drags the sun.
        assert!((a - b).abs() < 0.03 * b, "{a} {b}");
    }
}

#[test]
fn clones_share_one_device() {
    let clone = renderer().clone();
    assert_eq!(clone.device(), renderer().device());
    assert_eq!(clone.device().recoveries, 0);
    let shared: Arc<dyn Render> = Arc::new(clone);
    assert!(pollster::block_on(shared.frame(small())).is_ok());
}
