// Numbers at the ends of what there is: scales, places, indices, eyes, triangles, light. Each is drawn by technique
// `exact` and by the reference, which must agree, all of the picture finite; or refused in a sentence. VITRINE_LONG=1
// also draws each decade, and by the techniques that peel. Needs VITRINE_BINARY.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { inflateSync } from 'node:zlib';
import { cube, glb, gltf } from '../scripts/glb.mjs';
import { exr } from './bombs.mjs';
import { ball, edited, model, solid, thin } from './case-models.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const binary = resolve(process.env.VITRINE_BINARY ?? join(here, '../build/release/vitrine'));
const skip = existsSync(binary) ? false : `no ${binary}`;
const embree = !skip && !/without Embree/.test(spawnSync(binary, ['rays', 'ripples', '--relief-size', '4', '--rounds', '1']).stderr.toString());
const long = process.env.VITRINE_LONG === '1';
const more = long ? test : () => {}; // of the same
const folder = mkdtempSync(join(tmpdir(), 'vitrine-numbers-'));
after(() => rmSync(folder, { recursive: true, force: true }));

// ----------------------------------------------------------------------------------------------------- pictures

const side = 32;

const nextText = (bytes, at) => bytes.toString('latin1', at, bytes.indexOf(0, at));

/** All numbers of a picture that `vitrine` has written: OpenEXR, floats in ZIP chunks of 16 lines. */
function numbersOf(exr) {
  let at = 8, height = 0;
  for (let name = nextText(exr, at); name !== ''; name = nextText(exr, at)) {
    at += name.length + 1;
    at += nextText(exr, at).length + 1;
    const size = exr.readInt32LE(at), window = at + 4;
    if (name === 'dataWindow') height = exr.readInt32LE(window + 12) - exr.readInt32LE(window + 4) + 1;
    at = window + size;
  }
  const chunks = Math.ceil(height / 16), numbers = [];
  at += 1 + 8 * chunks;
  for (let chunk = 0; chunk < chunks; ++chunk) {
    const size = exr.readInt32LE(at + 4), texels = side * Math.min(16, height - 16 * chunk), data = exr.subarray(at + 8, at + 8 + size);
    const isPlain = size === 12 * texels || size === 16 * texels; // packing would not make it smaller
    const packed = isPlain ? data : inflateSync(data), bytes = Buffer.from(packed), half = Math.ceil(packed.length / 2);
    for (let i = 1; i < packed.length && !isPlain; ++i) packed[i] = (packed[i - 1] + packed[i] - 128) & 255;
    for (let i = 0; i < packed.length && !isPlain; ++i) bytes[i] = packed[i % 2 === 0 ? i / 2 : half + (i - 1) / 2];
    for (let i = 0; i < bytes.length; i += 4) numbers.push(bytes.readFloatLE(i));
    at += 8 + size;
  }
  return numbers;
}

function draw(args, technique) {
  const files = ['directions.pfm', 'picture.exr'].map((name) => join(folder, name));
  files.forEach((file) => rmSync(file, { force: true }));
  const result = spawnSync(binary, ['render', ...args, '-t', technique, '-r', `${side},${side}`, '--directions', files[0], '-o', files[1]], { cwd: folder, timeout: 60000 });
  const error = result.stderr.toString(), what = `${technique}: ${error}`;
  assert.equal(result.signal, null, `${what} killed`);
  if (result.status !== 0) return { code: result.status, error };
  const bytes = readFileSync(files[0]), directions = new Float32Array(bytes.buffer.slice(bytes.byteOffset + bytes.length - 12 * side * side, bytes.byteOffset + bytes.length));
  const numbers = numbersOf(readFileSync(files[1]));
  assert.equal(numbers.length % (side * side), 0);
  assert.ok(numbers.every(Number.isFinite), `${technique}: the picture has ${numbers.filter((number) => !Number.isFinite(number)).length} numbers that are none`);
  for (let i = 0; i < directions.length; i += 3) {
    const length = Math.hypot(...directions.subarray(i, i + 3));
    assert.ok(length === 0 || Math.abs(length - 1) < 1e-3 || Math.abs(length - Math.sqrt(12)) < 1e-3, `${technique}: a direction of length ${length}`);
  }
  return { code: 0, error, directions, numbers };
}

/** Share of the pixels whose directions are within a degree, or both none. */
function agreement(a, b) {
  let same = 0;
  for (let i = 0; i < a.length; i += 3) {
    const [p, q] = [a.subarray(i, i + 3), b.subarray(i, i + 3)], [l, m] = [Math.hypot(...p), Math.hypot(...q)];
    same += Math.abs(l - m) < 1e-2 && (l === 0 || l > 2 || p[0] * q[0] + p[1] * q[1] + p[2] * q[2] >= Math.cos(Math.PI / 180)) ? 1 : 0;
  }
  return same / (a.length / 3);
}

const hits = (directions) => directions.filter((_, i) => i % 3 === 0 && Math.hypot(...directions.subarray(i, i + 3)) > 0).length;

/** Draws by both; the directions of `exact`. `least`: pixels that must have met glass; `most`: that may. */
function agrees(args, { least = 100, most = side * side } = {}) {
  const exact = draw(args, 'exact');
  assert.equal(exact.code, 0, exact.error);
  assert.ok(hits(exact.directions) >= least && hits(exact.directions) <= most, `${hits(exact.directions)} pixels have met glass`);
  if (embree) {
    const reference = draw(args, 'reference');
    assert.equal(reference.code, 0, reference.error);
    const share = agreement(exact.directions, reference.directions);
    assert.ok(share >= 0.98, `exact and reference agree on ${(100 * share).toFixed(1)} % of the pixels`);
  }
  return exact;
}

/** Exit code 1, and a last line that holds all parts. */
function refuses(args, ...parts) {
  for (const technique of embree ? ['exact', 'reference'] : ['exact']) {
    const result = draw(args, technique);
    assert.equal(result.code, 1, `exit code ${result.code}`);
    const last = result.error.trimEnd().split('\n').at(-1);
    assert.match(last, /^vitrine: /);
    for (const part of parts) assert.ok(last.includes(part), `'${part}' is not in: ${last}`);
  }
}

/** OpenEXR of floats, a line a chunk, not packed; three numbers a pixel. */
function exrOf(width, height, numbers) {
  const channels = [2, 1, 0], lines = Array.from({ length: height }, (_, y) => { // B, G, R
    const line = new Float32Array(3 * width).map((_number, i) => numbers[3 * (y * width + (i % width)) + channels[Math.floor(i / width)]]);
    return Buffer.concat([Buffer.from(new Int32Array([y, line.byteLength]).buffer), Buffer.from(line.buffer)]);
  });
  const head = exr(width, height, 0, 2, Buffer.alloc(0)).length, [{ length }] = lines;
  const places = new BigInt64Array(height).map((_, y) => BigInt(head + 8 * height + y * length));
  return exr(width, height, 0, 2, Buffer.concat([Buffer.from(places.buffer), ...lines]));
}

// ------------------------------------------------------------------------------------------------------- models

function write(name, bytes) {
  writeFileSync(join(folder, name), bytes);
  return name;
}

const round = ball(1, 8);
const scaled = (mesh, scale, offset = [0, 0, 0]) => ({ ...mesh, positions: mesh.positions.map((place, i) => place * scale + offset[i % 3]) });
const glass = (mesh, material = solid([1, 1, 1])) => write('glass.glb', model([{ mesh, material }]));
const bare = (positions, indices) => write('bare.glb', glb(gltf({ positions, indices })));
const decades = (from, to, step) => Array.from({ length: Math.floor((to - from) / step) + 1 }, (_, i) => from + i * step);

const plain = new Map(); // by technique: directions of the ball of size 1

/** The same picture as that. */
function isSame(directions, technique = 'exact', least = 0.99) {
  if (!plain.has(technique)) plain.set(technique, draw([glass(round)], technique).directions);
  const share = agreement(directions, plain.get(technique));
  assert.ok(share >= least, `${technique}: as at size 1 on ${(100 * share).toFixed(1)} % of the pixels`);
}

describe('sizes and places', { skip }, () => {
  for (const exponent of long ? decades(-18, 18, 1) : [-18, -12, 12, 18]) {
    test(`vertices of 1e${exponent}`, () => isSame(agrees([glass(scaled(round, 10 ** exponent))]).directions));
  }
  test('big.glb, to 1e18', () => agrees([join(here, 'cases/big.glb')]));
  for (const exponent of long ? decades(-18, 18, 3) : [-12]) {
    for (const technique of long ? ['wyman', 'layered', 'oliveira', 'single', 'kay-thickness'] : ['wyman']) {
      test(`vertices of 1e${exponent}, ${technique}`, () => isSame(draw([glass(scaled(round, 10 ** exponent))], technique).directions, technique, 0.97));
    }
  }
  for (const exponent of long ? decades(-9, 9, 1) : [-9, 9]) {
    test(`scale=1e${exponent}`, () => agrees(['--object', `sphere:scale=1e${exponent}`]));
  }
  for (const exponent of long ? decades(3, 6, 1) : [6]) {
    test(`vertices 1e${exponent} away`, () => agrees([glass(scaled(round, 1, [10 ** exponent, 0, 10 ** exponent]))]));
    test(`moved 1e${exponent} away`, () => agrees(['--object', `sphere:at=1e${exponent},0,-1e${exponent}`]));
  }
  test('a ground far away and of any size', () => {
    for (const scale of [1e-12, 1e12]) {
      const { numbers } = draw([glass(scaled(round, scale)), '--ground'], 'exact'), plain = draw([glass(round), '--ground'], 'exact').numbers;
      const apart = numbers.filter((number, i) => Math.abs(number - plain[i]) > 0.02 * Math.max(plain[i], 0.1)).length;
      assert.ok(apart < 0.01 * numbers.length, `scale ${scale}: ${apart} of ${numbers.length} numbers differ`);
    }
  });
  test('absorption goes with the size', () => {
    const of = (scale) => model([{ mesh: scaled(round, scale), material: solid([1, 1, 1], { extensions: { KHR_materials_volume: { thicknessFactor: 1, attenuationColor: [0.2, 0.5, 0.9], attenuationDistance: scale } } }) }]);
    const [plain, large] = [1, 1e12].map((scale) => draw([write('absorbs.glb', of(scale))], 'exact').numbers);
    const apart = large.filter((number, i) => Math.abs(number - plain[i]) > 0.02 * Math.max(plain[i], 0.1)).length;
    assert.ok(apart < 0.01 * large.length, `${apart} of ${large.length} numbers differ`);
  });
  test('a mote beside a giant', () => agrees(['--object', 'sphere:scale=1e-6,at=0,0,1', '--object', 'sphere:scale=1000,at=0,0,-2000', '--camera', '0,0,1.00001', '--target', '0,0,0']));
  test('too large', () => refuses([glass(scaled(round, 1e20))], 'reaches 1e+20 from the origin; it must be 2e+18 at most'));
  test('all points the same', () => refuses([bare([1, 1, 1, 1, 1, 1, 1, 1, 1], [0, 1, 2])], 'all its points are the same, (1, 1, 1)'));
  test('so far that all points are the same', () => refuses([glass(scaled(round, 1, [1e12, 1e12, 1e12]))], 'all its points are the same, (1e+12, 1e+12, 1e+12)'));
  test('far, but seen: a note', () => assert.match(agrees([glass(scaled(round, 1, [1e6, 0, 0]))]).error, /lies 1e\+06 from the origin, where numbers are about 0\.1 apart/));
});

describe('eyes', { skip }, () => {
  const file = () => glass(round);
  test('in glass', () => agrees([file(), '--camera', '0,0,0.2'], { least: side * side }));
  test('in glass in glass', () => agrees(['--object', 'sphere', '--object', 'sphere:scale=0.5,ior=1.33', '--camera', '0,0,0.1', '--target', '1,0.1,0'], { least: side * side }));
  test('on a face', () => agrees(['--object', 'cube', '--camera', '0,0,0.5', '--target', '0,0,0']));
  test('in the plane of a face', () => agrees(['--object', 'cube', '--camera', '3,0.5,0', '--target', '0,0.5,0']));
  test('straight down', () => agrees([file(), '--camera', '0,5,0', '--target', '0,0,0'], { least: 50 }));
  test('far away', () => agrees([file(), '--camera', '1e18,0,0'], { least: 0, most: 0 }));
  test('near its target', () => agrees([file(), '--camera', '0,0,3', '--target', '0,0,2.9999998']));
  test('out of reach', () => refuses([file(), '--camera', '1e30,0,0'], 'position is at (1e+30, 0, 0)', 'from -1e+19 to 1e+19'));
  test('target out of reach', () => refuses([file(), '--camera', '0,0,3', '--target', '0,1e30,0'], 'target is at (0, 1e+30, 0)'));
  test('on its target', () => refuses([file(), '--camera', '1,2,3', '--target', '1,2,3'], 'the camera stands on its target (1, 2, 3)'));
  for (const fov of ['0.001', '179.9', 'nan']) test(`field of view ${fov}`, () => refuses([file(), '--fov', fov], '--fov is', fov));
});

describe('indices', { skip }, () => {
  const none = { least: 0, most: 0 };
  test('1 turns nothing', () => agrees([glass(round), '--ior', '1'], none));
  test('a thin wall, which is passed straight on', () => agrees([glass(round, thin([1, 1, 1]))]));
  test('1 of an object', () => agrees(['--object', 'sphere:ior=1', '--object', 'cube:ior=1,at=0.2,0,0'], none));
  test('0 of a file mirrors all', () => agrees([glass(round, solid([1, 1, 1], { extensions: { KHR_materials_ior: { ior: 0 } } }))], none));
  for (const ior of long ? [1.00001, 1.0001, 1.1, 2.5, 4] : [1.00001, 4]) test(`${ior}`, () => agrees([glass(round), '--ior', String(ior)]));
  for (const ior of [0.25, 0.5]) test(`${ior} of an object`, () => agrees(['--object', `sphere:ior=${ior}`]));
  for (const ior of ['0', '0.5', '1e6', 'nan']) test(`${ior} is refused`, () => refuses([glass(round), '--ior', ior], '--ior is'));
  test('1e6 of a file is refused', () => refuses([glass(round, solid([1, 1, 1], { extensions: { KHR_materials_ior: { ior: 1e6 } } }))], 'index of refraction of 1e+06; it must be from 0.25 to 4'));
});

describe('triangles', { skip }, () => {
  const turned = (indices) => indices.map((_, i) => indices[i - (i % 3) + 2 - (i % 3)]);
  const kinds = {
    'inside out': { ...round, indices: turned(round.indices) },
    'each twice': { ...round, indices: [...round.indices, ...round.indices] },
    'some without area': { ...round, indices: [...round.indices, 0, 0, 0, 1, 1, 5, 20, 40, 40] },
    'normals of no length': { ...round, normals: round.normals.map(() => 0) },
    'normals of 1e-30': { ...round, normals: round.normals.map((part) => part * 1e-30) },
    'normals the wrong way': { ...round, normals: round.normals.map((part) => -part) },
  };
  for (const [name, mesh] of Object.entries(kinds)) test(name, () => agrees([glass(mesh)]));
  test('three on an edge', () => agrees([bare([...cube.positions, 0, 0, 3], [...cube.indices, 0, 1, 8])]));
  test('one', () => agrees([bare([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2])]));
  test('none with an area: a warning', () => assert.match(agrees([bare([1, 1, 1, 2, 2, 2, 3, 3, 3], [0, 1, 2])], { least: 0, most: 0 }).error, /cannot be seen: none of its 1 triangles has an area/));
  test('two equal boxes in one place', () => agrees(['--object', 'cube', '--object', 'cube']));
  test('two equal balls of two kinds of glass', () => agrees(['--object', 'sphere', '--object', 'sphere:ior=1.33']));
  test('boxes that touch', () => agrees(['--object', 'cube', '--object', 'cube:at=1,0,0']));
  for (const number of [NaN, Infinity]) test(`a position of ${number}`, () => refuses([bare([number, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2])], 'vertex 0 has a position that is not finite'));
  test('none', () => refuses([bare([0, 0, 0, 1, 0, 0, 0, 1, 0], [])], 'no triangles'));
});

describe('keys of animations', { skip }, () => {
  const moves = { translation: [[0, 0, 0], [0.4, 0, 0]], rotation: [[0, 0, 0, 1], [0, 1, 0, 0]], scale: [[1, 1, 1], [1, 2, 1]], weights: [[0], [1]] };
  /** A ball that moves so; its keys as they come. `count`: of keys, without bytes for them. */
  const keyed = (path, { times = [0, 1], values = moves[path], way = 'LINEAR', count } = {}) => write('keyed.glb', edited(model([{ mesh: round, material: solid([1, 1, 1]) }]), (json) => {
    const numbers = new Float32Array([...times, ...values.flat()]), buffer = json.buffers.length;
    const add = (byteOffset, one, size) => json.accessors.push(count ? { componentType: 5126, count, type: one } : { bufferView: json.bufferViews.push({ buffer, byteOffset, byteLength: 4 * size }) - 1, componentType: 5126, count: size / { SCALAR: 1, VEC3: 3, VEC4: 4 }[one], type: one }) - 1;
    json.buffers.push({ byteLength: numbers.byteLength, uri: `data:application/octet-stream;base64,${Buffer.from(numbers.buffer).toString('base64')}` });
    const kind = { rotation: 'VEC4', weights: 'SCALAR' }[path] ?? 'VEC3';
    const sampler = { input: add(0, 'SCALAR', times.length), output: add(4 * times.length, kind, values.flat().length), interpolation: way };
    if (path === 'weights') json.meshes[0].primitives[0].targets = [{ POSITION: json.meshes[0].primitives[0].attributes.POSITION }];
    json.animations = [{ samplers: [sampler], channels: [{ sampler: 0, target: { node: 0, path } }] }];
  }));
  const at = (seconds, path, keys, ...expected) => agrees([keyed(path, keys), '--time', String(seconds)], ...expected);
  for (const path of Object.keys(moves)) more(`of ${path}`, () => at(0.5, path));
  more('times below 0', () => at(0, 'translation', { times: [-2, -1] }));
  more('times that are all one', () => at(0, 'translation', { times: [1, 1] }));
  more('times 1e-45 apart', () => at(1e-45, 'translation', { times: [0, 1e-45] }));
  test('times 6e38 apart', () => at(1, 'translation', { times: [-3e38, 3e38] }));
  more('a time far behind the last', () => at(1e6, 'rotation'));
  test('tangents of 1e38 over 1e30 seconds', () => refuses([keyed('translation', { times: [0, 1e30], values: [[0, 0, 0], [0, 0, 0], [1e38, 0, 0], [1e38, 0, 0], [0, 0, 0], [0, 0, 0]], way: 'CUBICSPLINE' }), '--time', '1e6'], 'moved so far that 32-bit numbers do not hold it'));
  more('rotations of 1e-20 and 1e30', () => at(0.5, 'rotation', { values: [[0, 0, 0, 1e-20], [0, 1e30, 0, 0]] }));
  test('rotations that meet at 0', () => at(0.5, 'rotation', { values: [[0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, -1], [0, 0, 0, 0]], way: 'CUBICSPLINE' }));
  more('a scale of 1e9', () => at(1, 'scale', { values: [[1, 1, 1], [1e9, 1e9, 1e9]] }));
  more('a scale of 1e-9, out of sight', () => at(1, 'scale', { values: [[1, 1, 1], [1e-9, 1e-9, 1e-9]] }, { least: 0, most: 0 }));
  test('a scale of 0', () => at(1, 'scale', { values: [[1, 1, 1], [0, 0, 0]] }, { least: 0, most: 0 }));
  more('a scale turned inside out', () => at(1, 'scale', { values: [[1, 1, 1], [-1, 1, 1]] }));
  more('a place of 1e17, out of sight', () => at(1, 'translation', { values: [[0, 0, 0], [1e17, 0, 0]] }, { least: 0, most: 0 }));
  test('a weight of 1e9', () => at(1, 'weights', { values: [[0], [1e9]] }));
  for (const [what, path, keys, ...parts] of [
    ['a scale of 1e38', 'scale', { values: [[1, 1, 1], [1e38, 1e38, 1e38]] }, 'is scaled by 1e+38, 1e+38, 1e+38 or moved so far that'],
    ['a place of 3e38', 'translation', { values: [[0, 0, 0], [3e38, 0, 0]] }, '3e+38'],
    ['a weight of 3e38', 'weights', { values: [[0], [3e38]] }, 'reaches 3e+38 from the origin'],
    ['a time of NaN', 'translation', { times: [0, NaN] }, 'has the time nan after 0'],
    ['a time of Infinity', 'translation', { times: [0, Infinity] }, 'has the time inf after 0'],
    ['times that fall', 'translation', { times: [1, 0] }, 'has the time 0 after 1'],
    ['a value of NaN', 'translation', { values: [[0, 0, 0], [NaN, 0, 0]] }, 'has a value that is not finite'],
    ['a weight of Infinity', 'weights', { values: [[0], [Infinity]] }, 'has a value that is not finite'],
    ['a rotation of no length', 'rotation', { values: [[0, 0, 0, 1], [0, 0, 0, 0]] }, 'has a rotation of zero length'],
    ['fewer values than keys', 'translation', { values: [[0, 0, 0]] }, 'has 1 values of 3 numbers for 2 keys'],
    ['4e9 keys of no bytes', 'scale', { count: 4e9 }, "a 'count' that is not a whole number from 0 to 2147483647"],
    ['1e8 keys of no bytes', 'rotation', { count: 1e8 }, '100000000 elements without data, more than the 16777216'],
  ]) {
    test(what, () => refuses([keyed(path, keys), '--time', '1'], ...parts));
  }
});

describe('light', { skip }, () => {
  const pfm = (value) => {
    const numbers = new Float32Array(8 * 4 * 3).fill(0.5);
    numbers[33] = value;
    return write('light.pfm', Buffer.concat([Buffer.from('PF\n8 4\n-1.0\n'), Buffer.from(numbers.buffer)]));
  };
  for (const value of [1e30, 3e38, 1e-45, NaN, Infinity, -1]) test(`a pixel of ${value}`, () => agrees([glass(round), '-e', pfm(value)]));
  const withPixel = (value) => write('light.exr', exrOf(8, 4, new Float32Array(96).fill(0.5).fill(value, 33, 34)));
  for (const value of long ? [3e38, -3e38, NaN, Infinity, -Infinity] : [3e38, NaN]) test(`a pixel of ${value}, OpenEXR`, () => agrees([glass(round), '-e', withPixel(value)]));
  /** The exponent of one pixel; what else the header says. */
  const hdr = (exponent, header = '') => {
    const bytes = Buffer.alloc(4 * 32, 128);
    bytes[7] = exponent;
    return write('light.hdr', Buffer.concat([Buffer.from(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n${header}\n-Y 4 +X 8\n`), bytes]));
  };
  for (const exponent of long ? [0, 1, 255] : [255]) test(`a pixel of exponent ${exponent}, Radiance HDR`, () => agrees([glass(round), '-e', hdr(exponent)]));
  for (const header of ['EXPOSURE=1e-30\nEXPOSURE=1e-30', ...(long ? ['EXPOSURE=1e30\nEXPOSURE=1e30', 'GAMMA=nan', 'PIXASPECT=0'] : [])]) {
    test(`a header of ${header}, Radiance HDR`, () => agrees([glass(round), '-e', hdr(128, `${header}\n`)]));
  }
  for (const number of long ? ['nan', 'inf', '0', '-1', '1e-45', '1e38', '1e308', ''] : ['nan', '1e38']) {
    test(`an EXPOSURE of '${number}'`, () => refuses([glass(round), '-e', hdr(128, `EXPOSURE=${number}\n`)], 'its EXPOSURE is not a number from 1e-30 to 1e30'));
  }
  more('a COLORCORR of NaN', () => refuses([glass(round), '-e', hdr(128, 'COLORCORR=1 nan 1\n')], 'its COLORCORR is not three numbers from 1e-30 to 1e30'));
  more('all pixels of 3e38', () => agrees([glass(round), '-e', write('light.exr', exrOf(8, 4, new Float32Array(96).fill(3e38)))]));
  more('all pixels of 0', () => agrees([glass(round), '-e', write('light.exr', exrOf(8, 4, new Float32Array(96)))]));
  test('a ground and rough glass under a sun of 3e38', () => {
    for (const words of [['--ground'], ['--roughness', '0.3'], ['--dispersion', '0.5', '--samples', '4']]) draw([glass(round), '-e', withPixel(3e38), ...words], 'exact');
  });
  for (const value of long ? [3e38, NaN, -Infinity] : [NaN]) test(`a height of ${value}`, () => {
    const { code, error } = draw([withPixel(value)], 'heightfield');
    assert.ok(code === 0 || /light\.exr/.test(error), error);
  });
  for (const [option, value] of [['--exposure', '1e9'], ['--sun', '0,0,0'], ['--sun', '0,1,0,0.5,1e39,1,1'], ['--ground', 'nan'], ['--roughness', '1e30'], ['--dispersion', '-1']]) {
    test(`${option} ${value}`, () => refuses([glass(round), option === '--ground' ? `${option}=${value}` : option, ...(option === '--ground' ? [] : [value])], option));
  }
  test('a ground as far below as floats go', () => agrees([glass(round), '--ground=-1e30']));
  for (const distance of [1e-30, 1e30]) {
    test(`attenuation distance ${distance}`, () => agrees([glass(round, solid([1, 1, 1], { extensions: { KHR_materials_volume: { thicknessFactor: 1, attenuationColor: [0, 0.5, 1], attenuationDistance: distance } } }))]));
  }
});
