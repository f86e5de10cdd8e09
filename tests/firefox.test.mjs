// <vitrine-viewer> in Firefox, by puppeteer-core over WebDriver BiDi: WebGL needs a display, so under Xvfb. Its pictures
// are those of Chromium. Skips itself without either browser, Xvfb or the packages.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { answerWithFile, chromiumPath, firefoxNeeds, launch, launchFirefox, listen, openPage, patience, quiet, skipWithout } from './browser-tools.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const site = resolve(process.env.VITRINE_WEB ?? join(here, '../build/web'));
const screenshots = join(here, '../build/screenshots');
const modules = await Promise.all(['puppeteer-core', 'pngjs', 'pixelmatch'].map((name) => import(name))).catch(() => null);
const skip = skipWithout(
  [modules, "node modules (run 'npm ci' in tests/)"],
  [existsSync(join(site, 'element/vitrine-viewer.js')), `${site}/element`],
  [existsSync(chromiumPath), chromiumPath],
  ...firefoxNeeds,
);
const [, { PNG }, { default: pixelmatch }] = modules ?? [{}, {}, {}];

const head = '<!doctype html><html lang="en"><title>Test</title><link rel="icon" href="data:,"><style>body { margin: 0; background: rgb(20, 90, 40); display: flex; flex-wrap: wrap; align-content: start } vitrine-viewer { width: 160px; height: 160px }</style><script type="module" src="/element/vitrine-viewer.js"></script>';
const body = `<vitrine-viewer id="a" src="knot" environment-image="sky" samples="4" interpolation-decay="0"></vitrine-viewer>${
  '<vitrine-viewer class="more" src="sphere" samples="1" style="width: 40px; height: 40px"></vitrine-viewer>'.repeat(19)}`;

/** A panel of glass over a canvas of tiles, which it may also have as a file. */
const over = `<style>canvas { position: absolute; width: 300px; height: 200px; object-fit: cover } #a { position: absolute; left: 100px; top: 40px }</style>
  <canvas id="under" width="300" height="300"></canvas>
  <vitrine-viewer id="a" objects="panel:width=1.6,height=1.2,radius=0.3,bevel=0.2,thickness=0.4,rotate=20,10,0" samples="1" interpolation-decay="0" backdrop="#under"></vitrine-viewer>
  <script>{
    const pen = under.getContext('2d');
    for (let i = 0; i < 900; ++i) {
      pen.fillStyle = 'rgb(' + [8 * (i % 30), 8 * Math.floor(i / 30), (i + Math.floor(i / 30)) % 2 ? 220 : 40] + ')';
      pen.fillRect(10 * (i % 30), 10 * Math.floor(i / 30), 10, 10);
    }
  }</script>`;

describe('the element in Firefox', { skip }, () => {
  let server, firefox, chromium;

  before(async () => {
    mkdirSync(screenshots, { recursive: true });
    server = await listen((request, response) => {
      const { pathname } = new URL(request.url, 'http://localhost');
      const page = { '/': head + body, '/over.html': head + over }[pathname];
      if (page) response.writeHead(200, { 'content-type': 'text/html' }).end(page);
      else answerWithFile(site, pathname, response);
    });
    firefox = await launchFirefox();
    chromium = await launch();
  });
  after(async () => {
    await firefox?.close();
    await chromium?.close();
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

  test('a backdrop: what lies under the element, wherever it moves, and a picture, as Chromium shows them; a video goes on', async (t) => {
    const expected = await openPage(chromium, { viewport: { width: 400, height: 300 } }), page = await firefox.newPage();
    t.after(() => expected.context().close());
    await page.setViewport({ width: 400, height: 300 });
    const complaints = [];
    page.on('pageerror', (error) => complaints.push(String(error)));
    const both = [expected, page];
    for (const one of both) await one.goto(`${server.address}/over.html`);
    await expected.waitForFunction(allLoaded);
    await page.waitForFunction(allLoaded, { timeout: patience });
    const seen = new Set();
    const changes = {
      'as it stands': () => {},
      'moved by a style': () => (a.style.left = '130px'),
      'by a transform': () => (a.style.transform = 'translate(-90px, 30px)'),
      'a picture': () => (a.backdrop = under.toDataURL()),
      'another canvas, further behind': () => Object.assign(a, { backdropDistance: 2, backdrop: Object.assign(document.createElement('canvas'), { width: 20, height: 20 }) }),
      'the one under it again': () => (a.backdrop = '#under'),
    };
    for (const [name, change] of Object.entries(changes)) {
      const pictures = [];
      for (const one of both) {
        await one.evaluate(change);
        await one.evaluate(settled);
        pictures.push([read(await whole(one)), PNG.sync.read(Buffer.from(await one.screenshot()))]);
      }
      const [file, shown] = [0, 1].map((i) => difference(pictures[0][i], pictures[1][i]));
      t.diagnostic(`${name}: file: ${file.toFixed(4)} % differ, screen: ${shown.toFixed(4)} %`);
      assert.ok(file < 0.5 && shown < 0.5, `${name}: ${file} % of the file and ${shown} % of the screen differ`);
      seen.add(pictures[1][1].data.toString('base64'));
    }
    assert.equal(seen.size, Object.keys(changes).length, 'each change is seen');

    await page.evaluate(() => {
      const canvas = Object.assign(document.createElement('canvas'), { width: 64, height: 64 }), pen = canvas.getContext('2d');
      window.fill = (color) => {
        pen.fillStyle = `rgb(${color})`;
        pen.fillRect(0, 0, 64, 64);
      };
      a.backdrop = Object.assign(document.createElement('video'), { muted: true, srcObject: canvas.captureStream() });
      a.backdrop.play();
    });
    for (const color of [[200, 30, 60], [20, 160, 220]]) {
      await page.waitForFunction((wanted) => {
        window.fill(wanted);
        const canvas = a.shadowRoot.querySelector('canvas'), copy = new OffscreenCanvas(1, 1).getContext('2d');
        copy.drawImage(canvas, -2, -2);
        const [...there] = copy.getImageData(0, 0, 1, 1).data; // beside the glass
        return wanted.every((value, i) => Math.abs(value - there[i]) < 9);
      }, { timeout: patience, polling: 50 }, color);
    }
    assert.deepEqual(complaints, []);
  });
});
