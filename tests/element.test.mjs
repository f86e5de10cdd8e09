// <vitrine-viewer> in headless Chromium on llvmpipe. Needs what browser.test.mjs needs; skips itself likewise.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { cube, glb, gltf, tetrahedron } from '../scripts/glb.mjs';
import { answerWithFile, chromiumPath, launch, listen, openPage, quiet, skipWithout } from './browser-tools.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const site = resolve(process.env.VITRINE_WEB ?? join(here, '../build/web'));
const binary = resolve(process.env.VITRINE_BINARY ?? join(here, '../build/release/vitrine'));
const axe = resolve(process.env.AXE ?? join(here, 'node_modules/axe-core/axe.min.js'));
const screenshots = join(here, '../build/screenshots');

const modules = await Promise.all(['playwright-core', 'pixelmatch', 'pngjs'].map((name) => import(name))).catch(() => null);
const skip = skipWithout(
  [modules, "node modules (run 'npm ci' in tests/)"],
  [existsSync(join(site, 'element/vitrine-viewer.js')), `${site}/element`],
  [existsSync(binary), binary],
  [existsSync(chromiumPath), chromiumPath],
);
const [, { default: pixelmatch }, { PNG }] = modules ?? [{}, {}, {}];

const side = 128; // of most pictures that are compared, pixels: a software GPU draws them

const ofSide = `<style>vitrine-viewer { width: ${side}px; height: ${side}px }</style>`;

const csp = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; connect-src 'self'; img-src 'self'; require-trusted-types-for 'script'; trusted-types 'none'";
const sheet = 'body { margin: 0; background: rgb(20, 90, 40); } vitrine-viewer { width: 160px; height: 160px; } .far { height: 3000px; }';

/** A tetrahedron with an index of refraction, followed by `padding` bytes that no accessor reads. */
function pyramid({ padding = 0 } = {}) {
  const { json, bin } = gltf({ ...tetrahedron, ior: 1.3 });
  json.buffers[0].byteLength += padding;
  return glb({ json, bin: Buffer.concat([bin, Buffer.alloc(padding)]) });
}

/** A cube of glass, one behind it that is opaque and wears a picture, and a camera that looks at them from the right. @param {Buffer} image a .png */
function textured(image) {
  const { json, bin } = gltf(cube);
  const texcoords = Buffer.from(new Float32Array(cube.positions.flatMap((_, i) => (i % 3 === 2 ? [] : [0.5]))).buffer);
  json.bufferViews.push({ buffer: 0, byteOffset: bin.length, byteLength: texcoords.length },
    { buffer: 0, byteOffset: bin.length + texcoords.length, byteLength: image.length });
  json.buffers[0].byteLength += texcoords.length + image.length;
  json.accessors.push({ bufferView: 2, componentType: 5126, count: texcoords.length / 8, type: 'VEC2' });
  Object.assign(json, {
    extensionsUsed: ['KHR_materials_transmission'],
    images: [{ bufferView: 3, mimeType: 'image/png' }],
    textures: [{ source: 0 }],
    materials: [{ pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 0 }, extensions: { KHR_materials_transmission: { transmissionFactor: 1 } } }, { pbrMetallicRoughness: { baseColorTexture: { index: 0 }, metallicFactor: 0 } }],
    cameras: [{ type: 'perspective', perspective: { yfov: 0.7, znear: 0.1 } }],
    nodes: [{ mesh: 0 }, { mesh: 1, translation: [0, 0, -3] }, { camera: 0, translation: [9, 0, 0], rotation: [0, Math.SQRT1_2, 0, Math.SQRT1_2] }],
    scenes: [{ nodes: [0, 1, 2] }],
  });
  const [{ attributes, indices }] = json.meshes[0].primitives;
  json.meshes[0].primitives[0].material = 0;
  json.meshes.push({ primitives: [{ attributes: { ...attributes, TEXCOORD_0: 2 }, indices, material: 1 }] });
  return glb({ json, bin: Buffer.concat([bin, texcoords, image]) });
}

/** A ring of so many times so many squares. */
function torus(around, across) {
  const positions = [], indices = [];
  for (let i = 0; i < around; ++i) {
    for (let k = 0; k < across; ++k) {
      const u = (2 * Math.PI * i) / around, v = (2 * Math.PI * k) / across, r = 1 + 0.4 * Math.cos(v);
      positions.push(r * Math.cos(u), r * Math.sin(u), 0.4 * Math.sin(v));
      const [a, b, c, d] = [[i, k], [i + 1, k], [i + 1, k + 1], [i, k + 1]].map(([m, n]) => (m % around) * across + (n % across));
      indices.push(a, b, c, a, c, d);
    }
  }
  return glb(gltf({ positions, indices }));
}

/** A .png of one colour. */
function plain(...color) {
  const png = new PNG({ width: 8, height: 8 });
  for (let i = 0; i < png.data.length; i += 4) png.data.set(color, i);
  return PNG.sync.write(png);
}

/** An environment of all colours and opacities. */
function panorama() {
  const png = new PNG({ width: 64, height: 32 });
  for (let i = 0; i < 64 * 32; ++i) png.data.set([4 * (i % 64), 8 * (i >> 6), (i * 37) % 256, (i * 5) % 256], 4 * i);
  return png;
}

/** Six faces of one colour each. */
function cross() {
  const png = new PNG({ width: 64, height: 48 });
  for (let i = 0; i < 64 * 48; ++i) {
    const face = [i % 64 >> 4, i >> 10];
    png.data.set(face.includes(1) ? [80 * face[0], 120 * face[1], 90, 255] : [0, 0, 0, 0], 4 * i);
  }
  return png;
}

/** As Radiance HDR: four pixels of RGBE, red, green, blue and bright. */
const radiance = Buffer.concat([Buffer.from('#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n'),
  Buffer.from([200, 20, 10, 128, 10, 180, 20, 128, 30, 10, 220, 128, 255, 255, 255, 131])]);

/** Hills that no symmetry makes easy, as a .png. */
function hills(width, height) {
  const png = new PNG({ width, height });
  for (let i = 0; i < width * height; ++i) {
    const x = (i % width) / width, y = Math.floor(i / width) / height;
    png.data.set([120 + 100 * Math.sin(9 * x + 2) * Math.cos(7 * y), 255 * y, 250 * x, 255], 4 * i);
  }
  return PNG.sync.write(png);
}

/** Heights as .pfm, which holds numbers as they are: grey, little endian, bottom row first. */
function slopes(width, height) {
  const numbers = Float32Array.from({ length: width * height }, (_, i) => Math.sin(0.3 * (i % width)) + 0.01 * Math.floor(i / width));
  return Buffer.concat([Buffer.from(`Pf\n${width} ${height}\n-1.0\n`), Buffer.from(numbers.buffer)]);
}

/** Pictures of heights that the server has, good and bad. */
const reliefs = PNG && new Map([
  ['/hills.png', hills(90, 60)],
  ['/slopes.pfm', slopes(40, 50)],
  ['/dot.png', hills(1, 1)],
  ['/wide.png', hills(4097, 2)],
  ['/broken.png', hills(90, 60).fill(7, 60)],
  ['/words.txt', Buffer.from('no picture')],
]);

/** The built site, test pages from memory, and a file of which the second half waits until its gate is opened. */
function startServer(requests, pages, gates) {
  return listen(async (request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    requests.push(pathname);
    const send = (body, type, more = {}) => response.writeHead(200, { 'content-type': type, 'content-length': body.length, ...more }).end(body);
    if (pages.has(pathname)) {
      send(Buffer.from(pages.get(pathname).html), 'text/html', pages.get(pathname).headers);
    } else if (pathname === '/test.css') {
      send(Buffer.from(sheet), 'text/css');
    } else if (pathname === '/good.glb') {
      send(pyramid(), 'model/gltf-binary');
    } else if (pathname === '/broken.glb') {
      send(pyramid().subarray(0, 100), 'model/gltf-binary');
    } else if (pathname === '/red.glb') {
      send(textured(plain(250, 10, 20, 255)), 'model/gltf-binary');
    } else if (pathname === '/noted.glb') {
      const { json, bin } = gltf(cube);
      send(glb({ json: { ...json, extensionsUsed: ['ACME_motion'] }, bin }), 'model/gltf-binary');
    } else if (pathname === '/unreadable.glb') {
      send(textured(plain(250, 10, 20, 255).fill(7, 16)), 'model/gltf-binary');
    } else if (pathname === '/slow.glb') {
      const bytes = pyramid({ padding: 400000 });
      response.writeHead(200, { 'content-type': 'model/gltf-binary', 'content-length': bytes.length });
      response.write(bytes.subarray(0, 200000));
      await new Promise((open) => gates.push(open));
      response.end(bytes.subarray(200000));
    } else if (pathname === '/panorama.png') {
      send(PNG.sync.write(panorama()), 'image/png');
    } else if (pathname === '/panorama.hdr') {
      send(radiance, 'image/vnd.radiance');
    } else if (pathname === '/panorama.exr') {
      send(readFileSync(join(here, 'cases/panorama.exr')), 'image/x-exr');
    } else if (pathname === '/cross.png') {
      send(PNG.sync.write(cross()), 'image/png');
    } else if (reliefs.has(pathname)) {
      send(reliefs.get(pathname), 'application/octet-stream');
    } else if (pathname === '/poster.png') {
      send(plain(250, 10, 200, 255), 'image/png');
    } else {
      answerWithFile(site, pathname, response);
    }
  });
}

/** In the page, before anything else: counts draws and contexts, and collects events. */
function instrument() {
  window.counts = { draws: 0, programs: 0, contexts: [] };
  const { drawArrays } = WebGL2RenderingContext.prototype;
  WebGL2RenderingContext.prototype.drawArrays = function (...values) {
    ++window.counts.draws;
    return drawArrays.apply(this, values);
  };
  const { linkProgram } = WebGL2RenderingContext.prototype;
  WebGL2RenderingContext.prototype.linkProgram = function (...values) {
    ++window.counts.programs;
    return linkProgram.apply(this, values);
  };
  const { getContext } = OffscreenCanvas.prototype;
  OffscreenCanvas.prototype.getContext = function (kind, ...rest) {
    const context = getContext.call(this, kind, ...rest);
    const known = window.counts.contexts.some((ref) => ref.deref() === context);
    if (kind === 'webgl2' && context && !known) window.counts.contexts.push(new WeakRef(context));
    return context;
  };
  window.liveContexts = () => window.counts.contexts.filter((ref) => ref.deref()?.isContextLost() === false).length;
  window.events = [];
  window.shown = 0;
  document.addEventListener('frame', () => ++window.shown, true);
  for (const type of ['load', 'progress', 'error', 'camera-change', 'render-scale']) {
    document.addEventListener(type, (event) => {
      if (event.target.localName !== 'vitrine-viewer') return;
      const { sourceError, ...detail } = event.detail;
      window.events.push({ event: type, id: event.target.id, ...detail, sentence: sourceError?.message, time: performance.now() });
    }, true);
  }
  document.addEventListener('securitypolicyviolation', (event) => (window.violations ??= []).push(event.violatedDirective));
}

/** Percentage of pixels that differ visibly. */
function difference(a, b) {
  assert.deepEqual([a.width, a.height], [b.width, b.height]);
  return (100 * pixelmatch(a.data, b.data, null, a.width, a.height, { threshold: 0.1 })) / (a.width * a.height);
}

/** Mean difference of a channel. */
function meanError(a, b) {
  assert.deepEqual([a.width, a.height], [b.width, b.height]);
  return a.data.reduce((sum, value, i) => sum + Math.abs(value - b.data[i]), 0) / a.data.length;
}

const pixel = ({ data, width }, x, y) => [...data.subarray(4 * (y * width + x), 4 * (y * width + x) + 3)];
/** For what must not happen in that time. */
const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

describe('the element', { skip }, () => {
  const requests = [], pages = new Map(), gates = [];
  let server, browser, folder;

  before(async () => {
    mkdirSync(screenshots, { recursive: true });
    folder = mkdtempSync(join(tmpdir(), 'vitrine-element-'));
    server = await startServer(requests, pages, gates);
    browser = await launch();
  });
  after(async () => {
    await browser?.close();
    server?.close();
    if (folder) rmSync(folder, { recursive: true, force: true });
  });

  /** A page with that body, whose viewers take one sample a pixel and follow at once unless they say otherwise. When the test is over its console must hold no error nor warning but those allowed. */
  async function open(t, body, { init, headers = {}, waits = true, allowed = /^$/, ...options } = {}) {
    const path = `/page${pages.size}.html`;
    const head = '<!doctype html><html lang="en"><title>Test</title><link rel="stylesheet" href="/test.css"><link rel="icon" href="/poster.png">';
    const quick = Object.entries({ samples: 1, 'interpolation-decay': 0 }).reduce((text, [name, value]) => text.replaceAll(new RegExp(`<vitrine-viewer(?![^>]*${name}=)`, 'g'), `<vitrine-viewer ${name}="${value}"`), body);
    pages.set(path, { html: `${head}<script type="module" src="/element/vitrine-viewer.js"></script>${quick}`, headers });
    const page = await openPage(browser, { viewport: { width: 360, height: 360 }, ...options });
    const complaints = [];
    page.on('pageerror', (error) => complaints.push(String(error)));
    page.on('console', (message) => {
      const isBad = ['error', 'warning'].includes(message.type()) && !/GPU stall|fallback to software/.test(message.text());
      if (isBad && !allowed.test(message.text())) complaints.push(message.text());
    });
    t.after(async () => {
      await page.context().close();
      assert.deepEqual(complaints, []);
    });
    await page.addInitScript(instrument);
    if (init) await page.addInitScript(init);
    await page.goto(`${server.address}${path}`);
    if (waits) {
      await page.waitForFunction(() => [...document.querySelectorAll('vitrine-viewer')].every((viewer) => viewer.loaded));
      await quiet(page);
    }
    return page;
  }

  /** The last request for /slow.glb gets the rest. */
  const openGate = () => gates.splice(0).at(-1)();
  const draws = (page) => page.evaluate(() => window.counts.draws);
  const events = (page, type) => page.evaluate((name) => window.events.filter(({ event }) => event === name), type);
  const message = (page, id = 'a') => page.evaluate((name) => {
    const part = document.getElementById(name).shadowRoot.querySelector('[part=message]');
    return part.hidden ? '' : part.textContent;
  }, id);
  const shot = async (page, id = 'a') => PNG.sync.read(await page.locator(`#${id}`).screenshot());

  async function picture(page, id = 'a') {
    const url = await page.evaluate((name) => document.getElementById(name).toDataURL(), id);
    return PNG.sync.read(Buffer.from(url.split(',')[1], 'base64'));
  }

  /** What the one element shows after changes of its properties. */
  async function shown(page, changes) {
    await page.evaluate((values) => Object.assign(a, values), changes);
    await page.waitForFunction(() => a.loaded);
    await quiet(page);
    assert.equal(await message(page), '');
    return picture(page);
  }

  function nativePicture(...args) {
    const result = spawnSync(binary, ['render', '--tone-mapping', 'neutral', ...args, '-o', 'native.png', '--resolution', `${side},${side}`],
      { cwd: folder, env: { ...process.env, ASAN_OPTIONS: 'detect_leaks=0' } });
    assert.equal(result.status, 0, result.stderr.toString());
    return PNG.sync.read(readFileSync(join(folder, 'native.png')));
  }

  test('draws what the native program draws', async (t) => {
    const page = await open(t, `<vitrine-viewer id="a" src="knot" skybox-image></vitrine-viewer>${ofSide}`);
    for (const technique of ['exact', 'layered', 'wyman', 'single']) {
      await page.evaluate((id) => (a.technique = id), technique);
      const expected = nativePicture('knot', '--technique', technique);
      await quiet(page);
      for (const [name, seen] of [['toBlob', await picture(page)], ['screen', await shot(page)]]) {
        const differing = difference(seen, expected);
        t.diagnostic(`${technique}, ${name}: ${differing.toFixed(4)} % differ`);
        assert.ok(differing < 0.5, `${technique}, ${name}: ${differing} % differ`);
      }
    }
    await page.evaluate(() => Object.assign(a, { technique: 'exact', src: 'goblet', environmentImage: 'checker', cameraOrbit: '0rad 90deg 6m', cameraTarget: '0m 0m 0m', exposure: 2, ior: 1.3 }));
    await page.waitForFunction(() => a.loaded);
    await quiet(page);
    const expected = nativePicture('goblet', '-e', 'checker', '--camera', '0,0,6', '--target', '0,0,0', '--exposure', '1', '--ior', '1.3');
    assert.ok(difference(await picture(page), expected) < 0.5, 'a view of its own');
  });

  test('takes pictures as environment, decoded by the browser to the file\'s own numbers', async (t) => {
    const page = await open(t, `<vitrine-viewer id="a" src="sphere" skybox-image></vitrine-viewer>${ofSide}`);
    const exr = readFileSync(join(here, 'cases/panorama.exr'));
    assert.equal(await page.evaluate(() => performance.getEntriesByName(new URL('/element/exr.js', location)).length), 0, 'loaded for OpenEXR only');
    await page.evaluate(() => import('/element/exr.js')); // quiet does not wait for import()
    for (const [name, bytes] of [['panorama.png', PNG.sync.write(panorama())], ['panorama.hdr', radiance], ['panorama.exr', exr], ['cross.png', PNG.sync.write(cross())]]) {
      writeFileSync(join(folder, name), bytes);
      await page.evaluate((url) => (a.environmentImage = url), `/${name}`);
      await quiet(page);
      const differing = difference(await picture(page), nativePicture('sphere', '-e', name));
      assert.ok(differing < 0.5, `${name}: ${differing} % differ`);
    }
    const bytes = await page.evaluate(async () => {
      const { decodePicture, openInCore } = await import('/element/picture.js');
      const contents = await decodePicture(new Uint8Array(await (await fetch('/panorama.png')).arrayBuffer()));
      const core = { HEAPU8: new Uint8Array(16 + 4 * 64 * 32), _malloc: () => 16 };
      const gl = document.createElement('canvas').getContext('webgl2');
      const call = openInCore(core, gl, 'OpenEnvironment', contents, (...values) => values.join());
      return [call, ...core.HEAPU8.subarray(16)];
    });
    assert.deepEqual(bytes, ['OpenPicture,16,64,32', ...panorama().data]);
  });

  test('a still view becomes clean, then nothing is drawn', async (t) => {
    const page = await open(t, `<vitrine-viewer id="a" src="sphere" layers="2" environment-image="checker" skybox-image camera-controls samples="24"></vitrine-viewer>${ofSide}`);
    const shown = () => page.evaluate(() => window.shown);
    assert.equal(await shown(), 24);
    const before = await draws(page);
    await pause(500);
    assert.equal(await draws(page), before, 'idle');
    const clean = await shot(page);
    assert.ok(difference(await picture(page), clean) < 0.01, 'the file is the picture on the screen');
    assert.equal(await draws(page), before + 1, 'and nothing else is drawn for it');
    const truth = nativePicture('sphere', '--layers', '2', '-e', 'checker', '--samples', '24');
    const error = meanError(clean, truth);

    await page.focus('#a');
    await page.evaluate(() => a.shadowRoot.querySelector('.view').focus());
    await page.keyboard.press('ArrowLeft');
    await quiet(page);
    assert.equal(await shown(), 48, 'turning starts anew');
    assert.ok(difference(clean, await shot(page)) > 5);
    await page.keyboard.press('Home');
    await page.evaluate(() => (a.samples = 1));
    await page.evaluate(() => document.activeElement.blur());
    await quiet(page);
    const stairs = meanError(await shot(page), truth);
    t.diagnostic(`mean error of 1 sample ${stairs.toFixed(2)}, of 24 ${error.toFixed(2)} of 255`);
    assert.ok(error < 0.2 * stairs);

    await page.evaluate(() => (a.samples = 4));
    await page.evaluate(() => a.removeAttribute('skybox-image'));
    await quiet(page);
    const { data } = await picture(page);
    const partly = data.filter((value, i) => i % 4 === 3 && value > 0 && value < 255).length;
    assert.ok(partly > 100, 'the edge is partly transparent');
    await page.locator('#a').screenshot({ path: join(screenshots, 'element-samples.png') });
  });

  test('shaders that plain glass does without are loaded once a picture needs them', async (t) => {
    const name = '/vitrine-shaders.txt';
    const count = () => requests.filter((path) => path === name).length;
    requests.length = 0;
    const page = await open(t, '<vitrine-viewer id="a" src="knot"></vitrine-viewer><vitrine-viewer id="b" src="sphere"></vitrine-viewer>');
    assert.equal(count(), 0);
    const exact = await shot(page);
    for (const technique of ['layered', 'wyman', 'kay-linear']) {
      await page.evaluate((id) => (a.technique = b.technique = id), technique);
      await quiet(page);
      assert.equal(count(), 1, technique);
      assert.ok(difference(exact, await shot(page)) > 1, technique);
    }
    for (const attributes of ['objects="knot; plane:checker"', 'src="red.glb"', 'relief="ripples"']) {
      requests.length = 0;
      await open(t, `<vitrine-viewer id="a" ${attributes}></vitrine-viewer>`);
      assert.equal(count(), 1, attributes);
    }
    requests.length = 0;
    const hidden = await open(t, '<vitrine-viewer id="a" src="knot"></vitrine-viewer>');
    const size = await hidden.evaluate(async () => {
      a.technique = 'layered';
      await null;
      return (await a.toBlob()).size;
    });
    assert.ok(size > 1000 && count() === 1, 'a picture waits for them');
  });

  test('shaders that are not there, or of another build, are told and asked for again', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="knot"></vitrine-viewer>', { allowed: /404/ });
    const exact = await shot(page);
    const answers = [{ status: 404 }, { status: 200, body: '<!doctype html>' }];
    const sentences = [/vitrine-shaders.txt cannot be loaded: the server answered 404; serve it beside vitrine-core.wasm/, /vitrine-shaders.txt is not of the same build as vitrine-core.wasm/];
    await page.route('**/vitrine-shaders.txt', (route) => (answers.length > 0 ? route.fulfill(answers.shift()) : route.continue()));
    for (const sentence of sentences) {
      await page.evaluate(() => (a.technique = 'layered'));
      await page.waitForFunction((source) => window.events.some((event) => event.event === 'error' && new RegExp(source).test(event.sentence)), sentence.source);
      await page.evaluate(() => (a.technique = 'exact'));
      await quiet(page);
      assert.equal(difference(exact, await shot(page)), 0);
    }
    await page.evaluate(() => (a.technique = 'layered'));
    await quiet(page);
    assert.ok(difference(exact, await shot(page)) > 1);
  });

  test('several on a page share one module and do not disturb each other', async (t) => {
    requests.length = 0;
    const page = await open(t, `<vitrine-viewer id="a" src="sphere" camera-controls></vitrine-viewer>
      <vitrine-viewer id="b" src="goblet" environment-image="sky" skybox-image></vitrine-viewer>`);
    assert.equal(requests.filter((path) => path.endsWith('.wasm')).length, 1);
    const [a, b] = [await shot(page), await shot(page, 'b')];
    await page.screenshot({ path: join(screenshots, 'element-two.png') });
    assert.ok(difference(a, b) > 20);
    await page.focus('#a');
    await page.evaluate(() => a.setAttribute('src', 'diamond'));
    await page.waitForFunction(() => a.loaded);
    await quiet(page);
    assert.ok(difference(a, await shot(page)) > 5, 'one changes');
    assert.equal(difference(b, await shot(page, 'b')), 0, 'the other stays');
    await page.evaluate(() => a.remove());
    await quiet(page);
    await page.evaluate(() => (b.src = 'bottle'));
    await page.waitForFunction(() => b.loaded);
    await quiet(page);
    assert.ok(difference(b, await shot(page, 'b')) > 2, 'and goes on alone');
  });

  test('shows the page behind the glass, or the environment', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="sphere"></vitrine-viewer>');
    const clear = await shot(page);
    await page.locator('#a').screenshot({ path: join(screenshots, 'element-transparent.png') });
    for (const [x, y] of [[2, 2], [157, 2], [2, 157], [157, 157]]) assert.deepEqual(pixel(clear, x, y), [20, 90, 40]);
    const glass = new Set();
    for (let x = 50; x < 110; ++x) glass.add(String(pixel(clear, x, 80)));
    assert.ok(!glass.has('20,90,40') && glass.size > 10, 'the glass shows the studio');
    await page.evaluate(() => a.setAttribute('skybox-image', 'checker'));
    await quiet(page);
    const full = await shot(page);
    assert.notDeepEqual(pixel(full, 2, 2), [20, 90, 40]);
    assert.ok(difference(clear, full) > 30);
  });

  test('without a model there is no picture, and with the next one there is', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="cube" technique="single"></vitrine-viewer>');
    const first = await shot(page);
    await page.evaluate(() => a.removeAttribute('src'));
    await quiet(page);
    assert.deepEqual(pixel(await shot(page), 80, 80), [20, 90, 40]);
    await page.evaluate(() => (a.src = 'cube'));
    await page.waitForFunction(() => a.loaded);
    await quiet(page);
    assert.equal(difference(first, await shot(page)), 0);
  });

  test('maps tones, and puts a background behind the scene', async (t) => {
    const page = await open(t, `<vitrine-viewer id="a" src="sphere" environment-image="sky" samples="4" background="environment"></vitrine-viewer>${ofSide}`, { allowed: /404/ });
    const native = (...args) => nativePicture('sphere', '-e', 'sky', '--samples', '4', ...args);
    const problem = async () => {
      await quiet(page);
      return message(page);
    };
    writeFileSync(join(folder, 'panorama.png'), PNG.sync.write(panorama()));
    for (const toneMapping of ['aces', 'agx', 'none', 'neutral']) {
      const seen = await shown(page, { toneMapping });
      const differing = difference(seen, native('--tone-mapping', toneMapping));
      assert.ok(differing < 0.5, `${toneMapping}: ${differing} % differ`);
      assert.ok(toneMapping === 'neutral' || meanError(seen, native()) > 1, toneMapping);
    }
    for (const background of ['#f0e8d8', 'blurred', 'blurred:20', '/panorama.png', 'transparent']) {
      const seen = await shown(page, { background });
      const differing = difference(seen, native('--background', background.replace('/', './')));
      t.diagnostic(`${background}: ${differing.toFixed(4)} % differ`);
      assert.ok(differing < 0.5, `${background}: ${differing} % differ`);
    }
    await page.locator('#a').screenshot({ path: join(screenshots, 'element-background.png') });
    // What cannot stand is said; the picture is as without it, or as before.
    await page.evaluate(() => (a.background = 'blured'));
    assert.match(await problem(), /^background is 'blured'; it must be environment, .* or a URL$/);
    await page.evaluate(() => (a.background = 'blurred:0'));
    assert.match(await problem(), /^background is 'blurred:0'; it must be .*\(1 to 90\)/);
    await shown(page, { background: '/panorama.png' });
    await page.evaluate(() => (a.background = '/nowhere.png'));
    assert.match(await problem(), /nowhere\.png: the server answered 404/);
    assert.ok(difference(await picture(page), native('--background', './panorama.png')) < 0.5, 'the one before stays');
    await page.evaluate(() => (a.background = '/good.glb'));
    assert.match(await problem(), /good\.glb: no picture that this browser can decode/);
  });

  test('a ground catches shadow and light, over the environment and over the page', async (t) => {
    const page = await open(t, `<vitrine-viewer id="a" src="sphere" skybox-image="sky" ground camera-orbit="0deg 60deg 6m" camera-target="0m 0m 0m"></vitrine-viewer>${ofSide}`);
    const lit = await picture(page);
    const view = ['sphere', '-e', 'sky', '--camera', '0,3,5.19615', '--target', '0,0,0'];
    const differing = difference(lit, nativePicture(...view, '--ground'));
    t.diagnostic(`${differing.toFixed(3)} % differ from the native program's`);
    assert.ok(differing < 1, `${differing} % differ`);
    const plain = await shown(page, { ground: false });
    assert.ok(difference(plain, nativePicture(...view)) < 0.5);
    const changed = lit.data.filter((value, at) => Math.abs(value - plain.data[at]) > 5).length;
    assert.ok(changed > 500, `${changed} numbers show the ground`);
    assert.ok(difference(await shown(page, { shadowIntensity: 1 }), lit) < 0.01, 'as model-viewer has it');
    await page.evaluate(async () => { // while things move there are fewer rays
      for (let i = 5; i >= 0; --i) {
        a.roughness = 0.1 * i;
        await new Promise(requestAnimationFrame);
        await new Promise(requestAnimationFrame);
      }
    });
    assert.ok(meanError(await shown(page, { roughness: null }), lit) < 0.001, 'at rest all of them');
    await page.evaluate(() => a.removeAttribute('skybox-image'));
    await quiet(page);
    const shadowed = await shot(page);
    await page.evaluate(() => (a.shadowIntensity = 0));
    await quiet(page);
    const clear = await shot(page);
    let darker = 0;
    for (let y = 80; y < 158; ++y) {
      for (let x = 2; x < 158; ++x) darker += pixel(clear, x, y)[1] === 90 && pixel(shadowed, x, y)[1] < 80;
    }
    assert.ok(darker > 100, `${darker} pixels of the page lie in shadow`);
  });

  test('a matt ground and a sun are those of the native program, and what they cannot be gives a sentence', async (t) => {
    const page = await open(t, `<vitrine-viewer id="a" src="sphere" skybox-image="studio" ground ground-color="0.5,0.4,0.3" sun="-1,1,-0.5,2,6,5,4" camera-orbit="0deg 60deg 6m" camera-target="0m 0m 0m"></vitrine-viewer>${ofSide}`);
    const lit = await picture(page);
    const view = ['sphere', '-e', 'studio', '--camera', '0,3,5.19615', '--target', '0,0,0', '--ground', '--ground-color', '0.5,0.4,0.3'];
    const differing = difference(lit, nativePicture(...view, '--sun', '-1,1,-0.5,2,6,5,4'));
    t.diagnostic(`${differing.toFixed(3)} % differ from the native program's`);
    assert.ok(differing < 1, `${differing} % differ`);
    const noSun = difference(await shown(page, { sun: null }), lit);
    assert.ok(noSun > 5, `${noSun} % differ without the sun`);
    assert.ok(difference(await shown(page, { sun: '-1,1,-0.5' }), nativePicture(...view, '--sun', '-1,1,-0.5')) < 1);
    const problem = () => page.evaluate(async () => {
      await new Promise((done) => setTimeout(done));
      return a.shadowRoot.querySelector('[part=message]').textContent;
    });
    for (const [name, values] of [['groundColor', ['0.5,0.4', '1,1,2', 'red', '1,,1']], ['sun', ['1,0,0', '1,1', '0,1,0,91', '0,1,0,1,2', '0,1,0,1,2,2,-1', '0,1,0,1,2,2,2,2']]]) {
      const attribute = name === 'sun' ? 'sun' : 'ground-color';
      for (const value of values) {
        await page.evaluate(([key, text]) => (a[key] = text), [name, value]);
        assert.match(await problem(), new RegExp(`^${attribute} is '${value}'; it must be `));
      }
      await page.evaluate((key) => (a[key] = null), name);
    }
    await page.evaluate(() => Object.assign(a, { ground: false, sun: '0,1,0' }));
    assert.equal(await problem(), 'sun says something of a ground; add ground');
    await page.evaluate(() => (a.sun = null));
    assert.equal(await problem(), '');
  });

  test('adding, removing and moving leaks nothing', async (t) => {
    const page = await open(t, '<div id="one"></div><div id="two"></div>', { waits: false });
    const measured = await page.evaluate(async () => {
      const { VitrineViewer } = await import('/element/vitrine-viewer.js');
      window.refs = [];
      const loads = (viewer) => new Promise((done) => viewer.addEventListener('load', done, { once: true }));
      const cycle = async (count) => {
        for (let i = 0; i < count; ++i) {
          const viewer = document.createElement('vitrine-viewer');
          Object.assign(viewer, { src: 'knot', steps: 2, layers: 1, samples: 1 });
          window.refs.push(new WeakRef(viewer));
          window.one.append(viewer);
          await loads(viewer);
          viewer.remove();
          await new Promise((done) => setTimeout(done));
        }
      };
      await cycle(4);
      const before = (await VitrineViewer.statistics()).heapBytes;
      const start = performance.now();
      await cycle(24);
      const after = await VitrineViewer.statistics();
      const milliseconds = performance.now() - start;

      const viewer = document.createElement('vitrine-viewer');
      Object.assign(viewer, { src: 'sphere', samples: 1 });
      window.one.append(viewer);
      await loads(viewer);
      const made = window.counts.contexts.length;
      for (let i = 0; i < 100; ++i) {
        (i % 2 ? window.one : window.two).append(viewer);
        await new Promise((done) => setTimeout(done));
      }
      const moved = { made: window.counts.contexts.length - made, live: window.liveContexts(), ...(await VitrineViewer.statistics()) };
      viewer.remove();
      await new Promise((done) => setTimeout(done, 10));
      return { before, after, milliseconds, moved, live: window.liveContexts(), last: await VitrineViewer.statistics() };
    });
    t.diagnostic(JSON.stringify(measured));
    assert.equal(measured.after.heapBytes, measured.before, 'the heap does not grow');
    assert.equal(measured.after.contexts, 0);
    assert.deepEqual([measured.moved.made, measured.moved.live, measured.moved.contexts], [0, 1, 1], 'moving keeps the context');
    assert.deepEqual([measured.live, measured.last.contexts], [0, 0]);
    await (await page.context().newCDPSession(page)).send('HeapProfiler.collectGarbage');
    const kept = await page.evaluate(() => window.refs.filter((ref) => ref.deref()).length);
    t.diagnostic(`${kept} of 28 elements are still in memory`);
    assert.ok(kept <= 2);
  });

  for (const count of [20, 100]) {
    test(`${count} elements share one context, and compile each shader once`, async (t) => {
      const shapes = ['sphere', 'cube', 'diamond'];
      const page = await open(t, `${Array.from({ length: count }, (_, i) => `<vitrine-viewer id="v${i}" src="${shapes[i % 3]}" environment-image="checker"></vitrine-viewer>`).join('')}
        <style>body { display: flex; flex-wrap: wrap } vitrine-viewer { width: 60px; height: ${50 + (count % 3)}px }</style>`, { waits: false, allowed: /CONTEXT_LOST/ });
      const isBlank = (image) => new Set(new Uint32Array(Uint8Array.from(image.data).buffer)).size < 10;
      const all = Array.from({ length: count }, (_, i) => i);
      const scroll = async () => {
        for (const i of all) {
          await page.evaluate((k) => document.getElementById(`v${k}`).scrollIntoView(), i);
          await page.waitForFunction((k) => document.getElementById(`v${k}`).loaded, i);
        }
        await quiet(page);
      };
      await scroll();
      const made = await page.evaluate(() => [window.liveContexts(), window.counts.contexts.length, window.counts.programs]);
      t.diagnostic(`${made[0]} context, ${made[2]} programs`);
      assert.deepEqual(made.slice(0, 2), [1, 1]);
      assert.ok(made[2] <= 2, `${made[2]} programs`); // to trace with, and to show
      const pictures = [];
      for (const i of all) pictures.push(await shot(page, `v${i}`));
      const whole = async (name) => {
        for (const i of all) assert.equal(difference(pictures[i], await shot(page, `v${i}`)), 0, `${name}: ${i}`);
      };
      for (const i of all) {
        assert.ok(!isBlank(pictures[i]), `${i} has its picture`);
        assert.equal(difference(pictures[i], pictures[i % 3]), 0, 'that of its shape');
      }
      assert.ok(difference(pictures[0], pictures[1]) > 5);
      await page.evaluate(() => {
        window.loss = window.counts.contexts[0].deref().getExtension('WEBGL_lose_context');
        window.loss.loseContext();
      });
      await page.waitForFunction(() => window.events.some(({ type }) => type === 'webglcontextlost'));
      await page.evaluate(() => window.loss.restoreContext());
      await page.waitForFunction((k) => document.getElementById(`v${k}`).shadowRoot.querySelector('[part=message]').hidden, count - 1);
      await scroll();
      await whole('after a loss');
      for (const i of all) assert.equal(await message(page, `v${i}`), '');
    });
  }

  test('elements out of view give back what they hold on the GPU, those seen longest ago first', async (t) => {
    const page = await open(t, `${Array.from({ length: 6 }, (_, i) => `<vitrine-viewer id="v${i}" src="sphere" samples="2"></vitrine-viewer>`).join('')}
      <style>vitrine-viewer { width: 700px; height: 700px }</style>`, { waits: false, viewport: { width: 720, height: 720 }, deviceScaleFactor: 1 });
    let first;
    const held = [];
    for (let i = 0; i < 6; ++i) {
      await page.evaluate((k) => document.getElementById(`v${k}`).scrollIntoView(), i);
      await page.waitForFunction((k) => document.getElementById(`v${k}`).loaded, i);
      await quiet(page);
      first ??= await shot(page, 'v0');
      held.push(await page.evaluate(() => customElements.get('vitrine-viewer').statistics()));
    }
    t.diagnostic(held.map(({ viewers, gpuBytes }) => `${viewers} hold ${(gpuBytes / 1e6).toFixed(0)} MB`).join(', '));
    const most = held[0].gpuBytes * 2 + 2 ** 27; // at most two are in view
    for (const { gpuBytes } of held) assert.ok(gpuBytes <= most);
    assert.ok(held.at(-1).viewers < 6);
    assert.equal(difference(first, await shot(page, 'v0')), 0, 'its picture stays');
    await page.evaluate(() => Object.assign(window.v0, { ior: 1.2 }));
    await page.evaluate(() => window.v0.scrollIntoView());
    await quiet(page);
    const changed = await shot(page, 'v0');
    assert.ok(difference(first, changed) > 5, 'and it comes back to draw');
  });

  test('poster and progress stand until the first frame', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="/slow.glb" poster="/poster.png" alt="A pyramid"></vitrine-viewer>', { waits: false });
    await page.waitForFunction(() => window.events.some(({ totalProgress }) => totalProgress > 0.3));
    const loading = await shot(page);
    writeFileSync(join(screenshots, 'element-loading.png'), PNG.sync.write(loading));
    assert.deepEqual(pixel(loading, 80, 80), [250, 10, 200]);
    assert.notDeepEqual(pixel(loading, 10, 2), [250, 10, 200], 'the bar');
    openGate();
    await page.waitForFunction(() => a.loaded);
    await quiet(page);
    assert.deepEqual(pixel(await shot(page), 2, 2), [20, 90, 40], 'the poster is gone');
    const values = (await events(page, 'progress')).map(({ totalProgress }) => totalProgress);
    t.diagnostic(values.map((value) => value.toFixed(3)).join(' '));
    assert.ok(values.length >= 4 && values[0] === 0 && values.at(-1) === 1);
    assert.ok(values.every((value, i) => i === 0 || value > values[i - 1]));
    assert.equal((await events(page, 'load')).length, 1);
    assert.equal(await page.evaluate(() => getComputedStyle(a.shadowRoot.querySelector('[part=progress-bar]')).display), 'none');

    await page.evaluate(() => {
      a.outerHTML = '<vitrine-viewer id="a" src="sphere" reveal="manual"><div slot="poster" id="words">Soon</div></vitrine-viewer>';
    });
    await page.waitForFunction(() => a.loaded);
    assert.ok(await page.isVisible('#words'));
    await page.evaluate(() => a.dismissPoster());
    assert.ok(await page.isHidden('#words'));
    assert.ok(await page.evaluate(() => a.modelIsVisible));
  });

  test('a failed load says why and leaves the picture', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="/good.glb"></vitrine-viewer>', { allowed: /404/ });
    const first = await shot(page);
    const picked = await picture(page);
    const cases = { '/missing.glb': /missing\.glb: the server answered 404/, '/broken.glb': /broken\.glb/, teapot: /teapot/ };
    for (const [src, sentence] of Object.entries(cases)) {
      await page.evaluate((url) => (a.src = url), src);
      await page.waitForFunction((count) => window.events.filter(({ event }) => event === 'error').length === count, Object.keys(cases).indexOf(src) + 1);
      assert.match(await message(page), sentence);
      const error = (await events(page, 'error')).at(-1);
      assert.equal(error.type, 'loadfailure');
      assert.match(error.sentence, sentence);
      assert.equal(await page.evaluate(() => a.loaded), false);
      assert.equal(difference(picked, await picture(page)), 0);
    }
    await page.locator('#a').screenshot({ path: join(screenshots, 'element-error.png') });
    await page.evaluate(() => (a.src = '/good.glb'));
    await page.waitForFunction(() => a.loaded);
    assert.equal(await message(page), '');
    assert.equal(difference(first, await shot(page)), 0);

    await page.evaluate(() => Object.assign(a, { ior: 9, layers: 2.5, cameraOrbit: 'left' }));
    await quiet(page);
    const text = await message(page);
    for (const part of [/ior is '9'; it must be a number from 1 to 4; 4 is used/, /layers is '2.5'/, /camera-orbit is 'left'/]) assert.match(text, part);
    assert.deepEqual((await events(page, 'error')).at(-1).type, 'invalid');
    assert.deepEqual(await page.evaluate(() => [a.ior, a.layers]), [4, 3]);
  });

  test('a fetch that fails says whether it was offline, another server or what it answered', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="cube" technique="single"></vitrine-viewer>', { allowed: /CORS|ERR_|404/ });
    const other = await listen((request, response) => response.end('nothing for other pages'));
    const said = async (src, sentence) => {
      await page.evaluate((url) => (a.src = url), src);
      await page.waitForFunction(({ source }) => window.events.some((event) => event.event === 'error' && new RegExp(source).test(event.sentence)), sentence);
    };
    await said(`${other.address}/far.glb`, { source: 'far\\.glb: cannot be fetched: 127.0.0.1:\\d+ does not let this page read it; it has to answer with Access-Control-Allow-Origin' });
    other.close();
    await said('http://127.0.0.1:9/gone.glb', { source: 'gone\\.glb: cannot be fetched: 127.0.0.1:9 cannot be reached' });
    await page.context().setOffline(true);
    await said('/away.glb', { source: 'away\\.glb: cannot be fetched: the browser is offline' });
    await page.context().setOffline(false);
    await said('/missing.glb', { source: 'missing\\.glb: the server answered 404' });
  });

  test('what a frame is refused for is said until the next good one, and too large a size is scaled down', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="cube" technique="single"></vitrine-viewer>');
    const first = await shot(page);
    await page.evaluate(() => (a.cameraTarget = '1e9m 1e9m 1e9m'));
    await quiet(page);
    assert.match(await message(page), /the camera stands on its target/);
    assert.equal((await events(page, 'error')).length, 1);
    await page.evaluate(() => a.removeAttribute('camera-target'));
    await quiet(page);
    assert.equal(await message(page), '');
    assert.equal(difference(first, await shot(page)), 0);
    for (const [width, height] of [['17000px', '20px'], ['6000px', '6000px']]) {
      await page.evaluate(([w, h]) => Object.assign(a, { hidden: false }) && Object.assign(a.style, { width: w, height: h }), [width, height]);
      await page.waitForFunction((side) => window.events.at(-1).pixelWidth === side, width === '17000px' ? 16384 : 4096);
      assert.equal(await message(page), '');
      await page.evaluate(() => (a.hidden = true)); // the second one need not be drawn
    }
  });

  test('several objects, each of its own index', async (t) => {
    requests.length = 0;
    const page = await open(t, `<vitrine-viewer id="a" skybox-image environment-image="checker" objects="sphere:at=-1.2,0,0, ior = 1.2; sphere:at=1.2,0,0;"></vitrine-viewer>${ofSide}`, { allowed: /404/ });
    const show = (changes) => shown(page, changes);
    const part = (image, ...ends) => {
      const [from, to] = ends.map(Math.round);
      const half = new PNG({ width: to - from, height: image.height });
      PNG.bitblt(image, half, from, 0, to - from, image.height, 0, 0);
      return half;
    };
    const first = await picture(page);
    assert.ok(difference(first, nativePicture('--object', 'sphere:at=-1.2,0,0,ior=1.2', '--object', 'sphere:at=1.2,0,0', '-e', 'checker')) < 0.5, 'as the native program');
    const other = await show({ objects: 'sphere:at=-1.2,0,0,ior=1.2; sphere:at=1.2,0,0,ior=1.9' });
    assert.ok(difference(part(first, 0, 0.47 * side), part(other, 0, 0.47 * side)) < 0.5, 'the left one is as before');
    assert.ok(difference(part(first, 0.53 * side, side), part(other, 0.53 * side, side)) > 5, 'the right one is not');
    assert.ok(difference(other, await show({ ior: 1.9 })) > 5, 'ior is for all');
    const plainer = await show({ ior: null, fresnel: 'off' });
    assert.ok(meanError(other, plainer) > 0.5, 'without Fresnel reflection');

    // The path goes through both, and ends on what is opaque.
    const path = await page.evaluate(async () => {
      Object.assign(a, { objects: 'sphere\nsphere:at=0,0,-3\nplane:at=0,0,-6', cameraOrbit: '0deg 90deg auto', cameraTarget: '0m 0m 0m' });
      await new Promise((done) => a.addEventListener('load', done, { once: true }));
      const { left, top } = a.getBoundingClientRect();
      return a.pathAt(left + 65, top + 63);
    });
    assert.deepEqual([path.events.length, path.points.length, path.exited], [4, 5, false]);
    assert.ok(Math.abs(path.points[4][2] + 6) < 1e-3);

    const files = await show({ src: 'torus', objects: '/good.glb:at=2,0,0; /good.glb:at=-2,0,0,scale=0.5; water' });
    assert.deepEqual(requests.filter((one) => one.endsWith('.glb')), ['/good.glb'], 'fetched once');
    const cases = {
      'sphere:at=1': /objects 'sphere:at=1': at is '1'; it must be three numbers/,
      'sphere:color=1,0,0': /has the key 'color', which is unknown; the keys are ior, at/,
      teapot: /teapot: neither a built-in name nor a file/,
      '/missing.glb:ior=2': /missing\.glb: the server answered 404/,
      'sphere:scale=0': /scale is '0'/,
    };
    for (const [objects, sentence] of Object.entries(cases)) {
      const count = (await events(page, 'error')).length;
      await page.evaluate((text) => (a.objects = text), objects);
      await page.waitForFunction((least) => window.events.filter(({ event }) => event === 'error').length > least, count);
      assert.match(await message(page), sentence);
      assert.equal(difference(files, await picture(page)), 0, 'the picture stays');
    }
    await show({ src: null, objects: 'cube' });
    await page.evaluate(() => Object.assign(a, { cameraIndex: 2 }));
    await quiet(page);
    assert.match(await message(page), /camera-index is 2, but the model has no camera/);
    await page.evaluate(() => Object.assign(a, { cameraIndex: null }));
    await quiet(page);
    assert.equal(await message(page), '');
  });

  test('a model that is asked for again while another one is being built', async (t) => {
    const init = () => {
      const usual = window.setTimeout;
      window.held = [];
      window.setTimeout = (act, after, ...values) => (window.holds && values.length === 1 ? window.held.push(() => act(...values)) : usual(act, after, ...values));
    };
    const page = await open(t, '<vitrine-viewer id="a" src="sphere"></vitrine-viewer>', { init });
    const before = await shot(page);
    await page.evaluate(() => {
      window.holds = true; // the slices in which it is built
      a.src = 'knot';
    });
    await page.waitForFunction(() => window.held.length > 0);
    await page.evaluate(() => (a.src = 'sphere'));
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    await page.evaluate(() => {
      window.holds = false;
      window.held.splice(0).forEach((act) => act());
    });
    await page.waitForFunction(() => a.loaded);
    await quiet(page);
    assert.equal(difference(before, await shot(page)), 0);
  });

  test('pictures and cameras of a model', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="/red.glb"></vitrine-viewer>');
    const facts = await page.evaluate(async () => {
      const { Viewer, loadCore } = await import('/element/core.js');
      const viewer = new Viewer(await loadCore(), {});
      const contents = new Uint8Array(await (await fetch('/red.glb')).arrayBuffer());
      viewer.begin([{ name: 'red.glb', contents, spec: '' }]);
      const { length } = viewer.images;
      viewer.destroy();
      return length;
    });
    if (facts === 0) {
      t.skip('the loader gives no pictures');
      return;
    }
    const reds = ({ data }) => data.filter((value, i) => i % 4 === 0 && value > 60 && value > 3 * data[i + 1] && value > 3 * data[i + 2]).length;
    const first = await picture(page);
    assert.ok(reds(first) > 300, `${reds(first)} pixels are red`);
    await page.evaluate(() => (a.cameraIndex = 0));
    await quiet(page);
    const { theta, phi } = await page.evaluate(() => ({ ...a.getCameraOrbit() }));
    assert.ok(Math.abs(theta - Math.PI / 2) < 1e-3 && Math.abs(phi - Math.PI / 2) < 1e-3, 'the camera of the file');
    assert.ok(difference(first, await picture(page)) > 5);
    await page.evaluate(() => (a.cameraIndex = 1));
    await quiet(page);
    assert.match(await message(page), /camera-index is 1; the model has the cameras 0 to 0/);
    await page.evaluate(() => Object.assign(a, { cameraIndex: null, src: '/unreadable.glb' }));
    await page.waitForFunction(() => a.loaded);
    await quiet(page);
    assert.match(await message(page), /^unreadable\.glb: image 0 is no picture that this browser can decode; white is shown in its place$/);
    assert.equal(reds(await picture(page)), 0);
    await page.evaluate(() => {
      globalThis.told = [];
      a.addEventListener('warning', ({ detail }) => told.push(...detail.sentences));
      a.src = '/noted.glb';
    });
    await page.waitForFunction(() => a.loaded);
    assert.deepEqual(await page.evaluate(() => [told, a.warnings]), Array(2).fill(["'noted.glb': ignored: extension ACME_motion"]));
    await page.evaluate(() => (a.src = '/red.glb'));
    await page.waitForFunction(() => a.loaded);
    await quiet(page);
    assert.equal(await page.evaluate(() => a.warnings.length), 0);
    assert.equal(await message(page), '');
    assert.equal(difference(first, await picture(page)), 0);
  });

  test('relief glass of patterns and pictures', async (t) => {
    requests.length = 0;
    const page = await open(t, `<vitrine-viewer id="a" relief="hammered" relief-depth="0.06" src="/good.glb" skybox-image></vitrine-viewer>${ofSide}`, { allowed: /404/ });
    const show = (changes) => shown(page, changes);
    const draws = async (name, seen, ...args) => {
      const differing = difference(seen, nativePicture(...args));
      t.diagnostic(`${name}: ${differing.toFixed(4)} % differ`);
      assert.ok(differing < 0.5, `${name}: ${differing} % differ`);
    };
    assert.ok(!requests.includes('/good.glb'), 'relief goes before src');
    assert.equal((await events(page, 'load')).at(-1).url, 'hammered');
    const first = await picture(page);
    await page.locator('#a').screenshot({ path: join(screenshots, 'element-relief.png') });
    await draws('hammered', first, 'hammered', '--relief', '0.06');
    const colours = new Set(new Uint32Array(Uint8Array.from(first.data).buffer));
    assert.ok(colours.size > 1000, `${colours.size} colours`);

    const coarse = await show({ relief: null, src: '', objects: 'hammered:relief=0.06,samples=96' }); // few triangles
    const exact = meanError(coarse, await show({ technique: 'exact' }));
    t.diagnostic(`heightfield and exact: mean difference ${exact.toFixed(3)} of 255`);
    assert.ok(exact < 0.5);
    assert.ok(meanError(coarse, await show({ technique: 'layered' })) < 20);
    assert.equal(meanError(first, await show({ technique: null, relief: 'hammered', objects: '' })), 0, 'and back');
    assert.ok(difference(first, await show({ reliefDepth: 0.2 })) > 5, 'depth');
    assert.ok(difference(first, await show({ reliefDepth: 0.06, reliefSlab: 1 })) > 5, 'slab');
    const path = await page.evaluate(() => {
      const { left, top } = a.getBoundingClientRect();
      return a.pathAt(left + 65, top + 63);
    });
    assert.ok(path.events.length >= 2 && path.exited, 'a path goes through');

    for (const name of ['hills.png', 'slopes.pfm']) {
      writeFileSync(join(folder, name), reliefs.get(`/${name}`));
      requests.length = 0;
      await draws(name, await show({ relief: `/${name}`, reliefDepth: 0.3, reliefSlab: null }), name, '--relief', '0.3');
      await draws(`${name}, less deep`, await show({ reliefDepth: 0.1, reliefSmooth: 4 }), name, '--smooth', '4');
      assert.deepEqual(requests, [`/${name}`], 'fetched once');
      await show({ reliefDepth: null, reliefSmooth: null });
    }
    const keys = ['--object', 'hills.png:relief=0.2,at=0,0,-1', '--object', 'plane:checker=6,at=0,0,-2', '--object', 'fluted:at=2.1,0,0'];
    const scene = await show({ relief: null, src: '', objects: keys.filter((_, i) => i % 2).join(';').replace('hills', '/hills') });
    await draws('objects', scene, ...keys);

    const cases = {
      '/dot.png': /relief 'dot.png' is 1 x 1 samples, but a side must be 2 to 4096/,
      '/wide.png': /relief 'wide.png' is 4097 x 2 samples, but a side must be 2 to 4096/,
      '/broken.png': /relief 'broken.png' is a PNG that the browser could not decode/,
      '/words.txt': /relief 'words.txt' is no picture that can be read/,
      '/good.glb': /relief 'good.glb' is no picture that can be read/,
      knot: /knot: neither a built-in name nor a file/,
    };
    for (const [relief, sentence] of Object.entries(cases)) {
      const count = (await events(page, 'error')).length;
      await page.evaluate((url) => (a.relief = url), relief);
      await page.waitForFunction((least) => window.events.filter(({ event }) => event === 'error').length > least, count);
      assert.match(await message(page), sentence);
      assert.equal(difference(scene, await picture(page)), 0, 'the picture stays');
    }
    await page.evaluate(() => Object.assign(a, { relief: null, objects: 'knot:relief=0.1' }));
    await page.waitForFunction(() => /knot/.test(a.shadowRoot.querySelector('[part=message]').textContent));
    assert.match(await message(page), /objects 'knot:relief=0.1' is no relief|'knot' is no relief, so the key 'relief' says nothing to it/);
  });

  test('a technique that cannot have the scene leaves it to the usual one', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" relief="ripples" camera-controls></vitrine-viewer>');
    const first = await picture(page);
    await page.evaluate(async () => {
      const { Viewer } = await import('/element/core.js');
      const { setGlass } = Viewer.prototype;
      window.tries = 0;
      Viewer.prototype.setGlass = function (glass) {
        return glass.technique === 'exact' ? `too many triangles, try ${++window.tries}` : setGlass.call(this, glass);
      };
      a.technique = 'exact';
    });
    await quiet(page);
    assert.equal(await message(page), 'too many triangles, try 1');
    assert.equal(difference(first, await picture(page)), 0, 'the picture stays');
    await page.evaluate(() => a.shadowRoot.querySelector('.view').focus());
    await page.keyboard.press('ArrowLeft');
    await quiet(page);
    assert.ok(difference(first, await picture(page)) > 2, 'and turns');
    assert.equal(await page.evaluate(() => window.tries), 1);
    await page.evaluate(() => (a.technique = 'single'));
    await quiet(page);
    assert.equal(await message(page), '');
  });

  test('an outdated load is dropped', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="/slow.glb"></vitrine-viewer>', { waits: false });
    await page.waitForFunction(() => window.events.some(({ totalProgress }) => totalProgress > 0.1));
    await page.evaluate(() => (a.src = 'torus'));
    await page.waitForFunction(() => a.loaded);
    openGate();
    await quiet(page);
    assert.deepEqual((await events(page, 'load')).map(({ url }) => url), ['torus']);
    assert.deepEqual(await events(page, 'error'), []);
  });

  test('turns under mouse, wheel, keys and sliders', async (t) => {
    const page = await open(t, '<a id="before" href="#">before</a><vitrine-viewer id="a" src="diamond" camera-controls alt="A diamond"></vitrine-viewer><a href="#" id="next">next</a>');
    const orbit = () => page.evaluate(() => ({ ...a.getCameraOrbit() }));
    const first = await picture(page);
    const start = await orbit();
    const box = await page.locator('#a').boundingBox();
    await page.mouse.move(box.x + 80, box.y + 80);
    await page.mouse.down();
    await page.mouse.move(box.x + 120, box.y + 90, { steps: 3 });
    await page.mouse.up();
    const turned = await orbit();
    assert.ok(Math.abs(start.theta - turned.theta - Math.PI / 4) < 1e-6, 'a quarter of the height is an eighth of a turn');
    assert.ok(turned.phi < start.phi, 'down shows the top');
    await page.mouse.move(box.x + 20, box.y + 20);
    assert.deepEqual({ ...(await orbit()), toString: 0 }, { ...turned, toString: 0 }, 'a released button turns nothing');
    await page.mouse.wheel(0, 200);
    await page.waitForFunction((radius) => a.getCameraOrbit().radius > 1.1 * radius, turned.radius);
    const changes = await events(page, 'camera-change');
    assert.equal(changes.at(-1).source, 'user-interaction');

    await page.evaluate(() => (a.disableZoom = true));
    const far = await orbit();
    await page.mouse.wheel(0, -200);
    await pause(50);
    assert.equal((await orbit()).radius, far.radius, 'disable-zoom');
    await page.evaluate(() => (a.disableZoom = false));

    await page.focus('#before');
    await page.keyboard.press('Tab');
    const focused = await page.evaluate(() => {
      const { activeElement } = a.shadowRoot;
      return [activeElement?.getAttribute('role'), activeElement?.getAttribute('aria-label'), getComputedStyle(activeElement).outlineStyle];
    });
    assert.deepEqual(focused, ['application', 'A diamond', 'solid']);
    await page.locator('#a').screenshot({ path: join(screenshots, 'element-focus.png') });
    await page.keyboard.press('Home');
    assert.deepEqual({ ...(await orbit()), toString: 0 }, { ...start, toString: 0 });
    for (const [key, name, sign] of [['ArrowLeft', 'theta', -1], ['ArrowRight', 'theta', 1], ['ArrowUp', 'phi', -1], ['ArrowDown', 'phi', 1], ['+', 'radius', -1], ['-', 'radius', 1]]) {
      const old = await orbit();
      await page.keyboard.press(key);
      assert.equal(Math.sign((await orbit())[name] - old[name]), sign, key);
    }
    await page.keyboard.press('ArrowLeft');
    await page.waitForFunction(() => /^Seen from .* at 100 %/.test(a.shadowRoot.querySelector('[role=status]').textContent));
    t.diagnostic(await page.evaluate(() => a.shadowRoot.querySelector('[role=status]').textContent));
    await page.keyboard.press('Tab');
    assert.equal(await page.evaluate(() => document.activeElement.id), 'next', 'one stop, and Tab leaves it');

    await page.evaluate(() => {
      const turn = a.shadowRoot.querySelector('[aria-label=Turn]');
      turn.value = 90;
      turn.dispatchEvent(new Event('input'));
    });
    assert.ok(Math.abs((await orbit()).theta - Math.PI / 2) < 1e-6, 'a slider for screen readers');
    await page.evaluate(() => a.resetView());
    await quiet(page);
    assert.equal(difference(first, await picture(page)), 0, 'and back');
  });

  test('the view follows as a spring does, within its limits', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="cube" technique="single" camera-controls interpolation-decay="100" camera-orbit="0deg 90deg 4m"></vitrine-viewer>');
    const orbit = () => page.evaluate(() => ({ ...a.getCameraOrbit() }));
    const first = await shot(page);
    await page.evaluate(() => (a.cameraOrbit = '60deg 90deg 8m'));
    await page.waitForFunction(() => a.getCameraOrbit().theta > 0.05);
    const between = await orbit();
    assert.ok(between.theta < Math.PI / 3 && between.radius > 4 && between.radius < 8, JSON.stringify(between));
    await quiet(page);
    const end = await orbit();
    assert.ok(Math.abs(end.theta - Math.PI / 3) < 1e-9 && Math.abs(end.radius - 8) < 1e-9, 'it arrives');
    const arrived = await shot(page);
    assert.ok(difference(first, arrived) > 2);
    await page.evaluate(() => {
      a.cameraOrbit = '0deg 90deg 4m';
      return Promise.resolve().then(() => a.jumpCameraToGoal());
    });
    assert.ok((await orbit()).theta < 1e-9, 'without the way');
    await quiet(page);
    assert.equal(difference(first, await shot(page)), 0);
    await page.evaluate(() => (a.cameraOrbit = '-350deg 90deg 4m'));
    await page.waitForFunction(() => a.getCameraOrbit().theta !== 0);
    assert.ok(Math.abs((await orbit()).theta + 2 * Math.PI) < 0.2, 'the shorter way round');
    await quiet(page);
    await page.emulateMedia({ reducedMotion: 'reduce' });
    await page.evaluate(() => (a.cameraOrbit = '45deg 90deg 4m'));
    await page.evaluate(() => null);
    assert.ok(Math.abs((await orbit()).theta - Math.PI / 4) < 1e-9, 'at once, for whom motion is too much');

    await page.evaluate(() => Object.assign(a, { minCameraOrbit: '-10deg 60deg 3m', maxCameraOrbit: '10deg auto 150%', maxFieldOfView: '30deg' }));
    await quiet(page);
    assert.ok(Math.abs((await page.evaluate(() => a.getFieldOfView())) - 30) < 1e-9);
    assert.ok(Math.abs((await orbit()).theta - Math.PI / 18) < 1e-9);
    await page.evaluate(() => a.shadowRoot.querySelector('.view').focus());
    for (let i = 0; i < 12; ++i) await page.keyboard.press('ArrowUp');
    for (let i = 0; i < 30; ++i) await page.keyboard.press('+');
    await page.keyboard.press('ArrowLeft');
    const { theta, phi, radius } = await orbit();
    assert.deepEqual([theta, phi, radius].map((value) => Number(value.toFixed(4))), [Math.PI / 36, Math.PI / 3, 3].map((value) => Number(value.toFixed(4))), 'and from the limit back at once');
    await page.evaluate(() => (a.maxCameraOrbit = 'far'));
    await quiet(page);
    assert.match(await message(page), /^max-camera-orbit is 'far'; it must have 3 parts$/);
  });

  test('the right button pans', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="cube" technique="single" camera-controls></vitrine-viewer>');
    const target = () => page.evaluate(() => a.getCameraTarget());
    const start = await target();
    const drag = async () => {
      await page.mouse.move(80, 80);
      await page.mouse.down({ button: 'right' });
      await page.mouse.move(110, 80, { steps: 3 });
      await page.mouse.up({ button: 'right' });
    };
    await drag();
    const moved = await target();
    assert.ok(Math.hypot(moved.x - start.x, moved.z - start.z) > 0.3 && moved.y === start.y);
    await page.evaluate(() => (a.disablePan = true));
    await drag();
    assert.deepEqual(await target(), moved);
  });

  test('hotspots stand at their points', async (t) => {
    const count = () => requests.filter((path) => path === '/element/hotspots.js').length;
    requests.length = 0;
    const page = await open(t, `<vitrine-viewer id="b" src="cube" technique="single"></vitrine-viewer>`);
    assert.equal(count(), 0, 'not loaded without');
    await page.evaluate(() => {
      b.outerHTML = `<vitrine-viewer id="a" src="cube" technique="single" samples="1" interpolation-decay="0" camera-orbit="0deg 90deg 6m" camera-target="0m 0m 0m">
        <button slot="hotspot-front" id="front" data-position="0.5m 0 50cm" data-normal="0 0 1" data-visibility-attribute="shown">A</button>
        <button slot="hotspot-back" id="back" data-position="0 0 -0.5" data-normal="0 0 -1">B</button></vitrine-viewer>`;
    });
    await page.waitForFunction(() => a.loaded && front.getBoundingClientRect().width > 0);
    await quiet(page);
    assert.equal(count(), 1);
    const middle = (id) => page.evaluate((name) => {
      const { left, top, width, height } = document.getElementById(name).getBoundingClientRect();
      const [[x, y]] = a.project([name === 'front' ? [0.5, 0, 0.5] : [0, 0, -0.5]]);
      return [left + width / 2 - x, top + height / 2 - y];
    }, id);
    for (const id of ['front', 'back']) assert.ok((await middle(id)).every((value) => Math.abs(value) < 1), `${id}: ${await middle(id)}`);
    const seen = () => page.evaluate(() => [front.hasAttribute('data-shown'), back.hasAttribute('data-visible')]);
    assert.deepEqual(await seen(), [true, false]);
    await page.screenshot({ path: join(screenshots, 'element-hotspots.png') });
    await page.evaluate(() => (a.cameraOrbit = '160deg 90deg 6m'));
    await quiet(page);
    for (const id of ['front', 'back']) assert.ok((await middle(id)).every((value) => Math.abs(value) < 1), id);
    assert.deepEqual(await seen(), [false, true]);
    await page.evaluate(() => (front.dataset.position = 'here'));
    await page.waitForFunction(() => /hotspot-front: data-position is 'here'/.test(a.shadowRoot.querySelector('[part=message]').textContent));
    await page.evaluate(() => front.remove());
    await page.waitForFunction(() => a.shadowRoot.querySelector('[part=message]').hidden);
  });

  test('a hand shows that the view can be turned, until somebody does', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="cube" technique="single" camera-controls interaction-prompt="auto" interaction-prompt-threshold="50"></vitrine-viewer>', { waits: false });
    await page.waitForFunction(() => a.loaded);
    const theta = await page.evaluate(() => a.getCameraOrbit().theta);
    await page.waitForFunction((before) => a.shadowRoot.querySelector('.prompt svg') && Math.abs(a.getCameraOrbit().theta - before) > 0.05, theta);
    await page.locator('#a').screenshot({ path: join(screenshots, 'element-prompt.png') });
    await page.evaluate(() => a.shadowRoot.querySelector('.view').focus());
    await page.keyboard.press('ArrowLeft');
    await quiet(page);
    assert.equal(await page.evaluate(() => a.shadowRoot.querySelector('.prompt')), null);
  });

  test('orientation, scale, dimensions and materials', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="/good.glb" objects="cube:at=3,0,0" camera-orbit="0deg 75deg 12m"></vitrine-viewer>');
    const size = () => page.evaluate(() => [a.getDimensions(), a.getBoundingBoxCenter()]);
    const close = ({ x, y, z }, ...expected) => [x, y, z].forEach((value, i) => assert.ok(Math.abs(value - expected[i]) < 1e-3, `${[x, y, z]}, not ${expected}`));
    const [whole, centre] = await size();
    await shown(page, { objects: '' });
    const [alone] = await size();
    assert.ok(whole.x > alone.x && centre.x > 0.5);
    const first = await picture(page);
    await shown(page, { scale: '2 1 0.5' });
    close((await size())[0], 2 * alone.x, alone.y, 0.5 * alone.z);
    await shown(page, { scale: '1', orientation: '0deg 0deg 90deg' });
    close((await size())[0], alone.z, alone.y, alone.x);
    await shown(page, { orientation: '90deg 0 0deg'.replace(' 0 ', ' 0rad ') });
    close((await size())[0], alone.y, alone.x, alone.z);
    await page.evaluate(() => (a.scale = '0'));
    await quiet(page);
    assert.match(await message(page), /^scale is '0'; it must be one or three numbers above 0$/);
    assert.equal(difference(first, await shown(page, { scale: null, orientation: null })), 0);

    assert.deepEqual(await page.evaluate(() => a.materials.map(({ opaque, ior, tint }) => [opaque, Number(ior.toFixed(3)), tint])), [[false, 1.3, [1, 1, 1]]]);
    const changed = await page.evaluate(async () => {
      const [material] = a.materials;
      Object.assign(material, { ior: 1.6, tint: [1, 0.5, 0.5] });
      return [material.ior, material.tint];
    });
    assert.deepEqual(changed, [1.6, [1, 0.5, 0.5]]);
    await quiet(page);
    const red = await picture(page);
    assert.ok(difference(first, red) > 2);
    writeFileSync(join(folder, 'good.glb'), pyramid());
    assert.equal(await page.evaluate(() => {
      try {
        a.materials[0].ior = 'much';
        return '';
      } catch (reason) {
        return reason.message;
      }
    }), "material '0:ior=much': ior is 'much'; it must be a number from 0.25 to 4");
    await page.evaluate(() => window.counts.contexts.at(-1).deref().getExtension('WEBGL_lose_context').loseContext());
    await page.waitForFunction(() => !a.shadowRoot.querySelector('[part=message]').hidden);
    await page.evaluate(() => (a.hidden = true));
    await quiet(page);
    await page.evaluate(() => (a.hidden = false));
    await page.waitForFunction(() => a.shadowRoot.querySelector('[part=message]').hidden);
    await quiet(page);
    assert.equal(difference(red, await picture(page)), 0, 'what was set stays');
    assert.ok(difference(red, await shown(page, { src: 'cube' })) > 2);
  });

  test('turns under fingers', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="knot" layers="2" steps="8" camera-controls></vitrine-viewer>', { hasTouch: true });
    const touch = await page.context().newCDPSession(page);
    const send = (type, ...points) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const orbit = () => page.evaluate(() => ({ ...a.getCameraOrbit() }));
    const start = await orbit();
    await send('touchStart', [40, 80]);
    await send('touchMove', [70, 82]);
    await send('touchMove', [100, 82]);
    await send('touchEnd');
    await quiet(page);
    const turned = await orbit();
    assert.ok(turned.theta < start.theta - 0.3, 'one finger turns');
    await send('touchStart', [60, 80], [90, 80]);
    await send('touchMove', [40, 80], [110, 80]);
    await send('touchMove', [30, 80], [120, 80]);
    await send('touchEnd');
    await quiet(page);
    assert.ok((await orbit()).radius < 0.6 * turned.radius, 'two fingers zoom');
    assert.equal((await orbit()).theta, turned.theta);
    assert.equal(await page.evaluate(() => getComputedStyle(a.shadowRoot.querySelector('.view')).touchAction), 'pan-y');
  });

  test('auto-rotate turns, but not against the visitor', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="torus" layers="2" steps="4" auto-rotate></vitrine-viewer>', { waits: false });
    await page.waitForFunction(() => a.loaded);
    const theta = () => page.evaluate(() => a.getCameraOrbit().theta);
    const old = await theta();
    await page.waitForFunction((before) => a.getCameraOrbit().theta > before + 0.05, old);
    await page.emulateMedia({ reducedMotion: 'reduce' });
    await quiet(page);
    const [rest, count] = [await theta(), await draws(page)];
    await pause(500);
    assert.deepEqual([await theta(), await draws(page)], [rest, count]);
  });

  test('nothing is drawn while idle, off screen or hidden', async (t) => {
    requests.length = 0;
    const page = await open(t, '<vitrine-viewer id="a" src="torus" layers="2" steps="4" camera-controls></vitrine-viewer><div class="far"></div><vitrine-viewer id="b" src="/broken.glb"></vitrine-viewer><vitrine-viewer src="/good.glb" loading="eager"></vitrine-viewer>', { waits: false });
    await page.waitForFunction(() => a.loaded);
    await quiet(page);
    assert.deepEqual(requests.filter((path) => path.endsWith('.glb')), ['/good.glb'], 'only what is eager is fetched');
    const idle = await draws(page);
    await pause(1000);
    assert.equal(await draws(page), idle, 'idle');
    assert.equal(await page.evaluate(() => window.counts.contexts.length), 1, 'the others have no context yet');
    await page.evaluate(() => scrollTo(0, 600));
    await quiet(page);
    await page.evaluate(() => (a.autoRotate = true));
    await pause(500);
    assert.equal(await draws(page), idle, 'off screen');
    await page.evaluate(() => scrollTo(0, 0));
    await page.waitForFunction((count) => window.counts.draws > count, idle);
    await page.evaluate(() => (a.hidden = true));
    await quiet(page);
    const hidden = await draws(page);
    await pause(500);
    assert.equal(await draws(page), hidden, 'hidden');
  });

  // Less of each setting too, where the resolution alone is not enough. Frames in motion last 40 ms here whatever the
  // machine does.
  const init = () => {
    const { fenceSync, getSyncParameter } = WebGL2RenderingContext.prototype;
    const born = new WeakMap();
    WebGL2RenderingContext.prototype.fenceSync = function (...values) {
      const fence = fenceSync.apply(this, values);
      if (fence) born.set(fence, performance.now());
      return fence;
    };
    WebGL2RenderingContext.prototype.getSyncParameter = function (fence, name) {
      const isYoung = window.a?.autoRotate && performance.now() - born.get(fence) < 40;
      return isYoung && name === this.SYNC_STATUS ? this.UNSIGNALED : getSyncParameter.call(this, fence, name);
    };
  };
  for (const [technique, full, least] of [['exact', [4, 100, 8, 1, 3], [2, 25, 4, 0, 1]], ['layered', [4, 100, 8, 0, 3], [2, 25, 4, 0, 1]]]) {
    test(`quality="auto" holds the frame time and ends with a full frame: ${technique}`, async (t) => {
      const page = await open(t, `<vitrine-viewer id="a" src="knot" camera-controls technique="${technique}" steps="100"></vitrine-viewer><style>vitrine-viewer { width: 100px; height: 100px }</style>`, { deviceScaleFactor: 3, init });
      const settings = ({ layers, steps, maxEvents, branches, wavelengths }) => [layers, steps, maxEvents, branches, wavelengths];
      const first = (await events(page, 'render-scale'))[0];
      assert.deepEqual([first.reportedDpr, first.renderedDpr, first.pixelWidth, first.preset, first.reason], [3, 2, 200, 'medium', 'still']);
      assert.deepEqual(settings(first), full);
      const shown = await picture(page);
      await page.evaluate(() => (a.autoRotate = true));
      await page.waitForFunction(() => window.events.some(({ pixelWidth }) => pixelWidth === 50));
      await page.screenshot({ path: join(screenshots, `element-moving-${technique}.png`) });
      const lessened = () => page.evaluate(async () => (await customElements.get('vitrine-viewer').statistics()).lessened);
      assert.deepEqual((await lessened()).map((one) => [one.pixelWidth < 200, one.reason]), [[true, 'frame-time']]);
      await page.evaluate(() => (a.autoRotate = false));
      await quiet(page);
      const scales = await events(page, 'render-scale');
      t.diagnostic(scales.map((one) => `${one.pixelWidth} px, ${one.preset}: ${settings(one)} (${one.reason})`).join('; '));
      assert.ok(scales.slice(1, -1).every(({ reason }) => reason === 'frame-time'));
      for (const one of scales) assert.deepEqual(settings(one), one.preset === 'low' ? least : full);
      assert.ok(scales.some(({ preset }) => preset === 'low'));
      const { pixelWidth, preset, reason } = scales.at(-1);
      assert.deepEqual([pixelWidth, preset, reason], [200, 'medium', 'still']);
      assert.deepEqual(await lessened(), []);
      await page.evaluate(() => a.resetView());
      await quiet(page);
      assert.equal(difference(shown, await picture(page)), 0);
      await page.evaluate(() => (a.quality = 'low'));
      await quiet(page);
      assert.equal((await events(page, 'render-scale')).at(-1).pixelWidth, 100);
    });
  }

  test('presets say what is not said', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="sphere" quality="high"></vitrine-viewer>');
    const shown = async (change) => {
      await page.evaluate((values) => Object.assign(a, values), change);
      await quiet(page);
      const { preset, layers, steps, maxEvents } = (await events(page, 'render-scale')).at(-1);
      return [preset, layers, steps, maxEvents];
    };
    assert.deepEqual(await shown({}), ['medium', 4, 50, 8]);
    assert.deepEqual(await shown({ preset: 'low' }), ['low', 2, 25, 4]);
    assert.deepEqual(await shown({ preset: 'high', maxEvents: 5 }), ['high', 8, 100, 5]);
    assert.deepEqual(await shown({ technique: 'layered', layers: 3 }), ['high', 3, 100, 5]);
    assert.deepEqual(await shown({ technique: null, preset: null, layers: null, maxEvents: null }), ['medium', 4, 50, 8]);
  });

  describe('a large model', () => {
    const large = torus(400, 150); // 120 000 triangles
    before(() => pages.set('/large.glb', { html: large, headers: { 'content-type': 'model/gltf-binary' } }));

    /** A page with a sphere; `act` is called after each slice of building what comes next, with the number of slices so far. */
    async function sliced(t, act) {
      const page = await open(t, `<vitrine-viewer id="a" src="sphere" skybox-image></vitrine-viewer>${ofSide}`);
      await page.evaluate(async (body) => {
        const { Viewer } = await import('/element/core.js');
        const { build } = Viewer.prototype;
        window.slices = 0;
        window.act = new Function('count', body);
        Viewer.prototype.build = function (milliseconds) {
          const isWhole = build.call(this, milliseconds);
          const count = ++window.slices;
          if (!isWhole && milliseconds < Infinity) setTimeout(() => window.act(count));
          return isWhole;
        };
      }, act);
      await page.evaluate(() => (a.src = '/large.glb'));
      return page;
    }
    const loads = async (page) => (await events(page, 'load')).length;

    test('is built in slices', async (t) => {
      const page = await sliced(t, '');
      await page.waitForFunction(() => a.loaded);
      await quiet(page);
      const slices = await page.evaluate(() => window.slices);
      t.diagnostic(`${slices} slices`);
      assert.ok(slices > 2, `${slices} slices`);
      writeFileSync(join(folder, 'large.glb'), large);
      const differing = difference(await picture(page), nativePicture('large.glb'));
      assert.ok(differing < 0.5, `${differing} % differ`);
    });

    test('gives way to one that comes while it is built', async (t) => {
      const page = await sliced(t, "if (count === 1) a.src = 'knot';");
      const before = await loads(page);
      await page.waitForFunction(() => window.slices > 0 && a.src === 'knot' && a.loaded);
      await quiet(page);
      assert.equal(await loads(page), before + 1, 'one of them is shown');
      const seen = await picture(page);
      assert.ok(difference(seen, nativePicture('knot')) < 0.5);
    });

    test('may lose its element while it is built', async (t) => {
      const page = await sliced(t, 'if (count === 1) { window.gone = a; a.remove(); }');
      await page.waitForFunction(() => window.gone);
      await quiet(page);
      assert.equal(await page.evaluate(() => gone.loaded), false);
      await page.evaluate(() => document.body.append(gone));
      await page.waitForFunction(() => a.loaded);
      await quiet(page);
      writeFileSync(join(folder, 'large.glb'), large);
      assert.ok(difference(await picture(page), nativePicture('large.glb')) < 0.5);
    });

    test('is whole for toBlob', async (t) => {
      const page = await sliced(t, 'if (count === 1) { window.isEarly = !a.loaded; window.url = a.toDataURL(); }');
      await page.waitForFunction(() => window.url);
      assert.equal(await page.evaluate(() => window.isEarly), true);
      const early = PNG.sync.read(Buffer.from((await page.evaluate(() => window.url)).split(',')[1], 'base64'));
      await quiet(page);
      assert.equal(difference(early, await picture(page)), 0);
      assert.equal((await events(page, 'load')).length, 2);
    });
  });

  test('waits for its shaders without asking', async (t) => {
    const init = () => {
      window.isHeld = true;
      window.asked = [];
      const type = WebGL2RenderingContext.prototype;
      const { getProgramParameter } = type;
      type.getProgramParameter = function (program, name) {
        if (window.isHeld) window.asked.push(name);
        return name === 0x91b1 && window.isHeld ? false : getProgramParameter.call(this, program, name);
      };
    };
    const page = await open(t, '<vitrine-viewer id="a" src="sphere"></vitrine-viewer>', { init, waits: false });
    if (await page.evaluate(() => document.createElement('canvas').getContext('webgl2').getExtension('KHR_parallel_shader_compile') === null)) {
      t.skip('this browser does not tell when shaders are ready');
      return;
    }
    await page.waitForFunction(() => window.asked.length > 5);
    assert.deepEqual(await page.evaluate(() => [...new Set(window.asked)]), [0x91b1]);
    assert.equal(await draws(page), 0);
    await page.evaluate(() => (window.isHeld = false));
    await page.waitForFunction(() => a.loaded);
    await quiet(page);
    assert.ok(await draws(page) > 0);
    // What was drawn before stays until other shaders are there.
    const seen = await shot(page);
    await page.evaluate(() => Object.assign(window, { isHeld: true, asked: [] }));
    await page.evaluate(() => (a.technique = 'single'));
    await page.waitForFunction(() => window.asked.length > 5);
    assert.equal(difference(seen, await shot(page)), 0);
    await page.evaluate(() => (window.isHeld = false));
    await quiet(page);
    assert.ok(difference(seen, await shot(page)) > 1);
  });

  test('a lost context comes back with its scene', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="/good.glb" environment-image="sky" camera-controls></vitrine-viewer><div class="far"></div>', { allowed: /CONTEXT_LOST/ });
    await page.focus('#a');
    await page.evaluate(() => a.shadowRoot.querySelector('.view').focus());
    await page.keyboard.press('ArrowLeft');
    await quiet(page);
    await page.evaluate(() => document.activeElement.blur());
    const first = await shot(page);
    requests.length = 0;
    await page.evaluate(() => {
      window.loss = window.counts.contexts.at(-1).deref().getExtension('WEBGL_lose_context');
      window.loss.loseContext();
    });
    await page.waitForFunction(() => window.events.some(({ type }) => type === 'webglcontextlost'));
    assert.match(await message(page), /context was lost/);
    await page.evaluate(() => (a.ior = 1.7)); // a change in the meantime is kept
    await page.evaluate(() => a.removeAttribute('ior'));
    await page.evaluate(() => window.loss.restoreContext());
    await page.waitForFunction(() => a.shadowRoot.querySelector('[part=message]').hidden);
    await quiet(page);
    assert.equal(difference(first, await shot(page)), 0);
    assert.deepEqual(requests, [], 'from the bytes that were kept');

    // Not given back: a new one once the element comes into view again.
    await page.evaluate(() => window.counts.contexts.at(-1).deref().getExtension('WEBGL_lose_context').loseContext());
    await page.waitForFunction(() => !a.shadowRoot.querySelector('[part=message]').hidden);
    await page.evaluate(() => scrollTo(0, 1000));
    await quiet(page);
    await page.evaluate(() => scrollTo(0, 0));
    await page.waitForFunction(() => a.shadowRoot.querySelector('[part=message]').hidden);
    await quiet(page);
    assert.equal(difference(first, await shot(page)), 0);
  });

  test('without WebGL 2 there is the poster and a sentence', async (t) => {
    const init = () => {
      const real = OffscreenCanvas.prototype.getContext;
      OffscreenCanvas.prototype.getContext = function (kind, ...rest) {
        return kind === 'webgl2' ? null : real.call(this, kind, ...rest);
      };
    };
    const page = await open(t, '<vitrine-viewer id="a" src="sphere" poster="/poster.png"></vitrine-viewer>', { init, waits: false });
    await page.waitForFunction(() => window.events.some(({ type }) => type === 'unsupported'));
    assert.match(await message(page), /WebGL 2/);
    await page.waitForFunction(() => a.shadowRoot.querySelector('img').naturalWidth > 0);
    assert.deepEqual(pixel(await shot(page), 80, 3), [250, 10, 200]);
    await page.locator('#a').screenshot({ path: join(screenshots, 'element-no-webgl.png') });
  });

  test('passes a strict Content Security Policy', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="/good.glb" poster="/poster.png" camera-controls auto-rotate></vitrine-viewer>',
      { headers: { 'content-security-policy': csp }, waits: false });
    await page.waitForFunction(() => document.querySelector('vitrine-viewer').loaded);
    assert.deepEqual(await page.evaluate(() => window.violations ?? []), []);
    assert.equal(await page.evaluate(() => getComputedStyle(document.querySelector('vitrine-viewer')).display), 'block', 'its sheet is in force');
  });

  test('axe-core finds nothing', { skip: !existsSync(axe) && 'axe-core is not installed' }, async (t) => {
    const page = await open(t, '<main><h1 style="color: white">Glass</h1><vitrine-viewer id="a" src="sphere" camera-controls alt="A sphere"></vitrine-viewer><vitrine-viewer src="torus" alt="A ring"></vitrine-viewer></main>');
    await page.addScriptTag({ path: axe });
    const found = await page.evaluate(async () => {
      const { violations, passes } = await window.axe.run();
      return { violations: violations.map(({ id, help }) => `${id}: ${help}`), passes: passes.length };
    });
    t.diagnostic(`${found.passes} rules passed`);
    assert.deepEqual(found.violations, []);
  });

  test('properties set before the class is there count', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a"></vitrine-viewer><script>a.src = "torus"; a.ior = 1.2</script>');
    assert.deepEqual(await page.evaluate(() => [a.getAttribute('src'), a.getAttribute('ior'), a.loaded]), ['torus', '1.2', true]);
  });

  test('properties reflect attributes', async (t) => {
    const page = await open(t, '<vitrine-viewer id="a" src="sphere" ior="1.4"></vitrine-viewer>');
    const seen = await page.evaluate(() => {
      const before = [a.ior, a.technique, a.cameraControls, a.layers];
      Object.assign(a, { ior: null, cameraControls: true, maxEvents: 3 });
      return [before, a.ior, a.hasAttribute('ior'), a.getAttribute('camera-controls'), a.getAttribute('max-events'), a.constructor.observedAttributes.length];
    });
    assert.deepEqual(seen, [[1.4, null, false, null], null, false, '', '3', 60]);
    const blob = await page.evaluate(async () => {
      const { type, size } = await a.toBlob({ mimeType: 'image/jpeg' });
      return [type, size > 1000];
    });
    assert.deepEqual(blob, ['image/jpeg', true]);
  });
});
