// Makes the models and environments of the gallery that come from npm, where `npm ci` in tests/ has put them, and
// their index. Nothing of them is kept in the repository.
// Usage: node models.mjs FOLDER
import { mkdirSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { glb, gltf } from '../../scripts/glb.mjs';

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

const folder = process.argv[2];
const require = createRequire(new URL('../../tests/package.json', import.meta.url));
const models = [];
mkdirSync(folder, { recursive: true });
for (const { name, title } of packages) {
  try {
    const { positions, cells } = require(name);
    writeFileSync(join(folder, `${name}.glb`), glb(gltf({ positions: positions.flat(), indices: cells.flat() })));
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
