// SPDX-License-Identifier: BSD-3-Clause
//! Custom sensors and logs: answers, errors, panics, and the end of what they own.
mod support {
    #[allow(dead_code)]
    pub mod scene;
}
use cairn::*;
use std::error::Error as _;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};
use std::sync::Arc;
use support::scene::{bits, custom, filter, place, points, predict};

/// How a model behaves that the test can switch while the filter owns it.
const ANSWER: u32 = 0;
const NOT_VISIBLE: u32 = 1;
const ERROR: u32 = 2;
const PANIC: u32 = 3;

/// A filter with a custom sensor and two landmarks, and the switch of the sensor's model.
fn switched() -> (Filter, Sensor, Arc<AtomicU32>) {
    let switch = Arc::new(AtomicU32::new(ANSWER));
    let inside = Arc::clone(&switch);
    let mut filter = filter();
    let model = move |pose: &Pose, landmark: &[f64; 3], out: Prediction<'_>| match inside.load(Relaxed) {
        NOT_VISIBLE => Ok(false),
        ERROR => Err("the lens is dirty".into()),
        PANIC => panic!("the model fails"),
        _ => predict(pose, landmark, out),
    };
    let sensor = filter.add_custom(&custom(), model, place).unwrap();
    filter.predict_twist(0.1, &[1.0, 0.0, 0.0], &[0.0; 3]).unwrap();
    let matches = filter.update(sensor, &points()).unwrap();
    assert!(matches.iter().all(|found| found.result == MatchResult::NEW), "{matches:?}");
    (filter, sensor, switch)
}

#[test]
fn answers_update_landmarks_or_refuse_observations() {
    let (mut filter, sensor, switch) = switched();
    filter.predict_twist(0.1, &[1.0, 0.0, 0.0], &[0.0; 3]).unwrap();
    let matches = filter.update(sensor, &points()).unwrap();
    assert!(matches.iter().all(|found| found.result == MatchResult::MATCHED), "{matches:?}");
    switch.store(NOT_VISIBLE, Relaxed);
    let matches = filter.update(sensor, &points()).unwrap();
    assert!(matches.iter().all(|found| found.reason == Reason::NO_IMAGE), "{matches:?}");
}

#[test]
fn an_error_aborts_the_call_and_is_the_source() {
    let (mut filter, sensor, switch) = switched();
    let before = bits(&filter);
    switch.store(ERROR, Relaxed);
    let error = filter.update(sensor, &points()).unwrap_err();
    assert_eq!(error.status(), Status::ERROR_CALLBACK);
    assert_eq!(error.source().unwrap().to_string(), "the lens is dirty");
    assert_eq!(bits(&filter), before);
    // The next failure has no source left over.
    assert!(filter.predict_wheels(-1.0, 0.0, 0.0).unwrap_err().source().is_none());
    switch.store(ANSWER, Relaxed);
    filter.update(sensor, &points()).unwrap();
}

#[test]
fn a_panic_aborts_the_call_and_continues_in_the_caller() {
    let (mut filter, sensor, switch) = switched();
    let before = bits(&filter);
    switch.store(PANIC, Relaxed);
    let panic = catch_unwind(AssertUnwindSafe(|| filter.update(sensor, &points()))).unwrap_err();
    assert_eq!(panic.downcast_ref::<&str>(), Some(&"the model fails"));
    assert_eq!(bits(&filter), before);
    switch.store(ANSWER, Relaxed);
    filter.update(sensor, &points()).unwrap();
}

#[test]
fn jacobians_are_checked() {
    let pose = Pose { position: [1.0, 2.0, 3.0], ..Pose::identity() };
    let landmark = [4.0, -1.0, 2.0];
    assert!(custom().check(predict, place, &pose, &landmark).unwrap() < 1e-6);
    let wrong = |pose: &Pose, landmark: &[f64; 3], out: Prediction<'_>| {
        let Prediction { z, jacobian_pose, jacobian_landmark } = out;
        predict(pose, landmark, Prediction { z, jacobian_pose, jacobian_landmark: &mut *jacobian_landmark })?;
        jacobian_landmark[2][2] = 0.5;
        Ok(true)
    };
    let worst = custom().check_observer(wrong, &pose, &landmark).unwrap();
    assert!((worst - 0.5).abs() < 1e-6, "{worst}");
    let fails = |_: &Pose, _: &[f64; 3], _: Prediction<'_>| -> Answer { Err("no model".into()) };
    let error = custom().check_observer(fails, &pose, &landmark).unwrap_err();
    assert_eq!((error.status(), error.source().unwrap().to_string()), (Status::ERROR_CALLBACK, "no model".into()));
}

#[test]
fn what_a_model_owns_ends_with_the_filter_or_with_a_refused_call() {
    let (filter, _, switch) = switched();
    assert_eq!(Arc::strong_count(&switch), 2);
    drop(filter);
    assert_eq!(Arc::strong_count(&switch), 1);
    let (mut filter, inside) = (support::scene::filter(), Arc::clone(&switch));
    let refused = Custom { rows: 9, ..custom() };
    let error = filter
        .add_custom_observer(&refused, move |pose, landmark, out| {
            inside.fetch_add(1, Relaxed);
            predict(pose, landmark, out)
        })
        .unwrap_err();
    assert_eq!((error.status(), Arc::strong_count(&switch)), (Status::ERROR_ARGUMENT, 1));
}

struct PanicsAtItsEnd;

impl Drop for PanicsAtItsEnd {
    fn drop(&mut self) {
        panic!("the end fails");
    }
}

#[test]
fn a_panic_at_the_end_of_a_closure_does_not_cross_c() {
    let mut filter = filter();
    let owned = PanicsAtItsEnd;
    filter
        .add_custom_observer(&custom(), move |pose, landmark, out| {
            let _owned = &owned;
            predict(pose, landmark, out)
        })
        .unwrap();
    let panic = catch_unwind(AssertUnwindSafe(|| drop(filter))).unwrap_err();
    assert_eq!(panic.downcast_ref::<&str>(), Some(&"the end fails"));
}

/// A filter in which only the gate of a whole batch can refuse, and a frame that this gate refuses.
fn contradicted() -> (Filter, Sensor, [Observation; 4]) {
    let options = FilterOptions { max_landmarks: 50, gate_probability: 1.0, ..Default::default() };
    let mut filter = Filter::new(&options).unwrap();
    let sensor = filter.add_cartesian(&Default::default()).unwrap();
    let mut frame = [[4.0, 0.0], [-4.0, 0.0], [0.0, 4.0], [0.0, -4.0]].map(|[x, y]| Observation::new(0, [x, y, 0.0]));
    for (id, observation) in frame.iter_mut().enumerate() {
        observation.id = id as u64;
    }
    filter.update(sensor, &frame).unwrap();
    for observation in &mut frame {
        observation.z = observation.z.map(|value| 2.0 * value);
    }
    (filter, sensor, frame)
}

#[test]
fn a_log_receives_lines_until_it_is_replaced() {
    let (mut filter, sensor, frame) = contradicted();
    let lines = Arc::new(AtomicU32::new(0));
    let inside = Arc::clone(&lines);
    filter
        .set_log(move |line| {
            assert!(!line.is_empty());
            inside.fetch_add(1, Relaxed);
        })
        .unwrap();
    filter.update(sensor, &frame).unwrap();
    assert!(lines.load(Relaxed) > 0, "the case writes no line");
    assert_eq!(Arc::strong_count(&lines), 2);
    filter.set_log(|_| panic!("the log fails")).unwrap();
    assert_eq!(Arc::strong_count(&lines), 1);
    let panic = catch_unwind(AssertUnwindSafe(|| filter.update(sensor, &frame))).unwrap_err();
    assert_eq!(panic.downcast_ref::<&str>(), Some(&"the log fails"));
    filter.clear_log().unwrap();
    filter.update(sensor, &frame).unwrap();
}
