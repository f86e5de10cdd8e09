// The scenes of docs/scenes.md: draws each with exact, layered (any order, then ordered) and the reference, and writes
// docs/pictures/scenes.png, the table of docs/scenes.md and that of branches in docs/method.md. scripts/figures.sh calls
// it; it needs build/release and the packages of tests/.
//   node scripts/scenes.mjs [exact,layered,ordered]   (only some of them: the others' places stay empty)
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = resolve(dirname(fileURLToPath(import.meta.url)), '..');
const { PNG } = createRequire(join(root, 'tests/package.json'))('pngjs');
const side = 256;

const plane = '--object plane:at=0,0,-4,scale=2,checker';
const scenes = [
  ['two spheres', '--object sphere:at=-0.5,0,0.6 --object sphere:at=0.6,0.1,-2'],
  ['knot behind a cube', '--object cube:at=0,0,0.6 --object knot:at=0,0,-2'],
  ['three', '--object sphere:at=-0.5,0,1 --object cube:at=0.5,0,-1 --object torus:at=0,0,-3.2,ior=1.4'],
  ['sphere in sphere', '--object sphere --object sphere:scale=0.5,ior=2'],
  ['bubble', '--object sphere:ior=1.5 --object sphere:scale=0.6,ior=1'],
  ['touching', '--object cube:at=-0.6,0,0 --object cube:at=0.6,0,0,ior=1.7'],
  ['water', `--object tumbler --object water:ior=1.33 ${plane}`],
  ['goblet before a plane', `--object goblet ${plane}`],
  ['ball inside', '--object sphere --object sphere:scale=0.4,opaque,colour=0.9,0.3,0.1,roughness=0.4'],
  ['coloured', `--object knot:absorb=0.2,0.7,0.5,distance=0.5 --object sphere:at=0,0,-2.5,tint=0.9,0.8,1 ${plane}`],
];
const columns = [
  ['exact', '-t exact'],
  ['layered', '-t layered --multi any'],
  ['ordered', '-t layered --multi ordered'],
];
const asked = (process.argv[2] ?? 'exact,layered,ordered').split(',');
const branched = ['sphere in sphere', 'bubble', 'ball inside', 'water'];

const folder = mkdtempSync(join(tmpdir(), 'vitrine-scenes-'));
const file = (name) => join(folder, name);

function vitrine(...words) {
  return execFileSync(join(root, 'build/release/vitrine'), words, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] });
}

/** Draws a scene as name.png and, where asked, name.pfm and name.events.png. */
function draw(name, scene, environment, technique, ...more) {
  vitrine('render', ...scene.split(' '), '-e', environment, '-r', `${side},${side}`, '--samples', '16', ...technique.split(' '),
    '-o', file(`${name}.png`), ...more);
}

function compare(a, b, ...more) {
  return JSON.parse(vitrine('compare', file(a), file(b), '--json', ...more));
}

/** Pictures in rows, a line of white between them. */
function tile(rows) {
  const gap = 4, width = rows[0].length * (side + gap) - gap, height = rows.length * (side + gap) - gap;
  const sheet = new PNG({ width, height });
  sheet.data.fill(255);
  rows.forEach((row, y) => row.forEach((name, x) => {
    if (!existsSync(file(name))) return;
    PNG.bitblt(PNG.sync.read(readFileSync(file(name))), sheet, 0, 0, side, side, x * (side + gap), y * (side + gap));
  }));
  return PNG.sync.write(sheet, { colorType: 2 });
}

/** Puts lines between <!-- mark --> and <!-- end --> of a document. */
function insert(path, mark, lines) {
  const begin = `<!-- ${mark} -->`, text = readFileSync(path, 'utf8');
  const from = text.indexOf(begin), to = text.indexOf('<!-- end -->', from);
  if (from < 0 || to < 0) throw new Error(`${path} has no ${begin} ... <!-- end -->`);
  writeFileSync(path, `${text.slice(0, from + begin.length)}\n\n${lines.join('\n')}\n\n${text.slice(to)}`);
}

const percent = (share) => (100 * share).toFixed(1);

function measureScenes() {
  const rows = [];
  const table = [
    '| scene | events | ≤ 4 events: exact | layered | ordered | ≤ 6 events: exact | layered | ordered | lost: exact | layered | ordered | FLIP: exact | layered | ordered |',
    `|${'---|'.repeat(14)}`,
  ];
  for (const [name, scene] of scenes) {
    draw('truth', scene, 'studio', '-t reference', '--directions', file('truth.pfm'), '--events', file('events.png'));
    const events = PNG.sync.read(readFileSync(file('events.png'))).data.filter((value, i) => i % 4 === 0 && value > 0);
    const found = columns.map(([id, technique]) => {
      if (!asked.includes(id)) return null;
      draw(id, scene, 'studio', technique, '--directions', file(`${id}.pfm`));
      const directions = compare(`${id}.pfm`, 'truth.pfm', '--events', file('events.png'));
      return { directions, flip: compare(`${id}.png`, 'truth.png').flip };
    });
    const cells = (cell) => found.map((one) => (one ? cell(one) : '–')).join(' | ');
    table.push(`| ${name} | ${(events.reduce((a, b) => a + b, 0) / events.length).toFixed(1)} | ${[
      cells(({ directions }) => `${percent(directions.upTo4Events.within1)} %`),
      cells(({ directions }) => `${percent(directions.upTo6Events.within1)} %`),
      cells(({ directions }) => `${(100 * directions.lost).toFixed(2)} %`),
      cells(({ flip }) => flip.toFixed(3)),
    ].join(' | ')} |`);
    rows.push(columns.map(([id]) => `${rows.length}-${id}.png`).concat(`${rows.length}-truth.png`));
    [...columns.map(([id]) => id), 'truth'].forEach((id, i) => {
      if (id === 'truth' || asked.includes(id)) writeFileSync(file(rows.at(-1)[i]), readFileSync(file(`${id}.png`)));
    });
    console.log(table.at(-1));
  }
  writeFileSync(join(root, 'docs/pictures/scenes.png'), tile(rows));
  insert(join(root, 'docs/scenes.md'), 'scenes', table);
}

function measureBranches() {
  const counts = [['none', '-1'], ['1', '1'], ['2', '2'], ['4', '4']];
  const table = [`| branches | ${counts.map(([label]) => label).join(' | ')} |`, `|---|${'---|'.repeat(counts.length)}`];
  for (const name of branched) {
    const scene = scenes.find(([other]) => other === name)[1];
    draw('truth', scene, 'checker', '-t reference');
    const flips = counts.map(([, count]) => {
      draw('try', scene, 'checker', `-t exact --branches=${count}`);
      return compare('try.png', 'truth.png').flip.toFixed(3);
    });
    table.push(`| ${name} | ${flips.join(' | ')} |`);
    console.log(table.at(-1));
  }
  insert(join(root, 'docs/method.md'), 'branches', table);
}

try {
  measureScenes();
  measureBranches();
} finally {
  rmSync(folder, { recursive: true });
}
