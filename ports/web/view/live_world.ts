/** A world that begins as a scene's recording does, and goes on live (native/live.cpp). */
import * as fields from '../src/fields.js';
import type { StepReport } from '../src/index.js';
import type { Module } from '../src/module.js';
import { World } from '../src/world.js';

export interface LiveStep {
  /** The scene's recording has no more ticks. */
  over: boolean;
  /** It has a digest of this tick, and whether this is the world's. */
  compared: boolean;
  agrees: boolean;
  /** How many of the scene's calls could not be made so far, for the reader's have changed the world. */
  refused: number;
  report: StepReport;
}

export class LiveWorld extends World {
  /** Throws a DetentError. */
  static open(module: Module, recording: Uint8Array, assets: Uint8Array[]): LiveWorld {
    const [bytes, ...places] = [recording, ...assets].map((each) => module.store(each));
    const table = module.storeTable(places);
    try {
      module.call('live_open', bytes!.address, bytes!.count, table, places.length);
    } catch (error) {
      for (const place of [bytes!, ...places]) module.free(place.address);
      throw error;
    } finally {
      module.free(table);
    }
    return new LiveWorld(module, module.desk().next(), [bytes!, ...places]);
  }

  /** Makes the scene's calls before the next tick, and steps. */
  advance(): LiveStep {
    this.module.ask('live_step', this.session);
    const desk = this.module.desk();
    const [over, compared, agrees, refused] = [desk.next(), desk.next(), desk.next(), desk.next()];
    return {
      over: over !== 0,
      compared: compared !== 0,
      agrees: agrees !== 0,
      refused,
      report: fields.stepReport.take(desk),
    };
  }
  /** A recording of all calls so far, the scene's and the reader's. */
  recording(): Uint8Array {
    this.module.call('live_recording', this.session);
    const desk = this.module.desk();
    const [address, count] = [desk.next(), desk.next()];
    const bytes = this.module.bytes(address, count).slice();
    this.module.free(address);
    return bytes;
  }
}
