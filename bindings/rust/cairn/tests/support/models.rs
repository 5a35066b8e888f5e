// SPDX-License-Identifier: BSD-3-Clause
//! The custom sensors of the conformance files (tests/conformance/README.md of the project).
use cairn::{Answer, Placement, Pose, Prediction};

type Matrix = [[f64; 3]; 3];

fn rotation(pose: &Pose) -> Matrix {
    let [w, x, y, z] = pose.quaternion;
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

fn difference(pose: &Pose, landmark: &[f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| landmark[i] - pose.position[i])
}

fn in_body(r: &Matrix, d: &[f64; 3], i: usize) -> f64 {
    r[0][i] * d[0] + r[1][i] * d[1] + r[2][i] * d[2]
}

fn body_point(pose: &Pose, landmark: &[f64; 3], out: Prediction<'_>) -> Answer {
    let (r, d) = (rotation(pose), difference(pose, landmark));
    for i in 0..out.z.len() {
        out.z[i] = in_body(&r, &d, i);
        let turns = [r[1][i] * d[2] - r[2][i] * d[1], r[2][i] * d[0] - r[0][i] * d[2], r[0][i] * d[1] - r[1][i] * d[0]];
        out.jacobian_pose[i] = [-r[0][i], -r[1][i], -r[2][i], turns[0], turns[1], turns[2]];
        out.jacobian_landmark[i] = [r[0][i], r[1][i], r[2][i]];
    }
    Ok(true)
}

pub fn predict(model: &str, pose: &Pose, landmark: &[f64; 3], out: Prediction<'_>) -> Answer {
    let (r, d) = (rotation(pose), difference(pose, landmark));
    match model {
        "body_point" => body_point(pose, landmark, out),
        "body_point_ahead" => match in_body(&r, &d, 0) {
            ahead if ahead < -5.0 => Err("too far behind".into()),
            ahead if ahead < 0.0 => Ok(false),
            _ => body_point(pose, landmark, out),
        },
        "range_only" => {
            let range = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
            if range < 0.1 {
                return Ok(false);
            }
            out.z[0] = range;
            let [x, y, z] = d.map(|along| along / range);
            out.jacobian_pose[0] = [-x, -y, -z, 0.0, 0.0, 0.0];
            out.jacobian_landmark[0] = [x, y, z];
            Ok(true)
        }
        "wrong_jacobian" => {
            let Prediction { z, jacobian_pose, jacobian_landmark } = out;
            body_point(pose, landmark, Prediction { z, jacobian_pose, jacobian_landmark: &mut *jacobian_landmark })?;
            jacobian_landmark[0][0] = r[0][0] + 0.5;
            Ok(true)
        }
        "unfinished" => {
            let Prediction { z, jacobian_pose, jacobian_landmark } = out;
            body_point(pose, landmark, Prediction { z, jacobian_pose: &mut *jacobian_pose, jacobian_landmark })?;
            jacobian_pose[0][0] = f64::NAN;
            Ok(true)
        }
        "refusing" => Ok(false),
        "aborting" => Err("aborted".into()),
        other => panic!("no function {other}"),
    }
}

pub fn place(model: &str, pose: &Pose, z: &[f64], out: Placement<'_>) -> Answer {
    let r = rotation(pose);
    match model {
        "body_point" => {
            let value = |i: usize| z.get(i).copied().unwrap_or(0.0);
            let c = [0, 1, 2].map(|i| r[i][0] * value(0) + r[i][1] * value(1) + r[i][2] * value(2));
            for i in 0..3 {
                out.landmark[i] = pose.position[i] + c[i];
                out.jacobian_z[z.len() * i..z.len() * (i + 1)].copy_from_slice(&r[i][..z.len()]);
            }
            *out.jacobian_pose = [
                [1.0, 0.0, 0.0, 0.0, c[2], -c[1]],
                [0.0, 1.0, 0.0, -c[2], 0.0, c[0]],
                [0.0, 0.0, 1.0, c[1], -c[0], 0.0],
            ];
            Ok(true)
        }
        "refusing" => Ok(false),
        "aborting" => Err("aborted".into()),
        other => panic!("no function {other}"),
    }
}
