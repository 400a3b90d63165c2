/** A recording as the page plays it: one replay verifies every tick, another shows the tick that is looked at. */
import { type Detent, DetentError, type Replay, type ReplayProblem, type StepReport } from '../src/index.js';
import { Series } from './series.js';

/** Memory for snapshots, bytes. They make steps back and scrubbing quick where a recording has no keyframes. */
const snapshotBytesMax = 96e6;

export class Playback {
  readonly series: Series;
  /** The first and the last tick that can be shown. */
  readonly first: number;
  /** The last tick of the recording, as far as its bytes are whole. */
  readonly last: number;
  /** Every tick up to this one agrees. */
  verified: number;
  /** How many of them have a digest that was compared. */
  compared = 0;
  finished = false;
  problem: ReplayProblem | undefined;
  /** The ticks between two snapshots. */
  readonly snapshotInterval: number;
  tick: number;
  report: StepReport;
  private readonly snapshots = new Map<number, Uint8Array>();

  private constructor(
    private readonly verifier: Replay,
    readonly shown: Replay,
    ticks: number,
  ) {
    this.first = this.verified = this.tick = shown.header.tick;
    this.last = this.first + ticks;
    this.snapshotInterval = Math.max(1, Math.ceil((ticks * shown.header.snapshotBytes) / snapshotBytesMax));
    this.series = new Series(ticks);
    this.report = shown.report();
    this.snapshots.set(this.first, verifier.save());
  }

  /** Throws a ReplayProblem if nothing of the recording can be shown. */
  static open(detent: Detent, bytes: Uint8Array, assets: Uint8Array[]): Playback {
    const ticks = countTicks(detent.openRecording(bytes));
    const replays = [detent.openRecording(bytes), detent.openRecording(bytes)] as const;
    for (const replay of replays) {
      try {
        replay.start(assets);
      } catch (error) {
        const problem = replay.problem() ?? stopped(error, 0);
        for (const each of replays) each.close();
        throw problem;
      }
    }
    return new Playback(replays[0], replays[1], ticks);
  }

  close(): void {
    this.verifier.close();
    this.shown.close();
  }

  /** Verifies ticks for about so many milliseconds. */
  verifyFor(milliseconds: number): void {
    const until = performance.now() + milliseconds;
    while (!this.finished && performance.now() < until) this.verifyTick();
  }
  /** Verifies the first ticks, the same ones on every machine: so many, or fewer if they take more work. */
  verifyWork(ticks: number, work: number): void {
    for (let i = 0; i < ticks && work > 0 && !this.finished; ++i) {
      this.verifyTick();
      work -= workOf(this.verifier.report());
    }
  }
  private verifyTick(): void {
    try {
      const result = this.verifier.step();
      this.finished = result.finished;
      if (result.finished) return;
      this.verified = result.tick;
      this.compared += result.compared ? 1 : 0;
      this.series.note(result.tick - this.first, result.report);
      if ((result.tick - this.first) % this.snapshotInterval === 0) {
        this.snapshots.set(result.tick, this.verifier.save());
      }
    } catch (error) {
      this.finished = true;
      this.problem = this.verifier.problem() ?? stopped(error, this.verified + 1);
    }
  }

  /** The digest of the last tick that was verified. */
  finalDigest(): bigint {
    return this.verifier.digest();
  }

  /** The last tick that can be shown now: before a tick that differs, if there is one. */
  get end(): number {
    return this.problem === undefined ? this.last : this.verified;
  }

  /** Shows a tick, or the nearest that can be shown. False if the replay could not get there. */
  goTo(tick: number): boolean {
    tick = Math.max(this.first, Math.min(this.end, Math.round(tick)));
    try {
      this.approach(tick);
      while (this.tick < tick) this.advance();
      return true;
    } catch (error) {
      this.problem ??= this.shown.problem() ?? stopped(error, this.tick + 1);
      this.tick = Infinity; // what is shown is no tick of the recording: back to one that agrees
      this.approach(this.end);
      while (this.tick < this.end) this.advance();
      return false;
    }
  }

  /** Goes back, or forward where a snapshot or a keyframe lies nearer to the tick than the present one. */
  private approach(tick: number): void {
    const nearest = this.snapshotBefore(tick);
    if (tick >= this.tick && nearest <= this.tick) {
      if (tick <= this.verified || this.shown.header.keyframeInterval === 0 || tick - this.tick < 3) return;
      this.shown.seek(tick - 1);
      this.tick = tick - 1;
    } else {
      // From the tick before it, so that the report of this tick is known.
      const from = tick > this.first ? this.snapshotBefore(tick - 1) : nearest;
      this.shown.resume(this.snapshots.get(from)!);
      this.tick = from;
    }
    this.report = this.shown.report();
  }
  private snapshotBefore(tick: number): number {
    const index = Math.floor((Math.min(tick, this.verified) - this.first) / this.snapshotInterval);
    return this.first + index * this.snapshotInterval;
  }
  private advance(): void {
    const result = this.shown.step();
    if (result.finished) throw new Error('the recording ends early');
    this.tick = result.tick;
    this.report = result.report;
  }
}

/** How much work a step was, about: in a machine's time, a body without contacts counts 1. */
function workOf({ awake, contacts, ccd }: StepReport): number {
  return awake + contacts.substeps + 50 * ccd.tests;
}

function countTicks(replay: Replay): number {
  let ticks = 0;
  try {
    while (!replay.skip().finished) ++ticks;
  } catch {
    // Damage: the verifying replay meets it again, and names it.
  }
  replay.close();
  return ticks;
}

/** For an error that the player has not noted: the module has trapped, or there is no memory. */
function stopped(error: unknown, tick: number): ReplayProblem {
  return {
    status: error instanceof DetentError ? error.status : 'corrupt',
    text: error instanceof DetentError ? error.message : `the replay stopped: ${String(error)}`,
    tick,
    offset: 0,
    field: '',
    digestRecorded: 0n,
    digestReplayed: 0n,
  };
}
