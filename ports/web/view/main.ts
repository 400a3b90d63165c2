/** The page of `detent view`: a recording, replayed and verified as it is looked at. */
import { load, type Detent, type ReplayProblem } from '../src/index.js';
import { element, notice } from './elements.js';
import { embedded, moduleBytes, type Embedded } from './embedded.js';
import { Playback } from './playback.js';
import { refusal } from './verdict.js';
import { Viewer } from './viewer.js';

function refuse(text: string): void {
  notice(text);
  element('verdict').textContent = 'not shown';
  document.body.dataset['verdict'] = element('verdict').className = 'bad';
}

function describe({ name }: Embedded, playback: Playback): void {
  const { header } = playback.shown;
  const seconds = (playback.last - playback.first) * playback.shown.settings().tick;
  document.title = `${name} – Detent`;
  element('name').textContent = name;
  element('about').textContent =
    `${header.config}, ${playback.last - playback.first} ticks, ${seconds.toFixed(1)} s, ${playback.shown.info().bodies} bodies`;
  element('last').textContent = String(playback.last);
}

async function main(): Promise<void> {
  const data = embedded(document);
  if (data === undefined) return refuse('This page is a template: detent view writes a recording into it.');
  element('name').textContent = data.name;
  let detent: Detent;
  try {
    detent = await load(await moduleBytes(document));
  } catch {
    return refuse('This browser cannot run WebAssembly, or is too old for this page.');
  }
  const header = detent.openRecording(data.recording).header;
  try {
    const playback = Playback.open(detent, data.recording, data.assets);
    describe(data, playback);
    new Viewer(playback);
  } catch (error) {
    if (typeof (error as ReplayProblem).tick === 'number')
      refuse(refusal(error as ReplayProblem, header, detent.simulationVersion));
    else refuse(`This recording cannot be shown: ${String(error)}`);
  }
}

void main();
