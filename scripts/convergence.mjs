// How pictures of several samples come to the reference: of smooth glass, rough glass and glass that disperses. Writes the
// tables of docs/frost-and-fire.md and docs/pictures/convergence.svg; needs build/release. Some minutes.
//   node scripts/convergence.mjs [SIDE]   (pixels, 32)
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = resolve(dirname(fileURLToPath(import.meta.url)), '..'), page = join(root, 'docs/frost-and-fire.md');
const vitrine = join(root, 'build/release/vitrine'), side = Number(process.argv[2] ?? 32);
const folder = mkdtempSync(join(tmpdir(), 'vitrine-convergence-'));
const slab = '--object cube:scale=1.4,1.4,0.15,rotate=10,25,0';
const colours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7'];

/** Draws NAME.png. */
function draw(name, scene, ...more) {
  const words = ['render', ...scene.split(' '), '-e', 'studio', '-r', `${side},${side}`, ...more.join(' ').split(' '), '-o', join(folder, `${name}.png`)];
  execFileSync(vitrine, words, { stdio: ['ignore', 'ignore', 'inherit'] });
}

const compare = (name, truth) => JSON.parse(execFileSync(vitrine, ['compare', join(folder, `${name}.png`), join(folder, `${truth}.png`), '--json'], { encoding: 'utf8' }));

/** Errors of exact with so many samples each. */
function measure(scene, counts, truthSamples, ...more) {
  draw('truth', scene, '-t reference --samples', truthSamples, ...more);
  process.stderr.write(`${scene} ${more.join(' ')}\n`);
  return counts.map((samples) => {
    draw('drawn', scene, '-t exact --samples', samples, ...more);
    const { psnr, flip } = compare('drawn', 'truth');
    return { samples, psnr: psnr ?? 99, flip };
  });
}

const table = (head, rows) => [head, head.map(() => '---'), ...rows].map((row) => `| ${row.join(' | ')} |`).join('\n');

/** Puts a table between the page's marks of that name. */
function put(name, text) {
  const [open, close] = [`<!-- ${name} -->`, '<!-- end -->'], before = readFileSync(page, 'utf8'), start = before.indexOf(open) + open.length;
  if (start < open.length) throw new Error(`${page} has no ${open}`);
  writeFileSync(page, `${before.slice(0, start)}\n\n${text}\n\n${before.slice(before.indexOf(close, start))}`);
}

/** PSNR over samples, those on a logarithmic axis. */
function plot(lines) {
  const x = (samples) => 60 + 60 * Math.log2(samples), y = (psnr) => 340 - 6 * (psnr - 15), text = (at, words, more = '') => `<text x="${at[0]}" y="${at[1]}" ${more}>${words}</text>`;
  const grid = [20, 30, 40, 50, 60].map((psnr) => `<path d="M60 ${y(psnr)}H660" stroke="#ddd"/>${text([52, y(psnr) + 4], `${psnr} dB`, 'text-anchor="end"')}`);
  const ticks = [1, 4, 16, 64, 256, 1024].map((samples) => text([x(samples), 360], samples, 'text-anchor="middle"'));
  const paths = lines.map(([name, errors], i) => `<path d="M${errors.map(({ samples, psnr }) => `${x(samples)} ${y(psnr).toFixed(1)}`).join('L')}" fill="none" stroke="${colours[i]}" stroke-width="2"/>`
    + text([668, y(errors.at(-1).psnr) + 4], name, `fill="${colours[i]}"`));
  writeFileSync(join(root, 'docs/pictures/convergence.svg'), '<svg xmlns="http://www.w3.org/2000/svg" width="740" height="390" font-family="sans-serif" font-size="12">'
    + `<rect width="740" height="390" fill="#fff"/>${[...grid, ...ticks, ...paths].join('')}${text([360, 382], 'samples', 'text-anchor="middle"')}</svg>\n`);
}

const counts = [1, 4, 16, 64, 256, 1024], shapes = ['sphere', 'goblet', 'knot', 'diamond'];
const smooth = shapes.map((shape) => [shape, measure(shape, counts, 1024)]);
plot(smooth);
put('smooth', table(['', ...counts.map((count) => `${count.toLocaleString('en')}`)], smooth.map(([name, errors]) => [name, ...errors.map(({ psnr, flip }) => `${psnr.toFixed(1)} dB, ${flip.toFixed(3)}`)])));

const few = counts.slice(0, 5);
const byFlip = (name, errors) => [name, ...errors.map(({ flip }) => flip.toFixed(3))];
const rough = [['sphere', 'sphere'], ['slab', slab], ['goblet', 'goblet'], ['knot', 'knot']].flatMap(([name, scene]) =>
  [0.05, 0.2, 0.5].map((roughness) => byFlip(`${name}, ${roughness}`, measure(scene, few, 128, `--roughness ${roughness}`))));
put('rough', table(['', ...few], rough));
const disperse = [['knot', 'knot --dispersion 0.5'], ['goblet', 'goblet --glass flint'], ['diamond', 'diamond --glass diamond']].map(([name, scene]) => byFlip(name, measure(scene, few, 256)));
put('disperse', table(['', ...few], disperse));
rmSync(folder, { recursive: true });
