// Buffer views packed by meshoptimizer (EXT_meshopt_compression, KHR_meshopt_compression), unpacked by npm's
// meshoptimizer: with it a module of its own, which a page loads only for such a model.
import { MeshoptDecoder } from 'meshoptimizer/decoder';

/** Bytes a vertex that a filter goes with, beside multiples of 4 up to 256. */
const stridesOf = { NONE: null, EXPONENTIAL: null, OCTAHEDRAL: [4, 8], QUATERNION: [8], COLOR: [4, 8] };

/** The decoder. */
export async function load() {
  await MeshoptDecoder.ready;
  return MeshoptDecoder;
}

/** Do mode and filter go with stride and count? The decoder does not look. */
function fits({ count, byteStride, mode, filter = 'NONE' }) {
  if (!(Number.isInteger(count) && count >= 0 && Number.isInteger(byteStride))) return false;
  if (mode !== 'ATTRIBUTES') return filter === 'NONE' && (mode === 'INDICES' || (mode === 'TRIANGLES' && count % 3 === 0)) && (byteStride === 2 || byteStride === 4);
  return byteStride > 0 && byteStride <= 256 && byteStride % 4 === 0 && Object.hasOwn(stridesOf, filter) && (stridesOf[filter] ?? [byteStride]).includes(byteStride);
}

/**
 * @param decoder what load gave
 * @param {Uint8Array} bytes
 * @param {{count: number, byteStride: number, mode: string, filter?: string}} how as the extension says
 * @param {(size: number) => void} spend told of the size before memory is taken; may throw
 * @returns {Uint8Array} @throws {Error} why not
 */
export function decode(decoder, bytes, how, spend) {
  const { count, byteStride, mode, filter } = how;
  if (!fits(how)) throw new Error(`mode ${mode}, filter ${filter ?? 'NONE'}, ${count} elements of ${byteStride} bytes`);
  spend(count * byteStride);
  const unpacked = new Uint8Array(count * byteStride);
  decoder.decodeGltfBuffer(unpacked, count, byteStride, bytes, mode, filter);
  return unpacked;
}
