/** The list of scenes, at the left of a page that has several. */
import { element } from './elements.js';
import type { EmbeddedScene } from './embedded.js';

/** Of the scene that an address names, with "_" for " ", as files are called. An address may be anything. */
function nameIn(hash: string): string {
  try {
    return decodeURIComponent(hash.slice(1)).replaceAll('_', ' ');
  } catch {
    return '';
  }
}

/** The names of the scenes; the second one of a name is "name (2)". */
function namesOf(scenes: EmbeddedScene[]): string[] {
  return scenes.map(({ name }, i) => {
    const earlier = scenes.slice(0, i).filter((each) => each.name === name).length;
    return earlier === 0 ? name : `${name} (${earlier + 1})`;
  });
}

/** Calls `choose` with the scene that the reader chooses; with the first one, or that of the address, at once. */
export function bindSamples(scenes: EmbeddedScene[], choose: (scene: EmbeddedScene) => void): void {
  document.body.classList.add('samples');
  const names = namesOf(scenes);
  const rows = scenes.map((scene, i) => {
    const row = document.createElement('button');
    row.textContent = names[i]!;
    row.title = scene.text;
    row.onclick = () => {
      location.hash = encodeURIComponent(names[i]!.replaceAll(' ', '_'));
    };
    return row;
  });
  element('list').replaceChildren(...rows);

  const show = () => {
    const index = Math.max(0, names.indexOf(nameIn(location.hash)));
    rows.forEach((row, i) => row.classList.toggle('on', i === index));
    rows[index]!.scrollIntoView({ block: 'nearest' });
    choose(scenes[index]!);
  };
  window.addEventListener('hashchange', show);

  const search = element<HTMLInputElement>('search');
  search.oninput = () => {
    const words = search.value.toLowerCase().split(/\s+/);
    scenes.forEach(({ name, text }, i) => {
      const all = `${name} ${text}`.toLowerCase();
      rows[i]!.hidden = !words.every((word) => all.includes(word));
    });
    element('none').hidden = rows.some((row) => !row.hidden);
  };
  show();
}
