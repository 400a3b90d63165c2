/** Detent: deterministic rigid-body physics in WebAssembly. */
import { Module, type ModuleSource } from './module.js';
import { Replay } from './replay.js';
import type * as T from './types.js';
import { World } from './world.js';

export * from './types.js';
export * from './shapes.js';
export { DetentError, type ModuleSource } from './module.js';
export { WorldView } from './view.js';
export { World } from './world.js';
export { Replay } from './replay.js';
export { RollbackSession, type TickMaker } from './rollback.js';

/** The library in one configuration. All its worlds share one memory. */
export class Detent {
  /** @internal */
  constructor(private readonly module: Module) {}

  /** Recordings of another simulation version are refused. */
  get simulationVersion(): number {
    return this.module.ask('simulation_version');
  }
  /** `assets`: cooked files, by the index that shapes name; bind each with World.bindAsset(). */
  createWorld(def: T.WorldDef, assets: Uint8Array[] = []): World {
    return World.create(this.module, def, assets);
  }
  /** Reads the header of a recording. It may be damaged: see Replay.problem(). */
  openRecording(bytes: Uint8Array): Replay {
    return Replay.open(this.module, bytes);
  }
}

/** Loads the library: 'fx64' (fixed point) or 'f32' (float). */
export async function load(source: ModuleSource = 'fx64'): Promise<Detent> {
  return new Detent(await Module.load(source));
}
