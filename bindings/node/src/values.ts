// SPDX-License-Identifier: BSD-3-Clause
// Inputs on their way into memory. Each is checked first, for C would read anything: a wrong type or shape is a
// TypeError that names the parameter; what a value means is checked by the library.
import { check } from './call.js';
import type { Native } from './load.js';
import type { Memory } from './memory.js';

/** Numbers: a Float64Array, another typed array or an array. */
export type Numbers = ArrayLike<number>;
/** Ids: a BigUint64Array or an array of bigint. */
export type BigInts = ArrayLike<bigint>;
/** Bytes: a Uint8Array, such as a Buffer. */
export type Bytes = Uint8Array;

const LARGEST_UINT64 = (1n << 64n) - 1n;

function describe(value: unknown): string {
  if (value === null) return 'null';
  if (typeof value === 'bigint') return `${String(value)}n`;
  if (typeof value === 'number' || typeof value === 'boolean' || value === undefined) return String(value);
  if (Array.isArray(value)) return `an array of ${String(value.length)}`;
  return typeof value === 'string' ? JSON.stringify(value) : `a ${typeof value}`;
}

/** An input of the wrong type or shape; the names of the structs around it are put before its message. */
class InputError extends TypeError {
  within(place: string): this {
    this.message = `${place}.${this.message}`;
    return this;
  }
}
Object.defineProperty(InputError.prototype, 'name', { value: 'TypeError' });

function refuse(name: string, must: string, value: unknown): never {
  throw new InputError(`${name} must be ${must}, and is ${describe(value)}`);
}

export function double(value: number, name: string): number {
  if (typeof value !== 'number') refuse(name, 'a number', value);
  return value;
}

function integer(value: number, lowest: number, highest: number, name: string): number {
  if (typeof value !== 'number' || !Number.isInteger(value) || value < lowest || value > highest) {
    refuse(name, `an integer from ${String(lowest)} to ${String(highest)}`, value);
  }
  return value;
}

export const int32 = (value: number, name: string): number => integer(value, -(2 ** 31), 2 ** 31 - 1, name);
export const uint32 = (value: number, name: string): number => integer(value, 0, 2 ** 32 - 1, name);
export const size = (value: number, name: string): number => integer(value, 0, Number.MAX_SAFE_INTEGER, name);

export function uint64(value: bigint, name: string): bigint {
  if (typeof value !== 'bigint') {
    const written = Number.isSafeInteger(value) ? `write ${String(value)}n` : 'write 1n, not 1';
    refuse(name, `a bigint (${written}): a number has 53 bits, and ids have 64`, value);
  }
  if (value < 0n || value > LARGEST_UINT64) refuse(name, 'a bigint from 0n to 18446744073709551615n', value);
  return value;
}

export function text(value: string, name: string): string {
  if (typeof value !== 'string') refuse(name, 'a string', value);
  return value;
}

export function putDouble(m: Memory, at: number, value: number, name: string): void {
  m.setDouble(at, double(value, name));
}

export function putInt32(m: Memory, at: number, value: number, name: string): void {
  m.setInt32(at, int32(value, name));
}

export function putUint32(m: Memory, at: number, value: number, name: string): void {
  m.setUint32(at, uint32(value, name));
}

export function putUint64(m: Memory, at: number, value: bigint, name: string): void {
  m.setUint64(at, uint64(value, name));
}

export function putBool(m: Memory, at: number, value: boolean, name: string): void {
  if (typeof value !== 'boolean') refuse(name, 'true or false', value);
  m.setInt32(at, value ? 1 : 0);
}

/** The length of an array that a call gets. */
export function count(value: ArrayLike<unknown>, name: string): number {
  if (!Array.isArray(value) && !ArrayBuffer.isView(value)) refuse(name, 'an array', value);
  return value.length;
}

function sized(value: ArrayLike<unknown>, length: number, what: string, name: string): void {
  if (!Array.isArray(value) && !(ArrayBuffer.isView(value) && 'length' in value)) {
    refuse(name, `an array of ${String(length)} ${what}`, value);
  }
  if (value.length !== length) {
    throw new InputError(`${name} must have ${String(length)} ${what}, and has ${String(value.length)}`);
  }
}

export function putDoubles(m: Memory, at: number, value: Numbers, length: number, name: string): void {
  sized(value, length, 'numbers', name);
  for (let i = 0; i < length; i += 1) {
    const number = value[i];
    if (typeof number !== 'number') refuse(`${name}[${String(i)}]`, 'a number', number);
    m.setDouble(at + 8 * i, number);
  }
}

export function inDoubles(m: Memory, value: Numbers, length: number, name: string): number | Float64Array {
  if (value instanceof Float64Array && value.length === length && m.passes(length)) return value;
  const at = m.alloc(8 * length);
  putDoubles(m, at, value, length, name);
  return at;
}

export function inUint64s(m: Memory, value: BigInts, length: number, name: string): number | BigUint64Array {
  if (value instanceof BigUint64Array && value.length === length && m.passes(length)) return value;
  sized(value, length, 'bigints', name);
  const at = m.alloc(8 * length);
  for (let i = 0; i < length; i += 1) putUint64(m, at + 8 * i, value[i] as bigint, `${name}[${String(i)}]`);
  return at;
}

export function inBytes(m: Memory, value: Bytes, length: number, name: string): number | Uint8Array {
  if (!(value instanceof Uint8Array)) refuse(name, 'a Uint8Array', value);
  if (m.passes(length)) return value;
  const at = m.alloc(length);
  m.u8.set(value, at);
  return at;
}

export type Writer<T> = (m: Memory, at: number, value: T) => void;

export function putStruct<T>(m: Memory, at: number, write: Writer<T>, value: T, name: string): void {
  if (typeof value !== 'object' || value === null) refuse(name, 'an object', value);
  try {
    write(m, at, value);
  } catch (error) {
    throw error instanceof InputError ? error.within(name) : error;
  }
}

export function writeStruct<T>(m: Memory, bytes: number, write: Writer<T>, value: T, name: string): number {
  const at = m.alloc(bytes);
  putStruct(m, at, write, value, name);
  return at;
}

/** Options: what the library fills in, and over it what the caller gave. */
export function writeOptions<T>(
  m: Memory,
  bytes: number,
  init: Native<number>,
  write: Writer<T>,
  value: T,
  name: string,
): number {
  const at = m.alloc(bytes);
  check(init(m.address(at), bytes, m.error), m, null);
  putStruct(m, at, write, value, name);
  return at;
}

export function writeStructs<T>(
  m: Memory,
  bytes: number,
  write: Writer<T>,
  values: readonly T[],
  name: string,
): number {
  const length = values.length;
  const at = m.alloc(bytes * length);
  let i = 0;
  try {
    for (; i < length; i += 1) {
      const value = values[i] as T;
      if (typeof value !== 'object' || value === null) break;
      write(m, at + bytes * i, value);
    }
  } catch (error) {
    throw error instanceof InputError ? error.within(`${name}[${String(i)}]`) : error;
  }
  if (i < length) refuse(`${name}[${String(i)}]`, 'an object', values[i]);
  return at;
}

export function readStructs<T>(
  m: Memory,
  at: number,
  bytes: number,
  read: (m: Memory, at: number) => T,
  length: number,
): T[] {
  const values = new Array<T>(length);
  for (let i = 0; i < length; i += 1) values[i] = read(m, at + bytes * i);
  return values;
}

export function unknownField(struct: string, key: string): never {
  throw new InputError(`${key} is no field of ${struct}`);
}

export function missingField(seen: number, names: readonly string[]): never {
  throw new InputError(`${names.find((_, index) => (seen & (1 << index)) === 0) ?? ''} is missing`);
}
