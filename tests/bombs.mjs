// Files that are small and ask for much: what tests/bombs.test.mjs has refused.
import { deflateSync } from 'node:zlib';
import { glb } from '../scripts/glb.mjs';

const asset = '"asset":{"version":"2.0"}';
const repeat = (text, count) => Buffer.from(text.repeat(count).slice(0, -1));

/** A .gltf: `count` of a text under a key. */
export function jsonList(key, text, count) {
  return Buffer.concat([Buffer.from(`{${asset},"${key}":[`), repeat(`${text},`, count), Buffer.from(']}')]);
}

/** Nodes each of which is the next one's parent. */
export function nodeChain(count) {
  const nodes = Array.from({ length: count }, (_, i) => `{"children":[${(i + 1) % count}]}`);
  return Buffer.from(`{${asset},"scenes":[{"nodes":[0]}],"nodes":[${nodes.join(',')}]}`);
}

/** Keys that are all different, in an object that nothing reads. */
export function manyKeys(count) {
  return Buffer.from(`{${asset},"extras":{${Array.from({ length: count }, (_, i) => `"${i.toString(36)}":0`).join(',')}}}`);
}

export const nested = (depth) => Buffer.from(`{${asset},"extras":${'['.repeat(depth)}${']'.repeat(depth)}}`);

/** A sheet of so many vertices and triangles; `change` makes of the JSON what it will. */
export function sheet(vertexCount, triangleCount, change) {
  const positions = new Float32Array(3 * vertexCount).map((_, i) => Math.sin(i)), indices = new Uint32Array(3 * triangleCount).map((_, i) => i % vertexCount);
  const bin = Buffer.concat([Buffer.from(positions.buffer), Buffer.from(indices.buffer)]);
  const json = {
    asset: { version: '2.0' }, buffers: [{ byteLength: bin.length }],
    bufferViews: [{ buffer: 0, byteLength: positions.byteLength }, { buffer: 0, byteOffset: positions.byteLength, byteLength: indices.byteLength }],
    accessors: [{ bufferView: 0, componentType: 5126, count: vertexCount, type: 'VEC3' }, { bufferView: 1, componentType: 5125, count: indices.length, type: 'SCALAR' }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }], nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }],
  };
  change?.(json);
  return glb({ json, bin });
}

/** A primitive again and again. */
export const manyPrimitives = (count, vertexCount, triangleCount) => sheet(vertexCount, triangleCount, (json) => {
  json.meshes[0].primitives = Array(count).fill(json.meshes[0].primitives[0]);
});

/** As many materials as primitives. */
export const manyMaterials = (count) => sheet(3, 1, (json) => {
  json.materials = Array.from({ length: count }, (_, i) => ({ extensions: { KHR_materials_ior: { ior: 1 + i / count } } }));
  json.meshes[0].primitives = json.materials.map((_, material) => ({ attributes: { POSITION: 0 }, indices: 1, material }));
});

/** Accessors of zeros, which take no bytes. */
export const manyZeros = (primitives, zeros) => sheet(3, 1, (json) => {
  json.accessors.push({ componentType: 5126, count: zeros, type: 'VEC3' });
  json.meshes[0].primitives = Array(primitives).fill({ attributes: { POSITION: 2, NORMAL: 2, COLOR_0: 2 } });
});

export const manyTargets = (targets, vertexCount) => sheet(vertexCount, 1, (json) => {
  json.meshes[0].primitives[0].targets = Array(targets).fill({ POSITION: 0, NORMAL: 0 });
  json.meshes[0].weights = Array(targets).fill(0.1);
});

/** Nodes with a mesh of their own weights: a copy each. */
export const manyShapes = (nodes, vertexCount) => sheet(vertexCount, vertexCount, (json) => {
  json.meshes[0].primitives[0].targets = [{ POSITION: 0 }];
  json.nodes = Array.from({ length: nodes }, (_, i) => ({ mesh: 0, weights: [i / nodes] }));
  json.scenes[0].nodes = json.nodes.map((_, i) => i);
});

export const manySkins = (skins, nodes) => sheet(3, 1, (json) => {
  json.nodes = Array.from({ length: nodes }, () => ({}));
  json.skins = Array.from({ length: skins }, () => ({ joints: [0] }));
  for (let i = 0; i < skins; ++i) Object.assign(json.nodes[i], { mesh: 0, skin: i });
  json.scenes[0].nodes = json.nodes.map((_, i) => i);
});

/** A sparse accessor again and again: a copy each. */
export const manySparse = (accessors, count) => sheet(3, 1, (json) => {
  json.accessors.push({ componentType: 5126, count, type: 'VEC3', sparse: { count: 1, indices: { bufferView: 1, componentType: 5125 }, values: { bufferView: 0 } } });
  json.meshes[0].primitives = Array(accessors).fill({ attributes: { POSITION: 2 } });
});

/** Samplers that all read the same numbers. */
export const manySamplers = (count, keys) => sheet(3 * keys, 1, (json) => {
  json.accessors.push({ componentType: 5126, count: keys, type: 'SCALAR' }, { componentType: 5126, count: keys, type: 'VEC3' });
  json.animations = [{
    samplers: Array(count).fill({ input: 2, output: 3 }),
    channels: Array.from({ length: count }, (_, sampler) => ({ sampler, target: { node: 0, path: 'translation' } })),
  }];
});

/** Of PNG, section D: CRC-32. @param {Buffer} bytes */
function checksum(bytes) {
  let sum = 0xffffffff;
  for (const byte of bytes) {
    sum ^= byte;
    for (let k = 0; k < 8; ++k) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return ~sum >>> 0;
}

/** A chunk of a PNG file. @param {string} type four letters @param {Buffer} data */
export const pngChunk = (type, data) => {
  const bytes = Buffer.alloc(12 + data.length);
  bytes.writeUInt32BE(data.length, 0);
  bytes.write(type, 4, 'latin1');
  data.copy(bytes, 8);
  bytes.writeUInt32BE(checksum(bytes.subarray(4, -4)), 8 + data.length);
  return bytes;
};

/** A black PNG, of one bit a pixel unless said otherwise; `rows`: how many of them it has. */
export function png(width, height, { bits = 1, type = 0, rows = height, extra = [] } = {}) {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header[8] = bits;
  header[9] = type;
  const row = 1 + Math.ceil((width * bits * { 0: 1, 2: 3, 4: 2, 6: 4 }[type]) / 8);
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), pngChunk('IHDR', header), ...extra,
    pngChunk('IDAT', deflateSync(Buffer.alloc(row * rows), { level: 9 })), pngChunk('IEND', Buffer.alloc(0))]);
}

/** Texts that unpack to `size` bytes each. */
export const pngTexts = (count, size) => png(4, 4, { extra: Array(count).fill(pngChunk('zTXt', Buffer.concat([Buffer.from('a\0\0'), deflateSync(Buffer.alloc(size, 65))]))) });
export const pngProfile = (size) => png(4, 4, { extra: [pngChunk('iCCP', Buffer.concat([Buffer.from('a\0\0'), deflateSync(Buffer.alloc(size))]))] });

const marker = (code, ...bytes) => Buffer.from([0xff, code, (bytes.length + 2) >> 8, (bytes.length + 2) & 255, ...bytes]);

/** A grey progressive JPEG: one scan of its brightness, then `scans` that say of each pixel that there is nothing more. */
export function jpeg(width, height, scans, { cut = false } = {}) {
  const blocks = Math.ceil(width / 8) * Math.ceil(height / 8);
  const table = (id, ...values) => marker(0xc4, id, values.length, ...Array(15).fill(0), ...values);
  // The one code 0 of each table: of differences 0, and of 2^14 blocks and more, as 14 bits say, without anything.
  const parts = [Buffer.from([0xff, 0xd8]), marker(0xdb, 0, ...Array(64).fill(1)), marker(0xc2, 8, height >> 8, height & 255, width >> 8, width & 255, 1, 1, 0x11, 0),
    table(0x00, 0), table(0x10, 0xe0), marker(0xda, 1, 1, 0, 0, 0, 0)];
  if (cut) return Buffer.concat(parts);
  const runs = [];
  for (let left = blocks; left > 0; left -= 32767) runs.push(Math.max(Math.min(left, 32767), 16384));
  const bits = runs.map((run) => `0${(run - 16384).toString(2).padStart(14, '0')}`).join('');
  const bytes = [];
  for (let i = 0; i < bits.length; i += 8) {
    const byte = parseInt(bits.slice(i, i + 8).padEnd(8, '1'), 2);
    bytes.push(byte, ...(byte === 255 ? [0] : []));
  }
  parts.push(Buffer.alloc(Math.ceil(blocks / 8)));
  for (let i = 0; i < scans; ++i) parts.push(marker(0xda, 1, 1, 0, 1 + (i % 63), 1 + (i % 63), 0), Buffer.from(bytes));
  return Buffer.concat([...parts, Buffer.from([0xff, 0xd9])]);
}

/** A model whose materials have a picture each. */
export function manyPictures(pictures) {
  const { positions, texcoords, indices } = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], texcoords: [0, 0, 1, 0, 0, 1], indices: [0, 1, 2] };
  const parts = [Buffer.from(new Float32Array(positions).buffer), Buffer.from(new Float32Array(texcoords).buffer), Buffer.from(new Uint32Array(indices).buffer), ...pictures];
  const bufferViews = [];
  let at = 0;
  for (const part of parts) {
    bufferViews.push({ buffer: 0, byteOffset: at, byteLength: part.length });
    at += part.length;
  }
  const json = {
    asset: { version: '2.0' }, buffers: [{ byteLength: at }], bufferViews,
    accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3' }, { bufferView: 1, componentType: 5126, count: 3, type: 'VEC2' }, { bufferView: 2, componentType: 5125, count: 3, type: 'SCALAR' }],
    images: pictures.map((_, i) => ({ bufferView: 3 + i, mimeType: 'image/png' })), textures: pictures.map((_, source) => ({ source })),
    materials: [{ extensions: { KHR_materials_transmission: { transmissionFactor: 1 } } }, ...pictures.map((_, index) => ({ pbrMetallicRoughness: { baseColorTexture: { index } } }))],
    meshes: [{ primitives: Array.from({ length: pictures.length + 1 }, (_, material) => ({ attributes: { POSITION: 0, TEXCOORD_0: 1 }, indices: 2, material })) }],
    nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }],
  };
  return glb({ json, bin: Buffer.concat(parts) });
}

/** A Radiance HDR that has nothing but its header. */
export const hdr = (width, height) => Buffer.from(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`);

/** An OpenEXR file of tiles of one size, or of lines (0), of 16 bits (1) or floats (2), that ends with its header, or with `body`. */
export function exr(width, height, tile, kind = 1, body = Buffer.alloc(64)) {
  const number = (...values) => Buffer.from(new Int32Array(values).buffer);
  const attribute = (name, type, value) => Buffer.concat([Buffer.from(`${name}\0${type}\0`), number(value.length), value]);
  const channel = (name) => Buffer.concat([Buffer.from(`${name}\0`), number(kind, 0, 1, 1)]);
  return Buffer.concat([number(20000630, 2 | (tile > 0 ? 0x200 : 0)),
    attribute('channels', 'chlist', Buffer.concat([channel('B'), channel('G'), channel('R'), Buffer.from([0])])),
    attribute('compression', 'compression', Buffer.from([0])),
    attribute('dataWindow', 'box2i', number(0, 0, width - 1, height - 1)), attribute('displayWindow', 'box2i', number(0, 0, width - 1, height - 1)),
    attribute('lineOrder', 'lineOrder', Buffer.from([0])), attribute('pixelAspectRatio', 'float', Buffer.from(new Float32Array([1]).buffer)),
    attribute('screenWindowCenter', 'v2f', number(0, 0)), attribute('screenWindowWidth', 'float', Buffer.from(new Float32Array([1]).buffer)),
    ...(tile > 0 ? [attribute('tiles', 'tiledesc', Buffer.concat([number(tile, tile), Buffer.from([0])]))] : []), Buffer.from([0]), body]);
}

/** A buffer view that meshoptimizer packs, of so many elements of 4 bytes. */
export const meshopt = (count, mode = 'ATTRIBUTES', stride = 256) => sheet(3, 1, (json) => {
  json.extensionsUsed = ['EXT_meshopt_compression'];
  json.bufferViews.push({ buffer: 0, byteLength: 36, extensions: { EXT_meshopt_compression: { buffer: 0, byteLength: 36, byteStride: stride, count, mode } } });
  json.accessors[0] = { bufferView: 2, componentType: 5126, count, type: 'VEC3' };
});

const varint = (value) => {
  const bytes = [];
  for (; value > 127; value = Math.floor(value / 128)) bytes.push(128 | (value & 127));
  return [...bytes, value];
};

/** A primitive that Draco packs, or says so: as many faces and vertices, by accessors of `told`; traversal 0: standard, 2: by valence. */
export function draco(faces, vertices, { method = 1, version = [2, 2], symbols = 0, traversal = 0, told = { faces, vertices } } = {}) {
  const whole = (value) => [value, value >> 8, value >> 16, value >> 24].map((byte) => byte & 0xff);
  const number = version[0] < 2 ? whole : varint;
  const inOrder = [...varint(faces), ...varint(vertices), 1];
  const connectivity = [traversal, ...(version[0] < 2 ? whole(0) : []), ...number(vertices), ...number(faces), 0, ...number(symbols), ...number(0)];
  const packed = Buffer.from([...Buffer.from('DRACO'), ...version, 1, method, 0, 0, ...(method === 0 ? inOrder : connectivity), ...Array(64).fill(0)]);
  const json = {
    asset: { version: '2.0' }, buffers: [{ byteLength: packed.length }], bufferViews: [{ buffer: 0, byteLength: packed.length }], extensionsUsed: ['KHR_draco_mesh_compression'],
    accessors: [{ componentType: 5126, count: told.vertices, type: 'VEC3' }, { componentType: 5125, count: 3 * told.faces, type: 'SCALAR' }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1, extensions: { KHR_draco_mesh_compression: { bufferView: 0, attributes: { POSITION: 0 } } } }] }],
    nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }],
  };
  return glb({ json, bin: packed });
}
