// Models that are hard to draw right, by the default technique and by the reference: values worked out by hand, and each
// beside the other; then the same in Chromium. Files: tests/cases; squares of one material each: case-rows.mjs. Needs
// VITRINE_BINARY, tests/package.json's packages, and for the last part what browser.test.mjs needs.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { answerWithFile, chromiumPath, launch, listen, openPage, quiet, skipWithout } from './browser-tools.mjs';
import { ball, box, edited, matt, model, quad, solid, thin, unlit } from './case-models.mjs';
import { drawingOf, rows } from './case-rows.mjs';
import { difference } from './difference.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const binary = resolve(process.env.VITRINE_BINARY ?? join(here, '../build/release/vitrine'));
const site = resolve(process.env.VITRINE_WEB ?? join(here, '../build/web'));
const [{ PNG }, modules] = [await import('pngjs').catch(() => ({})), await import('playwright-core').catch(() => null)];
const skip = skipWithout([PNG, "node modules (run 'npm ci' in tests/)"], [existsSync(binary), binary]);
const embree = skip ? false : !/without Embree/.test(spawnSync(binary, ['rays', 'ripples', '--relief-size', '4', '--rounds', '1']).stderr.toString());

const folder = mkdtempSync(join(tmpdir(), 'vitrine-cases-'));
after(() => rmSync(folder, { recursive: true, force: true }));

function pngOf(width, height, pixels) {
  const png = new PNG({ width, height });
  png.data.set(pixels.flat());
  return PNG.sync.write(png);
}

const byteOf = (linear) => 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);
const linearOf = (byte) => (byte <= 10.31 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);
const pixel = ({ data, width }, x, y) => [...data.subarray(4 * (y * width + x), 4 * (y * width + x) + 3)];

const drawn = new Map(); // by the arguments

/** Draws, if it was not drawn before; the picture and what the program said. */
function draw(args) {
  const key = args.join(' ');
  if (!drawn.has(key)) drawn.set(key, drawAnew(args));
  return drawn.get(key);
}

function drawAnew(args) {
  const result = spawnSync(binary, ['render', ...args, '-o', '-'], { cwd: folder, maxBuffer: 1 << 26 });
  assert.equal(result.status, 0, `${args.join(' ')}: ${result.stderr}`);
  return { picture: PNG.sync.read(result.stdout), notes: result.stderr.toString() };
}

function write(name, bytes) {
  writeFileSync(join(folder, name), bytes);
  return name;
}

const isShort = process.env.VITRINE_SANITIZE === '1'; // the reference is traced in the release build
const techniques = embree && !isShort ? ['exact', 'reference'] : ['exact'];
const all = skip ? {} : rows({ pngOf });
const nameOf = (name) => name.replaceAll(/[^\w]+/g, '-');

if (!skip) {
  for (const [name, level] of [['black', 0], ['white', 255]]) write(`${name}.png`, pngOf(2, 1, [[level, level, level, 255], [level, level, level, 255]]));
}

/** What the command line takes of a drawing. */
const argumentsOf = ({ width, height, environment, camera, target, fov, args }) => [
  '-r', `${width},${height}`, '-e', ['black', 'white'].includes(environment) ? `${environment}.png` : environment, '--camera', camera.join(), '--target', target.join(), '--fov', String(fov), ...args];

/** What of the points is wrong, in words. */
function wrongPoints(picture, points, technique) {
  return points.flatMap(({ name, x, y, value, within }) => {
    const seen = pixel(picture, x, y), wanted = value.map((light) => (light === null ? null : Math.round(byteOf(Math.min(light, 1)))));
    const isRight = wanted.every((byte, k) => byte === null || Math.abs(byte - seen[k]) <= within);
    return isRight ? [] : [`${technique}: ${name} at ${x}, ${y} is ${seen}, but ${wanted} is right`];
  });
}

// --------------------------------------------------------------------------------------------------- materials

describe('squares of one material each', { skip }, () => {
  for (const [name, row] of Object.entries(all)) {
    test(name, () => {
      const drawing = drawingOf(row), file = write(`${nameOf(name)}.glb`, drawing.file);
      const drawn = techniques.map((technique) => draw([file, ...argumentsOf(drawing), '-t', technique]));
      const wrong = drawn.flatMap(({ picture }, i) => wrongPoints(picture, drawing.points, techniques[i]));
      assert.ok(wrong.length === 0, wrong.join('; '));
      assert.doesNotMatch(drawn[0].notes, /open/, 'they are closed, or it does not matter');
      if (drawn.length === 2) {
        const { mean, apart } = difference(drawn[0].picture, drawn[1].picture);
        assert.ok(mean < 0.5 && apart < 0.01, `exact and reference differ by ${mean.toFixed(3)} in the mean, ${(100 * apart).toFixed(2)} % of the pixels visibly`);
      }
    });
  }
});

// ------------------------------------------------------------------------------------------------------- files

const size = [200, 150], eye = 5, halfHeight = Math.tan(Math.PI / 8);
const usual = ['-r', size.join(), '--camera', `0,0,${eye}`, '--target', '0,0,0'];
const fileOf = (name) => join(here, 'cases', name.includes('.') ? name : `${name}.glb`);

/** The pixel that shows a point of the world. */
const pixelOf = (x, y, z = 0) => [size[0] / 2 + (x * size[1]) / 2 / (eye - z) / halfHeight, size[1] / 2 - (y * size[1]) / 2 / (eye - z) / halfHeight].map(Math.floor);
/** Linear light of the pixel that shows a point. */
const lightAt = (picture, ...point) => pixel(picture, ...pixelOf(...point)).map(linearOf);

/** What an interface of index 1.5 reflects at that cosine. */
function fresnel(cosine, ior = 1.5) {
  const inside = Math.sqrt(1 - (1 - cosine * cosine) / ior ** 2);
  return (((cosine - ior * inside) / (cosine + ior * inside)) ** 2 + ((ior * cosine - inside) / (ior * cosine + inside)) ** 2) / 2;
}

/** The file with these nodes far away. */
const without = (name, ...nodes) => write(`${name}-without.glb`, edited(readFileSync(fileOf(name)), (json) => nodes.forEach((node) => (json.nodes[node].translation = [0, 900, 0]))));

/** Pixels of which the test says yes, and the columns and rows that hold them. */
function find(picture, isIt) {
  const found = { count: 0, left: Infinity, top: Infinity, right: -1, bottom: -1 };
  for (let y = 0; y < picture.height; ++y) {
    for (let x = 0; x < picture.width; ++x) {
      if (!isIt(...pixel(picture, x, y), x, y)) continue;
      Object.assign(found, { count: found.count + 1, left: Math.min(found.left, x), top: Math.min(found.top, y), right: Math.max(found.right, x), bottom: Math.max(found.bottom, y) });
    }
  }
  return found;
}

/** Colours as bytes, one by one. @param {[number[], number[], string][]} rows linear light seen, right, and where */
function same(rowsOf, within) {
  const wrong = rowsOf.filter(([seen, right]) => right.some((light, k) => Math.abs(byteOf(seen[k]) - byteOf(Math.min(light, 1))) > within));
  assert.ok(wrong.length === 0, wrong.map(([seen, right, where]) => `${where} is ${seen.map(byteOf).map(Math.round)}, but ${right.map((light) => Math.round(byteOf(light)))} is right`).join('; '));
}

const inWhite = ['-e', 'white.png'], inBlack = ['-e', 'black.png'];

/** By name: what is drawn, and what must be seen, of either technique. */
const files = {
  'label-behind-glass': {
    args: ['-r', '150,100', '-e', 'sky', '--camera', '0.6,0.4,4.5', '--target', '0,0,0'],
    // Its glass has no volume: nothing is bent. With one: 646.
    check: ({ picture }) => assert.equal(find(picture, (r, g, b) => r > 150 && g < 100 && b < 100).count, 580),
  },
  'label-behind-glass, solid': {
    file: () => solidOf('label-behind-glass'), args: ['-r', '150,100', '-e', 'sky', '--camera', '0.6,0.4,4.5', '--target', '0,0,0'],
    check: ({ picture }) => assert.equal(find(picture, (r, g, b) => r > 150 && g < 100 && b < 100).count, 646),
  },
  'neon-thin': {
    args: ['-r', '200,200', '-e', 'studio', '--camera', '0,0,3.4', '--target', '0,0,0'],
    check: ({ picture }) => assert.ok(find(picture, (r, g, b) => r > g + 60 && b > g + 40).count > 1200),
  },
  'neon-thin, solid': {
    file: () => solidOf('neon-thin'), args: ['-r', '400,400', '-e', 'studio', '--camera', '0,0,3.4', '--target', '0,0,0'],
    check: ({ picture }) => assert.ok(Math.abs(find(picture, (r, g, b) => r > g + 60 && b > g + 40).count - 7715) < 20),
  },
  'decal-coincident': {
    check: ({ picture }) => {
      const { count, left, top, right, bottom } = find(picture, (r, g, b) => r > 1.5 * g && r > 1.5 * b);
      assert.equal(count, (right - left + 1) * (bottom - top + 1), 'a whole rectangle');
    },
  },
  'self-overlap': { args: [...usual, '--no-fresnel'] }, // what reflects in it is more than is followed
  'ior1-tint': {
    args: [...usual, ...inWhite], behind: [1, 2],
    check: ({ picture, empty }) => same([[-1, 0], [-1.3, 0.2], [1, 0]].map(([x, y]) => [lightAt(picture, x, y), lightAt(empty, x, y).map((light, k) => light * [0.1, 0.5, 0.9][k] ** 2), `${x}, ${y}`]), 2),
  },
  'sheet-ior1': {
    args: [...usual, ...inWhite], behind: [1],
    check: ({ picture, empty }) => same([[0, 0], [-0.7, 0.5], [0.8, -0.7]].map(([x, y]) => [lightAt(picture, x, y), lightAt(empty, x, y).map((light) => light * 0.1), `${x}, ${y}`]), 1),
  },
  'lens-two-sheets': {
    args: [...usual, ...inWhite], behind: [1, 2],
    check: ({ picture, empty }) => same([[0, 0], [-0.7, 0.5], [0.8, -0.7]].map(([x, y]) => [lightAt(picture, x, y), lightAt(empty, x, y).map((light) => light * 0.01 * 0.96 + 0.0004), `${x}, ${y}`]), 1),
  },
  'ior-zero': {
    args: [...usual, ...inWhite],
    check: ({ picture }) => same([[0, 0], [0.3, 0.2], [-0.5, 0.1]].map(([x, y]) => [lightAt(picture, x, y), [1, 1, 1], `${x}, ${y}`]), 1),
  },
  'ior-zero, in the dark': { args: [...usual, ...inBlack], file: () => fileOf('ior-zero'), check: ({ picture }) => same([[lightAt(picture, 0, 0), [0, 0, 0], 'the middle']], 0) },
  'thin-pane-edge': {
    args: ['-r', '401,101', '--fov', '20', '--camera', '0,0,5', '--target', '0,0,0'],
    check: ({ picture }) => {
      for (let y = 2; y < 99; ++y) {
        const [[r, , b], [R, , B]] = [pixel(picture, 199, y), pixel(picture, 201, y)];
        assert.ok(r > b + 50 && B > R + 50, `row ${y}: ${[r, b, R, B]}`);
      }
    },
  },
  'thin-pane': {
    args: [...usual, ...inWhite], behind: [1],
    check: ({ picture, empty }) => same([[0, 0], [0.3, 0.4], [-0.3, -0.5], [0.1, 0.6]].map(([x, y]) => {
      const cosine = (5 * Math.cos((50 * Math.PI) / 180) - x * Math.sin((50 * Math.PI) / 180)) / Math.hypot(x, y, 5);
      const F = fresnel(cosine);
      return [lightAt(picture, x, y), lightAt(empty, x, y).map((light) => 0.5 * (1 - F) * light + F), `${x}, ${y}`];
    }), 2),
  },
  'thin-bubble': {
    args: [...usual, ...inWhite], behind: [1],
    check: ({ picture, empty }) => same([[0, 0], [0.2, 0.1], [-0.4, 0.3], [0.5, -0.3], [0.1, 0.6]].map(([x, y]) => {
      const beside = (5 * Math.hypot(x, y)) / Math.hypot(x, y, 5) / 0.9, F = fresnel(Math.sqrt(1 - beside * beside));
      const through = 0.81 * (1 - F) ** 2; // of the backdrop; of what the far wall reflects, too
      return [lightAt(picture, x, y), lightAt(empty, x, y).map((light) => through * light + F + through * F), `${x}, ${y}`];
    }), 4),
  },
  'sheet-grey': { args: ['-r', '101,101', '--camera', '0,0,5', '--target', '0,0,0'], check: ({ picture }) => assert.deepEqual(pixel(picture, 50, 50), [135, 135, 135]) },
  'two-material-body': {
    args: [...usual, ...inWhite], behind: [1],
    check: ({ picture, empty }) => same([[-0.3, 0.1, [1, 0.3, 0.3]], [0.3, 0.1, [0.3, 0.3, 1]], [-0.3, -0.3, [1, 0.3, 0.3]]].map(([x, y, color]) => {
      const beside = (5 * Math.hypot(x, y)) / Math.hypot(x, y, 5) / 0.8, F = fresnel(Math.sqrt(1 - beside * beside));
      return [lightAt(picture, x, y), lightAt(empty, x, y).map((light, k) => color[k] ** 2 * (1 - F) ** 2 * (light + F) + F), `${x}, ${y}`];
    }), 8), // what the far wall reflects may leave through either half
  },
  'two-material-body, solid': {
    file: () => solidOf('two-material-body'), args: [...usual, ...inWhite], check: ({ notes }) => assert.doesNotMatch(notes, /not closed/),
  },
  'glass-pictures': {
    args: [...usual, ...inWhite, '--roughness', '0'], // what is seen through them is worked out for smooth glass
    behind: [1, 2, 3],
    check: ({ picture, empty }) => {
      const behind = ([x, y, color]) => {
        const F = 0.04, back = lightAt(empty, x, y);
        return [lightAt(picture, x, y), color.map((share, k) => F + (share * (1 - F)) ** 2 * (back[k] + F)), `${x}, ${y}`];
      };
      same([[-1.4, 0.1, [1, 0, 0]], [-1.4, -0.5, [1, 0, 0]], [-0.95, 0.1, [0, 0, 1]], [1.1, 0.3, [0.9, 0.6, 0.1]]].map(behind), 6);
      const [left, right] = [lightAt(picture, -0.4, 0.1), lightAt(picture, 0.4, 0.1)];
      assert.ok(left[0] > 1.5 * left[2] && right[2] > 1.5 * right[0], `vertex colours: ${left}, ${right}`);
      same([[lightAt(picture, 1.5, 0.2), [0.94, 0.64, 0.14], 'what is opaque, smooth']], 4);
    },
  },
  'alpha-blend': {
    args: [...usual, ...inWhite], behind: [1, 2],
    check: ({ picture, empty }) => {
      // Two walls, each a quarter there and black; a quarter of what each reflects. A quarter of a matt blue.
      same([[-0.7, 0], [-0.5, 0.3], [-0.9, -0.3]].map(([x, y]) => [lightAt(picture, x, y), lightAt(empty, x, y).map((light) => 0.75 ** 2 * light + 0.01 * (1 + 0.75 ** 2)), `${x}, ${y}`]), 3);
      same([[0.7, 0.1], [0.5, 0.3], [0.9, -0.3]].map(([x, y]) => [lightAt(picture, x, y), lightAt(empty, x, y).map((light, k) => 0.75 * light + 0.25 * ([0.1, 0.2, 0.9][k] + 0.016)), `${x}, ${y}`]), 2);
    },
  },
  'specular-zero': {
    args: [...usual, '-e', 'sky'], behind: [2],
    check: ({ picture, empty }) => assert.equal(find(picture, (r, g, b, x, y) => x > size[0] / 2 + 5 && pixel(empty, x, y).some((other, k) => Math.abs(other - [r, g, b][k]) > 1)).count, 0),
  },
  'emissive-picture': {
    args: [...usual, ...inBlack],
    check: ({ picture }) => same([[lightAt(picture, -1, 1, -2), [1, 0, 0], 'left'], [lightAt(picture, 1, 1, -2), [0, 0, 1], 'right'], [lightAt(picture, -0.2, 0.1), [0.9216, 0, 0], 'left, through the ball']], 3),
  },
  'texture-transform': {
    args: [...usual, ...inWhite],
    check: ({ picture }) => same([-1.4, -1.25, -1, -0.8, 0.85, 1.05, 1.2, 1.45].map((y) => [lightAt(picture, 1.2, y, -2), ((4 * (1.5 - y)) / 3) % 1 < 0.5 ? [1, 0.016, 0.016] : [0.016, 0.016, 1], `y = ${y}`]), 3),
  },
  'sampler-clamp': {
    args: [...usual, ...inWhite],
    check: ({ picture }) => same([[-1.46, [1, 0.016, 0.016]], [-0.04, [1, 0.016, 0.016]], [0.06, [0.016, 0.016, 1]], [1.46, [0.016, 0.016, 1]]].map(([x, color]) => [lightAt(picture, x, 1, -2), color, `x = ${x}`]), 3),
  },
  'light-point': {
    args: [...usual, ...inBlack, '--exposure', '-6'],
    check: ({ picture, notes }) => {
      same([[1.5, 0], [1.5, 1], [2.5, 0.5], [0.5, -1]].map(([x, y]) => {
        const distance = Math.hypot(x - 1.5, y, 1);
        return [lightAt(picture, x, y, -3), [((0.8 / Math.PI) * 100) / distance ** 3 / 64, 0, 0], `${x}, ${y}`];
      }), 4);
      assert.equal(notes, '', 'the light is not ignored');
    },
  },
  instancing: {
    args: [...usual, '-e', 'sky'], behind: [0],
    check: ({ picture, empty }) => {
      const differs = (r, g, b, x, y) => pixel(empty, x, y).some((other, k) => Math.abs(other - [r, g, b][k]) > 3);
      for (const middle of [-1.5, -0.5, 0.5, 1.5]) {
        const [left, top] = pixelOf(middle - 0.31, 0.31), [right, bottom] = pixelOf(middle + 0.31, -0.31);
        assert.ok(find(picture, (r, g, b, x, y) => x >= left && x <= right && y >= top && y <= bottom && differs(r, g, b, x, y)).count > 50, `a ball at ${middle}`);
      }
      const balls = [-1.5, -0.5, 0.5, 1.5].map((middle) => pixelOf(middle, 0));
      assert.equal(find(picture, (r, g, b, x, y) => differs(r, g, b, x, y) && balls.every(([X, Y]) => Math.hypot(x - X, y - Y) > 13)).count, 0);
    },
  },
  'skin-bind': {
    args: [...usual, '-e', 'sky'], behind: [0],
    check: ({ picture, empty }) => {
      const { left, top, right, bottom } = find(picture, (r, g, b, x, y) => y > 10 && pixel(empty, x, y).some((other, k) => Math.abs(other - [r, g, b][k]) > 1));
      const [wantedLeft, wantedTop] = pixelOf(-1, 1.5, 0.25), [wantedRight, wantedBottom] = pixelOf(1, 0.5, 0.25);
      [[left, wantedLeft], [top, wantedTop], [right, wantedRight]].forEach(([seen, right_]) => assert.ok(Math.abs(seen - right_) <= 2, `${[left, top, right, bottom]} for ${[wantedLeft, wantedTop, wantedRight, wantedBottom]}`));
    },
  },
  'frame-lamp': {
    args: ['-r', size.join()],
    check: ({ picture }) => {
      const { top, bottom } = find(picture, (r, g, b) => r > b + 30 && r > g + 10); // its foot of wood
      assert.ok(bottom - top > 0.7 * size[1] && bottom < size[1] - 1 && top > 0.08 * size[1], `rows ${top} to ${bottom}`);
    },
  },
  'unknown-extension-keys': {},
  'opaque-nested-open': {},
  // As clear glass of one index: one sample of what is rough or disperses is not what the reference's is.
  'rough-glass': { args: [...usual, '--roughness', '0'], check: ({ notes }) => assert.equal(notes, '') },
  dispersion: { args: [...usual, '--no-fresnel'], check: ({ notes }) => assert.equal(notes, '') },
};

const solidOf = (name) => write(`${name}-solid.glb`, edited(readFileSync(fileOf(name)), (json) => json.materials.filter(({ extensions }) => extensions?.KHR_materials_transmission).forEach(({ extensions }) => (extensions.KHR_materials_volume = { thicknessFactor: 1 }))));

describe('files', { skip }, () => {
  for (const [name, { args = usual, behind, check, file = () => fileOf(name) }] of Object.entries(files)) {
    test(name, () => {
      const path = file(), drawn = [];
      for (const technique of techniques) {
        drawn.push(draw([path, ...args, '-t', technique]));
        const empty = behind && draw([without(name, ...behind), ...args, '-t', technique]).picture;
        check?.({ ...drawn.at(-1), empty });
      }
      if (drawn.length === 2) {
        const { mean, apart } = difference(drawn[0].picture, drawn[1].picture);
        assert.ok(mean < 0.6 && apart < 0.01, `exact and reference differ by ${mean.toFixed(3)} in the mean, ${(100 * apart).toFixed(2)} % of the pixels visibly`);
      }
    });
  }

  test('a box of one side is not seen from within', () => {
    const file = write('within.glb', model([{ mesh: box(2, 2, 2), material: unlit([1, 0, 0]) }, { mesh: ball(0.2), material: solid([1, 1, 1]), translation: [0, 0, -5] }]));
    for (const technique of techniques) {
      const { picture } = draw([file, '-r', '60,40', '--camera', '0,0,0.5', '--target', '0,0,-5', '-t', technique]);
      assert.equal(find(picture, (red, green, blue) => red > 200 && green + blue < 100).count, 0, technique);
    }
  });

  test('far-origin is as the same at the origin', () => {
    const far = draw(['-r', '200,200', '--object', fileOf('far-origin'), '--camera', '100000.5,20000.25,-49995', '--target', '100000,20000,-50000']).picture;
    const near = draw(['-r', '200,200', '--object', `${fileOf('far-origin')}:at=-100000,-20000,50000`, '--camera', '0.5,0.25,5', '--target', '0,0,0']).picture;
    assert.equal(difference(far, near).apart, 0);
  });

  const refuses = (args, ...words) => {
    const result = spawnSync(binary, ['render', ...args, '-o', 'refused.png'], { cwd: folder });
    assert.equal(result.status, 1, result.stderr.toString());
    assert.match(result.stderr.toString().replaceAll(/^vitrine: note: .*\n/gm, ''), /^vitrine: [^\n]+\n$/);
    for (const word of words) assert.ok(result.stderr.toString().includes(word), `'${word}' is not in: ${result.stderr}`);
  };

  test('files that are refused', () => {
    refuses([fileOf('u_zero.gltf'), '-r', '20,20'], 'u_zero.gltf', 'folder');
    refuses([write('half.glb', model([{ mesh: quad(), material: thin([1, 1, 1], { extensions: { KHR_materials_ior: { ior: 0.5 } } }) }])), '-r', '20,20'], 'half.glb', '0.5', 'ior');
    const { notes } = draw([write('half-opaque.glb', model([{ mesh: quad(), material: thin() }, { mesh: quad(), material: matt([1, 0, 0], { extensions: { KHR_materials_ior: { ior: 0.5 } } }) }])), '-r', '20,20']);
    assert.match(notes, /ignored: an index of refraction of 0\.5/); // what is opaque only reflects by it
  });

  test('variants of materials', () => {
    const [red, green, blue] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((color) => unlit(color));
    const file = write('variants.glb', model([
      { mesh: quad(1), material: red, variantsOf: [{ material: green, variants: [0] }, { material: blue, variants: [1, 2] }] },
      { mesh: quad(), material: thin(), translation: [9, 0, 0] },
    ], { variants: ['leaf', 'sea', 'sky'] }));
    for (const technique of techniques) {
      for (const [args, color] of [[[], [255, 0, 0]], [['--variant', 'leaf'], [0, 255, 0]], [['--variant', 'sea'], [0, 0, 255]], [['--variant', 'sky'], [0, 0, 255]]]) {
        const { picture, notes } = draw([file, '-r', '20,20', '--camera', '0,0,3', '--target', '0,0,0', ...args, '-t', technique]);
        assert.deepEqual(pixel(picture, 10, 10), color, args.join(' '));
        assert.equal(/ignored: 3 variants/.test(notes), args.length === 0, notes);
      }
    }
    refuses([file, '--variant', 'sand', '-r', '20,20'], 'variants.glb', "'sand'", 'leaf');
  });

  test('panes turned by other angles before an edge move nothing', () => {
    for (const [degrees, x, z] of [[-25, 0.1, 0.3], [60, -0.2, -0.5], [75, 0, 1]]) {
      const half = (degrees * Math.PI) / 360, rotation = [0, Math.sin(half), 0, Math.cos(half)];
      const file = write('pane.glb', model([
        { mesh: quad(3, 6), material: unlit([1, 0, 0]), translation: [-1.5, 0, -3] }, { mesh: quad(3, 6), material: unlit([0, 0, 1]), translation: [1.5, 0, -3] },
        { mesh: quad(2), material: thin(), translation: [x, 0, z], rotation },
      ]));
      for (const technique of techniques) {
        const { picture } = draw([file, '-r', '101,21', '--fov', '5', '--camera', '0,0,5', '--target', '0,0,0', '-t', technique]);
        const edge = [pixel(picture, 49, 10), pixel(picture, 51, 10)];
        assert.ok(edge[0][0] > edge[0][2] + 50 && edge[1][2] > edge[1][0] + 50, `${degrees} degrees, ${technique}: ${edge}`);
      }
    }
  });

  test('sheets of index 1 are no events, and each costs as many reads as the others', { skip: !embree && 'built without Embree' }, () => {
    const sheets = (count) => write(`sheets-${count}.glb`, model([
      { mesh: quad(4), material: unlit([0.5, 0.6, 0.8]), translation: [0, 0, -3] },
      ...Array.from({ length: count }, (_, i) => ({ mesh: quad(), translation: [0, 0, -0.05 * i], material: thin([0.95, 0.95, 0.95], { extensions: { KHR_materials_ior: { ior: 1 } } }) })),
    ]));
    const args = ['-r', '48,48', '--camera', '0,0,3', '--target', '0,0,0'];
    draw([sheets(30), ...args, '-t', 'reference', '--events', 'events.png']);
    const events = PNG.sync.read(readFileSync(join(folder, 'events.png')));
    assert.ok(events.data.every((value, i) => i % 4 === 3 || value === 0), 'no events');
    const reads = [1, 10, 30].map((count) => {
      const result = spawnSync(binary, ['bench', sheets(count), '-t', 'exact', '--rounds', '1', '--resolution', '32,32', '--json'], { cwd: folder });
      return JSON.parse(result.stdout.toString()).cases[0].techniques[0].readsAPath;
    });
    assert.ok(reads[2] < 30 * reads[0] && (reads[2] - reads[1]) / 20 < (1.2 * (reads[1] - reads[0])) / 9, reads.join());
  });
});

// ----------------------------------------------------------------------------------------------- in Chromium

/** What the element is told where the command line has these arguments. */
function propertiesOf(args) {
  const given = (name, standard) => (args.includes(name) ? args[args.indexOf(name) + 1] : standard);
  const [width, height] = given('-r').split(',').map(Number), environment = given('-e', 'studio'), camera = given('--camera');
  const more = {};
  if (camera) {
    const [at, target] = [camera, given('--target')].map((text) => text.split(',').map(Number)), [x, y, z] = at.map((place, i) => place - target[i]);
    const distance = Math.hypot(x, y, z);
    Object.assign(more, { cameraOrbit: `${Math.atan2(x, z)}rad ${Math.acos(y / distance)}rad ${distance}m`, cameraTarget: target.map((place) => `${place}m`).join(' ') });
  }
  return {
    width, height, environmentImage: environment.includes('.') ? `/${environment}` : environment, exposure: 2 ** given('--exposure', 0), fieldOfView: `${given('--fov', 45)}deg`,
    fresnel: args.includes('--no-fresnel') ? 'off' : 'on', cameraOrbit: 'auto auto auto', cameraTarget: 'auto auto auto',
    roughness: args.includes('--roughness') ? Number(given('--roughness')) : null, ...more,
  };
}

const skipBrowser = skip || (process.env.VITRINE_SANITIZE === '1' && 'the page has no sanitizers: the release build draws it') || skipWithout([modules, "node modules (run 'npm ci' in tests/)"], [existsSync(join(site, 'element/vitrine-viewer.js')), `${site}/element`], [existsSync(chromiumPath), chromiumPath]);

describe('in Chromium, as the program draws it', { skip: skipBrowser }, () => {
  let server, browser, page;
  const complaints = [];

  before(async () => {
    server = await listen((request, response) => {
      const { pathname } = new URL(request.url, 'http://localhost'), made = join(folder, pathname), kept = join(here, 'cases', pathname);
      if (pathname === '/page.html') {
        response.writeHead(200, { 'content-type': 'text/html' }).end('<!doctype html><html lang="en"><title>Cases</title><link rel="icon" href="/black.png"><style>body { margin: 0 }</style>'
          + '<script type="module" src="/element/vitrine-viewer.js"></script><vitrine-viewer id="a" samples="1" tone-mapping="none" skybox-image style="width: 64px; height: 64px"></vitrine-viewer>');
      } else if (existsSync(made)) response.writeHead(200).end(readFileSync(made));
      else if (existsSync(kept)) response.writeHead(200).end(readFileSync(kept));
      else answerWithFile(site, pathname, response);
    });
    browser = await launch();
    page = await openPage(browser, { viewport: { width: 500, height: 450 } });
    page.on('pageerror', (error) => complaints.push(String(error)));
    page.on('console', (message) => {
      if (['error', 'warning'].includes(message.type()) && !/GPU stall|fallback to software/.test(message.text())) complaints.push(message.text());
    });
    await page.goto(`${server.address}/page.html`);
  });
  after(async () => {
    await browser?.close();
    server?.close();
  });

  async function compare(file, args, mostApart = 0.01) {
    const url = file.startsWith(here) ? file.slice(join(here, 'cases').length) : `/${file}`;
    const { width, height, ...values } = propertiesOf(args);
    await page.evaluate(([side, more]) => {
      Object.assign(a.style, side);
      Object.assign(a, more);
    }, [{ width: `${width}px`, height: `${height}px` }, { ...values, src: url }]);
    await page.waitForFunction((src) => a.loaded && a.src === src, url);
    await quiet(page);
    const message = await page.evaluate(() => {
      const part = a.shadowRoot.querySelector('[part=message]');
      return part.hidden ? '' : part.textContent;
    });
    assert.equal(message, '');
    const data = await page.evaluate(() => a.toDataURL());
    const seen = PNG.sync.read(Buffer.from(data.split(',')[1], 'base64'));
    const { mean, apart } = difference(seen, draw([file, ...args, '-t', 'exact']).picture);
    assert.ok(mean < 0.5 && apart <= mostApart, `${mean.toFixed(3)} in the mean, ${(100 * apart).toFixed(2)} % of the pixels visibly`);
    assert.deepEqual(complaints.splice(0), []);
    return seen;
  }

  for (const [name, row] of Object.entries(all)) {
    test(name, async () => {
      const drawing = drawingOf(row), file = write(`${nameOf(name)}.glb`, drawing.file);
      const wrong = wrongPoints(await compare(file, argumentsOf(drawing)), drawing.points, 'the element');
      assert.ok(wrong.length === 0, wrong.join('; '));
    });
  }
  for (const [name, { args = usual, file = () => fileOf(name) }] of Object.entries(files)) {
    test(name, () => compare(file(), args));
  }
  test('rough glass, with pictures of its roughness', () => compare(fileOf('rough-glass'), usual));
});
