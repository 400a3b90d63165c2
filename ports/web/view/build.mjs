// node view/build.mjs <folder of modules> <output folder> <configuration>...
// Writes the page of each configuration: its style, its code and the compressed WebAssembly module in one file.
import { readFileSync, writeFileSync } from 'node:fs';
import { argv } from 'node:process';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';

const [modules, output, ...configs] = argv.slice(2);
const here = (name) => fileURLToPath(new URL(name, import.meta.url));

const bundle = await build({
  entryPoints: [here('main.ts')],
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2022',
  legalComments: 'inline',
  define: { 'import.meta.url': '""' },
  write: false,
});
const style = await build({ entryPoints: [here('page.css')], minify: true, write: false });
// In a script element, "</script" and "<!--" would end or change it.
const code = bundle.outputFiles[0].text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
const fill = (page, mark, text) => {
  if (page.split(mark).length !== 2) throw new Error(`page.html needs ${mark} once`);
  return page.replace(mark, () => text);
};
const page = fill(
  fill(readFileSync(here('page.html'), 'utf8'), '/*style*/', style.outputFiles[0].text.trim()),
  '/*script*/',
  code,
);
for (const config of configs) {
  const module = gzipSync(readFileSync(`${modules}/view.${config}.small.wasm`), { level: 9 }).toString('base64');
  writeFileSync(`${output}/${config}.html`, fill(page, '/*module*/', module));
}
