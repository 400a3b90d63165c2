// node ports/wasm/run.mjs <program.wasm> [argument...]
// Runs a WASI program with its arguments and the host's files by their own names; its exit code is ours.
import { readFile } from 'node:fs/promises';
import { argv, cwd, exit } from 'node:process';
import { WASI } from 'node:wasi';

const args = argv.slice(2);
const wasi = new WASI({
  version: 'preview1',
  args,
  env: { PWD: cwd() },
  preopens: { '/': '/' },
  returnOnExit: true,
});
const program = await WebAssembly.compile(await readFile(args[0]));
exit(wasi.start(await WebAssembly.instantiate(program, { wasi_snapshot_preview1: wasi.wasiImport })));
