// Rough glass, glass that disperses, and caustics, beside three.js's MeshPhysicalMaterial and drei's
// MeshTransmissionMaterial and Caustics: FLIP to the reference, and time. docs/benchmarks-web.md says how.
//   node tests/bench/effects.mjs [--size N] [--rounds N] [--samples N] [--only rough,dispersion,caustics] [--peers physical,transmission] [--into FILE.md]
// Needs what glass.mjs needs.
import { mkdirSync, readFileSync, rmSync, renameSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { Body, add, cross, lathe, scale, unit } from '../../scripts/bodies.mjs';
import { glb, gltf } from '../../scripts/glb.mjs';
import { median } from './glass-report.mjs';
import { flip, note, openSite, prepare, root, run, timeInTurns, versions } from './glass-site.mjs';

/** A trefoil of a round rod, on a torus of radii 0.62 and 0.28. */
function knot() {
  const around = 320, section = 40;
  const torus = (t) => {
    const wide = 0.62 + 0.28 * Math.cos(3 * t);
    return [wide * Math.cos(2 * t), wide * Math.sin(2 * t), 0.28 * Math.sin(3 * t)];
  };
  return new Body().grid(around, section, (row, column) => {
    const t = (2 * Math.PI * (row % around)) / around, turn = (-2 * Math.PI * (column % section)) / section;
    const forward = unit(add(torus(t + 1e-4), scale(torus(t - 1e-4), -1)));
    const out = [Math.cos(3 * t) * Math.cos(2 * t), Math.cos(3 * t) * Math.sin(2 * t), Math.sin(3 * t)]; // of the torus
    const right = unit(cross(forward, out)), up = cross(right, forward);
    return add(torus(t), add(scale(right, 0.13 * Math.cos(turn)), scale(up, 0.13 * Math.sin(turn))));
  });
}

/** The built-in shape's profile, from its source. */
function goblet() {
  const source = readFileSync(join(root, 'src/shapes/shape_lathe.c'), 'utf8');
  const [, table] = /bool vtBuildGoblet[\s\S]*?\{\n([\s\S]*?)\n {4}\};/.exec(source);
  const points = [...table.matchAll(/\{(-?[\d.]+), (-?[\d.]+)\}/g)].map(([, radius, height]) => [Number(radius), Number(height) - 1.001]);
  return lathe(points, 96, 4);
}

function sphere() {
  return new Body().grid(64, 128, (row, column) => {
    const down = (Math.PI * row) / 64, turn = (-2 * Math.PI * (column % 128)) / 128;
    return [Math.sin(down) * Math.cos(turn), -Math.cos(down), Math.sin(down) * Math.sin(turn)];
  });
}

const bodies = { knot, goblet, sphere };
const view = { eye: [0.36, 0.3, 3.05], target: [0, 0, 0], fov: 45 };
const lit = { color: [0.12, 0.12, 0.12], sun: [-0.6, 0.9, -0.2], size: 1, light: [8, 8, 8] };
const cases = [
  { effect: 'rough', title: 'roughness 0.3', body: 'knot', roughness: 0.3 },
  { effect: 'rough', title: 'roughness 0.3', body: 'goblet', roughness: 0.3 },
  { effect: 'dispersion', title: 'dispersion 2', body: 'knot', dispersion: 2 },
  { effect: 'dispersion', title: 'dispersion 2', body: 'goblet', dispersion: 2 },
  { effect: 'caustics', title: 'ground', body: 'sphere', lit, camera: { eye: [1.5, 4.5, 6], target: [0.4, -0.4, 0.1], fov: 36 } },
  { effect: 'caustics', title: 'ground', body: 'goblet', lit, camera: { eye: [1.2, 3, 4], target: [0.35, -0.3, 0.1], fov: 34 } },
];
const titles = { physical: 'three.js MeshPhysicalMaterial', transmission: 'drei MeshTransmissionMaterial', exact: 'Vitrine exact' };

/** The words of the native program for a case. */
function wordsOf({ roughness, dispersion, lit: light, camera = view }, { model, environment, size }) {
  const words = [model, '-r', `${size},${size}`, '-e', environment, '--ior', '1.5', '--camera', camera.eye.join(), '--target', camera.target.join(), '--fov', `${camera.fov}`];
  if (roughness) words.push('--roughness', `${roughness}`);
  if (dispersion) words.push('--dispersion', `${dispersion}`);
  if (light) words.push('--ground', '--ground-color', light.color.join(), '--sun', [...light.sun, light.size, ...light.light].join());
  return words;
}

/** One case: rows of who drew it, how far from the reference, and how long. */
async function measure(one, options, folder) {
  const model = join(folder, 'model.glb'), { environment, size, samples, rounds } = options;
  writeFileSync(model, glb(gltf(bodies[one.body]())));
  const reference = join(folder, 'reference.png');
  run('render', ...wordsOf(one, { model, environment, size }), '-t', 'reference', '--samples', `${samples}`, '-o', reference);
  const { peers } = options;
  const { call, complaints, close } = await openSite({ out: folder, model, environment, gl: options.gl, peers });
  try {
    const shared = await call('open', one.lit !== undefined);
    const { lit: light } = one, low = shared.low;
    const ground = light && [1, 1, 0, 1, ...light.color, ...light.sun, light.size, ...light.light];
    await call('place', { size, ior: 1.5, camera: one.camera ?? view, roughness: one.roughness, dispersion: one.dispersion, ground, stage: light && { low, ...light } });
    const rows = [];
    for (const name of [...peers, 'exact']) {
      const isPeer = name !== 'exact', key = `${isPeer ? 'peer' : 'vitrine'}:${name}`;
      const problem = await call('add', isPeer ? 'peer' : 'vitrine', name);
      if (problem) throw new Error(`${name}: ${problem}`);
      const tries = [];
      for (const factor of !isPeer ? [0] : light ? [1] : [0.25, 0.5, 0.75, 1, 1.5]) { // of the mean chord
        for (const intensity of isPeer && light ? [0.02, 0.05, 0.1, 0.2, 0.5] : [0]) tries.push({ thickness: factor * shared.meanChord, intensity });
      }
      const row = { name, key };
      const draw = async (settings, file) => {
        writeFileSync(file, Buffer.from(await call('picture', key, { reflects: true, what: 'picture', ...settings }), 'base64'));
        return flip(file, reference);
      };
      for (const settings of tries) {
        const trial = join(folder, 'try.png'), found = await draw(settings, trial);
        if (row.flip === undefined || found < row.flip) {
          Object.assign(row, { flip: found, settings });
          renameSync(trial, join(folder, `${name}.png`));
        }
      }
      rmSync(join(folder, 'try.png'), { force: true });
      if (!isPeer) row.still = await draw({ samples: 64 }, join(folder, `${name}-64.png`));
      await call('show', key, { reflects: true, what: 'picture', ...row.settings, samples: 1 });
      note(`${one.body}, ${one.title}: ${name} FLIP ${row.flip.toFixed(3)}${row.still === undefined ? '' : `, 64 samples ${row.still.toFixed(3)}`}`);
      rows.push(row);
    }
    if (complaints.length > 0) throw new Error(`the page complains: ${complaints.join('; ').slice(0, 2000)}`);
    const times = await timeInTurns(call, rows.map(({ key }) => key), rounds);
    rows.forEach((row, i) => (row.milliseconds = median(times[i])));
    return { renderer: shared.renderer, rows };
  } finally {
    await close();
  }
}

async function main() {
  const text = (value) => ({ type: 'string', default: value });
  const { values } = parseArgs({ options: {
    size: text('192'), rounds: text('7'), samples: text('256'), only: text('rough,dispersion,caustics'), peers: text('physical,transmission'), gl: text('llvmpipe'), into: text(''),
    out: text(join(root, 'build/bench/effects')), environment: text(join(root, 'build/web/demo/assets/city.hdr')),
  } });
  const options = { ...values, size: Number(values.size), rounds: Number(values.rounds), samples: Number(values.samples), peers: values.peers.split(',').filter(Boolean), out: resolve(values.out) };
  for (const [name, known] of Object.entries({ only: cases.map(({ effect }) => effect), peers: ['physical', 'transmission'] })) {
    const stranger = values[name].split(',').find((word) => word !== '' && !known.includes(word));
    if (stranger !== undefined) throw new Error(`--${name} names '${stranger}'; there are ${[...new Set(known)].join(', ')}`);
  }
  for (const name of ['size', 'rounds', 'samples']) {
    if (!(Number.isInteger(options[name]) && options[name] >= 1)) throw new Error(`--${name} is '${values[name]}'; it must be a whole number from 1`);
  }
  mkdirSync(options.out, { recursive: true });
  prepare({ model: options.environment, environment: options.environment, peers: options.peers });
  const lines = [], shown = [];
  let renderer = '';
  for (const one of cases.filter(({ effect }) => options.only.split(',').includes(effect))) {
    const folder = join(options.out, `${one.effect}-${one.body}`);
    mkdirSync(folder, { recursive: true });
    const result = await measure(one, options, folder);
    renderer = result.renderer;
    const base = result.rows[0].milliseconds;
    for (const { name, flip: found, still, milliseconds } of result.rows) {
      lines.push(`| ${one.body}, ${one.title} | ${titles[name]}${one.lit && name !== 'exact' ? ', drei Caustics' : ''} | ${milliseconds.toFixed(1)} ms | ${(milliseconds / base).toFixed(2)} | ${found.toFixed(3)} | ${still === undefined ? '–' : still.toFixed(3)} |`);
    }
    shown.push(['reference', ...options.peers, 'exact', 'exact-64'].map((name) => join(folder, `${name}.png`)));
  }
  const packages = options.peers.length > 0 ? ` Packages: ${Object.entries(versions()).map(([name, version]) => `${name} ${version}`).join(', ')}.` : '';
  const table = `${renderer}; ${options.size} × ${options.size} pixels, index 1.5, reference of ${options.samples} samples.${packages}

| scene | glass | a frame | ratio | FLIP | FLIP at rest, 64 samples |
|---|---|---|---|---|---|
${lines.join('\n')}
`;
  writeFileSync(join(options.out, 'report.md'), table);
  await drawSheet(shown, options);
  console.log(table);
  if (options.into) {
    const page = readFileSync(options.into, 'utf8'), [start, end] = ['<!-- effects -->\n', '<!-- end -->'];
    const from = page.indexOf(start), to = page.indexOf(end, from);
    if (from < 0 || to < 0) throw new Error(`no marks '${start.trim()}' and '${end}' in ${options.into}`);
    writeFileSync(options.into, `${page.slice(0, from + start.length)}\n${table}\n${page.slice(to)}`);
  }
}

/** A row of pictures for each case: reference, the peers, one sample, 64 samples. */
async function drawSheet(rows, { out, size }) {
  const { PNG } = (await import('pngjs')).default;
  const sheet = new PNG({ width: rows[0].length * size, height: rows.length * size });
  rows.forEach((files, row) => files.forEach((file, column) => PNG.bitblt(PNG.sync.read(readFileSync(file)), sheet, 0, 0, size, size, column * size, row * size)));
  writeFileSync(join(out, 'sheet.png'), PNG.sync.write(sheet));
}

main().catch((reason) => {
  console.error(`bench: ${reason.message}`);
  process.exitCode = 1;
});
