// SPDX-License-Identifier: BSD-3-Clause
// What several tests need.
import assert from 'node:assert/strict';
import { CairnError, Filter, Status, type CustomPlace, type CustomPredict, type ObservationInput } from 'cairn-slam';
import { callbacks } from './callbacks.js';

export const predict = callbacks.predict['body_point'] as CustomPredict;
export const place = callbacks.place['body_point'] as CustomPlace;

/** Three landmarks around the start. */
export const FRAME: readonly ObservationInput[] = [
  { id: 1n, z: [5, 1, 0] },
  { id: 2n, z: [4, -2, 1] },
  { id: 3n, z: [6, 0, -1] },
];

/** A filter with a sensor that gives points, after one frame. */
export function started(): { filter: Filter; points: number } {
  const filter = new Filter({ trajectoryPoses: 10 });
  const points = filter.addCartesian();
  filter.predictTwist(0.1, [1, 0, 0], [0, 0, 0.1]);
  filter.update(points, FRAME);
  return { filter, points };
}

/** All that a filter tells. */
export function state(filter: Filter): unknown {
  const { associationSeconds: _, ...update } = filter.lastUpdate();
  return [filter.pose(), filter.map.landmarks(), update, filter.health(), filter.trajectory(0n)];
}

/** Expects an error of the library. */
export function refused(status: Status, message: RegExp | string): (error: unknown) => true {
  return (error) => {
    assert(error instanceof CairnError, String(error));
    assert(error instanceof Error);
    assert.equal(error.status, status);
    if (typeof message === 'string') assert.equal(error.message, message);
    else assert.match(error.message, message);
    return true;
  };
}
