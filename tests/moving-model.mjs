// A model that moves.
import { cube, glb, gltf } from '../scripts/glb.mjs';

/** A glass cube that goes along x from 0 to 2 in a second, and along y by the second animation. */
export function moving(change = () => {}) {
  const parts = gltf({ positions: [...cube.positions], indices: [...cube.indices] });
  const numbers = new Float32Array([0, 1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 1, 0]);
  const start = parts.bin.length;
  const view = (offset, byteLength) => parts.json.bufferViews.push({ buffer: 0, byteOffset: start + offset, byteLength }) - 1;
  const accessor = (offset, count, type, bytes) =>
    parts.json.accessors.push({ bufferView: view(offset, bytes), componentType: 5126, count, type }) - 1;
  const times = accessor(0, 2, 'SCALAR', 8), outputs = [accessor(8, 2, 'VEC3', 24), accessor(32, 2, 'VEC3', 24)];
  parts.json.buffers[0].byteLength += numbers.byteLength;
  parts.json.meshes[0].primitives[0].attributes.NORMAL = 0; // which are computed else, with a note
  parts.json.animations = outputs.map((output, i) => ({
    name: ['along', 'up'][i], samplers: [{ input: times, output }],
    channels: [{ sampler: 0, target: { node: 0, path: 'translation' } }],
  }));
  change(parts.json);
  return glb({ json: parts.json, bin: Buffer.concat([parts.bin, Buffer.from(numbers.buffer)]) });
}
