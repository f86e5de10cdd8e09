// Thumbnails of many models, 256 x 256: by one process of vitrine, by a process each, and by <model-viewer> in one headless
// Chromium, which is what people use today. Time and memory; read the ratios.
//   node tests/bench/thumbnails.mjs [COUNT [IN_BROWSER]]     COUNT: 1000; of which the browser draws the first IN_BROWSER (all)
// Needs build/release and the packages of tests/; those of tests/bench/ are installed on first use.
import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { answerWithFile, chromiumPath, gpus, listen, patience } from '../browser-tools.mjs';
import { ball, box, matt, model, quad, solid, thin } from '../case-models.mjs';
import { memoryOf } from '../memory.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const binary = resolve(process.env.VITRINE_BINARY ?? join(here, '../../build/release/vitrine'));
const count = Number(process.argv[2] ?? 1000), inBrowser = Number(process.argv[3] ?? count), side = 256;
if (![count, inBrowser].every((one) => Number.isInteger(one) && one >= 1) || inBrowser > count) {
  console.error(`thumbnails: '${process.argv.slice(2).join(' ')}' are no numbers of thumbnails; give one from 1, and a second up to it`);
  process.exit(1);
}

/** Of twenty models one: glass of five kinds, alone, before a wall, around something, as a pane. */
function modelOf(index) {
  const color = [[1, 1, 1], [0.7, 0.9, 0.8], [1, 0.8, 0.6], [0.7, 0.8, 1], [0.9, 0.7, 0.9]][index % 5];
  const wall = { mesh: quad(2.4, 2), material: matt([0.8, 0.4, 0.2]), translation: [0, 0, -0.8] };
  return model([
    [{ mesh: ball(0.5, 24), material: solid(color) }],
    [{ mesh: box(0.8, 0.8, 0.8), material: solid(color), rotation: [0.2, 0.3, 0, 0.933] }, wall],
    [{ mesh: ball(0.6, 32), material: solid(color) }, { mesh: box(0.3, 0.3, 0.3), material: matt([0.2, 0.4, 0.8]) }],
    [{ mesh: quad(1, 1), material: thin(color) }, { mesh: ball(0.3, 16), material: matt([0.8, 0.7, 0.1]), translation: [0, 0, -0.5] }],
  ][Math.floor(index / 5)]);
}

/** Runs to the end. @returns {Promise<{seconds: number, megabytes: number}>} the most that was taken at any time */
async function measure(act, pid = () => null) {
  let megabytes = 0;
  const timer = setInterval(() => {
    if (pid() !== null) megabytes = Math.max(megabytes, memoryOf(pid()));
  }, 100);
  const start = performance.now();
  await act();
  clearInterval(timer);
  return { seconds: (performance.now() - start) / 1000, megabytes };
}

async function byVitrine(args, running) {
  const child = spawn(binary, ['render', ...args, '-r', `${side},${side}`], { stdio: ['ignore', 'ignore', 'pipe'] });
  let said = '';
  child.stderr.on('data', (text) => (said += text));
  running.pid = child.pid;
  const code = await new Promise((done) => child.on('close', done));
  if (code !== 0) throw new Error(said);
}

async function byModelViewer(puppeteer, models, out, running) {
  const page = `<!doctype html><link rel="icon" href="data:,"><script type="module" src="/model-viewer.min.js"></script><style>body { margin: 0 } model-viewer { width: ${side}px; height: ${side}px }</style><model-viewer id="a" interaction-prompt="none"></model-viewer>`;
  const server = await listen((request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    if (pathname === '/') response.writeHead(200, { 'content-type': 'text/html' }).end(page);
    else answerWithFile(pathname.endsWith('.glb') ? models : join(here, 'node_modules/@google/model-viewer/dist'), pathname, response);
  });
  const browser = await puppeteer.launch({ executablePath: chromiumPath, headless: true, timeout: patience, protocolTimeout: 3600000, args: ['--no-sandbox', '--disable-gpu-watchdog', ...gpus.llvmpipe] });
  running.pid = browser.process().pid;
  try {
    const tab = await browser.newPage();
    await tab.setViewport({ width: side, height: side });
    await tab.goto(server.address);
    await tab.waitForFunction(() => customElements.get('model-viewer') !== undefined);
    for (const name of readdirSync(models).slice(0, inBrowser)) {
      const picture = await tab.evaluate(async (src) => {
        await new Promise((done, fail) => {
          a.addEventListener('load', done, { once: true });
          a.addEventListener('error', ({ detail }) => fail(new Error(`${src}: ${detail.sourceError}`)), { once: true });
          a.src = src;
        });
        return (await a.toDataURL('image/png')).split(',')[1];
      }, `/${name}`);
      writeFileSync(join(out, name.replace('.glb', '.png')), Buffer.from(picture, 'base64'));
    }
  } finally {
    await browser.close();
    server.close();
  }
}

const folder = mkdtempSync(join(tmpdir(), 'vitrine-thumbnails-'));
try {
  if (!existsSync(join(here, 'node_modules/@google/model-viewer'))) execFileSync('npm', ['--prefix', here, 'ci', '--no-audit', '--no-fund', '--loglevel=error'], { stdio: ['ignore', 2, 2] });
  const { default: puppeteer } = await import('puppeteer-core');
  const models = join(folder, 'models'), files = Array.from({ length: 20 }, (_, i) => modelOf(i));
  for (const name of ['models', 'one', 'each', 'browser']) mkdirSync(join(folder, name));
  for (let i = 0; i < count; ++i) writeFileSync(join(models, `${String(i).padStart(4, '0')}.glb`), files[i % 20]);
  writeFileSync(join(folder, 'list.txt'), readdirSync(models).map((name) => `${join(models, name)}\n`).join(''));
  const running = { pid: null }, rows = [];
  const add = async (what, name, wanted, act) => {
    running.pid = null;
    const { seconds, megabytes } = await measure(act, () => running.pid);
    const made = readdirSync(join(folder, name)).length;
    if (made !== wanted) throw new Error(`${what}: ${made} of ${wanted} pictures`);
    rows.push(`| ${what} | ${wanted} | ${seconds.toFixed(1)} s | ${((1000 * seconds) / wanted).toFixed(0)} ms | ${megabytes.toFixed(0)} MB |`);
    console.error(rows.at(-1));
  };
  await add('`vitrine render --list`, one process', 'one', count, () => byVitrine(['--list', join(folder, 'list.txt'), '-o', join(folder, 'one/{name}.png')], running));
  await add('`vitrine render`, a process each', 'each', count, async () => {
    for (const name of readdirSync(models)) await byVitrine([join(models, name), '-o', join(folder, 'each', name.replace('.glb', '.png'))], running);
  });
  await add('`<model-viewer>` in headless Chromium, one page', 'browser', inBrowser, () => byModelViewer(puppeteer, models, join(folder, 'browser'), running));
  console.log(`Thumbnails of 20 models, ${side} x ${side}\n\n| by | thumbnails | time | each | memory at most |\n|---|---|---|---|---|\n${rows.join('\n')}`);
} finally {
  rmSync(folder, { recursive: true, force: true });
}
