// SPDX-License-Identifier: BSD-3-Clause
// Callbacks: one native function for each type, which finds the caller's function by the number that C calls `user`.
// Nothing may be thrown through the library: what a function throws is kept, and the call that it aborted throws it.
import worker from 'node:worker_threads';
import koffi from 'koffi';
import type { Thrown } from './call.js';
import { HELD, type Handle, type NativeObject } from './handle.js';
import { Memory } from './memory.js';

/** The callbacks of one call of the library, until it releases them. */
export class Entry {
  #kept = false;

  constructor(
    readonly id: bigint,
    readonly owner: Thrown,
    private readonly functions: Readonly<Record<string, unknown>>,
    private readonly fields: Readonly<Record<string, number>>,
    private readonly holder: Set<object> | null,
  ) {}

  function(type: string): unknown {
    return this.functions[type];
  }

  field(name: string): number {
    return this.fields[name] ?? 0;
  }

  /** The library has them now. */
  keep(): void {
    this.#kept = true;
  }

  /** The end of the call. */
  settle(): void {
    if (!this.#kept) this.drop();
  }

  drop(): void {
    entries.delete(this.id);
    this.holder?.delete(this);
  }
}

// The object that calls the functions holds them, not this table: a function may refer to its object.
const entries = new Map<bigint, WeakRef<Entry>>();
let last = 0n;

/** Keeps functions for the library; null if there are none. */
export function hold(
  object: NativeObject | null,
  owner: Handle | Thrown,
  functions: Readonly<Record<string, unknown>>,
  fields: Readonly<Record<string, number>>,
): Entry | null {
  let any = false;
  for (const [type, value] of Object.entries(functions)) {
    if (value === null || value === undefined) continue;
    if (typeof value !== 'function') throw new TypeError(`a ${type} must be a function, and is a ${typeof value}`);
    any = true;
  }
  if (!any) return null;
  last += 1n;
  const holder = object ? object[HELD] : null;
  const entry = new Entry(last, owner, functions, fields, holder);
  entries.set(last, new WeakRef(entry));
  holder?.add(entry);
  return entry;
}

type NativeValue = bigint | number | string | null;
type NativeCallback = (...values: NativeValue[]) => unknown;

/** A native function that calls a function of JavaScript; it is made when it is needed first. */
export function callback(result: string, parameters: string[], run: NativeCallback): () => bigint {
  let pointer: bigint | null = null;
  return () => (pointer ??= register(result, parameters, run));
}

function register(result: string, parameters: string[], run: NativeCallback): bigint {
  const pointer = koffi.register(run, koffi.pointer(koffi.proto(result, parameters)));
  // A process has only so many. The handles are destroyed before, for their module was loaded before.
  if (!worker.isMainThread) {
    process.on('exit', () => {
      koffi.unregister(pointer);
    });
  }
  return pointer;
}

const find = (user: NativeValue | undefined): Entry | undefined =>
  typeof user === 'bigint' ? entries.get(user)?.deref() : undefined;

/** Runs a callback that answers: 1, 0, or -1, which aborts the call. */
export function answer(user: NativeValue | undefined, run: (entry: Entry) => boolean): number {
  const entry = find(user);
  if (!entry) return -1;
  try {
    return run(entry) ? 1 : 0;
  } catch (error) {
    entry.owner.thrown ??= { error };
    return -1;
  }
}

/** Runs a callback that cannot abort the call. What it throws is an uncaught exception. */
export function notify(user: NativeValue | undefined, run: (entry: Entry) => void): void {
  const entry = find(user);
  if (!entry) return;
  try {
    run(entry);
  } catch (error) {
    queueMicrotask(() => {
      throw error;
    });
  }
}

/** The answer of a callback. */
export function yes(value: boolean): boolean {
  if (typeof value !== 'boolean') throw new TypeError('a callback must return true or false');
  return value;
}

export const pointerRelease = callback('void', ['void *'], (user) => {
  find(user ?? null)?.drop();
  if (typeof user === 'bigint') entries.delete(user);
});

const typed = new Map<number, ReturnType<typeof koffi.array>>();
function doubles(length: number): ReturnType<typeof koffi.array> {
  let type = typed.get(length);
  if (!type) typed.set(length, (type = koffi.array('double', length, 'Typed')));
  return type;
}

/** A copy of what the library shows a callback: the callback may keep it. */
export function copyIn(pointer: NativeValue | undefined, bytes: number): Memory {
  const memory = new Memory(bytes, true);
  memory.u8.set(new Uint8Array((koffi.decode(pointer, doubles(bytes / 8)) as Float64Array).buffer));
  return memory;
}

/** Gives the library what a callback wrote. */
export function copyOut(pointer: NativeValue | undefined, values: Float64Array): void {
  koffi.encode(pointer, doubles(values.length), values);
}
