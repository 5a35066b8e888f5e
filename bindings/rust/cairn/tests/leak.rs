// SPDX-License-Identifier: BSD-3-Clause
//! Memory stays constant over 10,000 lives of a filter with everything that it owns.
#![cfg(target_os = "linux")]
mod support {
    #[allow(dead_code)]
    pub mod scene;
}
use support::scene::{custom, filter, place, points, predict};

/// Resident memory of this process, KiB.
fn resident() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with("VmRSS:")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}

fn one_life(keep: &mut Vec<Box<[u8; 64]>>) {
    let owned = Box::new([1_u8; 4096]);
    let mut filter = filter();
    let model = move |pose: &cairn::Pose, landmark: &[f64; 3], out: cairn::Prediction<'_>| {
        assert_eq!(owned[0], 1);
        predict(pose, landmark, out)
    };
    let sensor = filter.add_custom(&custom(), model, place).unwrap();
    filter.set_log(|_| {}).unwrap();
    filter.update(sensor, &points()).unwrap();
    filter.map().copy().unwrap().landmarks().unwrap();
    filter.predict_wheels(-1.0, 0.0, 0.0).unwrap_err();
    if std::env::var_os("CAIRN_LEAK").is_some() {
        keep.push(Box::new([1; 64])); // the test must see 64 bytes a life
    }
}

#[test]
fn ten_thousand_lives_take_no_memory() {
    let mut keep = Vec::with_capacity(10_000);
    (0..1_000).for_each(|_| one_life(&mut keep));
    let before = resident();
    (0..10_000).for_each(|_| one_life(&mut keep));
    let grown = resident().saturating_sub(before);
    println!("grown by {grown} KiB over 10,000 lives");
    assert!(grown < 256, "resident memory grew by {grown} KiB");
}
