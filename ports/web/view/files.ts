/** Files that the reader drops on the page, or opens. They are read here, and sent nowhere. */
import type { Named } from './compare.js';
import { element } from './elements.js';

export function bindFiles(take: (file: Named) => void): void {
  const read = async (file: File | undefined) => {
    if (file !== undefined) take({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) });
  };
  const input = element<HTMLInputElement>('file');
  element('second').onclick = () => input.click();
  input.onchange = () => {
    void read(input.files?.[0]);
    input.value = ''; // the same file may be chosen again
  };
  window.addEventListener('dragover', (event) => event.preventDefault());
  window.addEventListener('drop', (event) => {
    event.preventDefault();
    void read(event.dataTransfer?.files[0]);
  });
}
