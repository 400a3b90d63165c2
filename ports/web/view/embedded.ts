/** What `detent view` has written into the page: recordings or scenes, with their assets. */
import type { Named } from './compare.js';

/** A scene: the recording of its first ticks, and the indices of its assets. */
export interface EmbeddedScene {
  name: string;
  text: string;
  recording: () => Promise<Uint8Array>;
  assets: () => Promise<Uint8Array[]>;
}
export interface Embedded {
  recordings: Named[];
  scenes: EmbeddedScene[];
  /** Of the recordings. */
  assets: Uint8Array[];
}

export function bytesOf(base64: string): Uint8Array {
  const letters = atob(base64.trim());
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes;
}
async function unpacked(packed: Uint8Array): Promise<Uint8Array> {
  const stream = new Blob([packed as BlobPart]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The bytes in an element, which the build may have compressed. */
async function contentOf(from: HTMLElement): Promise<Uint8Array> {
  const bytes = bytesOf(from.textContent ?? '');
  return from.dataset['packed'] === undefined ? bytes : unpacked(bytes);
}

/** Undefined if the page is still a template. */
export function embedded(page: Document): Embedded | undefined {
  const all = (kind: string) => [...page.querySelectorAll<HTMLElement>(`script.${kind}`)];
  const [recordings, scenes, assets] = [all('recording'), all('scene'), all('asset')];
  if (recordings.length + scenes.length === 0) return undefined;
  const contents = new Map<number, Promise<Uint8Array>>();
  const asset = (index: number) => {
    if (!contents.has(index)) contents.set(index, contentOf(assets[index]!));
    return contents.get(index)!;
  };
  return {
    recordings: recordings.map((each) => ({
      name: each.dataset['name'] ?? 'recording',
      bytes: bytesOf(each.textContent ?? ''),
    })),
    scenes: scenes.map((each) => ({
      name: each.dataset['name'] ?? 'scene',
      text: each.dataset['text'] ?? '',
      recording: () => contentOf(each),
      assets: () => Promise.all((each.dataset['assets'] ?? '').split(' ').filter(Boolean).map(Number).map(asset)),
    })),
    assets: scenes.length > 0 ? [] : assets.map((each) => bytesOf(each.textContent ?? '')),
  };
}

/** The WebAssembly module, which the build has compressed. */
export async function moduleBytes(page: Document): Promise<Uint8Array> {
  return unpacked(bytesOf(page.querySelector('script.module')?.textContent ?? ''));
}
