/** The page's controls of a live scene: it runs, and the reader throws its bodies and changes its settings. */
import type { BodyId, Detent, Material } from '../src/index.js';
import type { Module } from '../src/module.js';
import { element, notice } from './elements.js';
import { extentNow, survey } from './extent.js';
import { Grab } from './grab.js';
import { LiveWorld, type LiveStep } from './live_world.js';
import { Playback } from './playback.js';
import { bindKeys, clickPixels, Scenery } from './scenery.js';
import { losses } from './series.js';
import { bindSpeeds, type Speeds } from './speeds.js';

/** Of a frame, ms: what the steps may take. */
const stepBudget = 24;

/** What is played before a scene is shown, to see where its bodies go. */
const surveyWork = 60000;

/** A scene as its page has it. */
export interface LiveScene {
  name: string;
  text: string;
  recording: Uint8Array;
  assets: Uint8Array[];
}

export class LiveViewer {
  private readonly scenery: Scenery;
  private readonly speeds: Speeds;
  private scene: LiveScene | undefined;
  private world: LiveWorld | undefined;
  private last: LiveStep | undefined;
  /** A body under the pressed mouse, and where it was pressed; it is held once the mouse has moved. */
  private taken: { grab: Grab; at: [number, number] } | undefined;
  private grab: Grab | undefined;
  /** The reader has made calls: the digests are no more the scene's. */
  private touched = false;
  /** A tick that differs from the scene's though the reader has changed nothing. */
  private differs: number | undefined;
  private agreed = 0;
  /** What the scene gave the bodies, by their ids. */
  private readonly materials = new Map<string, Material>();
  private tickSeconds = 1 / 60;
  private playing = false;
  private due = 0;
  private then = performance.now();

  constructor(
    private readonly detent: Detent,
    private readonly module: Module,
  ) {
    document.body.classList.add('live');
    this.scenery = new Scenery(
      'This browser has no WebGL, or it is switched off: the scene runs, but is not drawn.',
      () => this.world && extentNow(this.world),
    );
    this.speeds = bindSpeeds();
    this.bindButtons();
    this.bindSliders();
    this.bindMouse();
    bindKeys({
      ...this.scenery.keys(),
      ' ': () => this.setPlaying(!this.playing),
      ArrowRight: (shift) => this.stepBy(shift ? 10 : 1),
      Home: () => this.restart(),
      '[': () => this.speeds.change(-1),
      ']': () => this.speeds.change(1),
    });
    requestAnimationFrame((now) => this.frame(now));
  }

  /** Begins a scene, from its start. */
  open(scene: LiveScene): void {
    this.close();
    notice('');
    try {
      if (scene !== this.scene) this.survey(scene); // the camera stays if a scene starts again
      this.scene = scene;
      this.world = LiveWorld.open(this.module, scene.recording, scene.assets);
    } catch (error) {
      notice(`This scene cannot be shown: ${'text' in (error as object) ? (error as { text: string }).text : String(error)}`);
      this.verdict('bad', 'not shown', '');
      return;
    }
    this.tickSeconds = this.world.settings().tick;
    this.materials.clear();
    element<HTMLInputElement>('friction').value = '1';
    element('friction-value').textContent = '× 1';
    element('name').textContent = scene.name;
    element('about').textContent = scene.text;
    document.title = `${scene.name} – Detent`;
    document.body.dataset['scene'] = scene.name;
    this.setPlaying(true);
  }
  private survey(scene: LiveScene): void {
    const trial = Playback.open(this.detent, scene.recording, scene.assets);
    try {
      this.scenery.open(survey(trial, surveyWork));
    } finally {
      trial.close();
    }
  }
  private restart(): void {
    if (this.scene !== undefined) this.open(this.scene);
  }
  private close(): void {
    this.world?.destroy();
    this.letGo();
    this.world = this.last = this.differs = undefined;
    this.touched = false;
    this.agreed = 0;
  }

  private frame(now: number): void {
    const seconds = Math.min(0.1, (now - this.then) / 1000);
    this.then = now;
    if (this.playing) this.play(seconds);
    if (this.scenery.stale) this.refresh();
    if (this.world !== undefined) this.scenery.render();
    requestAnimationFrame((later) => this.frame(later));
  }
  private play(seconds: number): void {
    this.due += (seconds * this.speeds.speed) / this.tickSeconds;
    const until = performance.now() + stepBudget;
    while (this.due >= 1 && performance.now() < until) {
      this.due -= 1;
      this.step();
    }
    this.due = Math.min(this.due, 1);
  }
  private stepBy(ticks: number): void {
    this.setPlaying(false);
    for (let i = 0; i < ticks; ++i) this.step();
  }
  private step(): void {
    const { world } = this;
    if (world === undefined) return;
    if (this.taken !== undefined && !world.has(this.taken.grab.id)) this.letGo();
    if (this.grab !== undefined) this.change(() => this.grab!.pull(this.tickSeconds));
    this.last = world.advance();
    const { compared, agrees, report } = this.last;
    if (!this.touched && compared) {
      if (agrees) this.agreed = report.tick;
      else this.differs ??= report.tick;
    }
    this.scenery.stale = true;
  }
  /** Makes calls of the reader's. A refused call is told; the calls before it have changed the world. */
  private change(call: (world: LiveWorld) => void): void {
    if (this.world === undefined) return;
    this.touched = true;
    try {
      call(this.world);
    } catch (error) {
      notice(`Refused: ${error instanceof Error ? error.message : String(error)}`);
    }
    this.scenery.stale = true;
  }
  private setPlaying(playing: boolean): void {
    this.playing = playing;
    this.due = 0;
    this.scenery.stale = true;
    element('play').classList.toggle('on', playing);
    element('play').title = playing ? 'pause (space)' : 'play (space)';
  }

  /** Shows the present state. */
  private refresh(): void {
    const { world, last } = this;
    if (world === undefined) return;
    const point = this.grab?.point();
    this.scenery.show(world, { marks: [], pull: point && [point, this.grab!.target] });
    const { tick } = world.info();
    element('tick').textContent = String(tick);
    element('time').textContent = `${(tick * this.tickSeconds).toFixed(2)} s`;
    element('digest').textContent = this.playing ? '' : world.digest().toString(16).padStart(16, '0');
    const lost: [string, number][] = last === undefined ? [] : losses(last.report);
    if (last !== undefined && last.refused > 0) lost.push(['calls of the scene refused', last.refused]);
    element('lost').textContent = lost.map(([name, count]) => `${count} ${name}`).join(', ');
    document.body.dataset['tick'] = String(tick);
    document.body.dataset['held'] = this.grab === undefined ? '' : String(this.grab.id.slot);
    this.showSettings(world);
    this.showVerdict(tick);
  }
  private showVerdict(tick: number): void {
    if (this.differs !== undefined) {
      const text = `tick ${this.differs} differs`;
      return this.verdict('bad', text, `${text} from the scene as detent run plays it.`);
    }
    if (this.touched) return this.verdict('live', 'live, changed', 'Calls of the reader have changed this world.');
    if (this.agreed < tick) return this.verdict('live', 'live', 'The scene goes on after the ticks that were recorded.');
    this.verdict('good', 'as recorded', 'The digest after each tick is that of detent run.');
  }
  private verdict(kind: string, text: string, detail: string): void {
    const pill = element('verdict');
    pill.textContent = text;
    pill.title = detail;
    document.body.dataset['verdict'] = pill.className = kind;
  }

  private bindButtons(): void {
    const actions: Record<string, () => void> = {
      start: () => this.restart(),
      play: () => this.setPlaying(!this.playing),
      forward: () => this.stepBy(1),
      save: () => this.save(),
    };
    for (const [id, action] of Object.entries(actions)) element(id).onclick = action;
    element('start').title = 'start again (Home)';
  }
  private save(): void {
    if (this.world === undefined || this.scene === undefined) return;
    let recording: Uint8Array;
    try {
      recording = this.world.recording();
    } catch (error) {
      return notice(`The recording cannot be saved: ${error instanceof Error ? error.message : String(error)}`);
    }
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([recording as BlobPart]));
    link.download = `${this.scene.name.replaceAll(' ', '_')}.rec`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  }

  private bindSliders(): void {
    const slider = (id: string, apply: (world: LiveWorld, value: number) => void) => {
      const input = element<HTMLInputElement>(id);
      input.oninput = () => this.change((world) => apply(world, Number(input.value)));
      input.onchange = () => input.blur(); // the keys are the page's again
    };
    slider('gravity', (world, value) => {
      const [x, , z] = world.settings().gravity;
      world.setGravity([x, value, z]);
    });
    slider('substeps', (world, value) => world.setSettings({ substeps: value }));
    slider('friction', (world, value) => {
      element('friction-value').textContent = `× ${value}`;
      for (const { id } of world.bodies()) {
        const material = this.materialOf(world, id);
        world.setMaterial(id, { ...material, friction: Math.min(16, value * (material.friction ?? 0)) });
      }
    });
  }
  private materialOf(world: LiveWorld, id: BodyId): Material {
    const key = `${id.slot}.${id.generation}`;
    const material = this.materials.get(key) ?? world.body(id).def.material;
    this.materials.set(key, material);
    return material;
  }
  /** The scene's own calls may change them, too. */
  private showSettings(world: LiveWorld): void {
    const { gravity, substeps } = world.settings();
    for (const [id, value, text] of [
      ['gravity', gravity[1], `${gravity[1].toFixed(1)} m/s²`],
      ['substeps', substeps, substeps === 0 ? 'chosen' : String(substeps)],
    ] as const) {
      const input = element<HTMLInputElement>(id);
      if (document.activeElement !== input) input.value = String(value);
      element(`${id}-value`).textContent = text;
    }
  }

  /** The left button on a dynamic body holds it; elsewhere, and with the other buttons, it moves the camera. */
  private bindMouse(): void {
    const canvas = element('stage');
    const { stage } = this.scenery;
    if (stage === undefined) return;
    // Before the camera's own listener.
    canvas.addEventListener(
      'pointerdown',
      (event) => {
        const { world } = this;
        if (event.button !== 0 || world === undefined) return;
        const picked = stage.pick(event.offsetX, event.offsetY);
        if (picked === undefined || world.body(picked.id).def.type !== 'dynamic') return;
        stage.turns = false;
        canvas.setPointerCapture(event.pointerId);
        this.taken = { grab: new Grab(world, picked.id, picked.point), at: [event.offsetX, event.offsetY] };
      },
      { capture: true },
    );
    canvas.addEventListener('pointermove', (event) => {
      const { taken } = this;
      if (taken === undefined) return;
      const [x, y] = taken.at;
      if (Math.hypot(event.offsetX - x, event.offsetY - y) >= clickPixels) this.grab = taken.grab;
      taken.grab.target = stage.across(event.offsetX, event.offsetY, taken.grab.target);
      this.scenery.stale = true;
    });
    for (const name of ['pointerup', 'pointercancel', 'lostpointercapture'])
      canvas.addEventListener(name, () => this.letGo());
  }
  /** Lets the held body go, and the mouse turn the camera again. */
  private letGo(): void {
    if (this.taken === undefined) return;
    this.taken = this.grab = undefined;
    this.scenery.stage!.turns = true;
    this.scenery.stale = true;
  }
}
