// The plain page of GLFW's port in headless Chromium: pictures as the native program draws them, input, layouts.
// Needs build/web (`emcmake cmake --preset web && cmake --build --preset web`), the native program, Chromium
// and `npm ci` in this folder; without one of them the tests skip themselves and say so.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { chromiumPath, launch, openPage, serve, skipWithout } from './browser-tools.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const site = resolve(process.env.VITRINE_WEB ?? join(here, '../build/web'));
const binary = resolve(process.env.VITRINE_BINARY ?? join(here, '../build/release/vitrine'));
const screenshots = join(here, '../build/screenshots');

const modules = await Promise.all(['playwright-core', 'pixelmatch', 'pngjs'].map((name) => import(name))).catch(() => null);
const skip = skipWithout(
  [modules, "node modules (run 'npm ci' in tests/)"],
  [existsSync(join(site, 'vitrine.wasm')), site],
  [existsSync(binary), binary],
  [existsSync(chromiumPath), chromiumPath],
);
const [, { default: pixelmatch }, { PNG }] = modules ?? [{}, {}, {}];

const wide = { width: 800, height: 420 };
const little = { width: 200, height: 200 }; // where the canvas is not looked at: a software GPU draws it

/** Waits until nothing is being drawn and nothing waits to be. */
function settle(page) {
  return page.evaluate(async () => {
    for (let quiet = 0; quiet < 3; quiet = window.vitrine.isIdle() ? quiet + 1 : 0) {
      await new Promise(requestAnimationFrame);
    }
  });
}

async function picture(page, width = 256, height = 256) {
  const text = await page.evaluate(([w, h]) => {
    let bytes = '';
    for (const byte of window.vitrine.image(w, h)) bytes += String.fromCharCode(byte);
    return btoa(bytes);
  }, [width, height]);
  return { width, height, data: Buffer.from(text, 'base64') };
}

/** The part of the canvas that no words cover, as the visitor sees it. */
async function canvasPart(page) {
  await settle(page);
  return PNG.sync.read(await page.screenshot({ clip: { x: 0, y: 0, width: 460, height: 240 } }));
}

/** Percentage of pixels that differ visibly. */
function difference(a, b) {
  assert.deepEqual([a.width, a.height], [b.width, b.height]);
  return (100 * pixelmatch(a.data, b.data, null, a.width, a.height, { threshold: 0.1 })) / (a.width * a.height);
}

describe('the page', { skip }, () => {
  let server, browser, folder;

  before(async () => {
    mkdirSync(screenshots, { recursive: true });
    folder = mkdtempSync(join(tmpdir(), 'vitrine-web-'));
    server = await serve(site);
    browser = await launch();
  });
  after(async () => {
    await browser?.close();
    server?.close();
    if (folder) rmSync(folder, { recursive: true, force: true });
  });

  /** A fresh page; when the test is over its console must hold no error and no complaint of WebGL. */
  async function open(t, { init, waits = true, from = browser, ...options } = {}) {
    const page = await openPage(from, { viewport: wide, colorScheme: 'dark', ...options });
    const complaints = [];
    page.on('pageerror', (error) => complaints.push(String(error)));
    page.on('console', (message) => {
      if (message.type() === 'error' || /INVALID_|feedback|incomplete/i.test(message.text())) complaints.push(message.text());
    });
    t.after(async () => {
      await page.context().close();
      assert.deepEqual(complaints, []);
    });
    if (init) await page.addInitScript(init);
    await page.goto(`${server.address}/`);
    if (waits) {
      const state = await page.waitForFunction(() => {
        const text = document.querySelector('[role=alert]').textContent;
        return window.vitrine?.info().drawCount > 0 ? 'drawn' : /^(GL|page|renderer):/.test(text) && text;
      });
      assert.equal(await state.jsonValue(), 'drawn');
      await settle(page);
    }
    return page;
  }

  function nativePicture() {
    const result = spawnSync(binary, ['render', 'knot', '-o', 'native.png', '--environment', 'studio', '--resolution', '256,256',
      '--camera', '0.36,0.3,3.05', '--target', '0,0,0', '--fov', '45'], { cwd: folder, env: { ...process.env, ASAN_OPTIONS: 'detect_leaks=0' } });
    assert.equal(result.status, 0, result.stderr.toString());
    return PNG.sync.read(readFileSync(join(folder, 'native.png')));
  }

  const setView = (page) => page.evaluate(() => window.vitrine.setView(0.36, 0.3, 3.05, 0, 0, 0, 45));
  const alertText = (page) => page.textContent('[role=alert]');

  test('shows the knot in glass', async (t) => {
    const page = await open(t, { viewport: { width: 1280, height: 800 } });
    await page.screenshot({ path: join(screenshots, 'wide-dark.png') });
    const seen = await canvasPart(page);
    const colors = new Set();
    for (let i = 0; i < seen.data.length; i += 4) colors.add(seen.data.readUInt32BE(i));
    assert.ok(colors.size > 100, `${colors.size} colours`);
    assert.equal(await alertText(page), '');
    await page.emulateMedia({ colorScheme: 'light' });
    await page.screenshot({ path: join(screenshots, 'wide-light.png') });
  });

  // Measured on llvmpipe (native: OSMesa, also llvmpipe): 0 %; 0.008 % of pixels are off by up to 17 of 255.
  test('draws what the native program draws', async (t) => {
    const page = await open(t, { viewport: little });
    await setView(page);
    const differing = difference(await picture(page), nativePicture());
    t.diagnostic(`${differing.toFixed(4)} % differ`);
    assert.ok(differing < 0.5, `${differing} % differ`);
  });

  // Measured on SwiftShader: 0.42 %: another rasterizer and other rounding.
  test('draws the same on SwiftShader', async (t) => {
    const other = await launch('swiftshader');
    t.after(() => other.close());
    const page = await open(t, { from: other, viewport: little });
    await setView(page);
    const differing = difference(await picture(page), nativePicture());
    t.diagnostic(`${differing.toFixed(4)} % differ`);
    assert.ok(differing < 0.5, `${differing} % differ`);
  });

  test('needs no extension', async (t) => {
    const init = () => {
      const type = WebGL2RenderingContext.prototype;
      type.getExtension = () => null;
      type.getSupportedExtensions = () => [];
    };
    const plain = await open(t, { viewport: little });
    const bare = await open(t, { init, viewport: little });
    for (const page of [plain, bare]) await setView(page);
    assert.ok((await picture(plain)).data.equals((await picture(bare)).data), 'the same bytes');
  });

  test('turns under mouse, wheel and keys', async (t) => {
    const page = await open(t);
    const first = await canvasPart(page);
    await page.mouse.move(300, 200);
    await page.mouse.down();
    await page.mouse.move(420, 240, { steps: 3 });
    await page.mouse.move(700, 60, { steps: 2 });
    await page.mouse.up();
    const turned = await canvasPart(page);
    assert.ok(difference(first, turned) > 3, 'the drag turns');
    await page.mouse.move(200, 100, { steps: 2 });
    assert.equal(difference(turned, await canvasPart(page)), 0, 'a released button turns nothing');
    await page.mouse.wheel(0, 200);
    const far = await canvasPart(page);
    assert.ok(difference(turned, far) > 3, 'the wheel zooms');

    await page.focus('#canvas');
    await page.keyboard.press('Home');
    assert.equal(difference(first, await canvasPart(page)), 0, 'Home goes back');
    for (const key of ['ArrowLeft', 'ArrowUp', '+']) {
      const old = await canvasPart(page);
      await page.keyboard.press(key);
      assert.ok(difference(old, await canvasPart(page)) > 1, key);
    }
    await page.keyboard.press('Tab');
    assert.notEqual(await page.evaluate(() => document.activeElement.id), 'canvas', 'Tab leaves the canvas');
  });

  test('an idle page draws nothing', async (t) => {
    const page = await open(t, { viewport: little });
    const count = () => page.evaluate(() => window.vitrine.info().drawCount);
    const old = await count();
    assert.equal(old, 1);
    await page.waitForTimeout(1000);
    assert.equal(await count(), old);
  });

  test('a resized window is filled', async (t) => {
    const page = await open(t, { deviceScaleFactor: 3, viewport: { width: 300, height: 400 } });
    const size = () => page.evaluate(() => [canvas.width / canvas.clientWidth, canvas.height / canvas.clientHeight]);
    assert.deepEqual(await size(), [2, 2], 'two pixels a CSS pixel at most');
    await page.setViewportSize({ width: 350, height: 300 });
    await settle(page);
    assert.deepEqual(await size(), [2, 2]);
  });

  test('fits a telephone', async (t) => {
    const page = await open(t, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
    await page.screenshot({ path: join(screenshots, 'narrow.png') });
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390, 'no horizontal scrolling');
    const old = await picture(page, 64, 64);
    const touch = await page.context().newCDPSession(page);
    const send = (type, ...points) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    await send('touchStart', [100, 200]);
    await send('touchMove', [180, 220]);
    await send('touchEnd');
    await settle(page);
    const turned = await picture(page, 64, 64);
    assert.ok(difference(old, turned) > 3, 'one finger turns');
    await send('touchStart', [150, 200], [200, 200]);
    await send('touchMove', [100, 200], [250, 200]);
    await send('touchEnd');
    await settle(page);
    assert.ok(difference(turned, await picture(page, 64, 64)) > 3, 'two fingers zoom');
  });

  test('starts again after a lost context', async (t) => {
    const page = await open(t);
    await page.evaluate(() => {
      window.isOld = true;
      window.loss = canvas.getContext('webgl2').getExtension('WEBGL_lose_context');
      window.loss.loseContext();
    });
    await page.waitForFunction(() => document.querySelector('[role=alert]').textContent.includes('context was lost'));
    await page.evaluate(() => window.loss.restoreContext());
    await page.waitForFunction(() => !window.isOld && window.vitrine?.info().drawCount > 0);
  });

  test('says so where there is no WebGL 2', async (t) => {
    const init = () => {
      const real = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind === 'webgl2' ? null : real.call(this, kind, ...rest);
      };
    };
    const page = await open(t, { init, waits: false });
    await page.waitForFunction(() => document.querySelector('[role=alert]').textContent !== '');
    assert.match(await alertText(page), /WebGL 2/);
    await page.screenshot({ path: join(screenshots, 'no-webgl.png') });
  });
});
