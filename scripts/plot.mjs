// Draws the times of a sweep, which `vitrine bench MODEL --sweep ... --json` measured, as SVG: both axes logarithmic, a
// line for each technique's strict paths, a dashed one for its default picture, and the reference's two of the same.
//   node scripts/plot.mjs BENCH.json PLOT.svg
import { readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const size = { width: 760, height: 460 }; // pixels
const field = { left: 70, right: 610, top: 20, bottom: 410 }; // within it; to the right of it names
const colours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9']; // told apart by the colour-blind, too
const nameDistance = 15; // of two names one below the other

/** What differs from case to case, and how the axis calls it. */
const sweeps = {
  triangles: ['by triangles', (each) => each.triangles],
  resolution: ['by pixels', (each) => each.width * each.height, (each) => `${each.width} x ${each.height}`],
  objects: ['by objects', (each) => each.objects],
  depth: ['by objects, one behind the other', (each) => each.objects],
  relief: ['by samples along a side of the relief', (each) => each.samples],
};

const log = Math.log10;
const place = (number) => number.toFixed(1);
const escape = (text) => text.replace(/[&<>]/g, (sign) => `&#${sign.charCodeAt(0)};`);

/** Name, colour, whether dashed, and points [variable, milliseconds]; without what was not measured. */
function findLines({ cases, device }, variable) {
  // Where processors draw, their time is what other programs disturb least.
  const clock = device.includes('llvmpipe') ? 'cpu' : 'wall';
  const line = (name, colour, dashed, timesOf) => ({
    name: dashed ? `${name}, picture` : name, colour, dashed,
    points: cases.map((each) => [variable(each), timesOf(each)?.[clock]]).filter(([, time]) => time > 0),
  });
  const lines = cases[0].techniques.flatMap(({ label }, i) => [false, true].map((dashed) =>
    line(label, colours[i % colours.length], dashed, ({ techniques }) => (dashed ? techniques[i].picture : techniques[i]))));
  for (const dashed of [false, true]) {
    lines.push(line('Embree', '#000', dashed, ({ reference }) => (dashed ? reference.picture : reference)));
  }
  return lines.filter(({ points }) => points.length > 0);
}

/** From numbers to pixels: the variable from end to end, whole decades of milliseconds. */
function fitAxes(lines) {
  const points = lines.flatMap((line) => line.points), [xs, ys] = [0, 1].map((k) => points.map((point) => log(point[k])));
  const low = [Math.min(...xs), Math.floor(Math.min(...ys))];
  const high = [Math.max(...xs, low[0] + 0.1), Math.max(Math.ceil(Math.max(...ys)), low[1] + 1)];
  return {
    decades: [low[1], high[1]],
    across: (value) => field.left + ((log(value) - low[0]) / (high[0] - low[0])) * (field.right - field.left),
    down: (value) => field.top + ((high[1] - log(value)) / (high[1] - low[1])) * (field.bottom - field.top),
  };
}

function drawGrid({ cases, device }, axes, [title, variable, nameOf = variable]) {
  const parts = [];
  for (let decade = axes.decades[0]; decade <= axes.decades[1]; ++decade) {
    for (const step of [1, 2, 5]) {
      const value = Number(`${step}e${decade}`), y = axes.down(value);
      if (y < field.top - 0.5) continue;
      parts.push(`<path d="M${field.left} ${place(y)}H${field.right}" stroke="${step === 1 ? '#bbb' : '#e6e6e6'}"/>`,
        `<text x="${field.left - 6}" y="${place(y + 4)}" text-anchor="end">${value} ms</text>`);
    }
  }
  for (const each of cases) {
    const x = place(axes.across(variable(each)));
    parts.push(`<path d="M${x} ${field.top}V${field.bottom}" stroke="#e6e6e6"/>`,
      `<text x="${x}" y="${field.bottom + 18}" text-anchor="middle">${nameOf(each)}</text>`);
  }
  const time = device.includes('llvmpipe') ? 'CPU time of a frame' : 'time of a frame';
  parts.push(`<text x="${(field.left + field.right) / 2}" y="${size.height - 8}" text-anchor="middle">${time}, ${title}</text>`);
  return parts;
}

function drawLine({ name, colour, dashed, points }, axes, nameY) {
  const places = points.map(([x, y]) => [place(axes.across(x)), place(axes.down(y))]);
  return [
    `<polyline fill="none" stroke="${colour}" stroke-width="2"${dashed ? ' stroke-dasharray="6 4"' : ''} points="${places.map((at) => at.join()).join(' ')}"/>`,
    ...places.map(([x, y]) => `<circle cx="${x}" cy="${y}" r="3" fill="${colour}"/>`),
    `<text x="${field.right + 10}" y="${place(nameY)}" fill="${colour}">${escape(name)}</text>`,
  ];
}

/** The report of `vitrine bench --json` as SVG. */
export function drawPlot(report) {
  const sweep = sweeps[report.sweep];
  if (!sweep) throw new Error('the report is not of a sweep; add --sweep objects, depth, relief, triangles or resolution');
  const lines = findLines(report, sweep[1]), axes = fitAxes(lines);
  const lastTime = ({ points }) => points.at(-1)[1];
  // From the top down, so that names need only be kept apart downwards.
  lines.sort((a, b) => lastTime(b) - lastTime(a));
  let lowest = field.top;
  const drawn = lines.flatMap((line) => {
    lowest = Math.max(lowest + nameDistance, axes.down(lastTime(line)) + 4);
    return drawLine(line, axes, lowest);
  });
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${size.width} ${size.height}" font-family="sans-serif" font-size="12">`,
    '<rect width="100%" height="100%" fill="#fff"/>', ...drawGrid(report, axes, sweep), ...drawn, '</svg>', '',
  ].join('\n');
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [, , input, output] = process.argv;
  try {
    if (!output) throw new Error('name two files: node scripts/plot.mjs BENCH.json PLOT.svg');
    writeFileSync(output, drawPlot(JSON.parse(readFileSync(input, 'utf8'))));
  } catch (reason) {
    console.error(`plot: ${reason.message}`);
    process.exitCode = 1;
  }
}
