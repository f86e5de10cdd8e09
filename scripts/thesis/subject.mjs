// What the page of scripts/thesis.mjs is asked for, and what all its figures share: models, techniques, light.
import { existsSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { makeStudio } from './pictures.mjs';

const root = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
const binary = resolve(process.env.VITRINE_BINARY ?? join(root, 'build/release/vitrine'));

export function fail(sentence) {
  console.error(`thesis: ${sentence}`);
  process.exit(1);
}

function readOptions() {
  try {
    const { values } = parseArgs({ options: {
      output: { type: 'string', short: 'o' }, models: { type: 'string' }, size: { type: 'string' }, only: { type: 'string' },
    } });
    const { output, models: folder, size, only } = values;
    if (!output) throw new Error('no output given; add -o FOLDER');
    if (folder && !existsSync(folder)) throw new Error(`--models is '${folder}', which is not there; name a folder of .glb files`);
    const side = Number(size ?? 384);
    if (!Number.isInteger(side) || side < 32 || side > 1024) throw new Error(`--size is '${size}'; give a whole number from 32 to 1024`);
    // Table 4.1 is of 512 x 512, in the thesis as here, unless told otherwise.
    return { output: resolve(output), folder: folder && resolve(folder), side, tableSide: size ? side : 512, only: only?.split(',') };
  } catch (reason) {
    return fail(reason.message);
  }
}

export const { output, folder, side, tableSide, only } = readOptions();
export const studio = makeStudio(binary, output);

// The thesis's models. It does not say how many faces goblet and bottle have.
export const models = {
  sphere: { title: 'sphere', thesis: '512 faces', file: 'sphere_512f.glb', shape: 'sphere' },
  goblet: { title: 'goblet', shape: 'goblet' },
  torus: { title: 'torus', thesis: '576 faces', file: 'torus_576f.glb', shape: 'torus' },
  knot: { title: 'knot', thesis: '2,400 faces', file: 'knot_2400f.glb', keys: 'rotate=90,0,0', shape: 'knot' }, // turned as the shape is
  cow: { title: 'cow', thesis: '5,804 faces', file: 'cow_5804.glb' },
  bottle: { title: 'bottle', shape: 'bottle' },
  bunny: { title: 'bunny', thesis: '69,664 faces', file: 'bunny_69666.glb' },
  head: { title: "queen's head", file: 'spot_5856.glb', standIn: 'a calf', view: ['--camera=-0.9,0.4,-2.7'] },
};

/** Where the model's file is; undefined where it is not at hand. */
export function pathOf({ file }) {
  const path = folder && file && join(folder, file);
  return path && existsSync(path) ? path : undefined;
}

/** The words that name the model: its file, else its shape; undefined where there is neither. */
export function wordsOf(model) {
  const path = pathOf(model), { keys, shape, view = [] } = model;
  if (path) return [...(keys ? ['--object', `${path}:${keys}`] : [path]), ...view];
  return shape && [shape];
}

/** What is drawn for the model, for a title. */
export function nameOf(model) {
  const { title, thesis, file, standIn, shape } = model;
  if (pathOf(model)) return standIn ? `${title}, for which ${file}, ${standIn}, stands in` : `${title}, ${file} (in the thesis ${thesis})`;
  return shape ? `${title}, for which the built-in ${shape} stands in${thesis ? ` (in the thesis ${thesis})` : ''}` : `${title}, not at hand`;
}

// Techniques. Four refractions and one total internal reflection (section 4.4) are five events; 50 steps (section 3.5.3).
export const single = ['-t', 'single'];
export const oliveira = ['-t', 'oliveira', '--steps', '50'];
export const layered = ({ layers = 4, steps = 50, events = layers + 1 } = {}) =>
  ['-t', 'layered', '--layers', String(layers), '--steps', String(steps), '--max-events', String(events)];
export const traced = (events = 64) => ['-t', 'reference', '--max-events', String(events)]; // 64: as good as without end

export const ior = '1.45'; // glass, section 3.1.2

/** The words of a whole command: a model by a technique, without Fresnel reflection, of which the thesis has none. */
export function all(model, technique, environment = 'sky', across = side) {
  return [...model, ...technique, '--ior', ior, '--no-fresnel', '-e', environment, '-r', `${across},${across}`];
}
