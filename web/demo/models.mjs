// Makes the models and environments of the gallery that come from npm, where `npm ci` in tests/ has put them, and
// their index. Nothing of them is kept in the repository.
// Usage: node models.mjs FOLDER
import { mkdirSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const packages = [{ name: 'bunny', title: 'Bunny' }]; // 2503 vertices, after the Stanford Computer Graphics Laboratory's scan
const environments = ['city', 'sunset', 'forest', 'night', 'lobby']; // of @pmndrs/assets, Poly Haven, CC0

/** Linear RGBA floats, bottom row first, as Radiance HDR without run lengths (Ward 1991: shared exponent). */
function hdr({ width, height, data }) {
  const pixels = Buffer.alloc(4 * width * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const from = 4 * ((height - 1 - y) * width + x), to = 4 * (y * width + x);
      const color = [0, 1, 2].map((channel) => Math.max(0, data[from + channel]));
      const brightest = Math.max(...color);
      if (brightest < 1e-32) continue;
      const exponent = Math.floor(Math.log2(brightest)) + 1;
      color.forEach((value, channel) => (pixels[to + channel] = Math.min(255, Math.floor((value * 256) / 2 ** exponent))));
      pixels[to + 3] = exponent + 128;
    }
  }
  return Buffer.concat([Buffer.from(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`), pixels]);
}

async function decodeEnvironment(name) {
  const [{ EXRLoader }, { FloatType }, { default: url }] = await Promise.all([
    import(require.resolve('three/examples/jsm/loaders/EXRLoader.js')),
    import(require.resolve('three/src/constants.js')),
    import(require.resolve(`@pmndrs/assets/hdri/${name}.exr.js`)),
  ]);
  const bytes = Uint8Array.from(Buffer.from(url.slice(url.indexOf(',') + 1), 'base64'));
  const loader = new EXRLoader();
  loader.setDataType(FloatType);
  return hdr(loader.parse(bytes.buffer));
}

function glb({ positions, cells }) {
  const bounds = (pick) => [0, 1, 2].map((axis) => pick(...positions.map((position) => Math.fround(position[axis]))));
  const vertices = Buffer.from(new Float32Array(positions.flat()).buffer);
  const indices = Buffer.from(new Uint32Array(cells.flat()).buffer);
  const json = Buffer.from(JSON.stringify({
    asset: { version: '2.0' },
    buffers: [{ byteLength: vertices.length + indices.length }],
    bufferViews: [{ buffer: 0, byteLength: vertices.length }, { buffer: 0, byteOffset: vertices.length, byteLength: indices.length }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: positions.length, type: 'VEC3', min: bounds(Math.min), max: bounds(Math.max) },
      { bufferView: 1, componentType: 5125, count: 3 * cells.length, type: 'SCALAR' },
    ],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    nodes: [{ mesh: 0 }],
    scenes: [{ nodes: [0] }],
    scene: 0,
  }));
  const padded = Buffer.concat([json, Buffer.alloc((4 - (json.length % 4)) % 4, ' ')]);
  const words = (...numbers) => Buffer.from(new Uint32Array(numbers).buffer);
  const body = Buffer.concat([vertices, indices]);
  return Buffer.concat([
    words(0x46546c67, 2, 28 + padded.length + body.length),
    words(padded.length, 0x4e4f534a), padded, words(body.length, 0x004e4942), body,
  ]);
}

const folder = process.argv[2];
const require = createRequire(new URL('../../tests/package.json', import.meta.url));
const models = [];
mkdirSync(folder, { recursive: true });
for (const { name, title } of packages) {
  try {
    writeFileSync(join(folder, `${name}.glb`), glb(require(name)));
    models.push({ id: name, title, url: `assets/${name}.glb`, picture: `pictures/${name}.png` });
  } catch (reason) {
    if (reason.code !== 'MODULE_NOT_FOUND') throw reason;
    console.warn(`${name}: not installed (npm ci in tests/); the gallery goes without it`);
  }
}
const found = [];
for (const name of environments) {
  try {
    writeFileSync(join(folder, `${name}.hdr`), await decodeEnvironment(name));
    found.push({ id: name, title: name[0].toUpperCase() + name.slice(1), url: `assets/${name}.hdr` });
  } catch (reason) {
    if (!['MODULE_NOT_FOUND', 'ERR_MODULE_NOT_FOUND'].includes(reason.code)) throw reason;
    console.warn(`${name}: not installed (npm ci in tests/); the gallery goes without it`);
  }
}
writeFileSync(join(folder, 'index.json'), JSON.stringify({ models, environments: found }));
