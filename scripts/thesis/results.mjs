// The figures and the table of chapter 4: one refraction, two layers and four layers beside ray tracing.
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { escape, percent, row, text } from './parts.mjs';
import { partsOfScene, scenes } from './scenes.mjs';
import { all, ior, layered, models, nameOf, oliveira, output, side, single, studio, tableSide, traced, wordsOf } from './subject.mjs';

function ball(id) {
  const sphere = wordsOf(models.sphere);
  return row([
    ['4.2 (left): the scene, the same sphere, opaque', studio.draw(`${id}-design`, all(['--object', `${sphere}:colour=0.8,0.3,0.1`], ['-t', 'exact']))],
    ['4.2 (right): ray tracing', studio.draw(`${id}-traced`, all(sphere, traced()))],
    ['4.3: one refraction', studio.draw(`${id}-single`, all(sphere, single))],
    ['4.4: two refractions, Oliveira & Brauwers 2007', studio.draw(`${id}-oliveira`, all(sphere, oliveira))],
    ['4.4: two refractions, the method of the thesis', studio.draw(`${id}-two-layers`, all(sphere, layered({ layers: 2 })))],
  ]);
}

/** Figures 4.5 to 4.17 but the zooms: one model; `hasAnalysis`: with the colours of paths. */
async function compare(id, model, environment, hasAnalysis = true) {
  const words = wordsOf(model);
  if (!words) return text(`Left out: ${model.file} was not at hand.`);
  const draw = (part, technique) => studio.draw(`${id}-${part}`, all(words, technique, environment));
  const truth = draw('traced', traced());
  const judge = async (caption, drawing) => {
    const picture = await drawing;
    return [`${caption}; mean FLIP to ray tracing ${(await studio.flip(picture, await truth)).toFixed(3)}`, picture];
  };
  const [one, two, ours, four] = await Promise.all([
    judge('(a) one refraction', draw('single', single)),
    judge('(b) two layers, Oliveira & Brauwers 2007', draw('oliveira', oliveira)),
    judge('(b) two layers, the method of the thesis', draw('two-layers', layered({ layers: 2 }))),
    judge(`(${hasAnalysis ? 'd' : 'c'}) four layers`, draw('four-layers', layered())),
  ]);
  const analysis = ['(c) paths: red two refractions, blue four, green total internal reflection, grey lost', hasAnalysis && draw('analysis', [...layered(), '--analysis'])];
  return row([one, two, ours, ...(hasAnalysis ? [analysis] : []), four, [`(${hasAnalysis ? 'e' : 'd'}) ray tracing`, truth]]);
}

/** A ninth of a picture three times as large. `left`, `top`: shares of its sides; `order`: the thesis's. */
function zoom(id, model, left, top, order) {
  const captions = { oliveira: 'two layers, Oliveira & Brauwers 2007', layered: 'ours, four layers', traced: 'ray tracing' };
  const techniques = { oliveira, layered: layered(), traced: traced() };
  return row(order.map((name, i) => [
    `(${'abc'[i]}) ${captions[name]}`,
    studio.draw(`${id}-${name}-whole`, all(wordsOf(model), techniques[name], 'sky', 3 * side)).then((whole) => studio.crop(`${id}-${name}`, whole, left, top, side)),
  ]));
}

function simpleScene(id) {
  const parts = partsOfScene(id, scenes.cube);
  return row([
    ['4.18: the scene, the same objects, opaque', parts.design()],
    ['4.19 (a): ray tracing', parts.traced()],
    ['4.19 (b): ours, one after the other as in the thesis', parts.ordered()],
    ['4.19 (b): ours, in any order', parts.any()],
    ['4.19 (c): the sphere alone', parts.nearest()],
  ]);
}

function twoObjects(id, scene) {
  const parts = partsOfScene(id, scene);
  return row([
    ['(a) the scene, the same objects, opaque', parts.design()],
    ['(b) exit directions of the nearer object alone', parts.nearestDirections()],
    ['(c) exit directions of both objects', parts.orderedDirections()],
    ['(d) the nearer object alone', parts.nearest()],
    ['(e) both objects, one after the other as in the thesis', parts.ordered()],
    ['(e) both objects, in any order', parts.any()],
    ['(f) ray tracing', parts.traced()],
  ]);
}

async function limits(id) {
  const parts = partsOfScene(id, scenes.three), { within1, lost, picture } = await parts.errors();
  return row([
    ['(a) the scene, the same objects, opaque', parts.design()],
    ['(b) ray tracing', parts.traced()],
    ['(c) ours, one after the other as in the thesis', parts.ordered()],
    [`errors of (c): ${percent(within1)} within 1° of ray tracing (blue), red wrong, ${percent(lost)} lost (magenta)`, picture],
    ['ours, layers of a quarter of that resolution', parts.coarse()],
  ]);
}

/** The built-in checker as a picture, Radiance HDR: 32 x 16 squares, tinted by direction. */
function writeChecker(path, width, height) {
  const pixels = Buffer.alloc(4 * width * height);
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

function resolutions(id) {
  const close = [...wordsOf(models.sphere), '--camera=0.24,0.2,2'];
  const draw = (name, environment) => studio.draw(`${id}-${name}`, all(close, layered(), environment));
  return row([
    ...[256, 512, 1024].map((size, i) => {
      const path = join(output, `checker-${size}.hdr`);
      writeChecker(path, size, size);
      return [`(${'abc'[i]}) ${size} x ${size}, equirectangular`, draw(size, path)];
    }),
    ['(d) procedural', draw('procedural', 'checker')],
  ]);
}

/** The eye so many times as far from what it looks at, as options. */
function move({ camera, target }, factor) {
  return ['--camera', camera.map((at, i) => target[i] + factor * (at - target[i])).join(), '--target', target.join()];
}

// Table 4.1's rows in its order: frames a second of the method, of OptiX far and near.
const timed = [['sphere', [153, 112, 56]], ['cow', [126, 44, 23]], ['torus', [142, 92, 49]], ['knot', [133, 79, 34]], ['bunny', [15, 12, 9]]];

/** A row of table 4.1: layered and traced, at twice the distance and as framed. */
async function time(model, speeds) {
  const words = wordsOf(model), thesis = speeds.map((speed) => `<td>${speed}</td>`).join('');
  if (!words) return { html: `<tr><th>${escape(nameOf(model))}</th><td colspan="7">left out</td>${thesis}</tr>` };
  const measure = async (...view) => JSON.parse(await studio.run('bench', ...words, ...layered(), '--ior', ior, '-e', 'sky',
    '-r', `${tableSide},${tableSide}`, '--rounds', '3', '--json', ...view));
  const near = await measure(), [{ triangles }] = near.cases, far = await measure(...move(near.cases[0], 2));
  const cells = [far, near].map(({ cases: [{ reference, techniques: [ours] }] }) =>
    `<td>${ours.wall.toFixed(1)} ms</td><td>${reference.wall.toFixed(1)} ms</td><td>${ours.wallToReference.toFixed(2)}</td>`);
  return { html: `<tr><th>${escape(nameOf(model))}</th><td>${triangles}</td>${cells.join('')}${thesis}</tr>`, device: near.device };
}

async function timeAll() {
  const rows = [];
  for (const [id, speeds] of timed) rows.push(await time(models[id], speeds)); // one at a time, nothing else running
  return `<table><tr><th>model</th><th>triangles</th><th>far: ours</th><th>traced</th><th>ratio</th><th>near: ours</th><th>traced</th><th>ratio</th>
<th>thesis: ours, fps</th><th>OptiX far</th><th>near</th></tr>
${rows.map(({ html }) => html).join('\n')}
</table>
${text(`Time of a frame of ${tableSide} x ${tableSide}: four layers, 50 steps, at most 5 events, index ${ior}, environment sky; the median of 3 frames, drawn in turns with the ray
tracer (Embree, directions only, 5 events) on the same processors: read the ratios. The thesis's faces have four corners where triangles are twice as many. Far is twice the distance of near, as in the thesis. Drawn on ${rows.find(({ device }) => device).device}.`)}`;
}

/** A row of the list: one model in one light. */
const compared = (id, model, environment, hasAnalysis) =>
  [id, `Figure ${id}: ${nameOf(model)}; environment ${environment}`, () => compare(id, model, environment, hasAnalysis)];
const sky = 'environment sky';

/** [figure, title, what draws it] each. */
export const resultFigures = [
  ['4.1', 'Figure 4.1: glass in the real world', () => text('Two photographs, which are not ours to show.')],
  ['4.2', `Figures 4.2 to 4.4: ${nameOf(models.sphere)}; ${sky}`, ball],
  compared('4.5', models.goblet, 'sky'),
  ['4.6', `Figure 4.6: the rim, three times as large; ${nameOf(models.goblet)}; ${sky}`, (id) => zoom(id, models.goblet, 0.33, 0.03, ['oliveira', 'traced', 'layered'])],
  compared('4.7', models.goblet, 'checker'),
  compared('4.8', models.torus, 'sky'),
  compared('4.9', models.torus, 'checker', false),
  compared('4.10', models.knot, 'sky'),
  ['4.11', `Figure 4.11: four refractions, three times as large; ${nameOf(models.knot)}; ${sky}`, (id) => zoom(id, models.knot, 0.47, 0.1, ['oliveira', 'layered', 'traced'])],
  compared('4.12', models.knot, 'checker', false),
  compared('4.13', models.cow, 'sky'),
  compared('4.14', models.cow, 'checker', false),
  compared('4.15', models.bottle, 'sky'),
  compared('4.16', models.bunny, 'sky'),
  compared('4.17', models.head, 'sky'),
  ['4.18', `Figures 4.18 and 4.19: two objects, a sphere before a cube; ${sky}`, simpleScene],
  ['4.20', `Figure 4.20: two objects, a cube before a knot; ${sky}`, (id) => twoObjects(id, scenes.knot)],
  ['4.21', `Figure 4.21: two objects, a torus before a sphere; ${sky}`, (id) => twoObjects(id, scenes.torus)],
  ['4.22', `Figure 4.22: limits; a knot, a torus and a sphere; ${sky}`, limits],
  ['4.23', `Figure 4.23: resolution of the environment; ${nameOf(models.sphere)}`, resolutions],
];
export const table = ['table', 'Table 4.1: performance', timeAll];
