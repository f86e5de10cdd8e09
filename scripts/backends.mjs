// Each technique by each GL beside OSMesa's picture: the table of docs/robustness.md, and what tests/backends.test.mjs
// holds against its bound. Needs build/release, the packages of tests/ and, for browsers, build/web and Chromium.
//   node scripts/backends.mjs          writes the table "backends"
//   node scripts/backends.mjs TABLE    writes another one, of another system's GL: "backends, Debian 13"
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { answerWithFile, chromiumPath, firefoxNeeds, launch, launchFirefox, listen, openFirefoxPage, openPage, quiet } from '../tests/browser-tools.mjs';
import { difference } from '../tests/difference.mjs';

const root = resolve(fileURLToPath(import.meta.url), '../..');
const site = resolve(process.env.VITRINE_WEB ?? join(root, 'build/web'));
const binary = resolve(process.env.VITRINE_BINARY ?? join(root, 'build/release/vitrine'));
const side = 128;
const techniques = ['exact', 'heightfield', 'layered', 'oliveira', 'wyman', 'single', 'kay-thickness', 'kay-nonlinear', 'kay-linear'];
const sourceOf = (technique) => (technique === 'heightfield' ? 'ripples' : 'knot');
const readPng = (bytes) => createRequire(join(root, 'tests/package.json'))('pngjs').PNG.sync.read(bytes);

/**
 * What a picture may differ by: a channel's mean, of 255, and the share of pixels with a channel off by more than 8.
 * SwiftShader, which snaps vertices to sixteenths of a pixel, draws edges of surfaces, and of layers, on a few other
 * pixels; rays that are traced do not tell.
 */
export function boundOf(technique, name) {
  const isTraced = technique === 'exact' || technique === 'heightfield';
  return !isTraced && name === browsers.swiftshader ? { mean: 2, apart: 0.03 } : { mean: 0.05, apart: 0.001 };
}

export const browsers = { llvmpipe: 'Chromium, llvmpipe', swiftshader: 'Chromium, SwiftShader', firefox: 'Firefox, llvmpipe' };
const hasSite = existsSync(join(site, 'element/vitrine-viewer.js'));

/** The keys of those that this machine has. */
export const browsersHere = Object.keys(browsers).filter((key) => hasSite && (key === 'firefox' ? firefoxNeeds.every(([there]) => there) : existsSync(chromiumPath)));

export function drawNatively(technique, backend) {
  const result = spawnSync(binary, ['render', sourceOf(technique), '-t', technique, '--rendering-backend', backend, '--tone-mapping', 'neutral', '-r', `${side},${side}`, '-o', '-'], { maxBuffer: 1 << 26 });
  if (result.status !== 0) throw new Error(result.stderr.toString());
  return readPng(result.stdout);
}

/** Is this program built with that backend, and does the machine have it? */
export const hasBackend = (backend) => spawnSync(binary, ['render', 'plane', '-r', '8,8', '--rendering-backend', backend, '-o', '-']).status === 0;

/** Every technique by one of the browsers. @param {keyof typeof browsers} key */
async function drawInBrowser(key) {
  const page = `<!doctype html><html lang="en"><title>Test</title><link rel="icon" href="data:,"><style>vitrine-viewer { width: ${side}px; height: ${side}px }</style><script type="module" src="/element/vitrine-viewer.js"></script><vitrine-viewer id="a" src="knot" samples="1" interpolation-decay="0" skybox-image></vitrine-viewer>`;
  const server = await listen((request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    if (pathname === '/') response.writeHead(200, { 'content-type': 'text/html' }).end(page);
    else answerWithFile(site, pathname, response);
  });
  const size = { width: 200, height: 200 }, browser = key === 'firefox' ? await launchFirefox() : await launch(key);
  try {
    const opened = key === 'firefox' ? await openFirefoxPage(browser, size) : await openPage(browser, { viewport: size });
    await opened.goto(server.address);
    const pictures = {};
    for (const technique of techniques) {
      await opened.evaluate((values) => Object.assign(document.getElementById('a'), values), { src: sourceOf(technique), technique });
      await opened.waitForFunction(() => document.getElementById('a').loaded);
      await quiet(opened);
      const url = await opened.evaluate(() => document.getElementById('a').toDataURL());
      pictures[technique] = readPng(Buffer.from(url.split(',')[1], 'base64'));
    }
    return pictures;
  } finally {
    await browser.close();
    server.close();
  }
}

/** By technique and name of a GL other than OSMesa: its difference from OSMesa's picture. */
export async function compareBackends(keys = browsersHere) {
  const table = Object.fromEntries(techniques.map((technique) => [technique, {}]));
  const truth = Object.fromEntries(techniques.map((technique) => [technique, drawNatively(technique, 'osmesa')]));
  for (const technique of hasBackend('egl') ? techniques : []) table[technique].EGL = difference(drawNatively(technique, 'egl'), truth[technique]);
  for (const key of keys) {
    const pictures = await drawInBrowser(key);
    for (const technique of techniques) table[technique][browsers[key]] = difference(pictures[technique], truth[technique]);
  }
  return table;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const table = await compareBackends(), names = ['EGL', ...Object.values(browsers)];
  const lines = [`| technique | ${names.join(' | ')} |`, `|---|${'---|'.repeat(names.length)}`, ...Object.entries(table).map(([technique, row]) =>
    `| ${technique} | ${names.map((name) => (row[name] ? `${row[name].mean.toFixed(4)}, ${(100 * row[name].apart).toFixed(3)} %` : '-')).join(' | ')} |`)];
  const path = join(root, 'docs/robustness.md'), text = readFileSync(path, 'utf8'), begin = `<!-- ${process.argv[2] ?? 'backends'} -->`;
  const from = text.indexOf(begin), to = text.indexOf('<!-- end -->', from);
  if (from < 0 || to < 0) throw new Error(`${path} has no ${begin} ... <!-- end -->`);
  writeFileSync(path, `${text.slice(0, from + begin.length)}\n\n${lines.join('\n')}\n\n${text.slice(to)}`);
  console.log(lines.join('\n'));
}
