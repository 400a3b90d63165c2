/** What `detent view` has written into the page: one or two recordings with their names, and their assets. */
import type { Named } from './compare.js';

export interface Embedded {
  recordings: Named[];
  assets: Uint8Array[];
}

export function bytesOf(base64: string): Uint8Array {
  const letters = atob(base64.trim());
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

/** Undefined if the page is still a template. */
export function embedded(page: Document): Embedded | undefined {
  const recordings = [...page.querySelectorAll<HTMLElement>('script.recording')];
  if (recordings.length === 0) return undefined;
  return {
    recordings: recordings.map((each) => ({
      name: each.dataset['name'] ?? 'recording',
      bytes: bytesOf(each.textContent ?? ''),
    })),
    assets: [...page.querySelectorAll('script.asset')].map((asset) => bytesOf(asset.textContent ?? '')),
  };
}

/** The WebAssembly module, which the build has compressed. */
export async function moduleBytes(page: Document): Promise<ArrayBuffer> {
  const base64 = page.querySelector('script.module')?.textContent ?? '';
  const packed = new Blob([bytesOf(base64) as BlobPart]).stream();
  return new Response(packed.pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}
