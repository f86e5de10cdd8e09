// Glass over a page: what <vitrine-viewer> shows of a picture behind it, in headless Chromium on llvmpipe. Needs what
// element.test.mjs needs; skips itself likewise.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { answerWithFile, chromiumPath, launch, listen, openPage, quiet, skipWithout } from './browser-tools.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const site = resolve(process.env.VITRINE_WEB ?? join(here, '../build/web'));
const binary = resolve(process.env.VITRINE_BINARY ?? join(here, '../build/release/vitrine'));
const modules = await Promise.all(['playwright-core', 'pngjs'].map((name) => import(name))).catch(() => null);
const skip = skipWithout(
  [modules, "node modules (run 'npm ci' in tests/)"],
  [existsSync(join(site, 'element/backdrop.js')), `${site}/element/backdrop.js`],
  [existsSync(binary), binary],
  [existsSync(chromiumPath), chromiumPath],
);
const [, { PNG }] = modules ?? [{}, {}];

const side = 128; // of the pictures that are compared, pixels: a software GPU draws them

/** Red grows to the right and green downwards, a step a pixel; wider than high, so that cover cuts it. */
function ramp() {
  const png = new PNG({ width: 256, height: 192 });
  for (let i = 0; i < 256 * 192; ++i) png.data.set([i % 256, i >> 8, 77, 255], 4 * i);
  return PNG.sync.write(png);
}

/** A picture with edges. */
function tiles() {
  const png = new PNG({ width: 200, height: 120 });
  for (let i = 0; i < 200 * 120; ++i) {
    const x = i % 200, y = Math.floor(i / 200);
    png.data.set(((x >> 4) + (y >> 4)) % 2 ? [250, 30 + y, 20, 255] : [x, 40, 230, 255], 4 * i);
  }
  return PNG.sync.write(png);
}

/** Mean difference of a channel. */
function meanError(a, b) {
  assert.deepEqual([a.width, a.height], [b.width, b.height]);
  return a.data.reduce((sum, value, i) => sum + Math.abs(value - b.data[i]), 0) / a.data.length;
}

const pixel = ({ data, width }, x, y) => [...data.subarray(4 * (y * width + x), 4 * (y * width + x) + 4)];

/** In the page: a canvas of one colour. */
function paint() {
  window.fill = (canvas, color) => {
    const pen = canvas.getContext('2d');
    pen.fillStyle = color;
    pen.fillRect(0, 0, canvas.width, canvas.height);
    return canvas;
  };
  window.problems = [];
  document.addEventListener('error', ({ detail }) => detail?.sourceError && window.problems.push(detail.sourceError.message), true);
}

describe('glass over a page', { skip }, () => {
  const pages = new Map(), requests = [];
  let server, other, browser, folder;

  before(async () => {
    folder = mkdtempSync(join(tmpdir(), 'vitrine-backdrop-'));
    writeFileSync(join(folder, 'ramp.png'), ramp());
    writeFileSync(join(folder, 'tiles.png'), tiles());
    const files = new Map([['/ramp.png', ramp()], ['/tiles.png', tiles()], ['/words.png', Buffer.from('no picture')], ['/words.webm', Buffer.from('no video')]]);
    const answer = (request, response) => {
      const { pathname } = new URL(request.url, 'http://localhost');
      requests.push(pathname);
      if (pages.has(pathname)) response.writeHead(200, { 'content-type': 'text/html' }).end(pages.get(pathname));
      else if (files.has(pathname)) response.writeHead(200, { 'content-length': files.get(pathname).length }).end(files.get(pathname));
      else answerWithFile(site, pathname, response);
    };
    server = await listen(answer);
    other = await listen(answer);
    browser = await launch();
  });
  after(async () => {
    await browser?.close();
    server?.close();
    other?.close();
    if (folder) rmSync(folder, { recursive: true, force: true });
  });

  /** A page with that body, each viewer of `side` pixels with one sample a pixel; when the test is over it has said nothing but what is allowed. */
  async function open(t, body, { allowed = /^$/, init, ...options } = {}) {
    const path = `/page${pages.size}.html`;
    const style = `<style>body { margin: 0 } vitrine-viewer { width: ${side}px; height: ${side}px }</style>`;
    pages.set(path, `<!doctype html><html lang="en"><title>Test</title><link rel="icon" href="data:,">${style}<script type="module" src="/element/vitrine-viewer.js"></script>${body.replaceAll('<vitrine-viewer', '<vitrine-viewer samples="1" interpolation-decay="0"')}`);
    const page = await openPage(browser, { viewport: { width: 400, height: 300 }, ...options });
    const complaints = [];
    page.on('pageerror', (error) => complaints.push(String(error)));
    page.on('console', (message) => ['error', 'warning'].includes(message.type()) && !/GPU stall|fallback to software/.test(message.text()) && !allowed.test(message.text()) && complaints.push(message.text()));
    t.after(async () => {
      await page.context().close();
      assert.deepEqual(complaints, []);
    });
    await page.addInitScript(paint);
    if (init) await page.addInitScript(init);
    await page.goto(`${server.address}${path}`);
    await page.waitForFunction(() => [...document.querySelectorAll('vitrine-viewer')].every((viewer) => viewer.loaded));
    await quiet(page);
    return page;
  }

  const message = (page) => page.evaluate(() => {
    const part = document.getElementById('a').shadowRoot.querySelector('[part=message]');
    return part.hidden ? '' : part.textContent;
  });

  async function picture(page) {
    const url = await page.evaluate(() => a.toDataURL());
    return PNG.sync.read(Buffer.from(url.split(',')[1], 'base64'));
  }

  const shot = async (page, id = 'a') => PNG.sync.read(await page.locator(`#${id}`).screenshot());

  /** What the element shows after a change, in the middle of its picture. @param {(page: object) => void} change in the page */
  async function middleAfter(page, change, value) {
    await page.evaluate(change, value);
    await quiet(page);
    return pixel(await picture(page), side / 2, side / 2);
  }

  const near = (seen, wanted, tolerance, what) => assert.ok(wanted.every((value, i) => Math.abs(value - seen[i]) <= tolerance), `${what}: ${seen} for ${wanted}`);

  function nativePicture(...args) {
    const result = spawnSync(binary, ['render', ...args, '-o', 'native.png', '--resolution', `${side},${side}`], { cwd: folder, env: { ...process.env, ASAN_OPTIONS: 'detect_leaks=0' } });
    assert.equal(result.status, 0, result.stderr.toString());
    return PNG.sync.read(readFileSync(join(folder, 'native.png')));
  }

  test('shows of a picture what the native program shows', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="sphere" backdrop="/ramp.png" camera-orbit="0deg 90deg 5m" camera-target="0m 0m 0m"></vitrine-viewer>');
    const camera = ['--camera', '0,0,5', '--target', '0,0,0'];
    const cases = [
      [{ }, 'sphere', '--backdrop', 'ramp.png'],
      [{ backdrop: '/tiles.png', backdropDistance: 3 }, 'sphere', '--backdrop', 'tiles.png', '--backdrop-distance', '3'],
      [{ roughness: 0.2, exposure: 2 }, 'sphere', '--backdrop', 'tiles.png', '--backdrop-distance', '3', '--roughness', '0.2', '--exposure', '1'],
      [{ roughness: null, exposure: 1, backdropDistance: null, src: 'panel' }, 'panel', '--backdrop', 'tiles.png'],
      [{ src: '', objects: 'panel:width=1.8,height=1.2,radius=0.3,bevel=0.2,thickness=0.4,rotate=20,10,0' }, '--object', 'panel:width=1.8,height=1.2,radius=0.3,bevel=0.2,thickness=0.4,rotate=20,10,0', '--backdrop', 'tiles.png'],
      [{ objects: '', relief: 'fluted', backdropDistance: 0.5 }, 'fluted', '--backdrop', 'tiles.png', '--backdrop-distance', '0.5'],
    ];
    for (const [changes, ...args] of cases) {
      await page.evaluate((values) => Object.assign(a, values), changes);
      await page.waitForFunction(() => a.loaded);
      await quiet(page);
      assert.equal(await message(page), '');
      const expected = nativePicture(...args, ...camera);
      for (const [name, seen] of [['toDataURL', await picture(page)], ['screen', await shot(page)]]) {
        const error = meanError(seen, expected);
        t.diagnostic(`${args.join(' ')}, ${name}: ${error.toFixed(3)} of 255`);
        assert.ok(error < 1, `${args.join(' ')}, ${name}: ${error}`);
      }
    }
  });

  test('a slab shifts it by the closed form', async (t) => {
    const degrees = 35, thickness = 0.4, far = 1 / Math.tan(Math.PI / 360); // 2 units high at the slab, almost parallel rays
    const page = await open(t, `<vitrine-viewer id="a" fresnel="off" objects="panel:width=1.9,height=1.9,radius=0.05,bevel=0.01,thickness=${thickness},rotate=0,${degrees},0" camera-orbit="0deg 90deg ${far}m" camera-target="0m 0m 0m" field-of-view="1deg"></vitrine-viewer>`);
    await page.evaluate((size) => { // two levels a pixel, to the right and downwards
      const canvas = new OffscreenCanvas(size, size), image = new ImageData(size, size);
      for (let i = 0; i < size * size; ++i) image.data.set([2 * (i % size), 2 * Math.floor(i / size), 77, 255], 4 * i);
      canvas.getContext('2d').putImageData(image, 0, 0);
      a.backdrop = canvas;
    }, side);
    const angle = (degrees * Math.PI) / 180, within = Math.asin(Math.sin(angle) / 1.5);
    const shift = (thickness * Math.sin(angle - within)) / Math.cos(within);
    for (const distance of [2, 40]) {
      await page.evaluate((value) => (a.backdropDistance = value), distance);
      await quiet(page);
      const seen = await picture(page), scale = side * (far / (far + distance)); // levels a unit
      for (let x = 50; x < 78; x += 3) near(pixel(seen, x, 64), [2 * x - scale * shift, 2 * 64, 77, 255], 1, `through the slab at ${x}, ${distance} behind`);
      near(pixel(seen, 2, 64), [2 * 2, 2 * 64, 77, 255], 1, 'beside it');
    }
  });

  test('takes pictures of all kinds, and follows what changes', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="panel" fresnel="off"></vitrine-viewer>');
    assert.equal(await page.evaluate(() => a.backdrop), '');
    const glass = await picture(page);
    assert.deepEqual(await middleAfter(page, () => (a.backdrop = window.fill(new OffscreenCanvas(40, 20), 'rgb(200, 30, 60)'))), [200, 30, 60, 255], 'OffscreenCanvas');
    await page.evaluate(() => (window.canvas = window.fill(Object.assign(document.createElement('canvas'), { width: 30, height: 30 }), 'rgb(10, 180, 40)')));
    assert.deepEqual(await middleAfter(page, () => (a.backdrop = window.canvas)), [10, 180, 40, 255], 'canvas');
    assert.ok(await page.evaluate(() => a.backdrop === window.canvas));
    await page.evaluate(() => window.fill(window.canvas, 'rgb(90, 20, 240)'));
    assert.deepEqual(await middleAfter(page, () => (a.backdrop = window.canvas)), [90, 20, 240, 255], 'the same, set again');
    assert.deepEqual(await middleAfter(page, () => Object.assign(window.canvas, { width: 50 }) && (a.backdrop = window.fill(window.canvas, 'rgb(7, 8, 9)'))), [7, 8, 9, 255], 'of another size');
    assert.deepEqual(await middleAfter(page, async () => (a.backdrop = await createImageBitmap(window.fill(new OffscreenCanvas(9, 9), 'rgb(0, 90, 90)')))), [0, 90, 90, 255], 'ImageBitmap');
    near(await middleAfter(page, () => (a.backdrop = Object.assign(new Image(), { src: '/ramp.png' }))), [127, 95, 77, 255], 2, 'img');
    near(await middleAfter(page, () => (a.backdrop = '/ramp.png')), [127, 95, 77, 255], 2, 'URL');
    await page.evaluate(() => a.setAttribute('backdrop', '/ramp.png'));
    await page.evaluate(() => a.removeAttribute('backdrop'));
    await quiet(page);
    assert.ok(meanError(await picture(page), glass) < 0.1, 'as it was without');
    assert.equal(await message(page), '');
  });

  /** Until the middle of what is on the screen has that colour, while `act` is repeated. */
  const awaitMiddle = (page, color, tolerance, act = '') => page.waitForFunction(([wanted, most, source]) => {
    new Function('color', source)(`rgb(${wanted})`);
    const canvas = a.shadowRoot.querySelector('canvas'), pen = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
    pen.drawImage(canvas, -canvas.width / 2, -canvas.height / 2);
    return wanted.every((value, i) => Math.abs(value - pen.getImageData(0, 0, 1, 1).data[i]) <= most);
  }, [color, tolerance, act], { polling: 50 });

  test('a video goes on by itself', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="panel" fresnel="off"></vitrine-viewer>');
    await page.evaluate(() => {
      window.canvas = Object.assign(document.createElement('canvas'), { width: 64, height: 64 });
      window.push = (color) => {
        window.fill(window.canvas, color);
        window.track.requestFrame();
      };
      window.canvas.getContext('2d');
      const stream = window.canvas.captureStream(0);
      [window.track] = stream.getVideoTracks();
      a.backdrop = Object.assign(document.createElement('video'), { muted: true, srcObject: stream });
      a.backdrop.play();
    });
    for (const color of [[200, 30, 60], [20, 160, 220], [240, 230, 20]]) await awaitMiddle(page, color, 8, 'window.push(color)');
    assert.equal(await message(page), '');
  });

  /** In the page: URL of a video of one second that begins green and goes on blue. */
  function film() {
    window.film = async () => {
      const canvas = Object.assign(document.createElement('canvas'), { width: 64, height: 64 });
      canvas.getContext('2d');
      const recorder = new MediaRecorder(canvas.captureStream(), { mimeType: 'video/webm' }), parts = [];
      recorder.ondataavailable = ({ data }) => parts.push(data);
      const end = new Promise((done) => (recorder.onstop = done));
      recorder.start();
      for (let i = 0; i < 60; ++i) {
        window.fill(canvas, i < 30 ? 'rgb(0, 200, 0)' : 'rgb(0, 0, 200)');
        await new Promise((done) => requestAnimationFrame(done));
      }
      recorder.stop();
      await end;
      return URL.createObjectURL(new Blob(parts, { type: 'video/webm' }));
    };
  }

  test('the URL of a video plays it, unless the visitor prefers reduced motion', async (t) => {
    for (const reducedMotion of ['no-preference', 'reduce']) {
      const page = await open(t, '<vitrine-viewer id="a" src="panel" fresnel="off"></vitrine-viewer>', { init: film, reducedMotion });
      await page.evaluate(async () => (a.backdrop = await window.film()));
      await awaitMiddle(page, [0, 200, 0], 20);
      if (reducedMotion === 'reduce') await quiet(page);
      else await awaitMiddle(page, [0, 0, 200], 20);
      assert.equal(await message(page), '');
    }
  });

  const overPage = `<style>body { margin: 0; background: rgb(1, 2, 3) } canvas { display: block; width: 300px; height: 200px; object-fit: cover } #a { position: absolute; left: 100px; top: 40px; width: 120px; height: 80px }</style>
    <canvas id="under" width="300" height="300"></canvas>
    <vitrine-viewer id="a" objects="panel:width=100,height=60,radius=10,bevel=2,thickness=4" fresnel="off" backdrop="#under" camera-orbit="0deg 90deg 4583m" field-of-view="1deg"></vitrine-viewer>
    <script>{
      const pen = under.getContext('2d'), image = pen.createImageData(300, 300);
      for (let i = 0; i < 90000; ++i) image.data.set([(i % 300) * 0.8, Math.floor(i / 300) * 0.8, 50, 255], 4 * i);
      pen.putImageData(image, 0, 0);
    }</script>`;

  test('over an element of the page it shows what lies under it, wherever it moves', async (t) => {
    const page = await open(t, overPage);
    /** What the page has there: 300 x 200 of 300 x 300, so that 50 rows are cut above. */
    const under = (x, y) => [0.8 * x, 0.8 * (y + 50), 50, 255];
    const look = async (left, top, what) => {
      const seen = await picture(page), screen = PNG.sync.read(await page.screenshot());
      for (const [x, y] of [[60, 40], [30, 25], [90, 60]]) {
        near(pixel(seen, x, y), under(left + x, top + y), 2, `${what}, through the glass`);
        near(pixel(screen, left + x, top + y), under(left + x, top + y), 2, `${what}, on the screen`);
      }
      assert.equal(pixel(seen, 2, 2)[3], 0, 'nothing is drawn beside the glass');
      near(pixel(screen, left + 2, top + 2), under(left + 2, top + 2), 2, 'the page is seen there');
    };
    await look(100, 40, 'as it stands');
    await page.evaluate(() => (a.style.left = '150px'));
    await quiet(page);
    await look(150, 40, 'moved by a style');
    await page.evaluate(() => Object.assign(a.style, { transform: 'translate(-70px, 60px)' }));
    await quiet(page);
    await look(80, 100, 'by a transform');
    await page.evaluate(() => Object.assign(document.body.style, { height: '900px' }) && (a.style.position = 'fixed') && window.scrollTo(0, 10));
    await quiet(page);
    near(pixel(await picture(page), 60, 40), under(140, 150), 2, 'the page scrolls under it');
    await page.waitForTimeout(1500); // no frame looks any more
    await page.evaluate(() => a.animate([{}, { transform: 'translate(-20px, 20px)' }], { duration: 100, fill: 'forwards' }).finished);
    await page.waitForTimeout(500);
    await quiet(page);
    near(pixel(PNG.sync.read(await page.screenshot()), 190, 100), under(190, 110), 2, 'an animation moved it, through the glass');
    await page.evaluate(() => window.fill(under, 'rgb(9, 90, 190)') && (a.backdrop = '#under'));
    await quiet(page);
    assert.deepEqual(pixel(await picture(page), 60, 40), [9, 90, 190, 255], 'set again');
  });

  test('live content of the page, where the browser draws it into a canvas', async (t) => {
    const page = await open(t, '<canvas id="under" layoutsubtree width="50" height="50"><p>Words</p></canvas><vitrine-viewer id="a" src="panel" fresnel="off"></vitrine-viewer>', {
      init: () => { // stands in for HTML in canvas, which browsers have behind a flag
        CanvasRenderingContext2D.prototype.drawElementImage = function (child) {
          window.fill(this.canvas, child.style.color);
        };
        HTMLCanvasElement.prototype.requestPaint = function () {
          this.dispatchEvent(new Event('paint'));
        };
      },
    });
    await page.evaluate(() => (document.querySelector('p').style.color = 'rgb(10, 20, 30)'));
    assert.deepEqual(await middleAfter(page, () => (a.backdrop = '#under') && (a.style.position = 'fixed')), [10, 20, 30, 255]);
    assert.deepEqual(await middleAfter(page, () => {
      document.querySelector('p').style.color = 'rgb(40, 200, 90)';
      document.getElementById('under').requestPaint();
    }), [40, 200, 90, 255]);
  });

  test('loads nothing of it without one', async (t) => {
    requests.length = 0;
    const page = await open(t, '<vitrine-viewer id="a" src="sphere"></vitrine-viewer>');
    const full = () => requests.filter((path) => /backdrop|full/.test(path));
    assert.deepEqual(full(), []);
    await page.evaluate(() => (a.src = 'panel'));
    await page.waitForFunction(() => a.loaded);
    await quiet(page);
    assert.deepEqual(full(), ['/vitrine-full.js', '/vitrine-full.wasm']);
    assert.equal(await message(page), '');
    await page.evaluate(() => (a.backdrop = '/ramp.png'));
    await page.waitForFunction(() => a.loaded);
    await quiet(page);
    assert.deepEqual(full(), ['/vitrine-full.js', '/vitrine-full.wasm', '/element/backdrop.js']);
    assert.equal(await page.evaluate(() => a.constructor.statistics().then(({ contexts }) => contexts)), 1);
  });

  test('the page of the demo: its glass is there, the lens follows the pointer, axe finds nothing', async (t) => {
    const page = await openPage(browser, { viewport: { width: 420, height: 500 }, reducedMotion: 'reduce' });
    const complaints = [];
    page.on('pageerror', ({ message: text }) => complaints.push(text));
    page.on('console', (said) => said.type() === 'error' && complaints.push(said.text()));
    t.after(() => page.context().close());
    await page.addInitScript(paint);
    await page.addInitScript(() => new MutationObserver(() => document.querySelectorAll('vitrine-viewer:not([samples])').forEach((viewer) => viewer.setAttribute('samples', 1))).observe(document, { childList: true, subtree: true }));
    await page.goto(`${server.address}/demo/over-a-page.html`);
    for (const viewer of await page.locator('vitrine-viewer').all()) {
      await viewer.scrollIntoViewIfNeeded();
      await viewer.evaluate((one) => one.loaded || new Promise((done) => one.addEventListener('load', done)));
    }
    const { x, y, width, height } = await page.locator('#under-lens').evaluate((map) => {
      map.scrollIntoView();
      return map.getBoundingClientRect();
    });
    await page.mouse.move(x + 0.75 * width, y + 0.5 * height);
    const seen = await page.waitForFunction(() => {
      const lens = document.getElementById('lens'), [[left, top]] = lens.project([[0, 0, 0]]), box = lens.getBoundingClientRect();
      return Math.abs(left - box.left - 0.75 * box.width) < 2 && Math.abs(top - box.top - 0.5 * box.height) < 2;
    });
    assert.ok(seen, 'the lens is under the pointer');
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 420, 'no horizontal scrolling');
    await quiet(page);
    const axe = readFileSync(join(here, 'node_modules/axe-core/axe.min.js'), 'utf8');
    const found = await page.evaluate(`(async () => { ${axe}; return (await window.axe.run()).violations; })()`);
    assert.deepEqual(found.map(({ id, nodes }) => [id, ...nodes.map(({ html }) => html)]), []);
    assert.deepEqual([complaints, await page.evaluate(() => window.problems)], [[], []]);
  });

  test('what cannot be is told, and the picture before stays', async (t) => {
    const page = await open(t, '<p id="words">Words</p><img id="foreign"><vitrine-viewer id="a" src="panel" fresnel="off" backdrop="/ramp.png"></vitrine-viewer>', { allowed: /404|CORS|ERR_FAILED|tainted/ });
    const { host } = new URL(other.address);
    const cases = [
      ['/none.png', 'none.png: the server answered 404 Not Found'],
      ['/none.webm', 'none.webm: the server answered 404 Not Found'],
      ['/words.png', '/words.png: no picture or video that this browser can decode; save it as PNG, JPEG, WebP, WebM or MP4'],
      ['/words.webm', '/words.webm: no picture or video that this browser can decode; save it as PNG, JPEG, WebP, WebM or MP4'],
      [`${other.address}/tiles.png`, `tiles.png: cannot be fetched: ${host} does not let this page read it; it has to answer with Access-Control-Allow-Origin`],
      ['#nowhere', "backdrop is '#nowhere'; there must be an img, a video or a canvas of that id in the page"],
      ['#words', "backdrop is '#words'; there must be an img, a video or a canvas of that id in the page"],
    ];
    for (const [url, sentence] of cases) {
      await page.evaluate((value) => (a.backdrop = value), url);
      await page.waitForFunction((value) => window.problems.at(-1) === value, sentence);
      await quiet(page);
      assert.equal(await message(page), sentence);
      near(pixel(await picture(page), side / 2, side / 2), [127, 95, 77, 255], 2, url);
      await page.evaluate(() => (a.backdrop = '/ramp.png'));
      await page.waitForFunction(() => a.shadowRoot.querySelector('[part=message]').hidden);
    }
    await page.evaluate(async (src) => {
      Object.assign(document.getElementById('foreign'), { src });
      a.backdrop = '#foreign';
    }, `${other.address}/tiles.png`);
    await page.waitForFunction(() => window.problems.at(-1).includes('crossorigin'));
    assert.equal(await message(page), 'backdrop: this page may not read the pixels of that picture; give it the attribute crossorigin, and have its server answer with Access-Control-Allow-Origin');
    await page.evaluate(() => Object.assign(a, { backdrop: '/ramp.png', technique: 'layered' }));
    await page.waitForFunction(() => window.problems.at(-1).includes('technique'));
    assert.equal(await message(page), 'technique layered shows no backdrop; exact and heightfield do');
    await page.evaluate(() => (a.technique = null));
    await quiet(page);
    assert.equal(await message(page), '');
  });
});
