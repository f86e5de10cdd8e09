// Glass beside glass: what three.js's MeshPhysicalMaterial, drei's MeshTransmissionMaterial and MeshRefractionMaterial
// and Vitrine need for a frame of the same scene, and how right it is. Writes report.md, report.json, a picture of each
// and a sheet of all. Fails where browser and native program draw different paths. docs/benchmarks-web.md says what is
// measured and how.
//   node tests/bench/glass.mjs [--model FILE.glb] [--rounds N] [--gl llvmpipe|swiftshader|gpu] ...   (--help: all)
// Needs build/release, build/web and the packages of tests/; those of tests/bench/, which the peers need, are installed
// on first use.
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { basename, dirname, join, relative, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { answerWithFile, launch, listen, openPage } from '../browser-tools.mjs';
import { agreement, background, calibrate, cameraRays, decode, directionsHdr, pfm, readPfm, shares } from './glass-directions.mjs';
import { readOptions } from './glass-options.mjs';
import { insert, isPlain, markdown, median, sheet, techniqueOf } from './glass-report.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, '../..');

const leastAgreement = 0.99; // of browser and native program; measured: 1 on llvmpipe, exact 0.999 and layered 0.992 on SwiftShader

const vitrine = process.env.VITRINE_BINARY ?? join(root, 'build/release/vitrine');
const web = resolve(process.env.VITRINE_WEB ?? join(root, 'build/web'));

function note(text) {
  process.stderr.write(`${text}\n`);
}

function prepare({ model, environment, peers }) {
  for (const [file, remedy] of [
    [vitrine, 'cmake --preset release && cmake --build --preset release'],
    [join(web, 'vitrine-core.wasm'), 'scripts/build-web.sh'],
    [model, 'give --model, or run scripts/dependencies.sh and scripts/build-web.sh'],
    [environment, 'give --environment, or run scripts/dependencies.sh and scripts/build-web.sh'],
    [join(root, 'tests/node_modules/playwright-core'), 'scripts/dependencies.sh'],
  ]) {
    if (!existsSync(file)) throw new Error(`${file} is missing: ${remedy}`);
  }
  if (peers.length > 0 && !existsSync(join(here, 'node_modules/@react-three/drei'))) {
    note('installing the packages of tests/bench');
    const { status } = spawnSync('npm', ['--prefix', here, 'ci', '--no-audit', '--no-fund', '--loglevel=error'], { stdio: ['ignore', 2, 2] });
    if (status !== 0) throw new Error('npm ci failed in tests/bench');
  }
}

/** The native program; its standard output. */
function run(...words) {
  return execFileSync(vitrine, words, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
}

const packages = ['three', '@react-three/drei', '@react-three/fiber', 'three-mesh-bvh'];
const version = (name) => JSON.parse(readFileSync(join(here, `node_modules/${name}/package.json`), 'utf8')).version;

/** Serves the site, and `files` from elsewhere. */
function serveWith(site, files) {
  return listen((request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    const file = resolve(files[pathname] ?? join(site, pathname));
    answerWithFile(dirname(file), `/${basename(file)}`, response);
  });
}

/** Truth, by the native ray tracer, and each technique's directions, by the native program. */
function traceTruth({ model, environment, size, ior, camera, samples }, out) {
  const scene = ['--resolution', `${size},${size}`, '--camera', camera.eye.join(), '--target', camera.target.join(), '--fov', `${camera.fov}`,
    '--ior', `${ior}`, '--environment', environment];
  const file = (name) => join(out, name);
  run('render', model, ...scene, '--technique', 'reference', '--no-fresnel', '-o', file('reference.png'), '--directions', file('reference.pfm'), '--events', file('events.png'));
  run('render', model, ...scene, '--technique', 'reference', '--fresnel', '--samples', `${samples}`, '-o', file('reference-reflecting.png'));
  return {
    directionsOf(technique) {
      run('render', model, ...scene, '--technique', technique, '--no-fresnel', '-o', file('native.png'), '--directions', file(`${technique}.pfm`));
      rmSync(file('native.png'));
      return readPfm(readFileSync(file(`${technique}.pfm`)));
    },
  };
}

async function main() {
  const options = readOptions();
  prepare(options);
  const { build } = await import('esbuild');
  const { PNG } = (await import('pngjs')).default;
  const { out, size } = options;
  mkdirSync(out, { recursive: true });

  await build({
    entryPoints: [join(here, 'glass-page.js')], bundle: true, minify: true, format: 'esm', target: 'es2022', logLevel: 'error',
    outfile: join(out, 'site/page.js'), define: { 'process.env.NODE_ENV': '"production"' },
    alias: { 'vitrine-core': join(web, 'element/core.js') },
    external: options.peers.length > 0 ? [] : ['./glass-peers.js'], // never loaded: its packages may be absent
  });
  writeFileSync(join(out, 'site/index.html'), '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><script type="module" src="/page.js"></script>');
  writeFileSync(join(out, 'site/directions.hdr'), directionsHdr());
  const server = await serveWith(join(out, 'site'), {
    '/': join(out, 'site/index.html'), '/model.glb': options.model, '/environment.hdr': options.environment,
    '/vitrine-core.wasm': join(web, 'vitrine-core.wasm'), '/vitrine-shaders.txt': join(web, 'vitrine-shaders.txt'),
  });
  const environment = { ...process.env };
  if (options.gl === 'llvmpipe') environment.LIBGL_ALWAYS_SOFTWARE = '1';
  const browser = await launch(options.gl, { env: environment });
  try {
    const page = await openPage(browser, { viewport: { width: 900, height: 600 } });
    const complaints = [];
    page.on('console', (message) => {
      if (message.type() === 'error') complaints.push(message.text());
    });
    page.on('pageerror', (reason) => complaints.push(String(reason)));
    await page.goto(`${server.address}/`);
    await page.waitForFunction(() => window.bench !== undefined);
    const call = (name, ...values) => page.evaluate(([method, words]) => window.bench[method](...words), [name, values]);
    const shared = await call('open');
    note(`${shared.renderer}; ${basename(options.model)}, ${shared.triangles} triangles`);
    const target = options.target ?? shared.centre;
    const eye = options.eye ?? [0.36, 0.3, 3.05].map((value, k) => target[k] + value * shared.halfExtent);
    const camera = { eye, target, fov: options.fov };
    await call('place', { size, ior: options.ior, camera });

    note('tracing the truth');
    const scene = traceTruth({ ...options, camera }, out);
    const truth = readPfm(readFileSync(join(out, 'reference.pfm')));
    const eventsPicture = PNG.sync.read(readFileSync(join(out, 'events.png')));
    const events = Array.from({ length: size * size }, (_, i) => { // bottom row first, as in PFM
      const row = size - 1 - Math.floor(i / size);
      return eventsPicture.data[4 * (row * size + (i % size))];
    });
    const rays = cameraRays(size, camera);
    const judged = events.map((count) => count >= 1 && count <= 4);
    const flip = (picture, reference) => JSON.parse(run('compare', picture, reference, '--json')).flip;

    // Who takes part.
    const entries = [
      { kind: 'empty', name: 'empty' },
      ...options.peers.map((name) => ({ kind: 'peer', name })),
      ...options.techniques.map((name) => ({ kind: 'vitrine', name })),
    ];
    const absent = [];
    const contestants = [];
    for (const entry of entries) {
      entry.key = `${entry.kind}:${entry.name}`;
      const problem = await call('add', entry.kind, entry.name);
      if (problem) absent.push({ ...entry, problem });
      else contestants.push(entry);
      if (problem) note(`${entry.name} is left out: ${problem}`);
    }

    const save = (name, picture) => {
      const file = join(out, `${name}.png`);
      writeFileSync(file, Buffer.from(picture, 'base64'));
      return file;
    };

    // How right: the same physics for all, refraction without reflection.
    for (const entry of contestants.filter(({ kind }) => kind !== 'empty')) {
      const { key, name, kind } = entry;
      const isScreenSpace = kind === 'peer' && name !== 'refraction';
      const factors = [0.25, 0.5, 0.75, 1, 1.5]; // of the mean chord: what the light of this object passes through
      entry.tried = [];
      const thicknesses = isScreenSpace && options.thickness === null ? factors.map((factor) => factor * shared.meanChord) : [options.thickness ?? 0];
      for (const thickness of thicknesses) {
        const picture = await call('picture', key, { thickness, reflects: false, what: 'picture' });
        const found = flip(save(`${name}.try`, picture), join(out, 'reference.png'));
        entry.tried.push({ thickness, flip: found });
        if (entry.flip === undefined || found < entry.flip) {
          Object.assign(entry, { flip: found, thickness: isScreenSpace ? thickness : null });
          renameSync(join(out, `${name}.try.png`), join(out, `${name}.png`));
        }
      }
      rmSync(join(out, `${name}.try.png`), { force: true });
      const { thickness } = entry;
      if (kind === 'peer') {
        const floats = Buffer.from(await call('floats', key, { thickness, reflects: false, what: 'directions' }), 'base64');
        entry.directions = decode(new Float32Array(floats.buffer, floats.byteOffset, 4 * size * size));
        entry.calibration = calibrate(entry.directions, truth, rays, size);
        writeFileSync(join(out, `${name}.pfm`), pfm(entry.directions, size));
      } else {
        entry.directions = scene.directionsOf(techniqueOf(name));
        // The browser's picture of directions has 8 bits: enough to see that it is what the native program draws. Both
        // follow strict paths: a picture with Fresnel reflection mixes the colours of two directions.
        const seen = PNG.sync.read(Buffer.from(await call('picture', key, { reflects: false, what: 'directions' }), 'base64'));
        const inBrowser = decode(seen.data, size);
        const { share, count } = agreement(inBrowser, entry.directions, truth, judged, size);
        Object.assign(entry, { asNative: share, comparedPixels: count });
        entry.calibration = calibrate(inBrowser, truth, rays, size);
        if (!(share >= leastAgreement)) {
          throw new Error(`${name}: browser and native program agree in ${(100 * share).toFixed(1)} % of ${count} pixels, `
            + `but it must be ${100 * leastAgreement} %: build both from the same source; if they are, one of them draws wrong paths`);
        }
      }
      Object.assign(entry, shares(entry.directions, truth, judged));
      if (!isPlain(name)) {
        save(`${name}-reflecting`, await call('picture', key, { thickness, reflects: true, what: 'picture' }));
        entry.flipReflecting = flip(join(out, `${name}-reflecting.png`), join(out, 'reference-reflecting.png'));
      }
      note(`${name}: ${(100 * entry.within1).toFixed(1)} % within 1 degree, FLIP ${entry.flip.toFixed(3)}`);
    }
    if (complaints.length > 0) throw new Error(`the page complains: ${complaints.join('; ').slice(0, 2000)}`);

    // How fast: in turns, so that what else the machine does falls on all alike. First as each is by default, reflecting
    // its environment; then those that reflect without that.
    const time = async (entries, reflects) => {
      for (const { key, kind, thickness } of entries) {
        if (kind !== 'empty') await call('show', key, { thickness, reflects, what: 'picture' });
        for (let i = 0; i < 2; ++i) await call('time', key);
      }
      const times = entries.map(() => []);
      for (let round = 0; round < options.rounds; ++round) {
        for (const [i, { key }] of entries.entries()) times[i].push(await call('time', key));
        process.stderr.write('.');
      }
      process.stderr.write('\n');
      return times;
    };
    (await time(contestants, true)).forEach((times, i) => (contestants[i].times = times));
    const reflecting = contestants.filter(({ name }) => !['empty', 'refraction'].includes(name) && !isPlain(name));
    (await time(reflecting, false)).forEach((times, i) => (reflecting[i].plainMilliseconds = median(times)));

    const base = contestants.find(({ name }) => name === 'physical');
    const rows = contestants.map(({ kind, name, times, directions, key, ...rest }) => ({
      kind, name, milliseconds: median(times), fastest: Math.min(...times), slowest: Math.max(...times),
      ratio: base ? median(times) / median(base.times) : null, ...rest,
    }));
    const report = {
      date: new Date().toISOString().slice(0, 10),
      renderer: shared.renderer, browser: browser.version(), processors: cpus().length, processor: cpus()[0]?.model ?? '',
      threads: process.env.LP_NUM_THREADS ?? null,
      model: basename(options.model), triangles: shared.triangles, normals: shared.hasNormals ? 'of the file' : 'computed',
      environment: basename(options.environment), size, rounds: options.rounds, ior: options.ior, camera, samples: options.samples,
      meanChord: shared.meanChord, thicknessGiven: options.thickness !== null,
      versions: options.peers.length > 0 ? Object.fromEntries(packages.map((name) => [name, version(name)])) : {},
      judgedPixels: judged.filter(Boolean).length, background: background(truth) / (size * size),
      contestants: rows, absent: absent.map(({ kind, name, problem }) => ({ kind, name, problem })),
    };
    writeFileSync(join(out, 'report.json'), `${JSON.stringify(report, null, 2)}\n`);
    writeFileSync(join(out, 'report.md'), markdown(report));
    if (options.into) writeFileSync(options.into, insert(readFileSync(options.into, 'utf8'), report));
    await sheet(browser, report, out);
    console.log(markdown(report));
    note(`written to ${relative(process.cwd(), out) || '.'}`);
  } finally {
    await browser.close();
    server.close();
  }
}

main().catch((reason) => {
  console.error(`bench: ${reason.message}`);
  process.exitCode = 1;
});
