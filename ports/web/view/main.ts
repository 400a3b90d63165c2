/** The page of `detent view`: one or two recordings, replayed and verified as they are looked at, or live scenes. */
import { Detent, type ReplayProblem } from '../src/index.js';
import { Module } from '../src/module.js';
import type { Named } from './compare.js';
import { element, notice } from './elements.js';
import { embedded, moduleBytes, type EmbeddedScene } from './embedded.js';
import { bindFiles } from './files.js';
import { LiveViewer } from './live.js';
import { Pair } from './pair.js';
import { Playback } from './playback.js';
import { bindSamples } from './samples.js';
import { refusal } from './verdict.js';
import { Viewer } from './viewer.js';

function refuse(text: string): void {
  notice(text);
  element('verdict').textContent = 'not shown';
  document.body.dataset['verdict'] = element('verdict').className = 'bad';
}

function describe(name: string, playback: Playback): void {
  const { header } = playback.shown;
  const seconds = (playback.last - playback.first) * playback.shown.settings().tick;
  document.title = `${name} – Detent`;
  element('name').textContent = name;
  element('about').textContent =
    `${header.config}, ${playback.last - playback.first} ticks, ${seconds.toFixed(1)} s, ${playback.shown.info().bodies} bodies`;
  element('last').textContent = String(playback.last);
}

function show(module: Module, recordings: Named[], assets: Uint8Array[]): void {
  const detent = new Detent(module);
  const [first, second] = recordings as [Named, Named?];
  const playback = Playback.open(detent, first.bytes, assets);
  describe(first.name, playback);
  const viewer = new Viewer(playback);
  const compare = (given: Named) => {
    const other = given.name === first.name ? { ...given, name: `${given.name} (second)` } : given;
    element('name').textContent = `${first.name} and ${other.name}`;
    viewer.compareWith(new Pair(detent, module, playback, first, other, assets));
  };
  if (second !== undefined) compare(second);
  bindFiles(compare);
}

function showLive(module: Module, scenes: EmbeddedScene[]): void {
  const viewer = new LiveViewer(new Detent(module), module);
  let chosen: EmbeddedScene | undefined;
  const choose = async (scene: EmbeddedScene) => {
    chosen = scene;
    try {
      const [recording, assets] = await Promise.all([scene.recording(), scene.assets()]);
      if (chosen === scene) viewer.open({ name: scene.name, text: scene.text, recording, assets });
    } catch (error) {
      refuse(`This scene cannot be read from the page: ${String(error)}`);
    }
  };
  if (scenes.length === 1) void choose(scenes[0]!);
  else bindSamples(scenes, (scene) => void choose(scene));
}

async function main(): Promise<void> {
  const data = embedded(document);
  if (data === undefined) return refuse('This page is a template: detent view writes a recording into it.');
  const { recordings, scenes, assets } = data;
  element('name').textContent = (recordings[0] ?? scenes[0])!.name;
  let module: Module;
  try {
    module = await Module.load((await moduleBytes(document)) as BufferSource);
  } catch {
    return refuse('This browser cannot run WebAssembly, or is too old for this page.');
  }
  if (scenes.length > 0) return showLive(module, scenes);
  try {
    show(module, recordings, assets);
  } catch (error) {
    const detent = new Detent(module);
    const { header } = detent.openRecording(recordings[0]!.bytes);
    if (typeof (error as ReplayProblem).tick === 'number')
      refuse(refusal(error as ReplayProblem, header, detent.simulationVersion));
    else refuse(`This recording cannot be shown: ${String(error)}`);
  }
}

void main();
