// What all programs that drive browsers share: where they are, how they are started, and a server for what they show.
import { existsSync, readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';
import { startDisplay, xvfbPath } from './display.mjs';

export const chromiumPath = process.env.CHROMIUM ?? '/usr/bin/chromium';
export const firefoxPath = process.env.FIREFOX ?? '/usr/bin/firefox-esr';

/** Mesa's llvmpipe is the faster of the two software GPUs; SwiftShader is Chromium's own. */
export const gpus = {
  llvmpipe: ['--use-gl=angle', '--use-angle=gl-egl', '--ignore-gpu-blocklist'],
  swiftshader: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  gpu: process.platform === 'linux' ? ['--use-gl=angle', '--use-angle=gl-egl', '--ignore-gpu-blocklist'] : ['--ignore-gpu-blocklist'],
};

/**
 * How long a test waits for what must come, milliseconds: far longer than it takes on a slow machine that does something
 * else as well, so that only what never comes fails.
 */
export const patience = 180000;

const flags = ['--no-sandbox', '--disable-sync', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-gpu-watchdog'];

/** Chromium without a window. @param {'llvmpipe'|'swiftshader'|'gpu'} gpu */
export async function launch(gpu = 'llvmpipe', options = {}) {
  const { chromium } = await import('playwright-core');
  return chromium.launch({ executablePath: chromiumPath, args: [...flags, ...gpus[gpu]], timeout: patience, ...options });
}

/** What Firefox needs, for skipWithout. */
export const firefoxNeeds = [[existsSync(firefoxPath), firefoxPath], [existsSync(xvfbPath), 'Xvfb']];

/** Firefox by puppeteer-core over WebDriver BiDi, on a display of its own: without one it has no WebGL. */
export async function launchFirefox(options = {}) {
  const { default: puppeteer } = await import('puppeteer-core'), screen = await startDisplay();
  try {
    const browser = await puppeteer.launch({ browser: 'firefox', executablePath: firefoxPath, headless: false, env: { ...process.env, DISPLAY: screen.display }, timeout: patience, ...options });
    browser.once('disconnected', () => screen.stop());
    return browser;
  } catch (reason) {
    screen.stop();
    throw reason;
  }
}

const types = {
  '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css', '.json': 'application/json',
  '.wasm': 'application/wasm', '.png': 'image/png', '.glb': 'model/gltf-binary', '.hdr': 'image/vnd.radiance',
};

export const typeOf = (path) => types[extname(path)] ?? 'application/octet-stream';

/** A server on a free port of this machine. @param {import('node:http').RequestListener} answer */
export async function listen(answer) {
  const server = createServer(answer);
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  return { address: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}

/** Answers with a file of the folder; a path that ends in a slash means its index.html. */
export function answerWithFile(folder, pathname, response) {
  const file = join(folder, pathname.endsWith('/') ? `${pathname}index.html` : pathname);
  if (!file.startsWith(folder) || !extname(file) || !existsSync(file)) {
    response.writeHead(404).end();
    return;
  }
  const body = readFileSync(file);
  response.writeHead(200, { 'content-type': typeOf(file), 'content-length': body.length }).end(body);
}

/** Serves a folder. @returns {Promise<{address: string, close: () => void}>} */
export function serve(folder) {
  return listen((request, response) => answerWithFile(folder, new URL(request.url, 'http://localhost').pathname, response));
}

/** In a page, before its scripts: knows what they have yet to do, for `quiet`. */
function watchWork() {
  const waiting = { frames: new Set(), timers: new Set(), promises: 0 };
  const { requestAnimationFrame, cancelAnimationFrame, setTimeout, clearTimeout } = window;
  window.requestAnimationFrame = (act) => {
    const id = requestAnimationFrame((time) => {
      waiting.frames.delete(id);
      act(time);
    });
    waiting.frames.add(id);
    return id;
  };
  window.cancelAnimationFrame = (id) => {
    waiting.frames.delete(id);
    cancelAnimationFrame(id);
  };
  window.setTimeout = (act, delay = 0, ...values) => {
    const id = setTimeout(() => {
      waiting.timers.delete(id);
      act(...values);
    }, delay);
    if (delay < 1000) waiting.timers.add(id); // longer ones tidy up
    return id;
  };
  window.clearTimeout = (id) => {
    waiting.timers.delete(id);
    clearTimeout(id);
  };
  const promising = [
    [window, 'fetch', 'createImageBitmap'], [Response.prototype, 'arrayBuffer', 'blob', 'json', 'text'],
    [ReadableStreamDefaultReader.prototype, 'read'], [WebAssembly, 'compile', 'compileStreaming', 'instantiate', 'instantiateStreaming'],
    [HTMLImageElement.prototype, 'decode'], [window.scheduler, 'postTask', 'yield'],
  ];
  for (const [owner, ...names] of promising) {
    for (const name of names.filter((one) => owner?.[one])) {
      const real = owner[name];
      owner[name] = function (...values) {
        ++waiting.promises;
        const answer = real.apply(this, values);
        const count = () => --waiting.promises;
        answer.then(count, count);
        return answer;
      };
    }
  }
  const isMoving = ({ playState, effect }) => playState === 'running' && effect?.getComputedTiming().endTime !== Infinity;
  const work = () => ({
    frames: waiting.frames.size, timers: waiting.timers.size, promises: waiting.promises,
    animations: document.getAnimations().filter(isMoving).length, images: [...document.images].filter(({ complete }) => !complete).length,
  });
  window.whenQuiet = async (limit) => {
    const start = performance.now();
    for (let still = 0; still < 3;) { // frames: observers of size and of visibility answer in the next one
      await new Promise((done) => requestAnimationFrame(done));
      const now = work();
      still = Object.values(now).every((count) => count === 0) ? still + 1 : 0;
      if (performance.now() - start > limit) throw new Error(`the page is never quiet: ${JSON.stringify(now)}`);
    }
  };
}

const scripts = new WeakMap(); // of a page: which were asked for, and how many have come

/** A page of a context of its own, which is closed with `page.context().close()`; it waits patiently, and may ask no other host. */
export async function openPage(browser, options = {}) {
  const context = await browser.newContext(options);
  context.setDefaultTimeout(patience);
  context.on('request', (request) => {
    const { protocol, hostname } = new URL(request.url());
    if (protocol.startsWith('http') && !['localhost', '127.0.0.1'].includes(hostname)) throw new Error(`a page asked another host: ${request.url()}`);
  });
  await context.addInitScript(watchWork);
  const page = await context.newPage();
  watchScripts(page);
  return page;
}

function watchScripts(page) {
  const asked = { pending: new Set(), come: 0 };
  scripts.set(page, asked);
  page.on('request', (request) => /\.m?js$/.test(new URL(request.url()).pathname) && asked.pending.add(request));
  for (const type of ['requestfinished', 'requestfailed']) page.on(type, (request) => asked.pending.delete(request) && ++asked.come);
}

/** A page of launchFirefox's, for which `quiet` waits, too. */
export async function openFirefoxPage(browser, { width, height }) {
  const page = await browser.newPage();
  page.setDefaultTimeout(patience);
  await page.setViewport({ width, height });
  await page.evaluateOnNewDocument(watchWork);
  watchScripts(page);
  return page;
}

/** Until the page of openPage or openFirefoxPage has nothing to do: no frame, short timer, file, script, picture or animation is awaited. */
export async function quiet(page) {
  const asked = scripts.get(page);
  let come;
  do {
    ({ come } = asked);
    await page.evaluate((limit) => window.whenQuiet(limit), patience);
  } while (asked.pending.size > 0 || asked.come !== come); // a script that has come may go on
}

/** What of [there, name] is missing, as the reason to skip; false where nothing is. */
export function skipWithout(...needs) {
  const missing = needs.filter(([there]) => !there).map(([, name]) => name);
  return missing.length > 0 && `missing: ${missing.join(', ')}`;
}
