// The page of the thesis's figures: what is on it is what its captions say. Needs VITRINE_BINARY with Embree. No models are at
// hand here, so that built-in shapes stand in.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { PNG } from 'pngjs';

const here = dirname(fileURLToPath(import.meta.url));
const binary = resolve(process.env.VITRINE_BINARY ?? join(here, '../build/release/vitrine'));
const folder = mkdtempSync(join(tmpdir(), 'vitrine-thesis-'));
after(() => rmSync(folder, { recursive: true, force: true }));

function thesis(...words) {
  const { status, stderr } = spawnSync(process.execPath, [join(here, '../scripts/thesis.mjs'), ...words], { env: { ...process.env, VITRINE_BINARY: binary } });
  return { status, error: stderr.toString() };
}

const decode = (text) => text.replace(/&#(\d+);/g, (_, code) => String.fromCharCode(code));

/** Makes the page and reads it: sections by their id, { title, figures: [{ caption, file, command, note }] }. */
function makePage(name, ...words) {
  const where = join(folder, name), { status, error } = thesis('-o', where, ...words);
  assert.equal(status, 0, error);
  const sections = new Map();
  for (const [, id, title, body] of readFileSync(join(where, 'index.html'), 'utf8').matchAll(/<section id="(.*?)"><h2>(.*?)<\/h2>\n(.*?)<\/section>/gs)) {
    const figures = [...body.matchAll(/<img src="(.*?)".*?<figcaption>(.*?)\n<code>(.*?)<\/code>(.*?)<\/figcaption>/gs)]
      .map(([, file, caption, command, note]) => ({ file, caption: decode(caption), command: decode(command), note: decode(note).trim() }));
    sections.set(id, { title: decode(title), figures, body });
  }
  const find = (id, pattern) => {
    const found = sections.get(id).figures.filter(({ caption }) => pattern.test(caption));
    assert.equal(found.length, 1, `one figure of ${id} is ${pattern}`);
    return found[0];
  };
  const pixels = ({ file }) => PNG.sync.read(readFileSync(join(where, file)));
  return { where, sections, find, pixels };
}

/** Runs a caption's command, in the page's folder, and gives its picture. */
function drawAgain(where, command) {
  const words = command.split(' ').slice(1), path = join(folder, 'again.png');
  if (words.includes('--layer-sheet')) words.pop();
  const { status, stderr } = spawnSync(binary, [...words, ...(words.at(-1) === '--layer-sheet' ? [path] : ['-o', path])], { cwd: where });
  assert.equal(status, 0, `${command}: ${stderr}`);
  return PNG.sync.read(readFileSync(path));
}

const isSame = (a, b) => a.width === b.width && a.height === b.height && a.data.equals(b.data);

/** The share of pixels that differ by more than 8 of 255 in a channel. */
function shareThatDiffers(a, b) {
  assert.deepEqual([a.width, a.height], [b.width, b.height]);
  let count = 0;
  for (let at = 0; at < a.data.length; at += 4) count += [0, 1, 2].some((k) => Math.abs(a.data[at + k] - b.data[at + k]) > 8);
  return count / (a.width * a.height);
}

const side = 64;

// Every figure of the thesis that is a picture: its title and how many pictures it has.
const wanted = {
  2.4: [/Figure 2\.4: .*total internal reflection/, 3], 3.3: [/Figure 3\.3: .*torus/, 1], 3.4: [/Figure 3\.4: four against six/, 5],
  '3.10': [/Figure 3\.10: two layers/, 2], 3.12: [/Figure 3\.12: four layers/, 1], 3.13: [/Figure 3\.13: faults/, 2], 3.15: [/Figures 3\.15 to 3\.17: .*three cases/, 3],
  '3.20': [/Figures 3\.20 to 3\.23: layers merged/, 3], 3.24: [/Figure 3\.24: linear steps, 5 against 50/, 5], 3.25: [/Figure 3\.25: linear steps, 50 against 500/, 5],
  3.26: [/Figures 3\.26 to 3\.29: total internal reflection/, 3], 3.33: [/Figure 3\.33: a knot behind a cube/, 3], 4.1: [/Figure 4\.1: .*real world/, 0],
  4.2: [/Figures 4\.2 to 4\.4: sphere.*stands in/, 5], 4.5: [/Figure 4\.5: goblet.*stands in.*environment sky/, 6], 4.6: [/Figure 4\.6: the rim, three times/, 3],
  4.7: [/Figure 4\.7: goblet.*environment checker/, 6], 4.8: [/Figure 4\.8: torus.*environment sky/, 6], 4.9: [/Figure 4\.9: torus.*environment checker/, 5],
  '4.10': [/Figure 4\.10: knot.*environment sky/, 6], 4.11: [/Figure 4\.11: four refractions, three times/, 3], 4.12: [/Figure 4\.12: knot.*environment checker/, 5],
  4.13: [/Figure 4\.13: cow, not at hand/, 0], 4.14: [/Figure 4\.14: cow, not at hand/, 0], 4.15: [/Figure 4\.15: bottle.*environment sky/, 6],
  4.16: [/Figure 4\.16: bunny, not at hand/, 0], 4.17: [/Figure 4\.17: queen's head, not at hand/, 0], 4.18: [/Figures 4\.18 and 4\.19: two objects/, 5],
  '4.20': [/Figure 4\.20: two objects, a cube before a knot/, 7], 4.21: [/Figure 4\.21: two objects, a torus before a sphere/, 7], 4.22: [/Figure 4\.22: limits/, 5],
  4.23: [/Figure 4\.23: resolution of the environment/, 4], table: [/Table 4\.1: performance/, 0],
};

describe('the page', () => {
  let page;
  before(() => {
    page = makePage('small', '--size', String(side));
  });

  test('has every figure by its title, with its pictures', () => {
    assert.deepEqual([...page.sections.keys()].sort(), Object.keys(wanted).sort());
    for (const [id, [title, count]] of Object.entries(wanted)) {
      const section = page.sections.get(id);
      assert.match(section.title, title);
      assert.equal(section.figures.length, count, id);
    }
    for (const id of ['4.13', '4.14', '4.16', '4.17']) assert.match(page.sections.get(id).body, /Left out: \w+\.glb was not at hand/);
    assert.match(page.sections.get('table').body, /Time of a frame of 64 x 64: four layers, 50 steps, at most 5 events, index 1\.45/);
    assert.equal(page.sections.get('table').body.match(/<td>left out|<td colspan="7">left out/g).length, 2, 'cow and bunny');
  });

  test("draws with the thesis's index, steps and events", () => {
    for (const { figures } of page.sections.values()) {
      for (const { command } of figures.filter((one) => one.command.startsWith('vitrine render'))) {
        assert.match(command, / --ior 1\.45 --no-fresnel -e /);
        const layers = Number(command.match(/--layers (\d+)/)?.[1]), objects = command.match(/--object/g)?.length ?? 1;
        if (/-t layered/.test(command)) assert.equal(Number(command.match(/--max-events (\d+)/)[1]), (layers + 1) * objects, command);
      }
    }
    assert.match(page.find('4.8', /^\(d\)/).command, /-t layered --layers 4 --steps 50 --max-events 5/);
  });

  for (const id of ['3.12', '4.5', '4.9', '4.20', '4.23']) {
    test(`${id}: its pictures are what the commands under them draw`, () => {
      const plain = page.sections.get(id).figures.filter(({ note }) => note === '');
      assert.ok(plain.length > 0);
      for (const one of plain) assert.ok(isSame(page.pixels(one), drawAgain(page.where, one.command)), `${one.file}: ${one.command}`);
    });
  }

  test("two layers are Oliveira's and, beside them, the thesis's own", () => {
    for (const id of ['4.5', '4.7', '4.8', '4.9', '4.10', '4.12', '4.15']) {
      const theirs = page.find(id, /^\(b\) two layers, Oliveira & Brauwers 2007/), own = page.find(id, /^\(b\) two layers, the method/);
      assert.match(theirs.command, / -t oliveira /);
      assert.match(own.command, / -t layered --layers 2 /);
      assert.ok(shareThatDiffers(page.pixels(theirs), page.pixels(own)) > 0.01, id);
    }
  });

  test('the second environment is another one', () => {
    for (const [first, second] of [['4.5', '4.7'], ['4.8', '4.9'], ['4.10', '4.12']]) {
      const [a, b] = [first, second].map((id) => page.find(id, /ray tracing$/));
      assert.ok(shareThatDiffers(page.pixels(a), page.pixels(b)) > 0.5, `${first}, ${second}`);
    }
  });

  test('2.4: without total internal reflection it is black there, and only there', () => {
    const [without, together] = [/^\(a\)/, /^\(b\)/].map((pattern) => page.pixels(page.find('2.4', pattern)));
    const { command } = page.find('2.4', /^\(b\)/), analysis = drawAgain(page.where, `${command} --analysis`);
    let black = 0;
    for (let at = 0; at < analysis.data.length; at += 4) {
      const [r, g, b] = analysis.data.subarray(at, at + 3), isGreen = g > r && g > b;
      const now = without.data.subarray(at, at + 3);
      assert.deepEqual([...now], isGreen ? [0, 0, 0] : [...together.data.subarray(at, at + 3)]);
      black += isGreen;
    }
    assert.ok(black > 0.1 * side * side, `${black} pixels are black`);
  });

  test('4.6 and 4.11: parts of pictures three times as large, where there are four refractions', () => {
    for (const id of ['4.6', '4.11']) {
      for (const one of page.sections.get(id).figures) {
        assert.match(one.command, new RegExp(`-r ${3 * side},${3 * side}$`));
        const [, x, y] = one.note.match(/from (\d+),(\d+)$/).map(Number), part = new PNG({ width: side, height: side });
        PNG.bitblt(drawAgain(page.where, one.command), part, x, y, side, side, 0, 0);
        assert.ok(isSame(page.pixels(one), part), one.file);
      }
      const ours = page.find(id, /^\([bc]\) ours/), [, x, y] = ours.note.match(/from (\d+),(\d+)$/).map(Number);
      const paths = drawAgain(page.where, `${ours.command} --analysis`);
      let blue = 0;
      for (let j = y; j < y + side; ++j) {
        for (let i = x; i < x + side; ++i) {
          const [r, g, b] = paths.data.subarray(4 * (j * paths.width + i));
          blue += b > r && b > g;
        }
      }
      assert.ok(blue > 0.1 * side * side, `${id}: ${blue} pixels`);
    }
  });

  test('4.20: exit directions as colours, of one object and of both', () => {
    const one = page.pixels(page.find('4.20', /^\(b\)/)), both = page.pixels(page.find('4.20', /^\(c\)/));
    assert.ok(shareThatDiffers(one, both) > 0.05);
    // Sums of squares of a unit vector; black and white apart.
    let units = 0;
    for (let at = 0; at < both.data.length; at += 4) {
      const d = [...both.data.subarray(at, at + 3)].map((value) => value / 127.5 - 1), length = Math.hypot(...d);
      units += Math.abs(length - 1) < 0.02;
      assert.ok(Math.abs(length - 1) < 0.02 || Math.abs(length - Math.sqrt(3)) < 0.02, `length ${length}`);
    }
    assert.ok(units > 0.1 * side * side);
  });

  test('4.23: environments of the sizes that the titles say', () => {
    for (const size of [256, 512, 1024]) {
      const { command } = page.find('4.23', new RegExp(`^\\([abc]\\) ${size} x ${size},`));
      const file = command.match(/-e (\S+)/)[1], [, height, width] = readFileSync(join(page.where, file), 'latin1').match(/-Y (\d+) \+X (\d+)\n/).map(Number);
      assert.deepEqual([width, height], [size, size]);
      assert.equal(readFileSync(join(page.where, file)).length, readFileSync(join(page.where, file), 'latin1').search(/-Y .*\n/) + `-Y ${size} +X ${size}\n`.length + 4 * size * size);
    }
    const truth = page.pixels(page.find('4.23', /procedural/));
    const shares = [256, 512, 1024].map((size) => shareThatDiffers(page.pixels(page.find('4.23', new RegExp(` ${size} x`))), truth));
    assert.ok(shares[0] > shares[1] && shares[1] > shares[2], `the larger the nearer to the procedural one: ${shares}`);
  });
});

test('3.24 and 3.25: five steps lose a foot, five hundred steep layers, fifty little', () => {
  const steps = makePage('steps', '--size', '256', '--only', '3.24,3.25');
  const within = (id, count) => Number(steps.find(id, new RegExp(`^size 1/${count}, ${count} steps: `)).caption.match(/([\d.]+) % within/)[1]);
  const [five, fifty] = [within('3.24', 5), within('3.24', 50)];
  assert.ok(fifty > 82 && five < fifty - 8, `${five} % and ${fifty} %`);
  const [picture, better, truth] = [/^size 1\/5, 5 steps$/, /^size 1\/50, 50 steps$/, /^ray tracing/].map((pattern) => steps.pixels(steps.find('3.24', pattern)));
  const wrong = shareThatDiffers(picture, truth), right = shareThatDiffers(better, truth);
  assert.ok(right < 0.04 && wrong > 2 * right, `${wrong} and ${right} of the pixels differ from ray tracing`);
  assert.ok(within('3.25', 500) < within('3.25', 50) - 10);
});

describe('asked for what cannot be', () => {
  const refuses = (words, sentence) => test(words.slice(-2).join(' ') || 'no option', () => {
    const { status, error } = thesis(...words);
    assert.equal(status, 1);
    assert.match(error, sentence);
  });
  const output = ['-o', join(folder, 'refused')];
  refuses([], /^thesis: [^\n]*add -o FOLDER\n$/);
  refuses([...output, '--size', '9'], /^thesis: --size is '9'[^\n]*32 to 1024\n$/);
  refuses([...output, '--models', 'nowhere'], /^thesis: --models is 'nowhere'[^\n]*folder of \.glb files\n$/);
  refuses([...output, '--only', '4.5,9.9'], /^thesis: --only names '9\.9'[^\n]*4\.23, table\n$/);
});
