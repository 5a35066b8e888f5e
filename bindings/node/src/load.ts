// SPDX-License-Identifier: BSD-3-Clause
// Finds the libraries, and refuses one that this package was not made for.
import path from 'node:path';
import koffi, { type LibraryHandle } from 'koffi';
import { API, LIBRARIES } from './facts.js';

/** What the library can be given. */
export type NativeArgument = number | bigint | string | ArrayBufferView | null;

/** A function of the library. */
export interface Native<Result> {
  (...values: NativeArgument[]): Result;
  async: (...values: [...NativeArgument[], (error: unknown, result: Result) => void]) => void;
}

interface Library {
  bind: <Result>(name: string, result: string, parameters: string[]) => Native<Result>;
}

// The library runs on a stack that koffi gives it. For asynchronous calls this is too small without more.
const STACK_BYTES = 2 << 20;
try {
  if ((koffi.config().async_stack_size ?? 0) < STACK_BYTES) koffi.config({ async_stack_size: STACK_BYTES });
} catch {
  // The program has made asynchronous calls before, with a size of its own choice.
}

/** The name by which the system's loader finds a library; or, from the folder of CAIRN_LIBRARY, its path. */
function locate(soname: string): string {
  const named = process.env['CAIRN_LIBRARY'];
  if (named === undefined || named === '') return soname;
  if (path.basename(named).startsWith('libcairn')) {
    return soname === LIBRARIES.cairn.soname ? named : path.join(path.dirname(named), soname);
  }
  return path.join(named, soname);
}

const needs = `cairn ${API.version} for Node needs version ${API.version.replace(/\.\d+$/, '')} of the library`;
const remedy = 'install that version, or set CAIRN_LIBRARY to its path or its folder';

function firstLine(error: unknown): string {
  return (error instanceof Error ? error.message : String(error)).split('\n', 1)[0] ?? '';
}

function refuseOther(library: LibraryHandle, where: string): void {
  let version = 'of an unknown version';
  try {
    version = String(library.func('cairn_version', 'str', [])());
    const number = Number(library.func('cairn_version_number', 'uint32_t', [])());
    // Before 1.0 a minor version may change everything.
    if (Math.floor(number / 100) === Math.floor(API.versionNumber / 100)) return;
  } catch {
    // 0.1 has no number.
  }
  throw new Error(`${needs}, and ${where} is ${version}: ${remedy}`);
}

/** Opens a library. */
export function load(soname: string): Library {
  const where = locate(soname);
  let library: LibraryHandle;
  try {
    library = koffi.load(where);
  } catch (error) {
    throw new Error(`${needs} (${soname}), and found none: ${where}: ${firstLine(error)}; ${remedy}`);
  }
  if (soname === LIBRARIES.cairn.soname) refuseOther(library, where);
  return {
    bind<Result>(name: string, result: string, parameters: string[]): Native<Result> {
      try {
        return library.func(name, result, parameters) as Native<Result>;
      } catch {
        throw new Error(`${needs}, and ${where} lacks ${name}: ${remedy}`);
      }
    },
  };
}
