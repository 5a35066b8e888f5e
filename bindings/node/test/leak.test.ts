// SPDX-License-Identifier: BSD-3-Clause
// 10,000 filters, closed or only forgotten: memory stays, and callbacks are freed. Needs node --expose-gc.
import assert from 'node:assert/strict';
import test from 'node:test';
import { setImmediate as turn } from 'node:timers/promises';
import { Filter } from 'cairn-slam';
import { FRAME, place, predict } from './support.js';

const collect = globalThis.gc ?? assert.fail('run node with --expose-gc');
const ROUNDS = 10_000;
const FIRST = 2_000; // until then heaps and pools find their size
// The system's count of pages is rough, the count of objects is not.
const ALLOWED_RESIDENT = 32 << 20;
const ALLOWED_OBJECTS = 1 << 20;

interface Memory {
  resident: number;
  objects: number;
}

function use(): Filter {
  const filter = new Filter({ maxLandmarks: 10 });
  const custom = filter.addCustom({}, (...values) => filter instanceof Filter && predict(...values), place);
  filter.setLog(() => filter.closed);
  filter.update(custom, FRAME);
  filter.map.copy().close();
  return filter;
}

async function settled(): Promise<Memory> {
  for (let i = 0; i < 3; i += 1) {
    collect();
    await turn();
  }
  const { rss, heapUsed, external } = process.memoryUsage();
  return { resident: rss, objects: heapUsed + external };
}

/** Runs all rounds, and compares the memory after them with the memory after the first ones. */
async function constant(what: string, round: () => void): Promise<void> {
  let before: Memory | null = null;
  for (let i = 0; i < ROUNDS; i += 1) {
    if (i === FIRST) before = await settled();
    round();
    if (i % 500 === 0) await settled(); // finalizers run between turns of the event loop
  }
  const after = await settled();
  assert(before);
  const [resident, objects] = [after.resident - before.resident, after.objects - before.objects];
  const kib = (bytes: number): string => `${String(Math.round(bytes / 1024))} KiB`;
  console.log(
    `${what}: ${kib(resident)} more resident, ${kib(objects)} more objects after ${String(ROUNDS - FIRST)} filters`,
  );
  assert(resident < ALLOWED_RESIDENT && objects < ALLOWED_OBJECTS);
}

test('10,000 filters that are closed', () =>
  constant('closed', () => {
    use().close();
  }));

test('10,000 filters that are forgotten', () => constant('forgotten', use));

test('a callback is freed with its filter, also one that refers to it', async () => {
  const references = Array.from({ length: 20 }, (_, i) => {
    const filter = new Filter();
    const callback = (): boolean => filter.closed;
    filter.addCustom({}, callback);
    if (i % 2 === 0) filter.close();
    return new WeakRef(callback);
  });
  await settled();
  // One may still be on the stack.
  assert(references.filter((reference) => reference.deref() !== undefined).length <= 1);
});

test('a map keeps its filter, and a filter its callbacks', async () => {
  const { map } = use();
  await settled();
  assert.equal(map.size(), FRAME.length);
});
