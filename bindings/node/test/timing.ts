// SPDX-License-Identifier: BSD-3-Clause
// One update of 6 observations beside the same update in C (update.c): timing.js PROGRAM_IN_C
// Prints the medians, in turns. A time is no test: it fails only if it cannot measure.
import { execFileSync } from 'node:child_process';
import { Filter, Vehicle, type ObservationInput } from 'cairn-slam';

const LANDMARKS = 12;
const SEEN = 6;
const STEPS = 4000;
const WARM_UP = 1000;
const ROUNDS = 5;

const median = (values: number[]): number => values.sort((a, b) => a - b)[Math.floor(values.length / 2)] ?? NaN;

function updates(): number {
  using filter = new Filter({ maxLandmarks: LANDMARKS, vehicle: Vehicle.Planar });
  const sensor = filter.addCartesian();
  const durations: number[] = [];
  for (let step = 0; step < STEPS; step += 1) {
    filter.predictTwist(0.1, [0.1, 0, 0], [0, 0, 0]);
    const observations: ObservationInput[] = [];
    for (let i = 0; i < SEEN; i += 1) {
      const id = (SEEN * step + i) % LANDMARKS;
      observations.push({
        id: BigInt(id),
        z: [2 * (id % 4) - 0.01 * (step + 1) + 0.001 * (step % 7), Math.floor(id / 4) - 1 + 0.001 * (step % 5), 0],
      });
    }
    const start = process.hrtime.bigint();
    const matches = filter.update(sensor, observations);
    const end = process.hrtime.bigint();
    if (matches.length !== SEEN) throw new Error('a match is missing');
    if (step >= WARM_UP) durations.push(Number(end - start) / 1000);
  }
  return median(durations);
}

const [program = ''] = process.argv.slice(2);
const node: number[] = [];
const c: number[] = [];
for (let round = 0; round < ROUNDS; round += 1) {
  node.push(updates());
  c.push(Number(execFileSync(program, { encoding: 'utf8' })));
}
const shown = (values: number[]): string => values.map((value) => value.toFixed(1)).join(' ');
console.log(`Node, microseconds an update: ${shown(node)}`);
console.log(`C, microseconds an update:    ${shown(c)}`);
console.log(`over C: ${(median(node) - median(c)).toFixed(1)} microseconds (median of ${String(ROUNDS)} rounds)`);
