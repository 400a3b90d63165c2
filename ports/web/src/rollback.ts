/** Rollback sessions: players on several machines, whose inputs arrive late. */
import * as fields from './fields.js';
import type { Module } from './module.js';
import {
  statuses,
  type Desync,
  type RollbackDef,
  type RollbackReport,
  type TickChecksum,
  type TickInputs,
} from './types.js';
import type { World } from './world.js';

/**
 * Makes a tick: applies the inputs to the world and steps it once. The results may depend on the world, the game's state
 * and the inputs only. It must not call the session. If it throws, the session is over.
 */
export type TickMaker = (world: World, inputs: TickInputs) => void;

const whole = (value: number, max: number) => Number.isInteger(value) && value >= 0 && value <= max;
const wordMax = 0xffffffff;

/**
 * Inputs and checksums may come from a network: a call with wrong ones throws a DetentError, and changes nothing. See
 * docs/rollback.md.
 */
export class RollbackSession {
  private handle = 0;
  private input = 0;
  private gameAt = 0;
  private readonly inputBytes: number;
  private readonly players: number;
  private readonly gameBytes: number;
  private state: 'ready' | 'making ticks' | 'over' = 'ready';
  private thrown: { error: unknown } | undefined;

  /** @internal */
  static begin(world: World, module: Module, session: number, def: RollbackDef, make: TickMaker): RollbackSession {
    return new RollbackSession(world, module, session, def, make);
  }
  private constructor(
    private readonly world: World,
    private readonly module: Module,
    session: number,
    def: RollbackDef,
    private readonly make: TickMaker,
  ) {
    module.require(typeof make === 'function', 'bad_argument');
    const { players = 2, inputBytes = 1, game = new Uint8Array() } = def;
    module.require(game instanceof Uint8Array, 'bad_argument');
    [this.players, this.inputBytes, this.gameBytes] = [players, inputBytes, game.length];
    const values: number[] = [];
    fields.rollbackDef.put(values, { ...def, gameBytes: game.length });
    module.call('rollback_open', session, module.callbackAddress(), module.put(values));
    const desk = module.desk();
    [this.handle, this.input, this.gameAt] = [desk.next(), desk.next(), desk.next()];
    this.game().set(game);
    module.callbacks.set(this.handle, () => this.makeTick());
  }
  /** Ends the session and frees its memory. The world stays as it is. */
  end(): void {
    this.module.require(this.state !== 'making ticks', 'bad_argument');
    if (this.handle === 0) return;
    this.module.callbacks.delete(this.handle);
    this.module.ask('rollback_close', this.handle);
    this.handle = 0;
    this.state = 'over';
  }

  /** The module calls this for each tick. An exception must not unwind its stack. */
  private makeTick(): void {
    if (this.thrown !== undefined) return;
    const desk = this.module.desk();
    const [tick, address, predicted, again] = [desk.next(), desk.next(), desk.next(), desk.next() !== 0];
    const all = this.module.bytes(address, this.players * this.inputBytes).slice();
    const inputs = Array.from({ length: this.players }, (_, player) =>
      all.subarray(player * this.inputBytes, (player + 1) * this.inputBytes),
    );
    try {
      this.make(this.world, { tick, inputs, predicted, again, game: this.module.bytes(this.gameAt, this.gameBytes) });
    } catch (error) {
      this.thrown = { error };
    }
  }

  private requireReady(): void {
    this.module.require(this.state === 'ready', 'bad_argument');
  }
  private requirePlayer(player: number): void {
    this.requireReady();
    this.module.require(whole(player, wordMax), 'bad_argument');
  }
  private requireTick(tick: number): void {
    this.module.require(whole(tick, Number.MAX_SAFE_INTEGER), 'out_of_range');
  }
  private putInput(input: Uint8Array): void {
    this.module.require(input instanceof Uint8Array && input.length === this.inputBytes, 'bad_argument');
    this.module.bytes(this.input, this.inputBytes).set(input);
  }

  /** Adds the input of a local player for the tick that comes `delay` ticks after the next one. Returns this tick. */
  addLocalInput(player: number, input: Uint8Array): number {
    this.requirePlayer(player);
    this.putInput(input);
    this.module.call('rollback_add_local_input', this.handle, player);
    return this.module.desk().next();
  }
  /**
   * Adds the input of a remote player for a tick, in any order. One that is known does not change. Throws `out_of_range`
   * if the tick is too far ahead: the sender must send it again.
   */
  addInput(player: number, tick: number, input: Uint8Array): void {
    this.requirePlayer(player);
    this.requireTick(tick);
    this.putInput(input);
    this.module.call('rollback_add_input', this.handle, player, tick);
  }
  /** The known input of any player, to send it. Throws `out_of_range` if it is not known yet, or no longer kept. */
  getInput(player: number, tick: number): Uint8Array {
    this.requirePlayer(player);
    this.requireTick(tick);
    this.module.call('rollback_get_input', this.handle, player, tick);
    return this.module.bytes(this.input, this.inputBytes).slice();
  }
  /** The first tick for which the player's input is not known here: the player's machine need send no earlier ones. */
  nextInput(player: number): number {
    this.requirePlayer(player);
    return this.module.ask('rollback_next_input', this.handle, player);
  }

  /**
   * Repeats the ticks that had wrong predictions, then makes one more. Returns undefined, and does nothing, if `window`
   * ticks were made without an input: call it again when more inputs have arrived.
   */
  advance(): RollbackReport | undefined {
    return this.run(1);
  }
  /** Only repeats the ticks that had wrong predictions: while the session waits, and after the last tick. */
  correct(): RollbackReport {
    return this.run(0)!;
  }
  private run(more: number): RollbackReport | undefined {
    this.requireReady();
    this.state = 'making ticks';
    const status = statuses[this.module.ask('rollback_advance', this.handle, more)];
    this.state = this.thrown === undefined ? 'ready' : 'over';
    if (this.thrown !== undefined) throw this.thrown.error;
    if (status === 'waiting') return undefined;
    this.module.require(status === 'ok', status!);
    return this.module.get(fields.rollbackReport);
  }

  /** Ticks that the session has made. */
  tick(): number {
    this.requireReady();
    return this.module.ask('rollback_tick', this.handle);
  }
  /** The number of ticks whose inputs are all known and used. The state after these ticks is final. */
  confirmedTick(): number {
    this.requireReady();
    return this.module.ask('rollback_confirmed_tick', this.handle);
  }
  /** The game's own state; the array is valid until the next call that allocates memory. */
  game(): Uint8Array {
    this.requireReady();
    return this.module.bytes(this.gameAt, this.gameBytes);
  }

  /** The last checksums of confirmed ticks, the latest first. Send each as often as the network requires. */
  checksums(count = 1): TickChecksum[] {
    this.requireReady();
    this.module.require(whole(count, wordMax), 'out_of_range');
    this.module.ask('rollback_checksums', this.handle, count);
    const desk = this.module.desk();
    return Array.from({ length: desk.next() }, () => fields.tickChecksum.take(desk));
  }
  /**
   * Adds a checksum of a remote player; it is compared as soon as its tick is confirmed here. Returns desync(). Throws
   * `out_of_range` if it is too old or too far ahead to be compared.
   */
  addChecksum(player: number, { tick, checksum }: TickChecksum): Desync | undefined {
    this.requirePlayer(player);
    this.requireTick(tick);
    this.module.require(whole(checksum, wordMax), 'out_of_range');
    const code = this.module.ask('rollback_add_checksum', this.handle, player, tick, checksum);
    if (statuses[code] !== 'digest_differs') this.module.check(code);
    return this.desync();
  }
  /** The first tick after which the machines differ, if one is known. */
  desync(): Desync | undefined {
    this.requireReady();
    this.module.ask('rollback_desync', this.handle);
    const desk = this.module.desk();
    return desk.next() === 0 ? undefined : fields.desync.take(desk);
  }
}
