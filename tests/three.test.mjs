// vitrine-viewer/three in headless Chromium on llvmpipe: glass in scenes of three.js's, of its newest version and of 0.180.
// Needs what element.test.mjs needs; skips itself likewise.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { gltf, glb } from '../scripts/glb.mjs';
import { answerWithFile, chromiumPath, launch, listen, openPage, skipWithout } from './browser-tools.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const site = resolve(process.env.VITRINE_WEB ?? join(here, '../build/web'));
const binary = resolve(process.env.VITRINE_BINARY ?? join(here, '../build/release/vitrine'));
const screenshots = join(here, '../build/screenshots');
const skip = skipWithout(
  [existsSync(join(here, 'node_modules/three-0.180')), "node modules (run 'npm ci' in tests/)"],
  [existsSync(join(site, 'vitrine-three.wasm')), `${site}/vitrine-three.wasm`],
  [existsSync(chromiumPath), chromiumPath],
);

const folders = { site, npm: join(here, 'node_modules'), tests: join(here, 'three') };

/** A page with the modules of that folder's three.js. */
const html = (three, script) => `<!doctype html><link rel="icon" href="data:,"><body>
<script type="importmap">{"imports":{"three":"/npm/${three}/build/three.module.js","three/addons/":"/npm/${three}/examples/jsm/"}}</script>
<script type="module" src="${script}"></script>`;

describe('glass in three.js', { skip }, () => {
  let browser, server, page;
  const problems = [], scripts = new Map(); // of pages, made here

  before(async () => {
    server = await listen((request, response) => {
      const { pathname, searchParams } = new URL(request.url, 'http://localhost');
      const [, folder, path] = pathname.match(/^\/(\w+)(\/.*)$/) ?? [];
      if (folders[folder]) answerWithFile(folders[folder], path, response);
      else if (scripts.has(pathname)) response.writeHead(200, { 'content-type': 'text/javascript' }).end(scripts.get(pathname));
      else if (pathname === '/') response.writeHead(200, { 'content-type': 'text/html' }).end(html(searchParams.get('three'), searchParams.get('script')));
      else response.writeHead(404).end();
    });
    browser = await launch();
    page = await openThree('three');
  });
  after(async () => {
    await browser?.close();
    server?.close();
  });

  async function openThree(three, script = '/tests/page.js') {
    const opened = await openPage(browser, { viewport: { width: 640, height: 480 } });
    opened.on('pageerror', ({ message }) => problems.push(message));
    opened.on('console', (message) => message.type() === 'error' && problems.push(message.text()));
    await opened.goto(`${server.address}/?three=${three}&script=${script}`);
    await opened.waitForFunction(() => window.isReady);
    return opened;
  }

  /** Runs in the page, and looks that nothing went wrong in it. */
  async function inPage(act, argument, where = page) {
    const answer = await where.evaluate(act, argument);
    assert.deepEqual(problems.splice(0), []);
    return answer;
  }

  for (const three of ['three', 'three-0.180']) {
    test(`a ball bends light as Snell has it, surroundings turned as three.js turns them (${three})`, async () => {
      const where = three === 'three' ? page : await openThree(three);
      const ways = await inPage(() => measureBall([[0, 0, 0], [0.4, 1, 0.3]]), null, where);
      for (const { pixels, off, besides, besidesOff, error } of ways) {
        assert.ok(pixels > 5000 && off <= 0.01 * pixels, `${off} of ${pixels} directions differ by more than 1 degree`);
        assert.ok(besides > 5000 && besidesOff === 0, 'beside the ball three.js shows the same surroundings');
        assert.equal(error, 0);
      }
      if (where !== page) await where.context().close();
    });
  }

  for (const camera of ['orthographic', 'off its axis']) {
    test(`a ball bends light as Snell has it for a camera that is ${camera}`, async () => {
      const [{ pixels, off, error }] = await inPage((seenBy) => measureBall([[0, 0, 0]], seenBy), camera);
      assert.ok(pixels > 3000 && off <= 0.01 * pixels, `${off} of ${pixels} directions differ by more than 1 degree`);
      assert.equal(error, 0);
    });
  }

  test('maps: each half of a pane transmits, blurs and bends as its row of the picture says', async () => {
    const { plain, transmission, roughness, normal, flat } = await inPage(async () => ({
      plain: await measureMaps({}),
      transmission: await measureMaps({ transmissionMap: rowsTexture([255, 255, 255], [0, 0, 0]) }),
      roughness: await measureMaps({ roughnessMap: rowsTexture([0, 0, 0], [0, 255, 0]) }, { roughness: 0.5 }),
      normal: await measureMaps({ normalMap: rowsTexture([128, 128, 255], [180, 128, 244]) }),
      flat: await measureMaps({ normalMap: rowsTexture([128, 128, 255], [128, 128, 255]) }),
    }));
    for (const { notes } of [plain, transmission, roughness, normal, flat]) assert.deepEqual(notes, []);
    const [lower, upper] = plain.halves;
    for (const half of plain.halves) assert.ok(half.bright > 230 && half.steepest > 150, JSON.stringify(plain));
    assert.ok(transmission.halves[0].bright > 230 && transmission.halves[1].bright < 30, JSON.stringify(transmission));
    assert.ok(roughness.halves[0].steepest > 150 && roughness.halves[1].steepest < 80, JSON.stringify(roughness));
    assert.deepEqual(flat.halves.map(({ edge }) => edge), [lower.edge, upper.edge], 'a normal map that says nothing');
    assert.equal(normal.halves[0].edge, lower.edge);
    assert.ok(Math.abs(normal.halves[1].edge - upper.edge) >= 2, `${JSON.stringify(normal)}: tilted normals move what is behind`);
  });

  test('a knot bends light as the program draws it', { skip: skipWithout([existsSync(binary), binary]) }, async (context) => {
    const { positions, indices, seen, eye } = await inPage(() => traceKnot());
    const folder = mkdtempSync(join(tmpdir(), 'vitrine-three-'));
    writeFileSync(join(folder, 'knot.glb'), glb(gltf({ positions, indices, ior: 1.5 })));
    const ran = spawnSync(binary, ['render', join(folder, 'knot.glb'), '--directions', join(folder, 'knot.pfm'), '-o', join(folder, 'knot.png'),
      '-r', '128,128', '--camera', eye.join(), '--target', '0,0,0', '--fov', '40', '--no-fresnel']);
    assert.equal(ran.status, 0, ran.stderr.toString());
    const bytes = readFileSync(join(folder, 'knot.pfm'));
    rmSync(folder, { recursive: true });
    const wanted = new Float32Array(bytes.buffer.slice(bytes.byteOffset + bytes.length - 4 * 3 * 128 * 128, bytes.byteOffset + bytes.length)); // lowest row first
    let pixels = 0, near = 0;
    for (let i = 0; i < 128 * 128; ++i) {
      const [a, b] = [wanted.subarray(3 * i, 3 * i + 3), seen.slice(4 * i, 4 * i + 3)];
      if (Math.abs(Math.hypot(...a) - 1) > 0.01) continue; // background, or lost
      ++pixels;
      near += (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / Math.hypot(...b) > Math.cos(Math.PI / 180) ? 1 : 0;
    }
    context.diagnostic(`${near} of ${pixels} within 1 degree`);
    assert.ok(pixels > 3000 && near >= 0.99 * pixels, `${near} of ${pixels} directions within 1 degree`);
  });

  test('a scene: post before the glass, ring through it, floor seen in it; three.js goes on as before', async () => {
    const { before: plain, glassy, after: again, bare, glInError, picture } = await inPage(async () => {
      const { scene, add } = makeScene(), renderer = makeRenderer(), camera = makeCamera();
      scene.environment = new THREE.PMREMGenerator(renderer).fromScene(new RoomEnvironment(), 0.04).texture;
      renderer.render(scene, camera);
      const without = pixelsOf(renderer);
      const knot = add(new THREE.TorusKnotGeometry(0.5, 0.2, 200, 32), glassMaterial(), 0, 0, 0);
      knot.castShadow = false;
      renderer.render(scene, camera);
      const own = pixelsOf(renderer);
      const glass = await createGlass(renderer);
      await glass.compileAsync(scene, camera);
      const ours = pixelsOf(renderer), image = renderer.domElement.toDataURL();
      scene.remove(knot);
      renderer.render(scene, camera);
      const then = pixelsOf(renderer), error = renderer.getContext().getError();
      glass.dispose();
      const at = (pixels, x, y) => [...pixels.subarray(4 * (192 * y + x), 4 * (192 * y + x) + 3)];
      const differ = (a, b) => a.reduce((count, value, i) => count + (i % 4 === 0 && value !== b[i]), 0);
      return {
        before: [at(without, 107, 100), at(ours, 107, 100)], glassy: differ(ours, without), bare: differ(ours, own),
        after: differ(then, without), glInError: error, picture: image,
      };
    });
    mkdirSync(screenshots, { recursive: true });
    writeFileSync(join(screenshots, 'three.png'), Buffer.from(picture.split(',')[1], 'base64'));
    plain[0].forEach((value, i) => assert.ok(Math.abs(value - plain[1][i]) <= 2, `the post hides the glass: ${plain}`));
    assert.ok(glassy > 2000 && bare > 1500, `${glassy} pixels show glass, ${bare} of them otherwise than three.js`);
    assert.equal(again, 0, 'what three.js draws afterwards');
    assert.equal(glInError, 0);
  });

  test('glass without surroundings of its own, of index 1, is not seen', async () => {
    const most = await inPage(async () => {
      const { scene, add } = makeScene(), renderer = makeRenderer(), camera = makeCamera();
      const glass = await createGlass(renderer, { fresnel: false });
      const knot = add(new THREE.TorusKnotGeometry(0.4, 0.15, 100, 16), glassMaterial({ ior: 1.0001 }), 0.2, 0.2, -0.3);
      knot.castShadow = false;
      await glass.compileAsync(scene, camera);
      const ours = pixelsOf(renderer);
      scene.remove(knot);
      const ball = add(new THREE.SphereGeometry(0.01, 8, 4), glassMaterial(), 90, 0, 0); // so that all goes the same way
      glass.render(scene, camera);
      const without = pixelsOf(renderer);
      ball.geometry.dispose();
      glass.dispose();
      let off = 0;
      for (let i = 0; i < ours.length; i += 4) off += Math.abs(ours[i] - without[i]) > 16 ? 1 : 0;
      return off;
    });
    assert.ok(most < 0.01 * 192 * 192, `${most} pixels differ`);
  });

  test('tones, colour space and targets are three.js\'s own', async () => {
    const off = await inPage(async () => {
      const { scene, add } = makeScene(), renderer = makeRenderer(), camera = makeCamera();
      scene.background = null;
      add(new THREE.SphereGeometry(0.01, 8, 4), glassMaterial(), 90, 0, 0);
      const glass = await createGlass(renderer);
      renderer.toneMapping = THREE.ACESFilmicToneMapping;
      renderer.toneMappingExposure = 0.7;
      await glass.compileAsync(scene, camera);
      const both = () => {
        glass.render(scene, camera);
        const ours = pixelsOf(renderer);
        renderer.render(scene, camera);
        return [ours, pixelsOf(renderer)];
      };
      const [ours, own] = both(), background = new THREE.Color(0x80a0c0);
      const behind = [background, null].map((color) => {
        scene.background = color;
        if (!color) renderer.setClearColor(background, 0.5);
        return both();
      });
      const isKept = scene.background === null && renderer.getClearColor(new THREE.Color()).equals(background) && renderer.getClearAlpha() === 0.5;
      const { length } = glass.notes;
      scene.background = Object.assign(new THREE.DataTexture(new Uint8Array([255, 0, 0, 255]), 1, 1), { colorSpace: THREE.SRGBColorSpace, needsUpdate: true });
      glass.render(scene, camera);
      const told = glass.notes.slice(length);
      scene.background = null;
      renderer.setClearColor(0x000000, 1);
      const target = new THREE.WebGLRenderTarget(64, 64, { type: THREE.HalfFloatType, samples: 4 });
      const readTarget = (draw) => {
        const numbers = new Uint16Array(4 * 64 * 64);
        renderer.setRenderTarget(target);
        draw();
        renderer.readRenderTargetPixels(target, 0, 0, 64, 64, numbers);
        return [renderer.getRenderTarget() === target, ...[...numbers].map(THREE.DataUtils.fromHalfFloat)];
      };
      const [stays, ...oursInTarget] = readTarget(() => glass.render(scene, camera));
      const [, ...ownInTarget] = readTarget(() => renderer.render(scene, camera));
      renderer.setRenderTarget(null);
      const composer = new EffectComposer(renderer);
      composer.addPass(Object.assign(new Pass(), { needsSwap: false, render: (one, to, from) => (one.setRenderTarget(from), glass.render(scene, camera)) }));
      composer.addPass(new OutputPass());
      composer.render();
      const composed = pixelsOf(renderer);
      glass.dispose();
      const inside = (a, b, most) => a.reduce((count, value, i) => count + (Math.abs(value - b[i]) > most), 0) / a.length;
      return {
        canvas: inside([...ours], own, 6), composed: inside([...ours], composed, 4), target: inside(oursInTarget, ownInTarget, 0.05),
        behind: behind.map(([one, other]) => inside([...one], other, 2)), told, stays: stays && isKept,
      };
    });
    assert.ok(off.canvas < 0.02, `${off.canvas} of the canvas`); // its edges: three.js maps tones of each sample there
    for (const share of off.behind) assert.ok(share < 0.02, `${share} of the canvas before a colour`);
    assert.deepEqual(off.told, ['scene.background is an sRGB picture; its tones are mapped, too']);
    assert.ok(off.target < 0.02, `${off.target} of the target`);
    assert.ok(off.composed < 0.001, `${off.composed} of what EffectComposer shows`);
    assert.ok(off.stays);
  });

  test('what moves is followed, what is disposed goes, and nothing piles up', async () => {
    const { moved, kept, heap, memory, gone, ways } = await inPage(async () => {
      const { scene, add } = makeScene(), renderer = makeRenderer({ side: 48 }), camera = makeCamera();
      const glass = await createGlass(renderer, { preset: 'low' });
      const ball = add(new THREE.SphereGeometry(0.6, 24, 12), glassMaterial(), 0, 0, 0);
      await glass.compileAsync(scene, camera);
      const look = () => (glass.render(scene, camera), pixelsOf(renderer).join());
      const seen = [look()];
      const positions = ball.geometry.attributes.position;
      for (let i = 0; i < positions.count; ++i) positions.setY(i, 1.4 * positions.getY(i));
      positions.needsUpdate = true;
      seen.push(look());
      ball.visible = false;
      seen.push(look());
      ball.visible = true;
      ball.layers.set(3);
      const hidden = look() === seen[2];
      ball.layers.set(0);
      const back = look() === seen[1];
      const measure = () => ({ ...renderer.info.memory, programs: renderer.info.programs.length, heap: glass.statistics.heapBytes });
      for (let i = 0; i < 20; ++i) look();
      const first = measure();
      for (let i = 0; i < 980; ++i) {
        ball.rotation.y += 0.01;
        if (i % 10 === 0) positions.needsUpdate = true;
        glass.render(scene, camera);
        if (i % 50 === 0) await new Promise(requestAnimationFrame);
      }
      const last = measure();
      ball.geometry.dispose();
      const after = glass.statistics.geometries;
      glass.dispose();
      return { moved: new Set(seen).size, kept: [hidden, back], heap: [first.heap, last.heap], memory: [first, last], gone: after, ways: renderer.getContext().getError() };
    });
    assert.equal(moved, 3);
    assert.deepEqual(kept, [true, true]);
    assert.equal(heap[1], heap[0]);
    assert.deepEqual(memory[1], memory[0]);
    assert.equal(gone, 0);
    assert.equal(ways, 0);
  });

  test('bones, morph targets, instances and groups are where three.js draws them', async () => {
    const shares = await inPage(async () => {
      const renderer = makeRenderer({ side: 96 }), camera = makeCamera(), glass = await createGlass(renderer);
      const answer = {}, { now } = performance;
      let time = 0;
      performance.now = () => (time += 5); // a piece of geometry is built in each frame
      for (const [name, make] of Object.entries(movingMeshes)) {
        const scene = new THREE.Scene();
        scene.background = new THREE.Color(0x000000);
        const mesh = make(glassMaterial({ emissive: 0xffffff, thickness: 1 }));
        scene.add(mesh);
        glass.render(scene, camera);
        const early = pixelsOf(renderer);
        await glass.compileAsync(scene, camera);
        const ours = pixelsOf(renderer);
        const flat = new THREE.MeshBasicMaterial();
        mesh.material = Array.isArray(mesh.material) ? mesh.material.map(() => flat) : flat;
        renderer.render(scene, camera);
        const own = pixelsOf(renderer);
        for (const [when, seen] of [['', ours], [' at once', early]]) {
          let both = 0, either = 0;
          for (let i = 0; i < seen.length; i += 4) {
            const [a, b] = [seen[i] > 60, own[i] > 60];
            both += a && b;
            either += a || b;
          }
          answer[name + when] = either > 300 ? both / either : 0;
        }
      }
      Object.assign(performance, { now });
      answer.error = renderer.getContext().getError();
      glass.dispose();
      return answer;
    });
    assert.equal(shares.error, 0);
    delete shares.error;
    for (const [name, share] of Object.entries(shares)) assert.ok(share > 0.97, `${name}: ${share} of the silhouettes agree`);
  });

  test('frosted glass sees the scene blurred; a marked mesh is seen though it is off the picture', async () => {
    const { rough, behind } = await inPage(async () => {
      const camera = makeCamera();
      camera.position.set(0, 0, 4);
      camera.lookAt(0, 0, 0);
      const renderer = makeRenderer({ side: 96 }), scene = new THREE.Scene();
      scene.background = new THREE.Color(0x000000);
      const wall = new THREE.Mesh(new THREE.PlaneGeometry(1, 6), new THREE.MeshBasicMaterial({ color: 0xffffff }));
      wall.position.set(0.5, 0, -2);
      const pane = new THREE.Mesh(new THREE.BoxGeometry(2, 2, 0.1), glassMaterial({ ior: 1.3 }));
      scene.add(wall, pane);
      const glass = await createGlass(renderer);
      const steepest = async (roughness) => {
        pane.material.roughness = roughness;
        await glass.compileAsync(scene, camera);
        const row = pixelsOf(renderer).subarray(4 * 96 * 48, 4 * 96 * 49);
        let most = 0;
        for (let x = 30; x < 66; ++x) most = Math.max(most, Math.abs(row[4 * x] - row[4 * x - 4]));
        return most;
      };
      const answers = { rough: [await steepest(0), await steepest(0.5)] };
      const box = new THREE.Mesh(new THREE.BoxGeometry(6, 6, 1), new THREE.MeshBasicMaterial({ color: 0xff0000 })); // behind the eye
      box.position.z = 8;
      const ball = new THREE.Mesh(new THREE.SphereGeometry(1, 48, 24), glassMaterial({ ior: 1.5 }));
      scene.remove(wall, pane);
      scene.add(ball, box);
      const reds = async () => {
        await glass.compileAsync(scene, camera);
        const pixels = pixelsOf(renderer);
        return pixels.reduce((count, value, i) => count + (i % 4 === 0 && value > 20), 0);
      };
      const before = await reds();
      box.userData.glass = 'exact';
      answers.behind = [before, await reds()];
      glass.dispose();
      return answers;
    });
    assert.ok(rough[0] > 150 && rough[1] < 60, `steps of ${rough}`);
    assert.ok(behind[0] === 0 && behind[1] > 100, `${behind} red pixels`);
  });

  test('sentences: another renderer, depth buffers, options, a lost context, after dispose', async () => {
    const { sentences, drawn } = await inPage(async () => {
      const tell = async (act) => {
        try {
          await act();
          return '';
        } catch ({ message }) {
          return message;
        }
      };
      const { scene, add } = makeScene(), renderer = makeRenderer({ side: 48 }), camera = makeCamera();
      add(new THREE.SphereGeometry(0.6, 24, 12), glassMaterial(), 0, 0, 0);
      const glass = await createGlass(renderer);
      await glass.compileAsync(scene, camera);
      const before = pixelsOf(renderer).join();
      const { domElement } = renderer, event = (name) => new Promise((done) => domElement.addEventListener(name, done, { once: true }));
      const lost = event('webglcontextlost');
      renderer.forceContextLoss();
      await lost;
      const during = glass.render(scene, camera), late = await tell(() => createGlass(renderer));
      const restored = event('webglcontextrestored');
      await new Promise((done) => setTimeout(done)); // the loss has been told to all
      renderer.forceContextRestore();
      await restored;
      await glass.compileAsync(scene, camera);
      const again = pixelsOf(renderer).join() === before;
      glass.dispose();
      const logarithmic = makeRenderer({ side: 8, logarithmicDepthBuffer: true });
      return {
        sentences: [
          await tell(() => createGlass({ isWebGPURenderer: true })), await tell(() => createGlass({})), await tell(() => createGlass(logarithmic)),
          await tell(() => createGlass(renderer, { samples: 0 })), await tell(() => createGlass(renderer, { preset: 'best' })), late, await tell(() => glass.render(scene, camera)),
        ],
        drawn: [during, again],
      };
    }).catch((reason) => ({ sentences: [reason.message], drawn: [] }));
    const wanted = [/WebGPURenderer .* use WebGLRenderer/, /a WebGLRenderer/, /has a logarithmicDepthBuffer, .* create it without/, /samples is 0; .* from 1 to 4096/, /preset is 'best'; .* low, medium, high/, /is lost; call it again/, /was disposed; createGlass/];
    wanted.forEach((pattern, i) => assert.match(sentences[i] ?? '', pattern));
    assert.deepEqual(drawn, [false, true]);
  });

  test('<Glass> of React Three Fiber draws the frames of a canvas', async () => {
    const { build } = await import('esbuild');
    const { outputFiles } = await build({
      entryPoints: [join(here, 'three/fiber.js')], bundle: true, write: false, format: 'esm', logLevel: 'error', nodePaths: [join(here, 'node_modules')],
      external: ['three'], alias: { 'vitrine-viewer/fiber': join(site, 'three/fiber.js') }, define: { 'process.env.NODE_ENV': '"production"' },
    });
    scripts.set('/fiber.js', outputFiles[0].text);
    const fiber = await openThree('three', '/fiber.js');
    await fiber.waitForFunction(() => window.problem || (window.glass?.statistics.objects === 1 && !window.glass.isWaiting));
    const { problem, notes, objects } = await inPage(() => ({ problem: window.problem ?? '', notes: window.glass?.notes, objects: window.glass?.statistics.objects }), null, fiber);
    assert.equal(problem, '');
    assert.deepEqual([notes, objects], [[], 1]);
    await fiber.context().close();
  });
});
