/** The page of two players: two machines of one match, and the network between them. */
import { Detent } from '../src/index.js';
import { Module } from '../src/module.js';
import { element, notice } from './elements.js';
import { moduleBytes } from './embedded.js';
import { Machine, type Message } from './machine.js';
import { extent, field, input, type Match } from './match.js';
import { Link, seeded, type Conditions } from './network.js';
import { Stage, type Look } from './stage.js';

const tickMs = 1000 / 60;
/** Of a frame, ms: what the ticks may take at the speed of the clock, and as fast as it can. */
const budget = { clock: 24, fast: 100 };
/** A player that plays by itself changes its aim after so many ticks. */
const aimTicks = 45;
const seed = 1;

/** Of the address: settings (#delay=100&jitter=20&loss=5&fast), and a tick at which the match is paused (pause=300). */
const given = new URLSearchParams(location.hash.slice(1));

const keys: Record<string, number>[] = [
  { KeyW: input.up, KeyA: input.left, KeyS: input.down, KeyD: input.right, Space: input.jump },
  { ArrowUp: input.up, ArrowLeft: input.left, ArrowDown: input.down, ArrowRight: input.right, Enter: input.jump },
];

/** What a player does that plays by itself: it goes to places that a seed decides, and now and then jumps. */
function seededInput({ world, balls }: Match, player: number, tick: number): number {
  const random = seeded(2 * Math.floor(tick / aimTicks) + player + seed);
  const aim = () => (2 * random() - 1) * (field - 2);
  const [x, z] = [aim(), aim()];
  const [atX, , atZ] = world.pose(balls[player]!).position;
  const along = (way: number, less: number, more: number) => (Math.abs(way) < 0.5 ? 0 : way < 0 ? less : more);
  const jump = tick % aimTicks === 0 && random() < 0.4 ? input.jump : 0;
  return along(x - atX, input.left, input.right) | along(z - atZ, input.up, input.down) | jump;
}

/** One half of the page. */
class Side {
  readonly held = new Set<string>();
  auto = true;
  private readonly stage: Stage | undefined;
  private readonly look: Look = {
    colourBy: 'island',
    contacts: false,
    joints: false,
    bounds: false,
    follow: false,
    glass: false,
    speedMax: 0,
  };
  private readonly rows: Map<string, HTMLElement>;

  constructor(
    private readonly part: HTMLElement,
    readonly player: number,
    private readonly machine: () => Machine,
  ) {
    try {
      this.stage = new Stage(part.querySelector('canvas')!);
    } catch {
      notice('This browser has no WebGL, or it is switched off: the match runs, but is not drawn.');
    }
    this.rows = new Map(
      ['tick', 'predicted ticks', 'ticks rolled back', 'waits'].map((name) => {
        const row = part.querySelector('table')!.insertRow();
        row.insertCell().textContent = name;
        return [name, row.insertCell()];
      }),
    );
    const button = part.querySelector<HTMLButtonElement>('.auto')!;
    button.onclick = () => {
      this.auto = !this.auto;
      button.blur();
    };
    const gravity = part.querySelector<HTMLInputElement>('.gravity')!;
    gravity.oninput = () => (this.machine().gravity = Number(gravity.value));
    gravity.onchange = () => gravity.blur(); // the keys are the players' again
  }

  /** Looks at a new match. */
  open(): void {
    this.stage?.open(extent);
  }
  input(tick: number): number {
    if (this.auto) return seededInput(this.machine().match, this.player, tick);
    return [...this.held].reduce((bits, code) => bits | keys[this.player]![code]!, 0);
  }
  show(other: Machine): void {
    const machine = this.machine();
    const { match, counts, tick, confirmed } = machine;
    const own = match.balls[this.player];
    this.stage?.update(match.world, this.look, own, { marks: [], second: other.match.world });
    this.stage?.render();
    const text = (name: string, value: string | number) => (this.rows.get(name)!.textContent = String(value));
    text('tick', `${tick}, ${confirmed} final`);
    text('predicted ticks', counts.predicted);
    text('ticks rolled back', `${counts.again}, at most ${counts.mostAgain} at once`);
    text('waits', counts.waits);
    this.part.querySelector('.auto')!.classList.toggle('on', this.auto);
    const gravity = this.part.querySelector<HTMLInputElement>('.gravity')!;
    if (document.activeElement !== gravity) gravity.value = String(machine.gravity);
    this.part.querySelector('output')!.textContent = `${machine.gravity.toFixed(1)} m/s²`;
  }
}

class Players {
  private machines!: Machine[];
  private links!: Link<Message>[];
  private readonly sides: Side[];
  /** ms, of the network. */
  private now = 0;
  private due = 0;
  private readonly stopAt = Number(given.get('pause') ?? NaN);
  private then = performance.now();
  private readonly fast: () => boolean;
  private readonly paused: () => boolean;
  private readonly conditions: Conditions = { delay: 0, jitter: 0, loss: 0 };

  constructor(private readonly detent: Detent) {
    this.sides = [...document.querySelectorAll<HTMLElement>('.player')].map(
      (part, player) => new Side(part, player, () => this.machines[player]!),
    );
    this.bindSliders();
    this.bindKeys();
    this.fast = bindSwitch('fast', given.has('fast'));
    this.paused = bindSwitch('pause', false);
    element('start').onclick = () => this.start();
    // A button that was clicked does not keep the keys.
    document.addEventListener('click', ({ target }) => target instanceof HTMLButtonElement && target.blur());
    this.start();
    requestAnimationFrame((now) => this.frame(now));
  }

  private start(): void {
    this.machines?.forEach((machine) => machine.close());
    this.machines = [0, 1].map((player) => new Machine(this.detent, player));
    this.links = [0, 1].map((player) => new Link(seeded(1000 * seed + player)));
    this.now = this.due = 0;
    for (const side of this.sides) side.open();
  }

  private frame(now: number): void {
    this.due += Math.min(100, now - this.then) / tickMs;
    this.then = now;
    const fast = this.fast();
    const until = performance.now() + (fast ? budget.fast : budget.clock);
    while (!this.paused() && (fast || this.due >= 1) && performance.now() < until) {
      this.due -= 1;
      this.makeTick();
      if (this.machines[0]!.tick === this.stopAt) element('pause').click();
    }
    this.due = Math.min(Math.max(0, this.due), 1);
    this.show();
    requestAnimationFrame((later) => this.frame(later));
  }
  private makeTick(): void {
    const [a, b] = this.machines as [Machine, Machine];
    this.now += tickMs;
    this.links[0]!.receive(this.now).forEach((message) => b.receive(message));
    this.links[1]!.receive(this.now).forEach((message) => a.receive(message));
    this.machines.forEach((machine, player) => {
      machine.advance((tick) => this.sides[player]!.input(tick));
      this.links[player]!.send(this.now, machine.message(), this.conditions);
    });
  }

  private show(): void {
    this.sides.forEach((side, player) => side.show(this.machines[1 - player]!));
    const agreed = Math.min(...this.machines.map((machine) => machine.agreed));
    const differs = Math.min(...this.machines.map(({ desync }) => desync?.tick ?? Infinity));
    const pill = element('verdict');
    pill.textContent = differs === Infinity ? `both agree after ${agreed} ticks` : `they differ since tick ${differs}`;
    pill.title = 'Each machine compares the checksums of the other one with its own, tick by tick.';
    pill.className = differs === Infinity ? 'good' : 'bad';
    Object.assign(document.body.dataset, { verdict: pill.className, agreed, differs });
  }

  private bindSliders(): void {
    for (const [id, unit, scale] of [['delay', 'ms', 1], ['jitter', 'ms', 1], ['loss', '%', 100]] as const) {
      const slider = element<HTMLInputElement>(id);
      const take = () => {
        this.conditions[id] = Number(slider.value) / scale;
        slider.nextElementSibling!.textContent = `${slider.value} ${unit}`;
      };
      slider.oninput = take;
      slider.onchange = () => slider.blur();
      slider.value = given.get(id) ?? slider.value;
      take();
    }
  }
  private bindKeys(): void {
    const of = ({ code }: KeyboardEvent) => this.sides.find(({ player }) => code in keys[player]!);
    window.addEventListener('keydown', (event) => {
      const side = of(event);
      if (side === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
      if (event.target instanceof HTMLInputElement) return;
      event.preventDefault();
      side.auto = false;
      side.held.add(event.code);
    });
    window.addEventListener('keyup', (event) => of(event)?.held.delete(event.code));
    window.addEventListener('blur', () => this.sides.forEach(({ held }) => held.clear()));
  }
}

/** A button that is on or off; returns which. */
function bindSwitch(id: string, on: boolean): () => boolean {
  const button = element(id);
  button.onclick = () => button.classList.toggle('on');
  button.classList.toggle('on', on);
  return () => button.classList.contains('on');
}

async function main(): Promise<void> {
  new Players(new Detent(await Module.load(await moduleBytes(document) as BufferSource)));
}
main().catch((error: unknown) => {
  notice(`The match cannot be shown: ${String(error)}`);
  element('verdict').textContent = 'not shown';
  document.body.dataset['verdict'] = element('verdict').className = 'bad';
});
