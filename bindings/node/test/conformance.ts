// SPDX-License-Identifier: BSD-3-Clause
// Replays tests/conformance by the public interface, and compares every output with that of the C replayer, exactly:
// conformance.js SCENARIOS OUTPUT_OF_C API_JSON NAMES
// Replays them a second time by the asynchronous form of every method that has one.
// Writes the names of functions, fields and constants that the replay used to NAMES, for bindings_check.py.
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { isDeepStrictEqual } from 'node:util';
import * as cairn from 'cairn-slam';
import { callbacks } from './callbacks.js';

type Json = string | number | boolean | null | Json[] | { [key: string]: Json };
interface Typed {
  name: string;
  type: string;
  base: string;
  kind: string;
  role: string;
  length: string | number | null;
}
interface Field extends Typed {
  repeatable: boolean;
}
interface Parameter extends Typed {
  direction: 'in' | 'out' | 'inout';
}
interface Function {
  name: string;
  fallible: boolean;
  destroys: string | null;
  returns: Omit<Typed, 'name' | 'role' | 'length'>;
  parameters: Parameter[];
}
interface Api {
  constants: { name: string; type: string; value: number | string }[];
  enums: { name: string; prefix: string; bits: boolean; values: { name: string; value: number }[] }[];
  structs: { name: string; init: string | null; fields: Field[] }[];
  handles: { name: string }[];
  functions: Function[];
}
interface Call {
  call: string;
  with?: Record<string, Json>;
  gives?: Record<string, Json>;
  status?: string;
  message?: string;
  log?: string[];
}
interface Scenario {
  name: string;
  calls: Call[];
}

const [scenarios = '', outputOfC = '', apiFile = '', namesFile = ''] = process.argv.slice(2);
const read = <T>(file: string): T => JSON.parse(readFileSync(file, 'utf8')) as T;
const api = read<Api>(apiFile);
const used = new Set<string>();
const exported = cairn as unknown as Record<string, unknown>;

// The rules for names, which the package states.
const pascal = (name: string): string =>
  name.replace(/([^_]+)_?/g, (_, word: string) => word.charAt(0).toUpperCase() + word.slice(1).toLowerCase());
const camel = (name: string): string =>
  /^[a-z]/.test(name) ? name.replace(/_(.)/g, (_, letter: string) => letter.toUpperCase()) : name;
const bare = (name: string): string => name.replace(/^cairn_/, '');
const className = (handle: string): string => (handle === 'cairn_map' ? 'LandmarkMap' : pascal(bare(handle)));

function member(object: unknown, name: string): unknown {
  if (typeof object !== 'object' || object === null || !(name in object)) throw new Error(`there is no ${name}`);
  return (object as Record<string, unknown>)[name];
}

/** The public constant of a name of C. */
function constant(type: string, name: string): number {
  const { prefix } = api.enums.find((e) => e.name === type) ?? { prefix: '' };
  const value = member(exported[pascal(bare(type))], pascal(name.slice(prefix.length)));
  used.add(name);
  return Number(value);
}

const names = new Map<string, unknown>();
function lookUp(reference: string): unknown {
  const [name = '', ...steps] = reference.split('.');
  if (!names.has(name)) throw new Error(`nothing has the name ${name}`);
  return steps.reduce((value, step) => member(value, Array.isArray(value) ? step : camel(step)), names.get(name));
}

const textOf = (value: Json): string => (typeof value === 'string' ? value : JSON.stringify(value));

const bits = new DataView(new ArrayBuffer(8));
function double(value: Json): number {
  if (typeof value === 'number') return value;
  const special = { nan: NaN, inf: Infinity, '-inf': -Infinity }[textOf(value)];
  if (special !== undefined) return special;
  bits.setBigUint64(0, BigInt(`0x${textOf(value).slice(1)}`));
  return bits.getFloat64(0);
}

/** A value of a scenario for the binding. */
function input(type: Typed, value: Json): unknown {
  if (typeof value === 'string' && value.startsWith('$')) return lookUp(value);
  if (type.kind === 'text' || type.kind === 'bool') return value;
  if (type.kind === 'callback') return callback(type.base, textOf(value));
  if (typeof value === 'string' && value.startsWith('bytes:')) return Buffer.from(value.slice(6), 'hex');
  if (type.length !== null && Array.isArray(value)) {
    const values = value.map((element) => input({ ...type, length: null }, element));
    if (type.kind === 'number') return Float64Array.from(values as number[]);
    return type.base === 'uint64_t' ? BigUint64Array.from(values as bigint[]) : values;
  }
  if (type.kind === 'number') return double(value);
  if (type.kind === 'enum') {
    if (!Array.isArray(value)) return constant(type.type, textOf(value));
    return value.reduce((sum: number, name) => sum | constant(type.type, textOf(name)), 0);
  }
  if (type.kind === 'struct') {
    const struct = api.structs.find((s) => s.name === type.base);
    const object: Record<string, unknown> = {};
    for (const [name, element] of Object.entries(value as Record<string, Json>)) {
      const field = struct?.fields.find((f) => f.name === name);
      if (!field) throw new Error(`${type.base} has no field ${name}`);
      used.add(`${type.base}.${name}`);
      object[camel(name)] = input(field, element);
    }
    return object;
  }
  return type.base === 'uint64_t' ? BigInt(value as string | number) : value;
}

/** What the binding gave, in the form of a replayer's output. */
function output(type: Omit<Typed, 'name' | 'role'>, value: unknown): Json {
  if (value instanceof Uint8Array) return `bytes:${Buffer.from(value).toString('hex')}`;
  if (type.length !== null) {
    const element = { ...type, length: null };
    return Array.from(value as ArrayLike<unknown>, (one) => output(element, one));
  }
  if (type.kind === 'number') {
    if (Number.isNaN(value)) return 'nan';
    bits.setFloat64(0, value as number);
    return `x${bits.getBigUint64(0).toString(16).padStart(16, '0')}`;
  }
  if (type.kind === 'enum') {
    const known = api.enums.find((e) => e.name === type.type);
    if (known?.bits === true) {
      return known.values.filter((v) => (Number(value) & v.value) !== 0).map((v) => v.name);
    }
    const name = known?.values.find((v) => v.value === value)?.name;
    if (name === undefined) throw new Error(`${type.type} has no value ${String(value)}`);
    if (constant(type.type, name) !== value) throw new Error(`${name} has another value`);
    return name;
  }
  if (type.kind === 'struct') {
    const object: Record<string, Json> = {};
    for (const field of api.structs.find((s) => s.name === type.base)?.fields ?? []) {
      if (field.role === 'struct_size' || field.role === 'reserved') continue;
      const got = member(value, camel(field.name));
      used.add(`${type.base}.${field.name}`);
      if (field.repeatable) object[field.name] = output(field, got);
    }
    return object;
  }
  return typeof value === 'bigint' ? value.toString() : (value as Json);
}

let asynchronousCalls = 0;
let lines: string[] = [];
let aborted: unknown = null;
function callback(type: string, name: string): unknown {
  if (name === 'collect') return (line: string) => lines.push(line);
  const run = callbacks[type === 'cairn_custom_predict_fn' ? 'predict' : 'place'][name];
  if (!run) throw new Error(`there is no callback ${name}`);
  return (...values: never[]) => {
    try {
      return run(...values);
    } catch (error) {
      aborted = error;
      throw error;
    }
  };
}

const isInput = (p: Parameter): boolean =>
  (['value', 'sensor', 'text', 'handle', 'callback'].includes(p.role) || ['object', 'array'].includes(p.role)) &&
  p.direction !== 'out';
const isOutput = (p: Parameter): boolean =>
  p.role === 'created' || (['object', 'array'].includes(p.role) && p.direction !== 'in');

/** Calls the function of the public interface that a function of C is. */
function run(f: Function, values: Record<string, Json>, asynchronous: boolean): unknown {
  const [first] = f.parameters;
  const inputs = f.parameters.filter(isInput);
  const given = inputs.map((p) => {
    const value = values[p.name];
    return value === undefined ? undefined : input(p, value);
  });
  const creates = f.parameters.find((p) => p.role === 'created');
  if (first?.role === 'handle') {
    const object = given[0];
    const name = f.destroys === null ? camel(f.name.slice(first.base.length + 1)) : 'close';
    if (!(object instanceof (member(exported, className(first.base)) as new () => object)))
      throw new Error('no handle');
    if (f.returns.kind === 'handle') return member(object, name);
    const form = asynchronous && `${name}Async` in object ? `${name}Async` : name;
    if (form !== name) asynchronousCalls += 1;
    return (member(object, form) as (...values: unknown[]) => unknown).apply(object, given.slice(1));
  }
  if (creates) return Reflect.construct(member(exported, className(creates.base)) as () => unknown, given);
  const name = f.name.endsWith('_init') ? f.name.replace(/_init$/, '_defaults') : f.name;
  return (member(exported, camel(bare(name))) as (...values: unknown[]) => unknown)(...given);
}

function outputs(f: Function, result: unknown): Map<string, { type: Omit<Typed, 'name' | 'role'>; value: unknown }> {
  const all = f.parameters.filter(isOutput);
  const found = new Map<string, { type: Omit<Typed, 'name' | 'role'>; value: unknown }>();
  if (!f.fallible && f.returns.kind !== 'void')
    found.set('return', { type: { ...f.returns, length: null }, value: result });
  for (const p of all) found.set(p.name, { type: p, value: all.length === 1 ? result : member(result, camel(p.name)) });
  return found;
}

async function replay(scenario: Scenario, expected: Scenario, asynchronous: boolean): Promise<void> {
  names.clear();
  const created: { close(): void }[] = [];
  for (const [index, call] of scenario.calls.entries()) {
    const f = api.functions.find((one) => one.name === call.call);
    if (!f) throw new Error(`no function ${call.call}`);
    const got: Call = { call: call.call };
    const want = expected.calls[index];
    lines = [];
    aborted = null;
    try {
      const result = await run(f, call.with ?? {}, asynchronous);
      used.add(f.name);
      const gives: Record<string, Json> = {};
      for (const [name, { type, value }] of outputs(f, result)) {
        const label = call.gives?.[name];
        const named = typeof label === 'string' && label.startsWith('$') ? label : null;
        if (named !== null) names.set(named, value);
        if (type.kind === 'handle') {
          if (f.returns.kind !== 'handle') created.push(value as { close(): void });
          gives[name] = named ?? '';
        } else {
          gives[name] = output(type, value);
        }
      }
      if (Object.keys(gives).length > 0) got.gives = gives;
    } catch (error) {
      if (error instanceof cairn.CairnError) {
        used.add('cairn_error.status').add('cairn_error.message');
        got.status = error.code;
        got.message = error.message;
      } else if (error === aborted && want?.status === 'CAIRN_ERROR_CALLBACK') {
        got.status = want.status; // the callback's own error comes back
        got.message = want.message ?? '';
      } else {
        throw new Error(`${scenario.name}, call ${String(index)} (${call.call})`, { cause: error });
      }
    }
    if (lines.length > 0) got.log = lines;
    if (!isDeepStrictEqual(got, want)) {
      const shown = [got, want].map((one) => JSON.stringify(one)).join('\n  C: ');
      throw new Error(`${scenario.name}, call ${String(index)} differs from C:\n     ${shown}`);
    }
  }
  for (const object of created.reverse()) object.close();
}

for (const c of api.constants) {
  const value = member(exported, bare(c.name.toLowerCase()).toUpperCase());
  if (value === (c.type === 'uint64_t' ? BigInt(c.value) : c.value)) used.add(c.name);
}
let scenarioCount = 0;
let calls = 0;
for (const file of readdirSync(scenarios)
  .filter((name) => name.endsWith('.json'))
  .sort()) {
  const scenario = read<Scenario>(path.join(scenarios, file));
  const expected = read<Scenario>(path.join(outputOfC, file));
  await replay(scenario, expected, false);
  await replay(scenario, expected, true);
  scenarioCount += 1;
  calls += scenario.calls.length;
}
if (scenarioCount === 0) throw new Error(`no scenario in ${scenarios}`);
// These two have no method: the errors carry the message.
for (const name of ['cairn_last_message', 'cairn_sim_last_message']) used.add(name);
writeFileSync(namesFile, [...used].join('\n'));
if (asynchronousCalls === 0) throw new Error('no call was asynchronous');
console.log(
  `${String(scenarioCount)} scenarios with ${String(calls)} calls, and again with ${String(asynchronousCalls)} of them ` +
    'asynchronous: the same bits and texts as C',
);
