// Primitives packed by Draco (KHR_draco_mesh_compression), unpacked by npm's draco3dgltf: with it a module of its own, and
// draco.wasm beside it, which a page loads only for such a model.
import createDraco from 'draco3dgltf/draco_decoder_gltf_nodejs.js';

/** glTF's types of components by Draco's names of them. */
const types = { 5120: 'DT_INT8', 5121: 'DT_UINT8', 5122: 'DT_INT16', 5123: 'DT_UINT16', 5125: 'DT_UINT32', 5126: 'DT_FLOAT32' };
const widths = { 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 };

let loading = null;

/** The decoder. A load that failed is tried again by the next call. */
export function load() {
  const fetchIt = async () => {
    const response = await fetch(new URL('./draco.wasm', import.meta.url));
    if (!response.ok) throw new Error(`the server answered ${response.status} to draco.wasm`);
    return createDraco({ wasmBinary: await response.arrayBuffer() });
  };
  loading ??= fetchIt().catch((reason) => {
    loading = null;
    throw reason;
  });
  return loading;
}

/** The bytes that `write` puts at an address; null where it fails. */
function take(draco, size, write) {
  const place = draco._malloc(size || 1);
  if (place === 0) throw new Error('out of memory');
  const bytes = write(place) ? draco.HEAPU8.slice(place, place + size) : null;
  draco._free(place);
  return bytes;
}

/**
 * The numbers that a stream declares before its connectivity, so that nobody takes memory for what a few bytes say:
 * sections 2 to 4 of https://google.github.io/draco/spec/.
 * @param {Uint8Array} bytes
 * @param {number} most of triangles and of vertices
 * @returns {{faces: number, vertices: number}}
 * @throws {Error} where it is of another version than glTF has, ends, or declares more than it can have
 */
function declared(bytes, most) {
  let at = 0;
  const byte = () => {
    if (at >= bytes.length) throw new Error('it ends too early');
    return bytes[at++];
  };
  const number = () => {
    let value = 0, more = true;
    for (let factor = 1; more; factor *= 128) {
      const next = byte();
      value += (next & 127) * factor;
      more = next > 127;
    }
    return value;
  };
  const skip = (count) => (at += count);
  const skipMetadata = () => {
    for (let entries = number(); entries > 0; --entries) {
      skip(byte());
      skip(number());
    }
    for (let parts = number(); parts > 0; --parts) {
      skip(byte());
      skipMetadata();
    }
  };
  skip(5); // "DRACO"
  const major = byte(), minor = byte();
  if (major !== 2 || minor !== 2) throw new Error(`it has version ${major}.${minor} of Draco's bitstream, but glTF has 2.2`);
  skip(1); // a mesh, or points
  const isInOrder = byte() === 0, flags = byte() + 256 * byte();
  if (flags & 0x8000) {
    for (let attributes = number(); attributes > 0; --attributes) {
      number(); // its name
      skipMetadata();
    }
    skipMetadata();
  }
  const hasBits = !isInOrder && byte() === 0; // one at least for three quarters of the triangles
  const first = number(), second = number(), [faces, vertices] = isInOrder ? [first, second] : [second, first], left = bytes.length - at;
  if (faces > most || vertices > most || (hasBits && 3 * faces > 4 * 8 * left)) {
    throw new Error(`it declares ${faces} triangles and ${vertices} vertices, which neither its ${left} bytes nor its accessors have`);
  }
  return { faces, vertices };
}

/**
 * @param draco what load gave
 * @param {Uint8Array} bytes
 * @param {Map<string, {id: number, componentType: number, components: number}>} wanted by the names of attributes
 * @param {number} most of triangles and of vertices, by the accessors
 * @param {(size: number) => void} spend told of sizes before memory is taken; may throw
 * @returns {{vertexCount: number, attributes: Map<string, Uint8Array>, indices: Uint8Array}} indices of 32 bits
 * @throws {Error} why not
 */
export function decode(draco, bytes, wanted, most, spend) {
  const { faces, vertices } = declared(bytes, most), inside = 44 * faces + 8 * vertices; // as gltf_draco.cpp counts them
  spend(inside);
  const decoder = new draco.Decoder(), mesh = new draco.Mesh();
  try {
    const status = decoder.DecodeArrayToMesh(new Int8Array(bytes.buffer, bytes.byteOffset, bytes.length), bytes.length, mesh);
    if (!status.ok()) throw new Error(status.error_msg());
    const vertexCount = mesh.num_points(), attributes = new Map();
    for (const [name, { id, componentType, components }] of wanted) {
      const attribute = decoder.GetAttributeByUniqueId(mesh, id), type = draco[types[componentType]];
      const size = vertexCount * components * widths[componentType];
      const fits = attribute.ptr !== 0 && type !== undefined && attribute.num_components() === components;
      if (fits) spend(size);
      const data = fits && take(draco, size, (place) => decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, type, size, place));
      if (!data) throw new Error(`it has no ${name} as its accessor says`);
      attributes.set(name, data);
    }
    const size = 12 * mesh.num_faces();
    spend(size);
    const indices = take(draco, size, (place) => decoder.GetTrianglesUInt32Array(mesh, size, place));
    if (!indices) throw new Error('it has no triangles');
    spend(-inside);
    return { vertexCount, attributes, indices };
  } catch (reason) {
    if (reason instanceof WebAssembly.RuntimeError) loading = null; // its memory may be in disorder: the next file gets a new decoder
    throw reason;
  } finally {
    if (loading !== null) {
      draco.destroy(mesh);
      draco.destroy(decoder);
    }
  }
}
