/** What is shown of a world, of a recording or a live one: the look, the chosen body, the camera. */
import type { BodyId, WorldView } from '../src/index.js';
import { rampGradient, type ColourBy } from './colours.js';
import { element, notice } from './elements.js';
import type { Extent } from './extent.js';
import { Inspector } from './inspector.js';
import { digits } from './numbers.js';
import { Stage, type Beside, type Look } from './stage.js';

/** A click moves less. */
export const clickPixels = 4;

export class Scenery {
  readonly stage: Stage | undefined;
  selected: BodyId | undefined;
  /** Something has changed since show(). */
  stale = true;
  /** Nothing of this world has been shown yet. */
  private fresh = true;
  private readonly inspector: Inspector;
  private readonly look: Look = {
    colourBy: 'island',
    contacts: false,
    joints: true,
    bounds: false,
    follow: false,
    glass: false,
    speedMax: 0,
  };

  /** `undrawn`: what a page says that cannot draw. `extent`: what the camera looks at if it is reset; else what open() got. */
  constructor(
    undrawn: string,
    private readonly extent?: () => Extent | undefined,
  ) {
    this.inspector = new Inspector(element('inspector'), (id) => this.select(id));
    try {
      this.stage = new Stage(element('stage'));
    } catch {
      notice(undrawn);
    }
    this.bindButtons();
    this.bindPicking();
  }

  /** Begins with another world. */
  open(extent: Extent): void {
    this.stage?.open(extent);
    this.look.speedMax = 0;
    this.setLook('glass', false);
    this.select(undefined);
    this.fresh = true;
  }
  show(world: WorldView, beside: Beside = { marks: [] }): void {
    this.stale = false;
    if (this.look.colourBy === 'speed') {
      for (const row of world.bodies()) {
        if (row.type !== 'fixed') this.look.speedMax = Math.max(this.look.speedMax, row.speed);
      }
    }
    this.stage?.update(world, this.look, this.selected, beside);
    if (this.fresh && this.stage?.hidden) this.setLook('glass', true);
    this.fresh = false;
    this.inspector.update(world, this.stage?.bodies.rows ?? world.bodies(), this.selected);
    this.showLegend();
  }
  render(): void {
    this.stage?.render();
    document.body.dataset['firstFrame'] ??= performance.now().toFixed(0);
  }
  select(id: BodyId | undefined): void {
    this.selected = id;
    this.stale = true;
    if (id === undefined) this.setLook('follow', false);
    element<HTMLButtonElement>('follow').disabled = id === undefined;
  }

  /** The keys that change what is shown. */
  keys(): Record<string, (shift: boolean) => void> {
    const colour = (by: ColourBy) => this.setLook('colourBy', by);
    return {
      '1': () => colour('island'),
      '2': () => colour('sleep'),
      '3': () => colour('speed'),
      c: () => this.setLook('contacts', !this.look.contacts),
      j: () => this.setLook('joints', !this.look.joints),
      b: () => this.setLook('bounds', !this.look.bounds),
      g: () => this.setLook('glass', !this.look.glass),
      f: () => this.setLook('follow', this.selected !== undefined && !this.look.follow),
      r: () => this.resetCamera(),
      Escape: () => (element('keys').hidden ? this.select(undefined) : toggleHelp()),
      '?': () => toggleHelp(),
    };
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
    const extent = this.extent?.();
    if (extent === undefined) this.stage?.resetCamera();
    else this.stage?.refit(extent);
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

  private bindButtons(): void {
    element('reset').onclick = () => this.resetCamera();
    element('help').onclick = () => toggleHelp();
    for (const button of document.querySelectorAll<HTMLElement>('[data-look]')) {
      const key = button.dataset['look'] as 'contacts';
      button.onclick = () => this.setLook(key, (button.dataset['value'] as never) ?? !this.look[key]);
    }
    // A button that was clicked does not keep the keys: space plays.
    document.addEventListener('click', ({ target, detail }) => {
      if (detail > 0 && target instanceof Element) target.closest('button')?.blur();
    });
    this.setLook('colourBy', 'island');
  }
  /** A click that is not a drag of the camera chooses a body. */
  private bindPicking(): void {
    const canvas = element('stage');
    let from: [number, number] = [0, 0];
    canvas.addEventListener('pointerdown', (event) => (from = [event.offsetX, event.offsetY]));
    canvas.addEventListener('click', (event) => {
      if (Math.hypot(event.offsetX - from[0], event.offsetY - from[1]) < clickPixels) {
        this.select(this.stage?.pick(event.offsetX, event.offsetY)?.id);
      }
    });
  }
}

/** Calls the function of a key that is pressed outside of a field. */
export function bindKeys(keys: Record<string, (shift: boolean) => void>): void {
  window.addEventListener('keydown', (event) => {
    const field = event.target instanceof HTMLSelectElement || event.target instanceof HTMLInputElement;
    if (event.ctrlKey || event.metaKey || event.altKey || field) return;
    const action = keys[event.key];
    if (action === undefined) return;
    event.preventDefault();
    action(event.shiftKey);
  });
}

function toggleHelp(): void {
  element('keys').hidden = !element('keys').hidden;
}
