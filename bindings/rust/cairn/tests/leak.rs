// SPDX-License-Identifier: BSD-3-Clause
//! Memory stays constant over 10,000 lives of a filter with everything that it owns.
#![cfg(target_os = "linux")]
mod support {
    #[allow(dead_code)]
    pub mod scene;
}
use cairn::{Filter, FilterOptions};
use support::scene::{custom, place, points, predict};

/// Resident memory of this process, KiB.
fn resident() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with("VmRSS:")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}

fn one_life() {
    let owned = Box::new([1_u8; 4096]);
    let options = FilterOptions { max_landmarks: 4, max_observations: 4, max_sensors: 1, ..Default::default() };
    let mut filter = Filter::new(&options).unwrap();
    let model = move |pose: &cairn::Pose, landmark: &[f64; 3], out: cairn::Prediction<'_>| {
        assert_eq!(owned[0], 1);
        predict(pose, landmark, out)
    };
    let sensor = filter.add_custom(&custom(), model, place).unwrap();
    filter.set_log(|_| {}).unwrap();
    filter.update(sensor, &points()).unwrap();
    filter.map().copy().unwrap().landmarks().unwrap();
    filter.predict_wheels(-1.0, 0.0, 0.0).unwrap_err();
}

#[test]
fn ten_thousand_lives_take_no_memory() {
    (0..1_000).for_each(|_| one_life());
    let before = resident();
    (0..10_000).for_each(|_| one_life());
    let grown = resident().saturating_sub(before);
    println!("grown by {grown} KiB over 10,000 lives");
    assert!(grown < 256, "resident memory grew by {grown} KiB");
}
