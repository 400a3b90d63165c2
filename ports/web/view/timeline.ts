/** The time line: a track to scrub on, and under it the step report as graphs. */
import type { Playback } from './playback.js';
import { seriesDefs } from './series.js';

const labelWidth = 132;
const trackHeight = 18;
const rowHeight = 26;
const rowGap = 4;
const colours = {
  text: '#97a1ae',
  strong: '#e6e9ee',
  track: '#2a3039',
  verified: '#2f6f55',
  head: '#ffffff',
  fill: '#31506e',
  line: '#6fb3f2',
  bad: '#ff5d5d',
  badFill: '#7a2c2f',
  row: '#1c2129',
  good: '#4cc38a',
};

export class Timeline {
  private readonly to: CanvasRenderingContext2D;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly playback: Playback,
    scrub: (tick: number) => void,
  ) {
    this.to = canvas.getContext('2d')!;
    canvas.style.height = `${trackHeight + seriesDefs.length * (rowHeight + rowGap) + 4}px`;
    const drag = (event: PointerEvent) => scrub(this.tickAt(event.offsetX));
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      drag(event);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (canvas.hasPointerCapture(event.pointerId)) drag(event);
      const row = Math.floor((event.offsetY - trackHeight - rowGap) / (rowHeight + rowGap));
      canvas.title = event.offsetX < labelWidth ? (seriesDefs[row]?.text ?? '') : '';
    });
  }

  private get width(): number {
    return Math.max(1, this.canvas.clientWidth - labelWidth - 8);
  }
  private get span(): number {
    return Math.max(1, this.playback.last - this.playback.first);
  }
  private x(tick: number): number {
    return labelWidth + ((tick - this.playback.first) / this.span) * this.width;
  }
  private tickAt(x: number): number {
    const share = Math.min(1, Math.max(0, (x - labelWidth) / this.width));
    return this.playback.first + Math.round(share * this.span);
  }

  /** `mark`: a tick that is marked. */
  draw(mark?: number): void {
    const ratio = Math.min(window.devicePixelRatio, 2);
    const { clientWidth, clientHeight } = this.canvas;
    if (
      this.canvas.width !== Math.round(clientWidth * ratio) ||
      this.canvas.height !== Math.round(clientHeight * ratio)
    ) {
      this.canvas.width = Math.round(clientWidth * ratio);
      this.canvas.height = Math.round(clientHeight * ratio);
    }
    const { to } = this;
    to.setTransform(ratio, 0, 0, ratio, 0, 0);
    to.clearRect(0, 0, clientWidth, clientHeight);
    to.font = '11px system-ui, sans-serif';
    to.textBaseline = 'middle';
    this.drawTrack();
    if (mark !== undefined) {
      to.fillStyle = colours.bad;
      to.fillRect(this.x(mark) - 1, 0, 2, clientHeight);
    }
    seriesDefs.forEach((_, i) => this.drawSeries(i, trackHeight + rowGap + i * (rowHeight + rowGap)));
    this.drawHead(clientHeight);
  }

  private drawTrack(): void {
    const { to, playback } = this;
    const middle = trackHeight / 2;
    to.fillStyle = colours.text;
    to.fillText('verified', 8, middle);
    to.fillStyle = colours.track;
    to.fillRect(labelWidth, middle - 3, this.width, 6);
    to.fillStyle = colours.verified;
    to.fillRect(labelWidth, middle - 3, this.x(playback.verified) - labelWidth, 6);
    if (playback.problem === undefined) return;
    to.fillStyle = colours.bad;
    const from = this.x(playback.verified);
    to.fillRect(from, middle - 3, labelWidth + this.width - from, 6);
    to.fillRect(from - 1, 0, 2, trackHeight);
  }

  private drawSeries(index: number, top: number): void {
    const { to, playback } = this;
    const def = seriesDefs[index]!;
    const max = playback.series.max[index]!;
    const bad = def.lost === true && max > 0;
    to.fillStyle = bad ? colours.bad : colours.text;
    to.fillText(def.name, 8, top + rowHeight / 2);
    const now = playback.series.values[index]![playback.tick - playback.first] ?? 0;
    to.fillStyle = bad && now > 0 ? colours.bad : colours.strong;
    to.textAlign = 'right';
    to.fillText(`${now}`, labelWidth - 12, top + rowHeight / 2);
    to.textAlign = 'left';
    to.fillStyle = colours.row;
    to.fillRect(labelWidth, top, this.width, rowHeight);
    if (max === 0) {
      if (def.lost !== true) return;
      to.fillStyle = playback.finished && playback.problem === undefined ? colours.good : colours.text;
      to.fillText('nothing is lost', labelWidth + 8, top + rowHeight / 2);
      return;
    }
    this.drawArea(index, top, max, bad);
  }

  /** A column of a pixel shows the largest value of its ticks, so that a single tick is never left out. */
  private drawArea(index: number, top: number, max: number, bad: boolean): void {
    const { to, playback } = this;
    const perPixel = this.span / this.width;
    const until = Math.floor((playback.verified - playback.first) / perPixel);
    const base = top + rowHeight;
    to.beginPath();
    to.moveTo(labelWidth, base);
    for (let x = 0; x <= until; ++x) {
      const from = Math.floor(x * perPixel);
      const value = playback.series.peak(index, from, Math.max(from, Math.ceil((x + 1) * perPixel) - 1));
      to.lineTo(labelWidth + x, base - (value / max) * (rowHeight - 3));
    }
    to.lineTo(labelWidth + until, base);
    to.closePath();
    to.fillStyle = bad ? colours.badFill : colours.fill;
    to.fill();
    to.strokeStyle = bad ? colours.bad : colours.line;
    to.stroke();
    to.fillStyle = colours.text;
    to.textAlign = 'right';
    to.fillText(`${max}`, labelWidth + this.width - 4, top + 7);
    to.textAlign = 'left';
  }

  private drawHead(height: number): void {
    const x = this.x(this.playback.tick);
    this.to.fillStyle = colours.head;
    this.to.fillRect(x - 0.75, 0, 1.5, height);
    this.to.beginPath();
    this.to.arc(x, trackHeight / 2, 5, 0, 2 * Math.PI);
    this.to.fill();
  }
}
