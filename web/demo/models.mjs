// Makes the models of the gallery that come from npm, where `npm ci` in tests/ has put them, and their index.
// Usage: node models.mjs FOLDER
import { mkdirSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const packages = [{ name: 'bunny', title: 'Bunny' }]; // Stanford's, 2503 vertices, public domain

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
writeFileSync(join(folder, 'index.json'), JSON.stringify({ models }));
