// node view/pack.mjs <page>
// Compresses the scenes and assets of a page that `detent view` has written: those of many scenes are mostly zeros.
import { readFileSync, writeFileSync } from 'node:fs';
import { argv } from 'node:process';
import { gzipSync } from 'node:zlib';

const packed = (base64) => gzipSync(Buffer.from(base64, 'base64'), { level: 9 }).toString('base64');
const page = readFileSync(argv[2], 'utf8').replace(
  /(<script class="(?:scene|asset)" type="text\/plain"[^>]*)>([A-Za-z0-9+/=]*)/g,
  (_, start, base64) => `${start} data-packed="gzip">${packed(base64)}`,
);
writeFileSync(argv[2], page);
