/** The WebAssembly module of one configuration: its functions, its memory, and the desk (native/desk.h). */
import { type Codec, Taker } from './codec.js';
import { statuses, type Status, type Vec3 } from './types.js';

/** A call that was refused. It has changed nothing. */
export class DetentError extends Error {
  constructor(
    readonly status: Status,
    message: string,
  ) {
    super(message);
    this.name = 'DetentError';
  }
}

type Native = Record<string, (...args: (number | bigint)[]) => number & bigint>;

/**
 * A module of the package, or its URL, response, bytes or compiled module. The small modules have 60 % of the bytes and
 * take two to four times as long.
 */
export type ModuleSource = 'fx64' | 'f32' | 'fx64.small' | 'f32.small' | URL | Response | BufferSource | WebAssembly.Module;

async function compile(source: ModuleSource): Promise<WebAssembly.Module> {
  if (source instanceof WebAssembly.Module) return source;
  if (typeof source === 'string') source = new URL(`./detent.${source}.wasm`, import.meta.url);
  if (source instanceof URL && source.protocol === 'file:') {
    // Node.js cannot fetch a file. The name is no literal, so that a bundler for browsers does not look for the module.
    const name = 'node:fs/promises';
    const files = (await import(name)) as typeof import('node:fs/promises');
    return WebAssembly.compile(await files.readFile(source));
  }
  if (source instanceof URL) source = await fetch(source);
  if (source instanceof Response) return WebAssembly.compile(await source.arrayBuffer());
  return WebAssembly.compile(source as BufferSource);
}

/** A module that imports a function of one number, and exports it: so the function can be put into a table. */
const relay = Uint8Array.of(
  ...[0, 0x61, 0x73, 0x6d, 1, 0, 0, 0], // the header
  ...[1, 5, 1, 0x60, 1, 0x7f, 0], // types: (i32) -> ()
  ...[2, 5, 1, 0, 0, 0, 0], // imports: a function of this type, without names
  ...[7, 4, 1, 0, 0, 0], // exports: the same function
);

/** Where bytes lie in the module's memory. */
export interface Place {
  address: number;
  count: number;
}

export class Module {
  readonly native: Native;
  /** Functions that the module calls, by the address that it passes. They must not throw. */
  readonly callbacks = new Map<number, () => void>();
  private readonly memory: WebAssembly.Memory;
  private relayAt = 0;

  private constructor(instance: WebAssembly.Instance) {
    this.native = instance.exports as unknown as Native;
    this.memory = instance.exports['memory'] as WebAssembly.Memory;
    this.native['_initialize']?.();
  }
  static async load(source: ModuleSource): Promise<Module> {
    return new Module(await WebAssembly.instantiate(await compile(source), {}));
  }

  /** The address of a function that the module may call: it runs the callback of the address that it gets. */
  callbackAddress(): number {
    if (this.relayAt === 0) {
      const run = (address: number) => this.callbacks.get(address)!();
      const { exports } = new WebAssembly.Instance(new WebAssembly.Module(relay), { '': { '': run } });
      const table = this.native['__indirect_function_table'] as unknown as WebAssembly.Table;
      this.relayAt = table.grow(1);
      table.set(this.relayAt, exports['']);
    }
    return this.relayAt;
  }

  /** Makes a call that returns a status; throws if it is not ok. */
  call(name: string, ...args: (number | bigint)[]): void {
    this.check(this.native[name]!(...args));
  }
  check(code: number): void {
    if (code !== 0) throw new DetentError(statuses[code] ?? 'bad_argument', this.statusText(code));
  }
  /** Throws this status unless `allowed`. */
  require(allowed: boolean, status: Status): void {
    if (!allowed) this.check(statuses.indexOf(status));
  }
  statusText(code: number): string {
    return this.text(this.native['status_text']!(code));
  }
  /** A function that returns a number. */
  ask(name: string, ...args: (number | bigint)[]): number {
    return this.native[name]!(...args);
  }
  askBig(name: string, ...args: (number | bigint)[]): bigint {
    return BigInt.asUintN(64, this.native[name]!(...args));
  }

  /** Lays numbers on the desk; returns their count. */
  put(values: number[]): number {
    const address = this.native['desk_room']!(values.length);
    if (address === 0) throw new DetentError('buffer_too_small', 'there is no memory for the arguments');
    new Float64Array(this.memory.buffer, address, values.length).set(values);
    return values.length;
  }
  /** What the last call has left on the desk; valid until the next one. */
  desk(): Taker {
    return new Taker(new Float64Array(this.memory.buffer, this.native['desk_room']!(0)));
  }
  get<Out>(codec: Codec<any, Out>): Out {
    return codec.take(this.desk());
  }

  allocate(count: number): number {
    const address = this.native['allocate']!(count);
    if (address === 0) throw new DetentError('buffer_too_small', `there is no memory for ${count} bytes`);
    return address;
  }
  free(address: number): void {
    this.native['release']!(address);
  }
  bytes(address: number, count: number): Uint8Array {
    return new Uint8Array(this.memory.buffer, address, count);
  }
  floats(address: number, count: number): Float32Array {
    return new Float32Array(this.memory.buffer, address, count);
  }
  /** Copies bytes into the module's memory. */
  store(bytes: Uint8Array): Place {
    const address = this.allocate(bytes.length);
    this.bytes(address, bytes.length).set(bytes);
    return { address, count: bytes.length };
  }
  /** Lays out a table of assets, as the module takes it. */
  storeTable(places: Place[]): number {
    const address = this.allocate(8 * places.length);
    const words = new Uint32Array(this.memory.buffer, address, 2 * places.length);
    places.forEach((place, i) => words.set([place.address, place.count], 2 * i));
    return address;
  }
  text(address: number): string {
    const bytes = new Uint8Array(this.memory.buffer);
    let end = address;
    while (bytes[end] !== 0) ++end;
    return this.textOf({ address, count: end - address });
  }
  textOf({ address, count }: Place): string {
    return new TextDecoder().decode(this.bytes(address, count).slice());
  }
}

/** Numbers as they are passed for a vector. */
export const spread = (v: Vec3): [number, number, number] => [Number(v[0]), Number(v[1]), Number(v[2])];
