// SPDX-License-Identifier: BSD-3-Clause
//! Wrong calls are errors with the library's message, and change nothing.
mod support {
    #[allow(dead_code)]
    pub mod scene;
}
use cairn::*;
use std::error::Error as _;
use support::scene::{bits, filter, filter_with_points, points};

#[test]
fn an_error_has_status_and_message() {
    let mut filter = filter();
    let error = filter.predict_wheels(-1.0, 1.0, 1.0).unwrap_err();
    assert_eq!(error.status(), Status::ERROR_ARGUMENT);
    assert_eq!(error.status().name(), "CAIRN_ERROR_ARGUMENT");
    assert!(error.message().starts_with("dt "), "{error}");
    assert_eq!(error.to_string(), error.message());
    assert!(error.source().is_none());
    assert_eq!(last_message(), error.message());
}

#[test]
fn a_wrong_call_changes_nothing() {
    let (mut filter, sensor) = filter_with_points();
    let before = bits(&filter);
    let nan = Observation::new(1, [f64::NAN, 0.0, 0.0]);
    assert_eq!(filter.update(sensor, &[nan]).unwrap_err().status(), Status::ERROR_ARGUMENT);
    assert_eq!(filter.update(Sensor(7), &points()).unwrap_err().status(), Status::ERROR_NOT_FOUND);
    assert_eq!(filter.remove_landmark(99).unwrap_err().status(), Status::ERROR_NOT_FOUND);
    assert_eq!(bits(&filter), before);
}

#[test]
fn slices_of_the_wrong_length_are_refused_before_c_reads_them() {
    let (mut filter, sensor) = filter_with_points();
    let before = bits(&filter);
    let mut matches = [Match::default()];
    let error = filter.update_into(sensor, &points(), &mut matches).unwrap_err();
    assert_eq!(error.message(), "matches must hold 2 values, and holds 1");
    let error = filter.update_linear(&[0.1, 0.2], &[1.0; 3], None, &[1], &[0.0; 6]).unwrap_err();
    assert_eq!(error.message(), "covariance must hold 4 values, and holds 3");
    let error = filter.update_linear(&[0.1], &[1.0], Some(&[0.0; 5]), &[1], &[0.0; 3]).unwrap_err();
    assert_eq!(error.message(), "jacobian_pose must hold 6 values, and holds 5");
    let error = filter.update_linear(&[0.1], &[1.0], None, &[1], &[0.0; 4]).unwrap_err();
    assert_eq!(error.message(), "jacobian_landmarks must hold 3 values, and holds 4");
    assert_eq!(error.status(), Status::ERROR_ARGUMENT);
    assert_eq!(bits(&filter), before);
}

#[test]
fn constants_without_a_name_are_refused_by_the_library() {
    let options = FilterOptions { join: Join(7), ..Default::default() };
    let error = Filter::new(&options).unwrap_err();
    assert!(error.message().contains("join"), "{error}");
    assert_eq!(format!("{:?} {:?}", Join(7), Join::SPARSE), "Join(7) Join::SPARSE");
    let doubts = Doubts::NIS | Doubts::BLIND;
    assert_eq!(format!("{doubts:?}"), "Doubts(NIS | BLIND)");
    assert_eq!(doubts.reasons().collect::<Vec<_>>(), [Doubts::NIS, Doubts::BLIND]);
}

#[test]
fn ids_have_64_bits() {
    let (filter, _) = filter_with_points();
    let ids: Vec<u64> = filter.map().landmarks().unwrap().iter().map(|landmark| landmark.id).collect();
    assert_eq!(ids, [1, u64::MAX - 1]);
    assert_eq!(filter.map().landmark((1 << 53) + 1).unwrap_err().status(), Status::ERROR_NOT_FOUND);
    assert_eq!(ID_NONE, id_none());
}

#[test]
fn a_query_uses_the_memory_of_the_caller() {
    let (filter, _) = filter_with_points();
    let mut landmarks = Vec::with_capacity(2);
    let memory = landmarks.as_ptr();
    filter.map().landmarks_into(&mut landmarks).unwrap();
    assert_eq!((landmarks.len(), landmarks.as_ptr()), (2, memory));
    let mut short = Vec::with_capacity(1); // the library says how many there are, and the query is made again
    filter.map().landmarks_into(&mut short).unwrap();
    assert_eq!(short, landmarks);
    filter.map().nearest_into(&[0.0; 3], 0, &mut short).unwrap();
    assert!(short.is_empty());
}

#[test]
fn a_refused_merge_fills_in_its_report() {
    let (filter, _) = filter_with_points();
    let mut copy = filter.map().copy().unwrap();
    let mut report = MergeReport::default();
    let error = copy.merge_into(filter.map(), None, &mut report).unwrap_err();
    assert_eq!(error.status(), Status::ERROR_STATE); // both hold landmarks of the same filter
    assert_eq!(copy.size().unwrap(), 2);
    copy.close();
    filter.close();
}

#[test]
fn a_drive_ends_with_none_and_with_an_error() {
    let mut world = World::new(&WorldOptions { landmarks: 10, ..Default::default() }).unwrap();
    let mut steps = 0;
    while let Some(step) = world.next_step().unwrap() {
        assert_eq!(step.motion_count as usize, world.motions().unwrap().len());
        steps += 1;
    }
    assert_eq!(steps, world.steps().unwrap());
    assert_eq!(world.advance().unwrap_err().status(), Status::ERROR_STATE);
    assert_eq!(sim_last_message(), world.advance().unwrap_err().message());
}

#[test]
fn the_version_is_that_of_the_library() {
    assert_eq!(version_number() / 100, VERSION / 100);
    assert!(version().starts_with(&format!("{}.{}.", VERSION / 10_000, VERSION / 100 % 100)));
    assert!(has("errors") && !has("nonsense") && !has("with\0zero"));
    assert!(!build().is_empty());
}
