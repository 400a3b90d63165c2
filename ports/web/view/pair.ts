/** A second recording beside the first: where they part, and what the page says of it. */
import type { Detent, ReplayProblem } from '../src/index.js';
import type { Module } from '../src/module.js';
import { compareRecordings, type Comparison, type Named } from './compare.js';
import { Playback } from './playback.js';
import { refusal, verdictOf, type Verdict } from './verdict.js';

/** The first bytes of a Zstandard file. */
const zstandard = [0x28, 0xb5, 0x2f, 0xfd];

export class Pair {
  private playback: Playback | undefined;
  private comparison: Comparison | undefined;
  /** Why there is no second recording to play. */
  private refused = '';
  /** Of the comparison that is still to be made. */
  private timer: number | undefined;

  constructor(
    detent: Detent,
    module: Module,
    private readonly first: Playback,
    private readonly a: Named,
    private readonly b: Named,
    assets: Uint8Array[],
  ) {
    if (zstandard.every((byte, i) => b.bytes[i] === byte)) {
      this.refused = `${b.name} is compressed. Unpack it first: zstd -d ${b.name}`;
      return;
    }
    try {
      this.playback = Playback.open(detent, b.bytes, assets);
    } catch (error) {
      const header = detent.openRecording(b.bytes);
      this.refused =
        typeof (error as ReplayProblem).tick === 'number'
          ? refusal(error as ReplayProblem, header.header, detent.simulationVersion, b.name)
          : `${b.name} cannot be shown: ${String(error)}`;
      header.close();
      return;
    }
    // After the next frame: this takes as long as replaying both up to the difference.
    this.timer = window.setTimeout(() => this.compare(module, assets), 30);
  }
  private compare(module: Module, assets: Uint8Array[]): void {
    try {
      this.comparison = compareRecordings(module, this.a, this.b, assets);
    } catch (error) {
      this.refused = `${this.a.name} and ${this.b.name} cannot be compared here: ${String(error)}. Use detent diff.`;
    }
  }
  close(): void {
    window.clearTimeout(this.timer);
    this.playback?.close();
  }

  verifyFor(milliseconds: number): void {
    this.playback?.verifyFor(milliseconds);
  }
  get finished(): boolean {
    return this.playback?.finished ?? true;
  }

  /** The tick at which playing stops: the first one that differs, as far as the first recording can be shown. */
  get stop(): number | undefined {
    const { comparison, first } = this;
    if (comparison === undefined || !comparison.different) return undefined;
    return Math.max(first.first, Math.min(first.end, this.atStart ? first.first : comparison.tick));
  }
  private get atStart(): boolean {
    return this.comparison?.stage === 'seed';
  }
  /** What differs, at the ticks where it does. */
  marks(tick: number): { bodies: number[]; joints: number[] } {
    const { comparison, stop } = this;
    return comparison === undefined || stop === undefined || tick < stop ? { bodies: [], joints: [] } : comparison;
  }
  /** The second world at this tick; undefined if it is not known there. */
  at(tick: number): Playback | undefined {
    const { playback } = this;
    if (playback === undefined || tick < playback.first || tick > playback.end) return undefined;
    return playback.goTo(tick) ? playback : undefined;
  }
  /** What the ghosts are at this tick. */
  legend(tick: number): string {
    const { playback, b } = this;
    if (playback === undefined) return '';
    if (tick > playback.last) return `${b.name} ends at tick ${playback.last}`;
    if (tick < playback.first) return `${b.name} begins at tick ${playback.first}`;
    if (tick > playback.end) return `not verified here, so not drawn: ${b.name} from tick ${playback.end + 1} on`;
    return `ghosts: ${b.name}, where it differs`;
  }

  verdict(): Verdict {
    const { comparison, a, b } = this;
    if (this.refused !== '') return { kind: 'bad', text: 'not compared', detail: this.refused };
    if (comparison === undefined) return { kind: 'busy', text: 'comparing', detail: `${a.name} and ${b.name}` };
    const detail = comparison.impossible ? comparison.text : `${a.name} and ${b.name}: ${comparison.text}`;
    if (comparison.impossible) return { kind: 'bad', text: 'not compared', detail };
    if (comparison.different) return { kind: 'bad', text: this.where(comparison), detail };
    if (comparison.damaged) return { kind: 'bad', text: `equal up to tick ${comparison.last}, then damaged`, detail };
    return this.verdictOfEqual(comparison, detail);
  }
  private where({ tick, equalTo, afterLastTick }: Comparison): string {
    if (this.atStart) return 'the seeds differ';
    if (afterLastTick) return 'what comes after the last tick differs';
    return tick === equalTo + 1 ? `tick ${tick} differs` : `one of the ticks ${equalTo + 1} to ${tick} differs`;
  }
  private verdictOfEqual({ first, last }: Comparison, detail: string): Verdict {
    for (const [name, playback] of [
      [this.a.name, this.first],
      [this.b.name, this.playback!],
    ] as const) {
      const verdict = verdictOf(playback, () => playback.finalDigest());
      if (verdict.kind !== 'good') return { ...verdict, text: `${name}: ${verdict.text}` };
    }
    if (last < first) return { kind: 'bad', text: 'not compared', detail };
    const whole = this.first.last === last && this.playback?.last === last;
    const text = whole ? 'all ticks of both agree' : `both agree in the ticks ${first} to ${last}`;
    return { kind: 'good', text, detail: `${detail}. All digests of both agree with this page's, too.` };
  }
}
