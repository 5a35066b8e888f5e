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
    for i in 0..3 {
        out.z[i] = landmark[i] - pose.position[i];
        out.jacobian_pose[i] = [0.0; 6];
        out.jacobian_pose[i][i] = -1.0;
        out.jacobian_landmark[i] = [0.0; 3];
        out.jacobian_landmark[i][i] = 1.0;
    }
    Ok(true)
}

pub fn place(pose: &Pose, z: &[f64], out: Placement<'_>) -> Answer {
    out.jacobian_z.fill(0.0);
    for i in 0..3 {
        out.landmark[i] = pose.position[i] + z[i];
        out.jacobian_pose[i] = [0.0; 6];
        out.jacobian_pose[i][i] = 1.0;
        out.jacobian_z[3 * i + i] = 1.0;
    }
    Ok(true)
}
