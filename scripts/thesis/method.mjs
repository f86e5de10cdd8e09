// The figures of chapters 2 and 3: of the method and its parts.
import { drawFaults } from './faults.mjs';
import { percent, row, text } from './parts.mjs';
import { partsOfScene, scenes } from './scenes.mjs';
import { all, layered, models, nameOf, oliveira, output, pathOf, studio, traced, wordsOf } from './subject.mjs';

const torus = () => wordsOf(models.torus);

function reflectionOff(id) {
  const cube = ['cube']; // most of what is seen through it meets a side beyond the critical angle
  const picture = studio.draw(`${id}-b`, all(cube, traced()));
  const analysis = studio.draw(`${id}-analysis`, all(cube, [...traced(), '--analysis']));
  return row([
    ['(a) only refraction; black where there is total internal reflection', Promise.all([picture, analysis]).then((both) => studio.blacken(`${id}-a`, ...both))],
    ['(b) with total internal reflection', picture],
    ['(c) the scene: the same cube, opaque', studio.draw(`${id}-c`, all(['--object', 'cube:colour=0.8,0.3,0.1'], ['-t', 'exact']))],
  ]);
}

const backOfTorus = (id) => row([['the back of the ring is seen through its front', studio.draw(id, all(torus(), traced()))]]);

async function moreThanFour(id) {
  // Along the strands: as the file's axes are, or the built-in knot from the side.
  const path = pathOf(models.knot), knot = path ? [path] : ['knot', '--camera=2.4,0.4,0.7'];
  const draw = (part, technique) => studio.draw(`${id}-${part}`, all(knot, technique));
  const directions = [4, 6].map((events) => studio.drawDirections(`${id}-${events}-events`, all(knot, traced(events))));
  const difference = await studio.compareDirections(`${id}-difference`, await directions[0], await directions[1]);
  return text('The dragon is not at hand. A knot seen along its strands, where light meets six surfaces, stands in.') + await row([
    ['(left) ray tracing, four events', draw('4-events', traced(4))],
    ['(right) ray tracing, six events', draw('6-events', traced(6))],
    [`where they differ: red, or magenta where four events end in the glass; ${percent(difference.within1)} agree within 1° (blue)`, difference.picture],
    ['ours, four layers', draw('4-layers', layered())],
    ['ours, six layers', draw('6-layers', layered({ layers: 6 }))],
  ]);
}

const twoLayers = (id) => row([
  ['two layers, Oliveira & Brauwers 2007', studio.draw(`${id}-oliveira`, all(torus(), oliveira))],
  ['two layers, the method of the thesis', studio.draw(`${id}-two-layers`, all(torus(), layered({ layers: 2 })))],
]);

const peel = (name, model, layers, ...view) => studio.drawLayers(name, all([...model, ...view], layered({ layers })));
const fromFront = '--camera=0,1,3'; // its back is half hidden
const fourLayers = (id) => row([['depth above, normals beneath; layers 1 to 4 from the left', peel(id, torus(), 4)]]);

const faults = (id) => row([
  ['(a) seen along the axis: no faults', peel(`${id}-a`, torus(), 2, '--camera=0,3.4,0.02')],
  ['(b) from the front: layer 2, on the right, jumps where the front of the ring hides the back', peel(`${id}-b`, torus(), 2, fromFront)],
]);

async function faultCases(id) {
  const bunny = wordsOf(models.bunny);
  const sheets = { tumbler: peel(`${id}-tumbler`, ['tumbler', '--camera=0,0.4,3', '--target=0,0,0'], 4), ...(bunny && { bunny: peel(`${id}-bunny`, bunny, 4) }) };
  const rows = await Promise.all(Object.entries(sheets).map(async ([name, drawing]) => {
    const sheet = await drawing, depths = [0, 1, 2, 3].map((layer) => studio.readDepth(sheet, layer, 4));
    const drawn = drawFaults(`${id}-${name}`, name, depths, output);
    return row(drawn.map(({ caption, file }) => [caption, file && { ...sheet, file, note: 'a column of its depths; ray and search by scripts/thesis/faults.mjs' }]));
  }));
  return text(`Sections through peeled layers, the eye on the left: layer 1 black, layer 2 red, 3 and 4 grey; a ray and its linear steps blue, filled where it is before
layer 2 (+), hollow where it is behind it (-); a hit is ringed green. ${bunny ? '' : 'The bunny is not at hand.'}`) + rows.join('\n');
}

async function merge(id) {
  const sheet = await peel(`${id}-sheet`, torus(), 4), second = studio.readDepth(sheet, 1, 4), fourth = studio.readDepth(sheet, 3, 4);
  const merged = { ...fourth, depths: fourth.depths.map((depth, at) => depth ?? second.depths[at]) };
  return text('The program always merges, so that the faults of figure 3.20 cannot be shown.') + await row([
    ['depth of layer 2', studio.drawDepth(`${id}-second`, sheet, second, 'layer 2 of it')],
    ['depth of layer 4', studio.drawDepth(`${id}-fourth`, sheet, fourth, 'layer 4 of it')],
    ['3.23: layer 4, merged with layer 2', studio.drawDepth(`${id}-merged`, sheet, merged, 'layer 4 of it and, where that is empty, layer 2, as merge.frag has it')],
  ]);
}

/** Pictures and errors for numbers of steps, and ray tracing of as many events. */
async function compareSteps(id, model, counts) {
  const truth = await studio.drawDirections(`${id}-traced`, all(model, traced(5)));
  const parts = await Promise.all(counts.map(async (steps) => {
    const name = `${id}-${steps}`, drawing = all(model, layered({ steps })), title = `size 1/${steps}, ${steps} steps`;
    const { within1, lost, picture } = await studio.compareDirections(`${name}-error`, await studio.drawDirections(name, drawing), truth);
    return [[title, studio.draw(name, drawing)], [`${title}: ${percent(within1)} within 1° of ray tracing (blue), red wrong, ${percent(lost)} lost (magenta)`, picture]];
  }));
  return row([...parts.flat(), ['ray tracing, five events', studio.draw(`${id}-traced`, all(model, traced(5)))]]);
}

const tumbler = ['tumbler', '--camera=1.95,1.1,2', '--target=0,0,0'];
const legs = (cow) => [...cow, '--camera=1.5,0.1,0.5', '--target=0,-0.25,0', '--fov=30'];

async function fewSteps(id) {
  const cow = wordsOf(models.cow);
  return text(`The thesis's cow loses its legs with five steps. Ours hardly does: a step is a part of the ray's way through the object's box, not of the whole depth,
and all layers are looked at in each.${cow ? '' : ' (The cow is not at hand.)'} What five steps lose here is what is reflected in thin parts: the foot of a tumbler.`)
    + await compareSteps(`${id}-tumbler`, tumbler, [5, 50]) + (cow ? await compareSteps(`${id}-cow`, legs(cow), [5, 50]) : '');
}

async function manySteps(id) {
  const cow = wordsOf(models.cow);
  return text(`A step is also the jump of depth that is a fault, so that with 500 steps steep pieces of a layer are taken for faults.${cow ? '' : ' The cow is not at hand; the built-in bottle stands in.'}`)
    + await compareSteps(id, cow ? legs(cow) : ['bottle'], [50, 500]);
}

async function reflection(id) {
  return text('The program always clears the surface that a path starts on with a step of a tenth first, as figure 3.29 has it, so that the faults of 3.26 cannot be shown.') + await row([
    ['3.29 (right): with total internal reflection', studio.draw(`${id}-four-layers`, all(torus(), layered()))],
    ['paths: red two refractions, blue four, green total internal reflection, grey lost', studio.draw(`${id}-analysis`, all(torus(), [...layered(), '--analysis']))],
    ['ray tracing', studio.draw(`${id}-traced`, all(torus(), traced()))],
  ]);
}

function knotBehindCube(id) {
  const { ordered, any, traced: truth } = partsOfScene(id, scenes.knot);
  return row([['one after the other, as in the thesis', ordered()], ['in any order', any()], ['ray tracing', truth()]]);
}

const torusName = nameOf(models.torus);

/** [figure, title, what draws it] each. */
export const methodFigures = [
  ['2.4', 'Figure 2.4: ray tracing without and with total internal reflection; environment sky', reflectionOff],
  ['3.3', `Figure 3.3: ray tracing; ${torusName}; environment sky`, backOfTorus],
  ['3.4', 'Figure 3.4: four against six; environment sky', moreThanFour],
  ['3.10', `Figure 3.10: two layers; ${torusName}; environment sky`, twoLayers],
  ['3.12', `Figure 3.12: four layers; ${torusName}`, fourLayers],
  ['3.13', `Figure 3.13: faults of depth; ${torusName}`, faults],
  ['3.15', 'Figures 3.15 to 3.17: a ray at a fault, three cases', faultCases],
  ['3.20', `Figures 3.20 to 3.23: layers merged; ${torusName}`, merge],
  ['3.24', 'Figure 3.24: linear steps, 5 against 50; environment sky', fewSteps],
  ['3.25', 'Figure 3.25: linear steps, 50 against 500; environment sky', manySteps],
  ['3.26', `Figures 3.26 to 3.29: total internal reflection; ${torusName}; environment sky`, reflection],
  ['3.33', 'Figure 3.33: a knot behind a cube; environment sky', knotBehindCube],
];
