// Figures 3.15 to 3.17: a ray and a fault of layer 2, in a column of texels of peeled layers. The search is that of the
// thesis, section 3.5.1, along one column: rows and depths as the layers have them, rays inside the glass chosen so that each case is
// there.
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

const SIZE = 1 / 50; // of a linear step, and the jump of depth that is a fault (section 3.5.3)
const LARGE = 6 * SIZE; // a jump that is seen in a drawing
const HALVINGS = 10;

/** Depths down a column, null where there is no surface. */
const columnOf = ({ depths, columns, rows }, column) => Array.from({ length: rows }, (_, row) => depths[row * columns + column]);

/** Follows a ray from layer 1 at a row, so many rows down over the whole depth, until it hits layer 2 or leaves the glass. */
function search(layers, row, slope) {
  const [front, back] = layers;
  const at = (t) => ({ row: row + slope * t, depth: front[row] + t });
  const stored = (point) => back[Math.round(point.row)] ?? null;
  const isBefore = (t) => at(t).depth < stored(at(t));
  const isInside = ({ row: there, depth }) => layers.filter((layer) => (layer[Math.round(there)] ?? 1) < depth).length % 2 === 1;
  const found = { start: at(0), points: [], passed: 0, between: 0, hit: null };
  let side = true, a = 0.1 * SIZE;
  for (let b = a + SIZE; isInside(at(a)) && stored(at(b)) !== null; a = b, b += SIZE) {
    const jump = Math.abs(stored(at(a)) - stored(at(b)));
    found.points.push({ ...at(b), isBefore: isBefore(b) });
    if (isBefore(b) === side) {
      found.passed = Math.max(found.passed, side ? jump : 0); // case 1: the fault is behind the ray
      continue;
    }
    let low = a, high = b;
    for (let k = 0; k < HALVINGS; ++k) {
      const middle = (low + high) / 2;
      if (isBefore(middle) === side) low = middle;
      else high = middle;
    }
    const apart = Math.abs(stored(at(low)) - stored(at(high)));
    if (apart <= SIZE) {
      found.hit = at(high); // case 3
      break;
    }
    found.between = Math.max(found.between, apart); // case 2: remember the side, go on
    side = !side;
  }
  return found;
}

const cases = [
  {
    title: 'case 1 (3.15): the ray passes before the fault, every difference is +, the search goes on',
    is: ({ passed, between, hit }) => hit && between === 0 && passed > LARGE,
  },
  {
    title: 'case 2 (3.16): the ray passes through the fault; where + becomes - the depths on both sides are far apart: no hit',
    is: ({ between, points }) => between > LARGE && points.filter(({ isBefore }) => !isBefore).length > 2,
  },
  {
    title: 'case 3 (3.17): the ray meets the surface; where + becomes - the depths on both sides are less than a step apart',
    is: ({ passed, between, hit }) => hit && between === 0 && passed < SIZE,
  },
];

const COLUMNS = 40;
const SLOPES = [-1.5, -1, -0.7, -0.4, -0.2, 0.2, 0.4, 0.7, 1, 1.5]; // heights of the picture, over the whole depth

/** The ray of a case with most steps, in the first column from the middle outwards that has one; some columns are looked at. */
function findRay(sheets, isCase) {
  const [{ columns, rows }] = sheets;
  for (let k = 0; k < COLUMNS - 1; ++k) {
    const column = Math.floor(columns * (0.5 + ((k % 2 ? -1 : 1) * Math.ceil(k / 2)) / COLUMNS));
    const layers = sheets.map((sheet) => columnOf(sheet, column));
    let best = null;
    for (let row = 0; row < rows; ++row) {
      if (layers[0][row] === null) continue;
      for (const slope of SLOPES) {
        const found = search(layers, row, slope * rows);
        if (isCase(found) && found.points.length > (best?.found.points.length ?? 3)) best = { layers, found };
      }
    }
    if (best) return best;
  }
  return null;
}

/** Depth to the right, rows downwards. */
function drawRay({ layers, found: { start, points, hit } }) {
  const scale = 300 / layers[0].length, x = (depth) => (20 + 260 * depth).toFixed(1), y = (row) => (scale * row).toFixed(1);
  const dot = ({ row, depth }, radius, style) => `<circle cx="${x(depth)}" cy="${y(row)}" r="${radius}" ${style}/>`;
  const outlines = layers.flatMap((layer, i) => layer.map((depth, row) => depth !== null && dot({ row, depth }, 1.5, `fill="${['#000', '#d11', '#aaa', '#aaa'][i]}"`)));
  const end = hit ?? points.at(-1);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="300" height="300"><rect width="300" height="300" fill="#fff"/>
${outlines.filter(Boolean).join('')}
<path d="M${x(start.depth)} ${y(start.row)}L${x(end.depth)} ${y(end.row)}" stroke="#15c"/>
${points.map((point) => dot(point, 2.5, `stroke="#15c" fill="${point.isBefore ? '#15c' : '#fff'}"`)).join('')}
${hit ? dot(hit, 7, 'fill="none" stroke="#080" stroke-width="2"') : ''}</svg>\n`;
}

/** Draws the three cases in four layers into the folder: { caption, file } each; a case that the layers do not have has no file. */
export function drawFaults(name, title, sheets, folder) {
  return cases.map((one, i) => {
    const ray = findRay(sheets, one.is), file = `${name}-${i + 1}.svg`;
    if (!ray) return { caption: `${title}, ${one.title}: no ray in this view` };
    writeFileSync(join(folder, file), drawRay(ray));
    return { caption: `${title}, ${one.title}`, file };
  });
}
