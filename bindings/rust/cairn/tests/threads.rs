// SPDX-License-Identifier: BSD-3-Clause
//! Handles move between threads, queries run side by side, and every message is its own.
mod support {
    #[allow(dead_code)]
    pub mod scene;
}
use cairn::*;
use std::sync::{Arc, Barrier, Mutex};
use std::thread;
use support::scene::{bits, filter, filter_with_points, points};

#[test]
fn handles_are_send_and_sync() {
    fn check<T: Send + Sync>() {}
    check::<Filter>();
    check::<MapCopy>();
    check::<&Map>();
    check::<Team>();
    check::<World>();
    check::<Fleet>();
    check::<Error>();
}

#[test]
fn queries_run_side_by_side() {
    let (filter, _) = filter_with_points();
    let expected = bits(&filter);
    thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| (0..500).for_each(|_| assert_eq!(bits(&filter), expected)));
        }
    });
}

#[test]
fn threads_that_share_a_filter_take_turns() {
    let (filter, sensor) = filter_with_points();
    let filter = Arc::new(Mutex::new(filter));
    thread::scope(|scope| {
        for _ in 0..4 {
            let filter = Arc::clone(&filter);
            scope.spawn(move || {
                for _ in 0..100 {
                    filter.lock().unwrap().update(sensor, &points()).unwrap();
                }
            });
        }
    });
    assert_eq!(filter.lock().unwrap().health().unwrap().updates, 401);
}

#[test]
fn sixteen_threads_that_fail_at_once_get_their_own_messages() {
    let barrier = Barrier::new(16);
    thread::scope(|scope| {
        for number in 0..16_u64 {
            let barrier = &barrier;
            scope.spawn(move || {
                let mut filter = filter();
                barrier.wait();
                for round in 0..200 {
                    let id = 1_000_000 * (number + 1) + round;
                    let error = filter.remove_landmark(id).unwrap_err();
                    assert!(error.message().contains(&id.to_string()), "{id}: {error}");
                    thread::yield_now();
                }
            });
        }
    });
}
