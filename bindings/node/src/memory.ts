// SPDX-License-Identifier: BSD-3-Clause
// Memory that the library reads and writes: one ArrayBuffer with typed views, from which a call takes what it needs.
// A call of the library that runs a callback, which calls the library again, needs a second one; so they are pooled.
import koffi from 'koffi';
import { ERROR } from './facts.js';

const FIRST_SIZE = 1 << 14;
const LARGEST_POOLED = 1 << 20;
const MOST_POOLED = 8;
/** Arrays with more numbers than this are handed to the library where they are; a copy of others is cheaper. */
const FEWEST_TO_PASS = 64;

export class Memory {
  buffer: ArrayBuffer;
  /** The address of the buffer, which does not move. */
  base: bigint;
  u8: Uint8Array;
  /** Of a call that goes on while the caller may change its arrays: everything is copied. */
  copies = false;
  #i32: Int32Array;
  #u32: Uint32Array;
  #f64: Float64Array;
  #u64: BigUint64Array;
  #top = 0;

  /** With `own`, arrays that are read stay views of this memory. */
  constructor(
    size: number,
    private readonly own: boolean,
  ) {
    this.buffer = new ArrayBuffer(size);
    this.base = own ? 0n : koffi.address(this.buffer);
    this.u8 = new Uint8Array(this.buffer);
    this.#i32 = new Int32Array(this.buffer);
    this.#u32 = new Uint32Array(this.buffer);
    this.#f64 = new Float64Array(this.buffer);
    this.#u64 = new BigUint64Array(this.buffer);
  }

  /** Forgets everything but room for the error of a call, which is at the beginning. */
  reset(copies: boolean): void {
    this.copies = copies;
    this.#u32[ERROR.structSize.offset >> 2] = ERROR.size;
    this.#top = ERROR.size;
  }

  /** The address of the error. */
  get error(): bigint {
    return this.base;
  }

  /** Takes zeroed bytes, and gives their place. Places stay valid when the memory grows, addresses do not. */
  alloc(bytes: number): number {
    const at = this.#top;
    this.#top = at + ((bytes + 7) & ~7);
    if (this.#top > this.buffer.byteLength) this.#grow();
    this.u8.fill(0, at, this.#top);
    return at;
  }

  #grow(): void {
    const old = this.u8;
    this.buffer = new ArrayBuffer(2 * this.#top);
    this.base = koffi.address(this.buffer);
    this.u8 = new Uint8Array(this.buffer);
    this.u8.set(old);
    this.#i32 = new Int32Array(this.buffer);
    this.#u32 = new Uint32Array(this.buffer);
    this.#f64 = new Float64Array(this.buffer);
    this.#u64 = new BigUint64Array(this.buffer);
  }

  address(at: number): bigint {
    return this.base + BigInt(at);
  }

  /** What the library gets for an input: the address of a copy, or the caller's array. */
  pass(input: number | ArrayBufferView | null): bigint | ArrayBufferView | null {
    return typeof input === 'number' ? this.address(input) : input;
  }

  /** Whether an array of this length is handed to the library where it is. */
  passes(length: number): boolean {
    return !this.copies && length > FEWEST_TO_PASS;
  }

  int32(at: number): number {
    return this.#i32[at >> 2] as number;
  }

  uint32(at: number): number {
    return this.#u32[at >> 2] as number;
  }

  uint64(at: number): bigint {
    return this.#u64[at >> 3] as bigint;
  }

  /** A size_t, in memory that was zero before; also where it has 4 bytes. */
  size(at: number): number {
    return Number(this.#u64[at >> 3]);
  }

  double(at: number): number {
    return this.#f64[at >> 3] as number;
  }

  doubles(at: number, length: number): Float64Array {
    return this.own ? new Float64Array(this.buffer, at, length) : this.#f64.slice(at >> 3, (at >> 3) + length);
  }

  text(at: number, size: number): string {
    const bytes = Buffer.from(this.buffer, at, size);
    const end = bytes.indexOf(0);
    return bytes.toString('utf8', 0, end < 0 ? size : end);
  }

  setInt32(at: number, value: number): void {
    this.#i32[at >> 2] = value;
  }

  setUint32(at: number, value: number): void {
    this.#u32[at >> 2] = value;
  }

  setUint64(at: number, value: bigint): void {
    this.#u64[at >> 3] = value;
  }

  setDouble(at: number, value: number): void {
    this.#f64[at >> 3] = value;
  }
}

const pool: Memory[] = [];

export function acquire(copies: boolean): Memory {
  const memory = pool.pop() ?? new Memory(FIRST_SIZE, false);
  memory.reset(copies);
  return memory;
}

export function release(memory: Memory): void {
  if (memory.buffer.byteLength <= LARGEST_POOLED && pool.length < MOST_POOLED) pool.push(memory);
}

/** Memory that the results keep: the library writes into it, and arrays are views of it. */
export function fresh(bytes: number): Memory {
  return new Memory((bytes + 7) & ~7, true);
}

/** A length whose array can be made; a RangeError that says so beats a crash of the process. */
export function room(length: number, bytes: number): number {
  if (length * bytes > 2 ** 36) throw new RangeError(`the result has ${String(length)} numbers, which do not fit`);
  return length;
}
