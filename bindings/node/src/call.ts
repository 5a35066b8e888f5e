// SPDX-License-Identifier: BSD-3-Clause
// Errors of calls, and calls in other threads.
import { ERROR, Status } from './facts.js';
import type { Native, NativeArgument } from './load.js';
import type { Memory } from './memory.js';

/** A call of the library failed. It has changed nothing. */
export class CairnError extends Error {
  /** The name of the status, for example "CAIRN_ERROR_ARGUMENT", as other errors of Node have a code. */
  readonly code: string;

  constructor(
    /** Why it failed. */
    readonly status: Status,
    message: string,
  ) {
    super(message);
    const name = Status[status] as string | undefined;
    this.code = name === undefined ? 'CAIRN_ERROR' : `CAIRN${name.replace(/[A-Z]/g, '_$&').toUpperCase()}`;
  }
}
Object.defineProperty(CairnError.prototype, 'name', { value: 'CairnError' });

/** Keeps what a callback threw until the call that it aborted comes back. */
export interface Thrown {
  thrown: { error: unknown } | null;
}

function fail(status: number, m: Memory, thrower: Thrown | null): never {
  const thrown = thrower?.thrown;
  if (thrown) {
    thrower.thrown = null;
    if (status === (Status.ErrorCallback as number)) throw thrown.error;
  }
  throw new CairnError(status, m.text(ERROR.message.offset, ERROR.message.size));
}

/** Throws if a call failed. */
export function check(status: number, m: Memory, thrower: Thrown | null): void {
  if (status < 0) fail(status, m, thrower);
}

// koffi refuses more asynchronous calls than its limit; and each has a stack, so that not too many may run.
const MOST_ASYNC = 32;
let running = 0;
const waiting: (() => void)[] = [];

/** Calls a function in another thread. Calls that are too many wait for their turn. */
export function callAsync<Result>(native: Native<Result>, values: NativeArgument[]): Promise<Result> {
  return new Promise<Result>((resolve, reject) => {
    const start = (): void => {
      running += 1;
      native.async(...values, (error, result) => {
        running -= 1;
        waiting.shift()?.();
        // koffi gives null where there is no error.
        if (error instanceof Error) reject(error);
        else resolve(result);
      });
    };
    if (running < MOST_ASYNC) start();
    else waiting.push(start);
  });
}
