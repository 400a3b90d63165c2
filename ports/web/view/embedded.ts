/** What `detent view` has written into the page: the recording, its assets and its name. */

export interface Embedded {
  name: string;
  recording: Uint8Array;
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
  const recording = page.querySelector<HTMLElement>('script.recording');
  if (recording === null) return undefined;
  return {
    name: recording.dataset['name'] ?? 'recording',
    recording: bytesOf(recording.textContent ?? ''),
    assets: [...page.querySelectorAll('script.asset')].map((asset) => bytesOf(asset.textContent ?? '')),
  };
}

/** The WebAssembly module, which the build has compressed. */
export async function moduleBytes(page: Document): Promise<ArrayBuffer> {
  const base64 = page.querySelector('script.module')?.textContent ?? '';
  const packed = new Blob([bytesOf(base64) as BlobPart]).stream();
  return new Response(packed.pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}
