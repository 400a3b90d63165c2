/** Recordings: replayed, verified after every tick, and searched. */
import * as fields from './fields.js';
import type { Module, Place } from './module.js';
import { statuses, type RecordingInfo, type ReplayProblem, type TickResult } from './types.js';
import { WorldView } from './view.js';

/** The fields of a recording that are digests: a fault there lies in the tick itself, any other before the next. */
const isDigest = (field: string) => field.endsWith('digest');

/** A recording that is replayed. All views of a world show its state after the present tick. */
export class Replay extends WorldView {
  readonly header: RecordingInfo;
  private finished = false;

  /** @internal */
  static open(module: Module, bytes: Uint8Array): Replay {
    const stored = module.store(bytes);
    const session = module.ask('replay_open', stored.address, stored.count);
    if (session === 0) throw new Error('there is no memory for the recording');
    return new Replay(module, session, stored);
  }
  private constructor(
    module: Module,
    session: number,
    private readonly recording: Place,
    private assets: Place[] = [],
  ) {
    super(module, session);
    module.ask('replay_info', session);
    this.header = module.get(fields.recordingInfo);
  }
  /** Frees the memory. No method may be called afterwards. */
  close(): void {
    this.release();
    this.module.ask('replay_close', this.session);
    for (const place of [this.recording, ...this.assets]) this.module.free(place.address);
  }

  /** Makes the world and loads the seed. `assets`: the cooked files of the recorded world, by index. */
  start(assets: Uint8Array[] = []): void {
    this.assets = assets.map((bytes) => this.module.store(bytes));
    const table = this.module.storeTable(this.assets);
    try {
      this.module.call('replay_start', this.session, table, this.assets.length);
    } finally {
      this.module.free(table);
    }
  }

  /** Plays one tick and compares its digest with the recorded one. Throws if they differ, or at damage; see problem(). */
  step(): TickResult {
    return this.next(1);
  }
  /** Reads the bytes of one tick without a world. Only for a replay that was not started. */
  skip(): TickResult {
    return this.next(0);
  }
  private next(world: number): TickResult {
    this.module.call('replay_next', this.session, world);
    const result = this.module.get(fields.tickResult);
    this.finished = result.finished;
    return result;
  }

  /** Goes to a tick, from the last keyframe of the recording before it. Throws if a tick on the way differs. */
  seek(tick: number): void {
    this.module.call('replay_go_to', this.session, tick);
    this.finished = false;
  }
  /** Goes to a snapshot that save() made during this replay, also after an error. */
  resume(snapshot: Uint8Array): void {
    const place = this.module.store(snapshot);
    try {
      this.module.call('replay_resume', this.session, place.address, place.count);
      this.finished = false;
    } finally {
      this.module.free(place.address);
    }
  }

  /** Replays to the end; returns the number of ticks whose digests agreed. Throws as step(). */
  verify(): number {
    let compared = 0;
    while (!this.finished) {
      const result = this.step();
      if (result.compared && !result.finished) ++compared;
    }
    return compared;
  }

  /** Where and why the replay stopped; undefined if it has not. */
  problem(): ReplayProblem | undefined {
    this.module.ask('replay_error', this.session);
    const desk = this.module.desk();
    const [code, tick, offset, field] = [desk.next(), desk.next(), desk.next(), desk.next()];
    if (code === 0) return undefined;
    const name = this.module.text(field);
    const recorded = this.module.askBig('replay_digest_recorded', this.session);
    const replayed = this.module.askBig('replay_digest_replayed', this.session);
    return {
      status: statuses[code] ?? 'corrupt',
      text: `${this.module.statusText(code)} at byte ${offset}, tick ${tick}: ${name}`,
      tick: isDigest(name) ? tick : tick + 1,
      offset,
      field: name,
      digestRecorded: recorded,
      digestReplayed: replayed,
    };
  }
}
