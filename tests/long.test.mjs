// Long runs: 5,000 frames of <vitrine-viewer> in Chromium and in Firefox, in which size, technique and model change and
// the context is lost; and 200 programs at once. LONG_FRAMES: how many (5000), LONG_PROGRAMS: how many (200). Skips a
// browser that is not there.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { answerWithFile, chromiumPath, firefoxNeeds, gpus, launchFirefox, listen, patience, skipWithout } from './browser-tools.mjs';
import { memoryOf } from './memory.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const site = resolve(process.env.VITRINE_WEB ?? join(here, '../build/web'));
const binary = resolve(process.env.VITRINE_BINARY ?? join(here, '../build/release/vitrine'));
const frames = Number(process.env.LONG_FRAMES ?? 5000), programs = Number(process.env.LONG_PROGRAMS ?? 200);
const rounds = 10;
const settings = { timeout: patience, protocolTimeout: 3600000 };
const puppeteer = await import('puppeteer-core').catch(() => null);
const needed = [[puppeteer, "node modules (run 'npm ci' in tests/)"], [existsSync(join(site, 'element/vitrine-viewer.js')), `${site}/element`]];

/** In the page, before its scripts: what WebGL keeps, and rounds of frames. */
function watch() {
  const alive = new Set(), contexts = new Set(), errors = [];
  const { prototype } = WebGL2RenderingContext;
  for (const kind of ['Texture', 'Buffer', 'Framebuffer', 'Renderbuffer', 'VertexArray', 'Shader', 'Program', 'Sync']) {
    const makes = kind === 'Sync' ? 'fenceSync' : `create${kind}`, make = prototype[makes], remove = prototype[`delete${kind}`];
    prototype[makes] = function (...values) {
      contexts.add(this);
      const made = make.apply(this, values);
      if (made !== null && !this.isContextLost()) alive.add(made);
      return made;
    };
    prototype[`delete${kind}`] = function (object) {
      alive.delete(object);
      remove.call(this, object);
    };
  }
  const techniques = ['exact', 'layered', 'oliveira', 'wyman', 'single', 'kay-thickness', 'kay-nonlinear', 'kay-linear'];
  const models = ['diamond', 'cube', 'sphere', 'tumbler'], sizes = [32, 48, 24];
  /** So many frames; in their middle the context is lost. What is alive after them, and GL's errors. */
  window.playRound = async (count, seed) => {
    const viewer = document.getElementById('a');
    if (!errors.length) viewer.addEventListener('error', ({ detail }) => errors.push(`${detail?.sourceError?.message ?? detail?.type}`));
    const next = (change) => new Promise((done) => {
      viewer.addEventListener('frame', done, { once: true });
      change();
    });
    for (let i = 0; i < count; ++i) {
      await next(() => {
        viewer.style.width = viewer.style.height = `${sizes[Math.floor(i / 10) % 3]}px`;
        viewer.technique = techniques[Math.floor(i / 15) % 8];
        if (i % 60 === 0) viewer.src = models[(i / 60) % 4];
        viewer.cameraOrbit = `${(seed * 7 + i * 11) % 360 + i / 1000}deg ${60 + (i % 50)}deg auto`;
      });
      if (i === Math.floor(count / 2)) {
        const [loss] = [...contexts].filter((context) => !context.isContextLost()).map((context) => context.getExtension('WEBGL_lose_context'));
        loss.loseContext();
        alive.clear(); // they went with it
        contexts.clear();
        setTimeout(() => loss.restoreContext(), 50);
        await new Promise((done) => viewer.addEventListener('frame', done, { once: true }));
      }
    }
    return { alive: alive.size, glErrors: [...contexts].map((context) => context.getError()).filter((error) => error !== 0), errors: [...errors] };
  };
}

const page = `<!doctype html><html lang="en"><title>Test</title><link rel="icon" href="data:,"><style>vitrine-viewer { width: 32px; height: 32px; display: block }</style>
  <script>(${watch})()</script><script type="module" src="/element/vitrine-viewer.js"></script>
  <vitrine-viewer id="a" src="diamond" samples="1" interpolation-decay="0" loading="eager"></vitrine-viewer>`;

describe('thousands of frames on a page', { skip: skipWithout(...needed) }, () => {
  let server;
  before(async () => {
    server = await listen((request, response) => {
      const { pathname } = new URL(request.url, 'http://localhost');
      if (pathname === '/') response.writeHead(200, { 'content-type': 'text/html' }).end(page);
      else answerWithFile(site, pathname, response);
    });
  });
  after(() => {
    server?.close();
  });

  async function play(t, browser) {
    t.after(() => browser.close());
    const opened = await browser.newPage();
    await opened.setViewport({ width: 200, height: 200 });
    const complaints = [];
    opened.on('pageerror', (error) => complaints.push(String(error)));
    await opened.goto(server.address);
    await opened.waitForFunction(() => document.getElementById('a').loaded, { timeout: patience });
    const memory = [], alive = [];
    for (let round = 0; round < rounds; ++round) {
      const told = await opened.evaluate((count, seed) => window.playRound(count, seed), Math.round(frames / rounds), round);
      assert.deepEqual(told.glErrors, []);
      complaints.push(...told.errors.filter((text) => !/context/.test(text)));
      memory.push(memoryOf(browser.process().pid));
      alive.push(told.alive);
      t.diagnostic(`| ${Math.round(((round + 1) * frames) / rounds)} | ${memory.at(-1).toFixed(0)} | ${told.alive} |`);
    }
    assert.deepEqual(complaints, []);
    const most = (numbers) => Math.max(...numbers);
    // Caches fill in the first rounds.
    assert.ok(most(alive.slice(3)) <= most(alive.slice(0, 3)), `objects of WebGL: ${alive}`);
    assert.ok(most(memory.slice(-3)) < 1.1 * most(memory.slice(2, 5)), `megabytes: ${memory}`);
  }

  test('in Chromium', { skip: skipWithout([existsSync(chromiumPath), chromiumPath]) }, async (t) => {
    await play(t, await puppeteer.default.launch({ executablePath: chromiumPath, headless: true, args: ['--no-sandbox', '--disable-gpu-watchdog', ...gpus.llvmpipe], ...settings }));
  });

  test('in Firefox', { skip: skipWithout(...firefoxNeeds) }, async (t) => {
    await play(t, await launchFirefox(settings));
  });
});

test('many programs at once draw the same picture', { skip: skipWithout([existsSync(binary), binary]) }, async (t) => {
  const folder = mkdtempSync(join(tmpdir(), 'vitrine-many-'));
  t.after(() => rmSync(folder, { recursive: true, force: true }));
  let running = 0, most = 0;
  const run = (i) => new Promise((done) => {
    const child = spawn(binary, ['render', 'sphere', '-r', '16,16', '-o', join(folder, `${i}.png`)], { stdio: ['ignore', 'ignore', 'pipe'] });
    most = Math.max(most, ++running);
    let said = '';
    child.stderr.on('data', (text) => { said += text; });
    child.on('close', (code, signal) => {
      --running;
      done(code === 0 ? '' : `${i}: ${signal ?? code} ${said}`);
    });
  });
  const said = await Promise.all(Array.from({ length: programs }, (_, i) => run(i)));
  assert.deepEqual(said.filter((text) => text !== ''), []);
  const pictures = new Set(Array.from({ length: programs }, (_, i) => readFileSync(join(folder, `${i}.png`)).toString('base64')));
  t.diagnostic(`${programs} programs, ${most} at once, ${pictures.size} picture`);
  assert.equal(pictures.size, 1);
});
