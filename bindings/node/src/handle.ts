// SPDX-License-Identifier: BSD-3-Clause
// Objects of the library: who destroys them and when, and that only one thread at a time uses each.
import worker from 'node:worker_threads';
import { CairnError, type Thrown } from './call.js';
import { Status } from './facts.js';
import type { Native } from './load.js';

/** @internal */
export const HANDLE: unique symbol = Symbol('cairn.handle');
/** @internal */
export const HELD: unique symbol = Symbol('cairn.held');

/** Handles that are open in this thread. A worker that ends destroys them, for its finalizers never run. */
const open = new Set<Handle>();
if (!worker.isMainThread) {
  process.on('exit', () => {
    for (const handle of open) handle.destroy();
  });
}

/** The pointer of an object, and who uses it now. It does not refer to the object, which may so be collected. */
export class Handle implements Thrown {
  thrown: Thrown['thrown'] = null;
  readonly owner: Handle;
  #pointer: bigint | null;
  #queries = 0;
  #changing = false;

  /** `destroyer`: the function that destroys it; or the handle that owns it, and lends it. */
  constructor(
    pointer: bigint,
    private readonly destroyer: Native<unknown> | Handle,
    readonly kind: string,
  ) {
    this.#pointer = pointer;
    this.owner = destroyer instanceof Handle ? destroyer : this;
    if (this.owner === this) open.add(this);
  }

  get closed(): boolean {
    return this.#pointer === null || this.owner.#pointer === null;
  }

  get pointer(): bigint {
    if (this.#pointer === null || this.closed) throw this.#isClosed();
    return this.#pointer;
  }

  #isClosed(): CairnError {
    return new CairnError(Status.ErrorState, `this ${this.owner.kind} is closed`);
  }

  get lent(): boolean {
    return this.owner !== this;
  }

  /** Called before each use. The library takes no locks: two threads in one object would be undefined behaviour. */
  enter(changes: boolean): void {
    const { owner } = this;
    if (this.closed) throw this.#isClosed();
    if (owner.#changing || (changes && owner.#queries > 0)) {
      throw new CairnError(
        Status.ErrorState,
        `this ${owner.kind} is in use by another call: ` +
          'await its asynchronous calls, and do not use it in its callbacks',
      );
    }
    if (changes) owner.#changing = true;
    else owner.#queries += 1;
  }

  leave(changes: boolean): void {
    if (changes) this.owner.#changing = false;
    else this.owner.#queries -= 1;
  }

  destroy(): void {
    const pointer = this.#pointer;
    if (pointer === null || this.destroyer instanceof Handle) return;
    this.#pointer = null;
    open.delete(this);
    this.destroyer(pointer);
  }
}

const collected = new FinalizationRegistry<Handle>((handle) => {
  handle.destroy();
});

const markAsUncloneable = (worker as { markAsUncloneable?: (object: object) => void }).markAsUncloneable;

/** An object of the library. It is destroyed by close(), by `using`, or when it is collected. */
export abstract class NativeObject {
  /** @internal */
  readonly [HANDLE]: Handle;
  /** Callbacks, which live as long as the object that calls them. @internal */
  readonly [HELD] = new Set<object>();

  /** @internal */
  constructor(handle: Handle) {
    if (!(handle instanceof Handle))
      throw new TypeError(`a ${new.target.name} comes from another object or its copy()`);
    this[HANDLE] = handle;
    // In another thread it would be an empty object: say so when it is sent.
    markAsUncloneable?.(this);
    if (!handle.lent) collected.register(this, handle, this);
  }

  /** Whether close() was called. */
  get closed(): boolean {
    return this[HANDLE].closed;
  }

  /** Destroys the object now. Later calls throw. To close twice is allowed; what another object owns stays. */
  close(): void {
    const handle = this[HANDLE];
    if (handle.lent || this.closed) return;
    handle.enter(true);
    collected.unregister(this);
    handle.destroy();
  }

  [Symbol.dispose](): void {
    this.close();
  }
}

type Class<T extends NativeObject> = abstract new (...values: never[]) => T;

/** The handle of an argument. */
export function handleOf<T extends NativeObject>(object: T, type: Class<T>, name: string): Handle {
  if (!(object instanceof type)) throw new TypeError(`${name} must be a ${type.name}`);
  return object[HANDLE];
}

/** Begins a call on an object, which may read another one. */
export function enter(object: NativeObject, changes: boolean, read?: Handle): Handle {
  const handle = object[HANDLE];
  handle.enter(changes);
  try {
    if (read && read.owner !== handle.owner) read.enter(false);
  } catch (error) {
    handle.leave(changes);
    throw error;
  }
  handle.owner.thrown = null;
  return handle;
}

/** Ends it. The object is named, so that it is not collected before. */
export function leave(object: NativeObject, changes: boolean, read?: Handle): void {
  const handle = object[HANDLE];
  handle.leave(changes);
  if (read && read.owner !== handle.owner) read.leave(false);
}

const lentObjects = new WeakMap<NativeObject, Map<string, { object: NativeObject; owner: NativeObject }>>();

/** An object that another one owns: always the same JavaScript object, which keeps its owner alive. */
export function lend<T extends NativeObject>(
  owner: NativeObject,
  name: string,
  native: Native<bigint | null>,
  wrap: (handle: Handle) => T,
): T {
  const handle = owner[HANDLE];
  const { pointer } = handle;
  let lent = lentObjects.get(owner);
  if (!lent) lentObjects.set(owner, (lent = new Map<string, { object: NativeObject; owner: NativeObject }>()));
  let entry = lent.get(name);
  if (!entry) {
    handle.enter(false);
    try {
      const object = wrap(new Handle(native(pointer) ?? 0n, handle.owner, handle.owner.kind));
      object[HELD].add(owner);
      lent.set(name, (entry = { object, owner }));
    } finally {
      handle.leave(false);
    }
  }
  return entry.object as T;
}
