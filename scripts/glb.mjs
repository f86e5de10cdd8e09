// Writes binary glTF 2.0: what the demo's models and the tests' are made with.

/** glTF as JSON and data of positions and indices, 16 bits where they suffice. @param {{positions: number[], normals?: number[], indices: number[], ior?: number}} mesh flat lists @param {string} [uri] of the data, in a file of its own */
export function gltf({ positions, normals, indices, ior }, uri) {
  const points = Buffer.from(new Float32Array(positions).buffer);
  const isSmall = positions.length / 3 <= 65535 && indices.every((index) => index <= 65535);
  const corners = Buffer.from((isSmall ? new Uint16Array(indices) : new Uint32Array(indices)).buffer);
  const bounds = (pick) => [0, 1, 2].map((axis) => {
    let bound = -pick(-Infinity, Infinity);
    for (let i = axis; i < positions.length; i += 3) {
      if (Number.isFinite(positions[i])) bound = pick(bound, Math.fround(positions[i]));
    }
    return bound;
  });
  const json = {
    asset: { version: '2.0' },
    buffers: [{ byteLength: points.length + corners.length, uri }],
    bufferViews: [{ buffer: 0, byteLength: points.length }, { buffer: 0, byteOffset: points.length, byteLength: corners.length }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: positions.length / 3, type: 'VEC3', min: bounds(Math.min), max: bounds(Math.max) },
      { bufferView: 1, componentType: isSmall ? 5123 : 5125, count: indices.length, type: 'SCALAR' },
    ],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    nodes: [{ mesh: 0 }],
    scenes: [{ nodes: [0] }],
    scene: 0,
  };
  const parts = [points, corners];
  if (normals !== undefined) {
    const byteOffset = points.length + corners.length + ((4 - (corners.length % 4)) % 4);
    parts.push(Buffer.alloc(byteOffset - points.length - corners.length), Buffer.from(new Float32Array(normals).buffer));
    json.buffers[0].byteLength = byteOffset + points.length;
    json.bufferViews.push({ buffer: 0, byteOffset, byteLength: points.length });
    json.accessors.push({ bufferView: 2, componentType: 5126, count: positions.length / 3, type: 'VEC3' });
    json.meshes[0].primitives[0].attributes.NORMAL = 2;
  }
  if (ior !== undefined) {
    json.extensionsUsed = ['KHR_materials_ior'];
    json.materials = [{ extensions: { KHR_materials_ior: { ior } } }];
    json.meshes[0].primitives[0].material = 0;
  }
  return { json, bin: Buffer.concat(parts) };
}

/** The file of what gltf returns, changed or not. @returns {Buffer} */
export function glb({ json, bin }) {
  const pad = (bytes, filler) => Buffer.concat([bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4, filler)]);
  const words = (...numbers) => Buffer.from(new Uint32Array(numbers).buffer);
  const text = pad(Buffer.from(JSON.stringify(json)), ' '), data = pad(bin, 0);
  return Buffer.concat([words(0x46546c67, 2, 28 + text.length + data.length), words(text.length, 0x4e4f534a), text, words(data.length, 0x004e4942), data]);
}

export const tetrahedron = { positions: [1, 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1], indices: [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3] };

/** From -1 to 1. */
export const cube = {
  positions: Array.from({ length: 8 }, (_, i) => [i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1]).flat(),
  indices: [[4, 5, 7, 6], [1, 0, 2, 3], [5, 1, 3, 7], [0, 4, 6, 2], [6, 7, 3, 2], [0, 1, 5, 4]].flatMap(([a, b, c, d]) => [a, b, c, a, c, d]),
};
