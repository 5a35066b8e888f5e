// SPDX-License-Identifier: BSD-3-Clause
//! Small inputs for tests.
use cairn::{Answer, Custom, Filter, FilterOptions, Observation, Placement, Pose, Prediction};

pub fn filter() -> Filter {
    Filter::new(&FilterOptions { max_landmarks: 50, ..Default::default() }).unwrap()
}

/// A filter whose sensor gives points, with two landmarks.
pub fn filter_with_points() -> (Filter, cairn::Sensor) {
    let mut filter = filter();
    let sensor = filter.add_cartesian(&Default::default()).unwrap();
    filter.predict_twist(0.1, &[1.0, 0.0, 0.0], &[0.0; 3]).unwrap();
    filter.update(sensor, &points()).unwrap();
    (filter, sensor)
}

pub fn points() -> [Observation; 2] {
    [Observation::new(1, [4.0, 1.0, 0.5]), Observation::new(u64::MAX - 1, [3.0, -2.0, 0.0])]
}

/// All bits of what a filter tells.
pub fn bits(filter: &Filter) -> Vec<u64> {
    let (pose, covariance) = filter.pose().unwrap();
    let mut all = [&pose.position[..], &pose.quaternion, &covariance].concat();
    for landmark in filter.map().landmarks().unwrap() {
        all.extend(landmark.position);
        all.extend(landmark.covariance);
        all.push(landmark.observations as f64);
    }
    all.into_iter().map(f64::to_bits).collect()
}

/// A model of a sensor whose axes are those of the map: z = landmark - position.
pub fn custom() -> Custom {
    Custom { sigma: [0.1; 3], ..Default::default() }
}

pub fn predict(pose: &Pose, landmark: &[f64; 3], out: Prediction<'_>) -> Answer {
    out.jacobian_pose.copy_from_slice(&pose_columns(-1.0));
    out.jacobian_landmark.copy_from_slice(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    out.z.copy_from_slice(&[0, 1, 2].map(|i| landmark[i] - pose.position[i]));
    Ok(true)
}

pub fn place(pose: &Pose, z: &[f64], out: Placement<'_>) -> Answer {
    *out.jacobian_pose = pose_columns(1.0);
    out.jacobian_z.copy_from_slice(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    *out.landmark = [0, 1, 2].map(|i| pose.position[i] + z[i]);
    Ok(true)
}

/// The derivative by [dp; dtheta] of a value that depends on the position.
fn pose_columns(sign: f64) -> [[f64; 6]; 3] {
    [[sign, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0, sign, 0.0, 0.0, 0.0, 0.0], [0.0, 0.0, sign, 0.0, 0.0, 0.0]]
}
