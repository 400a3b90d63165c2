/** A player's machine: its world, its rollback session, and what it sends to the other one. */
import type { Desync, Detent, RollbackSession, TickChecksum } from '../src/index.js';
import { makeTick, startMatch, type Match } from './match.js';

/** All that the other machine lacks; the next message replaces a lost one. */
export interface Message {
  /** The tick of the first input. */
  first: number;
  inputs: Uint8Array[];
  checksums: TickChecksum[];
  /** The first ticks for which the sender lacks an input and a checksum. */
  lacksInput: number;
  lacksChecksum: number;
}

/** Ticks from a key to its effect, and ticks that may be predicted. */
const delay = 2;
const window = 16;

export class Machine {
  readonly match: Match;
  readonly counts = { again: 0, mostAgain: 0, predicted: 0, waits: 0 };
  /** m/s². */
  gravity = -9.81;
  private readonly session: RollbackSession;
  private readonly other: number;
  /** The first ticks for which the other machine lacks an input and a checksum of this one. */
  private theyLack = { input: 0, checksum: 0 };
  /** The first tick whose checksum has not arrived from there. */
  private nextChecksum = 0;

  constructor(
    detent: Detent,
    private readonly player: number,
  ) {
    this.other = 1 - player;
    this.match = startMatch(detent);
    this.session = this.match.world.beginRollback({ local: 1 << player, delay, window }, (_, inputs) => {
      if (inputs.predicted !== 0 && !inputs.again) ++this.counts.predicted;
      makeTick(this.match, inputs, this.gravity);
    });
  }
  close(): void {
    this.session.end();
    this.match.world.destroy();
  }

  get tick(): number {
    return this.session.tick();
  }
  get confirmed(): number {
    return this.session.confirmedTick();
  }
  get desync(): Desync | undefined {
    return this.session.desync();
  }
  /** The number of ticks after which the states of both machines were compared and are equal. */
  get agreed(): number {
    const compared = Math.min(this.nextChecksum - 1, this.session.confirmedTick(), this.session.tick() - 1);
    return Math.max(0, Math.min(compared, (this.desync?.tick ?? Infinity) - 1));
  }

  receive({ first, inputs, checksums, lacksInput, lacksChecksum }: Message): void {
    inputs.forEach((input, i) => this.session.addInput(this.other, first + i, input));
    for (const each of checksums) {
      if (each.tick !== this.nextChecksum) continue;
      this.session.addChecksum(this.other, each);
      ++this.nextChecksum;
    }
    this.theyLack = {
      input: Math.max(this.theyLack.input, lacksInput),
      checksum: Math.max(this.theyLack.checksum, lacksChecksum),
    };
  }
  /** Makes a tick, if the inputs of the other machine are not too late. `input`: the player's, one byte. */
  advance(input: (tick: number) => number): void {
    const next = this.session.nextInput(this.player);
    if (next === this.tick + delay) this.session.addLocalInput(this.player, Uint8Array.of(input(next)));
    const report = this.session.advance();
    const again = (report ?? this.session.correct()).ticksAgain;
    if (report === undefined) ++this.counts.waits;
    this.counts.again += again;
    this.counts.mostAgain = Math.max(this.counts.mostAgain, again);
  }
  message(): Message {
    const { session, theyLack } = this;
    const inputs: Uint8Array[] = [];
    for (let tick = theyLack.input; tick < session.nextInput(this.player); ++tick)
      inputs.push(session.getInput(this.player, tick));
    return {
      first: theyLack.input,
      inputs,
      checksums: session.checksums(Math.max(0, this.confirmed - theyLack.checksum + 1)).reverse(),
      lacksInput: session.nextInput(this.other),
      lacksChecksum: this.nextChecksum,
    };
  }
}
