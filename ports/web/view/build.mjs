// node view/build.mjs <folder of modules> <output folder> <configuration>...
// Writes the page of each configuration, view/CONFIGURATION.html, and players.html: the style, the code and the compressed
// WebAssembly module in one file.
import { readFileSync, writeFileSync } from 'node:fs';
import { argv } from 'node:process';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';

const [modules, output, ...configs] = argv.slice(2);
const here = (name) => fileURLToPath(new URL(name, import.meta.url));

const fill = (page, mark, text) => {
  if (page.split(mark).length !== 2) throw new Error(`a page needs ${mark} once`);
  return page.replace(mark, () => text);
};

/** The page NAME.html with NAME.css and the code, without its module. */
async function pageOf(name, code) {
  const bundle = await build({
    entryPoints: [here(code)],
    bundle: true,
    minify: true,
    format: 'iife',
    target: 'es2022',
    legalComments: 'inline',
    define: { 'import.meta.url': '""' },
    write: false,
  });
  const style = await build({ entryPoints: [here(`${name}.css`)], bundle: true, minify: true, write: false });
  // In a script element, "</script" and "<!--" would end or change it.
  const script = bundle.outputFiles[0].text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
  const page = readFileSync(here(`${name}.html`), 'utf8');
  return fill(fill(page, '/*style*/', style.outputFiles[0].text.trim()), '/*script*/', script);
}
const withModule = (page, module) =>
  fill(page, '/*module*/', gzipSync(readFileSync(`${modules}/${module}.small.wasm`), { level: 9 }).toString('base64'));

const view = await pageOf('page', 'main.ts');
for (const config of configs) writeFileSync(`${output}/view/${config}.html`, withModule(view, `view.${config}`));
writeFileSync(`${output}/players.html`, withModule(await pageOf('players', 'players.ts'), 'detent.fx64'));
