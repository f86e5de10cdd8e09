// <vitrine-viewer> in Firefox, by puppeteer-core over WebDriver BiDi: WebGL needs a display, so under Xvfb. Its pictures
// are those of Chromium. Skips itself without either browser, Xvfb or the packages.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { answerWithFile, chromiumPath, launch, listen, openPage, patience, quiet, skipWithout } from './browser-tools.mjs';
import { startDisplay, xvfbPath } from './display.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const site = resolve(process.env.VITRINE_WEB ?? join(here, '../build/web'));
const screenshots = join(here, '../build/screenshots');
const firefoxPath = process.env.FIREFOX ?? '/usr/bin/firefox-esr';
const modules = await Promise.all(['puppeteer-core', 'pngjs', 'pixelmatch'].map((name) => import(name))).catch(() => null);
const skip = skipWithout(
  [modules, "node modules (run 'npm ci' in tests/)"],
  [existsSync(join(site, 'element/vitrine-viewer.js')), `${site}/element`],
  [existsSync(chromiumPath), chromiumPath],
  [existsSync(firefoxPath), firefoxPath],
  [existsSync(xvfbPath), 'Xvfb'],
);
const [{ default: puppeteer }, { PNG }, { default: pixelmatch }] = modules ?? [{}, {}, {}];

const head = '<!doctype html><html lang="en"><title>Test</title><link rel="icon" href="data:,"><style>body { margin: 0; background: rgb(20, 90, 40); display: flex; flex-wrap: wrap; align-content: start } vitrine-viewer { width: 160px; height: 160px }</style><script type="module" src="/element/vitrine-viewer.js"></script>';
const body = `<vitrine-viewer id="a" src="knot" environment-image="sky" samples="4" interpolation-decay="0"></vitrine-viewer>${
  '<vitrine-viewer class="more" src="sphere" samples="1" style="width: 40px; height: 40px"></vitrine-viewer>'.repeat(19)}`;

describe('the element in Firefox', { skip }, () => {
  let server, screen, firefox, chromium;

  before(async () => {
    mkdirSync(screenshots, { recursive: true });
    server = await listen((request, response) => {
      const { pathname } = new URL(request.url, 'http://localhost');
      if (pathname === '/') response.writeHead(200, { 'content-type': 'text/html' }).end(head + body);
      else answerWithFile(site, pathname, response);
    });
    screen = await startDisplay();
    firefox = await puppeteer.launch({ browser: 'firefox', executablePath: firefoxPath, headless: false, env: { ...process.env, DISPLAY: screen.display }, timeout: patience });
    chromium = await launch();
  });
  after(async () => {
    await firefox?.close();
    await chromium?.close();
    screen?.stop();
    server?.close();
  });

  /** Frames of the first element until it has all samples. */
  const settled = () => new Promise((done) => {
    const wait = () => {
      clearTimeout(window.rest);
      window.rest = setTimeout(done, 1000);
    };
    for (const viewer of document.querySelectorAll('vitrine-viewer')) viewer.addEventListener('frame', wait);
    wait();
  });
  const allLoaded = () => [...document.querySelectorAll('vitrine-viewer')].every(({ loaded }) => loaded);
  const whole = (page) => page.evaluate(() => document.getElementById('a').toDataURL());
  const read = (url) => PNG.sync.read(Buffer.from(url.split(',')[1] ?? url, 'base64'));
  const difference = (one, other) => (100 * pixelmatch(one.data, other.data, null, one.width, one.height, { threshold: 0.1 })) / (one.width * one.height);

  test('draws what Chromium draws, on the screen and as a file, on a page of twenty', async (t) => {
    const expected = await openPage(chromium, { viewport: { width: 400, height: 400 } });
    await expected.goto(server.address);
    await expected.waitForFunction(allLoaded);
    await quiet(expected);
    const page = await firefox.newPage();
    await page.setViewport({ width: 400, height: 400 });
    const complaints = [];
    page.on('pageerror', (error) => complaints.push(String(error)));
    await page.goto(server.address);
    await page.waitForFunction(allLoaded, { timeout: patience });
    await page.evaluate(settled);
    const file = difference(read(await whole(page)), read(await whole(expected)));
    const shown = PNG.sync.read(Buffer.from(await page.screenshot()));
    writeFileSync(join(screenshots, 'firefox.png'), PNG.sync.write(shown));
    const screenDiffers = difference(shown, PNG.sync.read(await expected.screenshot()));
    t.diagnostic(`file: ${file.toFixed(4)} % differ, screen: ${screenDiffers.toFixed(4)} %`);
    assert.ok(file < 0.5, `${file} % differ`);
    assert.ok(screenDiffers < 0.5, `${screenDiffers} % differ on the screen`);
    assert.deepEqual(complaints, []);

    // A lost context comes back.
    const before = shown;
    await page.evaluate(async () => {
      const { Viewer, loadCore } = await import('/element/core.js');
      const viewer = new Viewer(await loadCore(), { lost() {}, restored() {}, crowded: () => false });
      window.loss = viewer.gl.getExtension('WEBGL_lose_context');
      window.loss.loseContext();
    });
    await page.waitForFunction(() => !document.getElementById('a').shadowRoot.querySelector('[part=message]').hidden, { timeout: patience });
    await page.evaluate(() => window.loss.restoreContext());
    await page.waitForFunction(() => document.getElementById('a').shadowRoot.querySelector('[part=message]').hidden, { timeout: patience });
    await page.evaluate(settled);
    assert.ok(difference(before, PNG.sync.read(Buffer.from(await page.screenshot()))) < 0.01);
  });
});
