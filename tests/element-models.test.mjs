// Files in <vitrine-viewer>: packed, in several files, with pictures of every kind, with variants; in headless Chromium on
// llvmpipe, on a page whose policy forbids all that it can. Needs what element.test.mjs needs; skips itself likewise.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, beforeEach, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { answerWithFile, chromiumPath, launch, listen, openPage, quiet, skipWithout } from './browser-tools.mjs';
import { ball, box, colored, edited, matt, model, quad, solid, thin, unlit } from './case-models.mjs';
import * as bombs from './bombs.mjs';
import { apart, packDraco, packMeshopt, packPicture, withPicture, within } from './packed-models.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const site = resolve(process.env.VITRINE_WEB ?? join(here, '../build/web'));
const binary = resolve(process.env.VITRINE_BINARY ?? join(here, '../build/release/vitrine'));
const screenshots = join(here, '../build/screenshots');

const modules = await Promise.all(['playwright-core', 'pngjs', 'draco3dgltf', 'meshoptimizer', 'ktx2-encoder'].map((name) => import(name))).catch(() => null);
const skip = skipWithout(
  [modules, "node modules (run 'npm ci' in tests/)"],
  [['draco', 'meshopt', 'basis', 'unpack'].every((name) => existsSync(join(site, `element/${name}.js`))), `${site}/element`],
  [existsSync(binary), binary],
  [existsSync(chromiumPath), chromiumPath],
);
const [, { PNG }] = modules ?? [{}, {}];

const side = 128;
const csp = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; connect-src 'self' blob:; img-src 'self'; require-trusted-types-for 'script'; trusted-types 'none'";

/** Red above left, blue above right, green below left, below right yellow, half of which is covered. */
function fourColors() {
  const png = new PNG({ width: 8, height: 8 });
  const colors = [[220, 30, 30, 255], [30, 60, 220, 255], [20, 160, 60, 255], [240, 240, 60, 128]];
  for (let i = 0; i < 64; ++i) png.data.set(colors[(i % 8 >> 2) + 2 * (i >> 5)], 4 * i);
  return png;
}

/** The same, without loss, by avifenc. */
const fourColorsAvif = Buffer.from('AAAAIGZ0eXBhdmlmAAAAAGF2aWZtaWYxbWlhZk1BMUEAAAGNbWV0YQAAAAAAAAAoaGRscgAAAAAAAAAAcGljdAAAAAAAAAAAAAAAAGxpYmF2aWYAAAAADnBpdG0AAAAAAAEAAAAsaWxvYwAAAABEAAACAAEAAAABAAABzAAAAD0AAgAAAAEAAAG1AAAAFwAAAEJpaW5mAAAAAAACAAAAGmluZmUCAAAAAAEAAGF2MDFDb2xvcgAAAAAaaW5mZQIAAAAAAgAAYXYwMUFscGhhAAAAABppcmVmAAAAAAAAAA5hdXhsAAIAAQABAAAAw2lwcnAAAACdaXBjbwAAABRpc3BlAAAAAAAAAAgAAAAIAAAAEHBpeGkAAAAAAwgICAAAAAxhdjFDgSAAAAAAABNjb2xybmNseAABAA0AAIAAAAAOcGl4aQAAAAABCAAAAAxhdjFDgQAcAAAAADhhdXhDAAAAAHVybjptcGVnOm1wZWdCOmNpY3A6c3lzdGVtczphdXhpbGlhcnk6YWxwaGEAAAAAHmlwbWEAAAAAAAAAAgABBAECgwQAAgQBBYYHAAAAXG1kYXQSAAoFGAi/YVAyDBAAABjeopU/voSlKBIACgg4CL9hAQ0AIDIvEAAAAA/6Pu9Ca4lsWefTvVEuiyu4MfzaI8MbGX9Bi6Z1QA+G8EF4A+nS46AKF7I=', 'base64');

/** Glass before a wall with a picture, and a box of many colours. */
const still = () => model([
  { mesh: ball(0.5, 12), material: solid([0.7, 0.9, 0.8]), translation: [-0.3, 0, 0.6] },
  { mesh: quad(2.4, 2), material: matt([1, 1, 1], { alphaMode: 'BLEND', pbr: { baseColorTexture: { index: 0 } } }), translation: [0, 0, -0.6] },
  { mesh: colored(box(0.4, 0.4, 0.4), 1, 0.4, 0.2, 1), material: matt([1, 1, 1]), translation: [0.6, 0.4, 0.4], rotation: [0.2, 0.3, 0, 0.933] },
], { pictures: [PNG.sync.write(fourColors())] });

/** A pane, thin or not, and two variants of it. */
const varied = () => model([
  { mesh: box(1.2, 1.2, 0.4), material: unlit([0.8, 0.1, 0.1]), variantsOf: [{ material: unlit([0.1, 0.7, 0.1]), variants: [0] }, { material: unlit([0.1, 0.1, 0.9]), variants: [1] }] },
  { mesh: quad(0.1), material: thin(), translation: [0, 1.5, 0] }, // a file without glass is made all glass
], { variants: ['Green', 'Blue'] });

/** Glass that goes along x from 0 to 0.6 in two seconds, and one that grows by the second animation, which lasts one. */
const moving = () => edited(model([
  { mesh: ball(0.5, 12), material: solid([0.7, 0.9, 0.8]) },
  { mesh: ball(0.3, 8), material: solid([1, 0.8, 0.6]), translation: [-0.8, 0.6, 0] },
]), (json) => {
  const numbers = new Float32Array([0, 2, 0, 0, 0, 0.6, 0, 0, 0, 1, 1, 1, 1, 0.4, 1.5, 0.4]);
  const add = (byteOffset, count, type) => {
    const bufferView = json.bufferViews.push({ buffer: json.buffers.length, byteOffset, byteLength: 4 * count * (type === 'VEC3' ? 3 : 1) }) - 1;
    return json.accessors.push({ bufferView, componentType: 5126, count, type }) - 1;
  };
  const animation = (name, node, path, input, output) => ({ name, samplers: [{ input, output }], channels: [{ sampler: 0, target: { node, path } }] });
  json.animations = [animation('slide', 0, 'translation', add(0, 2, 'SCALAR'), add(8, 2, 'VEC3')), animation('grow', 1, 'scale', add(32, 2, 'SCALAR'), add(40, 2, 'VEC3'))];
  json.buffers.push({ byteLength: numbers.byteLength, uri: `data:application/octet-stream;base64,${Buffer.from(numbers.buffer).toString('base64')}` });
});

function difference(a, b) {
  assert.deepEqual([a.width, a.height], [b.width, b.height]);
  let sum = 0, worst = 0;
  for (let i = 0; i < a.data.length; ++i) {
    sum += Math.abs(a.data[i] - b.data[i]);
    worst = Math.max(worst, Math.abs(a.data[i] - b.data[i]));
  }
  return { mean: sum / a.data.length, worst };
}

describe('files in the element', { skip }, () => {
  const files = {}, requests = [], missing = new Set(), delays = {};
  let server, browser, page, folder, plain, complaints;

  before(async () => {
    mkdirSync(screenshots, { recursive: true });
    folder = mkdtempSync(join(tmpdir(), 'vitrine-models-'));
    plain = still();
    server = await listen(async (request, response) => {
      const pathname = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
      requests.push(pathname);
      await new Promise((done) => setTimeout(done, delays[pathname] ?? 0));
      const send = (body, type) => response.writeHead(200, { 'content-type': type, 'content-security-policy': csp }).end(body);
      if (pathname === '/page.html') {
        send('<!doctype html><html lang="en"><title>Files</title><link rel="stylesheet" href="/test.css"><link rel="icon" href="/icon.png">'
          + '<script type="module" src="/element/vitrine-viewer.js"></script><vitrine-viewer tone-mapping="none" id="a" samples="1" skybox-image camera-orbit="0deg 90deg 4m" camera-target="0m 0m 0m" field-of-view="40deg"></vitrine-viewer>', 'text/html');
      } else if (pathname === '/test.css') send(`vitrine-viewer { width: ${side}px; height: ${side}px }`, 'text/css');
      else if (pathname === '/icon.png') send(PNG.sync.write(fourColors()), 'image/png');
      else if (missing.has(pathname)) response.writeHead(404).end();
      else if (files[pathname.slice(1)]) send(files[pathname.slice(1)], 'application/octet-stream');
      else answerWithFile(site, pathname, response);
    });
    browser = await launch();
  });
  after(async () => {
    await browser?.close();
    server?.close();
    if (folder) rmSync(folder, { recursive: true, force: true });
  });
  beforeEach(async () => {
    missing.clear();
    await openAnew();
  });

  async function openAnew() {
    await page?.close(); // what it still loads ends with it, and tells that to nobody
    page = await openPage(browser, { viewport: { width: 300, height: 300 } });
    complaints = [];
    const ofThisPage = complaints;
    page.on('pageerror', (error) => ofThisPage.push(String(error)));
    page.on('console', (message) => {
      if (['error', 'warning'].includes(message.type()) && !/GPU stall|fallback to software|404/.test(message.text())) ofThisPage.push(message.text());
    });
    await page.addInitScript(() => {
      window.failures = [];
      document.addEventListener('error', (event) => event.target.localName === 'vitrine-viewer' && window.failures.push(event.detail.sourceError.message), true);
      document.addEventListener('securitypolicyviolation', (event) => window.failures.push(event.violatedDirective));
    });
    await page.goto(`${server.address}/page.html`);
    requests.length = 0;
  }

  const said = () => page.evaluate(() => a.shadowRoot.querySelector('[part=message]').textContent);

  /** What the element shows. @param {Record<string, unknown>} changes of its properties */
  async function shown(changes) {
    await page.evaluate((values) => {
      window.failures.length = 0;
      Object.assign(a, values);
    }, changes);
    await page.waitForFunction(() => a.loaded || window.failures.length > 0);
    assert.deepEqual(await page.evaluate(() => window.failures), []);
    await quiet(page);
    const url = await page.evaluate(() => a.toDataURL());
    assert.deepEqual(complaints.splice(0), []);
    return PNG.sync.read(Buffer.from(url.split(',')[1], 'base64'));
  }

  /** What the element shows of a file, by its name. */
  function show(name, file, more = {}) {
    if (file) files[name] = file;
    return shown({ src: `/${name}`, walls: 'auto', variantName: '', ...more });
  }

  /** The sentence with which a file is refused. */
  async function refusal(name, file) {
    if (file) files[name] = file;
    await page.evaluate((src) => {
      window.failures.length = 0;
      a.src = src;
    }, `/${name}`);
    await page.waitForFunction(() => window.failures.length > 0);
    assert.deepEqual(complaints.splice(0), []);
    return page.evaluate(() => window.failures.join('; '));
  }

  function native(name, file, ...args) {
    if (file) writeFileSync(join(folder, name), file);
    const result = spawnSync(binary, ['render', name, '-e', 'studio', '--camera', '0,0,4', '--target', '0,0,0', '--fov', '40', '--resolution', `${side},${side}`, '-o', 'native.png', ...args], { cwd: folder });
    assert.equal(result.status, 0, result.stderr.toString());
    return PNG.sync.read(readFileSync(join(folder, 'native.png')));
  }

  function same(t, name, seen, expected, mostMean) {
    const { mean, worst } = difference(seen, expected);
    t.diagnostic(`${name}: ${mean.toFixed(4)} in the mean, ${worst} at most`);
    assert.ok(mean <= mostMean, `${name}: ${mean} in the mean, ${worst} at most`);
  }

  const decoders = () => requests.filter((name) => /(unpack|draco|meshopt|basis|exr)\.(js|wasm)$/.test(name)).sort();

  test('what no file needs is not loaded', async (t) => {
    const seen = await show('plain.glb', plain);
    writeFileSync(join(screenshots, 'element-models.png'), PNG.sync.write(seen));
    same(t, 'as the native program', seen, native('plain.glb', plain), 0.3);
    assert.deepEqual(decoders(), []);
  });

  test('geometry packed by Draco', async (t) => {
    const expected = await show('plain.glb', plain);
    const exact = await packDraco(plain);
    const seen = await show('draco.glb', exact);
    same(t, 'as unpacked', seen, expected, 0.1);
    assert.deepEqual(decoders(), ['/element/draco.js', '/element/draco.wasm', '/element/unpack.js']);
    same(t, 'as the native program', seen, native('draco.glb', exact), 0.3);
    same(t, 'of 14 bits', await show('draco14.glb', await packDraco(plain, { bits: 14 })), expected, 0.3);
    same(t, 'as .gltf', await show('draco.gltf', within(exact)), expected, 0.1);
    const told = await packDraco(plain, { bits: 14, inOrder: true, metadata: true });
    same(t, 'in order, with metadata', await show('metadata.glb', told), native('metadata.glb', told), 0.3);
    Object.assign(files, apart(exact, 'draco apart'));
    same(t, 'in several files', await show('draco apart.gltf'), expected, 0.1);
  });

  test('buffer views packed by meshoptimizer', async (t) => {
    const expected = await show('plain.glb', plain);
    const packed = await packMeshopt(plain);
    const seen = await show('meshopt.glb', packed);
    same(t, 'as unpacked', seen, expected, 0.1);
    assert.deepEqual(decoders(), ['/element/meshopt.js', '/element/unpack.js']);
    same(t, 'as the native program', seen, native('meshopt.glb', packed), 0.3);
    same(t, 'the newer coding', await show('meshopt1.glb', await packMeshopt(plain, 'KHR_meshopt_compression')), expected, 0.1);
    Object.assign(files, apart(packed, 'meshopt'));
    same(t, 'in several files', await show('meshopt.gltf'), expected, 0.1);
  });

  test('pictures of Basis Universal and AVIF', async (t) => {
    const expected = await show('plain.glb', plain);
    for (const [name, isUastc, mostMean] of [['uastc', true, 0.3], ['etc1s', false, 1.5]]) {
      const picture = await packPicture(fourColors(), isUastc);
      same(t, name, await show(`${name}.glb`, withPicture(plain, picture, 'KHR_texture_basisu', 'image/ktx2')), expected, mostMean);
    }
    assert.deepEqual(decoders(), ['/element/basis.js', '/element/basis.wasm']);
    const both = withPicture(await packMeshopt(plain), await packPicture(fourColors(), true), 'KHR_texture_basisu', 'image/ktx2');
    same(t, 'with packed geometry', await show('both.glb', both), expected, 0.3);
    same(t, 'AVIF', await show('avif.glb', withPicture(plain, fourColorsAvif, 'EXT_texture_avif', 'image/avif')), expected, 0.1);
    const { data } = await page.evaluate(async (bytes) => {
      const { ktxToPicture } = await import('/element/basis.js');
      const picture = await ktxToPicture(new Uint8Array(bytes));
      return { data: [...picture.data.subarray(0, 4), ...picture.data.subarray(-4)] };
    }, [...await packPicture(fourColors(), true)]);
    for (const [i, value] of [220, 30, 30, 255, 240, 240, 60, 128].entries()) assert.ok(Math.abs(data[i] - value) <= 2, `${data}`);
    const damagedPicture = (await packPicture(fourColors(), true)).fill(9, 80);
    assert.match(await refusal('damaged.glb', withPicture(plain, damagedPicture, 'KHR_texture_basisu', 'image/ktx2')), /damaged\.glb: image 0 is no picture that this browser can decode; white is shown in its place/);
  });

  test('natively a sentence tells of pictures that only browsers decode', async () => {
    for (const [extension, picture] of [['KHR_texture_basisu', await packPicture(fourColors(), true)], ['EXT_texture_avif', fourColorsAvif]]) {
      writeFileSync(join(folder, 'only.glb'), withPicture(plain, picture, extension, 'image/x'));
      const { status, stderr } = spawnSync(binary, ['render', 'only.glb', '-o', 'x.png'], { cwd: folder });
      assert.equal(status, 1);
      assert.match(stderr.toString(), new RegExp(`texture 0 has no PNG, JPEG or WebP picture but one of ${extension}; export it`));
    }
  });

  test('models in several files', async (t) => {
    const expected = await show('plain.glb', plain);
    Object.assign(files, apart(plain, 'apart'));
    same(t, 'as one file', await show('apart.gltf'), expected, 0);
    assert.deepEqual(decoders(), ['/element/unpack.js']);
    assert.deepEqual(requests.filter((name) => name.startsWith('/apart')).sort(), ['/apart pictures/0.png', '/apart.bin', '/apart.gltf']);
    same(t, 'with all in it', await show('within.gltf', within(plain)), expected, 0);

    const changed = (change) => {
      const json = JSON.parse(files['apart.gltf']);
      change(json);
      return Buffer.from(JSON.stringify(json));
    };
    for (const [i, uri] of ['../apart.bin', '/apart.bin', 'http://example.invalid/apart.bin', '..%2fapart.bin', '%2e%2e/apart.bin'].entries()) {
      const sentence = await refusal(`sub/outside${i}.gltf`, changed(({ buffers }) => (buffers[0].uri = uri)));
      assert.equal(sentence, `model 'outside${i}.gltf': its buffer '${uri}' cannot be read: it lies outside the model's folder; put the buffer beside the model`);
    }
    assert.match(await refusal('lost.gltf', changed(({ buffers }) => (buffers[0].uri = 'lost.bin'))), /^model 'lost\.gltf': its buffer 'lost\.bin' cannot be read: lost\.bin: the server answered 404/);
    assert.match(await refusal('short.gltf', changed(({ bufferViews }) => (bufferViews[0].byteLength = 1e6))), /reads beyond the end of buffer 0; the file is damaged/);
    const dropped = await page.evaluate(async () => {
      window.failures.length = 0;
      a.src = URL.createObjectURL(await (await fetch('/apart.gltf')).blob());
      while (window.failures.length === 0) await new Promise((done) => setTimeout(done, 20));
      return window.failures[0];
    });
    assert.match(dropped, /its buffer 'apart\.bin' cannot be read: this model has no folder; export it as one \.glb/);
    same(t, 'a picture that nothing shows', await show('unused.gltf', changed(({ images }) => images.push({ uri: 'nowhere.png' }))), expected, 0);
  });

  test('what cannot be unpacked is told', async () => {
    const draco = await packDraco(plain), meshopt = await packMeshopt(plain);
    assert.match(await refusal('cut.glb', edited(draco, ({ bufferViews }) => (bufferViews[0].byteLength = 40))), /^model 'cut\.glb': a packed primitive cannot be unpacked \(.+\); the file is damaged, export it again$/);
    assert.match(await refusal('id.glb', edited(draco, ({ meshes }) => (meshes[0].primitives[0].extensions.KHR_draco_mesh_compression.attributes.NORMAL = 77))), /it has no NORMAL as its accessor says/);
    assert.match(await refusal('type.glb', edited(draco, ({ meshes, accessors }) => (accessors[meshes[0].primitives[0].attributes.NORMAL].type = 'VEC2'))), /it has no NORMAL as its accessor says/);
    const lies = { faces: 1, vertices: 3 };
    assert.match(await refusal('bomb.glb', bombs.draco(4.9e7, 8e6, { symbols: 4.9e7, traversal: 2 })), /its data take more than 2147483648 bytes; simplify it/);
    for (const [i, bomb] of [bombs.draco(1.6e7, 8e6), bombs.draco(4.9e7, 8e6, { traversal: 2, told: lies }), bombs.draco(1, 4e8, { method: 0, told: lies })].entries()) {
      assert.match(await refusal(`lie ${i}.glb`, bomb), /cannot be unpacked \(it declares \d+ triangles and \d+ vertices, which neither its \d+ bytes nor its accessors have\)/);
    }
    assert.match(await refusal('old.glb', bombs.draco(9, 9, { version: [1, 248], told: lies })), /cannot be unpacked \(it has version 1\.248 of Draco's bitstream, but glTF has 2\.2\)/);
    const how = (change) => edited(meshopt, ({ bufferViews }) => change(bufferViews[0].extensions.EXT_meshopt_compression));
    assert.match(await refusal('mode.glb', how((one) => (one.mode = 'WORDS'))), /^model 'mode\.glb': buffer view 0 cannot be unpacked \(mode WORDS, filter NONE, \d+ elements of 12 bytes\); the file is damaged/);
    assert.match(await refusal('stride.glb', how((one) => (one.byteStride = 260))), /elements of 260 bytes/);
    const ofIndices = edited(meshopt, ({ bufferViews }) => {
      for (const { extensions } of bufferViews) if (extensions?.EXT_meshopt_compression.mode === 'TRIANGLES') extensions.EXT_meshopt_compression.filter = 'EXPONENTIAL';
    });
    assert.match(await refusal('filter.glb', ofIndices), /\(mode TRIANGLES, filter EXPONENTIAL, \d+ elements of \d bytes\)/);
    assert.match(await refusal('count.glb', how((one) => (one.count = 1e9))), /its data take more than 2147483648 bytes; simplify it/);
    assert.match(await refusal('short.glb', how((one) => (one.byteLength = 20))), /buffer view 0 cannot be unpacked/);
    assert.match(await refusal('beyond.glb', how((one) => (one.byteOffset = 1e6))), /reads beyond the end of buffer 0/);
    assert.match(await refusal('list.glb', edited(meshopt, (json_) => (json_.meshes = {}))), /^model 'list\.glb': its JSON is not glTF/);
    await show('meshopt.glb', meshopt);
    await show('draco.glb', draco);
  });

  test('a decoder that is not served is told', async (t) => {
    const draco = await packDraco(plain);
    files['draco.glb'] = draco;
    const other = await openPage(browser, { viewport: { width: 300, height: 300 } });
    t.after(() => other.context().close());
    for (const [file, sentence] of [
      ['/element/unpack.js', /^draco\.glb: it is packed, or in several files, and element\/unpack\.js cannot be loaded \(.+\); serve it with the element$/],
      ['/element/draco.js', /^model 'draco\.glb': it is packed, and element\/draco\.js cannot be loaded \(.+\); serve it with the element$/],
      ['/element/draco.wasm', /^model 'draco\.glb': it is packed, and element\/draco\.js cannot be loaded \(the server answered 404 to draco\.wasm\); serve it with the element$/],
    ]) {
      missing.clear();
      missing.add(file);
      await other.goto(`${server.address}/page.html`);
      const said_ = await other.evaluate(() => new Promise((done) => {
        a.addEventListener('error', ({ detail }) => done(detail.sourceError.message));
        a.src = '/draco.glb';
      }));
      assert.match(said_, sentence);
    }
  });

  test('variants of materials', async () => {
    const middle = ({ data, width, height }) => [...data.subarray(4 * ((height >> 1) * width + (width >> 1))).subarray(0, 3)];
    const most = (image) => ['red', 'green', 'blue'][middle(image).indexOf(Math.max(...middle(image)))];
    assert.equal(most(await show('varied.glb', varied())), 'red');
    assert.deepEqual(await page.evaluate(() => a.availableVariants), ['Green', 'Blue']);
    requests.length = 0;
    assert.equal(most(await shown({ variantName: 'Blue' })), 'blue');
    assert.equal(most(await shown({ variantName: 'Green' })), 'green');
    assert.equal(most(await shown({ variantName: '' })), 'red');
    assert.deepEqual(requests, [], 'nothing is fetched again');
    await page.evaluate(() => (a.variantName = 'Pink'));
    await page.waitForFunction(() => /variant-name/.test(a.shadowRoot.querySelector('[part=message]').textContent));
    assert.equal(await said(), "variant-name is 'Pink'; the files have 'Green', 'Blue'");
    await show('plain.glb', plain);
    assert.equal(await said(), '');
    assert.deepEqual(await page.evaluate(() => a.availableVariants), []);
  });

  test('walls of glass as the page says', async (t) => {
    const file = model([{ mesh: box(1.2, 1.2, 0.8), material: thin([0.5, 0.9, 0.6]), rotation: [0.2, 0.3, 0, 0.933] }, { mesh: quad(3, 3), material: matt([0.8, 0.7, 0.6]), translation: [0, 0, -1] }]);
    const pictures = {};
    for (const walls of ['auto', 'thin', 'solid']) {
      pictures[walls] = await show('walls.glb', file, { walls });
      same(t, walls, pictures[walls], native('walls.glb', file, '--walls', walls), 0.3);
    }
    assert.ok(difference(pictures.thin, pictures.solid).mean > 1);
    await page.evaluate(() => a.setAttribute('walls', 'thick'));
    await quiet(page);
    assert.match(await said(), /walls is 'thick'; it must be one of auto, thin, solid/);
    await page.evaluate(() => a.removeAttribute('walls'));
  });

  test('what is left out is in the statistics, too', async () => {
    await show('noted.glb', edited(plain, (json) => (json.extensionsUsed = [...(json.extensionsUsed ?? []), 'ACME_motion'])));
    const [warnings, statistics] = await page.evaluate(async () => [a.warnings, await customElements.get('vitrine-viewer').statistics()]);
    assert.deepEqual(warnings, ["'noted.glb': ignored: extension ACME_motion"]);
    assert.deepEqual(statistics.warnings, warnings);
  });

  const isPast = (seconds) => page.waitForFunction((least) => a.currentTime > least, seconds);
  const picture = async () => PNG.sync.read(Buffer.from((await page.evaluate(() => a.toDataURL())).split(',')[1], 'base64'));

  test('animations at a time, as the native program', async (t) => {
    await show('plain.glb', plain);
    assert.ok(!requests.some((name) => name.endsWith('animation.js')), 'not loaded for a file without');
    const file = moving();
    same(t, 'at rest', await show('moving.glb', file), native('moving.glb', file), 0.3);
    assert.deepEqual(requests.filter((name) => name.endsWith('animation.js')), ['/element/animation.js']);
    assert.deepEqual(await page.evaluate(() => [a.warnings, a.availableAnimations, a.duration, a.paused, a.currentTime]), [[], ['slide', 'grow'], 2, true, 0]);
    await page.evaluate(() => (a.currentTime = 1.5));
    await quiet(page);
    same(t, 'the first', await picture(), native('moving.glb', null, '--time', '1.5'), 0.3);
    await page.evaluate(() => (a.animationName = 'grow'));
    await page.waitForFunction(() => a.duration === 1);
    await page.evaluate(() => (a.currentTime = 9));
    await quiet(page);
    assert.equal(await page.evaluate(() => a.currentTime), 1);
    same(t, 'the second', await picture(), native('moving.glb', null, '--time', '1', '--animation', 'grow'), 0.3);
    await page.evaluate(() => (a.animationName = 'fly'));
    await page.waitForFunction(() => a.shadowRoot.querySelector('[part=message]').textContent !== '');
    assert.match(await said(), /^animation-name is 'fly'; the files have 'slide', 'grow'$/);
    await assert.rejects(page.evaluate(() => (a.currentTime = NaN)), /currentTime is NaN; it must be a number of seconds/);
    await page.evaluate(() => (a.animationName = ''));
    await quiet(page);
    same(t, 'another file', await show('plain.glb', plain), native('plain.glb', plain), 0.3);
    assert.deepEqual(await page.evaluate(() => a.availableAnimations), []);
    assert.deepEqual(complaints.splice(0), []);
  });

  test('the smaller core that comes between a file with animations and the larger core', async (t) => {
    Object.assign(delays, { '/vitrine-core.wasm': 500, '/vitrine-full.wasm': 1500 });
    t.after(() => Object.keys(delays).forEach((name) => delete delays[name]));
    await openAnew();
    await show('moving.glb', moving());
    assert.deepEqual(await page.evaluate(() => [a.availableAnimations, a.duration]), [['slide', 'grow'], 2]);
  });

  test('animations are played, in view only, and not where motion is unwelcome', async () => {
    await show('moving.glb', moving());
    await page.evaluate(() => {
      window.told = [];
      for (const type of ['play', 'pause', 'loop']) a.addEventListener(type, () => window.told.push(type));
      a.play();
    });
    await isPast(0.3);
    assert.equal(await page.evaluate(async () => {
      const { getError } = WebGL2RenderingContext.prototype;
      let waits = 0;
      WebGL2RenderingContext.prototype.getError = function () {
        ++waits;
        return getError.call(this);
      };
      for (let i = 0; i < 10; ++i) await new Promise((done) => a.addEventListener('frame', done, { once: true }));
      Object.assign(WebGL2RenderingContext.prototype, { getError });
      return waits;
    }), 0, 'a page that waits for the GPU in each frame');
    await page.waitForFunction(() => window.told.includes('loop'), null, { timeout: 60000 });
    const [paused, told] = await page.evaluate(() => [a.paused, (a.pause(), window.told)]);
    assert.deepEqual([paused, told[0], told.at(-1)], [false, 'play', 'pause']);
    await quiet(page);
    const before = await page.evaluate(() => a.currentTime);
    await quiet(page);
    assert.equal(await page.evaluate(() => a.currentTime), before);

    await page.emulateMedia({ reducedMotion: 'reduce' });
    await page.evaluate(() => (a.autoplay = true));
    await quiet(page);
    assert.equal(await page.evaluate(() => a.paused), true);
    await page.emulateMedia({ reducedMotion: 'no-preference' });
    await page.waitForFunction(() => !a.paused);
    await page.evaluate(() => Object.assign(document.body.style, { paddingTop: '5000px' }));
    await page.waitForTimeout(300); // the observer tells a frame later
    const hidden = await page.evaluate(() => a.currentTime);
    await page.waitForTimeout(300);
    assert.equal(await page.evaluate(() => a.currentTime), hidden);
    await page.evaluate(() => Object.assign(document.body.style, { paddingTop: '0' }));
    await page.waitForFunction((time) => a.currentTime !== time, hidden);
    await page.evaluate(() => (a.autoplay = false));
    await page.waitForFunction(() => a.paused);
    await quiet(page);
    assert.deepEqual(complaints.splice(0), []);
  });
});
