// Glass beside glass: what three.js's MeshPhysicalMaterial, drei's MeshTransmissionMaterial and MeshRefractionMaterial
// and Vitrine need for a frame of the same scene, and how right it is. Writes report.md, report.json, a picture of each
// and a sheet of all. Fails where browser and native program draw different paths. docs/benchmarks-web.md says what is
// measured and how.
//   node tests/bench/glass.mjs [--model FILE.glb] [--rounds N] [--gl llvmpipe|swiftshader|gpu] ...   (--help: all)
// Needs build/release, build/web and the packages of tests/; those of tests/bench/, which the peers need, are installed
// on first use.
import { mkdirSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { basename, join, relative } from 'node:path';
import { agreement, background, calibrate, cameraRays, decode, pfm, readPfm, shares } from './glass-directions.mjs';
import { readOptions } from './glass-options.mjs';
import { insert, isPlain, markdown, median, sheet, techniqueOf } from './glass-report.mjs';
import { flip, note, openSite, prepare, run, timeInTurns, versions } from './glass-site.mjs';

const leastAgreement = 0.99; // of browser and native program; measured: 1 on llvmpipe, exact 0.999 and layered 0.992 on SwiftShader

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
  const { PNG } = (await import('pngjs')).default;
  const { out, size } = options;
  mkdirSync(out, { recursive: true });

  const { browser, call, complaints, close } = await openSite(options);
  try {
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
      }
      return timeInTurns(call, entries.map(({ key }) => key), options.rounds);
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
      versions: options.peers.length > 0 ? versions() : {},
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
    await close();
  }
}

main().catch((reason) => {
  console.error(`bench: ${reason.message}`);
  process.exitCode = 1;
});
