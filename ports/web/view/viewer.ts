/** The page's controls of a recording: what is shown of it, and when. */
import { element, notice } from './elements.js';
import { survey } from './extent.js';
import type { Pair } from './pair.js';
import type { Playback } from './playback.js';
import { bindKeys, Scenery } from './scenery.js';
import { losses } from './series.js';
import { bindSpeeds, type Speeds } from './speeds.js';
import { Timeline } from './timeline.js';
import { verdictOf } from './verdict.js';

/** Of a frame, ms: what verifying, and what catching up with the clock, may take. */
const verifyBudget = 12;
const playBudget = 12;
export class Viewer {
  private readonly timeline: Timeline;
  private readonly scenery: Scenery;
  private readonly speeds: Speeds;
  private readonly tickSeconds: number;
  private pair: Pair | undefined;
  private playing = false;
  private due = 0;
  private then = performance.now();

  constructor(private readonly playback: Playback) {
    this.tickSeconds = playback.shown.settings().tick;
    this.timeline = new Timeline(element('timeline'), playback, (tick) => this.scrub(tick));
    this.scenery = new Scenery(
      'This browser has no WebGL, or it is switched off: the recording is verified, but not drawn.',
    );
    this.scenery.open(survey(playback));
    this.speeds = bindSpeeds();
    this.bindButtons();
    this.bindKeys();
    requestAnimationFrame((now) => this.frame(now));
  }

  /** Shows a second recording, too; it replaces an earlier second one. */
  compareWith(pair: Pair): void {
    this.pair?.close();
    this.pair = pair;
    this.setPlaying(false);
    notice('');
    element('verdict').textContent = ''; // or the same verdict as before would not be told again
    this.scenery.stale = true;
  }

  private frame(now: number): void {
    const seconds = Math.min(0.1, (now - this.then) / 1000);
    this.then = now;
    if (this.playing) this.play(seconds);
    if (this.scenery.stale) this.refresh();
    this.scenery.render();
    this.verify();
    this.timeline.draw(this.pair?.stop);
    this.showVerdict();
    requestAnimationFrame((later) => this.frame(later));
  }
  private verify(): void {
    const { playback, pair } = this;
    if (!playback.finished) {
      playback.verifyFor(verifyBudget);
      if (playback.tick > playback.end) this.scrub(playback.end);
    } else if (pair !== undefined && !pair.finished) {
      pair.verifyFor(verifyBudget);
      if (pair.finished) this.scenery.stale = true;
    }
  }
  private play(seconds: number): void {
    this.due += (seconds * this.speeds.speed) / this.tickSeconds;
    const until = performance.now() + playBudget;
    while (this.due >= 1 && this.playing && performance.now() < until) {
      this.due -= 1;
      this.scenery.stale = true;
      if (!this.playback.goTo(this.playback.tick + 1) || this.playback.tick >= this.playback.end)
        this.setPlaying(false);
      if (this.playback.tick === this.pair?.stop) this.setPlaying(false);
    }
    this.due = Math.min(this.due, 1); // a machine that is too slow plays slower, and does not fall behind
  }

  private scrub(tick: number): void {
    this.setPlaying(false);
    this.go(tick);
  }
  private go(tick: number): void {
    this.playback.goTo(tick);
    this.scenery.stale = true;
  }
  private setPlaying(playing: boolean): void {
    if (playing && this.playback.tick >= this.playback.end) this.go(this.playback.first);
    this.playing = playing;
    this.due = 0;
    element('play').classList.toggle('on', playing);
    element('play').title = playing ? 'pause (space)' : 'play (space)';
  }

  /** Shows the present tick. */
  private refresh(): void {
    const { shown, tick, report } = this.playback;
    this.scenery.show(shown, { marks: this.marks(), second: this.pair?.at(tick)?.shown });
    document.body.dataset['ghosts'] = String(this.scenery.stage?.ghostsDrawn ?? 0);
    element('ghosts').textContent = this.pair?.legend(tick) ?? '';
    element('tick').textContent = String(tick);
    element('time').textContent = `${(tick * this.tickSeconds).toFixed(2)} s`;
    element('lost').textContent = losses(report)
      .map(([name, count]) => `${count} ${name}`)
      .join(', ');
    document.body.dataset['tick'] = String(tick);
  }
  /** The bodies that differ, and those of the joints that do. */
  private marks(): number[] {
    const { shown, tick } = this.playback;
    const { bodies = [], joints = [] } = this.pair?.marks(tick) ?? {};
    const joined = shown
      .jointLines()
      .filter(({ id }) => joints.includes(id.slot))
      .flatMap(({ a, b }) => [a.slot, b.slot]);
    const marks = [...new Set([...bodies, ...joined])];
    document.body.dataset['marks'] = marks.join(' ');
    return marks;
  }
  private showVerdict(): void {
    const { kind, text, detail } =
      this.pair?.verdict() ?? verdictOf(this.playback, () => this.playback.finalDigest());
    const pill = element('verdict');
    if (pill.textContent === text && pill.title === detail) return;
    pill.textContent = text;
    pill.title = detail;
    pill.className = kind;
    document.body.dataset['verdict'] = kind;
    this.scenery.stale = true;
    element<HTMLButtonElement>('difference').disabled = this.pair?.stop === undefined;
    if (kind === 'bad') notice(this.pair === undefined ? `${text}: ${detail}` : detail);
  }

  private bindButtons(): void {
    const { playback } = this;
    const actions: Record<string, () => void> = {
      start: () => this.scrub(playback.first),
      back: () => this.scrub(playback.tick - 1),
      play: () => this.setPlaying(!this.playing),
      forward: () => this.scrub(playback.tick + 1),
      end: () => this.scrub(playback.end),
      difference: () => this.goToDifference(),
    };
    for (const [id, action] of Object.entries(actions)) element(id).onclick = action;
  }
  private goToDifference(): void {
    const stop = this.pair?.stop;
    if (stop !== undefined) this.scrub(stop);
  }
  private bindKeys(): void {
    const { playback } = this;
    bindKeys({
      ...this.scenery.keys(),
      ' ': () => this.setPlaying(!this.playing),
      ArrowLeft: (shift) => this.scrub(playback.tick - (shift ? 10 : 1)),
      ArrowRight: (shift) => this.scrub(playback.tick + (shift ? 10 : 1)),
      Home: () => this.scrub(playback.first),
      End: () => this.scrub(playback.end),
      '[': () => this.speeds.change(-1),
      ']': () => this.speeds.change(1),
      d: () => this.goToDifference(),
    });
  }
}
