/** The page's controls: what is shown of a recording, when, and how it is chosen. */
import { type BodyId } from '../src/index.js';
import { rampGradient, type ColourBy } from './colours.js';
import { extentOf, placesOf, type Extent } from './extent.js';
import { Inspector } from './inspector.js';
import { digits } from './numbers.js';
import { Playback } from './playback.js';
import { losses } from './series.js';
import { Stage, type Look } from './stage.js';
import { Timeline } from './timeline.js';
import { element, notice } from './elements.js';
import { verdictOf } from './verdict.js';

const speeds = [1 / 16, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8];
/** Of a frame, ms: what verifying, and what catching up with the clock, may take. */
const verifyBudget = 12;
const playBudget = 12;
/** What is played before the first frame, to see where the bodies go: ticks, and work as workOf() counts it. No time, for the
 *  camera shall be the same on every machine. */
const surveyTicks = 90;
const surveyWork = 6000;
/** Bodies that travel so many times their extent are seen where they start. */
const travelFactor = 12;

export class Viewer {
  private readonly timeline: Timeline;
  private readonly inspector: Inspector;
  private readonly stage: Stage | undefined;
  private readonly look: Look = {
    colourBy: 'island',
    contacts: false,
    joints: true,
    bounds: false,
    follow: false,
    speedMax: 0,
  };
  private selected: BodyId | undefined;
  private playing = false;
  private speed = 1;
  private due = 0;
  private then = performance.now();
  private stale = true;
  private readonly tickSeconds: number;

  constructor(private readonly playback: Playback) {
    this.tickSeconds = playback.shown.settings().tick;
    this.timeline = new Timeline(element('timeline'), playback, (tick) => this.scrub(tick));
    this.inspector = new Inspector(element('inspector'), (id) => this.select(id));
    try {
      this.stage = new Stage(element('stage'), this.survey());
    } catch {
      notice('This browser has no WebGL, or it is switched off: the recording is verified, but not drawn.');
    }
    this.bindButtons();
    this.bindKeys();
    this.bindPicking();
    requestAnimationFrame((now) => this.frame(now));
  }

  /** Where bodies are in the first part of the recording. */
  private survey(): Extent {
    const { playback } = this;
    playback.verifyWork(surveyTicks, surveyWork);
    const [start, ...later] = [0, 0.5, 1].map((share) => {
      playback.goTo(playback.first + share * (playback.verified - playback.first));
      return placesOf(playback.shown);
    });
    playback.goTo(playback.first);
    const first = extentOf(start!);
    const all = extentOf([...start!, ...later.flat()]);
    return all.radius > travelFactor * first.radius ? first : all;
  }

  private frame(now: number): void {
    const seconds = Math.min(0.1, (now - this.then) / 1000);
    this.then = now;
    if (this.playing) this.play(seconds);
    if (this.stale) this.refresh();
    this.stage?.render();
    document.body.dataset['firstFrame'] ??= performance.now().toFixed(0);
    if (!this.playback.finished) {
      this.playback.verifyFor(verifyBudget);
      if (this.playback.tick > this.playback.end) this.scrub(this.playback.end);
    }
    this.timeline.draw();
    this.showVerdict();
    requestAnimationFrame((later) => this.frame(later));
  }
  private play(seconds: number): void {
    this.due += (seconds * this.speed) / this.tickSeconds;
    const until = performance.now() + playBudget;
    while (this.due >= 1 && this.playing && performance.now() < until) {
      this.due -= 1;
      this.stale = true;
      if (!this.playback.goTo(this.playback.tick + 1) || this.playback.tick >= this.playback.end)
        this.setPlaying(false);
    }
    this.due = Math.min(this.due, 1); // a machine that is too slow plays slower, and does not fall behind
  }

  private scrub(tick: number): void {
    this.setPlaying(false);
    this.go(tick);
  }
  private go(tick: number): void {
    this.playback.goTo(tick);
    this.stale = true;
  }
  private setPlaying(playing: boolean): void {
    if (playing && this.playback.tick >= this.playback.end) this.go(this.playback.first);
    this.playing = playing;
    this.due = 0;
    element('play').classList.toggle('on', playing);
    element('play').title = playing ? 'pause (space)' : 'play (space)';
  }
  private select(id: BodyId | undefined): void {
    this.selected = id;
    this.stale = true;
    if (id === undefined) this.setLook('follow', false);
    element<HTMLButtonElement>('follow').disabled = id === undefined;
  }
  private setLook<Key extends keyof Look>(key: Key, value: Look[Key]): void {
    this.look[key] = value;
    for (const button of document.querySelectorAll<HTMLElement>('[data-look]')) {
      const name = button.dataset['look'] as keyof Look;
      const on = name === 'colourBy' ? this.look.colourBy === button.dataset['value'] : this.look[name] === true;
      button.classList.toggle('on', on);
      button.setAttribute('aria-pressed', String(on));
    }
    this.stale = true;
  }
  private resetCamera(): void {
    this.setLook('follow', false);
    this.stage?.resetCamera();
  }
  private setSpeed(speed: number): void {
    this.speed = speed;
    element<HTMLSelectElement>('speed').value = String(speed);
  }

  /** Shows the present tick. */
  private refresh(): void {
    this.stale = false;
    const { shown, tick, report } = this.playback;
    if (this.look.colourBy === 'speed') {
      for (const row of shown.bodies()) {
        if (row.type !== 'fixed') this.look.speedMax = Math.max(this.look.speedMax, row.speed);
      }
    }
    this.stage?.update(shown, this.look, this.selected);
    this.inspector.update(shown, this.stage?.bodies.rows ?? shown.bodies(), this.selected);
    element('tick').textContent = String(tick);
    element('time').textContent = `${(tick * this.tickSeconds).toFixed(2)} s`;
    element('lost').textContent = losses(report)
      .map(([name, count]) => `${count} ${name}`)
      .join(', ');
    this.showLegend();
    document.body.dataset['tick'] = String(tick);
  }
  private showLegend(): void {
    const { colourBy, contacts, speedMax } = this.look;
    const ramp = element('ramp');
    ramp.hidden = colourBy !== 'speed';
    ramp.style.backgroundImage = rampGradient;
    element('legend').textContent =
      colourBy === 'speed'
        ? `0 to ${digits(speedMax)} m/s`
        : colourBy === 'sleep'
          ? 'orange: awake, blue: asleep, grey: fixed'
          : 'a colour for each island; pale: asleep';
    const impulse = this.stage?.overlays.impulseMax ?? 0;
    element('impulse').textContent = contacts && impulse > 0 ? `longest normal: ${digits(impulse)} N s` : '';
  }
  private showVerdict(): void {
    const { kind, text, detail } = verdictOf(this.playback, () => this.playback.finalDigest());
    const pill = element('verdict');
    if (pill.textContent === text) return;
    pill.textContent = text;
    pill.title = detail;
    pill.className = kind;
    document.body.dataset['verdict'] = kind;
    if (kind === 'bad') notice(`${text}: ${detail}`);
  }

  private bindButtons(): void {
    const { playback } = this;
    const actions: Record<string, () => void> = {
      start: () => this.scrub(playback.first),
      back: () => this.scrub(playback.tick - 1),
      play: () => this.setPlaying(!this.playing),
      forward: () => this.scrub(playback.tick + 1),
      end: () => this.scrub(playback.end),
      reset: () => this.resetCamera(),
      help: () => toggleHelp(),
    };
    for (const [id, action] of Object.entries(actions)) element(id).onclick = action;
    for (const button of document.querySelectorAll<HTMLElement>('[data-look]')) {
      const key = button.dataset['look'] as 'contacts';
      button.onclick = () => this.setLook(key, (button.dataset['value'] as never) ?? !this.look[key]);
    }
    // A button that was clicked does not keep the keys: space plays.
    document.addEventListener('click', ({ target, detail }) => {
      if (detail > 0 && target instanceof Element) target.closest('button')?.blur();
    });
    const speed = element<HTMLSelectElement>('speed');
    for (const each of speeds) speed.add(new Option(each < 1 ? `1/${1 / each} ×` : `${each} ×`, String(each)));
    speed.onchange = () => this.setSpeed(Number(speed.value));
    this.setSpeed(1);
    this.setLook('colourBy', 'island');
    this.select(undefined);
  }
  private bindKeys(): void {
    const { playback } = this;
    const faster = (by: number) =>
      this.setSpeed(speeds[Math.min(speeds.length - 1, Math.max(0, speeds.indexOf(this.speed) + by))]!);
    const colour = (by: ColourBy) => this.setLook('colourBy', by);
    const keys: Record<string, (shift: boolean) => void> = {
      ' ': () => this.setPlaying(!this.playing),
      ArrowLeft: (shift) => this.scrub(playback.tick - (shift ? 10 : 1)),
      ArrowRight: (shift) => this.scrub(playback.tick + (shift ? 10 : 1)),
      Home: () => this.scrub(playback.first),
      End: () => this.scrub(playback.end),
      '[': () => faster(-1),
      ']': () => faster(1),
      '1': () => colour('island'),
      '2': () => colour('sleep'),
      '3': () => colour('speed'),
      c: () => this.setLook('contacts', !this.look.contacts),
      j: () => this.setLook('joints', !this.look.joints),
      b: () => this.setLook('bounds', !this.look.bounds),
      f: () => this.setLook('follow', this.selected !== undefined && !this.look.follow),
      r: () => this.resetCamera(),
      Escape: () => (element('keys').hidden ? this.select(undefined) : toggleHelp()),
      '?': () => toggleHelp(),
    };
    window.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || event.target instanceof HTMLSelectElement) return;
      const action = keys[event.key];
      if (action === undefined) return;
      event.preventDefault();
      action(event.shiftKey);
    });
  }
  /** A click that is not a drag of the camera chooses a body. */
  private bindPicking(): void {
    const canvas = element('stage');
    let from: [number, number] = [0, 0];
    canvas.addEventListener('pointerdown', (event) => (from = [event.offsetX, event.offsetY]));
    canvas.addEventListener('click', (event) => {
      if (Math.hypot(event.offsetX - from[0], event.offsetY - from[1]) < 4) {
        this.select(this.stage?.pick(event.offsetX, event.offsetY));
      }
    });
  }
}

function toggleHelp(): void {
  element('keys').hidden = !element('keys').hidden;
}
