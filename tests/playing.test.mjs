// A minute of an animated glass model in <vitrine-viewer>, in Chromium and in Firefox: memory stays as it is, and the page
// is not held up for long. PLAY_SECONDS: how long (60). Skips a browser that is not there.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { answerWithFile, chromiumPath, firefoxNeeds, gpus, launchFirefox, listen, patience, skipWithout } from './browser-tools.mjs';
import { ball, edited, model, solid } from './case-models.mjs';
import { memoryOf } from './memory.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const site = resolve(process.env.VITRINE_WEB ?? join(here, '../build/web'));
const seconds = Number(process.env.PLAY_SECONDS ?? 60);
const puppeteer = await import('puppeteer-core').catch(() => null);
const needed = [[puppeteer, "node modules (run 'npm ci' in tests/)"], [existsSync(join(site, 'element/vitrine-viewer.js')), `${site}/element`]];

/** A ball of glass, 9,800 triangles, whose vertices all move: it leans and comes back in two seconds. */
function leaning() {
  const mesh = ball(0.5, 50);
  return edited(model([{ mesh, material: solid([0.7, 0.9, 0.8]) }]), (json) => {
    const add = (numbers, type, count) => {
      const data = Buffer.from(new Float32Array(numbers).buffer);
      const buffer = json.buffers.push({ byteLength: data.length, uri: `data:application/octet-stream;base64,${data.toString('base64')}` }) - 1;
      const bufferView = json.bufferViews.push({ buffer, byteLength: data.length }) - 1;
      return json.accessors.push({ bufferView, componentType: 5126, count, type }) - 1;
    };
    const count = mesh.positions.length / 3;
    const moved = Array.from({ length: count }, (_, i) => [0.8 * mesh.positions[3 * i + 1] ** 2, 0, 0]).flat();
    json.meshes[0].primitives[0].targets = [{ POSITION: add(moved, 'VEC3', count) }];
    json.accessors.at(-1).min = [0, 0, 0];
    json.accessors.at(-1).max = [0.2, 0, 0];
    const input = add([0, 1, 2], 'SCALAR', 3), output = add([0, 1, 0], 'SCALAR', 3);
    json.animations = [{ name: 'lean', samplers: [{ input, output }], channels: [{ sampler: 0, target: { node: 0, path: 'weights' } }] }];
  });
}

const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
const mean = (numbers) => numbers.reduce((sum, one) => sum + one, 0) / numbers.length;

describe('an animated glass model is played', { skip: skipWithout(...needed) }, () => {
  let server;
  before(async () => {
    const file = leaning();
    const page = '<!doctype html><html lang="en"><title>Test</title><link rel="icon" href="data:,"><style>vitrine-viewer { width: 200px; height: 200px }</style><script type="module" src="/element/vitrine-viewer.js"></script><vitrine-viewer id="a" src="/leaning.glb" autoplay></vitrine-viewer>';
    server = await listen((request, response) => {
      const { pathname } = new URL(request.url, 'http://localhost');
      if (pathname === '/') response.writeHead(200, { 'content-type': 'text/html' }).end(page);
      else if (pathname === '/leaning.glb') response.writeHead(200, { 'content-type': 'model/gltf-binary' }).end(file);
      else answerWithFile(site, pathname, response);
    });
  });
  after(() => {
    server?.close();
  });

  /**
   * In the page: counts frames, and milliseconds for which each holds up the page: to pose, to draw, to show. Beside them, as
   * much arithmetic: what holds that up is the machine, which has other work.
   */
  const watch = async () => {
    const { Viewer } = await import('/element/core.js');
    const told = (window.told = { frames: 0, loops: 0, blocks: { setTime: [], draw: [], showOn: [] } });
    const arithmetic = [];
    a.addEventListener('frame', () => {
      ++told.frames;
      const start = performance.now();
      let sum = 1;
      for (let i = 0; i < 4e5; ++i) sum = (1.0000001 * sum) % 7;
      told.sum = sum;
      arithmetic.push(performance.now() - start);
    });
    a.addEventListener('loop', () => ++told.loops);
    for (const name of Object.keys(told.blocks)) {
      const act = Viewer.prototype[name];
      Viewer.prototype[name] = function (...values) {
        const start = performance.now();
        try {
          return act.apply(this, values);
        } finally {
          told.blocks[name].push(performance.now() - start);
        }
      };
    }
    told.blocks.arithmetic = arithmetic;
  };

  async function play(t, browser) {
    t.after(() => browser.close());
    const page = await browser.newPage();
    await page.setViewport({ width: 300, height: 300 });
    const complaints = [];
    page.on('pageerror', (error) => complaints.push(String(error)));
    await page.goto(server.address);
    await page.waitForFunction(() => a.loaded && a.currentTime > 0.2, { timeout: patience });
    await pause(5000); // what is loaded and compiled once
    await page.evaluate(watch);
    const memory = [];
    for (let i = 0; i < seconds; ++i) {
      await pause(1000);
      memory.push(memoryOf(browser.process().pid));
    }
    const told = await page.evaluate(() => ({ ...window.told, paused: a.paused }));
    const third = Math.floor(seconds / 3), early = mean(memory.slice(third, -third)), late = mean(memory.slice(-third));
    t.diagnostic(`${told.frames} frames in ${seconds} s, ${told.loops} rounds; memory ${memory[0].toFixed(0)} MB, then ${early.toFixed(0)} MB, then ${late.toFixed(0)} MB`);
    const medians = Object.fromEntries(Object.entries(told.blocks).map(([name, times]) => {
      times.sort((one, other) => one - other);
      const at = (share) => times[Math.floor(share * (times.length - 1))];
      t.diagnostic(`${name}: median ${at(0.5).toFixed(1)} ms, 99 % below ${at(0.99).toFixed(1)} ms, longest ${at(1).toFixed(1)} ms, ${times.filter((one) => one > 50).length} of ${times.length} above 50 ms`);
      return [name, at(0.5)];
    }));
    delete medians.arithmetic;
    assert.deepEqual(complaints, []);
    assert.ok(!told.paused && told.frames > seconds && told.loops > 0.3 * seconds, `${told.frames} frames, ${told.loops} rounds`);
    // Whatever else the machine does holds up some of them: what is too long by itself is so each time.
    assert.ok(Math.max(...Object.values(medians)) < 50, `medians, ms: ${JSON.stringify(medians)}`);
    assert.ok(late < 1.05 * early, `${early} MB, then ${late} MB`);
  }

  test('in Chromium', { skip: skipWithout([existsSync(chromiumPath), chromiumPath]) }, async (t) => {
    await play(t, await puppeteer.default.launch({ executablePath: chromiumPath, headless: true, args: ['--no-sandbox', '--disable-gpu-watchdog', ...gpus.llvmpipe], timeout: patience }));
  });

  test('in Firefox', { skip: skipWithout(...firefoxNeeds) }, async (t) => {
    await play(t, await launchFirefox());
  });
});
