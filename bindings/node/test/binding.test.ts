// SPDX-License-Identifier: BSD-3-Clause
// Errors, wrong input, lifetimes, callbacks, threads, loading; run against the installed package.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import { Worker } from 'node:worker_threads';
import * as cairn from 'cairn-slam';
import { Filter, LandmarkMap, Result, Status, Team, TeamMode, Vehicle, World } from 'cairn-slam';
import { FRAME, place, predict, refused, started, state } from './support.js';

const setting = (name: string): string => process.env[name] ?? assert.fail(`${name} is not set`);

/** Runs a program as a user's own: of this project, with the package that is installed. */
function run(
  source: string,
  environment: NodeJS.ProcessEnv = {},
): { status: number | null; stdout: string; stderr: string } {
  const file = path.join(process.cwd(), `program-${String(process.pid)}.mjs`);
  writeFileSync(file, source);
  return spawnSync(process.execPath, [file], { encoding: 'utf8', env: { ...process.env, ...environment } });
}

/** What a wrong type of TypeScript is at run time. */
const wrong = <T>(value: unknown): T => value as T;

test('the examples of the README run', () => {
  const examples = [...readFileSync(setting('CAIRN_TEST_README'), 'utf8').matchAll(/```js\n(.*?)```/gs)].map(
    ([, code]) => code,
  );
  const [first = '', second = ''] = examples;
  const checks = [
    `${first}\nconsole.log(covariance.length, [...pose.position].every(Number.isFinite));`,
    `${second}\nfilter.update(filter.addCartesian(), [{ id: 1n, z: [3, 4, 0] }]);
     console.log(filter.update(beacon, [{ id: 1n, z: [5.01, 0, 0] }])[0].result === 1);`,
  ];
  assert.equal(examples.length, checks.length);
  for (const check of checks) {
    const { status, stderr, stdout } = run(check);
    assert.equal(stderr, '');
    assert.equal(status, 0);
    assert.match(stdout, /true\n$/);
  }
});

test('an error has status, code, message and stack of the call', () => {
  const filter = new Filter();
  assert.throws(
    () => {
      filter.predictWheels(-1, 1, 1);
    },
    refused(Status.ErrorArgument, 'dt must be > 0, and is -1'),
  );
  try {
    filter.predictWheels(-1, 1, 1);
  } catch (error) {
    assert(error instanceof cairn.CairnError);
    assert.equal(error.name, 'CairnError');
    assert.equal(error.code, 'CAIRN_ERROR_ARGUMENT');
    assert.match(error.stack ?? '', /predictWheels/);
  }
});

test('wrong types and shapes are TypeErrors that name the argument, and change nothing', () => {
  const { filter, points } = started();
  const before = state(filter);
  const cases: [() => unknown, string][] = [
    [() => filter.update(points, [{ id: 1n, z: [1, 2] }]), 'observations[0].z must have 3 numbers, and has 2'],
    [
      () => filter.update(points, [{ id: 1n, z: [1, 2, wrong('3')] }]),
      'observations[0].z[2] must be a number, and is "3"',
    ],
    [
      () => filter.update(points, [{ id: 1n, z: wrong([1n, 2n, 3n]) }]),
      'observations[0].z[0] must be a number, and is 1n',
    ],
    [() => filter.update(points, [wrong({ id: 1n })]), 'observations[0].z is missing'],
    [() => filter.update(points, [wrong({ z: [1, 2, 3] })]), 'observations[0].id is missing'],
    [() => filter.update(points, [FRAME[0] ?? assert.fail(), wrong(7)]), 'observations[1] must be an object, and is 7'],
    [
      () => filter.update(points, [wrong({ id: 1n, z: [1, 2, 3], covariances: [] })]),
      'observations[0].covariances is no field of Observation',
    ],
    [() => filter.update(points, wrong('abc')), 'observations must be an array, and is "abc"'],
    [() => filter.update(wrong('0'), FRAME), 'sensor must be an integer from -2147483648 to 2147483647, and is "0"'],
    [() => filter.update(0.5, FRAME), 'sensor must be an integer from -2147483648 to 2147483647, and is 0.5'],
    [
      () => {
        filter.predictTwist(0.1, new Float64Array(2), [0, 0, 0]);
      },
      'velocity must have 3 numbers, and has 2',
    ],
    [
      () => {
        filter.predictTwist(0.1, wrong(new DataView(new ArrayBuffer(24))), [0, 0, 0]);
      },
      'velocity must be an array of 3 numbers, and is a object',
    ],
    [
      () => {
        filter.predictTwist(wrong(1n), [0, 0, 0], [0, 0, 0]);
      },
      'dt must be a number, and is 1n',
    ],
    [
      () => {
        filter.predictIncrement(wrong(null), new Float64Array(36));
      },
      'T_before_after must be an object, and is null',
    ],
    [() => new Filter(wrong({ maxLandmark: 3 })), 'options.maxLandmark is no field of FilterOptions'],
    [() => new Filter({ maxLandmarks: -1 }), 'options.maxLandmarks must be an integer from 0 to 4294967295, and is -1'],
    [() => new Filter({ initialPose: wrong({ position: [0, 0, 0] }) }), 'options.initialPose.quaternion is missing'],
    [() => new Team({ baseline: wrong(1) }, {}, {}), 'options.baseline must be true or false, and is 1'],
    [() => filter.addCustom({}, wrong(7)), 'a cairn_custom_predict_fn must be a function, and is a number'],
    [
      () => {
        filter.map.copy().merge(wrong({}));
      },
      'other must be a LandmarkMap',
    ],
    [() => new LandmarkMap(), 'a LandmarkMap comes from another object or its copy()'],
    [() => cairn.has(wrong(1)), 'feature must be a string, and is 1'],
  ];
  for (const [call, message] of cases) assert.throws(call, { name: 'TypeError', message });
  assert.deepEqual(state(filter), before);
});

test('arrays of any kind are taken; large ones where they are', () => {
  const { filter } = started();
  const ids = [1n, 2n, 3n];
  const rows = 9;
  const diagonal = (n: number, value: number): Float64Array => {
    const matrix = new Float64Array(n * n);
    for (let i = 0; i < n; i += 1) matrix[i * n + i] = value;
    return matrix;
  };
  const residual = new Float64Array(rows).fill(0.001);
  const twin = started().filter;
  filter.updateLinear(residual, diagonal(rows, 0.1), null, BigUint64Array.from(ids), diagonal(rows, 1));
  twin.updateLinear([...residual], [...diagonal(rows, 0.1)], null, ids, [...diagonal(rows, 1)]);
  assert.deepEqual(state(filter), state(twin));
  assert.throws(() => filter.updateLinear(residual, diagonal(rows, 0.1), null, ids, diagonal(8, 1)), {
    name: 'TypeError',
    message: 'jacobianLandmarks must have 81 numbers, and has 64',
  });
});

test('ids are bigint, all 64 bits of them', () => {
  const { filter, points } = started();
  const id = 2n ** 63n + 2n ** 53n + 1n;
  assert.deepEqual(
    filter.update(points, [{ id, z: [3, 3, 3] }]).map((match) => [match.landmark, match.result]),
    [[id, Result.New]],
  );
  assert.equal(filter.map.landmark(id).id, id);
  for (const number of [1, 2 ** 53 + 2]) {
    assert.throws(() => filter.update(points, [{ id: wrong(number), z: [1, 2, 3] }]), {
      name: 'TypeError',
      message: /^observations\[0\]\.id must be a bigint \(write 1n/,
    });
    assert.throws(() => filter.map.landmark(wrong(number)), { name: 'TypeError', message: /write 1n/ });
  }
  for (const outside of [-1n, 2n ** 64n]) {
    assert.throws(() => filter.map.landmark(outside), {
      name: 'TypeError',
      message: /from 0n to 18446744073709551615n/,
    });
  }
  assert.throws(() => filter.map.jointCovariance(wrong([1])), {
    name: 'TypeError',
    message: /^ids\[0\] must be a bigint/,
  });
  assert.throws(() => filter.map.landmark(cairn.ID_NONE), refused(Status.ErrorNotFound, /./));
});

test('a closed object throws, and its map with it; to close twice is allowed', () => {
  const { filter, points } = started();
  const { map } = filter;
  const copy = map.copy();
  map.close(); // the filter owns it: nothing happens
  assert.equal(map.size(), 3);
  assert.equal(filter.map, map);
  filter.close();
  filter.close();
  assert(filter.closed && map.closed && !copy.closed);
  const closed = refused(Status.ErrorState, 'this filter is closed');
  assert.throws(() => filter.update(points, FRAME), closed);
  assert.throws(() => filter.pose(), closed);
  assert.throws(() => filter.map, closed);
  assert.throws(() => map.size(), closed);
  assert.throws(() => copy.merge(map), closed);
  assert.equal(copy.size(), 3);
  const kept = ((): Filter => {
    using scoped = started().filter;
    return scoped;
  })();
  assert(kept.closed);
});

test('what a callback throws comes back, and the filter is as before', async () => {
  const make = (): { filter: Filter; custom: number; fail: (on: boolean) => void } => {
    const { filter } = started();
    let failing = false;
    const custom = filter.addCustom(
      { rows: 3, sigma: [0.1, 0.1, 0.1] },
      (...values) => {
        // The second landmark fails: the first one was computed by then.
        if (failing && Math.abs((values[1][1] ?? 0) - (filterTarget[1] ?? 0)) < 0.5) throw mine;
        return predict(...values);
      },
      place,
    );
    return { filter, custom, fail: (on) => (failing = on) };
  };
  const mine = new RangeError('mine');
  const filterTarget = started().filter.map.landmark(2n).position;
  const { filter, custom, fail } = make();
  const twin = make();
  const before = state(filter);
  fail(true);
  assert.throws(
    () => filter.update(custom, FRAME),
    (error) => error === mine,
  );
  assert.deepEqual(state(filter), before);
  await assert.rejects(filter.updateAsync(custom, FRAME), (error) => error === mine);
  assert.deepEqual(state(filter), before);
  assert.throws(
    () => {
      const throwing = (): never => {
        throw mine;
      };
      cairn.customCheck({}, throwing, null, cairn.poseIdentity(), [1, 1, 1]);
    },
    (error) => error === mine,
  );
  fail(false);
  const [matches] = await Promise.all([filter.updateAsync(custom, FRAME)]);
  assert.deepEqual(matches, twin.filter.update(twin.custom, FRAME));
  assert.deepEqual(state(filter), state(twin.filter));
});

test('callbacks: wrong answers, and calls inside', () => {
  const { filter, points } = started();
  const before = state(filter);
  const undecided = filter.addCustom(
    {},
    wrong(() => undefined),
  );
  assert.throws(() => filter.update(undecided, FRAME), { name: 'TypeError', message: /must return true or false/ });
  const busy = refused(Status.ErrorState, /^this filter is in use by another call/);
  for (const inside of [
    (): unknown => filter.update(points, FRAME),
    (): unknown => filter.pose(),
    (): unknown => filter.map.size(),
  ]) {
    const selfish = filter.addCustom({}, () => Boolean(inside()));
    assert.throws(() => filter.update(selfish, FRAME), busy);
  }
  const closing = filter.addCustom({}, () => {
    filter.close();
    return true;
  });
  assert.throws(() => filter.update(closing, FRAME), busy);
  assert.deepEqual(state(filter), before);

  // Another filter may be used inside, as deep as one likes: every call has memory of its own.
  const kept: Float64Array[] = [];
  const twin = started();
  const other = filter.addCustom({}, (...values) => {
    kept.push(values[1], values[2]);
    twin.filter.update(twin.points, FRAME);
    assert.throws(
      () => {
        twin.filter.predictWheels(-1, 0, 0);
      },
      refused(Status.ErrorArgument, /dt/),
    );
    return predict(...values);
  });
  const plain = started();
  assert.deepEqual(
    filter.update(other, FRAME).map((match) => match.distance),
    plain.filter.update(plain.filter.addCustom({}, predict), FRAME).map((match) => match.distance),
  );
  assert(kept.length > 0 && kept.every((values) => values.every(Number.isFinite)));
});

test('a log gets lines; what it throws is an uncaught exception', () => {
  const example = (log: string): string => `
    import { Filter } from 'cairn-slam';
    const filter = new Filter({ gateProbability: 1, batchGateProbability: 0.01 });
    const points = filter.addCartesian();
    filter.setLog(${log});
    filter.update(points, [{ id: 1n, z: [5, 1, 0] }, { id: 2n, z: [4, -2, 1] }]);
    for (let i = 0; i < 5; i += 1) filter.update(points, [{ id: 1n, z: [5.3, 1, 0] }, { id: 2n, z: [4, -2.3, 1] }]);
    filter.setLog(null);
    console.log('end');`;
  const lines = run(example('(line) => console.log(line)'));
  assert.equal(lines.stderr, '');
  assert.match(lines.stdout, /\S.*\nend\n$/s);
  const thrown = run(example("() => { throw new Error('from the log') }"));
  assert.match(thrown.stderr, /from the log/);
  assert.notEqual(thrown.status, 0);
});

test('asynchronous calls that all fail at once: every message is its own', async () => {
  const { filter } = started();
  const radii = Array.from({ length: 2000 }, (_, i) => -1 - i);
  const results = await Promise.allSettled(radii.map((radius) => filter.map.withinAsync([0, 0, 0], radius)));
  results.forEach((result, i) => {
    assert(result.status === 'rejected');
    refused(Status.ErrorArgument, `radius must be >= 0, and is ${String(radii[i])}`)(result.reason);
  });
  const others = Array.from({ length: 64 }, () => started());
  const sensors = await Promise.allSettled(others.map(({ filter: one }, i) => one.updateAsync(100 + i, FRAME)));
  sensors.forEach((result, i) => {
    assert(result.status === 'rejected');
    refused(Status.ErrorNotFound, new RegExp(`\\b${String(100 + i)}\\b`))(result.reason);
  });
});

test('two threads on one object: an error; queries run side by side', async () => {
  const { filter, points } = started();
  const twin = started();
  const update = filter.updateAsync(points, FRAME);
  const busy = refused(Status.ErrorState, /^this filter is in use by another call: await/);
  assert.throws(() => filter.update(points, FRAME), busy);
  assert.throws(() => filter.pose(), busy);
  assert.throws(() => filter.map.size(), busy);
  assert.throws(() => {
    filter.close();
  }, busy);
  await assert.rejects(filter.updateAsync(points, FRAME), busy);
  assert.deepEqual(await update, twin.filter.update(twin.points, FRAME));
  const queries = [filter.map.landmarksAsync(), filter.map.landmarksAsync()];
  assert.equal(filter.map.size(), 3);
  assert.throws(() => filter.update(points, FRAME), busy);
  for (const landmarks of await Promise.all(queries)) assert.deepEqual(landmarks, filter.map.landmarks());
  assert.deepEqual(state(filter), state(twin.filter));
});

test('worker threads that all fail at once: every message is its own; a worker that ends leaves nothing', async () => {
  const source = `
    import { Filter } from 'cairn-slam';
    import { workerData } from 'node:worker_threads';
    const filter = new Filter();
    filter.addCustom({}, () => true);
    filter.setLog(() => {});
    for (let i = 0; i < 3000; i += 1) {
      const dt = -(1 + workerData + 100 * i);
      try {
        filter.predictWheels(dt, 0, 0);
        throw new Error('no error');
      } catch (error) {
        if (error.message !== 'dt must be > 0, and is ' + dt) throw error;
      }
    }`;
  const file = path.join(process.cwd(), 'worker.mjs');
  writeFileSync(file, source);
  await Promise.all(
    Array.from(
      { length: 8 },
      (_, i) =>
        new Promise<void>((resolve, reject) => {
          const worker = new Worker(file, { workerData: i });
          worker.on('error', reject);
          worker.on('exit', (code) => {
            if (code === 0) resolve();
            else reject(new Error(`a worker ended with ${String(code)}`));
          });
        }),
    ),
  );
});

test('an object is used only where it was made', () => {
  const { filter } = started();
  let copy: unknown;
  try {
    copy = structuredClone(filter);
  } catch (error) {
    assert(error instanceof Error && error.name === 'DataCloneError');
    return;
  }
  assert(!(copy instanceof Filter) && !('update' in (copy as object))); // Node 18 and 20 send an empty object
});

test('a library that is missing, older or newer: one message that names both versions', () => {
  const load = (library: string): string => {
    const { status, stderr } = run("import 'cairn-slam';", { CAIRN_LIBRARY: library });
    assert.notEqual(status, 0);
    const lines = stderr.split('\n').filter((line) => line.startsWith('Error: '));
    assert.equal(lines.length, 1, stderr);
    return lines[0] ?? '';
  };
  const others = setting('CAIRN_TEST_OTHERS');
  const { version } = JSON.parse(readFileSync(setting('CAIRN_TEST_API'), 'utf8')) as { version: string };
  const needs = `cairn ${version} for Node needs version ${version.replace(/\.\d+$/, '')} of the library`;
  for (const other of ['0.1.1', '0.3.0']) {
    assert(load(path.join(others, other)).includes(`${needs}, and ${path.join(others, other)}`));
    assert.match(
      load(path.join(others, other)),
      new RegExp(` is ${other.replaceAll('.', '\\.')}: install that version`),
    );
  }
  assert.match(load('/nowhere'), /found none: .*\/nowhere/);
  assert(load('/nowhere').startsWith(`Error: ${needs} (libcairn`));
  assert.match(load(path.join(others, version)), /lacks cairn_/); // the version is right, and a function is missing
});

test('every constant and default is there without a copy', () => {
  assert.equal(cairn.versionNumber(), cairn.VERSION);
  assert.equal(cairn.idNone(), cairn.ID_NONE);
  assert.equal(cairn.filterOptionsDefaults().vehicle, Vehicle.Spatial);
  assert.equal(cairn.teamOptionsDefaults().mode, TeamMode.Joint);
  const world = new World({ landmarks: 50 });
  const numbers = [...world].map((step) => step.number);
  assert.equal(numbers.length, world.steps());
  assert.equal(numbers.at(-1), BigInt(world.steps() - 1));
});
