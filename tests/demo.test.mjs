// The demo page in headless Chromium: every control, the address, the wipe, files, layouts, accessibility.
// Needs build/web (`emcmake cmake --preset web && cmake --build --preset web`), Chromium and `npm ci` in this
// folder; without one of them the tests skip themselves and say so.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { glb, gltf, tetrahedron } from '../scripts/glb.mjs';
import { chromiumPath, launch, openPage, quiet, serve, skipWithout } from './browser-tools.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const site = resolve(process.env.VITRINE_WEB ?? join(here, '../build/web'));
const screenshots = join(here, '../build/screenshots');

const modules = await Promise.all(['playwright-core', 'pixelmatch', 'pngjs', 'axe-core'].map((name) => import(name))).catch(() => null);
const skip = skipWithout(
  [modules, "node modules (run 'npm ci' in tests/)"],
  [existsSync(join(site, 'demo/index.html')), join(site, 'demo')],
  [existsSync(chromiumPath), chromiumPath],
);
const [, { default: pixelmatch }, { PNG }] = modules ?? [{}, {}, {}];

const small = { width: 780, height: 420 };
const quick = 'layers=2&steps=12&events=4'; // llvmpipe computes every pixel on the CPU
const visible = { x: 0, y: 130, width: 424, height: 150 }; // neither panel nor gallery nor captions

/** In the page, before its scripts: counts draw calls, layout shifts and violations of the policy. */
function watch() {
  // One sample a pixel: a software GPU takes a while for 64.
  const { createElement } = Document.prototype;
  Document.prototype.createElement = function (name, ...rest) {
    const element = createElement.call(this, name, ...rest);
    if (name === 'vitrine-viewer') element.setAttribute('samples', '1');
    return element;
  };
  window.watched = { draws: 0, shift: 0, isCalm: true, violations: [] };
  for (const name of ['drawArrays', 'drawElements']) {
    const real = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function (...values) {
      ++window.watched.draws;
      return real.apply(this, values);
    };
  }
  // What an input moves is meant to, however long it takes until it does; the browser's own hadRecentInput says half a second.
  for (const name of ['pointerdown', 'keydown', 'click', 'input', 'change', 'drop', 'resize']) {
    window.addEventListener(name, () => (window.watched.isCalm = false), true);
  }
  const note = (entries) => {
    for (const { value } of entries) window.watched.shift += window.watched.isCalm ? value : 0;
  };
  const observer = new PerformanceObserver((list) => note(list.getEntries()));
  observer.observe({ type: 'layout-shift', buffered: true });
  window.calm = () => {
    note(observer.takeRecords());
    window.watched.isCalm = true;
  };
  document.addEventListener('securitypolicyviolation', (event) => window.watched.violations.push(`${event.violatedDirective} ${event.blockedURI}`));
}

/** Waits until every viewer shows its model and nothing is left to do. */
async function settle(page) {
  await page.waitForFunction(() => [...document.querySelectorAll('vitrine-viewer')].every((viewer) => viewer.loaded) && window.watched.draws > 0);
  await quiet(page);
  await page.evaluate(() => window.calm());
}

async function seen(page, clip = visible) {
  await settle(page);
  return PNG.sync.read(await page.screenshot({ clip }));
}

/** Percentage of pixels that differ visibly. */
function difference(a, b) {
  assert.deepEqual([a.width, a.height], [b.width, b.height]);
  return (100 * pixelmatch(a.data, b.data, null, a.width, a.height, { threshold: 0.1 })) / (a.width * a.height);
}

function columns(image, from, to) {
  const part = new PNG({ width: to - from, height: image.height });
  PNG.bitblt(image, part, from, 0, to - from, image.height, 0, 0);
  return part;
}

describe('the demo page', { skip }, () => {
  let server, browser;

  before(async () => {
    mkdirSync(screenshots, { recursive: true });
    server = await serve(site);
    browser = await launch();
  });
  after(async () => {
    await browser?.close();
    server?.close();
  });

  /** A fresh page; when the test is over there must have been no error, violation or layout shift. */
  async function open(t, query = quick, options = {}) {
    const page = await openPage(browser, { viewport: small, colorScheme: 'dark', ...options });
    const complaints = [];
    page.on('pageerror', (error) => complaints.push(String(error)));
    page.on('console', (message) => {
      if (message.type() === 'error' || /INVALID_|feedback|incomplete/i.test(message.text())) complaints.push(message.text());
    });
    t.after(async () => {
      const { shift, violations } = await page.evaluate(() => window.watched);
      await page.context().close();
      assert.deepEqual([...complaints, ...violations], []);
      assert.ok(shift < 0.05, `layout shifts by ${shift}`);
    });
    await page.addInitScript(watch);
    await page.goto(`${server.address}/demo/?${query}`);
    await settle(page);
    await page.evaluate(() => (document.querySelector('details').open = true)); // what few ask for
    return page;
  }

  const query = async (page) => {
    await quiet(page); // the address follows at most three times a second
    return Object.fromEntries(new URLSearchParams(await page.evaluate(() => location.search)));
  };
  const slide = (page, id, value) => page.locator(`#${id}`).fill(String(value));
  const drop = (page, name, bytes) => page.evaluate(([file, text]) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))], file));
    for (const type of ['dragenter', 'dragover', 'drop']) {
      document.getElementById('stage').dispatchEvent(new DragEvent(type, { dataTransfer, bubbles: true, cancelable: true }));
    }
  }, [name, bytes.toString('base64')]);

  test('shows the knot, and draws nothing while nothing changes', async (t) => {
    const page = await open(t, '', { viewport: { width: 1280, height: 800 } });
    await page.screenshot({ path: join(screenshots, 'demo-wide-dark.png') });
    const { draws } = await page.evaluate(() => window.watched);
    await page.waitForTimeout(700);
    assert.equal(await page.evaluate(() => window.watched.draws), draws);
    assert.match(await page.textContent('#size'), /^\d+ × \d+ · 8 events$/);
    const [canvas, panel, gallery] = await Promise.all(['vitrine-viewer', '.panel', '.gallery'].map((one) => page.locator(one).boundingBox()));
    assert.deepEqual([canvas.x, canvas.y, canvas.x + canvas.width, canvas.y + canvas.height], [0, 0, panel.x, gallery.y], 'no pixel is drawn that nobody sees');
    for (const href of await page.locator('header a').evaluateAll((links) => links.map((link) => link.href))) {
      if (href.startsWith(server.address)) assert.equal((await page.request.get(href)).status(), 200, href);
    }
    await page.emulateMedia({ colorScheme: 'light' });
    await page.screenshot({ path: join(screenshots, 'demo-wide-light.png') });
  });

  test('every control changes picture, number and address', async (t) => {
    const page = await open(t, `${quick}&quality=high&technique=layered`);
    let old = await seen(page);
    const changes = async (name, least = 0.1) => {
      const now = await seen(page);
      const differing = difference(old, now);
      assert.ok(differing > least, `${name}: ${differing} % differ`);
      old = now;
    };
    for (const [id, value, shown] of [['layers', 1, '1'], ['layers', 4, '4'], ['steps', 3, '3'], ['events', 2, '2'], ['ior', 1.2, '1.200'], ['exposure', 1, '+1.0 EV'], ['fov', 30, '30°']]) {
      await slide(page, id, value);
      assert.equal(await page.textContent(`#${id}-value`), shown);
      await changes(id, 0.02);
    }
    await page.getByRole('button', { name: 'Goblet' }).click();
    await changes('model', 1);
    assert.equal(await page.getByRole('button', { name: 'Goblet' }).getAttribute('aria-pressed'), 'true');
    await page.locator('#environment input[value=checker]').check();
    await changes('environment', 3);
    await page.locator('#tone input[value=agx]').check();
    await changes('tone', 3);
    await page.locator('#backdrop').uncheck();
    await changes('backdrop', 3);
    await page.locator('#ground').check(); // beyond the clip; the element's tests look at it
    assert.equal(await page.getAttribute('vitrine-viewer', 'ground'), '');
    await page.selectOption('#technique', 'single');
    await changes('technique');
    assert.ok(await page.isDisabled('#layers'), 'a slider that the technique does not heed');
    await page.locator('#quality input[value=low]').check();
    await changes('quality');
    await page.locator('#theme input[value=light]').check();
    await changes('theme', 10);
    assert.deepEqual(await query(page), {
      model: 'goblet', environment: 'checker', backdrop: '0', ground: '1', technique: 'single', ior: '1.2', layers: '4', steps: '3', events: '2',
      quality: 'low', exposure: '1', tone: 'agx', fov: '30', theme: 'light',
    });

    for (const [name, ior] of [['Water', '1.333'], ['Crown glass', '1.517'], ['Flint', '1.62'], ['Sapphire', '1.768'], ['Diamond', '2.417']]) {
      await page.locator('#glasses').getByRole('button', { name }).click();
      assert.equal(await page.inputValue('#ior'), ior);
      assert.equal(await page.getAttribute('vitrine-viewer', 'ior'), ior);
      assert.equal(await page.locator('#glasses [aria-pressed=true]').textContent(), name);
    }
  });

  test('scenes have an index for each object', async (t) => {
    const page = await open(t, 'quality=high'); // the knot behind needs its steps
    for (const [title, id, names] of [['Knot behind a cube', 'behind', ['Cube', 'Knot']], ['Water in a tumbler', 'tumbler', ['Tumbler', 'Water']]]) {
      const knot = await seen(page);
      await page.getByRole('button', { name: title }).click();
      const scene = await seen(page);
      assert.ok(difference(knot, scene) > 10, `${title} is seen`);
      await page.screenshot({ path: join(screenshots, `demo-${id}.png`) });
      assert.deepEqual(await page.locator('#objects label').allTextContents(), names);
      assert.ok(await page.isHidden('#ior'), 'no index for all');
      await page.getByLabel(names[0], { exact: true }).fill('1.1');
      assert.equal(await page.textContent('#object-0-value'), '1.100');
      const changed = await seen(page);
      assert.ok(difference(scene, changed) > 3, `${names[0]} of another index: ${difference(scene, changed)} % differ`);
      const link = await query(page);
      assert.deepEqual([link.model, link.iors.split(',')[0]], [id, '1.1']);
      const again = await open(t, String(new URLSearchParams(link)));
      assert.ok(difference(changed, await seen(again)) < 0.5, 'a link shows the same');
      await page.getByRole('button', { name: 'Knot', exact: true }).click();
      assert.equal((await query(page)).iors, undefined);
      assert.ok(await page.isVisible('#ior'));
    }
    await page.mouse.click(190, 160);
  });

  test('relief glass of patterns and of a dropped picture', async (t) => {
    const page = await open(t, `${quick}&quality=high`);
    assert.ok(await page.isHidden('#relief-glass'));
    let old = await seen(page);
    const changes = async (name, least) => {
      const now = await seen(page);
      const differing = difference(old, now);
      assert.ok(differing > least, `${name}: ${differing} % differ`);
      old = now;
    };
    await page.getByRole('button', { name: 'Relief glass' }).click();
    await changes('the relief', 10);
    assert.equal(await page.inputValue('#technique'), 'heightfield');
    assert.ok(await page.isHidden('#smooth'), 'patterns need no smoothing');
    for (const [id, depth] of [['hammered', '0.050'], ['lens-array', '0.060'], ['fluted', '0.040']]) {
      await page.locator(`#relief input[value=${id}]`).check();
      assert.equal(await page.textContent('#depth-value'), depth);
      await changes(id, 5);
    }
    await slide(page, 'depth', 0.2);
    await changes('depth', 2);
    await slide(page, 'slab', 0.5);
    await changes('slab', 1);
    await page.screenshot({ path: join(screenshots, 'demo-relief.png') });
    const link = await query(page);
    assert.deepEqual([link.model, link.relief, link.depth, link.slab, link.smooth, link.technique], ['relief', 'fluted', '0.2', '0.5', undefined, undefined]);
    const again = await open(t, String(new URLSearchParams(link)));
    assert.ok(difference(old, await seen(again)) < 0.5, 'a link shows the same');
    assert.deepEqual(await query(again), link);
    await page.locator('#preset input[value=medium]').check(); // enough steps for triangles
    old = await seen(page);
    await page.selectOption('#technique', 'exact');
    const differing = difference(old, await seen(page));
    assert.ok(differing < 0.5, `triangles show the same: ${differing} % differ`);
    assert.equal((await query(page)).technique, 'exact');
    await page.selectOption('#technique', 'heightfield');
    await settle(page);

    await page.evaluate(() => document.getElementById('stage').dispatchEvent(new DragEvent('dragenter', { bubbles: true, dataTransfer: new DataTransfer() })));
    assert.match(await page.textContent('.dropzone'), /or a picture to see it as relief glass/);
    const hills = new PNG({ width: 64, height: 48 });
    for (let i = 0; i < 64 * 48; ++i) hills.data.fill(128 + 100 * Math.sin(i % 64 / 5) * Math.cos(Math.floor(i / 64) / 7), 4 * i, 4 * i + 4);
    await drop(page, 'hills.png', PNG.sync.write(hills));
    await page.waitForSelector('#relief .file input:checked', { state: 'attached' });
    assert.ok(await page.locator('#environment input[value=sky]').isChecked(), 'the surroundings stay');
    await changes('hills.png', 5);
    await page.screenshot({ path: join(screenshots, 'demo-relief-picture.png') });
    await slide(page, 'smooth', 8);
    await changes('smoothing', 3);
    assert.equal((await query(page)).relief, undefined, 'a file has no address');
    await page.mouse.click(190, 200);
    assert.ok(await page.locator('#path-list li').count() >= 2, 'a click traces its path');
    await drop(page, 'broken.png', Buffer.from('nothing'));
    await page.waitForSelector('#error:not([hidden])');
    assert.match(await page.textContent('[role=alert]'), /broken\.png/);
    await page.getByRole('button', { name: 'Dismiss' }).click();
    assert.ok(await page.locator('#relief .file input').isChecked(), 'the picture before stays');
    await page.setInputFiles('#relief-file', { name: 'flat.png', mimeType: 'image/png', buffer: PNG.sync.write(new PNG({ width: 9, height: 9 })) });
    await page.waitForFunction(() => document.querySelector('#relief .file')?.textContent === 'flat.png');
    assert.equal(await page.inputValue('#technique'), 'heightfield');
    await page.getByRole('button', { name: 'Knot', exact: true }).click();
    assert.equal(await page.inputValue('#technique'), 'exact');
    assert.ok(await page.isHidden('#relief-glass'));
    assert.equal((await query(page)).depth, undefined);
  });

  test('presets and own numbers', async (t) => {
    const page = await open(t, 'quality=high');
    const show = (...expected) => page.waitForFunction((texts) => {
      const now = ['layers', 'steps', 'events'].map((id) => document.getElementById(`${id}-value`).textContent);
      return texts.join() === now.join();
    }, expected);
    const keep = (address) => page.waitForFunction((search) => location.search === search, address);
    await show('4 (preset)', '50 (preset)', '8 (preset)');
    assert.equal(await page.inputValue('#steps'), '50');
    await page.locator('#preset input[value=low]').check();
    await show('2 (preset)', '25 (preset)', '4 (preset)');
    assert.match(await page.textContent('#size'), /· 4 events$/);
    assert.match(await page.getAttribute('#size', 'title'), /preset low/);
    await page.selectOption('#technique', 'layered');
    await page.waitForFunction(() => document.getElementById('size').textContent.endsWith('· 2 layers · 25 steps'));
    await slide(page, 'layers', 3);
    await show('3', '25 (preset)', '4 (preset)');
    assert.equal(await page.locator('#preset :checked').count(), 0);
    await keep('?technique=layered&preset=low&layers=3&quality=high');
    await page.locator('#preset input[value=medium]').check();
    await show('4 (preset)', '50 (preset)', '8 (preset)');
    await keep('?technique=layered&quality=high');
  });

  test('layers and path colours', async (t) => {
    const page = await open(t);
    if (!(await page.evaluate(() => 'output' in document.querySelector('vitrine-viewer')))) {
      assert.ok(await page.locator('#output input[value=analysis]').isDisabled());
      t.diagnostic('the element has no output yet');
      return;
    }
    const pictures = [await seen(page)];
    await page.mouse.move(150, 200);
    await page.mouse.down();
    await page.mouse.move(200, 220, { steps: 3 });
    await page.mouse.up();
    pictures[0] = await seen(page);
    const viewOf = () => page.evaluate(() => {
      const viewer = document.querySelector('vitrine-viewer');
      return [String(viewer.getCameraOrbit()), Object.values(viewer.getCameraTarget()), viewer.getFieldOfView()];
    });
    const view = await viewOf();
    for (const output of ['analysis', 'layer-depth', 'layer-normal']) {
      await page.locator(`#output input[value=${output}]`).check();
      pictures.push(await seen(page));
    }
    await page.screenshot({ path: join(screenshots, 'demo-normals.png') });
    assert.equal(await page.inputValue('#technique'), 'layered', 'which has layers to show');
    assert.deepEqual(await viewOf(), view, 'seen as before');
    await page.locator('#output input[value=picture]').check();
    assert.equal(await page.inputValue('#technique'), 'exact', 'and the one before comes back');
    await page.locator('#output input[value=layer-normal]').check();
    await quiet(page);
    await slide(page, 'layer', 1);
    pictures.push(await seen(page));
    await page.selectOption('#technique', 'exact');
    pictures.push(await seen(page));
    assert.ok(await page.locator('#output input[value=picture]').isChecked());
    for (let i = 1; i < pictures.length; ++i) assert.ok(difference(pictures[i - 1], pictures[i]) > 3, `${i}`);
  });

  test('a link shows the same', async (t) => {
    const page = await open(t, `${quick}&model=torus&technique=oliveira&ior=1.7`);
    const first = await seen(page);
    await page.mouse.move(150, 200);
    await page.mouse.down();
    await page.mouse.move(230, 240, { steps: 4 });
    await page.mouse.up();
    const turned = await seen(page);
    assert.ok(difference(first, turned) > 2, 'the drag turns');
    const link = await query(page);
    assert.match(link.orbit, /^[-\d.]+deg [-\d.]+deg [\d.]+m$/);
    const again = await open(t, String(new URLSearchParams(link)));
    const differing = difference(turned, await seen(again));
    assert.ok(differing < 0.5, `${differing} % differ`);
    assert.equal(await again.inputValue('#technique'), 'oliveira');
    assert.deepEqual(await query(again), link);
    await again.click('#reset');
    assert.ok(difference(first, await seen(again)) < 0.5, 'the view is reset');
  });

  test('a bad address is answered with sentences', async (t) => {
    const page = await open(t, `${quick}&model=teapot&ior=99&orbit=up`);
    const text = await page.textContent('[role=alert]');
    for (const word of [/model is 'teapot'/, /ior is '99'; it must be a number from 1 to 4/, /orbit is 'up'/]) assert.match(text, word);
    assert.equal(await page.textContent('#ior-value'), '1.500');
    await page.getByRole('button', { name: 'Dismiss' }).click();
    assert.ok(await page.isHidden('#error'));
  });

  test('wipes between two techniques', async (t) => {
    const single = await seen(await open(t, `${quick}&technique=single`));
    const exact = await seen(await open(t, quick));
    const page = await open(t, `${quick}&compare=single&wipe=50`);
    const both = await seen(page);
    const middle = 212; // of the visible width
    const sides = [[0, middle - 24, exact, single], [middle + 24, 424, single, exact]];
    for (const [from, to, same, other] of sides) {
      const part = columns(both, from, to);
      assert.ok(difference(part, columns(same, from, to)) < 0.5, `from ${from}: as the single view`);
      assert.ok(difference(part, columns(other, from, to)) > 3, `from ${from}: unlike the other`);
    }

    const divider = page.getByRole('slider', { name: 'Divider' });
    await divider.focus();
    for (const [key, value] of [['ArrowRight', '52'], ['PageUp', '62'], ['End', '100'], ['Home', '0'], ['PageUp', '10']]) {
      await page.keyboard.press(key);
      assert.equal(await divider.getAttribute('aria-valuenow'), value, key);
    }
    const { x, y, width, height } = await divider.boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(318, 200, { steps: 3 });
    await page.mouse.up();
    assert.equal(await divider.getAttribute('aria-valuenow'), '75');

    const follows = async (what) => {
      await settle(page);
      const orbits = await page.evaluate(() => [...document.querySelectorAll('vitrine-viewer')].map((viewer) => {
        const { theta, phi, radius } = viewer.getCameraOrbit();
        return [theta, phi, radius].map((value) => value.toFixed(3));
      }));
      assert.deepEqual(orbits[1], orbits[0], what);
    };
    await slide(page, 'fov', 60);
    await follows('another field of view');
    await page.setViewportSize({ width: 840, height: 420 });
    await follows('another window');
    await page.mouse.move(100, 160);
    await page.mouse.down();
    await page.mouse.move(160, 160, { steps: 3 });
    await page.mouse.up();
    await follows('a drag');
    await page.screenshot({ path: join(screenshots, 'demo-wipe.png') });
    await page.selectOption('#compare', 'none');
    assert.equal(await page.locator('vitrine-viewer').count(), 1, 'the second context is given back');
  });

  test('wipes against stored pictures', async (t) => {
    const page = await open(t, 'quality=high');
    await page.selectOption('#compare', 'reference');
    await page.waitForSelector('#right .picture');
    const traced = await slideTo(page, 0), ours = await slideTo(page, 100);
    const differing = difference(traced, ours);
    t.diagnostic(`the reference differs by ${differing.toFixed(1)} %`);
    assert.ok(differing < 12, `${differing} % differ`); // measured 4.4: noise, and 4 samples a pixel
    assert.equal(await page.textContent('#right-name'), 'Ray-traced reference');
    await page.getByRole('button', { name: 'Keep this picture' }).click();
    await page.waitForFunction(() => document.querySelector('#compare').value.startsWith('blob:'));
    assert.ok(difference(await slideTo(page, 0), ours) < 0.5, 'the kept picture is what was shown');
    async function slideTo(where, wipe) {
      await where.focus('#divider');
      await where.keyboard.press(wipe === 0 ? 'Home' : 'End');
      return seen(where, { x: 30, y: 130, width: 360, height: 40 });
    }
  });

  test('files by drop and by button', async (t) => {
    const page = await open(t);
    const first = await seen(page);
    await drop(page, 'broken.glb', Buffer.from('not a model'));
    await page.waitForSelector('#error:not([hidden])');
    assert.match(await page.textContent('[role=alert]'), /broken\.glb/);
    assert.equal(await page.locator('#gallery .shape', { hasText: 'broken' }).count(), 0, 'it leaves no tile');
    await page.screenshot({ path: join(screenshots, 'demo-error.png') });
    await page.getByRole('button', { name: 'Dismiss' }).click();
    assert.ok(difference(first, await seen(page)) < 0.5, 'the picture stays');
    assert.equal(await page.getByRole('button', { name: 'Knot', exact: true }).getAttribute('aria-pressed'), 'true');

    await drop(page, 'tetrahedron.glb', glb(gltf(tetrahedron)));
    await page.waitForSelector('[data-url^="blob:"][aria-pressed=true]');
    assert.ok(await page.isHidden('#error'));
    assert.ok(difference(first, await seen(page)) > 3);
    assert.equal((await query(page)).model, undefined, 'a file has no address');

    const old = await seen(page);
    await drop(page, 'broken.hdr', Buffer.from('nothing'));
    await page.waitForSelector('#error:not([hidden])');
    assert.match(await page.textContent('[role=alert]'), /broken\.hdr/);
    assert.ok(await page.locator('#environment input[value=sky]').isChecked());
    await page.getByRole('button', { name: 'Dismiss' }).click();
    await page.setInputFiles('#picture-file', { name: 'words.png', mimeType: 'image/png', buffer: Buffer.from('no picture') });
    await page.waitForSelector('#error:not([hidden])');
    assert.match(await page.textContent('[role=alert]'), /^words\.png: no picture that this browser can decode; save it as PNG/);
    assert.equal(await page.inputValue('#compare'), 'none');
    await page.getByRole('button', { name: 'Dismiss' }).click();
    const red = new PNG({ width: 4, height: 2 });
    red.data.fill(Buffer.from([200, 10, 10, 255]));
    await page.setInputFiles('#image-file', { name: 'red.png', mimeType: 'image/png', buffer: PNG.sync.write(red) });
    await page.waitForSelector('#environment .file input:checked', { state: 'attached' });
    assert.ok(difference(old, await seen(page)) > 30);

    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
    assert.equal(download.suggestedFilename(), 'vitrine-tetrahedron.png');
    assert.ok(PNG.sync.read(readFileSync(await download.path())).width >= 424);
  });

  test('saving says how far it is', async (t) => {
    const page = await open(t, quick);
    await page.evaluate(() => document.querySelector('vitrine-viewer').setAttribute('samples', '6'));
    const values = await page.evaluate(() => {
      const values = [], progress = document.querySelector('#progress');
      new MutationObserver(() => values.push([progress.ariaLabel, progress.value, progress.matches('.done')])).observe(progress, { attributes: true });
      return (window.progressValues = values);
    });
    assert.deepEqual(values, []);
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
    assert.equal(download.suggestedFilename(), 'vitrine-knot.png');
    await page.waitForFunction(() => document.querySelector('#note').textContent === 'Saved vitrine-knot.png');
    const shown = await page.evaluate(() => window.progressValues);
    assert.ok(shown.some(([name, value, isDone]) => name === 'Saving' && value < 1 && !isDone), JSON.stringify(shown));
    assert.ok(shown.some(([name, value]) => name === 'Saving' && value === 1), JSON.stringify(shown));
    assert.deepEqual(shown.at(-1).filter((value) => typeof value !== 'number'), ['Loading', true]);
    assert.ok(await page.isEnabled('#save'));
  });

  test('a click traces its path', async (t) => {
    const page = await open(t, `${quick}&model=sphere`);
    const isStub = await page.evaluate(() => {
      const viewer = document.querySelector('vitrine-viewer');
      if (viewer.pathAt) return false;
      viewer.pathAt = (x, y) => ({
        points: [[0, 0, 1], [0, 0.1, -1], [0, 0.2, -2]],
        events: [{ kind: 'refraction', in: 30, out: 19.47 }, { kind: 'refraction', in: 19.47, out: 30 }],
        screen: [[x, y], [x + 60, y + 30], [x + 90, y + 80]],
      });
      return true;
    });
    if (isStub) t.diagnostic('the element has no pathAt yet: a stub');
    await page.mouse.click(190, 160);
    const events = page.locator('#path-list li');
    assert.equal(await events.count(), 2, 'in and out of a sphere');
    for (const text of await events.allTextContents()) assert.match(text, /^Refraction[\d.]+° → [\d.]+°$/);
    const dots = await page.locator('#path circle').evaluateAll((nodes) => nodes.map((node) => {
      const { x, y, width, height } = node.getBoundingClientRect();
      return [x + width / 2, y + height / 2];
    }));
    assert.equal(dots.length, 2);
    assert.ok(Math.hypot(dots[0][0] - 190, dots[0][1] - 160) < 2, `the first event is where the click was: ${dots[0]}`);
    await page.locator('#path-list').scrollIntoViewIfNeeded();
    await page.screenshot({ path: join(screenshots, 'demo-path.png') });
    await page.getByRole('button', { name: 'Torus' }).click();
    assert.equal(await events.count(), 0, 'another model, no path');
  });

  test('fits a telephone', async (t) => {
    const page = await open(t, quick, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
    await page.screenshot({ path: join(screenshots, 'demo-narrow.png') });
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390, 'no horizontal scrolling');
    for (const id of ['ior', 'technique', 'compare', 'layers', 'environment', 'reset', 'save', 'link']) {
      await page.locator(`#${id}`).scrollIntoViewIfNeeded();
      const { x, width } = await page.locator(`#${id}`).boundingBox();
      assert.ok(x >= 0 && x + width <= 390 && width > 0, id);
    }
    const more = page.getByRole('button', { name: 'More shapes' }), back = page.getByRole('button', { name: 'Shapes before these' });
    assert.ok(await more.isVisible() && await back.isHidden(), 'there are more shapes on one side');
    while (await more.isVisible()) {
      const isThere = page.evaluate(() => new Promise((done) => document.querySelector('#gallery').addEventListener('scrollend', () => requestAnimationFrame(done), { once: true })));
      await more.click();
      await isThere;
    }
    assert.ok(await back.isVisible());
    const last = await page.locator('#gallery .shape').last().boundingBox();
    assert.ok(last.x >= 0 && last.x + last.width <= 390, 'the last shape is reached');
    await page.click('#fold');
    await settle(page);
    await page.screenshot({ path: join(screenshots, 'demo-narrow-folded.png') });
    assert.equal(await page.getAttribute('#fold', 'aria-expanded'), 'false');
    const stage = await page.locator('#stage').boundingBox();
    assert.ok(stage.height > 560, `the glass has ${stage.height} pixels`);
  });

  test('has no serious fault of accessibility', async (t) => {
    const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
    for (const [colorScheme, viewport, shown] of [['dark', small, ''], ['light', small, '&model=relief'], ['light', { width: 390, height: 844 }, '']]) {
      const page = await open(t, `${quick}&compare=single&environment=studio${shown}`, { colorScheme, viewport });
      const found = await page.evaluate(`(async () => { ${axe}; return (await window.axe.run()).violations; })()`);
      const grave = found.filter(({ impact }) => ['serious', 'critical'].includes(impact));
      assert.deepEqual(grave.map(({ id, nodes }) => [id, ...nodes.map(({ html, failureSummary }) => `${html} ${failureSummary}`)]), []);
    }
  });
});
