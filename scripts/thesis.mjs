// The comparisons of Wang & Chi 2014, chapters 3 and 4, as a page with its pictures. The thesis's models cannot be
// shipped: those that the folder of --models lacks are left out, or a built-in shape stands in for them. Needs
// build/release.
//   node scripts/thesis.mjs -o FOLDER [--models FOLDER]
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

const root = resolve(dirname(fileURLToPath(import.meta.url)), '..');
const binary = resolve(process.env.VITRINE_BINARY ?? join(root, 'build/release/vitrine'));
const side = 512;

const models = {
  sphere: { title: 'sphere, 512 faces', figures: '4.3, 4.4', file: 'sphere_512f.glb', shape: 'sphere' },
  goblet: { title: 'goblet', figures: '4.5, 4.7', shape: 'goblet' },
  torus: { title: 'torus, 576 faces', figures: '4.8, 4.9', file: 'torus_576f.glb', shape: 'torus' },
  knot: { title: 'knot, 2,400 faces', figures: '4.10, 4.12', file: 'knot_2400f.glb', shape: 'knot' },
  cow: { title: 'cow, 5,804 faces', figures: '4.13, 4.14', file: 'cow_5804.glb' },
  bottle: { title: 'bottle', figures: '4.15', shape: 'bottle' },
  bunny: { title: 'bunny, 69,664 faces', figures: '4.16', file: 'bunny_69666.glb' },
};
const timed = ['sphere', 'cow', 'torus', 'knot', 'bunny']; // table 4.1's rows, in its order

let output, folderOfModels, pictureCount = 0;

function fail(sentence) {
  console.error(`thesis: ${sentence}`);
  process.exit(1);
}

function vitrine(command, ...words) {
  try {
    return execFileSync(binary, [command, ...words], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'], maxBuffer: 1 << 26 });
  } catch (reason) {
    return fail(reason.stderr?.trim() || `${binary} does not run; build it: cmake --build --preset release`);
  }
}

/** What the command line calls the model: its file, else its stand-in; undefined where there is neither. */
function findModel({ file, shape }) {
  const path = folderOfModels && file && join(folderOfModels, file);
  return path && existsSync(path) ? path : shape;
}

// -------------------------------------------------------------------------------------------------------- parts of the page

const escape = (text) => text.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);

/** Draws a picture, four layers unless told otherwise, and gives its figure. */
function figure(caption, model, ...options) {
  const name = `${String(++pictureCount).padStart(3, '0')}.png`, environment = options.includes('-e') ? [] : ['-e', 'sky'];
  const technique = options.includes('-t') ? [] : ['-t', 'layered'];
  vitrine('render', model, '-r', `${side},${side}`, '--ior', '1.5', '--no-fresnel', ...environment, ...technique, ...options,
    '-o', join(output, name));
  return `<figure><img src="${name}" width="${side}" height="${side}" alt="${escape(caption)}"><figcaption>${escape(caption)}</figcaption></figure>`;
}

const row = (figures) => `<div class="row">\n${figures.join('\n')}\n</div>`;

/** Figures 4.3 to 4.17: five pictures of one model. */
function compare(model) {
  const { title, figures, file } = model, name = findModel(model);
  if (!name) return `<p>Figures ${figures}: ${title} is left out, <code>${file}</code> was not at hand.</p>`;
  console.error(`thesis: figures ${figures}, ${name}`);
  return `<h3>Figures ${figures}: ${title}</h3>\n${row([
    figure('(a) one refraction', name, '-t', 'single'),
    figure('(b) two layers', name, '--layers', '2'),
    figure('(c) red two refractions, blue more, green total reflection', name, '--analysis'),
    figure('(d) four layers', name),
    figure('(e) ray tracing', name, '-t', 'reference'),
  ])}`;
}

/** The eye so many times as far from what it looks at, as options. */
function move({ camera, target }, factor) {
  return ['--camera', camera.map((at, i) => target[i] + factor * (at - target[i])).join(), '--target', target.join()];
}

/** A row of table 4.1: layered and traced, at twice the distance and as framed. */
function time(model) {
  const name = findModel(model);
  if (!name) return { html: `<tr><th>${model.title}</th><td colspan="7">not at hand</td></tr>` };
  console.error(`thesis: table 4.1, ${name}`);
  const measure = (...view) => JSON.parse(vitrine('bench', name, '-t', 'layered', '-e', 'sky', '--ior', '1.5', '-r', `${side},${side}`, '--json', ...view));
  const near = measure(), [{ triangles }] = near.cases, far = measure(...move(near.cases[0], 2));
  const cells = [far, near].map(({ cases: [{ reference, techniques: [layered] }] }) =>
    `<td>${layered.wall.toFixed(1)} ms</td><td>${reference.wall.toFixed(1)} ms</td><td>${layered.wallToReference.toFixed(2)}</td>`);
  return { html: `<tr><th>${model.title}</th><td>${triangles}</td>${cells.join('')}</tr>`, device: near.device };
}

function timeAll() {
  const rows = timed.map((id) => time(models[id]));
  return `<h2>Table 4.1: time of a frame, ${side} x ${side}</h2>
<p>Four layers, 50 steps, at most 8 events; medians of 9 frames drawn in turns with the ray tracer (Embree, directions only)
on the same processors. Far is twice the distance of near, as in the thesis. The thesis measured 153, 126, 142, 133 and 15
frames a second on its GPU.</p>
<table><tr><th>model</th><th>triangles</th><th>far: layered</th><th>traced</th><th>ratio</th><th>near: layered</th><th>traced</th><th>ratio</th></tr>
${rows.map(({ html }) => html).join('\n')}
</table>
<p>Drawn on ${escape(rows.find(({ device }) => device).device)}.</p>`;
}

function stepSizes() {
  const name = findModel(models.cow) ?? 'goblet'; // thin parts too
  console.error(`thesis: figures 3.24 and 3.25, ${name}`);
  return `<h2>Figures 3.24 and 3.25: linear steps</h2>\n${row([
    ...[5, 50, 500].map((steps) => figure(`size 1/${steps}`, name, '--steps', String(steps))),
    figure('ray tracing', name, '-t', 'reference'),
  ])}`;
}

/** The built-in checker as a picture, Radiance HDR: 32 x 16 squares, tinted by direction. */
function writeChecker(path, height) {
  const width = 2 * height, pixels = Buffer.alloc(4 * width * height);
  for (let j = 0; j < height; ++j) {
    for (let i = 0; i < width; ++i) {
      const azimuth = ((i + 0.5) / width - 0.5) * 2 * Math.PI, elevation = (0.5 - (j + 0.5) / height) * Math.PI;
      const direction = [Math.cos(elevation) * Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation) * Math.sin(azimuth)];
      const square = Math.floor(((i + 0.5) / width) * 32) + Math.floor((1 - (j + 0.5) / height) * 16);
      const light = direction.map((d) => (0.675 + 0.325 * d) * (0.15 + 0.75 * (square % 2)));
      // A pixel is three bytes and their common exponent.
      const exponent = Math.floor(Math.log2(Math.max(...light))) + 1;
      pixels.set([...light.map((value) => Math.floor((value * 256) / 2 ** exponent)), exponent + 128], 4 * (j * width + i));
    }
  }
  writeFileSync(path, Buffer.concat([Buffer.from(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`), pixels]));
}

function resolutions() {
  console.error('thesis: figure 4.23');
  const [framed] = JSON.parse(vitrine('bench', 'sphere', '-t', 'single', '-r', '16,16', '--rounds', '1', '--json')).cases;
  const view = move(framed, 0.62);
  return `<h2>Figure 4.23: resolution of the environment</h2>\n${row([
    ...[256, 512, 1024].map((height) => {
      const path = join(output, `checker-${height}.hdr`);
      writeChecker(path, height);
      return figure(`${2 * height} x ${height}`, 'sphere', '-e', path, ...view);
    }),
    figure('procedural', 'sphere', '-e', 'checker', ...view),
  ])}`;
}

// ------------------------------------------------------------------------------------------------------------------ the page

try {
  const { values } = parseArgs({ options: { output: { type: 'string', short: 'o' }, models: { type: 'string' } } });
  output = values.output;
  folderOfModels = values.models;
} catch (reason) {
  fail(reason.message);
}
if (!output) fail('no output given; add -o FOLDER');
mkdirSync(output, { recursive: true });
const parts = [
  '<h2>One refraction, two layers, four layers, ray tracing</h2>', ...Object.values(models).map(compare),
  timeAll(), stepSizes(), resolutions(),
];
writeFileSync(join(output, 'index.html'), `<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Wang &amp; Chi 2014, made anew</title>
<style>
body { font: 16px/1.5 system-ui, sans-serif; max-width: 1600px; margin: 2rem auto; padding: 0 1rem }
.row { display: flex; flex-wrap: wrap; gap: 12px }
figure { margin: 0; width: 300px }
img { width: 100%; height: auto }
figcaption { font-size: 14px }
table { border-collapse: collapse }
td, th { padding: .3rem .8rem; border: 1px solid #bbb; text-align: right }
</style>
<h1>Image Space Real-time Multi-refraction Technology, made anew</h1>
<p>The comparisons of Shi-Hao Wang and Ming-Te Chi (National Chengchi University, 2014) with Vitrine
${vitrine('--version').trim().split(' ').at(-1)}: ${side} x ${side}, index of refraction 1.5, at most 8 events.</p>
${parts.join('\n')}
</html>
`);
console.error(`thesis: ${join(output, 'index.html')}`);
