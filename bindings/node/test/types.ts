// SPDX-License-Identifier: BSD-3-Clause
// What a compiler must refuse in a user's program. It is compiled, and not run: an error that is missing is an error.
import { Filter, Join, type Match, type Pose } from 'cairn-slam';

export function program(filter: Filter, sensor: number): [Match[], Pose] {
  // @ts-expect-error An id is a bigint.
  filter.update(sensor, [{ id: 1, z: [1, 2, 3] }]);
  // @ts-expect-error A value is missing.
  filter.update(sensor, [{ id: 1n }]);
  // @ts-expect-error There is no such option.
  new Filter({ maxLandmark: 10 });
  // @ts-expect-error There is no such way of joining.
  new Filter({ join: 7 });
  // @ts-expect-error It answers true or false.
  filter.addCustom({}, () => 1);
  // @ts-expect-error It may only be read.
  filter.closed = true;
  new Filter({ join: Join.Sparse, initialCovariance: new Float64Array(36), submapLandmarks: 60 });
  const { pose, covariance }: { pose: Pose; covariance: Float64Array } = filter.pose();
  return [filter.update(sensor, [{ id: 1n, z: covariance.subarray(0, 3) }]), pose];
}
