// What glass.mjs and effects.mjs share: what they need, the native program, and the page of all contestants.
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { basename, dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { answerWithFile, launch, listen, openPage } from '../browser-tools.mjs';
import { directionsHdr } from './glass-directions.mjs';

const here = dirname(fileURLToPath(import.meta.url));
export const root = resolve(here, '../..');
const vitrine = process.env.VITRINE_BINARY ?? join(root, 'build/release/vitrine');
const web = resolve(process.env.VITRINE_WEB ?? join(root, 'build/web'));

export function note(text) {
  process.stderr.write(`${text}\n`);
}

/** Is all there? The peers' packages are installed. @throws {Error} a sentence */
export function prepare({ model, environment, peers }) {
  for (const [file, remedy] of [
    [vitrine, 'cmake --preset release && cmake --build --preset release'],
    [join(web, 'vitrine-core.wasm'), 'scripts/build-web.sh'],
    [model, 'give --model, or run scripts/dependencies.sh and scripts/build-web.sh'],
    [environment, 'give --environment, or run scripts/dependencies.sh and scripts/build-web.sh'],
    [join(root, 'tests/node_modules/playwright-core'), 'scripts/dependencies.sh'],
  ]) {
    if (!existsSync(file)) throw new Error(`${file} is missing: ${remedy}`);
  }
  if (peers.length > 0 && !existsSync(join(here, 'node_modules/@react-three/drei'))) {
    note('installing the packages of tests/bench');
    const { status } = spawnSync('npm', ['--prefix', here, 'ci', '--no-audit', '--no-fund', '--loglevel=error'], { stdio: ['ignore', 2, 2] });
    if (status !== 0) throw new Error('npm ci failed in tests/bench');
  }
}

/** The native program; its standard output. */
export function run(...words) {
  return execFileSync(vitrine, words, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
}

/** Mean FLIP of a picture to another. */
export const flip = (picture, reference) => JSON.parse(run('compare', picture, reference, '--json')).flip;

const packages = ['three', '@react-three/drei', '@react-three/fiber', 'three-mesh-bvh'];
/** Their versions, by name. */
export const versions = () => Object.fromEntries(packages.map((name) => [name, JSON.parse(readFileSync(join(here, `node_modules/${name}/package.json`), 'utf8')).version]));

/** Serves the site, and `files` from elsewhere. */
function serveWith(site, files) {
  return listen((request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    const file = resolve(files[pathname] ?? join(site, pathname));
    answerWithFile(dirname(file), `/${basename(file)}`, response);
  });
}

/**
 * The page glass-page.js in a browser, built into `out`.
 * @returns {Promise<{browser: object, call: Function, complaints: string[], close: () => Promise<void>}>} call: of a method of window.bench
 */
export async function openSite({ out, model, environment, gl, peers }) {
  const { build } = await import('esbuild');
  mkdirSync(out, { recursive: true });
  await build({
    entryPoints: [join(here, 'glass-page.js')], bundle: true, minify: true, format: 'esm', target: 'es2022', logLevel: 'error',
    outfile: join(out, 'site/page.js'), define: { 'process.env.NODE_ENV': '"production"' },
    alias: { 'vitrine-core': join(web, 'element/core.js') },
    external: peers.length > 0 ? [] : ['./glass-peers.js'], // never loaded: its packages may be absent
  });
  writeFileSync(join(out, 'site/index.html'), '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><script type="module" src="/page.js"></script>');
  writeFileSync(join(out, 'site/directions.hdr'), directionsHdr());
  const server = await serveWith(join(out, 'site'), {
    '/': join(out, 'site/index.html'), '/model.glb': model, '/environment.hdr': environment,
    '/vitrine-core.wasm': join(web, 'vitrine-core.wasm'), '/vitrine-full.wasm': join(web, 'vitrine-full.wasm'), '/vitrine-shaders.txt': join(web, 'vitrine-shaders.txt'),
  });
  const variables = { ...process.env };
  if (gl === 'llvmpipe') variables.LIBGL_ALWAYS_SOFTWARE = '1';
  const browser = await launch(gl, { env: variables });
  const close = async () => {
    await browser.close();
    server.close();
  };
  try {
    const page = await openPage(browser, { viewport: { width: 900, height: 600 } });
    const complaints = [];
    page.on('console', (message) => {
      if (message.type() === 'error') complaints.push(message.text());
    });
    page.on('pageerror', (reason) => complaints.push(String(reason)));
    await page.goto(`${server.address}/`);
    await page.waitForFunction(() => window.bench !== undefined);
    const call = (name, ...values) => page.evaluate(([method, words]) => window.bench[method](...words), [name, values]);
    return { browser, call, complaints, close };
  } catch (reason) {
    await close();
    throw reason;
  }
}

/** Milliseconds of frames of each contestant, in turns, after two to warm up. @returns {Promise<number[][]>} */
export async function timeInTurns(call, keys, rounds) {
  for (const key of keys) {
    for (let i = 0; i < 2; ++i) await call('time', key);
  }
  const times = keys.map(() => []);
  for (let round = 0; round < rounds; ++round) {
    for (const [i, key] of keys.entries()) times[i].push(await call('time', key));
    process.stderr.write('.');
  }
  process.stderr.write('\n');
  return times;
}
