// SPDX-License-Identifier: BSD-3-Clause
// The callbacks that tests/conformance/README.md defines. Each operation is rounded on its own, as it says.
import type { CustomPlace, CustomPredict, Pose } from 'cairn-slam';

type Rows = [number[], number[], number[]];

function rotation({ quaternion }: Pose): Rows {
  const [w = 0, x = 0, y = 0, z = 0] = quaternion;
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
  ];
}

const at = (values: ArrayLike<number>, i: number): number => values[i] ?? NaN;
const difference = (a: ArrayLike<number>, b: ArrayLike<number>): number[] => [0, 1, 2].map((i) => at(a, i) - at(b, i));
const column = (R: Rows, i: number): number[] => R.map((row) => at(row, i));

/** The landmark in the body, value by value. */
function body(R: Rows, d: number[], i: number): number {
  const r = column(R, i);
  return at(r, 0) * at(d, 0) + at(r, 1) * at(d, 1) + at(r, 2) * at(d, 2);
}

const bodyPoint: CustomPredict = (pose, landmark, z, jacobianPose, jacobianLandmark) => {
  const R = rotation(pose);
  const d = difference(landmark, pose.position);
  const [d0 = 0, d1 = 0, d2 = 0] = d;
  for (let i = 0; i < z.length; i += 1) {
    const [r0 = 0, r1 = 0, r2 = 0] = column(R, i);
    z[i] = body(R, d, i);
    jacobianPose.set([-r0, -r1, -r2, r1 * d2 - r2 * d1, r2 * d0 - r0 * d2, r0 * d1 - r1 * d0], 6 * i);
    jacobianLandmark.set([r0, r1, r2], 3 * i);
  }
  return true;
};

const aborting = (): never => {
  throw new Error('the callback aborts');
};

const predict: Record<string, CustomPredict> = {
  body_point: bodyPoint,
  body_point_ahead: (pose, landmark, z, jacobianPose, jacobianLandmark) => {
    const ahead = body(rotation(pose), difference(landmark, pose.position), 0);
    if (ahead < -5) return aborting();
    return ahead < 0 ? false : bodyPoint(pose, landmark, z, jacobianPose, jacobianLandmark);
  },
  range_only: (pose, landmark, z, jacobianPose, jacobianLandmark) => {
    const [d0 = 0, d1 = 0, d2 = 0] = difference(landmark, pose.position);
    const r = Math.sqrt(d0 * d0 + d1 * d1 + d2 * d2);
    if (r < 0.1) return false;
    z[0] = r;
    jacobianPose.set([-(d0 / r), -(d1 / r), -(d2 / r), 0, 0, 0]);
    jacobianLandmark.set([d0 / r, d1 / r, d2 / r]);
    return true;
  },
  wrong_jacobian: (pose, landmark, z, jacobianPose, jacobianLandmark) => {
    bodyPoint(pose, landmark, z, jacobianPose, jacobianLandmark);
    jacobianLandmark[0] = at(rotation(pose)[0], 0) + 0.5;
    return true;
  },
  unfinished: (pose, landmark, z, jacobianPose, jacobianLandmark) => {
    bodyPoint(pose, landmark, z, jacobianPose, jacobianLandmark);
    jacobianPose[0] = NaN;
    return true;
  },
  refusing: () => false,
  aborting,
};

const place: Record<string, CustomPlace> = {
  body_point: (pose, z, landmark, jacobianPose, jacobianZ) => {
    const R = rotation(pose);
    const values = [0, 1, 2].map((i) => (i < z.length ? at(z, i) : 0));
    const c = R.map((row) => at(row, 0) * at(values, 0) + at(row, 1) * at(values, 1) + at(row, 2) * at(values, 2));
    const [c0 = 0, c1 = 0, c2 = 0] = c;
    landmark.set(c.map((value, i) => at(pose.position, i) + value));
    jacobianPose.set([1, 0, 0, 0, c2, -c1, 0, 1, 0, -c2, 0, c0, 0, 0, 1, c1, -c0, 0]);
    R.forEach((row, i) => {
      jacobianZ.set(row.slice(0, z.length), z.length * i);
    });
    return true;
  },
  refusing: () => false,
  aborting,
};

export const callbacks = { predict, place } as {
  predict: Record<string, (...values: never[]) => boolean>;
  place: Record<string, (...values: never[]) => boolean>;
};
